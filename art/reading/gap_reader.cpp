#include "art/reading/gap_reader.h"

#include "art/kolam/interlaced_composition.h"
#include "art/kolam/rounded_lines.h"
#include "engine/base/threads.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sikku {
namespace {

using Curve = std::vector<glm::dvec2>;

/// Half the widths of lines, in spacings.
constexpr std::array<double, 7> half_widths = {0.026, 0.036, 0.046, 0.058, 0.072, 0.09, 0.11};

/// Places around the middle of a gap: x along the gap, y to its side, in spacings.
struct GapWindow {
    std::vector<glm::dvec2> places;
    double height;  ///< from the gap to the middle of a face
    explicit GapWindow(DotLattice lattice, double dot_radius)
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

/// The strands around a gap of a drawn kolam, with x along the gap.
Shape drawn_shape(const DotGrid& grid, std::uint32_t number, GapState state, const std::vector<Curve>& lines) {
    constexpr double reach = 0.75;
    const GridGap& gap = grid.gaps()[number];
    const glm::dvec2 from = dot_place(grid, gap.from), along = dot_place(grid, gap.to) - from;
    Shape shape{state, {}, state == GapState::turned ? 0.14 : 1e300};
    for (const Curve& line : lines) {
        bool continues = false;
        for (const glm::dvec2 point : line) {
            const glm::dvec2 way = point - from - 0.5 * along;
            const glm::dvec2 place(glm::dot(way, along), along.x * way.y - along.y * way.x);
            const bool is_near = glm::length(place) < reach;
            if (is_near && !continues) shape.strands.emplace_back();
            if (is_near) shape.strands.back().push_back(place);
            continues = is_near;
        }
    }
    std::erase_if(shape.strands, [](const Curve& strand) { return strand.size() < 2; });
    return shape;
}

double distance_to(const Curve& curve, glm::dvec2 point) {
    double least = 1e300;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const glm::dvec2 way = curve[i] - curve[i - 1];
        const double along =
            std::clamp(glm::dot(point - curve[i - 1], way) / std::max(glm::dot(way, way), 1e-12), 0.0, 1.0);
        const glm::dvec2 off = curve[i - 1] + along * way - point;
        least = std::min(least, glm::dot(off, off));
    }
    return std::sqrt(least);
}

/// Distances of the places of a window from the strands of a shape that is displaced.
std::vector<float> distances_of(const Shape& shape, const GapWindow& window, glm::dvec2 displacement) {
    std::vector<float> distances;
    distances.reserve(window.places.size());
    for (const glm::dvec2 place : window.places) {
        double least = 1e300;
        for (const Curve& strand : shape.strands) {
            least = std::min(least, distance_to(strand, place - displacement));
        }
        distances.push_back(static_cast<float>(least));
    }
    return distances;
}

/// Leaves out shapes that differ little from one before, as the mirror images of symmetric gaps do.
std::vector<Shape> distinct(std::vector<Shape> shapes) {
    constexpr float little = 0.01F;  // spacings, less than lines are wide
    const GapWindow window(DotLattice::triangular, 0.053);
    std::vector<std::pair<GapState, std::vector<float>>> kept;
    std::erase_if(shapes, [&](const Shape& shape) {
        std::vector<float> distances = distances_of(shape, window, glm::dvec2(0.0));
        const bool is_known = std::any_of(kept.begin(), kept.end(), [&](const auto& other) {
            return other.first == shape.state &&
                   std::equal(distances.begin(), distances.end(), other.second.begin(),
                              [](float a, float b) { return std::fabs(a - b) < little; });
        });
        if (!is_known) kept.emplace_back(shape.state, std::move(distances));
        return is_known;
    });
    return shapes;
}

/// Rounded lines run through a gap as the gaps around it permit: the strands in the gaps of some kolams.
std::vector<Shape> drawn_rounded_shapes() {
    std::vector<Shape> shapes;
    const DotGrid grid = parse_dot_grid("9-5 idukku");
    const Monitor monitor;
    Pulse pulse(monitor);
    for (const std::uint64_t seed : {2, 4}) {
        const GapStates states = composed_states(grid, GridSymmetry::d6, seed);
        const KolamRim rim(grid, states, RimStyle::round);
        std::vector<Curve> lines;
        for (const ArcStep& start : line_starts(grid, states)) {
            const Curve controls = rounded_line(grid, states, start, rim, pulse);
            const std::size_t count = controls.size();
            Curve& line = lines.emplace_back();
            for (std::size_t i = 0; i <= count; ++i) {
                const glm::dvec2 a = controls[i % count], b = controls[(i + 1) % count],
                                 c = controls[(i + 2) % count];
                line.push_back((a + 4.0 * b + c) / 6.0);
                line.push_back((a + 23.0 * b + 23.0 * c + controls[(i + 3) % count]) / 48.0);
            }
        }
        const std::vector<std::uint32_t> orbits = gap_orbits(grid, GridSymmetry::d6);
        std::uint32_t next = 0;
        for (std::uint32_t gap = 0; gap < orbits.size(); ++gap) {
            if (orbits[gap] != next) continue;
            ++next;
            const Shape shape = drawn_shape(grid, gap, states[gap], lines);
            for (const glm::dvec2 mirror :
                 {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)}) {
                Shape& image = shapes.emplace_back(shape);
                for (Curve& strand : image.strands) {
                    for (glm::dvec2& point : strand) point *= mirror;
                }
            }
        }
    }
    return distinct(std::move(shapes));
}

