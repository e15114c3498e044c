#include "art/space/scene.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <utility>

namespace sikku {

class SceneCollector : public SpaceSink {
public:
    SceneCollector(const Style& style, double most) : style_(style), most_(most) {}

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
        count(vertices.size());
        scene.polygons_.push_back({scene.vertices_.size(), vertices.size(), style_.index(pen)});
        for (const glm::dvec3& vertex : vertices) {
            add(vertex);
            scene.vertices_.push_back(local(vertex));
        }
    }
    void sphere(const glm::dvec3& centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        count(1);
        add(centre);
        add(centre - radius);
        add(centre + radius);
        scene.spheres_.push_back({local(centre), static_cast<float>(radius), SceneWidth(pen), style_.index(pen)});
    }

    Scene scene;

private:
    glm::vec3 local(const glm::dvec3& point) const { return glm::vec3(point - scene.origin_); }
    void add(const glm::dvec3& point) {
        // What is kept in floats is kept within their range.
        if (glm::any(glm::greaterThan(glm::abs(point), glm::dvec3(1e18)))) {
            throw BudgetError("the drawing is over 10^18 steps large, more than is drawn in space");
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
    void count(std::size_t more) {
        counted_ += static_cast<double>(more);
        if (counted_ > most_) {
            throw BudgetError(fmt::format(
                "drawings in space are kept whole, and this one has more than the {:.0f} segments and vertices that "
                "the budget allows",
                most_));
        }
    }

    const Style& style_;
    double most_;
    double counted_ = 0;
    bool has_bounds_ = false;
    bool is_joined_ = false;
};

Scene Scene::of(const Grammar& grammar, const Style& style, const DerivationOptions& derivation, double most) {
    SceneCollector collector(style, most);
    const auto turtle = SpaceTurtle::make(grammar, &collector);
    derive(grammar, *turtle, derivation);
    return std::move(collector.scene);
}

}  // namespace sikku
