// art/space/scene_bands.h: which rows of a picture each item of a scene touches, so that it can be drawn in bands.
#pragma once

#include "art/raster/raster.h"
#include "art/space/scene.h"
#include "art/space/stage.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sikku {

/// An item of a scene: the index of a segment, polygon or sphere.
struct SceneItem {
    enum class Kind : std::uint8_t { segment, polygon, sphere };
    Kind kind;
    std::size_t index;
};

/// Bands of rows of a picture, and the items that each may touch. Memory: 4 bytes for each band that an item touches;
/// if that is over 128 MB, several bands share a list.
class SceneBands {
public:
    static constexpr int samples = 4;  ///< per pixel in each direction; the unit of the stage

    /// @param widening  factor of the widths of stems that are drawn with collars
    SceneBands(const Scene& scene, const Stage& stage, const PixelSize& size, double widening = 1.0);

    int count() const { return count_; }
    /// Maximum number of rows of pixels in a band.
    int height() const { return height_; }
    int rows(int band) const;
    /// Number of items that may touch a band.
    std::size_t items(int band) const { return begin_[bin(band) + 1] - begin_[bin(band)]; }
    SceneItem item(int band, std::size_t i) const;

    /// Half the width of a stem, or the radius of a sphere, in samples: at least half a sample.
    double radius(const SceneWidth& width, const glm::vec3& at) const;
    double radius(const SceneSphere& sphere) const;

private:
    std::size_t bin(int band) const { return static_cast<std::size_t>(band / bin_bands_); }
    std::array<double, 2> reach(const SceneItem& item) const;
    SceneItem item_of(std::size_t number) const;
    void fill();

    const Scene& scene_;
    const Stage& stage_;
    PixelSize size_;
    double widening_;
    int height_ = 32;
    int count_ = 0;
    int bin_bands_ = 1;
    std::vector<std::size_t> begin_;  ///< by bin, into items_
    std::vector<std::uint32_t> items_;
};

/// The stage of a print whose units are samples.
Stage picture_stage(const Scene& scene, const Print& print);

/// Size of the picture of a print. @throws std::runtime_error if a side is over 500,000 pixels
PixelSize solid_picture_size(const Print& print);

}  // namespace sikku
