#include "art/image/gif_writer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_colours = 255;  // besides the transparent one

/// A number for each distinct colour, in the order of their first pixels.
class ColourNumbers {
public:
    ColourNumbers() { slots_.fill(empty); }
    /// @returns the number; most_colours if there are too many
    std::size_t number(std::uint32_t colour) {
        std::size_t slot = (colour * 0x9e3779b1U) >> 22U;
        for (; slots_[slot] != empty; slot = (slot + 1) % slots_.size()) {
            if (colours[slots_[slot]] == colour) return slots_[slot];
        }
        if (colours.size() == most_colours) return most_colours;
        slots_[slot] = static_cast<std::uint16_t>(colours.size());
        colours.push_back(colour);
        return colours.size() - 1;
    }
    std::vector<std::uint32_t> colours;

private:
    static constexpr std::uint16_t empty = 0xFFFF;
    std::array<std::uint16_t, 1024> slots_;
};

/// Colours that agree in their five upper bits.
struct ColourCell {
    std::array<std::uint64_t, 3> sums{};  // sums over up to 100 million pixels
    std::uint64_t count = 0;

    int mean(std::size_t channel) const { return static_cast<int>((sums[channel] + count / 2) / count); }
};

constexpr std::size_t cells = std::size_t{1} << 15U;
std::size_t cell_of(int red, int green, int blue) {
    return static_cast<std::size_t>(red >> 3) << 10U | static_cast<std::size_t>(green >> 3) << 5U |
           static_cast<std::size_t>(blue >> 3);
}

/// The colours of cells in at most `most` groups, which are halved at the median of their longest side, the one with
/// the largest sum of squares first. Source: Heckbert 1982.
std::vector<std::uint32_t> median_cut(const std::vector<ColourCell>& all, std::size_t most) {
    struct Group {
        std::size_t begin, end;
        std::size_t channel = 0;
        double spread = 0;
    };
    std::vector<std::uint32_t> used;
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (all[i].count > 0) used.push_back(i);
    }
    const auto measure = [&](Group& group) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            double count = 0, sum = 0, squares = 0;
            for (std::size_t i = group.begin; i < group.end; ++i) {
                const ColourCell& cell = all[used[i]];
                const double value = cell.mean(channel), times = static_cast<double>(cell.count);
                count += times;
                sum += times * value;
                squares += times * value * value;
            }
            const double spread = squares - sum * sum / count;
            if (group.end - group.begin > 1 && spread > group.spread) {
                group.spread = spread;
                group.channel = channel;
            }
        }
    };
    std::vector<Group> groups{{0, used.size()}};
    measure(groups.front());
    while (groups.size() < most) {
        const auto widest = std::max_element(groups.begin(), groups.end(),
                                             [](const Group& a, const Group& b) { return a.spread < b.spread; });
        if (!(widest->spread > 0)) break;
        const Group whole = *widest;
        const auto begin = used.begin() + static_cast<std::ptrdiff_t>(whole.begin);
        const auto end = used.begin() + static_cast<std::ptrdiff_t>(whole.end);
        std::sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(all[a].mean(whole.channel), a) < std::pair(all[b].mean(whole.channel), b);
        });
        std::uint64_t total = 0, below = 0;
        for (auto at = begin; at != end; ++at) total += all[*at].count;
        std::size_t middle = whole.begin;
        while (middle + 1 < whole.end && (middle == whole.begin || 2 * below < total)) {
            below += all[used[middle++]].count;
        }
        Group low{whole.begin, middle}, high{middle, whole.end};
        measure(low);
        measure(high);
        *widest = low;
        groups.push_back(high);
    }
    std::vector<std::uint32_t> palette;
    for (const Group& group : groups) {
        std::array<std::uint64_t, 3> sums{};
        std::uint64_t count = 0;
        for (std::size_t i = group.begin; i < group.end; ++i) {
            const ColourCell& cell = all[used[i]];
            for (std::size_t channel = 0; channel < 3; ++channel) sums[channel] += cell.sums[channel];
            count += cell.count;
        }
        std::uint32_t colour = 0;
        for (const std::uint64_t sum : sums)
            colour = colour << 8U | static_cast<std::uint32_t>((sum + count / 2) / count);
        palette.push_back(colour);
    }
    return palette;
}

