// engine/derivation/nearest_steps.h: rewrites whole words, a byte for each symbol, on two threads.
#pragma once

#include "engine/derivation/context_choices.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace sikku {

/// Uninitialized bytes, which are lost when the buffer grows.
class RawBytes {
public:
    std::uint8_t* data() { return bytes_.get(); }
    const std::uint8_t* data() const { return bytes_.get(); }
    std::size_t size() const { return size_; }
    /// Afterwards, the contents are arbitrary.
    void resize(std::size_t size);

private:
    std::unique_ptr<std::uint8_t[]> bytes_;
    std::size_t size_ = 0;
    std::size_t room_ = 0;
};

/// A word of at most 128 different symbols.
using ByteWord = RawBytes;

/// The steps of one table of a plain grammar whose productions rewrite one symbol and have contexts of at most one
/// symbol on each side. Memory: 1 byte for each symbol of a word, in addition to the words.
class NearestSteps {
public:
    NearestSteps(const Grammar& grammar, const Table& table);
    bool is_usable() const { return is_usable_; }

    /// Returns the size of the next word, and writes it, unless it has more than `longest` symbols.
    /// @param watch  called from time to time by the calling thread; may throw
    std::uint64_t rewrite(const ByteWord& word, ByteWord& next, std::uint64_t longest,
                          const std::function<void()>& watch);

private:
    /// How a symbol changes the state of a scan.
    struct Turn {
        std::uint8_t keep = 0;  ///< of the class that was seen last
        std::uint8_t take = 0;  ///< of the class that was seen before the branch
        std::uint8_t set = 0;   ///< class of the symbol itself
        std::int8_t opens = 0;  ///< 1: a branch, from this side; -1: closes it
    };
    /// The replacement of a symbol: a symbol if `code` is below `first_text`, otherwise a text.
    struct Outcome {
        std::uint8_t code = 0;
        std::uint8_t length = 1;
    };
    struct Text {
        std::array<std::uint8_t, 8> begin{};  ///< the whole text, if it is not longer
        std::uint32_t length = 1;
        std::uint32_t pool = 0;
    };
    struct Scan;

    /// Stores for each symbol in a part of the word the class seen on one side, or, if the other side is known, its
    /// outcome.
    template <bool to_left, bool is_second>
    void look(Scan& scan, std::size_t begin, std::size_t end);
    /// Writes the outcomes of a part of the word, up to the end of its half. Returns the end of the output.
    std::uint8_t* write(std::size_t begin, std::size_t end, std::uint8_t* out, const std::uint8_t* out_end) const;

    static constexpr std::uint8_t first_text = 128;
    static constexpr std::size_t longest_text = 255;

    bool is_usable_ = false;
    std::vector<Turn> to_right_, to_left_;  // by symbol: from left to right, and from right to left
    std::vector<std::uint32_t> rows_;       // by symbol: index of its outcomes
    std::vector<Outcome> outcomes_;         // by row and the classes on both sides
    std::array<Text, 256> texts_{};
    std::vector<std::uint8_t> pool_;
    const std::uint8_t* word_ = nullptr;
    RawBytes marks_;  // for each symbol, first a class and then its outcome
};

}  // namespace sikku
