#include "art/space/scene.h"

#include "art/space/triangles.h"
#include "art/style/camera.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/lettering.h"
#include "engine/language/surface.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace sikku {

/// Draws the letters of a label as stems, upright before an eye.
class LetterStems : public WithoutStrokes<PathSink> {
public:
    LetterStems(SpaceSink& sink, const Projection& eye, const glm::dvec3& centre, double height)
        : sink_(sink),
          right_(eye.turned_back({1, 0, 0})),
          up_(eye.turned_back({0, 1, 0})),
          centre_(centre),
          tolerance_(height / 200) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at_ = start;
        pen_ = pen;
        is_joined_ = false;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            sink_.segment(placed(at_), pen_, placed(end), pen_, is_joined_);
            at_ = end;
            is_joined_ = true;
        }
    }
    void curves(std::span<const glm::dvec2> controls) override {
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            flatten(at_, controls[i], controls[i + 1], controls[i + 2], tolerance_, [&](glm::dvec2 end) {
                lines({&end, 1});
            });
        }
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}

private:
    glm::dvec3 placed(glm::dvec2 point) const { return centre_ + point.x * right_ + point.y * up_; }

    SpaceSink& sink_;
    glm::dvec3 right_, up_, centre_;
    double tolerance_;
    glm::dvec2 at_{0.0};
    Pen pen_;
    bool is_joined_ = false;
};

class SceneCollector : public SpaceSink {
public:
    SceneCollector(const Grammar& grammar, const Style& style, double most)
        : grammar_(grammar), style_(style), eye_(style.camera, {}), most_(most) {}

    void segment(const glm::dvec3& from, const Pen& before, const glm::dvec3& to, const Pen& pen,
                 bool goes_on) override {
        if (!style_.draws(pen)) {
            is_joined_ = false;
            return;
        }
        add(from);
        add(to);
        count(1);
        scene.segments_.push_back(
            {local(from), local(to), SceneWidth(before), SceneWidth(pen), style_.index(pen), goes_on && is_joined_});
        is_joined_ = true;
    }
    void polygon(std::span<const glm::dvec3> vertices, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        count(static_cast<double>(vertices.size()));
        scene.polygons_.push_back({scene.vertices_.size(), vertices.size(), style_.index(pen), 0, {}, 0});
        for (const glm::dvec3& vertex : vertices) {
            add(vertex);
            scene.vertices_.push_back(local(vertex));
        }
    }
    void facet(std::span<const glm::dvec3> vertices, std::span<const int> colours, const Pen& pen) override {
        const std::size_t before = scene.polygons_.size();
        polygon(vertices, pen);
        if (scene.polygons_.size() == before) return;
        scene.polygons_.back().corners = scene.corners_.size();
        for (const int colour : colours) scene.corners_.push_back({{}, style_.index({.colour = colour}), 0.5F});
    }
    void surface(const Surface& surface, const glm::dmat4x3& map, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        count(parts_of_patch * static_cast<double>(surface.patches.size()));
        for (const Patch& patch : surface.patches) {
            for (const glm::dvec3& point : patch.points) add(map * glm::dvec4(point, 1.0));
        }
        const auto [colours, fresh] = scene.patch_colours_.try_emplace(&surface);
        for (const Patch& patch : fresh ? surface.patches : std::vector<Patch>()) {
            colours->second.push_back(patch.colour == 0 ? -1 : style_.index({.colour = patch.colour}));
        }
        glm::dmat4x3 placed = map;
        placed[3] -= scene.origin_;
        const auto& known = grammar_.surfaces();
        const auto shared =
            std::find_if(known.begin(), known.end(), [&](const auto& other) { return other.get() == &surface; });
        scene.surfaces_.push_back({*shared, glm::mat4x3(placed), style_.index(pen)});
    }
    void sphere(const glm::dvec3& centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        count(1);
        add(centre);
        add(centre - radius);
        add(centre + radius);
        scene.spheres_.push_back({local(centre), static_cast<float>(radius), SceneWidth(pen), style_.index(pen)});
    }

    void label(std::string_view text, const glm::dvec3& centre, double height, const Pen& pen) override {
        LetterStems(*this, eye_, centre, height).label(text, glm::dvec2(0.0), height, pen);
    }

    Scene scene;

private:
    glm::vec3 local(const glm::dvec3& point) const { return glm::vec3(point - scene.origin_); }
    void add(const glm::dvec3& point) {
        // Values stored in floats must be within their range.
        if (glm::any(glm::greaterThan(glm::abs(point), glm::dvec3(1e18)))) {
            throw BudgetError("the drawing is larger than 10^18 steps, the limit for drawings in space");
        }
        SpaceBounds& bounds = scene.bounds_;
        if (!has_bounds_) {
            bounds = {point, point};
            scene.origin_ = point;
        }
        has_bounds_ = true;
        bounds.low = glm::min(bounds.low, point);
        bounds.high = glm::max(bounds.high, point);
    }
    void count(double more) {
        counted_ += more;
        if (counted_ > most_) {
            throw BudgetError(
                fmt::format("drawings in space are held in memory, and this one has more than the {:.0f} segments "
                            "and vertices that "
                            "the budget allows",
                            most_));
        }
    }

    const Grammar& grammar_;
    const Style& style_;
    Projection eye_;
    double most_;
    double counted_ = 0;
    bool has_bounds_ = false;
    bool is_joined_ = false;
};

