#include "art/relief/crossings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace sikku {
namespace {

constexpr double most_comparisons = 1.5e8;

/// Squares of equal size over all segments, and the segments that run through each.
class Squares {
public:
    explicit Squares(std::span<const OutlineEdge> segments) : segments_(segments) {
        low_ = high_ = segments.front().from;
        double sum = 0;
        for (const OutlineEdge& segment : segments) {
            for (const Micrometres end : {segment.from, segment.to}) {
                low_ = {std::min(low_.x, end.x), std::min(low_.y, end.y)};
                high_ = {std::max(high_.x, end.x), std::max(high_.y, end.y)};
            }
            sum += std::max(std::fabs(double(segment.to.x) - segment.from.x),
                            std::fabs(double(segment.to.y) - segment.from.y));
        }
        const double width = double(high_.x) - low_.x + 1, height = double(high_.y) - low_.y + 1;
        const auto count = static_cast<double>(segments.size());
        // About as large as a segment is long, but few enough.
        side_ = std::max({sum / count, std::sqrt(width * height / (2 * count)), 1.0});
        columns_ = static_cast<std::size_t>(width / side_) + 1;
        begin_.assign(columns_ * (static_cast<std::size_t>(height / side_) + 1) + 1, 0);
        for (const OutlineEdge& segment : segments) {
            each_square(segment, [&](std::size_t square) { ++begin_[square + 1]; });
        }
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        entries_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t i = 0; i < segments.size(); ++i) {
            each_square(segments[i], [&](std::size_t square) { entries_[next[square]++] = i; });
        }
    }
    std::size_t count() const { return begin_.size() - 1; }
    std::span<const std::uint32_t> in(std::size_t square) const {
        return std::span(entries_).subspan(begin_[square], begin_[square + 1] - begin_[square]);
    }
    std::size_t square_at(double x, double y) const {
        return row((y - low_.y) / side_) * columns_ + column((x - low_.x) / side_);
    }

private:
    std::size_t column(double place) const {
        return std::min(static_cast<std::size_t>(std::max(place, 0.0)), columns_ - 1);
    }
    std::size_t row(double place) const {
        return std::min(static_cast<std::size_t>(std::max(place, 0.0)), (begin_.size() - 1) / columns_ - 1);
    }
    /// Visits the squares that a segment runs through, column by column, and perhaps some beside it.
    template <class Visit>
    void each_square(const OutlineEdge& segment, Visit&& visit) const {
        const bool is_back = segment.to.x < segment.from.x;
        const Micrometres left = is_back ? segment.to : segment.from, right = is_back ? segment.from : segment.to;
        const double x0 = (double(left.x) - low_.x) / side_, x1 = (double(right.x) - low_.x) / side_;
        const double y0 = (double(left.y) - low_.y) / side_, y1 = (double(right.y) - low_.y) / side_;
        const double slope = x1 > x0 ? (y1 - y0) / (x1 - x0) : 0;
        constexpr double slack = 1e-6;
        for (std::size_t x = column(x0); x <= column(x1); ++x) {
            const double from = std::max(x0, static_cast<double>(x)), to = std::min(x1, static_cast<double>(x) + 1);
            double low = x1 > x0 ? y0 + slope * (from - x0) : y0, high = x1 > x0 ? y0 + slope * (to - x0) : y1;
            if (low > high) std::swap(low, high);
            for (std::size_t y = row(low - slack); y <= row(high + slack); ++y) visit(y * columns_ + x);
        }
    }

    std::span<const OutlineEdge> segments_;
    Micrometres low_, high_;
    double side_ = 1;
    std::size_t columns_ = 1;
    std::vector<std::size_t> begin_;  ///< by square, into entries_
    std::vector<std::uint32_t> entries_;
};

std::int64_t line_side(const OutlineEdge& line, Micrometres point) {
    return (std::int64_t{line.to.x} - line.from.x) * (std::int64_t{point.y} - line.from.y) -
           (std::int64_t{line.to.y} - line.from.y) * (std::int64_t{point.x} - line.from.x);
}

struct CrossingPlace {
    double x = 0, y = 0;
};

/// The place where two segments cross within both.
std::optional<CrossingPlace> crossing(const OutlineEdge& a, const OutlineEdge& b) {
    if (std::max(a.from.x, a.to.x) < std::min(b.from.x, b.to.x) ||
        std::max(b.from.x, b.to.x) < std::min(a.from.x, a.to.x) ||
        std::max(a.from.y, a.to.y) < std::min(b.from.y, b.to.y) ||
        std::max(b.from.y, b.to.y) < std::min(a.from.y, a.to.y)) {
        return std::nullopt;
    }
    const std::int64_t from = line_side(a, b.from), to = line_side(a, b.to);
    if (!((from < 0 && to > 0) || (from > 0 && to < 0))) return std::nullopt;
    const std::int64_t left = line_side(b, a.from), right = line_side(b, a.to);
    if (!((left < 0 && right > 0) || (left > 0 && right < 0))) return std::nullopt;
    const double share = static_cast<double>(from) / (static_cast<double>(from) - static_cast<double>(to));
    return CrossingPlace{b.from.x + share * (double(b.to.x) - b.from.x),
                         b.from.y + share * (double(b.to.y) - b.from.y)};
}

std::size_t without_repetitions(std::vector<std::uint64_t>& places) {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places.size();
}

}  // namespace

std::size_t count_crossings(std::span<const OutlineEdge> segments, double apart, std::size_t most,
                            const Monitor& monitor) {
    if (segments.size() < 2) return 0;
    const Squares squares(segments);
    const double unit = std::max(1.0, 2 * apart);
    std::vector<std::uint64_t> places;
    Pulse pulse(monitor);
    double compared = 0;
    for (std::size_t square = 0; square < squares.count() && compared < most_comparisons; ++square) {
        const auto here = squares.in(square);
        for (std::size_t i = 0; i < here.size() && compared < most_comparisons; ++i) {
            compared += static_cast<double>(here.size() - i);
            pulse();
            for (std::size_t k = i + 1; k < here.size(); ++k) {
                const auto place = crossing(segments[here[i]], segments[here[k]]);
                // Other squares find it, too.
                if (!place || squares.square_at(place->x, place->y) != square) continue;
                const auto coordinate = [&](double value) {
                    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(value / unit)));
                };
                places.push_back(std::uint64_t{coordinate(place->x)} << 32 | coordinate(place->y));
            }
        }
        if (places.size() > 2 * most && without_repetitions(places) > most) return places.size();
    }
    return without_repetitions(places);
}

}  // namespace sikku
