#include "art/space/lit_places.h"

#include <algorithm>

namespace sikku {

void LitPlaces::clear() {
    size_ = 0;
    for (std::vector<float>& column : columns_) column.clear();
}

void LitPlaces::add(const glm::vec3& point, const glm::vec3& normal, bool thin) {
    if (size_ % together == 0) {
        for (std::vector<float>& column : columns_) column.resize(size_ + together, 0.0F);
    }
    const std::array<float, is_thin + 1> values = {point.x,  point.y,  point.z,           normal.x,
                                                   normal.y, normal.z, thin ? 1.0F : 0.0F};
    for (std::size_t i = 0; i < values.size(); ++i) columns_[i][size_] = values[i];
    ++size_;
}

void LitPlaces::darken() {
    for (const Column light : {front, behind}) std::fill(columns_[light].begin(), columns_[light].end(), 0.0F);
}

}  // namespace sikku
