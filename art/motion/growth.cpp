#include "art/motion/growth.h"

#include "art/drawing/map_frames.h"
#include "art/image/image_file.h"
#include "art/motion/gif_file.h"
#include "art/writer/make_drawing.h"
#include "engine/base/output.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {
namespace {

// While a map grows from one generation to the next: the time of each frame in seconds, and the part of a
// generation's time that the motion takes.
constexpr double motion_seconds = 0.04, motion_share = 0.7;

Grammar generation_of(const Grammar& grammar, std::int64_t steps) {
    auto other = grammar.with_steps(steps);
    if (!other)
        throw std::runtime_error(fmt::format("the schedule is too short for a derivation length of {}", steps));
    return std::move(*other);
}

/// The part of all generations that the page has to contain; `bounds` grows by their extent in space.
DrawnExtent frame_of(const Grammar& grammar, const Style& style, DrawOptions options, const GrowthOptions& growth,
                     std::optional<SpaceBounds>& bounds) {
    options.begin = nullptr;
    // The lines alone determine the frame: dots lie between them.
    options.colours_strokes = options.only_dots = false;
    options.title_line.reset();
    options.edition.clear();
    Style lines = style;
    lines.dots.reset();
    lines.border.reset();
    lines.fields.reset();
    DrawnExtent frame;
    const auto add = [&](const DrawnExtent& seen) {
        if (seen.box.empty()) return;
        frame.box.add(seen.box.low);
        frame.box.add(seen.box.high);
        frame.widest = std::max(frame.widest, seen.widest);
        frame.around = std::max(frame.around, seen.around);
    };
    for (std::int64_t n = growth.first; n <= growth.last; ++n) {
        const auto drawing = make_drawing(generation_of(grammar, n), lines, options);
        add(drawing->seen());
        if (const auto own = drawing->bounds()) {
            if (!bounds) bounds = *own;
            bounds->low = glm::min(bounds->low, own->low);
            bounds->high = glm::max(bounds->high, own->high);
        }
    }
    return frame;
}

/// Turns a dot spacing into one step for all generations, computed from the last one with two dots.
void set_step(const Grammar& grammar, const Style& style, DrawOptions& options, const GrowthOptions& growth) {
    for (std::int64_t n = growth.last; n >= growth.first && !options.placement.step; --n) {
        options.placement.step = make_drawing(generation_of(grammar, n), style, options)->fixed_step();
    }
    options.dot_spacing.reset();
    if (!options.placement.step) {
        throw std::runtime_error("dot spacing needs at least two dots; these drawings have fewer");
    }
}

/// The options with the frame of this generation alone, if each is to have its own and it draws anything.
DrawOptions framed(const Grammar& grammar, const Style& style, const DrawOptions& options,
                   const GrowthOptions& growth, std::int64_t n) {
    DrawOptions result = options;
    if (!growth.fits_each || options.window) return result;
    std::optional<SpaceBounds> bounds;
    DrawOptions alone = options;
    alone.frame.reset();
    const DrawnExtent own = frame_of(grammar, style, alone, {.first = n, .last = n}, bounds);
    if (!own.box.empty()) result.frame = own;
    return result;
}

/// Number of pictures between a generation and the one before it, if something grows.
int moving_frames(const DrawOptions& options, const GrowthOptions& growth, std::int64_t n) {
    if (n == growth.first || !options.map_frames || !options.map_frames->after(n)->has_growth()) return 0;
    return std::max(0, static_cast<int>(motion_share * growth.seconds / motion_seconds) - 1);
}

void draw_gif(const Grammar& grammar, const Print& given, const DrawOptions& shown, const GrowthOptions& growth,
              const std::filesystem::path& file, Destination& destination, DrawReport& report) {
    // All generations are read as words, so the largest is checked before the first is drawn.
    if (!grammar.map()) require_affordable(generation_of(grammar, growth.last), true, shown.budget);
    const DrawOptions options = for_frames(shown);
    std::size_t frames = 0;
    for (std::int64_t n = growth.first; n <= growth.last; ++n) {
        frames += 1 + static_cast<std::size_t>(moving_frames(options, growth, n));
    }
    const auto output = destination.open(file);
    GifFile gif(given, options, frames, *output, file);
    const auto add = [&](std::int64_t n, const DrawOptions& drawn, double seconds) {
        Print print = given;
        const auto drawing = make_drawing(generation_of(grammar, n), print.style, drawn);
        report = drawing->place(print);
        print.style = drawing->style();
        gif.frame(*drawing, print, seconds);
    };
    for (std::int64_t n = growth.first; n <= growth.last; ++n) {
        DrawOptions drawn = framed(grammar, given.style, options, growth, n);
        double seconds = growth.seconds;
        const int moving = moving_frames(options, growth, n);
        for (int i = 1; i <= moving; ++i) {
            const double share = static_cast<double>(i) / (moving + 1);
            drawn.map_share = share * share * (3 - 2 * share);
            add(n, drawn, motion_seconds);
        }
        seconds -= motion_seconds * moving;
        drawn.map_share = 1;
        add(n, drawn, n == growth.last ? std::max(seconds, growth.hold) : seconds);
    }
    gif.close();
    output->commit();
}

}  // namespace

std::filesystem::path frame_file(const std::filesystem::path& file, std::int64_t generation, std::int64_t last) {
    std::filesystem::path named = file;
    named.replace_filename(fmt::format("{}-{:0{}}{}", file.stem().string(), generation,
                                       fmt::formatted_size("{}", last), file.extension().string()));
    return named;
}

DrawReport draw_growth(const Grammar& grammar, const Print& given, const DrawOptions& given_options,
                       const GrowthOptions& growth, const std::filesystem::path& file, Destination& destination) {
    if (growth.first < 0 || growth.last > most_steps || growth.last - growth.first >= most_frames) {
        throw std::runtime_error(
            fmt::format("expected up to {} generations, with derivation "
                        "lengths up to {}",
                        most_frames, most_steps));
    }
    Print print = given;
    DrawOptions options = with_locked_watch(given_options);
    options.may_be_empty = true;
    if (uses_image_module(options.format)) prepare_images(options.threads);
    if (grammar.map()) {
        options.map_frames = std::make_shared<MapFrames>(generation_of(grammar, growth.last), options.budget,
                                                         options.monitor, KeptFrames::all);
    }
    if (options.dot_spacing) set_step(grammar, print.style, options, growth);
    std::optional<SpaceBounds> bounds;
    const DrawnExtent frame = frame_of(grammar, print.style, options, growth, bounds);
    if (frame.box.empty()) throw std::runtime_error("none of these generations draws anything");
    // All generations show the same window.
    if (!options.window) options.frame = frame;
    if (print.style.camera.distance && bounds && !growth.fits_each) {
        // The position of a camera with perspective is known only now.
        print.style.camera.aim = bounds;
        options.frame = frame_of(grammar, print.style, options, growth, bounds);
    }
    DrawReport report;
    if (growth.is_animation) {
        draw_gif(grammar, print, options, growth, file, destination, report);
        return report;
    }
    bool leaves_pattern_out = false;
    const std::string made = print.made;
    for (std::int64_t n = growth.first; n <= growth.last; ++n) {
        const Grammar generation = generation_of(grammar, n);
        print.made = fmt::format("{} # n = {}", made, n);  // a comment in shells
        report = draw(generation, print, framed(grammar, print.style, options, growth, n),
                      frame_file(file, n, growth.last), destination);
        leaves_pattern_out = leaves_pattern_out || report.leaves_pattern_out;
    }
    report.leaves_pattern_out = leaves_pattern_out;
    return report;
}

}  // namespace sikku
