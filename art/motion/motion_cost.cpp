#include "art/motion/motion_cost.h"

#include "art/raster/raster.h"
#include "art/writer/make_drawing.h"
#include "art/writer/print_cost.h"
#include "engine/language/grammar.h"

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr double frame_pixel_seconds = 8e-9;
constexpr double frame_ink_seconds = 25e-9;

/// A frame of an animated GIF: its pixels are drawn and compared, and changes are written.
double frame_seconds(const Print& print, const DrawingCost& drawing) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    const double pixels = static_cast<double>(size.width) * size.height;
    const double fine = print.dpi / 25.4;
    const double inked = std::min(pixels, drawing.length * fine * 3 + drawing.ink * (fine * fine));
    return 0.0005 + pixels * frame_pixel_seconds + inked * frame_ink_seconds;
}

}  // namespace

Cost growth_cost(const Grammar& grammar, const Print& print, const DrawOptions& options,
                 const GrowthOptions& growth) {
    constexpr std::int64_t most_looked_at = 8;
    constexpr double motion_frames = 8;  // between generations of a map
    Cost sum = base_cost(uses_image_module(options.format));
    const std::int64_t count = growth.last - growth.first + 1;
    const std::int64_t looked_at = std::min(count, most_looked_at);
    const double each = static_cast<double>(count) / static_cast<double>(looked_at);
    for (std::int64_t i = 0; i < looked_at; ++i) {
        // The last one is the most expensive.
        const std::int64_t n = growth.last - i * count / looked_at;
        const auto generation = grammar.with_steps(n);
        if (!generation) continue;
        if (!growth.is_animation) {
            const Cost own = print_cost(*generation, print, options);
            sum.seconds += each * (own.seconds - own.shared_seconds);
            sum.bytes += each * own.bytes;
            sum.memory = std::max(sum.memory, own.memory);
            sum.band = std::max(sum.band, own.band);
            continue;
        }
        const DrawingCost drawing = drawing_cost(*generation, print, options, options.reading());
        Cost scene;
        if (grammar.is_spatial()) add_scene(print, drawing, scene);
        // All generations are read once more for the frame that they share.
        const double frames = grammar.map() ? motion_frames : 1;
        const double frame = frame_seconds(print, drawing) + scene.seconds;
        sum.seconds += each * (2 * drawing.seconds + frames * frame);
        sum.bytes += each * frames * frame_seconds(print, drawing) * 1e6;
        sum.memory = std::max(sum.memory, base_cost(false).memory + drawing.memory + scene.memory);
    }
    return sum;
}

Cost division_cost(const Grammar& grammar, const Print& print, const DrawOptions& options,
                   const DivisionOptions& division) {
    constexpr double pictures_of_second = 25, bytes_of_moving_tile = 60;
    Cost cost = base_cost(false);
    const auto stages = static_cast<double>(division.last - division.first + 1);
    const DrawingCost drawing = drawing_cost(grammar, print, options, options.reading());
    cost.seconds += 3 * drawing.seconds;
    cost.memory += drawing.memory;
    if (!division.is_gif) {
        cost.seconds += drawing.points * 1e-6;
        cost.bytes = drawing.points * bytes_of_moving_tile;
        return cost;
    }
    const double frames = stages + (stages - 1) * division.times.division * pictures_of_second;
    // Most of them have fewer tiles than the last.
    cost.seconds += frames * (frame_seconds(print, drawing) + drawing.seconds / 2);
    cost.bytes = frames * frame_seconds(print, drawing) * 1e6;
    return cost;
}

Cost lesson_cost(const Grammar& grammar, const Print& print, const DrawOptions& options, bool is_animation) {
    constexpr double lines_of_step = 24, frames_of_step = 6, most_pages = 40, most_cells = 10;
    DrawOptions drawn = options;
    drawn.lesson_step = 0;
    const DrawingCost drawing = drawing_cost(grammar, print, drawn, drawn.reading());
    const bool has_pixels = !is_vector(options.format);
    const double steps =
        std::clamp(drawing.lines / lines_of_step, 1.0, has_pixels && !is_animation ? most_cells : most_pages);
    Cost cost = base_cost(uses_image_module(options.format));
    cost.memory += drawing.memory;
    cost.seconds += drawing.seconds;
    if (is_animation) {
        cost.seconds += steps * frames_of_step * frame_seconds(print, drawing);
        cost.bytes = steps * frames_of_step * 5000;
    } else if (has_pixels) {
        const Cost own = print_cost(grammar, print, options);
        cost.seconds += own.seconds - own.shared_seconds + steps * drawing.seconds / 4;
        cost.bytes = own.bytes;
    } else {
        const double points = steps * drawing.points * 14;
        cost.seconds += points * 250e-9;
        cost.bytes = points * 12;
    }
    return cost;
}

}  // namespace sikku
