#include "art/image/row_deflate.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#if defined(__x86_64__)
#include <emmintrin.h>
#endif

namespace sikku {
namespace {

constexpr std::size_t window = 32768;
constexpr std::size_t shortest = 3, longest = 258;
constexpr std::size_t hashed = 4;  // bytes
constexpr unsigned hash_bits = 15, three_bits = 12;
constexpr std::size_t most_of_three = 4096;                     // their distance
constexpr std::size_t most_symbols = 16384;                     // of a block
constexpr std::uint32_t three = 0xFF'FFFF, four = 0xFFFF'FFFF;  // masks of the first bytes of a number
constexpr std::size_t end_of_block = 256;
constexpr std::uint32_t match_mark = 0x8000'0000;
constexpr unsigned longest_code = 15, longest_length_code = 7;

struct MatchEffort {
    int tries;
    std::size_t good_length;
    bool is_lazy;
    bool remembers_all;
};
/// By level, 1 to 9.
constexpr std::array<MatchEffort, 9> efforts = {MatchEffort{1, 16, false, false},
                                                {2, 24, false, false},
                                                {4, 32, false, false},
                                                {4, 32, true, false},
                                                {8, 48, true, false},
                                                {16, 96, true, false},
                                                {48, 258, true, false},
                                                {160, 258, true, true},
                                                {1000, 258, true, true}};

std::uint32_t four_bytes(const char* bytes) {
    const auto at = [bytes](int i) { return std::uint32_t{static_cast<unsigned char>(bytes[i])}; };
    return at(0) | at(1) << 8U | at(2) << 16U | at(3) << 24U;
}

std::size_t hash_of(std::uint32_t bytes, unsigned bits) {
    return bytes * 0x9E37'79B1U >> (32 - bits);
}

bool are_eight_equal(const char* a, const char* b) {
    return std::memcmp(a, b, 8) == 0;
}

/// The number of equal bytes, at most `most`.
std::size_t equal_bytes(const char* a, const char* b, std::size_t most) {
    std::size_t count = 0;
    while (count + 8 <= most && are_eight_equal(a + count, b + count)) count += 8;
    while (count < most && a[count] == b[count]) ++count;
    return count;
}

/// A symbol of deflate and the bits that follow it.
struct Symbol {
    std::size_t code;
    unsigned extra_bits;
    std::uint32_t extra;
};

unsigned highest_bit(std::uint32_t number) {
    return 31U - static_cast<unsigned>(std::countl_zero(number));
}

Symbol length_symbol(std::uint32_t length) {
    const auto more = length - static_cast<std::uint32_t>(shortest);
    if (length == longest) return {285, 0, 0};
    if (more < 8) return {257 + more, 0, 0};
    const unsigned high = highest_bit(more);
    return {257 + 4 * (high - 1) + (more >> (high - 2) & 3U), high - 2, more & ((1U << (high - 2)) - 1)};
}

Symbol distance_symbol(std::uint32_t distance) {
    const std::uint32_t more = distance - 1;
    if (more < 4) return {more, 0, 0};
    const unsigned high = highest_bit(more);
    return {2 * high + (more >> (high - 1) & 1U), high - 1, more & ((1U << (high - 1)) - 1)};
}

std::uint32_t length_of(std::uint32_t symbol) {
    return (symbol >> 15U & 0xFFU) + static_cast<std::uint32_t>(shortest);
}
std::uint32_t distance_of(std::uint32_t symbol) {
    return (symbol & 0x7FFFU) + 1;
}

/// A prefix code, by symbol: the number of bits, 0 if the symbol does not occur, and the bits from the lowest on.
struct PrefixCode {
    std::vector<std::uint8_t> lengths;
    std::vector<std::uint16_t> bits;
};

/// The numbers of bits in an optimal prefix code of symbols with ascending counts, longest code first (Moffat and
/// Katajainen 1995, In-place calculation of minimum-redundancy codes).
std::vector<std::uint32_t> optimal_lengths(std::vector<std::uint32_t> a) {
    const std::size_t n = a.size();
    std::size_t leaf = 0, root = 0;
    const auto take = [&](std::size_t next) {
        if (leaf >= n || (root < next && a[root] < a[leaf])) {
            const std::uint32_t count = a[root];
            a[root++] = static_cast<std::uint32_t>(next);
            return count;
        }
        return a[leaf++];
    };
    for (std::size_t next = 0; next + 1 < n; ++next) {
        const std::uint32_t first = take(next);
        a[next] = first + take(next);
    }
    // Parents become depths of inner nodes, and these the numbers of bits of leaves.
    a[n - 2] = 0;
    for (std::size_t next = n - 2; next-- > 0;) a[next] = a[a[next]] + 1;
    std::size_t free = 1, depth = 0, inner = n - 1, next = n;
    while (free > 0) {
        std::size_t used = 0;
        for (; inner > 0 && a[inner - 1] == depth; --inner) ++used;
        for (; free > used; --free) a[--next] = static_cast<std::uint32_t>(depth);
        free = 2 * used;
        ++depth;
    }
    return a;
}

/// @param counts  how often each symbol occurs
/// @param most    bits of a code
PrefixCode prefix_code(std::span<const std::uint32_t> counts, unsigned most) {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) used.push_back(i);
    }
    // Some readers refuse codes of fewer than two symbols.
    for (std::size_t i = 0; used.size() < 2; ++i) {
        if (counts[i] == 0) used.push_back(i);
    }
    std::sort(used.begin(), used.end(),
              [&](std::size_t a, std::size_t b) { return counts[a] != counts[b] ? counts[a] < counts[b] : a < b; });
    std::vector<std::uint32_t> weights;
    for (const std::size_t symbol : used) weights.push_back(std::max(counts[symbol], 1U));
    std::array<std::uint32_t, 64> of_length{};
    for (const std::uint32_t length : optimal_lengths(std::move(weights))) ++of_length[std::min(length, most)];
    // Shortened codes displace others, which become longer.
    std::uint64_t places = 0;
    for (unsigned length = 1; length <= most; ++length) places += std::uint64_t{of_length[length]} << (most - length);
    for (; places > std::uint64_t{1} << most; --places) {
        unsigned length = most - 1;
        while (of_length[length] == 0) --length;
        --of_length[most];
        --of_length[length];
        of_length[length + 1] += 2;
    }
    PrefixCode code{std::vector<std::uint8_t>(counts.size()), std::vector<std::uint16_t>(counts.size())};
    auto symbol = used.begin();
    for (unsigned length = most; length > 0; --length) {
        for (std::uint32_t i = 0; i < of_length[length]; ++i)
            code.lengths[*symbol++] = static_cast<std::uint8_t>(length);
    }
    std::array<std::uint32_t, 17> next{};
    for (unsigned length = 1; length <= most; ++length) next[length + 1] = (next[length] + of_length[length]) << 1U;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const unsigned length = code.lengths[i];
        if (length == 0) continue;
        std::uint32_t forwards = next[length]++, backwards = 0;
        for (unsigned bit = 0; bit < length; ++bit, forwards >>= 1U) backwards = backwards << 1U | (forwards & 1U);
        code.bits[i] = static_cast<std::uint16_t>(backwards);
    }
    return code;
}

