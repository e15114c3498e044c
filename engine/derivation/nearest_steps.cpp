#include "engine/derivation/nearest_steps.h"

#include "engine/base/threads.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_small_symbols = 128;
constexpr std::size_t most_outcomes = std::size_t{1} << 15;
constexpr std::size_t between_pauses = std::size_t{1} << 20;  // symbols of a thread
constexpr std::size_t least_for_threads = std::size_t{1} << 18;
constexpr std::size_t scan_block = 4096;

/// Calls first(begin, end) for parts of [0, size) and other(begin, end) for parts of [0, other_size), pairs of them
/// in parallel, and `pause` between the pairs.
template <class First, class Other>
void in_parallel(std::size_t size, const First& first, std::size_t other_size, const Other& other,
                 const std::function<void()>& pause) {
    const bool are_long = size + other_size >= least_for_threads;
    for (std::size_t done = 0; done < std::max(size, other_size); done += between_pauses) {
        if (done > 0) pause();
        const auto one = [&] {
            if (done < size) first(done, std::min(done + between_pauses, size));
        };
        const auto two = [&] {
            if (done < other_size) other(done, std::min(done + between_pauses, other_size));
        };
        if (are_long) {
            run_both(one, two);
        } else {
            one();
            two();
        }
    }
}

/// Number of bytes before the first one that is 128 or more; 8 if there is none.
std::size_t small_bytes(std::uint64_t eight) {
    const std::uint64_t large = eight & 0x8080808080808080U;
    const int bits = std::endian::native == std::endian::little ? std::countr_zero(large) : std::countl_zero(large);
    return static_cast<std::size_t>(bits) / 8;
}

}  // namespace

void RawBytes::resize(std::size_t size) {
    if (size > room_) {
        if (size > std::numeric_limits<std::size_t>::max() / 4) throw std::bad_alloc();
        bytes_.reset();
        room_ = 0;
        // Memory that is not written is not allocated.
        bytes_.reset(new std::uint8_t[2 * size]);
        room_ = 2 * size;
    }
    size_ = size;
}

/// The state of a scan.
struct NearestSteps::Scan {
    std::uint8_t seen = 0;
    std::vector<std::uint8_t> open = {0};  // for each open branch, the class seen before it, above an unused 0
    std::ptrdiff_t depth = 1;
    std::uint64_t length = 0;  // of the outcomes

    void make_room(std::size_t symbols) {
        const std::size_t needed = static_cast<std::size_t>(depth) + symbols;
        if (open.size() < needed) open.resize(2 * needed);
    }
};

NearestSteps::NearestSteps(const Grammar& grammar, const Table& table) {
    const std::size_t symbols = grammar.symbols().size();
    if (!grammar.is_plain() || symbols > most_small_symbols || grammar.cut()) return;
    const ContextChoices choices(grammar, table);
    // Classes to the left are counted in rows of those to the right.
    const std::size_t rows = choices.rights(), row_size = choices.lefts() * rows;
    if (!choices.looks_at_nearest() || row_size > 256 || symbols * row_size > most_outcomes) return;
    std::map<Word, Outcome> known;
    std::size_t next_code = first_text;
    for (Symbol symbol = 0; symbol < symbols; ++symbol) {
        known[Word{symbol}] = {static_cast<std::uint8_t>(symbol), 1};
        texts_[symbol].begin.fill(static_cast<std::uint8_t>(symbol));
    }
    for (Symbol symbol = 0; symbol < symbols; ++symbol) {
        const ContextChoices::Kind kind = choices.kind(symbol);
        const auto turn = [&](std::size_t own, bool is_opening, bool is_closing) {
            Turn result;
            result.opens = static_cast<std::int8_t>(is_opening ? 1 : is_closing ? -1 : 0);
            if (is_closing && !kind.is_ignored) {
                result.take = 0xFF;
            } else if (kind.is_ignored) {
                result.keep = 0xFF;
            } else {
                result.set = static_cast<std::uint8_t>(own);
            }
            return result;
        };
        Turn right = turn(kind.left * rows, kind.is_push, kind.is_pop);
        // Behind `[`, the left context is the symbol before it.
        if (kind.is_push && !kind.is_ignored) right = {0xFF, 0, 0, 1};
        to_right_.push_back(right);
        to_left_.push_back(turn(kind.right, kind.is_pop, kind.is_push));
        rows_.push_back(static_cast<std::uint32_t>(outcomes_.size()));
        for (std::size_t i = 0; i < row_size; ++i) {
            const Word* successor = nullptr;
            if (table.context_free()) {
                successor = table.successor(symbol);
            } else {
                const auto candidates = choices.candidates(kind.row + i);
                if (!candidates.empty()) successor = &table.production(candidates.front()).successor;
            }
            const Word& text = successor ? *successor : Word{symbol};
            if (text.size() > longest_text) return;
            const auto [found, is_new] = known.try_emplace(text);
            if (is_new) {
                if (next_code == texts_.size()) return;
                found->second = {static_cast<std::uint8_t>(next_code), static_cast<std::uint8_t>(text.size())};
                Text& stored = texts_[next_code++];
                stored.length = static_cast<std::uint32_t>(text.size());
                stored.pool = static_cast<std::uint32_t>(pool_.size());
                for (const Symbol part : text) pool_.push_back(static_cast<std::uint8_t>(part));
                std::copy_n(pool_.begin() + stored.pool, std::min(text.size(), stored.begin.size()),
                            stored.begin.begin());
            }
            outcomes_.push_back(found->second);
        }
    }
    is_usable_ = true;
}

