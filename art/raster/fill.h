// art/raster/fill.h: computes the coverage of pixels by polygons from exact areas.
#pragma once

#include <cmath>
#include <cstring>
#include <vector>

namespace sikku {

/// Adds up the area that polygons cover of each pixel of a band. Directed edges come in any order; for closed
/// outlines the sum along a row is the winding number, averaged over the pixel. Coverage is its absolute value, at
/// most 1: the non-zero rule, exact except in pixels where a polygon crosses itself. The coverages of several
/// polygons of one direction in one sweep add up.
///
/// Memory: 4 bytes a pixel. Cost: the pixels that edges pass, and one test for each eight pixels between them.
/// Source: the accumulation buffer of Levien's font-rs, here with clipping and sparse rows.
class AreaFill {
public:
    AreaFill(int width, int rows);

    /// Adds an edge between two points in pixels, y down from the band's first row; they may lie outside the band.
    void edge(double x0, double y0, double x1, double y1);

    /// Calls `span(row, first, end, coverage)` for runs of pixels of equal coverage 1 to 255, row by row from the
    /// left, and clears the edges.
    template <class SpanFunction>
    void sweep(SpanFunction&& span);

private:
    void inner_edge(double x0, double y0, double x1, double y1);

    int width_;
    std::ptrdiff_t stride_;
    std::vector<float> sums_;  ///< area gained by a pixel and all to its right
    struct Reach {
        int low, high;  ///< touched columns, inclusive
    };
    std::vector<Reach> reach_;
    int low_row_, high_row_;
};

template <class SpanFunction>
void AreaFill::sweep(SpanFunction&& span) {
    for (int row = low_row_; row <= high_row_; ++row) {
        Reach& reach = reach_[static_cast<std::size_t>(row)];
        if (reach.low > reach.high) continue;
        float* sums = sums_.data() + row * stride_;
        float winding = 0;
        int run_start = reach.low, run_coverage = 0;
        const int last = reach.high < width_ ? reach.high : width_ - 1;
        sums[width_] = sums[width_ + 1] = 0;
        for (int column = reach.low; column <= last; ++column) {
            // Whole blocks without an edge keep the coverage.
            static constexpr float nothing[8] = {};
            // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the sums there are 0, of no sign
            while (column + 8 <= last && std::memcmp(sums + column, nothing, sizeof nothing) == 0) column += 8;
            winding += sums[column];
            sums[column] = 0;
            const float area = std::fabs(winding);
            const int coverage = area >= 1 ? 255 : static_cast<int>(area * 255 + 0.5f);
            if (coverage != run_coverage) {
                if (run_coverage > 0) span(row, run_start, column, run_coverage);
                run_start = column;
                run_coverage = coverage;
            }
        }
        // Beyond the last edge the winding is zero, unless the page ends before the polygon does.
        if (run_coverage > 0 && run_start < width_) span(row, run_start, width_, run_coverage);
        reach = {width_, -1};
    }
    low_row_ = static_cast<int>(reach_.size());
    high_row_ = -1;
}

}  // namespace sikku
