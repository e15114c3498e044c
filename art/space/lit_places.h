// art/space/lit_places.h: places on surfaces that are lit together.
#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace sikku {

/// Places in columns, so that several are lit at once. Their number is filled up to a multiple of `together`.
class LitPlaces {
public:
    static constexpr std::size_t together = 8;
    enum Column : std::size_t {
        x,
        y,
        z,
        normal_x,
        normal_y,
        normal_z,
        is_thin,  ///< 1 if light may come from both sides, else 0
        front,    ///< light from the side of the normal
        behind,   ///< light from the other side
        columns
    };

    void clear();
    /// @param normal  of length 1
    void add(const glm::vec3& point, const glm::vec3& normal, bool thin);
    /// The number of places without padding.
    std::size_t size() const { return size_; }
    float* column(Column which) { return columns_[which].data(); }
    const float* column(Column which) const { return columns_[which].data(); }
    /// Sets the light of all places to 0.
    void darken();

private:
    std::size_t size_ = 0;
    std::array<std::vector<float>, columns> columns_;
};

}  // namespace sikku