template <bool to_left, bool is_second>
void NearestSteps::look(Scan& scan, std::size_t begin, std::size_t end) {
    const Turn* const turns = to_left ? to_left_.data() : to_right_.data();
    const std::uint32_t* const rows = rows_.data();
    const Outcome* const outcomes = outcomes_.data();
    const std::uint8_t* const word = word_;
    std::uint8_t* const marks = marks_.data();
    std::uint8_t seen = scan.seen;
    for (std::size_t done = begin; done < end; done += scan_block) {
        const std::size_t count = std::min(scan_block, end - done);
        scan.make_room(count);
        std::uint8_t* const open = scan.open.data();
        std::ptrdiff_t depth = scan.depth;
        std::uint64_t length = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = to_left ? end - 1 - (done - begin + i) : done + i;
            const std::uint8_t symbol = word[at];
            if (is_second) {
                const Outcome outcome = outcomes[rows[symbol] + seen + marks[at]];
                marks[at] = outcome.code;
                length += outcome.length;
            } else {
                marks[at] = seen;
            }
            const Turn turn = turns[symbol];
            if (turn.opens == 0) {
                seen = static_cast<std::uint8_t>((seen & turn.keep) | turn.set);
                continue;
            }
            const std::uint8_t before = open[depth - 1];
            open[depth] = seen;
            seen = static_cast<std::uint8_t>((seen & turn.keep) | (before & turn.take) | turn.set);
            depth = std::max(depth + turn.opens, std::ptrdiff_t{1});
        }
        scan.depth = depth;
        scan.length += length;
    }
    scan.seen = seen;
}

std::uint8_t* NearestSteps::write(std::size_t begin, std::size_t end, std::uint8_t* out,
                                  const std::uint8_t* out_end) const {
    const std::uint8_t* const marks = marks_.data();
    const Text* const texts = texts_.data();
    constexpr std::size_t eight = 8;
    while (end - begin > eight && out_end - out >= static_cast<std::ptrdiff_t>(2 * eight)) {
        // Most symbols are replaced by one symbol: up to eight of these, then one of any kind.
        std::uint64_t next;
        std::memcpy(&next, marks + begin, eight);
        std::memcpy(out, &next, eight);
        const std::size_t count = small_bytes(next);
        const Text& text = texts[marks[begin + count]];
        out += count;
        std::memcpy(out, text.begin.data(), eight);
        if (text.length > eight) std::memcpy(out, pool_.data() + text.pool, text.length);
        out += text.length;
        begin += count + 1;
    }
    for (; begin < end; ++begin) {
        const Text& text = texts[marks[begin]];
        std::memcpy(out, text.length > eight ? pool_.data() + text.pool : text.begin.data(), text.length);
        out += text.length;
    }
    return out;
}

std::uint64_t NearestSteps::rewrite(const ByteWord& word, ByteWord& next, std::uint64_t longest,
                                    const std::function<void()>& watch) {
    const std::size_t size = word.size();
    const std::size_t middle = size / 2;
    word_ = word.data();
    marks_.resize(size);
    Scan right, left;  // from left to right, and from right to left
    std::uint64_t whole = 0;
    const auto steps = [&] {
        in_parallel(
            middle, [&](std::size_t begin, std::size_t end) { look<false, false>(right, begin, end); }, size - middle,
            [&](std::size_t begin, std::size_t end) { look<true, false>(left, size - end, size - begin); }, watch);
        in_parallel(
            size - middle,
            [&](std::size_t begin, std::size_t end) { look<false, true>(right, middle + begin, middle + end); },
            middle, [&](std::size_t begin, std::size_t end) { look<true, true>(left, middle - end, middle - begin); },
            watch);
        whole = left.length + right.length;
        if (whole > longest) return;
        next.resize(static_cast<std::size_t>(whole));
        std::uint8_t* out = next.data();
        std::uint8_t* const half = out + left.length;
        std::uint8_t* other = half;
        in_parallel(
            middle, [&](std::size_t begin, std::size_t end) { out = write(begin, end, out, half); }, size - middle,
            [&](std::size_t begin, std::size_t end) {
                other = write(middle + begin, middle + end, other, next.data() + whole);
            },
            watch);
    };
    if (size >= least_for_threads && available_threads() > 1) {
        on_threads(2, steps);
    } else {
        steps();
    }
    return whole;
}

}  // namespace sikku
