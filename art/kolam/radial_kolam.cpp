#include "art/kolam/radial_kolam.h"

#include "art/kolam/turtle_walk.h"
#include "art/print/ornaments.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/language/unit_vector.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
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

glm::dvec2 polar(double angle, double radius) {
    return radius * unit_vector(angle * 180 / std::numbers::pi);
}
double angle_of(const RadialKolam& kolam, double arm) {
    return std::numbers::pi / 2 - 2 * std::numbers::pi * arm / kolam.arms;
}
glm::dvec2 place_of(const RadialKolam& kolam, std::uint32_t arm, std::uint32_t dot) {
    return polar(angle_of(kolam, arm), dot);
}

/// Number of spans of the spline from one arm to the next.
constexpr std::size_t spans = 4;

/// The dot that a line visits on its k-th arm.
std::uint32_t dot_of(const RadialKolam& kolam, std::uint32_t line, std::size_t k) {
    return kolam.order[(line + k) % kolam.dots()];
}

/// Growth of the distance from the centre at the k-th dot of a line, from one arm to the next: 0 where the line turns
/// back, otherwise the harmonic mean of the differences to the dots before and after, so that the distance grows or
/// shrinks steadily. Source: Fritsch & Butland, A method for constructing local monotone piecewise cubic
/// interpolants, SIAM Journal on Scientific and Statistical Computing 5 (1984).
double slope_at(const RadialKolam& kolam, std::uint32_t line, std::size_t k) {
    const double dot = dot_of(kolam, line, k);
    const double in = dot - dot_of(kolam, line, k + kolam.dots() - 1), out = dot_of(kolam, line, k + 1) - dot;
    return in * out > 0 ? 2 * in * out / (in + out) : 0;
}

/// Change of that growth at the k-th dot: the mean of the second derivatives of the cubics before and after it.
double bend_at(const RadialKolam& kolam, std::uint32_t line, std::size_t k) {
    const std::size_t previous = k + kolam.dots() - 1;
    const double dot = dot_of(kolam, line, k), before = dot_of(kolam, line, previous),
                 after = dot_of(kolam, line, k + 1);
    return 3 * (before + after - 2 * dot) + slope_at(kolam, line, previous) - slope_at(kolam, line, k + 1);
}

/// The distance from the centre between two dots as a polynomial of degree 5 of the share of the way.
std::array<double, 6> distance_between(const RadialKolam& kolam, std::uint32_t line, std::size_t k) {
    const double from = dot_of(kolam, line, k), to = dot_of(kolam, line, k + 1);
    const double slope = slope_at(kolam, line, k), bend = bend_at(kolam, line, k);
    // Differences at the end that the first three terms leave.
    const double rest = to - from - slope - bend / 2, slope_rest = slope_at(kolam, line, k + 1) - slope - bend,
                 bend_rest = bend_at(kolam, line, k + 1) - bend;
    return {from,
            slope,
            bend / 2,
            10 * rest - 4 * slope_rest + bend_rest / 2,
            -15 * rest + 7 * slope_rest - bend_rest,
            6 * rest - 3 * slope_rest + bend_rest / 2};
}

/// Places along a line, `spans` from one arm to the next. Curvature has no jumps.
std::vector<glm::dvec2> places_along(const RadialKolam& kolam, std::uint32_t line, std::size_t length) {
    std::vector<glm::dvec2> places;
    for (std::size_t k = 0; k < length; ++k) {
        const std::array<double, 6> terms = distance_between(kolam, line, k);
        for (std::size_t i = 0; i < spans; ++i) {
            const double share = static_cast<double>(i) / spans;
            double radius = 0;
            for (std::size_t term = terms.size(); term-- > 0;) radius = radius * share + terms[term];
            places.push_back(polar(angle_of(kolam, static_cast<double>(k % kolam.arms) + share), radius));
        }
    }
    return places;
}

/// Unit normal of a line at a dot of an arm. @param slope  growth of its distance from the centre
glm::dvec2 normal_at(const RadialKolam& kolam, std::uint32_t arm, double radius, double slope) {
    const glm::dvec2 outwards = polar(angle_of(kolam, arm), 1.0), clockwise(outwards.y, -outwards.x);
    const glm::dvec2 along = slope * outwards + 2 * std::numbers::pi * radius / kolam.arms * clockwise;
    return glm::dvec2(-along.y, along.x) / glm::length(along);
}