int channel_of(std::uint32_t colour, std::size_t channel) {
    return static_cast<int>(colour >> (16 - 8 * channel) & 0xFFU);
}

/// Packs codes of growing width into blocks of at most 255 bytes.
class CodeBlocks {
public:
    explicit CodeBlocks(std::string& bytes) : bytes_(bytes) {}
    void put(unsigned code, int width) {
        held_ |= static_cast<std::uint64_t>(code) << bits_;
        bits_ += width;
        while (bits_ >= 8) add();
    }
    void finish() {
        if (bits_ > 0) add();
        flush();
        bytes_ += '\0';
    }

private:
    void add() {
        block_ += static_cast<char>(held_ & 0xFFU);
        held_ >>= 8U;
        bits_ = std::max(0, bits_ - 8);
        if (block_.size() == 255) flush();
    }
    void flush() {
        if (block_.empty()) return;
        bytes_ += static_cast<char>(block_.size());
        bytes_ += block_;
        block_.clear();
    }
    std::string& bytes_;
    std::string block_;
    std::uint64_t held_ = 0;
    int bits_ = 0;
};

/// The codes of known strings by prefix and last byte.
class CodeTable {
public:
    CodeTable() : entries_(size) {}
    void clear() { ++generation_; }
    /// The code of a prefix with one byte more; if there is none, -1, and it is added as `code`.
    int find_or_add(unsigned prefix, unsigned byte, unsigned code) {
        const std::uint32_t key = prefix << 8U | byte;
        std::size_t slot = (key * 0x9e3779b1U) >> 18U;
        for (; entries_[slot].generation == generation_; slot = (slot + 1) % size) {
            if (entries_[slot].key == key) return entries_[slot].code;
        }
        entries_[slot] = {key, generation_, static_cast<std::uint16_t>(code)};
        return -1;
    }

private:
    static constexpr std::size_t size = std::size_t{1} << 14U;
    struct Entry {
        std::uint32_t key = 0, generation = 0;
        std::uint16_t code = 0;
    };
    std::vector<Entry> entries_;
    std::uint32_t generation_ = 1;
};

}  // namespace

GifWriter::GifWriter(Output& output, int width, int height) : output_(output), width_(width), height_(height) {
    if (std::max(width, height) > 65'535 || std::int64_t{width} * height > 100'000'000) {
        throw std::runtime_error("a GIF has at most 65,535 pixels per side and 100 million in all");
    }
    output_.write("GIF89a");
    put_word(static_cast<unsigned>(width));
    put_word(static_cast<unsigned>(height));
    put({0x70, 0, 0});  // 8 bits a channel, without a common table of colours
    put({0x21, 0xFF, 11});
    output_.write("NETSCAPE2.0");
    put({3, 1, 0, 0, 0});  // repeats without end
}

void GifWriter::put(std::initializer_list<unsigned> bytes) {
    std::string text;
    for (const unsigned byte : bytes) text += static_cast<char>(byte);
    output_.write(text);
}

bool GifWriter::is_changed(std::span<const std::uint8_t> pixels, std::size_t pixel) const {
    if (!is_begun_) return true;
    const std::uint8_t *now = &pixels[3 * pixel], *before = &shown_[3 * pixel];
    return now[0] != before[0] || now[1] != before[1] || now[2] != before[2];
}

