#include "art/space/scene_bands.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

constexpr int most_side = 500'000;
constexpr std::size_t most_entries = std::size_t{1} << 25;  // entries of all bins

}  // namespace

PixelSize solid_picture_size(const Print& print) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    if (std::max(size.width, size.height) > most_side) {
        throw std::runtime_error("the picture would be over 500,000 pixels wide or high");
    }
    return size;
}

Stage picture_stage(const Scene& scene, const Print& print) {
    const double unit = print.dpi / 25.4 * SceneBands::samples;
    const glm::dmat3x2& to_page = print.placement.to_page;
    return {scene, print, {to_page[0] * unit, to_page[1] * unit, to_page[2] * unit}, print.placement.step * unit};
}

SceneBands::SceneBands(const Scene& scene, const Stage& stage, const PixelSize& size, double widening)
    : scene_(scene), stage_(stage), size_(size), widening_(widening) {
    // Powers of two, as callers request multiples of 128 rows.
    height_ = size.width > 16'384 ? 8 : size.width > 8'192 ? 16 : 32;
    count_ = (size.height + height_ - 1) / height_;
    height_ = std::min(height_, size.height);
    fill();
}

int SceneBands::rows(int band) const {
    return std::min(height_, size_.height - band * height_);
}

SceneItem SceneBands::item_of(std::size_t number) const {
    const std::size_t segments = scene_.segments().size(), polygons = scene_.polygons().size();
    if (number < segments) return {SceneItem::Kind::segment, number};
    if (number < segments + polygons) return {SceneItem::Kind::polygon, number - segments};
    return {SceneItem::Kind::sphere, number - segments - polygons};
}

SceneItem SceneBands::item(int band, std::size_t i) const {
    return item_of(items_[begin_[bin(band)] + i]);
}

double SceneBands::radius(const SceneWidth& width, const glm::vec3& at) const {
    return std::max(0.5, stage_.radius(width, at));
}

double SceneBands::radius(const SceneSphere& sphere) const {
    return std::max(0.5, stage_.radius(sphere));
}

/// The rows of samples that an item may touch.
std::array<double, 2> SceneBands::reach(const SceneItem& item) const {
    if (item.kind == SceneItem::Kind::segment) {
        const SceneSegment& segment = scene_.segments()[item.index];
        const double from = stage_.place(segment.from).y, to = stage_.place(segment.to).y;
        const double before = radius(segment.before, segment.from) * widening_;
        const double after = radius(segment.after, segment.to) * widening_;
        return {std::min(from - before, to - after), std::max(from + before, to + after)};
    }
    if (item.kind == SceneItem::Kind::polygon) {
        std::array<double, 2> reach{1e300, -1e300};
        for (const glm::vec3& vertex : scene_.vertices(scene_.polygons()[item.index])) {
            const double y = stage_.place(vertex).y;
            reach = {std::min(reach[0], y), std::max(reach[1], y)};
        }
        return reach;
    }
    const SceneSphere& sphere = scene_.spheres()[item.index];
    const double y = stage_.place(sphere.centre).y, half = radius(sphere);
    return {y - half, y + half};
}

void SceneBands::fill() {
    std::vector<std::array<int, 2>> spans(scene_.segments().size() + scene_.polygons().size() +
                                          scene_.spheres().size());
    for (std::size_t number = 0; number < spans.size(); ++number) {
        const std::array<double, 2> rows = reach(item_of(number));
        const double band = height_ * samples;
        // One row more on both sides, for rounding.
        const auto at = [&](double y) {
            return static_cast<int>(std::clamp(std::floor(y / band), -1.0, static_cast<double>(count_)));
        };
        const bool is_seen = rows[1] >= -1 && rows[0] <= double(size_.height) * samples + 1;
        spans[number] = {std::max(0, at(rows[0] - 1)), is_seen ? std::min(count_ - 1, at(rows[1] + 1)) : -1};
    }
    // As many bands in a bin as keep the lists short.
    for (;; bin_bands_ *= 2) {
        std::size_t entries = 0;
        for (const auto& [first, last] : spans) {
            if (last >= first) entries += std::size_t(last / bin_bands_ - first / bin_bands_ + 1);
        }
        if (entries <= std::max(most_entries, 2 * spans.size()) || bin_bands_ >= count_) break;
    }
    begin_.assign(std::size_t(count_ / bin_bands_) + 2, 0);
    const auto each = [&](auto&& visit) {
        for (std::size_t number = 0; number < spans.size(); ++number) {
            const auto [first, last] = spans[number];
            for (int bin = first / bin_bands_; last >= first && bin <= last / bin_bands_; ++bin) {
                visit(std::size_t(bin), number);
            }
        }
    };
    each([&](std::size_t bin, std::size_t) { ++begin_[bin + 1]; });
    for (std::size_t bin = 1; bin < begin_.size(); ++bin) begin_[bin] += begin_[bin - 1];
    items_.resize(begin_.back());
    std::vector<std::size_t> next = begin_;
    each([&](std::size_t bin, std::size_t number) { items_[next[bin]++] = static_cast<std::uint32_t>(number); });
}

}  // namespace sikku