class BitWriter {
public:
    explicit BitWriter(std::string& bytes) : bytes_(bytes) {}
    /// @param count  at most 32
    void put(std::uint32_t bits, unsigned count) {
        held_ |= std::uint64_t{bits} << count_;
        count_ += count;
        if (count_ < 32) return;
        for (int i = 0; i < 4; ++i, held_ >>= 8U) block_[size_++] = static_cast<char>(held_);
        count_ -= 32;
        if (size_ == block_.size()) pass_on();
    }
    void put(const PrefixCode& code, std::size_t symbol) { put(code.bits[symbol], code.lengths[symbol]); }
    void put(const PrefixCode& code, const Symbol& symbol) {
        put(code, symbol.code);
        put(symbol.extra, symbol.extra_bits);
    }
    /// Fills the last byte with zeros and appends all bytes to the string.
    void align() {
        pass_on();
        for (; count_ > 0; count_ -= std::min(count_, 8U), held_ >>= 8U) bytes_ += static_cast<char>(held_);
        held_ = 0;
    }
    /// Appends blocks that are not compressed.
    void put_stored(std::string_view bytes, bool is_last) {
        constexpr std::size_t most = 0xFFFF;
        do {
            const std::string_view part = bytes.substr(0, most);
            bytes.remove_prefix(part.size());
            put(is_last && bytes.empty() ? 1 : 0, 3);
            align();
            const auto size = static_cast<std::uint32_t>(part.size());
            put(size | (~size << 16U), 32);
            align();
            bytes_ += part;
        } while (!bytes.empty());
    }

private:
    void pass_on() {
        bytes_.append(block_.data(), size_);
        size_ = 0;
    }

