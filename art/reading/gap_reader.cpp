#include "art/reading/gap_reader.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace sikku {
namespace {

using Curve = std::vector<glm::dvec2>;

/// Places around the middle of a gap: x along the gap, y to its side, in spacings.
struct Window {
    std::vector<glm::dvec2> places;
    double height;  ///< from the gap to the middle of a face
    explicit Window(DotLattice lattice, double dot_radius)
        : height(lattice == DotLattice::square ? 0.5 : 1 / (2 * std::numbers::sqrt3)) {
        constexpr int across = 13;
        for (int j = -across; j <= across; ++j) {
            for (int i = -across; i <= across; ++i) {
                const glm::dvec2 place(0.5 * i / across, height * j / across);
                if (std::fabs(place.x) / 0.5 + std::fabs(place.y) / height > 1.02) continue;
                if (glm::distance(place, {-0.5, 0}) < dot_radius || glm::distance(place, {0.5, 0}) < dot_radius) {
                    continue;
                }
                places.push_back(place);
            }
        }
    }
};

/// Two strands, as they would be drawn.
struct Shape {
    GapState state;
    std::vector<Curve> strands;
    double apart = 1e300;  ///< half the distance of strands that do not cross
};

Curve bend(glm::dvec2 from, glm::dvec2 middle, glm::dvec2 to) {
    // The Bézier curve through `middle`.
    const glm::dvec2 control = 2.0 * middle - 0.5 * (from + to);
    Curve curve;
    for (int i = 0; i <= 12; ++i) {
        const double t = i / 12.0;
        curve.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * control + t * t * to);
    }
    return curve;
}

