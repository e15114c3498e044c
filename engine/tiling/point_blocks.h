// engine/tiling/point_blocks.h: numbers for points with whole coordinates; neighbours are near each other in memory.
#pragma once

#include "engine/base/memory.h"
#include "engine/geometry/place_table.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sikku {

/// Numbers points in the order in which they are added; equal coordinates have one number. Points of one square block
/// of the plane share a small hash table, which fits into a cache: the corners of a tile, and of the tiles that are
/// drawn next, are in few blocks. Memory: that of the coordinates, and about 8 bytes a point where points lie as
/// dense as the first 1,024; blocks of few points take more.
class PointBlocks {
public:
    /// @param rank  number of coordinates of a point
    explicit PointBlocks(std::size_t rank) : rank_(rank), blocks_(1) {}

    /// @param place  the point in the plane; equal coordinates have equal places
    std::uint32_t add(const std::int32_t* coordinates, glm::dvec2 place) {
        Block& block = block_at(place);
        const std::uint32_t slot = slot_of(block, coordinates);
        if (slot != no_number && block.slots[slot] != no_number) return block.slots[slot];
        const std::uint32_t number = points_++;
        coordinates_.insert(coordinates_.end(), coordinates, coordinates + rank_);
        if (width_ == 0) {
            sample_.push_back(place);
            if (points_ == sample_size) return divide();
        }
        keep(block, number);
        return number;
    }
    /// The number of a point, or no_number if it was not added.
    std::uint32_t find(const std::int32_t* coordinates, glm::dvec2 place) const {
        const Block* block = &blocks_.front();
        if (width_ > 0) {
            const auto found = by_cell_.find(cell_of(place));
            if (found == by_cell_.end()) return no_number;
            block = &blocks_[found->second];
        }
        const std::uint32_t slot = slot_of(*block, coordinates);
        return slot == no_number ? no_number : block->slots[slot];
    }
    void reserve(std::size_t points) {
        coordinates_.reserve(points * rank_);
        use_large_pages(coordinates_);
    }
    std::size_t size() const { return points_; }
    const std::int32_t* coordinates(std::uint32_t number) const {
        return coordinates_.data() + static_cast<std::size_t>(number) * rank_;
    }

private:
    static constexpr std::uint32_t sample_size = 1024;  ///< points whose density determines the size of blocks
    static constexpr double points_of_block = 100;      ///< at this density
    struct Block {
        std::uint64_t cell = 0;
        std::uint32_t used = 0;
        std::vector<std::uint32_t> slots;  ///< numbers, open addressing
    };

    std::uint64_t cell_of(glm::dvec2 place) const {
        const auto part = [&](double value) {
            constexpr double farthest = 1 << 30;
            return static_cast<std::uint32_t>(
                static_cast<std::int32_t>(std::clamp(std::floor(value / width_), -farthest, farthest)));
        };
        return std::uint64_t{part(place.x)} << 32U | part(place.y);
    }
    Block& block_at(glm::dvec2 place) {
        if (width_ == 0) return blocks_.front();
        const std::uint64_t cell = cell_of(place);
        std::uint32_t& recent = recent_[(cell >> 32U & 7U) * 8 + (cell & 7U)];
        if (blocks_[recent].cell == cell) return blocks_[recent];
        const auto [found, is_new] = by_cell_.try_emplace(cell, static_cast<std::uint32_t>(blocks_.size()));
        if (is_new) blocks_.push_back({cell, 0, {}});
        recent = found->second;
        return blocks_[recent];
    }

    std::uint32_t tag_of(const std::int32_t* coordinates) const {
        std::uint64_t hash = 0;
        for (std::size_t i = 0; i < rank_; ++i) {
            hash = (hash ^ static_cast<std::uint32_t>(coordinates[i])) * 0x9e3779b97f4a7c15;
            hash ^= hash >> 32U;
        }
        return static_cast<std::uint32_t>(hash);
    }
    /// The slot with the point or, if there is none, where it belongs; no_number in a block without slots.
    std::uint32_t slot_of(const Block& block, const std::int32_t* coordinates) const {
        const std::size_t size = block.slots.size();
        if (size == 0) return no_number;
        for (std::size_t at = tag_of(coordinates) & (size - 1);; at = (at + 1) & (size - 1)) {
            const std::uint32_t number = block.slots[at];
            if (number == no_number || is_at(number, coordinates)) return static_cast<std::uint32_t>(at);
        }
    }
    bool is_at(std::uint32_t number, const std::int32_t* coordinates) const {
        const std::int32_t* known = this->coordinates(number);
        std::size_t i = 0;
        while (i < rank_ && known[i] == coordinates[i]) ++i;
        return i == rank_;
    }
    void keep(Block& block, std::uint32_t number) {
        if (block.used + 1 > block.slots.size() / 4 * 3) grow(block);
        insert(block, number);
        ++block.used;
    }
    void insert(Block& block, std::uint32_t number) {
        const std::size_t mask = block.slots.size() - 1;
        std::size_t at = tag_of(coordinates(number)) & mask;
        while (block.slots[at] != no_number) at = (at + 1) & mask;
        block.slots[at] = number;
    }
    void grow(Block& block) {
        constexpr std::size_t least = 16, usual = 64;
        const std::size_t factor = block.slots.size() < usual ? 4 : 2;
        std::vector<std::uint32_t> numbers(std::max(least, factor * block.slots.size()), no_number);
        numbers.swap(block.slots);
        for (const std::uint32_t number : numbers) {
            if (number != no_number) insert(block, number);
        }
    }
    /// Sets the size of blocks and distributes the sample to them. Returns the number of its last point.
    std::uint32_t divide() {
        const glm::dvec2 size = box_of(sample_).size();
        const double share = points_of_block / sample_size;
        width_ = std::max({std::sqrt(size.x * size.y * share), std::max(size.x, size.y) * share, 1e-9});
        blocks_.clear();
        for (std::uint32_t number = 0; number < points_; ++number) {
            const std::uint64_t cell = cell_of(sample_[number]);
            const auto [found, is_new] = by_cell_.try_emplace(cell, static_cast<std::uint32_t>(blocks_.size()));
            if (is_new) blocks_.push_back({cell, 0, {}});
            keep(blocks_[found->second], number);
        }
        std::vector<glm::dvec2>().swap(sample_);  // frees the memory
        return points_ - 1;
    }

    std::size_t rank_;
    std::uint32_t points_ = 0;
    std::vector<std::int32_t> coordinates_;
    double width_ = 0;  ///< of blocks; 0: there is one so far
    std::vector<glm::dvec2> sample_;
    std::vector<Block> blocks_;
    std::unordered_map<std::uint64_t, std::uint32_t> by_cell_;
    std::array<std::uint32_t, 64> recent_{};  ///< blocks used last
};

}  // namespace sikku
