// engine/derivation/drawn_streamer.cpp: expands long words with random choices of constant weights, part by part, on
// several threads.
#include "engine/base/threads.h"
#include "engine/derivation/drawn_levels.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double usual_part = 1 << 15;       // symbols of a part, on average
constexpr std::size_t most_roots = 1 << 13;  // of a part
constexpr double most_room = 1 << 17;        // of a part, in modules, whatever is chosen
constexpr std::size_t modules_at_once = 256;
constexpr int parts_before_threads = 16;
constexpr int most_threads = 8;

/// A text of fewer bytes than `room`, and its length as the last byte.
template <std::size_t room>
using ShortText = std::array<char, room>;

/// The texts of the lowest level.
class DrawnTexts {
public:
    explicit DrawnTexts(const std::vector<std::string>& texts) {
        std::size_t longest = 0;
        for (const std::string& text : texts) longest = std::max(longest, text.size());
        is_short_ = longest < std::tuple_size_v<ShortText<16>>;
        if (is_short_) {
            fill(texts, short_);
        } else {
            fill(texts, long_);
        }
    }
    /// Calls take(texts), of the smallest size.
    template <class Take>
    void with(const Take& take) const {
        if (is_short_) return take(short_);
        take(long_);
    }

private:
    template <std::size_t room>
    static void fill(const std::vector<std::string>& texts, std::vector<ShortText<room>>& to) {
        to.resize(texts.size());
        for (std::size_t i = 0; i < texts.size(); ++i) {
            std::copy(texts[i].begin(), texts[i].end(), to[i].begin());
            to[i].back() = static_cast<char>(texts[i].size());
        }
    }

    bool is_short_ = false;
    std::vector<ShortText<16>> short_;
    std::vector<ShortText<DrawnLevels::longest_text>> long_;
};

/// Writes the children of modules. Returns the end of the children.
/// @param out  has room for the most children of each
DrawnModule* expand(const DrawnLevel& level, const DrawnModule* from, const DrawnModule* end, DrawnModule* out) {
    const std::size_t most = level.most;
    for (; from != end; ++from) {
        const std::uint64_t place = scrambled(from->key);
        const std::size_t alternative = level.chosen(from->kind, place);
        const std::uint64_t base = level.base(*from, place);
        const DrawnLevel::Child* const children = level.children.data() + alternative * most;
        for (std::size_t k = 0; k < most; ++k) out[k] = {base + children[k].add, children[k].kind};
        out += level.counts[alternative];
    }
    return out;
}

/// A part of the word: consecutive modules and their expansion.
class WordPart {
public:
    void clear() {
        roots_.clear();
        expected_ = 0;
        room_ = 0;
        nodes_above_ = 0;
    }
    /// Counts a node that was visited on the way to the modules.
    void add_node() { ++nodes_above_; }
    void add(const DrawnModule& root, double expected, double room) {
        roots_.push_back(root);
        expected_ += expected;
        room_ += room;
    }
    bool is_empty() const { return roots_.empty() && nodes_above_ == 0; }
    /// Also true after many nodes that were erased, so that the budget counts them.
    bool is_full() const {
        return expected_ >= usual_part || room_ >= most_room || roots_.size() >= most_roots ||
               nodes_above_ >= between_watches;
    }

    /// Expands the modules, which are of levels.low(). Does not throw: text() does.
    void expand_all(const DrawnLevels& levels, const DrawnTexts& texts) noexcept {
        try {
            error_ = nullptr;
            size_ = 0;
            nodes_ = nodes_above_;
            const DrawnModule* begin = roots_.data();
            std::size_t count = roots_.size();
            for (std::int64_t level = levels.low(); level > 2; --level) {
                std::vector<DrawnModule>& to = above_[static_cast<std::size_t>(level % 2)];
                count = expand(levels.level(level), begin, count, to);
                begin = to.data();
            }
            for (std::size_t i = 0; i < count; i += modules_at_once) {
                const std::size_t taken = std::min(modules_at_once, count - i);
                if (levels.low() == 1) {
                    write(levels.level(1), begin + i, taken, texts);
                } else {
                    const std::size_t children = expand(levels.level(2), begin + i, taken, lowest_);
                    write(levels.level(1), lowest_.data(), children, texts);
                }
            }
            nodes_ += size_;
        } catch (...) {
            error_ = std::current_exception();
        }
    }
    /// Nodes visited.
    std::uint64_t nodes() const { return nodes_; }
    std::string_view text() const {
        if (error_) std::rethrow_exception(error_);
        return std::string_view(text_).substr(0, size_);
    }

private:
    std::size_t expand(const DrawnLevel& level, const DrawnModule* begin, std::size_t count,
                       std::vector<DrawnModule>& to) {
        const std::size_t room = count * level.most;
        if (to.size() < room) to.resize(room);
        nodes_ += count;
        return static_cast<std::size_t>(sikku::expand(level, begin, begin + count, to.data()) - to.data());
    }