Curve circle_part(glm::dvec2 centre, double radius, double from, double to) {
    Curve curve;
    for (int i = 0; i <= 12; ++i) {
        const double angle = from + (to - from) * i / 12;
        curve.push_back(centre + radius * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return curve;
}

std::vector<Shape> shapes_of(DotLattice lattice, double height) {
    std::vector<Shape> shapes;
    // Where strands enter the rhombus: the middles of the chords from one side of a dot to the next.
    const glm::dvec2 enter =
        lattice == DotLattice::square ? glm::dvec2(0.25, 0.25) : glm::dvec2(0.125, 0.125 * std::numbers::sqrt3);
    const auto mirrored = [](glm::dvec2 p, double sx, double sy) { return glm::dvec2(sx * p.x, sy * p.y); };
    const glm::dvec2 far = 1.25 * enter;
    for (const double steep : {0.85, 1.0, 1.18}) {
        const glm::dvec2 end(far.x / steep, far.y * steep);
        shapes.push_back(
            {GapState::crossed, {{mirrored(end, -1, -1), end}, {mirrored(end, -1, 1), mirrored(end, 1, -1)}}});
    }
    for (const double apart : {0.08, 0.095, 0.115, 0.14, 0.17, 0.2, 0.24, 0.28}) {
        // Teardrops, and rings.
        shapes.push_back({GapState::turned,
                          {bend(mirrored(enter, -1, 1), {-apart, 0}, mirrored(enter, -1, -1)),
                           bend(enter, {apart, 0}, mirrored(enter, 1, -1))},
                          apart});
        const double ring = 0.5 - apart;
        const double angle = 0.3 * std::numbers::pi;
        shapes.push_back({GapState::turned,
                          {circle_part({-0.5, 0}, ring, -angle, angle),
                           circle_part({0.5, 0}, ring, std::numbers::pi - angle, std::numbers::pi + angle)},
                          apart});
    }
    for (const double part : {0.27, 0.36, 0.45, 0.54, 0.64}) {
        const double apart = part * height;
        if (lattice == DotLattice::triangular && part < 0.4) continue;
        shapes.push_back({GapState::joined,
                          {bend(mirrored(enter, -1, 1), {0, apart}, enter),
                           bend(mirrored(enter, -1, -1), {0, -apart}, mirrored(enter, 1, -1))},
                          apart});
        if (part > 0.35) {
            shapes.push_back(
                {GapState::joined, {{{-0.4, apart}, {0.4, apart}}, {{-0.4, -apart}, {0.4, -apart}}}, apart});
        }
    }
    return shapes;
}

double distance_to(const Curve& curve, glm::dvec2 point) {
    double least = 1e300;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const glm::dvec2 way = curve[i] - curve[i - 1];
        const double along =
            std::clamp(glm::dot(point - curve[i - 1], way) / std::max(glm::dot(way, way), 1e-12), 0.0, 1.0);
        least = std::min(least, glm::distance(point, curve[i - 1] + along * way));
    }
    return least;
}

/// A shape as ink at the places of a window, with a mean of 0 and a length of 1.
struct Template {
    GapState state;
    std::vector<float> values;
};

/// Values of a shape at the places of a window.
std::vector<float> drawn_values(const Shape& shape, const Window& window, double half_width, glm::dvec2 shift) {
    std::vector<float> values;
    values.reserve(window.places.size());
    for (const glm::dvec2 place : window.places) {
        double least = 1e300;
        for (const Curve& strand : shape.strands) least = std::min(least, distance_to(strand, place - shift));
        const double off = least / half_width;
        values.push_back(static_cast<float>(std::exp(-0.7 * off * off)));
    }
    return values;
}

/// Information about the state in each place of a window: the variance between the means of the states. The root, for
/// both sides of a product. Without it the strands that all states share would decide.
std::vector<float> weights_of(const std::vector<Shape>& shapes, const Window& window, double half_width) {
    const std::size_t count = window.places.size();
    std::array<std::vector<double>, 3> means;
    std::array<double, 3> shapes_of_state{};
    for (auto& mean : means) mean.resize(count);
    for (const Shape& shape : shapes) {
        const auto state = static_cast<std::size_t>(shape.state);
        const std::vector<float> values = drawn_values(shape, window, half_width, glm::dvec2(0.0));
        for (std::size_t i = 0; i < count; ++i) means[state][i] += values[i];
        ++shapes_of_state[state];
    }
    std::vector<float> weights(count);
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = means[0][i] / shapes_of_state[0];
        const double b = means[1][i] / shapes_of_state[1];
        const double c = means[2][i] / shapes_of_state[2];
        const double variance = (a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a);
        weights[i] = static_cast<float>(variance);
        sum += variance;
    }
    const auto floor = static_cast<float>(0.06 * sum / static_cast<double>(count));
    for (float& weight : weights) weight = std::sqrt(weight + floor);
    return weights;
}

/// Values with a weighted mean of 0 and a length of 1, times the roots of the weights.
void normalise(std::vector<float>& values, const std::vector<float>& weights) {
    double sum = 0;
    double all = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double weight = static_cast<double>(weights[i]) * weights[i];
        sum += weight * values[i];
        all += weight;
    }
    const double mean = sum / all;
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = static_cast<float>((values[i] - mean) * weights[i]);
        squares += static_cast<double>(values[i]) * values[i];
    }
    const auto factor = static_cast<float>(1 / std::sqrt(std::max(squares, 1e-12)));
    for (float& value : values) value *= factor;
}

/// Shapes of one width, displaced a little.
struct TemplateSet {
    std::vector<float> weights;
    std::vector<Template> templates;
};

TemplateSet templates_of(const std::vector<Shape>& shapes, const Window& window, double least_apart,
                         double half_width) {
    TemplateSet set{weights_of(shapes, window, half_width), {}};
    for (const Shape& shape : shapes) {
        // Strands that do not cross leave ground between them.
        if (shape.apart < least_apart * half_width) continue;
        const double along = shape.state == GapState::turned ? 0.012 : 0.035;
        const double aside = shape.state == GapState::joined ? 0.012 : 0.035;
        for (const double dy : {-aside, 0.0, aside}) {
            for (const double dx : {-along, 0.0, along}) {
                Template drawn{shape.state, drawn_values(shape, window, half_width, {dx, dy})};
                normalise(drawn.values, set.weights);
                set.templates.push_back(std::move(drawn));
            }
        }
    }
    return set;
}