/// The control points of a closed uniform cubic B-spline along a line. It passes through each dot at a knot, in the
/// direction of the places; elsewhere it is their quasi-interpolant, which differs from them in the fourth order.
std::vector<glm::dvec2> control_points(const RadialKolam& kolam, std::uint32_t line, std::size_t length) {
    const std::vector<glm::dvec2> places = places_along(kolam, line, length);
    const std::size_t count = places.size();
    const auto before = [count](std::size_t i) { return (i + count - 1) % count; };
    std::vector<glm::dvec2> controls(count);
    for (std::size_t i = 0; i < count; ++i) {
        controls[i] = (8.0 * places[i] - places[before(i)] - places[(i + 1) % count]) / 6.0;
    }
    for (std::size_t k = 0; k < length; ++k) {
        const auto arm = static_cast<std::uint32_t>(k % kolam.arms);
        const std::uint32_t dot = dot_of(kolam, line, k);
        const glm::dvec2 normal = normal_at(kolam, arm, dot, slope_at(kolam, line, k));
        glm::dvec2& last = controls[before(k * spans)];
        glm::dvec2& next = controls[k * spans + 1];
        // The tangent at a knot is the difference of the controls on either side.
        const double lean = glm::dot(next - last, normal) / 2;
        last += lean * normal;
        next -= lean * normal;
        controls[k * spans] = (6.0 * place_of(kolam, arm, dot) - last - next) / 4.0;
    }
    return controls;
}

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

KolamPatternOptions describe_radial_kolam(const RadialKolam& kolam) {
    KolamPatternOptions pattern;
    pattern.title = fmt::format("Radial kolam of {} arms with {}", kolam.arms, counted(kolam.dots(), "dot"));
    pattern.description = fmt::format("{}, the greatest common divisor of {} and {}; dots in the order {}",
                                      counted(kolam.lines(), "line"), kolam.arms, kolam.dots(),
                                      printable(fmt::format("{}", fmt::join(kolam.order, "-")), 80));
    return pattern;
}

KolamPattern radial_pattern(const RadialKolam& kolam, const KolamPatternOptions& options) {
    KolamPattern pattern;
    pattern.lines = kolam.lines();
    std::string& text = pattern.text;
    text += kolam_head(options);
    text += "\nderivation length: 0\nheading: 90\naxiom: ";
    const std::uint32_t line_colours = options.coloured ? colour_count : 1;
    const std::string pen_up = fmt::format(";({})", line_colours);
    TurtleWalk walker(text, glm::dvec2(0.0), 90);
    walker.put(pen_up);
    Pulse pulse(options.monitor);
    const std::size_t length = std::size_t{kolam.arms} * kolam.dots() / pattern.lines;
    for (std::uint32_t line = 0; line < pattern.lines; ++line) {
        const std::vector<glm::dvec2> controls = control_points(kolam, line, length);
        walker.move(controls[0], 'f');
        walker.put(fmt::format("[;({})", line % line_colours));
        TurtleWalk along = walker;
        for (std::size_t k = 1; k <= controls.size(); ++k) {
            pulse();
            along.move(controls[k % controls.size()], 'F');
        }
        walker.put("]");
    }
    // Dots that are not drawn are marked, since lines of radial kolams do not show where their dots are.
    const std::string dot_symbol = fmt::format("[;({})@.]", options.dot_symbols ? 0 : line_colours);
    const auto mark = [&](glm::dvec2 place) {
        pulse();
        walker.move(place, 'f');
        walker.put(dot_symbol);
    };
    mark({0.0, 0.0});
    for (std::uint32_t arm = 0; arm < kolam.arms; ++arm) {
        for (std::uint32_t dot = 1; dot <= kolam.dots(); ++dot) {
            pattern.dots.push_back(place_of(kolam, arm, dot));
            mark(pattern.dots.back());
        }
    }
    text += fmt::format("\n\nground: #7d3324\nline: spline\nstroke: 0.12 step {}\npalette: {} transparent\n", rice,
                        options.coloured ? kolam_colours : rice);
    return pattern;
}

}  // namespace sikku
