#include "art/tiles/border_cuts.h"

#include "art/plotter/plot_layer.h"
#include "art/print/outline.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::uint32_t none = PlotSegment::none;

/// Pieces of a border as loops, each with its tiles on the left.
class Loops {
public:
    explicit Loops(const std::vector<UnitedLines::Line>& lines) : lines_(lines), nodes_(tolerance(lines)) {
        for (const UnitedLines::Line& line : lines) {
            from_.push_back(line.is_border ? nodes_.at(line.from) : none);
            to_.push_back(line.is_border ? nodes_.at(line.to) : none);
        }
        out_.resize(nodes_.points.size());
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            if (from_[i] != none) out_[from_[i]].push_back(i);
        }
        is_used_.assign(lines.size(), false);
    }

    /// The indices of the pieces of a loop that begins with a piece; empty if they do not close.
    std::vector<std::uint32_t> loop(std::uint32_t first) {
        std::vector<std::uint32_t> pieces;
        std::uint32_t at = first;
        while (at != none && !is_used_[at]) {
            is_used_[at] = true;
            pieces.push_back(at);
            at = next(at);
            if (at == first) return pieces;
        }
        return {};
    }
    bool is_used(std::uint32_t piece) const { return is_used_[piece]; }
    /// The corners of a loop, without those on straight stretches.
    std::vector<glm::dvec2> corners(const std::vector<std::uint32_t>& loop) const {
        std::vector<glm::dvec2> corners;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const glm::dvec2 before = way(loop[(i + loop.size() - 1) % loop.size()]), after = way(loop[i]);
            const double sine = before.x * after.y - before.y * after.x;
            constexpr double straight = 1e-9;
            if (std::fabs(sine) > straight * glm::length(before) * glm::length(after) ||
                glm::dot(before, after) < 0) {
                corners.push_back(nodes_.points[from_[loop[i]]]);
            }
        }
        return corners;
    }

private:
    static double tolerance(const std::vector<UnitedLines::Line>& lines) {
        double size = 1e-300;
        for (const auto& line : lines) size = std::max({size, std::fabs(line.from.x), std::fabs(line.from.y)});
        return 1e-9 * size;
    }
    glm::dvec2 way(std::uint32_t piece) const { return lines_[piece].to - lines_[piece].from; }

    /// The next piece around the same tiles: the first one clockwise from the reversed piece, as tiles lie on the
    /// left.
    std::uint32_t next(std::uint32_t piece) const {
        const glm::dvec2 back = -way(piece);
        std::uint32_t best = none;
        double least = 0;
        for (const std::uint32_t other : out_[to_[piece]]) {
            const glm::dvec2 on = way(other);
            double turn = std::atan2(back.y, back.x) - std::atan2(on.y, on.x);
            if (turn <= 1e-9) turn += 2 * std::numbers::pi;
            if (best != none && turn >= least) continue;
            best = other;
            least = turn;
        }
        return best;
    }

    const std::vector<UnitedLines::Line>& lines_;
    PlotNodes nodes_;
    std::vector<std::uint32_t> from_, to_;  // nodes of pieces
    std::vector<std::vector<std::uint32_t>> out_;
    std::vector<bool> is_used_;
};

}  // namespace

std::vector<UnitedLines::Line> with_wider_border(const std::vector<UnitedLines::Line>& lines, double distance) {
    Loops loops(lines);
    std::vector<UnitedLines::Line> result;
    std::vector<bool> is_moved(lines.size(), false);
    std::vector<UnitedLines::Line> moved;
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].is_border || loops.is_used(i)) continue;
        const std::vector<std::uint32_t> loop = loops.loop(i);
        const std::vector<glm::dvec2> corners = loops.corners(loop);
        if (corners.size() < 3) continue;
        const auto outline = offset_sides(corners, distance);
        if (!outline) {
            throw std::runtime_error("the kerf is wider than a notch of the tiling's border; expected longer steps");
        }
        for (const std::uint32_t piece : loop) is_moved[piece] = true;
        for (std::size_t k = 0; k < outline->size(); ++k) {
            moved.push_back({(*outline)[k], (*outline)[(k + 1) % outline->size()], lines[i].pen, false, true});
        }
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!is_moved[i]) result.push_back(lines[i]);
    }
    result.insert(result.end(), moved.begin(), moved.end());
    return result;
}

}  // namespace sikku
