// engine/base/union_find.h: disjoint sets of numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sikku {

/// Disjoint sets of numbers from 0 on.
class UnionFind {
public:
    explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// Joins two sets; the smaller of their representatives stands for both.
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    /// The number of sets.
    std::uint64_t count() const {
        std::uint64_t sets = 0;
        for (std::uint32_t i = 0; i < parent_.size(); ++i) sets += parent_[i] == i ? 1 : 0;
        return sets;
    }
    /// For each number that of its set; sets are numbered from 0 in the order of their least members.
    std::vector<std::uint32_t> set_numbers() {
        std::vector<std::uint32_t> numbers(parent_.size());
        std::uint32_t sets = 0;
        for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = find(i) == i ? sets++ : numbers[find(i)];
        return numbers;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace sikku