/// The ink at the places of a window around a gap.
class Patches {
public:
    Patches(const GreyPicture& ink, const DotGrid& grid, const Homography& map, const Window& window)
        : ink_(ink), grid_(grid), map_(map), window_(window) {}
    std::vector<float> patch(const GridGap& gap) const {
        const glm::dvec2 from = lattice_point(grid_.lattice(), grid_.dots()[gap.from]);
        const glm::dvec2 to = lattice_point(grid_.lattice(), grid_.dots()[gap.to]);
        const glm::dvec2 along = to - from;
        const glm::dvec2 aside(-along.y, along.x);
        const glm::dvec2 middle = 0.5 * (from + to);
        std::vector<float> values;
        values.reserve(window_.places.size());
        for (const glm::dvec2 place : window_.places) {
            const float value = ink_.at(map_(middle + place.x * along + place.y * aside));
            values.push_back(std::clamp(value, -1.5F, 2.5F));
        }
        return values;
    }

private:
    const GreyPicture& ink_;
    const DotGrid& grid_;
    const Homography& map_;
    const Window& window_;
};

GapEvidence compare(std::vector<float> patch, const TemplateSet& set) {
    normalise(patch, set.weights);
    GapEvidence evidence;
    evidence.agreement.fill(-1);
    for (const Template& drawn : set.templates) {
        // Several sums at a time, which the compiler turns into vectors.
        std::array<float, 8> sums{};
        std::size_t i = 0;
        for (; i + 8 <= patch.size(); i += 8) {
            for (std::size_t k = 0; k < 8; ++k) sums[k] += patch[i + k] * drawn.values[i + k];
        }
        float sum = 0;
        for (const float part : sums) sum += part;
        for (; i < patch.size(); ++i) sum += patch[i] * drawn.values[i];
        double& best = evidence.agreement[static_cast<std::size_t>(drawn.state)];
        best = std::max(best, static_cast<double>(sum));
    }
    return evidence;
}

}  // namespace

GapState GapEvidence::best() const {
    return static_cast<GapState>(std::max_element(agreement.begin(), agreement.end()) - agreement.begin());
}

double GapEvidence::margin() const {
    std::array<double, 3> sorted = agreement;
    std::sort(sorted.begin(), sorted.end());
    return sorted[2] - sorted[1];
}

std::vector<GapEvidence> read_gap_evidence(const GreyPicture& ink, const DotGrid& grid, const Homography& map,
                                           double dot_radius, const Monitor& monitor) {
    std::vector<GapEvidence> evidence(grid.gaps().size());
    if (evidence.empty()) return evidence;
    const Window window(grid.lattice(), std::clamp(1.5 * dot_radius, 0.08, 0.2));
    const std::vector<Shape> shapes = shapes_of(grid.lattice(), window.height);
    const Patches patches(ink, grid, map, window);
    // Interlaced dots leave less room.
    const double least_apart = grid.lattice() == DotLattice::square ? 1.5 : 1.25;
    // Width of the lines: the one that fits best over some of the gaps.
    TemplateSet best;
    double most = -1e300;
    const std::size_t stride = std::max<std::size_t>(1, grid.gaps().size() / 60);
    for (const double half_width : {0.026, 0.036, 0.046, 0.058, 0.072}) {
        monitor.check();
        TemplateSet templates = templates_of(shapes, window, least_apart, half_width);
        double sum = 0;
        for (std::size_t i = 0; i < grid.gaps().size(); i += stride) {
            const GapEvidence found = compare(patches.patch(grid.gaps()[i]), templates);
            sum += found.agreement[static_cast<std::size_t>(found.best())];
        }
        if (sum > most) {
            most = sum;
            best = std::move(templates);
        }
    }
    for (std::size_t i = 0; i < evidence.size(); ++i) {
        monitor.check();
        evidence[i] = compare(patches.patch(grid.gaps()[i]), best);
    }
    return evidence;
}

}  // namespace sikku