GifWriter::Rectangle GifWriter::changed(std::span<const std::uint8_t> pixels) const {
    if (!is_begun_) return {0, 0, width_, height_};
    const auto row = [&](const auto& picture, int y) {
        return picture.begin() + static_cast<std::ptrdiff_t>(y) * width_ * 3;
    };
    const auto is_same = [&](int y) { return std::equal(row(pixels, y), row(pixels, y + 1), row(shown_, y)); };
    Rectangle area{width_, 0, 0, height_};
    while (area.top < height_ && is_same(area.top)) ++area.top;
    // A frame has at least one pixel.
    if (area.top == height_) return {0, 0, 1, 1};
    while (is_same(area.bottom - 1)) --area.bottom;
    for (int y = area.top; y < area.bottom; ++y) {
        const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
        for (int x = 0; x < area.left; ++x) {
            if (is_changed(pixels, first + static_cast<std::size_t>(x))) area.left = x;
        }
        for (int x = width_ - 1; x >= area.right; --x) {
            if (is_changed(pixels, first + static_cast<std::size_t>(x))) area.right = x + 1;
        }
    }
    return area;
}

std::size_t GifWriter::index_exactly(std::span<const std::uint8_t> pixels, const Rectangle& area) {
    constexpr std::uint8_t unchanged = most_colours;
    ColourNumbers numbers;
    indices_.clear();
    std::uint32_t last = 0;
    std::size_t last_number = most_colours;
    for (int y = area.top; y < area.bottom; ++y) {
        for (int x = area.left; x < area.right; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
            if (!is_changed(pixels, pixel)) {
                indices_.push_back(unchanged);
                continue;
            }
            const std::uint8_t* from = &pixels[3 * pixel];
            const std::uint32_t colour =
                std::uint32_t{from[0]} << 16U | std::uint32_t{from[1]} << 8U | std::uint32_t{from[2]};
            if (colour != last || last_number == most_colours) {
                last = colour;
                last_number = numbers.number(colour);
                if (last_number == most_colours) return 0;
            }
            indices_.push_back(static_cast<std::uint8_t>(last_number));
        }
    }
    palette_ = std::move(numbers.colours);
    const std::size_t transparent = palette_.size();
    std::replace(indices_.begin(), indices_.end(), unchanged, static_cast<std::uint8_t>(transparent));
    palette_.push_back(0);
    return transparent;
}

std::size_t GifWriter::index_diffused(std::span<const std::uint8_t> pixels, const Rectangle& area) {
    std::vector<ColourCell> histogram(cells);
    const auto width = static_cast<std::size_t>(width_);
    for (int y = area.top; y < area.bottom; ++y) {
        for (int x = area.left; x < area.right; ++x) {
            const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            if (!is_changed(pixels, pixel)) continue;
            const std::uint8_t* from = &pixels[3 * pixel];
            ColourCell& cell = histogram[cell_of(from[0], from[1], from[2])];
            for (std::size_t channel = 0; channel < 3; ++channel) cell.sums[channel] += from[channel];
            ++cell.count;
        }
    }
    palette_ = median_cut(histogram, most_colours);
    const std::size_t transparent = palette_.size();
    constexpr std::uint16_t unknown = 0xFFFF;
    std::vector<std::uint16_t> nearest(cells, unknown);
    const auto find_nearest = [&](std::size_t number) {
        const ColourCell& cell = histogram[number];
        std::array<int, 3> wanted{};
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const auto bits = static_cast<int>(number >> (10 - 5 * channel) & 31U);
            wanted[channel] = cell.count > 0 ? cell.mean(channel) : 8 * bits + 4;
        }
        int least = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i < palette_.size(); ++i) {
            int square = 0;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const int off = wanted[channel] - channel_of(palette_[i], channel);
                square += off * off;
            }
            if (square >= least) continue;
            least = square;
            nearest[number] = static_cast<std::uint16_t>(i);
        }
        return nearest[number];
    };
    // Rounding errors carried to the pixels of this row and the next, in sixteenths.
    const auto across = static_cast<std::size_t>(area.right - area.left);
    std::vector<std::array<int, 3>> errors(across + 2), below(across + 2);
    indices_.clear();
    for (int y = area.top; y < area.bottom; ++y) {
        std::fill(below.begin(), below.end(), std::array<int, 3>{});
        for (std::size_t x = 0; x < across; ++x) {
            const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(area.left) + x;
            if (!is_changed(pixels, pixel)) {
                indices_.push_back(static_cast<std::uint8_t>(transparent));
                continue;
            }
            const std::uint8_t* from = &pixels[3 * pixel];
            std::array<int, 3> wanted{};
            for (std::size_t channel = 0; channel < 3; ++channel) {
                wanted[channel] = std::clamp(from[channel] + errors[x + 1][channel] / 16, 0, 255);
            }
            const std::size_t cell = cell_of(wanted[0], wanted[1], wanted[2]);
            const std::uint16_t index = nearest[cell] != unknown ? nearest[cell] : find_nearest(cell);
            indices_.push_back(static_cast<std::uint8_t>(index));
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const int error = wanted[channel] - channel_of(palette_[index], channel);
                errors[x + 2][channel] += 7 * error;
                below[x][channel] += 3 * error;
                below[x + 1][channel] += 5 * error;
                below[x + 2][channel] += error;
            }
        }
        errors.swap(below);
    }
    palette_.push_back(0);
    return transparent;
}

