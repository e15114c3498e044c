#include "art/kolam/radial_kolam.h"

#include "art/print/ornaments.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

namespace sikku {
namespace {

std::vector<std::uint32_t> numbers(std::string_view text, char separator) {
    std::vector<std::uint32_t> found;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        std::uint32_t number = 0;
        const auto [rest, error] = std::from_chars(text.data() + at, text.data() + end, number);
        if (error != std::errc() || rest != text.data() + end || number == 0) return {};
        found.push_back(number);
        at = end + 1;
    }
    return found;
}

std::vector<std::uint32_t> odd_then_even(std::uint32_t dots) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t dot = 1; dot <= dots; dot += 2) order.push_back(dot);
    for (std::uint32_t dot = 2; dot <= dots; dot += 2) order.push_back(dot);
    return order;
}

glm::dvec2 place_of(const RadialKolam& kolam, std::uint32_t arm, std::uint32_t dot) {
    const double angle = std::numbers::pi / 2 - 2 * std::numbers::pi * arm / kolam.arms;
    return static_cast<double>(dot) * glm::dvec2(std::cos(angle), std::sin(angle));
}

/// The control points of the closed uniform cubic B-spline that passes through those points at its knots: the
/// solution of (c[i-1] + 4 c[i] + c[i+1]) / 6 = p[i], by iteration, which halves the error each time.
std::vector<glm::dvec2> control_points(const std::vector<glm::dvec2>& points) {
    const std::size_t count = points.size();
    std::vector<glm::dvec2> controls = points;
    std::vector<glm::dvec2> next(count);
    for (int i = 0; i < 60; ++i) {
        for (std::size_t k = 0; k < count; ++k) {
            next[k] = (6.0 * points[k] - controls[(k + count - 1) % count] - controls[(k + 1) % count]) / 4.0;
        }
        controls.swap(next);
    }
    return controls;
}

/// Walks to places with a turtle that knows its heading, in steps with ten decimals.
class Walker {
public:
    explicit Walker(std::string& text) : text_(text) {}

    void put(std::string_view symbols) {
        if (text_.size() - text_.rfind('\n') + symbols.size() > 109) text_ += " \\\n    ";
        text_ += symbols;
    }
    void move(glm::dvec2 to, char symbol) {
        const glm::dvec2 way = to - at_;
        const double length = rounded(std::hypot(way.x, way.y));
        if (length == 0) return;
        const double direction = std::atan2(way.y, way.x) * 180 / std::numbers::pi;
        const double turn = rounded(std::remainder(direction - heading_, 360.0));
        put(fmt::format("{}({:.10f}){}({:.10f})", turn < 0 ? '+' : '-', std::fabs(turn), symbol, length));
        // The place where the turtle is, which differs from `to` by what was rounded.
        heading_ += turn;
        const double radians = heading_ * std::numbers::pi / 180;
        at_ += length * glm::dvec2(std::cos(radians), std::sin(radians));
    }

private:
    static double rounded(double value) { return std::round(value * 1e10) / 1e10; }

    std::string& text_;
    glm::dvec2 at_{0.0};
    double heading_ = 90.0;
};

constexpr std::uint32_t colour_count = 8;

}  // namespace

std::uint32_t RadialKolam::lines() const {
    return std::gcd(arms, dots());
}

RadialKolam parse_radial_kolam(std::string_view size, std::string_view order) {
    std::string text = lower_case(size);
    if (const std::size_t at = text.find("×"); at != std::string::npos) {
        text.erase(at, 1);
        text[at] = 'x';
    }
    const std::vector<std::uint32_t> sides = numbers(text, 'x');
    if (sides.size() != 2 || sides[0] < 2) {
        throw std::runtime_error(
            fmt::format("'{}': expected ARMSxDOTS such as 8x5, 2 arms or more", printable(size, 80)));
    }
    if (std::uint64_t{sides[0]} * sides[1] > RadialKolam::most_dots) {
        throw std::runtime_error(fmt::format("a radial kolam has at most {} dots", RadialKolam::most_dots));
    }
    RadialKolam kolam{sides[0], order.empty() ? odd_then_even(sides[1]) : numbers(order, '-')};
    std::vector<std::uint32_t> sorted = kolam.order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> each(sides[1]);
    std::iota(each.begin(), each.end(), 1U);
    if (sorted != each) {
        throw std::runtime_error(
            fmt::format("order '{}': expected each dot of an arm once, 1 to {}, such as {}", printable(order, 80),
                        sides[1], printable(fmt::format("{}", fmt::join(odd_then_even(sides[1]), "-")), 80)));
    }
    return kolam;
}

KolamPattern radial_pattern(const RadialKolam& kolam, const KolamPatternOptions& options) {
    KolamPattern pattern;
    pattern.lines = kolam.lines();
    std::string& text = pattern.text;
    if (!options.title.empty()) text += fmt::format("title: {}\n", options.title);
    if (!options.description.empty()) text += fmt::format("description: {}\n", options.description);
    text += "\nderivation length: 0\nheading: 90\naxiom: ";
    const std::uint32_t line_colours = options.coloured ? colour_count : 1;
    const std::string pen_up = fmt::format(";({})", line_colours);
    Walker walker(text);
    walker.put(pen_up);
    Pulse pulse(options.monitor);
    const std::size_t length = std::size_t{kolam.arms} * kolam.dots() / pattern.lines;
    for (std::uint32_t line = 0; line < pattern.lines; ++line) {
        std::vector<glm::dvec2> points;
        for (std::size_t k = 0; k < length; ++k) {
            points.push_back(
                place_of(kolam, static_cast<std::uint32_t>(k % kolam.arms), kolam.order[(line + k) % kolam.dots()]));
        }
        const std::vector<glm::dvec2> controls = control_points(points);
        walker.move(controls[0], 'f');
        walker.put(fmt::format("[;({})", line % line_colours));
        Walker along = walker;
        for (std::size_t k = 1; k <= length; ++k) {
            pulse();
            along.move(controls[k % length], 'F');
        }
        walker.put("]");
    }
    if (options.dot_symbols) {
        walker.move({0.0, 0.0}, 'f');
        walker.put("[;(0)@.]");
    }
    for (std::uint32_t arm = 0; arm < kolam.arms; ++arm) {
        for (std::uint32_t dot = 1; dot <= kolam.dots(); ++dot) {
            pattern.dots.push_back(place_of(kolam, arm, dot));
            if (!options.dot_symbols) continue;
            pulse();
            walker.move(pattern.dots.back(), 'f');
            walker.put("[;(0)@.]");
        }
    }
    text += fmt::format("\n\nground: #7d3324\nline: spline\nstroke: 0.12 step {}\npalette: {} transparent\n", rice,
                        options.coloured ? kolam_colours : rice);
    return pattern;
}

}  // namespace sikku