    std::string& bytes_;
    std::uint64_t held_ = 0;
    unsigned count_ = 0;
    std::size_t size_ = 0;
    std::array<char, 4096> block_{};
};

/// The lengths of both codes of a block in their own code (RFC 1951, section 3.2.7).
class CodeLengths {
public:
    CodeLengths(const PrefixCode& literals, const PrefixCode& distances)
        : literals_(used(literals, 257)), distances_(used(distances, 1)) {
        std::vector<std::uint8_t> all(literals.lengths.begin(), literals.lengths.begin() + literals_);
        all.insert(all.end(), distances.lengths.begin(), distances.lengths.begin() + distances_);
        for (std::size_t at = 0; at < all.size();) {
            std::size_t count = 1;
            while (at + count < all.size() && all[at + count] == all[at]) ++count;
            at += count;
            add(all[at - 1], count);
        }
        std::array<std::uint32_t, 19> counts{};
        for (const Symbol& symbol : symbols_) ++counts[symbol.code];
        code_ = prefix_code(counts, longest_length_code);
        written_ = order.size();
        while (written_ > 4 && code_.lengths[order[written_ - 1]] == 0) --written_;
    }

    std::uint64_t bits() const {
        std::uint64_t sum = 14 + 3 * written_;
        for (const Symbol& symbol : symbols_) sum += code_.lengths[symbol.code] + symbol.extra_bits;
        return sum;
    }
    void write(BitWriter& out) const {
        out.put(static_cast<std::uint32_t>(literals_ - 257), 5);
        out.put(static_cast<std::uint32_t>(distances_ - 1), 5);
        out.put(static_cast<std::uint32_t>(written_ - 4), 4);
        for (std::size_t i = 0; i < written_; ++i) out.put(code_.lengths[order[i]], 3);
        for (const Symbol& symbol : symbols_) out.put(code_, symbol);
    }

private:
    static constexpr std::array<std::uint8_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                           11, 4,  12, 3, 13, 2, 14, 1, 15};

    static std::ptrdiff_t used(const PrefixCode& code, std::ptrdiff_t least) {
        auto size = static_cast<std::ptrdiff_t>(code.lengths.size());
        while (size > least && code.lengths[static_cast<std::size_t>(size - 1)] == 0) --size;
        return size;
    }
    /// Adds a length that occurs so many times in a row.
    void add(std::uint8_t length, std::size_t count) {
        if (length > 0) {
            symbols_.push_back({length, 0, 0});
            --count;
        }
        while (count >= 3) {
            const std::size_t most = length > 0 ? 6 : 138;
            const std::size_t part = std::min(count, most);
            count -= part;
            const auto repeats = static_cast<std::uint32_t>(part);
            if (length > 0) {
                symbols_.push_back({16, 2, repeats - 3});
            } else if (part <= 10) {
                symbols_.push_back({17, 3, repeats - 3});
            } else {
                symbols_.push_back({18, 7, repeats - 11});
            }
        }
        for (; count > 0; --count) symbols_.push_back({length, 0, 0});
    }

    std::ptrdiff_t literals_, distances_;
    std::size_t written_ = 0;
    std::vector<Symbol> symbols_;
    PrefixCode code_;
};

