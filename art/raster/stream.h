// art/raster/stream.h: stores a drawing as a stream of words for each band and colour, before it is painted.
#pragma once

#include "art/raster/stroke.h"
#include "engine/base/bits.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sikku::raster_stream {

// A drawing is stored as one stream of 32-bit words for each band and colour, in chunks that never move. Most words
// are short lines: the offset from the end of the last line, 16 bits for x and y each. A word with the smallest x is
// one of these codes instead:
enum class Code : std::int16_t {
    pen,      // one word: the width in pixels, a float
    move,     // two words: x, y
    line,     // two words: x, y
    polygon,  // one word: its colour; its edges follow
};
constexpr std::int16_t escape = INT16_MIN;

constexpr std::uint32_t pack(std::int16_t low, std::int16_t high) {
    return static_cast<std::uint16_t>(low) | static_cast<std::uint32_t>(static_cast<std::uint16_t>(high)) << 16;
}
constexpr std::int16_t low_half(std::uint32_t word) {
    return static_cast<std::int16_t>(word & 0xffff);
}
constexpr std::int16_t high_half(std::uint32_t word) {
    return static_cast<std::int16_t>(word >> 16);
}

struct Chunk {
    Chunk* next = nullptr;
    std::uint32_t* begin = nullptr;
    std::uint32_t* end = nullptr;  ///< end of the used words; not up to date in a stream's last chunk
};

/// Allocates memory that lives as long as the arena.
class Arena {
public:
    std::uint32_t* words(std::size_t count) {
        constexpr std::size_t slab = std::size_t{1} << 18;
        if (left_ < count) {
            slabs_.push_back(std::unique_ptr<std::uint32_t[]>(new std::uint32_t[slab]));  // not cleared
            next_ = slabs_.back().get();
            left_ = slab;
        }
        left_ -= count;
        return std::exchange(next_, next_ + count);
    }

private:
    std::vector<std::unique_ptr<std::uint32_t[]>> slabs_;
    std::uint32_t* next_ = nullptr;
    std::size_t left_ = 0;
};

/// The lines of one colour in one band.
class Stream {
public:
    void pen(Arena& arena, float width) {
        if (width == width_) return;
        width_ = width;
        has_end_ = false;
        put(arena, {pack(escape, static_cast<std::int16_t>(Code::pen)), bit_cast<std::uint32_t>(width)});
    }
    void polygon(Arena& arena, std::uint64_t serial, std::uint32_t colour) {
        if (serial == polygon_) return;
        polygon_ = serial;
        has_end_ = false;
        put(arena, {pack(escape, static_cast<std::int16_t>(Code::polygon)), colour});
    }
    void line(Arena& arena, SubPoint from, SubPoint to) {
        if (!has_end_ || !(end_ == from)) {
            put(arena, {pack(escape, static_cast<std::int16_t>(Code::move)), static_cast<std::uint32_t>(from.x),
                        static_cast<std::uint32_t>(from.y)});
            has_end_ = true;
        }
        end_ = to;
        const std::int32_t dx = to.x - from.x, dy = to.y - from.y;
        if (std::abs(dx) <= INT16_MAX && std::abs(dy) <= INT16_MAX) {
            put(arena, {pack(static_cast<std::int16_t>(dx), static_cast<std::int16_t>(dy))});
        } else {
            put(arena, {pack(escape, static_cast<std::int16_t>(Code::line)), static_cast<std::uint32_t>(to.x),
                        static_cast<std::uint32_t>(to.y)});
        }
    }

    bool empty() const { return first_ == nullptr; }

    /// Plays the stream to a reader with pen(), polygon(), move() and line(); calls `watch`, if set, every few
    /// thousand lines.
    template <class Reader>
    void read(Reader&& reader, const std::function<void()>& watch) const {
        SubPoint at;
        for (const Chunk* chunk = first_; chunk; chunk = chunk->next) {
            if (watch) watch();
            const std::uint32_t* end = chunk == last_ ? cursor_ : chunk->end;
            for (const std::uint32_t* word = chunk->begin; word != end;) {
                const std::uint32_t head = *word++;
                if (low_half(head) != escape) {
                    at = {at.x + low_half(head), at.y + high_half(head)};
                    reader.line(at);
                    continue;
                }
                const Code code{high_half(head)};
                if (code == Code::pen) {
                    reader.pen(bit_cast<float>(*word++));
                } else if (code == Code::polygon) {
                    reader.polygon(*word++);
                } else {
                    at = {static_cast<std::int32_t>(word[0]), static_cast<std::int32_t>(word[1])};
                    word += 2;
                    if (code == Code::move) {
                        reader.move(at);
                    } else {
                        reader.line(at);
                    }
                }
            }
        }
    }

private:
    template <std::size_t count>
    void put(Arena& arena, const std::uint32_t (&words)[count]) {
        if (static_cast<std::size_t>(limit_ - cursor_) < count) grow(arena);
        for (const std::uint32_t word : words) *cursor_++ = word;
    }
    void grow(Arena& arena) {
        constexpr std::size_t header = (sizeof(Chunk) + 7) / 8 * 2;
        constexpr std::size_t least = 64, most = 8192;
        const std::size_t size = last_ ? std::min(2 * static_cast<std::size_t>(limit_ - last_->begin), most) : least;
        // Chunks lie in the arena's words; an even number of them keeps the pointers aligned.
        static_assert(header % 2 == 0 && least % 2 == 0);
        std::uint32_t* words = arena.words(header + size);
        Chunk* chunk = new (words) Chunk;
        if (last_) {
            last_->end = cursor_;
            last_->next = chunk;
        } else {
            first_ = chunk;
        }
        last_ = chunk;
        chunk->begin = cursor_ = words + header;
        limit_ = cursor_ + size;
    }

    Chunk* first_ = nullptr;
    Chunk* last_ = nullptr;
    std::uint32_t* cursor_ = nullptr;
    std::uint32_t* limit_ = nullptr;
    SubPoint end_;
    bool has_end_ = false;
    float width_ = -1;
    std::uint64_t polygon_ = 0;
};

}  // namespace sikku::raster_stream