    void write(const DrawnLevel& level, const DrawnModule* from, std::size_t count, const DrawnTexts& texts) {
        const std::size_t room = size_ + (count + 1) * DrawnLevels::longest_text;
        if (text_.size() < room) text_.resize(2 * room);
        texts.with([&](const auto& all) {
            char* out = text_.data() + size_;
            for (const DrawnModule* const end = from + count; from != end; ++from) {
                const auto& text = all[level.chosen(from->kind, scrambled(from->key))];
                std::memcpy(out, text.data(), text.size());
                out += static_cast<unsigned char>(text.back());
            }
            size_ = static_cast<std::size_t>(out - text_.data());
        });
    }

    std::vector<DrawnModule> roots_;
    double expected_ = 0, room_ = 0;
    std::uint64_t nodes_above_ = 0;
    std::array<std::vector<DrawnModule>, 2> above_;  // by level, modulo 2
    std::vector<DrawnModule> lowest_;
    std::string text_;
    std::size_t size_ = 0;  // of the text written for it
    std::uint64_t nodes_ = 0;
    std::exception_ptr error_;
};

/// Divides a word into parts, depth first, and delivers them in order.
class DrawnStreamer {
public:
    DrawnStreamer(const Grammar& grammar, const DrawnLevels& levels, const DerivationOptions& options,
                  SymbolSink& sink, bool takes_text)
        : grammar_(grammar),
          levels_(levels),
          texts_(levels.level(1).texts),
          options_(options),
          sink_(sink),
          takes_text_(takes_text),
          visited_(grammar, options) {}

    void stream() {
        std::vector<WordPart> parts(1);
        const auto prepare = [&](std::size_t place) { return fill(parts[place]); };
        const auto work = [&](std::size_t place) { parts[place].expand_all(levels_, texts_); };
        const auto deliver = [&](std::size_t place) { hand_over(parts[place]); };
        for (int i = 0; i < parts_before_threads; ++i) {
            if (!prepare(0)) return;
            work(0);
            deliver(0);
        }
        const int threads = std::min(most_threads, available_threads());
        parts.resize(threads > 1 ? 2 * static_cast<std::size_t>(threads) + 2 : 1);
        hand_over_in_order(parts.size(), threads, prepare, work, deliver);
    }

private:
    struct Frame {
        const DrawnLevel::Child* next;
        const DrawnLevel::Child* end;
        std::uint64_t base;
        std::int64_t level;  // of the children
    };

    /// Collects the roots of the next part. Returns false if nothing is left.
    bool fill(WordPart& part) {
        part.clear();
        while (!part.is_full()) {
            if (!frames_.empty()) {
                Frame& frame = frames_.back();
                const DrawnModule module{frame.base + frame.next->add, frame.next->kind};
                const std::int64_t level = frame.level;
                if (++frame.next == frame.end) frames_.pop_back();
                take(module, level, part);
            } else if (next_ < grammar_.axiom().size()) {
                const std::uint64_t place = grammar_.place_of(grammar_.axiom_modules(), next_);
                const std::uint32_t kind = levels_.axiom_kind(grammar_.axiom()[next_++]);
                take({unscrambled(place), kind}, levels_.count(), part);
            } else {
                break;
            }
        }
        return !part.is_empty();
    }

    void take(const DrawnModule& module, std::int64_t number, WordPart& part) {
        const DrawnLevel& level = levels_.level(number);
        if (number == levels_.low()) return part.add(module, level.means[module.kind], level.rooms[module.kind]);
        part.add_node();
        const std::uint64_t place = scrambled(module.key);
        const std::size_t alternative = level.chosen(module.kind, place);
        const DrawnLevel::Child* const first = level.children.data() + alternative * level.most;
        const std::uint32_t count = level.counts[alternative];
        if (count > 0) frames_.push_back({first, first + count, level.base(module, place), number - 1});
    }

    void hand_over(const WordPart& part) {
        const std::string_view text = part.text();
        visited_.add(part.nodes());
        if (takes_text_) {
            if (!text.empty()) sink_.text(text);
            if (options_.watch) options_.watch(text.size());
            return;
        }
        for (std::size_t i = 0; i < text.size(); i += longest_run) {
            const std::string_view piece = text.substr(i, longest_run);
            run_.resize(piece.size());
            std::transform(piece.begin(), piece.end(), run_.begin(),
                           [](char symbol) { return Symbol{static_cast<unsigned char>(symbol)}; });
            sink_.symbols({run_, -1, {}});
            if (options_.watch) options_.watch(piece.size());
        }
    }

    const Grammar& grammar_;
    const DrawnLevels& levels_;
    DrawnTexts texts_;
    const DerivationOptions& options_;
    SymbolSink& sink_;
    bool takes_text_;
    std::vector<Frame> frames_;
    std::size_t next_ = 0;  // symbol of the axiom
    VisitedNodes visited_;
    Word run_;
};

}  // namespace

bool stream_drawn(const Grammar& grammar, const Levels& levels, const DerivationOptions& options, SymbolSink& sink) {
    const std::string_view bytes = sink.bytes();
    std::string numbers;
    for (int i = 0; i < 256 && bytes.empty(); ++i) numbers += static_cast<char>(i);
    const DrawnLevels drawn(grammar, levels, bytes.empty() ? std::string_view(numbers) : bytes);
    if (!drawn.is_usable()) return false;
    DrawnStreamer(grammar, drawn, options, sink, !bytes.empty()).stream();
    return true;
}

}  // namespace sikku
