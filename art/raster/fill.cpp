#include "art/raster/fill.h"

#include <algorithm>

namespace sikku {

AreaFill::AreaFill(int width, int rows)
    : width_(width),
      stride_(width + 2),  // an edge in the last column spills into the next
      sums_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows)),
      reach_(static_cast<std::size_t>(rows), Reach{width, -1}),
      low_row_(rows),
      high_row_(-1) {}

void AreaFill::edge(double x0, double y0, double x1, double y1) {
    const double rows = static_cast<double>(reach_.size());
    if (y0 == y1 || std::max(y0, y1) <= 0 || std::min(y0, y1) >= rows) return;
    // Cut at the left and right border: an edge left of it changes the winding of the whole row, one right of it
    // none.
    const double right = width_;
    for (const double border : {0.0, right}) {
        if ((x0 < border && x1 > border) || (x0 > border && x1 < border)) {
            const double y = y0 + (y1 - y0) * (border - x0) / (x1 - x0);
            edge(x0, y0, border, y);
            edge(border, y, x1, y1);
            return;
        }
    }
    if (std::max(x0, x1) <= 0) x0 = x1 = 0;
    if (std::min(x0, x1) >= right) return;
    inner_edge(x0, y0, x1, y1);
}

void AreaFill::inner_edge(double x0, double y0, double x1, double y1) {
    const double direction = y0 < y1 ? 1 : -1;
    if (y0 > y1) {
        std::swap(x0, x1);
        std::swap(y0, y1);
    }
    const double slope = (x1 - x0) / (y1 - y0);
    const double top = std::max(y0, 0.0), bottom = std::min(y1, static_cast<double>(reach_.size()));
    const int first_row = static_cast<int>(top);
    const int last_row = std::min(static_cast<int>(bottom), static_cast<int>(reach_.size()) - 1);
    low_row_ = std::min(low_row_, first_row);
    high_row_ = std::max(high_row_, last_row);
    if (x0 == x1) {
        // Most edges of curves on a square grid; the results are those of the general case.
        const int column = std::min(static_cast<int>(x0), width_);
        const double beyond = x0 - column;
        for (int row = first_row; row <= last_row; ++row) {
            const double from = std::max(top, static_cast<double>(row));
            const double to = std::min(bottom, static_cast<double>(row) + 1);
            if (from >= to) continue;
            const double height = direction * (to - from);
            float* const sums = sums_.data() + row * stride_ + column;
            sums[0] += static_cast<float>(height * (1 - beyond));
            sums[1] += static_cast<float>(height * beyond);
            Reach& reach = reach_[static_cast<std::size_t>(row)];
            reach.low = std::min(reach.low, column);
            reach.high = std::max(reach.high, column + 1);
        }
        return;
    }
    const double low_x = std::min(x0, x1), high_x = std::max(x0, x1);
    for (int row = first_row; row <= last_row; ++row) {
        const double from = std::max(top, static_cast<double>(row));
        const double to = std::min(bottom, static_cast<double>(row) + 1);
        if (from >= to) continue;
        const double height = direction * (to - from);
        const double a = std::clamp(x0 + slope * (from - y0), low_x, high_x);
        const double b = std::clamp(x0 + slope * (to - y0), low_x, high_x);
        const double left = std::min(a, b), right = std::max(a, b);
        const int first = std::min(static_cast<int>(left), width_);
        const int last = std::min(static_cast<int>(right), width_);
        float* sums = sums_.data() + row * stride_;
        if (first == last) {
            const double beyond = 0.5 * (left + right) - first;
            sums[first] += static_cast<float>(height * (1 - beyond));
            sums[first + 1] += static_cast<float>(height * beyond);
        } else {
            // A trapezium over several columns: each gets its part of the height, times the share of its width right
            // of the edge; the rest goes to the next column.
            const double per_column = height / (right - left);
            double from_x = left;
            for (int column = first; column <= last; ++column) {
                const double to_x = std::min(static_cast<double>(column) + 1, right);
                const double part = per_column * (to_x - from_x);
                const double beyond = 0.5 * (from_x + to_x) - column;
                sums[column] += static_cast<float>(part * (1 - beyond));
                sums[column + 1] += static_cast<float>(part * beyond);
                from_x = to_x;
            }
        }
        Reach& reach = reach_[static_cast<std::size_t>(row)];
        reach.low = std::min(reach.low, first);
        reach.high = std::max(reach.high, last + 1);
    }
}

}  // namespace sikku
