#include "art/print/ornaments.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sikku {
namespace {

// Of the border's width: a loop is two radii and the line wide.
constexpr double loop_share = 0.38;
constexpr double line_share = 0.24;
constexpr double earth_share = 0.6;  // of the line
constexpr double dot_share = 0.4;    // of the loop

}  // namespace

double least_distance(std::span<const glm::dvec2> dots) {
    std::vector<glm::dvec2> sorted(dots.begin(), dots.end());
    std::sort(sorted.begin(), sorted.end(),
              [](glm::dvec2 a, glm::dvec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    double least = 1e300;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].y - sorted[i].y < least; ++j) {
            least = std::min(least, glm::length(sorted[j] - sorted[i]));
        }
    }
    return sorted.size() < 2 ? 0 : least;
}

double border_width(const Page& page) {
    return std::min(page.width, page.height) / 24;
}

double border_room(double width) {
    return 1.6 * width;
}

std::vector<Colour> border_colours(const std::optional<Colour>& ground) {
    constexpr double least = 0.14;  // in OKLab
    const Colour white = kolam_palette().front();
    const Colour under = ground && ground->alpha > 0 ? *ground : Colour{255, 255, 255, 255};
    const Colour kaavi{0xb3, 0x45, 0x2c, 255};
    if (colour_distance(kaavi, under) >= least) return {white, kaavi};
    return {white, {0xe0, 0x7a, 0x50, 255}};
}

std::vector<Colour> kolam_palette() {
    constexpr std::size_t length = std::string_view("#rrggbb").size();
    std::vector<Colour> palette;
    for (std::size_t at = 0; at < kolam_colours.size(); at += length + 1) {
        palette.push_back(*parse_colour(kolam_colours.substr(at, length)));
    }
    return palette;
}

void draw_border(const Print& print, const Window& window, double width, int colour, PathSink& sink) {
    const Placement& placement = print.placement;
    const double radius = width * loop_share;
    const double line = width * line_share;
    // Page units, y down, clockwise from the top left corner; the sides lie one loop within the margin.
    const double inset = window.margin + 2 * radius + line / 2;
    const double left = window.left + inset;
    const double top = window.top + inset;
    const double right = window.left + window.width - inset;
    const double bottom = window.top + window.height - inset;
    const std::array<glm::dvec2, 4> corners = {glm::dvec2(left, top), glm::dvec2(right, top),
                                               glm::dvec2(right, bottom), glm::dvec2(left, bottom)};
    const std::array<glm::dvec2, 4> ways = {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(-1, 0), glm::dvec2(0, -1)};
    const double handle = 0.5522847498307936 * radius;  // of a quarter of a circle as a Bézier

    const glm::dmat2x2 back = glm::inverse(glm::dmat2x2(placement.to_page[0], placement.to_page[1]));
    const auto drawn = [&](glm::dvec2 point) { return back * (point - placement.to_page[2]); };
    const auto pen_of = [&](double millimetres, int of_colour) {
        const StrokeWidth& stroke = print.style.stroke;
        return Pen{millimetres / (stroke.in_steps ? placement.step : 1.0) / stroke.unit, true, of_colour};
    };
    const auto line_to = [&](glm::dvec2 point) {
        const std::array<glm::dvec2, 1> end = {drawn(point)};
        sink.lines(end);
    };
    const Pen earth = pen_of(line * earth_share, colour + 1);
    for (const Pen& pen : {pen_of(line, colour), earth}) {
        // A pen plotter does not paint over.
        if (print.is_plot && pen != earth) continue;
        sink.begin_stroke(drawn(corners[0] + radius * ways[0]), pen);
        for (std::size_t side = 0; side < 4; ++side) {
            const glm::dvec2 along = ways[side];
            const glm::dvec2 out = ways[(side + 3) % 4];
            const glm::dvec2 corner = corners[(side + 1) % 4];
            line_to(corner + radius * along);
            // Three quarters around the dot, then down the next side.
            const glm::dvec2 centre = corner + radius * (along + out);
            std::array<glm::dvec2, 9> loop;
            glm::dvec2 from = -out;
            glm::dvec2 heading = along;
            for (std::size_t i = 0; i < 9; i += 3) {
                loop[i] = drawn(centre + radius * from + handle * heading);
                loop[i + 1] = drawn(centre + radius * heading + handle * from);
                loop[i + 2] = drawn(centre + radius * heading);
                from = std::exchange(heading, -from);
            }
            sink.curves(loop);
            line_to(corner - radius * out);
        }
        sink.end_stroke(true);
    }
    for (std::size_t side = 0; side < 4; ++side) {
        const glm::dvec2 centre = corners[side] - radius * (ways[side] + ways[(side + 1) % 4]);
        sink.disc(drawn(centre), radius * dot_share / placement.step, earth);
    }
}

}  // namespace sikku