namespace {

constexpr double sharpest_cosine = 0.25;   // cosine of the angle between polygons that are one smooth surface
constexpr std::size_t most_compared = 64;  // polygons at a vertex

/// A corner of a polygon, and the place of its vertex.
struct Meeting {
    std::uint64_t place;
    std::uint32_t polygon;
    std::uint32_t corner;
};

/// A number that is equal for points that differ only by rounding.
std::uint64_t place_number(const glm::vec3& point, float grid) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::int64_t>(std::floor(double(point[axis]) / double(grid) + 0.37));
        hash = (hash ^ static_cast<std::uint64_t>(cell)) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 29;
    }
    return hash;
}

/// Side of the cells in which points are the same.
float meeting_grid(const SpaceBounds& bounds) {
    const glm::dvec3 size = bounds.high - bounds.low;
    return static_cast<float>(std::max({size.x, size.y, size.z, 1e-30}) * 1e-5);
}

/// The normal of a corner: the mean of those of the polygons at its vertex that bend little from its own.
glm::dvec3 mean_normal(std::span<const Meeting> meetings, const Meeting& own,
                       const std::vector<glm::dvec3>& normals) {
    const glm::dvec3& normal = normals[own.polygon];
    if (meetings.size() > most_compared) return normal;
    glm::dvec3 sum(0.0);
    for (const Meeting& other : meetings) {
        const double cosine = glm::dot(normal, normals[other.polygon]);
        // Neighbours may have the opposite orientation.
        if (std::fabs(cosine) >= sharpest_cosine) sum += normals[other.polygon] * (cosine < 0 ? -1.0 : 1.0);
    }
    return glm::length(sum) > 0 ? glm::normalize(sum) : normal;
}

}  // namespace

void Scene::smooth() {
    const float grid = meeting_grid(bounds_);
    std::vector<glm::dvec3> normals(polygons_.size(), glm::dvec3(0.0));
    std::vector<Meeting> meetings;
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
        if (!polygons_[i].corners) continue;
        const auto points = vertices(polygons_[i]);
        const glm::dvec3 normal = area_normal(points);
        if (glm::length(normal) > 0) normals[i] = glm::normalize(normal);
        for (std::size_t k = 0; k < points.size(); ++k) {
            meetings.push_back(
                {place_number(points[k], grid), static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)});
        }
    }
    std::stable_sort(meetings.begin(), meetings.end(),
                     [](const Meeting& a, const Meeting& b) { return a.place < b.place; });
    for (std::size_t first = 0, end = 0; first < meetings.size(); first = end) {
        while (end < meetings.size() && meetings[end].place == meetings[first].place) ++end;
        const auto here = std::span<const Meeting>(meetings).subspan(first, end - first);
        for (const Meeting& own : here) {
            corners_[*polygons_[own.polygon].corners + own.corner].normal =
                glm::vec3(mean_normal(here, own, normals));
        }
    }
}

void Scene::arch() {
    constexpr double height = 0.5;  // height of the arch, as a slope at the rim
    const float grid = meeting_grid(bounds_);
    // Polygons that share an edge with another are parts of a solid.
    std::unordered_map<std::uint64_t, std::uint32_t> edges;
    const auto each_edge = [&](const ScenePolygon& polygon, auto&& visit) {
        const auto points = vertices(polygon);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint64_t from = place_number(points[i], grid);
            visit(from + place_number(points[i + 1 < points.size() ? i + 1 : 0], grid));
        }
    };
    for (const ScenePolygon& polygon : polygons_) {
        if (!polygon.corners) each_edge(polygon, [&](std::uint64_t edge) { ++edges[edge]; });
    }
    for (std::size_t i = 0; i < polygons_.size(); ++i) {
        ScenePolygon& polygon = polygons_[i];
        if (polygon.corners) continue;
        bool is_alone = true;
        each_edge(polygon, [&](std::uint64_t edge) { is_alone = is_alone && edges[edge] == 1; });
        const auto points = vertices(polygon);
        const glm::dvec3 area = area_normal(points);
        if (!is_alone || !(glm::length(area) > 0)) continue;
        const glm::dvec3 normal = glm::normalize(area);
        glm::dvec3 middle(0.0);
        for (const glm::vec3& point : points) middle += glm::dvec3(point) / static_cast<double>(points.size());
        double reach = 0, length = 0;
        for (const glm::vec3& point : points) {
            reach = std::max(reach, glm::distance(glm::dvec3(point), middle));
            length = std::max(length, double{glm::distance(point, points.front())});
        }
        polygon.corners = corners_.size();
        polygon.organ = static_cast<std::uint32_t>(i + 1);
        for (const glm::vec3& point : points) {
            const glm::dvec3 out = (glm::dvec3(point) - middle) / reach;
            corners_.push_back({glm::vec3(glm::normalize(normal + height * out)), polygon.colour,
                                static_cast<float>(glm::distance(point, points.front()) / length)});
        }
    }
}

Scene Scene::of(const Grammar& grammar, const Style& style, const DerivationOptions& derivation, double most) {
    SceneCollector collector(grammar, style, most);
    const auto turtle = SpaceTurtle::make(grammar, &collector, style.sway);
    derive(grammar, *turtle, derivation);
    if (!collector.scene.corners_.empty()) collector.scene.smooth();
    if (!style.light.is_flat) collector.scene.arch();
    return std::move(collector.scene);
}

}  // namespace sikku
