#include "art/drawing/census.h"

#include "art/drawing/extent_sink.h"
#include "art/space/scene.h"
#include "art/space/solids.h"
#include "art/space/tessellation.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/word_size.h"
#include "engine/geometry/turtle.h"
#include "engine/language/surface.h"
#include "engine/measure/fold.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>

namespace sikku {
namespace {

/// Counts the strokes of a drawing in the plane.
class CountingSink : public PathSink {
public:
    CountingSink(const Style& style, const glm::dmat3x2& orientation, DrawnCensus& census)
        : style_(style), extent_(style, orientation), census_(census) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at_ = start;
        change_pen(pen);
        ++census_.strokes;
        extent_.begin_stroke(start, pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        double length = 0;
        for (const glm::dvec2 end : ends) {
            length += glm::length(end - at_);
            at_ = end;
        }
        if (draws_) {
            census_.lines += static_cast<double>(ends.size());
            census_.length += length;
            census_.mean_width += length * width_;
        }
        extent_.lines(ends);
    }
    void curves(std::span<const glm::dvec2> controls) override { lines(controls); }
    void change_pen(const Pen& pen) override {
        draws_ = style_.draws(pen);
        width_ = style_.pen_width(pen);
        extent_.change_pen(pen);
    }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        double twice = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::dvec2 a = vertices[i], b = vertices[(i + 1) % vertices.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        ++census_.polygons;
        census_.corners += static_cast<double>(vertices.size());
        census_.area += std::fabs(twice) / 2;
        extent_.polygon(vertices, pen);
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        ++census_.discs;
        census_.area += std::numbers::pi * radius * radius;
        extent_.disc(centre, radius, pen);
    }
    void finish() {
        if (census_.length > 0) census_.mean_width /= census_.length;
        census_.box = extent_.box;
        census_.widest = extent_.widest;
    }

private:
    const Style& style_;
    ExtentSink extent_;
    DrawnCensus& census_;
    glm::dvec2 at_{0.0};
    bool draws_ = true;
    double width_ = 0;
};

double patch_area(const Patch& patch, const glm::mat4x3& map) {
    const auto at = [&](std::size_t row, std::size_t column) {
        return map * glm::vec4(glm::vec3(patch.points[4 * row + column]), 1.0F);
    };
    const glm::vec3 a = at(0, 0), b = at(0, 3), c = at(3, 3), d = at(3, 0);
    return static_cast<double>(glm::length(glm::cross(b - a, d - a)) + glm::length(glm::cross(b - c, d - c))) / 2;
}

void count_scene(const Scene& scene, const Style& style, const glm::dmat3x2& orientation, DrawnCensus& census) {
    const auto width_of = [&](const SceneWidth& width) { return style.pen_width(width.pen(0)); };
    for (const SceneSegment& segment : scene.segments()) {
        const double length = static_cast<double>(glm::length(segment.to - segment.from));
        census.strokes += segment.goes_on ? 0 : 1;
        ++census.lines;
        census.length += length;
        census.mean_width += length * (width_of(segment.before) + width_of(segment.after)) / 2;
    }
    if (census.length > 0) census.mean_width /= census.length;
    for (const ScenePolygon& polygon : scene.polygons()) {
        const auto vertices = scene.vertices(polygon);
        glm::vec3 normal(0.0F);
        for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
            normal += glm::cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
        }
        ++census.polygons;
        census.corners += static_cast<double>(vertices.size());
        census.area += static_cast<double>(glm::length(normal)) / 2;
    }
    for (const SceneSphere& sphere : scene.spheres()) {
        ++census.discs;
        census.area += std::numbers::pi * static_cast<double>(sphere.radius) * static_cast<double>(sphere.radius);
    }
    std::map<int, double> bent;
    for (const SceneSurface& surface : scene.surfaces()) {
        const double bend = bend_of(surface);
        bent[bend > 0 ? static_cast<int>(std::floor(4 * std::log2(bend))) : std::numeric_limits<int>::min()] +=
            static_cast<double>(surface.surface->patches.size());
        census.patches += static_cast<double>(surface.surface->patches.size());
        for (const Patch& patch : surface.surface->patches) census.area += patch_area(patch, surface.map);
    }
    for (const auto& [size, count] : bent) {
        const bool is_flat = size == std::numeric_limits<int>::min();
        census.bent.push_back({is_flat ? 0 : std::exp2((size + 0.5) / 4), count});
    }
    const SceneExtent seen = extent_of(scene, style, orientation);
    census.box = seen.box;
    census.widest = seen.widest;
    const glm::dvec3 size = scene.bounds().high - scene.bounds().low;
    census.deepest = std::max({size.x, size.y, size.z});
}

/// Reads a word; nullopt if it has more than `most` nodes.
std::optional<DrawnCensus> read(const Grammar& grammar, const Style& style, const glm::dmat3x2& orientation,
                                double most) {
    DrawnCensus census;
    census.is_read = true;
    DerivationOptions options;
    options.interpreted = true;
    options.limit_whole_words(most);
    // Words with contexts are short before they are long: keeping them costs more than reading them.
    options.longest_word = options.compared = static_cast<std::uint64_t>(most);
    options.whole_words = 5 * options.longest_word;
    const auto count = [&](std::uint64_t symbols) { census.nodes += static_cast<double>(symbols); };
    options.watch = count;
    try {
        const Grammar resolved = resolve_contexts(grammar, options);
        if (resolved.is_spatial()) {
            count_scene(Scene::of(resolved, style, options, most), style, orientation, census);
        } else {
            CountingSink sink(style, orientation, census);
            derive(resolved, *Turtle::drawing(resolved, sink, style.moves_draw()), options);
            sink.finish();
        }
    } catch (const BudgetError&) {
        return std::nullopt;
    }
    return census;
}

void scale(DrawnCensus& census, double times) {
    for (double* number : {&census.nodes, &census.strokes, &census.lines, &census.length, &census.polygons,
                           &census.corners, &census.discs, &census.patches, &census.area}) {
        *number *= times;
    }
    for (BentPatches& patches : census.bent) patches.count *= times;
    census.is_read = false;
}

/// Makes the box larger about its middle.
void enlarge(DrawnCensus& census, double times) {
    const glm::dvec2 middle = (census.box.low + census.box.high) / 2.0;
    const glm::dvec2 half = (census.box.high - census.box.low) / 2.0 * times;
    if (!census.box.empty()) census.box = {middle - half, middle + half};
    census.deepest *= times;
}

double size_of(const DrawnCensus& census) {
    return census.box.empty() ? 0 : glm::length(census.box.high - census.box.low);
}

/// The census of a longer word by the counts of its symbols.
DrawnCensus by_counts(const Grammar& grammar, const Forecast& known, const Style& style,
                      const glm::dmat3x2& orientation, double most) {
    const std::int64_t steps = largest_affordable(grammar, true, most);
    const auto shorter = grammar.with_steps(std::max<std::int64_t>(0, steps));
    DrawnCensus census;
    const auto drawn_then = shorter ? estimate(*shorter, true) : std::nullopt;
    if (const auto found = steps >= 0 && drawn_then ? read(*shorter, style, orientation, 4 * most) : std::nullopt) {
        census = *found;
        const double then =
            drawn_symbols(grammar, *drawn_then, style.moves_draw()) + label_lines(grammar, *drawn_then);
        const double now = drawn_symbols(grammar, known, style.moves_draw()) + label_lines(grammar, known);
        if (then > 0) scale(census, now / then);
    } else {
        census.strokes = census.lines = census.length = drawn_symbols(grammar, known, style.moves_draw());
        census.mean_width = census.widest = style.pen_width({});
        census.is_read = false;
    }
    census.nodes = known.nodes;
    if (const auto folded = grammar.is_spatial() ? std::nullopt : fold(grammar);
        folded && !folded->ink_hull.empty()) {
        census.box = {};
        for (const glm::dvec2 corner : folded->ink_hull) census.box.add(orientation * glm::dvec3(corner, 1.0));
    }
    return census;
}

/// The census of a word whose length only derivation determines, by the growth of shorter ones.
DrawnCensus by_growth(const Grammar& grammar, const Style& style, const glm::dmat3x2& orientation, double most) {
    std::optional<DrawnCensus> last;
    std::int64_t steps = grammar.steps();
    for (std::int64_t less = 1; !last && steps > 0; less += std::max<std::int64_t>(1, less / 4)) {
        steps = std::max<std::int64_t>(0, grammar.steps() - less);
        if (const auto shorter = grammar.with_steps(steps)) last = read(*shorter, style, orientation, most);
    }
    if (!last) {
        DrawnCensus unknown;
        unknown.nodes = unknown.lines = unknown.strokes = most;
        unknown.mean_width = unknown.widest = style.pen_width({});
        return unknown;
    }
    // Productions may alternate, so growth is measured over several steps.
    const std::int64_t before = std::max<std::int64_t>(0, steps - std::max<std::int64_t>(1, steps / 4));
    const auto shorter = grammar.with_steps(before);
    const auto first = shorter && before < steps ? read(*shorter, style, orientation, most) : std::nullopt;
    if (!first || !(first->nodes > 0)) return *last;
    const auto growth = [&](double early, double late) {
        return extrapolated_growth(before, early, steps, late, grammar.steps());
    };
    scale(*last, growth(first->nodes, last->nodes));
    enlarge(*last, growth(size_of(*first), size_of(*last)));
    return *last;
}

}  // namespace

DrawnCensus drawn_census(const Grammar& grammar, const Style& style, const glm::dmat3x2& orientation, double most) {
    if (const auto known = estimate(grammar, true)) {
        if (known->nodes > most) return by_counts(grammar, *known, style, orientation, most);
        if (const auto found = read(grammar, style, orientation, 4 * most)) {
            DrawnCensus census = *found;
            census.nodes = known->nodes;
            return census;
        }
        return by_counts(grammar, *known, style, orientation, most / 4);
    }
    if (const auto found = read(grammar, style, orientation, most)) return *found;
    return by_growth(grammar, style, orientation, most);
}

}  // namespace sikku
