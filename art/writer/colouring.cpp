#include "art/writer/colouring.h"

#include "art/raster/regions.h"
#include "art/writer/make_drawing.h"
#include "art/writer/tiled_print.h"
#include "engine/base/option.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double rounding = 1.005;  // of areas measured in pixels

/// The drawing of a colouring page as a picture, without lines of text.
std::unique_ptr<Drawing> bare_drawing(const Grammar& grammar, const Style& style, const DrawOptions& options) {
    DrawOptions bare = options;
    bare.format = PrintFormat::png;
    bare.plot.reset();
    bare.tiles = nullptr;
    bare.relief = nullptr;
    bare.begin = nullptr;
    bare.specks.clear();
    bare.title_line.reset();
    bare.edition.clear();
    return make_drawing(grammar, style, bare);
}

void add(double area, RegionReport& report) {
    report.least = report.count == 0 ? area : std::min(report.least, area);
    ++report.count;
}

/// @param print  placed
ColouringCheck measured(const Drawing& drawing, Print print, const Monitor& monitor) {
    constexpr double most_dpi = 300, most_pixels = 12e6, inch = 25.4;
    print.dpi = std::min(most_dpi, inch * std::sqrt(most_pixels / (print.page.width * print.page.height)));
    print.style = drawing.style();
    print.style.stroke_colour = Colour{0, 0, 0, 255};  // dark, whatever the ink
    print.press = {};
    const auto rendering = drawing.rendering(print);
    rendering->watch([&] { monitor.check(); });
    const double pixel = inch / print.dpi, line = print.style.line_width({}, print.placement.step);
    const glm::dmat3x2& to_page = print.placement.to_page;
    const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(to_page[0], to_page[1]));
    ColouringCheck check;
    RegionReport holes;
    for (const ClosedRegion& region : closed_regions(*rendering, pixel_size(print.page, print.dpi))) {
        const double area = region.pixels * pixel * pixel;
        const bool is_speck = area <= line * line;
        if (is_speck) {
            check.specks.push_back({back * (pixel * region.centre - to_page[2]), 0.6 * line / print.placement.step});
        }
        add(area, is_speck ? holes : check.regions);
    }
    // A drawing that is so fine has no other regions.
    if (check.regions.count == 0) check.regions = holes;
    return check;
}

/// The print and its page, larger by a factor; lines keep their width.
Print enlarged(Print print, double factor) {
    print.page = {factor * print.page.width, factor * print.page.height, print.page.margin};
    glm::dmat3x2& to_page = print.placement.to_page;
    to_page = {factor * to_page[0], factor * to_page[1], factor * to_page[2]};
    print.placement.step *= factor;
    return print;
}

/// The factor by which the drawing has to grow until its regions have the area, if 16 suffices. The side of a region
/// between lines of constant width grows linearly.
std::optional<double> growth(const Drawing& drawing, const Print& print, const RegionReport& report, double wanted,
                             const Monitor& monitor) {
    constexpr double most_growth = 16;
    const auto side = [&](double factor) {
        return std::sqrt(measured(drawing, enlarged(print, factor), monitor).regions.least);
    };
    const double needed = std::sqrt(wanted * rounding), now = std::sqrt(report.least);
    const double most = std::min(needed / now, most_growth);
    const double largest = side(most);
    if (largest < needed) return std::nullopt;
    const double factor = 1 + (needed - now) / (largest - now) * (most - 1);
    return side(factor) >= std::sqrt(wanted) ? factor : most;
}

std::string name_of_size(glm::dvec2 size) {
    for (const char* name : {"A4", "A3", "A2", "A1", "A0"}) {
        const glm::dvec2 sheet = *parse_size(name, 0);
        const bool fits = sheet.x >= std::min(size.x, size.y) && sheet.y >= std::max(size.x, size.y);
        if (fits) return fmt::format(" ({})", name);
    }
    return "";
}

/// The page or the step that makes all regions large enough, unless the page would be larger than a wall.
std::string hint_of_size(const Page& page, std::optional<double> step, double factor) {
    constexpr double widest = 3000;
    if (step) return fmt::format("a step of at least {:g} mm", std::ceil(10 * factor * *step) / 10);
    const auto grown = [&](double side) { return std::ceil((side - 2 * page.margin) * factor + 2 * page.margin); };
    const glm::dvec2 size(grown(page.width), grown(page.height));
    if (std::max(size.x, size.y) > widest) return "";
    return fmt::format("a page of at least {:.0f} x {:.0f} mm{}", size.x, size.y, name_of_size(size));
}

/// The largest of the next shorter derivation lengths that makes them large enough.
std::string hint_of_length(const Grammar& grammar, const Style& style, const DrawOptions& options,
                           const Print& placed, double wanted) {
    constexpr std::int64_t most_tries = 6;
    for (std::int64_t steps = grammar.steps() - 1; steps >= std::max<std::int64_t>(0, grammar.steps() - most_tries);
         --steps) {
        const auto shorter = grammar.with_steps(steps);
        if (!shorter) break;
        Print print = placed;
        try {
            const auto drawing = bare_drawing(*shorter, style, options);
            drawing->place(print);
            const RegionReport report = measured(*drawing, print, options.monitor).regions;
            if (report.count > 1 && report.least >= wanted * rounding) return fmt::format("n = {}", steps);
        } catch (const NothingDrawn&) {
            break;
        }
    }
    return "";
}

/// The number of dots across that makes them large enough.
std::string hint_of_dots(const Grammar& grammar, Style style, const DrawOptions& options, double factor) {
    style.dots.emplace();
    try {
        const auto drawing = bare_drawing(grammar, style, options);
        const Box box = drawing->extent().box;
        const double distance = drawing->dot_distance();
        if (!(distance > 0)) return "";
        const double fewer = std::floor(box.longest() / distance / factor);
        return fewer >= 2 ? fmt::format("a grid of at most {:.0f} dots across", fewer) : "";
    } catch (const std::runtime_error&) {
        return "";
    }
}

[[noreturn]] void refuse_regions(const RegionReport& report, double wanted, const std::vector<std::string>& hints) {
    std::string text = fmt::format("the smallest of {} has {:.3g} mm², below {:g} mm²",
                                   counted(report.count, "closed region"), report.least, wanted);
    for (std::size_t i = 0; i < hints.size(); ++i) {
        text += fmt::format("{}{}", i == 0 ? "; expected " : i + 1 < hints.size() ? ", " : " or ", hints[i]);
    }
    refuse_option("colouring", "", text);
}

}  // namespace

ColouringCheck check_regions(const Grammar& grammar, const Style& style, const DrawOptions& options,
                             const Print& placed, const Page& sheet) {
    const double wanted = *options.colouring;
    const auto drawing = bare_drawing(grammar, style, options);
    Print print = placed;
    if (drawing->fixed_step()) place_whole(*drawing, print);
    drawing->seen();
    ColouringCheck check = measured(*drawing, print, options.monitor);
    const RegionReport& report = check.regions;
    if (report.count == 0) refuse_option("colouring", "", "the lines enclose no region that could be coloured");
    if (report.least >= wanted) return check;
    const std::optional<double> factor = growth(*drawing, print, report, wanted, options.monitor);
    std::vector<std::string> hints;
    if (factor) hints.push_back(hint_of_size(sheet, drawing->fixed_step(), *factor));
    const std::string length = hint_of_length(grammar, style, options, placed, wanted);
    hints.push_back(length.empty() && factor ? hint_of_dots(grammar, style, options, *factor) : length);
    hints.push_back("a smaller area");
    std::erase(hints, "");
    refuse_regions(report, wanted, hints);
}

}  // namespace sikku