/// Writes a block in the shorter form: with codes of its own, or as it is.
/// @param covered  the bytes that the symbols stand for
void write_block(std::span<const std::uint32_t> symbols, std::span<const std::uint32_t> counts,
                 std::span<const std::uint32_t> distance_counts, std::string_view covered, bool is_last,
                 BitWriter& out) {
    const PrefixCode literals = prefix_code(counts, longest_code);
    const PrefixCode distances = prefix_code(distance_counts, longest_code);
    const CodeLengths lengths(literals, distances);
    std::uint64_t bits = 3 + lengths.bits();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const unsigned extra = i < 265 || i == 285 ? 0 : static_cast<unsigned>(i - 261) / 4;
        bits += std::uint64_t{counts[i]} * (literals.lengths[i] + extra);
    }
    for (std::size_t i = 0; i < distance_counts.size(); ++i) {
        const unsigned extra = i < 4 ? 0 : static_cast<unsigned>(i) / 2 - 1;
        bits += std::uint64_t{distance_counts[i]} * (distances.lengths[i] + extra);
    }
    if (bits / 8 > covered.size() + 5 * (covered.size() / 0xFFFF + 1)) return out.put_stored(covered, is_last);
    constexpr unsigned own_codes = 2;
    out.put((is_last ? 1U : 0U) | own_codes << 1U, 3);
    lengths.write(out);
    for (const std::uint32_t symbol : symbols) {
        if ((symbol & match_mark) == 0) {
            out.put(literals, symbol);
        } else {
            out.put(literals, length_symbol(length_of(symbol)));
            out.put(distances, distance_symbol(distance_of(symbol)));
        }
    }
    out.put(literals, end_of_block);
}

}  // namespace

/// Where bytes occurred, in pieces of less than 4 GB. Places are numbered from 1; 0 stands for none.
struct RowDeflater::Places {
    std::array<std::uint32_t, std::size_t{1} << hash_bits> last;            ///< by hash of four bytes
    std::array<std::uint32_t, std::size_t{1} << three_bits> last_of_three;  ///< by hash of three bytes
    std::array<std::uint32_t, window> before;  ///< by place: the one before it with the same hash of four bytes

    void clear() {
        last.fill(0);
        last_of_three.fill(0);
    }
};

// Places are not initialised: new pages cost more time than compressing a small picture.
RowDeflater::RowDeflater(int level, std::size_t pixel_bytes) : pixel_bytes_(pixel_bytes), places_(new Places) {
    const MatchEffort& effort = efforts[static_cast<std::size_t>(std::clamp(level, 1, 9) - 1)];
    tries_ = effort.tries;
    good_length_ = effort.good_length;
    is_lazy_ = effort.is_lazy;
    remembers_all_ = effort.remembers_all;
    symbols_.reserve(most_symbols);
}

RowDeflater::RowDeflater(RowDeflater&&) noexcept = default;
RowDeflater::~RowDeflater() = default;

