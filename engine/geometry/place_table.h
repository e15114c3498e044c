// engine/geometry/place_table.h: numbers for places: whole coordinates of a lattice, or doubles with a tolerance.
#pragma once

#include "engine/base/chance.h"
#include "engine/geometry/box.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace sikku {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

/// Numbers places in the order in which they are added; equal ones have one number. Memory: that of the coordinates,
/// and up to 48 bytes a place.
template <class Coordinate>
class PlaceTable {
public:
    /// @param rank  even number of whole coordinates of a place; 0: places are doubles, and those within the
    /// tolerance are equal
    PlaceTable(std::size_t rank, double tolerance) : rank_(rank), tolerance_(tolerance), table_(64), shift_(32 - 6) {}

    std::uint32_t add(const Coordinate* coordinates, glm::dvec2 place) {
        const std::uint32_t tag = tag_of(coordinates, place);
        const std::uint32_t known = rank_ > 0 ? find_exact(coordinates, tag) : find_near(place);
        if (known != no_number) return known;
        const auto number = static_cast<std::uint32_t>(places_.size());
        if (rank_ > 0) coordinates_.insert(coordinates_.end(), coordinates, coordinates + rank_);
        places_.push_back(place);
        if (2 * places_.size() >= table_.size()) grow();
        insert({number, tag});
        return number;
    }
    /// The number of a place, or no_number if it was not added.
    std::uint32_t find(const Coordinate* coordinates, glm::dvec2 place) const {
        return rank_ > 0 ? find_exact(coordinates, tag_of(coordinates, place)) : find_near(place);
    }
    std::size_t size() const { return places_.size(); }
    std::span<const glm::dvec2> places() const { return places_; }
    glm::dvec2 at(std::uint32_t number) const { return places_[number]; }
    const Coordinate* coordinates(std::uint32_t number) const { return coordinates_.data() + number * rank_; }

private:
    struct Slot {
        std::uint32_t number = no_number;
        std::uint32_t tag = 0;
    };
    /// A hash; equal whole coordinates have equal tags.
    std::uint32_t tag_of(const Coordinate* coordinates, glm::dvec2 place) const {
        if (rank_ == 0) return tag_of_cell(cell_of(place.x), cell_of(place.y));
        std::uint64_t hash = 0;
        for (std::size_t i = 0; i < rank_; i += 2) {
            const auto low = static_cast<std::uint64_t>(coordinates[i]);
            const auto high = static_cast<std::uint64_t>(coordinates[i + 1]);
            hash = scrambled(hash + 0x9e3779b97f4a7c15 + (high << 32U) + (high >> 32U) + low);
        }
        return static_cast<std::uint32_t>(hash >> 32U);
    }
    /// The upper bits of tags, so that a table of twice the size has the same order.
    std::size_t home(std::uint32_t tag) const { return tag >> shift_; }
    std::size_t after(std::size_t slot) const { return (slot + 1) & (table_.size() - 1); }

    static std::uint32_t tag_of_cell(std::int64_t x, std::int64_t y) {
        const std::uint64_t hash =
            scrambled(scrambled(static_cast<std::uint64_t>(x)) + static_cast<std::uint64_t>(y));
        return static_cast<std::uint32_t>(hash >> 32U);
    }
    std::int64_t cell_of(double value) const {
        constexpr double cell_in_tolerances = 64;
        return static_cast<std::int64_t>(
            std::floor(std::clamp(value / (cell_in_tolerances * tolerance_), -9e18, 9e18)));
    }

    std::uint32_t find_exact(const Coordinate* coordinates, std::uint32_t tag) const {
        for (std::size_t at = home(tag);; at = after(at)) {
            const Slot& found = table_[at];
            if (found.number == no_number) return no_number;
            if (found.tag != tag) continue;
            const Coordinate* known = this->coordinates(found.number);
            std::uint32_t i = 0;
            while (i < rank_ && known[i] == coordinates[i]) ++i;
            if (i == rank_) return found.number;
        }
    }
    std::uint32_t find_near(glm::dvec2 place) const {
        const std::int64_t left = cell_of(place.x - tolerance_), right = cell_of(place.x + tolerance_);
        const std::int64_t low = cell_of(place.y - tolerance_), high = cell_of(place.y + tolerance_);
        std::uint32_t nearest = no_number;
        double least = tolerance_;
        for (std::int64_t x = left; x <= right; ++x) {
            for (std::int64_t y = low; y <= high; ++y) {
                const std::uint32_t tag = tag_of_cell(x, y);
                for (std::size_t at = home(tag); table_[at].number != no_number; at = after(at)) {
                    if (table_[at].tag != tag) continue;
                    const glm::dvec2 gap = places_[table_[at].number] - place;
                    const double distance = std::sqrt(scalar_product(gap, gap));
                    if (distance > least || (distance == least && nearest != no_number)) continue;
                    least = distance;
                    nearest = table_[at].number;
                }
            }
        }
        return nearest;
    }
    void insert(const Slot& entry) {
        std::size_t at = home(entry.tag);
        while (table_[at].number != no_number) at = after(at);
        table_[at] = entry;
    }
    /// Doubles the table. Both tables are traversed in order from a free slot, so that no run of entries is split.
    void grow() {
        std::vector<Slot> entries(2 * table_.size());
        entries.swap(table_);
        --shift_;
        std::size_t start = 0;
        while (entries[start].number != no_number) ++start;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const Slot& entry = entries[(start + i) & (entries.size() - 1)];
            if (entry.number != no_number) insert(entry);
        }
    }

    std::size_t rank_;
    double tolerance_;
    std::vector<Coordinate> coordinates_;
    std::vector<glm::dvec2> places_;
    std::vector<Slot> table_;  // numbers by tag, open addressing
    unsigned shift_;           // 32 less the bits of the table's size
};

}  // namespace sikku
