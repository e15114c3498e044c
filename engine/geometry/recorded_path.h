// engine/geometry/recorded_path.h: stores a drawing and draws it again.
#pragma once

#include "engine/geometry/path.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// Records a drawing. Memory: 16 bytes a point and 32 a call.
class RecordedPath : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { add(Call::begin, {&start, 1}, pen); }
    void lines(std::span<const glm::dvec2> ends) override { add(Call::lines, ends, {}); }
    void curves(std::span<const glm::dvec2> controls) override { add(Call::curves, controls, {}); }
    void change_pen(const Pen& pen) override { add(Call::pen, {}, pen); }
    void end_stroke(bool closed) override { add(closed ? Call::close : Call::end, {}, {}); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { add(Call::polygon, vertices, pen); }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override { add(Call::area, outline, pen); }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        add(Call::disc, {&centre, 1}, pen);
        points_.emplace_back(radius, 0.0);
    }
    void mark() override { add(Call::mark, {}, {}); }

    /// Draws it again: `sink` receives the same calls with the same points.
    void draw(PathSink& sink) const;
    bool empty() const { return calls_.empty(); }
    std::size_t points() const { return points_.size(); }

private:
    enum class Call : std::uint8_t { begin, lines, curves, pen, end, close, polygon, area, disc, mark };
    struct Recorded {
        Call call;
        std::size_t points;
        Pen pen;
    };
    void add(Call call, std::span<const glm::dvec2> points, const Pen& pen) {
        calls_.push_back({call, points.size(), pen});
        points_.insert(points_.end(), points.begin(), points.end());
    }
    std::vector<Recorded> calls_;
    std::vector<glm::dvec2> points_;
};

}  // namespace sikku