void RowDeflater::compress(std::string_view piece, bool is_last, std::string& packed) {
    BitWriter out(packed);
    piece_ = piece;
    remembered_ = 0;
    last_distance_ = 0;
    places_->clear();
    std::size_t block_begin = 0;
    std::size_t at = 0;
    const auto end_block = [&](bool ends_stream) {
        counts_[end_of_block] = 1;
        write_block(symbols_, counts_, distance_counts_, piece.substr(block_begin, at - block_begin), ends_stream,
                    out);
        symbols_.clear();
        counts_.fill(0);
        distance_counts_.fill(0);
        block_begin = at;
    };
    std::optional<Match> found;  // at this place
    while (at < piece.size()) {
        Match match = found ? *std::exchange(found, {}) : find(at);
        if (is_lazy_) {
            while (match.length > 0 && match.length < good_length_) {
                const Match next = find(at + 1);
                if (next.length <= match.length) break;
                add_literal(at++);
                match = next;
            }
        }
        if (match.length == 0) {
            add_literal(at++);
            if (symbols_.size() >= most_symbols && at < piece.size()) end_block(false);
            continue;
        }
        remember_matched(at, match);
        if (match.distance == pixel_bytes_) {
            // The rest of a run is often a part of what was there before with the same end.
            const std::size_t end = at + match.length;
            const std::size_t rest = match.length % longest;
            Match next = find(end);
            if (next.length > 0 && next.distance != pixel_bytes_ && rest > 0 && end - rest >= next.distance &&
                piece.substr(end - rest, rest) == piece.substr(end - rest - next.distance, rest)) {
                match.length -= rest;
                if (match.length > 0) add_match(match);
                next.length = std::min(next.length, longest - rest);
                remember_matched(end, next);
                next.length += rest;
                at = end - rest;
                match = next;
            } else {
                found = next;
            }
        }
        add_match(match);
        at += match.length;
        // A match of a whole piece adds some thousand symbols.
        if (symbols_.size() >= most_symbols && at < piece.size()) end_block(false);
    }
    end_block(is_last);
    if (is_last) {
        out.align();
    } else {
        out.put_stored({}, false);
    }
}

/// The best match that is found at a place.
RowDeflater::Match RowDeflater::find(std::size_t at) {
    const char* const bytes = piece_.data() + at;
    const std::size_t most = piece_.size() - std::min(at, piece_.size());
    Match best;
    if (most < hashed) return best;
    const std::uint32_t first = four_bytes(bytes);
    const auto look = [&](std::size_t distance, std::uint32_t mask, std::size_t at_most) {
        if (((four_bytes(bytes - distance) ^ first) & mask) != 0) return;
        if (best.length >= at_most || bytes[best.length] != (bytes - distance)[best.length]) return;
        const std::size_t length = equal_bytes(bytes, bytes - distance, at_most);
        if (length > best.length) best = {length, distance};
    };
    if (at >= pixel_bytes_) look(pixel_bytes_, three, most);
    // Repeating a pixel takes fewer bits than longer matches elsewhere.
    const std::size_t at_most = std::min(most, longest);
    if (last_distance_ != pixel_bytes_ && last_distance_ > 0 && at >= last_distance_ && best.length < good_length_) {
        look(last_distance_, three, at_most);
    }
    std::uint32_t place = places_->last[hash_of(first, hash_bits)];
    const std::uint32_t three_place = places_->last_of_three[hash_of(first & three, three_bits)];
    remember(at);
    for (int i = 0; i < tries_ && place > 0 && at + 1 - place <= window && best.length < good_length_; ++i) {
        look(at + 1 - place, four, at_most);
        place = places_->before[(place - 1) % window];
    }
    // Three bytes are worth a small distance.
    if (best.length < shortest && three_place > 0 && at + 1 - three_place <= most_of_three) {
        look(at + 1 - three_place, three, at_most);
    }
    return best;
}

void RowDeflater::remember(std::size_t at) {
    if (at < remembered_ || at + hashed > piece_.size()) return;
    const std::uint32_t bytes = four_bytes(piece_.data() + at);
    std::uint32_t& last = places_->last[hash_of(bytes, hash_bits)];
    places_->before[at % window] = last;
    last = static_cast<std::uint32_t>(at + 1);
    places_->last_of_three[hash_of(bytes & three, three_bits)] = last;
    remembered_ = at + 1;
}