void GifWriter::frame(std::span<const std::uint8_t> pixels, double seconds) {
    const Rectangle area = changed(pixels);
    palette_.clear();
    std::size_t transparent = index_exactly(pixels, area);
    if (palette_.empty()) transparent = index_diffused(pixels, area);
    write_picture(area, transparent, seconds);
    shown_.assign(pixels.begin(), pixels.end());
    is_begun_ = true;
}

void GifWriter::write_picture(const Rectangle& area, std::size_t transparent, double seconds) {
    const auto hundredths = static_cast<unsigned>(std::lround(std::clamp(seconds, 0.01, 655.0) * 100));
    put({0x21, 0xF9, 4, 0x05});  // stays on the screen; has a transparent colour
    put_word(hundredths);
    put({static_cast<unsigned>(transparent), 0});
    int bits = 1;
    while ((std::size_t{1} << static_cast<unsigned>(bits)) < palette_.size()) ++bits;
    put({0x2C});
    for (const int place : {area.left, area.top, area.right - area.left, area.bottom - area.top}) {
        put_word(static_cast<unsigned>(place));
    }
    put({0x80U | static_cast<unsigned>(bits - 1)});
    std::string table;
    for (std::size_t i = 0; i < std::size_t{1} << static_cast<unsigned>(bits); ++i) {
        const Colour colour = i < palette_.size() ? palette_[i] : 0;
        for (std::size_t channel = 0; channel < 3; ++channel) table += static_cast<char>(channel_of(colour, channel));
    }
    output_.write(table);
    write_codes(std::max(bits, 2));
}

/// Source: GIF89a specification, appendix F; Welch 1984.
void GifWriter::write_codes(int bits) {
    constexpr unsigned most_codes = 4096;
    const unsigned clear = 1U << static_cast<unsigned>(bits), end = clear + 1;
    std::string bytes(1, static_cast<char>(bits));
    CodeBlocks blocks(bytes);
    CodeTable table;
    int width = bits + 1;
    unsigned next = end + 1;
    blocks.put(clear, width);
    unsigned prefix = indices_.front();
    for (std::size_t i = 1; i < indices_.size(); ++i) {
        const unsigned byte = indices_[i];
        const int known = table.find_or_add(prefix, byte, next);
        if (known >= 0) {
            prefix = static_cast<unsigned>(known);
            continue;
        }
        blocks.put(prefix, width);
        prefix = byte;
        if (next++ == 1U << static_cast<unsigned>(width)) ++width;
        if (next < most_codes) continue;
        blocks.put(clear, width);
        table.clear();
        next = end + 1;
        width = bits + 1;
    }
    blocks.put(prefix, width);
    if (next == 1U << static_cast<unsigned>(width) && width < 12) ++width;
    blocks.put(end, width);
    blocks.finish();
    output_.write(bytes);
}

void GifWriter::comment(std::span<const std::string> pieces) {
    if (pieces.empty()) return;
    put({0x21, 0xFE});
    for (const std::string& piece : pieces) {
        put({static_cast<unsigned>(piece.size())});
        output_.write(piece);
    }
    put({0});
}

void GifWriter::close() {
    put({0x3B});
}

}  // namespace sikku
