// tests/music/far_bars_test.cpp: compares bars far inside Hilbert's curve with a walk in exact numbers.
#include "engine/base/integer.h"
#include "engine/derivation/forecast.h"
#include "music/scores.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::far_bars_test {

constexpr std::int64_t unit = 240;
constexpr std::int64_t breath = 240;
constexpr std::int64_t bar = 1920;

/// Reads Hilbert's curve as notes and passes over what lies well before a piece.
class ExactWalk {
public:
    struct Sounding {
        std::int64_t onset;  ///< ticks after the beginning of the piece
        std::int64_t duration;
        Integer y;
    };
    ExactWalk(int n, int order, Integer from, std::int64_t bars)
        : order_(order), from_(std::move(from)), to_(from_ + bars * bar) {
        walk('X', n);
    }
    std::vector<Sounding> notes;

private:
    /// The effect of a symbol of order k at a given heading.
    struct Effect {
        Integer steps = 0;  // across
        Integer phrases = 0;
        Integer rise = 0;
        int turn = 0;
    };
    static std::string_view successor(char symbol) { return symbol == 'X' ? "-YF+XFX+FY-" : "+XF-YFY-FX+"; }
    const Effect& effect(char symbol, int k, int heading) {
        const auto key = std::tuple(symbol, k, heading);
        if (const auto known = effects_.find(key); known != effects_.end()) return known->second;
        Effect effect_of;
        if (symbol == 'F') {
            effect_of.steps = heading % 2 == 0 ? 1 : 0;
            effect_of.rise = std::array{0, 1, 0, -1}[static_cast<std::size_t>(heading)];
        } else if (symbol == '+' || symbol == '-') {
            effect_of.turn = symbol == '+' ? 1 : 3;
        } else if (k > 0) {
            for (const char part : successor(symbol)) {
                const Effect& one = effect(part, k - 1, (heading + effect_of.turn) % 4);
                effect_of.steps += one.steps;
                effect_of.phrases += one.phrases;
                effect_of.rise += one.rise;
                effect_of.turn = (effect_of.turn + one.turn) % 4;
            }
            if (k == order_) effect_of.phrases += 1;
        }
        return effects_[key] = effect_of;
    }
    void walk(char symbol, int k) {
        if (time_ > to_) return;
        if (symbol == 'F') return step();
        const Effect& whole = effect(symbol, k, heading_);
        const bool is_part = symbol == 'X' || symbol == 'Y';
        if (!is_part ||
            (k >= order_ && time_ + whole.steps * unit + (whole.phrases + 3) * breath < from_ - 9 * bar)) {
            if (is_part) end_phrases();
            time_ += whole.steps * unit + whole.phrases * breath;
            y_ += whole.rise;
            heading_ = (heading_ + whole.turn) % 4;
            return;
        }
        if (k == 0) return;
        for (const char part : successor(symbol)) walk(part, k - 1);
        if (k == order_) ++(run_.steps > 0 ? run_.phrases : due_);
    }
    void step() {
        if (run_.steps == 0 || run_.heading != heading_) {
            end_run();
            run_ = {0, heading_, 0};
        }
        ++run_.steps;
        y_ += effect('F', 0, heading_).rise;
    }
    void end_run() {
        if (run_.steps > 0 && run_.heading % 2 == 0) {
            time_ += due_ * breath;
            due_ = 0;
            const Integer end = time_ + run_.steps * unit;
            if (end > from_ && time_ < to_) {
                const Integer onset = std::max(time_, from_) - from_;
                const Integer last = std::min(end, to_) - from_;
                notes.push_back(
                    {onset.convert_to<std::int64_t>(), Integer(last - onset).convert_to<std::int64_t>(), y_});
            }
            time_ = end;
        }
        due_ += run_.phrases;
        run_ = {};
    }
    void end_phrases() {
        end_run();
        time_ += due_ * breath;
        due_ = 0;
    }

