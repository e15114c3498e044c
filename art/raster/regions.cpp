#include "art/raster/regions.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::uint8_t light = 128;
constexpr double white = 255;

/// Joins runs of light pixels, row after row.
class RegionFinder {
public:
    explicit RegionFinder(int width) : width_(width), before_(static_cast<std::size_t>(width), 0) {}

    /// @param pixels  the first channel of each pixel counts
    void add_row(const std::uint8_t* pixels, std::size_t channels) {
        for (std::size_t x = 0; x < row_.size(); ++x) row_[x] = pixels[x * channels];
        for (const Run& run : above_) regions_[root(run.region)].light += dark_light(row_, run.begin, run.end);
        std::vector<Run> runs;
        auto above = above_.begin();
        for (int x = 0; x < width_;) {
            const int begin = x;
            while (x < width_ && is_light(row_[at(x)]) == is_light(row_[at(begin)])) ++x;
            if (!is_light(row_[at(begin)])) continue;
            const std::uint32_t region = add_region(begin, x);
            runs.push_back({begin, x, region});
            // Runs are sorted, so one that ends before this run touches no later run either.
            while (above != above_.end() && above->end <= begin) ++above;
            for (auto run = above; run != above_.end() && run->begin < x; ++run) join(run->region, region);
        }
        above_ = std::move(runs);
        std::swap(before_, row_);
        ++y_;
    }

    /// Call after the last row.
    std::vector<ClosedRegion> found() {
        for (const Run& run : above_) regions_[root(run.region)].is_open = true;
        std::vector<ClosedRegion> closed;
        for (std::uint32_t i = 0; i < regions_.size(); ++i) {
            const Region& region = regions_[i];
            if (region.parent != i || region.is_open) continue;
            const auto pixels = static_cast<double>(region.pixels);
            closed.push_back({static_cast<double>(region.light) / white,
                              {static_cast<double>(region.doubled_x) / 2 / pixels,
                               static_cast<double>(region.doubled_y) / 2 / pixels}});
        }
        return closed;
    }

private:
    struct Run {
        int begin, end;
        std::uint32_t region;
    };
    struct Region {
        std::uint64_t pixels;
        std::uint64_t light;                 ///< of its pixels and of the dark ones on its outline
        std::uint64_t doubled_x, doubled_y;  ///< sums over the pixels of twice their middles
        std::uint32_t parent;
        bool is_open;
    };

    /// A region of one run of the row.
    std::uint32_t add_region(int begin, int end) {
        const auto number = static_cast<std::uint32_t>(regions_.size());
        const auto pixels = static_cast<std::uint64_t>(end - begin);
        const bool is_open = y_ == 0 || begin == 0 || end == width_;
        regions_.push_back({pixels, light_of(begin, end), pixels * static_cast<std::uint64_t>(begin + end),
                            pixels * (2 * y_ + 1), number, is_open});
        return number;
    }
    static bool is_light(std::uint8_t pixel) { return pixel >= light; }
    static std::size_t at(int x) { return static_cast<std::size_t>(x); }
    /// The light of a run of the row, of the dark pixels at its ends, and of those above it.
    std::uint64_t light_of(int begin, int end) const {
        std::uint64_t sum = dark_light(before_, begin, end);
        for (int x = std::max(0, begin - 1); x < std::min(width_, end + 1); ++x) sum += row_[at(x)];
        return sum;
    }
    static std::uint64_t dark_light(const std::vector<std::uint8_t>& row, int begin, int end) {
        std::uint64_t sum = 0;
        for (int x = begin; x < end; ++x) sum += is_light(row[at(x)]) ? 0 : row[at(x)];
        return sum;
    }
    std::uint32_t root(std::uint32_t region) {
        while (regions_[region].parent != region) {
            regions_[region].parent = regions_[regions_[region].parent].parent;
            region = regions_[region].parent;
        }
        return region;
    }
    void join(std::uint32_t one, std::uint32_t other) {
        one = root(one);
        other = root(other);
        if (one == other) return;
        if (other < one) std::swap(one, other);  // regions are numbered by their first pixels
        regions_[one].pixels += regions_[other].pixels;
        regions_[one].light += regions_[other].light;
        regions_[one].doubled_x += regions_[other].doubled_x;
        regions_[one].doubled_y += regions_[other].doubled_y;
        regions_[one].is_open |= regions_[other].is_open;
        regions_[other].parent = one;
    }

    int width_;
    std::uint64_t y_ = 0;
    std::vector<std::uint8_t> before_, row_ = before_;  ///< the row above, and the current one
    std::vector<Run> above_;                            ///< runs of the row above
    std::vector<Region> regions_;
};

}  // namespace

std::vector<ClosedRegion> closed_regions(Rendering& rendering, PixelSize size) {
    RegionFinder finder(size.width);
    const auto channels = static_cast<std::size_t>(rendering.channels());
    const std::size_t stride = channels * static_cast<std::size_t>(size.width);
    rendering.render(0, [&](int, int rows, std::span<const std::uint8_t> pixels) {
        for (int row = 0; row < rows; ++row) {
            finder.add_row(&pixels[static_cast<std::size_t>(row) * stride], channels);
        }
    });
    return finder.found();
}

}  // namespace sikku