/// The same for all pictures and sizes of dots, and made once.
const std::vector<Shape>& rounded_shapes() {
    static const std::vector<Shape> shapes = drawn_rounded_shapes();
    return shapes;
}

std::vector<Shape> shapes_of(DotLattice lattice, double height) {
    std::vector<Shape> shapes;
    // The points where strands enter the rhombus: the middles of the chords from one side of a dot to the next.
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
    if (lattice == DotLattice::triangular)
        shapes.insert(shapes.end(), rounded_shapes().begin(), rounded_shapes().end());
    return shapes;
}

/// A shape as ink at the places of a window, with a mean of 0 and a length of 1.
struct GapTemplate {
    GapState state;
    std::vector<float> values;
};

/// A shape that is displaced a little, as distances of the places of a window from its strands.
struct Placed {
    GapState state;
    double apart;
    bool is_central;  ///< not displaced
    std::vector<float> distances;
};

/// Number of displacements of a shape, of which the fifth is zero.
constexpr std::size_t displacements = 9;

/// All shapes, each with its displacements in turn.
std::vector<Placed> placed_shapes(const std::vector<Shape>& shapes, const GapWindow& window, const Monitor& monitor) {
    std::vector<Placed> all(displacements * shapes.size());
    for_each_index(shapes.size(), [&](std::size_t number) {
        monitor.check();
        const Shape& shape = shapes[number];
        const double along = shape.state == GapState::turned ? 0.012 : 0.035;
        const double aside = shape.state == GapState::joined ? 0.012 : 0.035;
        Placed* next = &all[displacements * number];
        for (const double dy : {-aside, 0.0, aside}) {
            for (const double dx : {-along, 0.0, along}) {
                *next++ = {shape.state, shape.apart, dx == 0 && dy == 0, distances_of(shape, window, {dx, dy})};
            }
        }
    });
    return all;
}

/// Ink at the places of a window.
std::vector<float> drawn_values(const Placed& shape, double half_width) {
    std::vector<float> values;
    values.reserve(shape.distances.size());
    for (const float distance : shape.distances) {
        const auto off = distance / static_cast<float>(half_width);
        values.push_back(off > 4 ? 0.0F : std::exp(-0.7F * off * off));
    }
    return values;
}