    int order_;
    Integer from_, to_;
    std::map<std::tuple<char, int, int>, Effect> effects_;
    Integer time_ = 0, y_ = 0;
    int heading_ = 0;
    struct {
        int steps = 0, heading = 0, phrases = 0;
    } run_;
    int due_ = 0;
};

/// Off-beats swing beyond 2^60 ticks, too, and in meters of odd beats from each bar line on.
TEST(FarBars, Swing) {
    const Document document = parse("f.lsys",
                                    "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nturn: left\n"
                                    "derivation length: 60\nanchor: piece\nunit: 1/8\nruns: each step\n");
    for (const std::string first : {"3", "600479950316064", "1000000000000000"}) {
        const auto played = [&](const std::string& swing) {
            return list_notes({&document, 1}, {{"from-bar", first}, {"bars", "6"}, {"swing", swing}}, {}).notes;
        };
        const std::vector<Note> straight = played("50");
        const std::vector<Note> swung = played("75");
        ASSERT_EQ(straight.size(), swung.size());
        for (std::size_t i = 0; i < straight.size(); ++i) {
            const bool is_off_beat = straight[i].onset % 480 == 240;
            EXPECT_EQ(swung[i].onset - straight[i].onset, is_off_beat ? 120 : 0) << first << ' ' << i;
        }
    }
    const Document seven =
        parse("s.lsys", "axiom: FFFFFFFFFFFFFFFF\nheading: 0\nruns: each step\nunit: 1/8\nmeter: 7/8\nswing: 75\n");
    std::vector<std::int64_t> onsets;
    for (const Note& note : list_notes({&seven, 1}, {{"bars", "2"}}, {}).notes) onsets.push_back(note.onset);
    EXPECT_EQ(onsets, (std::vector<std::int64_t>{0, 360, 480, 840, 960, 1320, 1440, 1680, 2040, 2160, 2520, 2640,
                                                 3000, 3120}));
}

TEST(FarBars, EqualAnExactWalk) {
    for (const auto& [n, first] :
         {std::pair(6, "40"), {40, "123456789012345"}, {60, "1000000000000000000"}, {60, "8765432109876543210"}}) {
        const Document document =
            parse("f.lsys", fmt::format("axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nturn: left\n"
                                        "derivation length: {}\nscale: chromatic\nphrases: 3\nbreath: 1/8\n"
                                        "anchor: piece\nrange: refuse\n",
                                        n));
        const NoteList played =
            list_notes({&document, 1}, {{"from-bar", first}, {"bars", "30"}, {"velocity", "by y 20-120"}}, {});
        const ExactWalk exact(n, 3, (Integer(first) - 1) * bar, 30);
        ASSERT_GT(exact.notes.size(), 100u);
        const bool is_below =
            std::any_of(exact.notes.begin(), exact.notes.end(), [](const auto& one) { return one.y < 0; });
        ASSERT_EQ(played.notes.size(), exact.notes.size()) << first;
        for (std::size_t i = 0; i < exact.notes.size(); ++i) {
            EXPECT_EQ(played.notes[i].onset, exact.notes[i].onset) << first << ' ' << i;
            EXPECT_EQ(played.notes[i].duration, exact.notes[i].duration) << first << ' ' << i;
            EXPECT_EQ(Integer(std::llround(played.notes[i].key - played.notes[0].key)),
                      exact.notes[i].y - exact.notes[0].y)
                << first << ' ' << i;
            // The whole curve is 2^n - 1 steps high, and lies above its start or below it.
            const double height = std::ldexp(1.0, n) - 1;
            const double rise = exact.notes[i].y.convert_to<double>() / height;
            const double part = is_below ? 1 + rise : rise;
            EXPECT_EQ(played.notes[i].velocity, std::lround(20 + 100 * part)) << first << ' ' << i;
        }
    }
}

}  // namespace sikku::far_bars_test