/// Remembers the places in a match, but not those in runs of a colour, which cost time and are rarely useful.
void RowDeflater::remember_matched(std::size_t at, const Match& match) {
    const std::size_t end = std::min(at + match.length, piece_.size() - std::min<std::size_t>(piece_.size(), 8));
    if (match.distance == pixel_bytes_)
        at += match.length - std::min<std::size_t>(match.length, remembers_all_ ? longest : hashed - 1);
    while (at < end) {
        if (!remembers_all_ && at >= pixel_bytes_ &&
            are_eight_equal(piece_.data() + at, piece_.data() + at - pixel_bytes_)) {
            at += 8 - hashed + 1;
        } else {
            remember(at++);
        }
    }
}

void RowDeflater::add_literal(std::size_t at) {
    const auto value = static_cast<unsigned char>(piece_[at]);
    symbols_.push_back(value);
    ++counts_[value];
}

void RowDeflater::add_match(Match match) {
    last_distance_ = match.distance;
    while (match.length > 0) {
        std::size_t part = std::min(match.length, longest);
        if (const std::size_t rest = match.length - part; rest > 0 && rest < shortest) part = match.length - shortest;
        match.length -= part;
        symbols_.push_back(match_mark | static_cast<std::uint32_t>((part - shortest) << 15U | (match.distance - 1)));
        ++counts_[length_symbol(static_cast<std::uint32_t>(part)).code];
        ++distance_counts_[distance_symbol(static_cast<std::uint32_t>(match.distance)).code];
    }
}

std::uint32_t adler32_of(std::uint32_t before, std::string_view bytes) {
    constexpr std::uint32_t modulus = 65521;
    std::uint32_t sum = before & 0xFFFFU, sums = before >> 16U;
    const auto add = [&](std::string_view part) {
        for (const char byte : part) sums += sum += static_cast<unsigned char>(byte);
        sum %= modulus;
        sums %= modulus;
    };
#if defined(__x86_64__)
    // Sixteen bytes at a time; the lanes of 32 bits hold so many of them.
    constexpr std::size_t step = 16, most_steps = 256;
    const __m128i zero = _mm_setzero_si128();
    const __m128i high_weights = _mm_setr_epi16(16, 15, 14, 13, 12, 11, 10, 9);
    const __m128i low_weights = _mm_setr_epi16(8, 7, 6, 5, 4, 3, 2, 1);
    const auto total = [](__m128i lanes) {
        std::array<std::uint32_t, 4> values{};
        std::memcpy(values.data(), &lanes, sizeof values);
        return values[0] + values[1] + values[2] + values[3];
    };
    while (bytes.size() >= step) {
        const std::size_t steps = std::min(bytes.size() / step, most_steps);
        __m128i plain = zero, before_each = zero, weighted = zero;
        for (std::size_t i = 0; i < steps; ++i) {
            __m128i block;
            std::memcpy(&block, bytes.data() + i * step, step);
            before_each = _mm_add_epi32(before_each, plain);
            plain = _mm_add_epi32(plain, _mm_sad_epu8(block, zero));
            weighted = _mm_add_epi32(weighted, _mm_madd_epi16(_mm_unpacklo_epi8(block, zero), high_weights));
            weighted = _mm_add_epi32(weighted, _mm_madd_epi16(_mm_unpackhi_epi8(block, zero), low_weights));
        }
        const auto count = static_cast<std::uint32_t>(steps * step);
        sums = static_cast<std::uint32_t>(
            (sums + std::uint64_t{sum} * count + std::uint64_t{step} * total(before_each) + total(weighted)) %
            modulus);
        sum = (sum + total(plain)) % modulus;
        bytes.remove_prefix(count);
    }
#endif
    constexpr std::size_t most = 5552;  // until the sums exceed 32 bits
    for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), most))) add(bytes.substr(0, most));
    return sum | sums << 16U;
}

}  // namespace sikku
