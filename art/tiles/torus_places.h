// art/tiles/torus_places.h: places that are the same after translations of a lattice.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace sikku {

/// Numbers places in the order in which they are added. Places that differ by multiples of two vectors have the same
/// number. Places within a millionth of the vectors are the same.
class TorusPlaces {
public:
    /// @param vectors  not parallel
    explicit TorusPlaces(const std::array<glm::dvec2, 2>& vectors)
        : to_lattice_(glm::inverse(glm::dmat2x2(vectors[0], vectors[1]))) {}

    std::uint32_t number(glm::dvec2 place) {
        glm::dvec2 share = to_lattice_ * place;
        share -= glm::dvec2(std::floor(share.x), std::floor(share.y));
        const auto cell_of = [](double value) { return static_cast<int>(value * cells) % cells; };
        const int column = cell_of(share.x), row = cell_of(share.y);
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                const auto found = numbers_.find({(column + x + cells) % cells, (row + y + cells) % cells});
                if (found == numbers_.end()) continue;
                for (const auto& [other, number] : found->second) {
                    if (apart(share.x, other.x) < same && apart(share.y, other.y) < same) return number;
                }
            }
        }
        numbers_[{column, row}].emplace_back(share, count_);
        return count_++;
    }
    std::uint32_t count() const { return count_; }

private:
    static constexpr int cells = 1000;
    static constexpr double same = 1e-6;
    /// Distance on a circle of length 1.
    static double apart(double a, double b) {
        const double gap = std::fabs(a - b);
        return std::fmin(gap, 1 - gap);
    }

    glm::dmat2x2 to_lattice_;
    std::map<std::pair<int, int>, std::vector<std::pair<glm::dvec2, std::uint32_t>>> numbers_;
    std::uint32_t count_ = 0;
};

}  // namespace sikku
