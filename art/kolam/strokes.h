// art/kolam/strokes.h: reads the strokes of a drawing as nodes of a plane.
#pragma once

#include "art/kolam/kolam_plane.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/path.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace sikku::kolam_plane {

/// Strokes as the nodes that they visit.
struct Strokes {
    std::vector<std::uint32_t> nodes;
    std::vector<std::size_t> begins;  ///< into `nodes`; one more than there are strokes
    std::vector<bool> closed;
    std::vector<glm::dvec2> discs;  ///< their centres, with any pen
    std::size_t count() const { return closed.size(); }
    std::span<const std::uint32_t> stroke(std::size_t i) const {
        return {nodes.data() + begins[i], begins[i + 1] - begins[i]};
    }
};

/// Reads the strokes of a turtle. Plane is ExactPlane or RoughPlane.
template <class Plane>
class StrokeReader : public PathSink, public PlaceSink {
public:
    StrokeReader(Plane& plane, int rank, double most_segments, const std::function<bool(const Pen&)>& draws)
        : plane_(plane), rank_(static_cast<std::size_t>(rank)), most_(most_segments), draws_(draws) {}

    void places(std::span<const std::int64_t> coordinates) override { coordinates_ = coordinates; }
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at_ = start;
        at_coordinates_.assign(coordinates_.begin(), coordinates_.end());
        is_seen_ = false;
        change_pen(pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        if (ends.empty()) return;
        at_ = ends.back();
        const auto last = coordinates_.last(rank_);
        at_coordinates_.assign(last.begin(), last.end());
        if (!is_seen_) return;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const std::uint32_t node = plane_.node(coordinates_.subspan(i * rank_, rank_), ends[i]);
            if (node == strokes.nodes.back()) continue;  // a step of length 0
            strokes.nodes.push_back(node);
            if (static_cast<double>(strokes.nodes.size()) > most_) {
                throw BudgetError(
                    fmt::format("the drawing has more than {:.0f} segments, which exceeds the budget; "
                                "use a shorter derivation or a larger budget",
                                most_));
            }
        }
    }
    void curves(std::span<const glm::dvec2>) override {}
    void change_pen(const Pen& pen) override {
        const bool is_seen = !draws_ || draws_(pen);
        if (is_seen == is_seen_) return;
        if (is_seen) {
            strokes.begins.push_back(strokes.nodes.size());
            strokes.nodes.push_back(plane_.node(at_coordinates_, at_));
        } else {
            end_seen();
        }
        is_seen_ = is_seen;
    }
    void end_stroke(bool) override {
        if (is_seen_) end_seen();
        is_seen_ = false;
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2 centre, double, const Pen&) override { strokes.discs.push_back(centre); }
    void label(std::string_view, glm::dvec2, double, const Pen&) override {}

    Strokes finish() {
        strokes.begins.push_back(strokes.nodes.size());
        return std::move(strokes);
    }

private:
    void end_seen() {
        const std::size_t begin = strokes.begins.back();
        if (strokes.nodes.size() - begin < 2) {  // it went nowhere
            strokes.nodes.resize(begin);
            strokes.begins.pop_back();
        } else {
            strokes.closed.push_back(strokes.nodes[begin] == strokes.nodes.back());
        }
    }
    Plane& plane_;
    std::size_t rank_;
    double most_;
    const std::function<bool(const Pen&)>& draws_;
    std::span<const std::int64_t> coordinates_;
    glm::dvec2 at_{0.0};
    std::vector<std::int64_t> at_coordinates_;
    bool is_seen_ = false;
    Strokes strokes;
};

}  // namespace sikku::kolam_plane