/// Information about the state in each place of a window: the variance between the means of the states. Returns its
/// root, as both factors of a product are weighted. Without weights the strands common to all states would decide.
std::vector<float> weights_of(const std::vector<Placed>& shapes, double half_width) {
    const std::size_t count = shapes[0].distances.size();
    std::array<std::vector<double>, 3> means;
    std::array<double, 3> shapes_of_state{};
    for (auto& mean : means) mean.resize(count);
    for (const Placed& shape : shapes) {
        if (!shape.is_central) continue;
        const auto state = static_cast<std::size_t>(shape.state);
        const std::vector<float> values = drawn_values(shape, half_width);
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

/// Shapes of one width, each with its displacements in turn.
struct TemplateSet {
    std::vector<float> weights;
    std::vector<GapTemplate> templates;
};

TemplateSet templates_of(const std::vector<Placed>& shapes, double least_apart, double half_width) {
    TemplateSet set{weights_of(shapes, half_width), {}};
    for (const Placed& shape : shapes) {
        // Strands that do not cross leave ground between them.
        if (shape.apart < least_apart * half_width) continue;
        GapTemplate drawn{shape.state, drawn_values(shape, half_width)};
        normalise(drawn.values, set.weights);
        set.templates.push_back(std::move(drawn));
    }
    return set;
}

/// The ink at the places of a window around a gap. Deviations of the lattice are those of its corners.
std::vector<float> patch(const GreyPicture& ink, const LatticeMap& map, const GapWindow& window, glm::dvec2 from,
                         glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const glm::dvec2 aside(-along.y, along.x);
    const glm::dvec2 middle = 0.5 * (from + to);
    // Within a spacing, the map is nearly linear on each side of the middle.
    const glm::dvec2 here = map(middle);
    const glm::dvec2 before = 2.0 * (map(from) - here);
    const glm::dvec2 after = 2.0 * (map(to) - here);
    const glm::dvec2 below = (map(middle - window.height * aside) - here) / window.height;
    const glm::dvec2 above = (map(middle + window.height * aside) - here) / window.height;
    std::vector<float> values;
    values.reserve(window.places.size());
    for (const glm::dvec2 place : window.places) {
        const glm::dvec2 at = here + std::fabs(place.x) * (place.x < 0 ? before : after) +
                              std::fabs(place.y) * (place.y < 0 ? below : above);
        values.push_back(std::clamp(ink.at(at), -1.5F, 2.5F));
    }
    return values;
}

/// The sum of products; several at a time, which the compiler turns into vectors.
double product(const std::vector<float>& a, const std::vector<float>& b) {
    constexpr std::size_t lanes = 16;
    std::array<float, lanes> sums{};
    std::size_t i = 0;
    for (; i + lanes <= a.size(); i += lanes) {
        for (std::size_t k = 0; k < lanes; ++k) sums[k] += a[i + k] * b[i + k];
    }
    float sum = 0;
    for (const float part : sums) sum += part;
    for (; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

GapEvidence compare(std::vector<float> patch, const TemplateSet& set) {
    normalise(patch, set.weights);
    GapEvidence evidence;
    evidence.agreement.fill(-1);
    // The best two shapes of each state without displacement; then these displaced.
    struct Best {
        double sum = -1;
        std::size_t shape = 0;
    };
    std::array<std::array<Best, 2>, 3> best;
    for (std::size_t shape = 0; shape < set.templates.size(); shape += displacements) {
        const GapTemplate& central = set.templates[shape + displacements / 2];
        const double sum = product(patch, central.values);
        auto& [first, second] = best[static_cast<std::size_t>(central.state)];
        if (sum > first.sum) {
            second = first;
            first = {sum, shape};
        } else if (sum > second.sum) {
            second = {sum, shape};
        }
    }
    for (std::size_t state = 0; state < 3; ++state) {
        for (const Best& each : best[state]) {
            if (each.sum <= -1) continue;
            for (std::size_t i = 0; i < displacements; ++i) {
                const double sum = product(patch, set.templates[each.shape + i].values);
                evidence.agreement[state] = std::max(evidence.agreement[state], sum);
            }
        }
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

struct GapTemplates::Set {
    GapWindow window;
    std::array<TemplateSet, half_widths.size()> widths;

    Set(DotLattice lattice, double radius, const Monitor& monitor) : window(lattice, radius) {
        const std::vector<Placed> shapes = placed_shapes(shapes_of(lattice, window.height), window, monitor);
        // Interlaced dots leave less room.
        const double least_apart = lattice == DotLattice::square ? 1.5 : 1.25;
        for_each_index(half_widths.size(), [&](std::size_t i) {
            monitor.check();
            widths[i] = templates_of(shapes, least_apart, half_widths[i]);
        });
    }
};

GapTemplates::GapTemplates() = default;
GapTemplates::~GapTemplates() = default;

GapReader::GapReader(const GreyPicture& ink, const DotGrid& grid, const LatticeMap& map, double dot_radius,
                     GapTemplates& templates, const Monitor& monitor)
    : ink_(ink), set_([&]() -> const GapTemplates::Set& {
          const int radius = static_cast<int>(std::lround(75 * std::clamp(dot_radius, 0.053, 0.133))) * 2;
          auto& set = templates.sets_[{grid.lattice(), radius}];
          if (!set) set = std::make_unique<GapTemplates::Set>(grid.lattice(), 0.01 * radius, monitor);
          return *set;
      }()) {
    const std::size_t stride = std::max<std::size_t>(1, grid.gaps().size() / 60);
    std::vector<std::vector<float>> patches;
    for (std::size_t i = 0; i < grid.gaps().size(); i += stride) {
        const GridGap& gap = grid.gaps()[i];
        patches.push_back(patch(ink, map, set_.window, lattice_point(grid.lattice(), grid.dots()[gap.from]),
                                lattice_point(grid.lattice(), grid.dots()[gap.to])));
    }
    std::array<double, half_widths.size()> sums{};
    for_each_index(half_widths.size(), [&](std::size_t i) {
        monitor.check();
        for (const std::vector<float>& seen : patches) {
            const GapEvidence found = compare(seen, set_.widths[i]);
            sums[i] += found.agreement[static_cast<std::size_t>(found.best())];
        }
    });
    width_ = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
}

GapEvidence GapReader::read(const LatticeMap& map, GridDot from, GridDot to, glm::dvec2 offset) const {
    const DotLattice lattice = map.lattice();
    return compare(
        patch(ink_, map, set_.window, lattice_point(lattice, from) + offset, lattice_point(lattice, to) + offset),
        set_.widths[width_]);
}

}  // namespace sikku
