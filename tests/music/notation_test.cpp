#include "music/score/notation.h"

#include "tests/checks.h"
#include "tests/notation_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::notation_test {

/// What is printed, joined again at its ties.
std::vector<PlainNote> joined(const Notation& notation) {
    std::vector<PlainNote> list;
    for (const NotatedPart& part : notation.parts) {
        for (const Staff& staff : part.staves) {
            for (const NotatedVoice& voice : staff.voices) {
                bool open = false;
                for (const NotatedSymbol& symbol : voice.symbols) {
                    EXPECT_EQ(symbol.tied_back, open);
                    open = symbol.tied_forward;
                    if (symbol.kind != SymbolKind::note) {
                        EXPECT_FALSE(symbol.tied_back || symbol.tied_forward);
                        continue;
                    }
                    const std::int64_t duration = symbol.length;
                    if (symbol.tied_back) {
                        EXPECT_EQ(list.back().key, symbol.pitch.key());
                        list.back().duration += duration;
                    } else {
                        list.push_back({symbol.onset, duration, symbol.pitch.key()});
                    }
                }
                EXPECT_FALSE(open);
            }
        }
    }
    std::sort(list.begin(), list.end());
    return list;
}

/// `4. 8~ | 2~`: the first voice of the first staff in words.
std::string words(const Notation& notation) {
    std::string text;
    for (const NotatedSymbol& symbol : notation.parts.front().staves.front().voices.front().symbols) {
        if (notation.bar_lines.place(symbol.onset) == 0 && symbol.onset > 0) text += "| ";
        if (symbol.kind == SymbolKind::bar_rest) {
            text += "R ";
            continue;
        }
        const NoteValue value = symbol.value;
        if (symbol.kind == SymbolKind::rest) text += "r";
        text += std::to_string(value.divisor) + (value.dotted ? "." : "") + (symbol.tied_forward ? "~ " : " ");
    }
    if (!text.empty()) text.pop_back();
    return text;
}

std::string words(const Meter& meter, const std::vector<std::int64_t>& lengths) {
    return words(notate(line(meter, lengths)));
}

constexpr std::int64_t eighth = 240;

TEST(Notation, ChordsStayInTheirPart) {
    // Both parts come from patterns of their own, so that their symbols have the same numbers.
    TestScore score;
    score.head.title = "A note and a chord";
    score.head.parts = {plain_part("Bass", 1), plain_part("Chords", 3)};
    score.head.parts[1].has_chords = true;
    for (const auto& [voice, key] :
         std::vector<std::pair<std::int16_t, double>>{{0, 48}, {1, 60}, {2, 64}, {3, 67}}) {
        Note note{.duration = 480, .key = key, .voice = voice, .symbol = 1};
        score.notes.push_back(note);
    }
    score.end = 480;
    const Notation notation = notate(score);
    const auto others = [&](std::size_t part) {
        return notation.parts[part].staves.front().voices.front().symbols.front().chord.size();
    };
    EXPECT_EQ(others(0), 0U);
    EXPECT_EQ(others(1), 2U);
}

TEST(Notation, FiveUnitsAreFourAndOne) {
    for (const auto& [unit, expected] : std::vector<std::pair<std::int64_t, std::string>>{
             {120, "4~ 16 r16 r8 r2"}, {240, "2~ 8 r8 r4"}, {480, "1~ | 4 r4 r2"}, {960, "1~ | 1~ | 2 r2"}}) {
        EXPECT_EQ(words({4, 4}, {5 * unit}), expected);
    }
}

TEST(Notation, PrintsTheLongestThatTheBeatAllows) {
    EXPECT_EQ(words({4, 4}, {3 * eighth, 5 * eighth}), "4. 8~ 2");
    EXPECT_EQ(words({4, 4}, {eighth, 2 * eighth, eighth, 4 * eighth}), "8 4 8 2");
    EXPECT_EQ(words({4, 4}, {eighth, 6 * eighth, eighth}), "8 4.~ 4. 8");
    EXPECT_EQ(words({4, 4}, {480, 960, 480}), "4 2 4");
    EXPECT_EQ(words({4, 4}, {120, 240, 120, 240 * 6}), "16 8 16 2.");
    EXPECT_EQ(words({4, 4}, {120, 480, 120, 240, 960}), "16 8.~ 16 16 8 2");
    EXPECT_EQ(words({4, 4}, {7 * eighth, 9 * eighth}), "2.~ 8 8~ | 1");
    EXPECT_EQ(words({3, 4}, {6 * eighth, 6 * eighth}), "2. | 2.");
    EXPECT_EQ(words({5, 8}, {5 * eighth, 3 * eighth, 2 * eighth}), "4.~ 4 | 4. 4");
    EXPECT_EQ(words({7, 8}, {7 * eighth}), "4.~ 2");
    EXPECT_EQ(words({8, 4}, {16 * eighth}), "1~ 1");
    // The middle is visible but between beats.
    EXPECT_EQ(words({4, 4}, {480, 3 * eighth, 480, eighth}), "4 4~ 8 4 8");
    // Beats of three eighths.
    EXPECT_EQ(words({6, 8}, {4 * eighth, 2 * eighth}), "4.~ 8 4");
    EXPECT_EQ(words({6, 8}, {eighth, 4 * eighth, eighth}), "8 4~ 4 8");
    EXPECT_EQ(words({9, 8}, {9 * eighth}), "2.~ 4.");
    EXPECT_EQ(words({12, 8}, {12 * eighth}), "1.");
    EXPECT_EQ(words({3, 8}, {2 * eighth, 4 * eighth}), "4 8~ | 4.");
}

/// A bar as a key: meter and groups.
std::string meter_text(const Meter& meter) {
    std::string text = std::to_string(meter.beats) + "/" + std::to_string(meter.unit);
    for (const std::uint8_t group : meter.groups) text += "+" + std::to_string(group);
    return text;
}

/// Lines with notes off the beat, tuplets, rests, an upbeat and changes of meter.
TestScore syncopated_score(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    static constexpr std::array<Meter, 12> meters = {{{4, 4, {}},
                                                      {3, 4, {}},
                                                      {2, 4, {}},
                                                      {2, 2, {}},
                                                      {3, 2, {}},
                                                      {5, 4, {}},
                                                      {6, 4, {}},
                                                      {6, 8, {}},
                                                      {7, 8, {}},
                                                      {9, 8, {}},
                                                      {8, 8, {3, 3, 2}},
                                                      {7, 4, {3, 2, 2}}}};
    static constexpr std::array<std::int64_t, 3> units = {60, 120, 240};
    TestScore score = line(meters[below(meters.size())], {});
    score.head.parts = {plain_part("Voices", static_cast<int>(1 + below(3)))};
    if (below(4) == 0) score.head.upbeat = 240 * static_cast<std::int64_t>(1 + below(2));
    for (int voice = 0; voice < score.head.parts.front().voices; ++voice) {
        std::int64_t here = 0;
        for (std::size_t i = 0; i < 60; ++i) {
            const bool is_tuplet = here % 480 == score.head.upbeat % 480 && below(8) == 0;
            const std::int64_t length = is_tuplet ? 160 : units[below(3)] * static_cast<std::int64_t>(1 + below(8));
            const int times = is_tuplet ? 3 : 1;
            for (int k = 0; k < times; ++k, here += length) {
                if (below(6) == 0) continue;
                score.notes.push_back({.onset = here,
                                       .duration = length,
                                       .key = 60.0 + static_cast<double>(below(20)),
                                       .voice = static_cast<std::int16_t>(voice)});
            }
        }
        score.end = std::max(score.end, here);
    }
    std::int64_t at = score.head.upbeat;
    Meter meter = score.head.meter;
    for (std::size_t i = 0; i < below(3); ++i) {
        at += meter.bar() * static_cast<std::int64_t>(1 + below(4));
        meter = meters[below(meters.size())];
        score.head.changes.push_back({at, {120, {}, meter}});
    }
    return score;
}

/// How notes and rests are printed: `4/4 n 240+480` is a note of a quarter after an eighth.
class Writings {
public:
    /// Records a stretch of a bar, and expects that all equal ones are printed with the same values.
    void add(const std::string& stretch, const std::string& values) {
        const auto [known, is_new] = by_stretch_.emplace(stretch, values);
        EXPECT_EQ(known->second, values) << stretch;
        repeated_ += is_new ? 0 : 1;
    }
    std::size_t count() const { return by_stretch_.size(); }
    std::size_t repeated() const { return repeated_; }
    std::string at(const std::string& stretch) const {
        const auto known = by_stretch_.find(stretch);
        return known == by_stretch_.end() ? "" : known->second;
    }

private:
    std::map<std::string, std::string> by_stretch_;
    std::size_t repeated_ = 0;
};

TEST(Notation, EqualRhythmsAreWrittenEqually) {
    Writings by_bar;   // at equal places of bars
    Writings by_beat;  // at equal places of beats, if the bar has no middle and no groups
    for (unsigned seed = 0; seed < 300; ++seed) {
        const TestScore score = syncopated_score(seed);
        const Notation notation = notate(score);
        const BarLines& bars = notation.bar_lines;
        for (const NotatedVoice& voice : notation.parts.front().staves.front().voices) {
            for (std::size_t i = 0; i < voice.symbols.size();) {
                const NotatedSymbol& first = voice.symbols[i];
                std::string values;
                std::int64_t length = 0;
                bool is_plain = first.kind == SymbolKind::note || first.kind == SymbolKind::rest;
                do {
                    const NotatedSymbol& symbol = voice.symbols[i];
                    is_plain = is_plain && symbol.kind == first.kind && symbol.tuplet < 0;
                    values += std::to_string(symbol.value.divisor) + (symbol.value.dotted ? ". " : " ");
                    length += symbol.length;
                    ++i;
                } while (i < voice.symbols.size() &&
                         (first.kind == SymbolKind::note ? voice.symbols[i].tied_back
                                                         : voice.symbols[i].kind == first.kind) &&
                         bars.number(voice.symbols[i].onset) == bars.number(first.onset));
                if (!is_plain) continue;
                const Meter& meter = bars.meter(first.onset);
                const std::int64_t place = bars.place(first.onset);
                const std::string kind = first.kind == SymbolKind::note ? " n " : " r ";
                by_bar.add(meter_text(meter) + kind + std::to_string(place) + "+" + std::to_string(length), values);
                const bool is_even = meter.groups[0] == 0 && meter.unit < 8 && meter.beats % 2 != 0;
                const std::int64_t beat = 4 * ticks_per_quarter / meter.unit;
                const bool is_off_beat = place % beat != 0 && place + length < meter.bar();
                if (is_even && is_off_beat && first.kind == SymbolKind::note) {
                    by_beat.add(meter_text(meter) + " " + std::to_string(place % beat) + "+" + std::to_string(length),
                                values);
                }
            }
        }
    }
    EXPECT_GT(by_bar.count(), 500u);
    EXPECT_GT(by_bar.repeated(), 5'000u);
    EXPECT_GT(by_beat.repeated(), 100u);
    EXPECT_EQ(by_beat.at(meter_text({3, 4, {}}) + " 240+480"), "4 ");
}

TEST(Notation, SyncopationsAreWrittenOneWay) {
    // In three beats at any place; dotted notes show the beat.
    EXPECT_EQ(words({3, 4}, {eighth, 480, 480, eighth}), "8 4 4 8");
    EXPECT_EQ(words({3, 4}, {eighth, 480, 3 * eighth}), "8 4 8~ 4");
    EXPECT_EQ(words({3, 4}, {3 * eighth, 3 * eighth}), "4. 8~ 4");
    EXPECT_EQ(words({3, 4}, {eighth, 3 * eighth, 480}), "8 8~ 4 4");
    EXPECT_EQ(words({3, 2}, {480, 960, 960, 480}), "4 2 2 4");
    // Two beats are a pair: alone, in halves of four, and in a group.
    EXPECT_EQ(words({2, 4}, {eighth, 480, eighth}), "8 4 8");
    EXPECT_EQ(words({2, 4}, {eighth, 3 * eighth}), "8 4.");
    EXPECT_EQ(words({2, 2}, {480, 960, 480}), "4 2 4");
    EXPECT_EQ(words({4, 4}, {eighth, 480, eighth, eighth, 480, eighth}), "8 4 8 8 4 8");
    EXPECT_EQ(words({4, 4}, {eighth, 480, 480, 480, eighth}), "8 4 8~ 8 4 8");
    EXPECT_EQ(words({7, 4, {3, 2, 2}}, {eighth, 480, 480, eighth, eighth, 480, eighth, eighth, 480, eighth}),
              "8 4 4 8 8 4 8 8 4 8");
    // Six quarters are two groups of three.
    EXPECT_EQ(words({6, 4}, {eighth, 480, 480, eighth, eighth, 480, 480, eighth}), "8 4 4 8 8 4 4 8");
    EXPECT_EQ(words({5, 4}, {eighth, 480, 480, 480, 480, eighth}), "8 4 4 4 4 8");
    EXPECT_EQ(words({8, 4}, {eighth, 480, 480, 480, eighth, 1920}), "8 4 8~ 8 4 8 1");
    // Shorter ones stay within their beat.
    EXPECT_EQ(words({3, 4}, {120, 240, 240, 240, 120, 480}), "16 8 16~ 16 8 16 4");
}

TEST(Notation, RestsFillGapsAndTheLastBar) {
    EXPECT_EQ(words({4, 4}, {-480, 480, -960, -1920, 480}), "r4 4 r2 | R | 4 r4 r2");
    EXPECT_EQ(words({5, 8}, {-5 * eighth, 5 * eighth}), "R | 4.~ 4");
    EXPECT_EQ(words({4, 4}, {}), "R");
    EXPECT_EQ(words({4, 4}, {480, -5000}), "4 r4 r2 | R | R");
    EXPECT_EQ(notate(line({4, 4}, {1920})).bars, 1);
    EXPECT_EQ(notate(line({4, 4}, {1920, 30})).bars, 2);
}

TEST(Notation, RestsShowTheBeats) {
    EXPECT_EQ(words({4, 4}, {eighth, -480, 5 * eighth}), "8 r8 r8 8~ 2");
    EXPECT_EQ(words({4, 4}, {480, -960, 480}), "4 r4 r4 4");
    EXPECT_EQ(words({4, 4}, {-3 * eighth, 5 * eighth}), "r4 r8 8~ 2");
    EXPECT_EQ(words({4, 4}, {-360, 120, 120, -360, 960}), "r8. 16 16 r16 r8 2");
    EXPECT_EQ(words({3, 4}, {-960, 480}), "r4 r4 4");
    EXPECT_EQ(words({3, 2}, {-1920, 960}), "r2 r2 2");
    EXPECT_EQ(words({8, 4}, {-1920, 1920}), "r2 r2 1");
    EXPECT_EQ(words({6, 8}, {eighth, -5 * eighth}), "8 r8 r8 r4.");
    EXPECT_EQ(words({6, 8}, {-2 * eighth, 4 * eighth}), "r4 8~ 4.");
    EXPECT_EQ(words({12, 8}, {-6 * eighth, 3 * eighth, -3 * eighth}), "r2. 4. r4.");
    EXPECT_EQ(words({12, 8}, {3 * eighth, -6 * eighth, 3 * eighth}), "4. r4. r4. 4.");
    EXPECT_EQ(words({8, 4, {4, 2, 2}}, {480, -3 * 480, -960, 960}), "4 r4 r2 r2 2");
    // A rest begins at a multiple of its length, and only dotted beats and the first part of a beat have dots.
    for (const Meter meter : {Meter{4, 4}, {3, 4}, {6, 8}, {7, 8}, {2, 2}, {5, 4}, {12, 8}, {8, 4, {4, 2, 2}}}) {
        const std::vector<std::int64_t> groups = groups_of(meter);
        for (std::int64_t from = 0; from < meter.bar(); from += 30) {
            for (std::int64_t to = from + 30; to <= meter.bar(); to += 30) {
                std::int64_t here = from;
                for (const WrittenValue& written : written_rests(from, to, meter)) {
                    std::int64_t group = 0;
                    for (std::size_t i = 0; group + groups[i] <= here; ++i) group += groups[i];
                    const std::int64_t within = here - group;
                    const std::int64_t base = written.length / (written.value.dotted ? 3 : 2) * 2;
                    EXPECT_EQ(within % (written.value.dotted ? 2 * base : base) * (within > 0 ? 1 : 0), 0)
                        << meter.beats << "/" << meter.unit << " " << from << " " << to;
                    here += written.length;
                }
                ASSERT_EQ(here, to);
            }
        }
    }
}

TEST(Notation, BarLinesFollowTheMeters) {
    for (unsigned seed = 1; seed < 200; seed += 2) {
        const TestScore score = random_score(seed, false);
        const BarLines lines(score.head);
        const std::vector<std::int64_t> onsets = bar_onsets(score.head, score.end + 10'000);
        for (std::int64_t bar = 0; bar + 1 < std::ssize(onsets); ++bar) {
            const std::int64_t begin = onsets[static_cast<std::size_t>(bar)];
            const std::int64_t end = onsets[static_cast<std::size_t>(bar) + 1];
            EXPECT_EQ(lines.onset(bar), begin);
            EXPECT_EQ(lines.next(begin), begin);
            EXPECT_EQ(lines.count(begin), bar);
            for (const std::int64_t tick : {begin, begin + 1, (begin + end) / 2, end - 1}) {
                EXPECT_EQ(lines.number(tick), bar);
                EXPECT_EQ(lines.begin(tick), begin);
                EXPECT_EQ(lines.end(tick), end);
                EXPECT_EQ(lines.length(tick), end - begin);
                EXPECT_EQ(lines.meter(tick).bar(), end - begin);
                EXPECT_EQ(lines.place(tick), tick - begin);
                EXPECT_EQ(lines.next(tick), tick == begin ? begin : end);
                EXPECT_EQ(lines.count(tick), tick == begin ? bar : bar + 1);
            }
            const BarLines later = lines.from(begin);
            EXPECT_EQ(later.onset(1), end - begin);
            EXPECT_EQ(later.number(onsets.back() - 1 - begin), lines.number(onsets.back() - 1) - bar);
        }
    }
}

TEST(Notation, RandomScoresSayTheSameAsTheirNotes) {
    for (unsigned seed = 0; seed < 400; ++seed) {
        const TestScore score = random_score(seed, seed % 4 == 0);
        const Notation notation = notate(score, 1 + seed % 50);
        ASSERT_EQ(joined(notation), plain(score.notes)) << seed;
        EXPECT_EQ(notation.moved, 0u);
        EXPECT_EQ(notation.bent, 0u);
        const std::vector<std::int64_t> onsets = bar_onsets(score.head, score.end + 4 * 1920);
        const auto bars = static_cast<std::size_t>(notation.bars);
        ASSERT_LT(bars, onsets.size());
        EXPECT_GE(onsets[bars], score.end);
        EXPECT_LT(onsets[bars - 1], std::max<std::int64_t>(score.end, 1));
        const auto bar_of = [&](std::int64_t tick) {
            return static_cast<std::size_t>(std::upper_bound(onsets.begin(), onsets.end(), tick) - onsets.begin() -
                                            1);
        };
        ASSERT_EQ(notation.parts.size(), score.head.parts.size());
        for (const NotatedPart& part : notation.parts) {
            ASSERT_FALSE(part.staves.empty());
            for (const Staff& staff : part.staves) {
                ASSERT_GE(staff.voices.size(), 1u);
                ASSERT_LE(staff.voices.size(), 4u);
                for (const NotatedVoice& voice : staff.voices) {
                    std::vector<std::int64_t> sums(bars, 0);
                    std::int64_t here = 0;
                    for (const NotatedSymbol& symbol : voice.symbols) {
                        ASSERT_EQ(symbol.onset, here);
                        here += symbol.length;
                        const std::size_t bar = bar_of(symbol.onset);
                        const std::int64_t length = onsets[bar + 1] - onsets[bar];
                        sums[bar] += symbol.length;
                        if (symbol.kind == SymbolKind::bar_rest) {
                            EXPECT_EQ(symbol.length, length);
                            continue;
                        }
                        if (symbol.kind == SymbolKind::gap && symbol.length == length) continue;
                        const NoteValue value = symbol.value;
                        EXPECT_EQ(symbol.length, 1920 / value.divisor * (value.dotted ? 3 : 2) / 2);
                        EXPECT_TRUE((std::set{1, 2, 4, 8, 16, 32, 64}.contains(value.divisor)));
                    }
                    for (std::size_t i = 0; i < bars; ++i) ASSERT_EQ(sums[i], onsets[i + 1] - onsets[i]);
                }
            }
        }
    }
}

TEST(Notation, EveryStretchOfEveryBarIsPrintable) {
    for (const Meter meter : {Meter{4, 4},
                              {3, 4},
                              {2, 4},
                              {5, 8},
                              {6, 8},
                              {7, 16},
                              {1, 64},
                              {9, 32},
                              {3, 2},
                              {1, 1},
                              {7, 8, {3, 2, 2}},
                              {8, 8, {3, 3, 2}}}) {
        for (std::int64_t from = 0; from < meter.bar(); from += 30) {
            for (std::int64_t to = from + 30; to <= meter.bar(); to += 30) {
                std::int64_t sum = 0;
                for (const WrittenValue& written : written_values(from, to, meter)) {
                    sum += written.length;
                    EXPECT_EQ(written.value.ticks(), written.length);
                    EXPECT_TRUE((std::set{1, 2, 4, 8, 16, 32, 64}.contains(written.value.divisor)));
                    EXPECT_FALSE(written.value == (NoteValue{64, true}));
                }
                ASSERT_EQ(sum, to - from);
            }
        }
    }
    // Off the beat nothing hides the middle.
    for (std::int64_t from = 30; from < 960; from += 30) {
        if (from % 480 == 0) continue;
        std::int64_t here = from;
        for (const WrittenValue& written : written_values(from, 1920, Meter{4, 4})) {
            EXPECT_FALSE(here < 960 && here % 480 != 0 && here + written.length > 960) << from;
            here += written.length;
        }
    }
}

TEST(Notation, NothingCrossesTheEndOfAGroup) {
    const Meter meter{7, 8, {3, 2, 2}};
    EXPECT_EQ(words(meter, {7 * eighth}), "4.~ 2");
    EXPECT_EQ(words(meter, {2 * eighth, 3 * eighth, 2 * eighth}), "4 8~ 4 4");
    EXPECT_EQ(words(meter, {eighth, -6 * eighth}), "8 r8 r8 r4 r4");
    EXPECT_EQ(words({7, 8, {3, 2, 2}}, {2 * eighth, 5 * eighth}), words({7, 8}, {2 * eighth, 5 * eighth}));
    EXPECT_EQ(words({8, 8, {3, 3, 2}}, {8 * eighth}), "1");
    EXPECT_EQ(groups_of(meter), (std::vector<std::int64_t>{720, 480, 480}));
    EXPECT_EQ(groups_of({7, 8}), (std::vector<std::int64_t>{720, 480, 480}));
    EXPECT_EQ(groups_of({5, 16}), (std::vector<std::int64_t>{360, 240}));
    EXPECT_EQ(groups_of({8, 8}), (std::vector<std::int64_t>{720, 720, 480}));
    EXPECT_EQ(groups_of({4, 8}), (std::vector<std::int64_t>{480, 480}));
    EXPECT_EQ(groups_of({3, 8}), (std::vector<std::int64_t>{720}));
    EXPECT_EQ(groups_of({6, 8}), (std::vector<std::int64_t>{720, 720}));
}

/// The tuplets of the first voice, `5:4/16` each.
std::string tuplets(const Notation& notation) {
    std::string text;
    for (const TupletSpan& tuplet : notation.parts.front().staves.front().voices.front().tuplets) {
        text += std::to_string(tuplet.actual) + ":" + std::to_string(tuplet.normal) + "/" +
                std::to_string(tuplet.divisor) + " ";
    }
    if (!text.empty()) text.pop_back();
    return text;
}

TEST(Notation, ThirdsAndFifthsAreTuplets) {
    const auto both = [](const Meter& meter, const std::vector<std::int64_t>& lengths) {
        const Notation notation = notate(line(meter, lengths));
        EXPECT_EQ(notation.moved, 0u);
        EXPECT_EQ(joined(notation), plain(line(meter, lengths).notes));
        return tuplets(notation) + "; " + words(notation);
    };
    EXPECT_EQ(both({4, 4}, {160, 160, 160, 480, 960}), "3:2/8; 8 8 8 4 2");
    EXPECT_EQ(both({4, 4}, {320, 320, 320, 960}), "3:2/4; 4 4 4 2");
    EXPECT_EQ(both({4, 4}, {640, 640, 640}), "3:2/2; 2 2 2");
    EXPECT_EQ(both({4, 4}, {160, 320 + 160, 320, 960}), "3:2/8 3:2/8; 8 4~ 8 4 2");
    EXPECT_EQ(both({4, 4}, {80, 240, 160, 1440}), "6:4/16; 16 8~ 16 8 2.");
    EXPECT_EQ(both({4, 4}, {80, 160, 80, 160, 1440}), "3:2/16 3:2/16; 16 8 16 8 2.");
    EXPECT_EQ(both({4, 4}, {96, 96, 288, 1440}), "5:4/16; 16 16 8. 2.");
    EXPECT_EQ(both({4, 4}, {192, 768, 960}), "5:4/8; 8 2 2");
    EXPECT_EQ(both({4, 4}, {160, -1760}), "3:2/8; 8 r8 r8 r4 r2");
    EXPECT_EQ(both({6, 8}, {80, 160, 480, 720}), "3:2/16; 16 8 4 4.");
    EXPECT_EQ(both({7, 8}, {240, 160, 80, 240, 480, 480}), "3:2/16; 8 8 16 8 4 4");
    EXPECT_EQ(both({4, 4}, {480, 480, 480, 480}), "; 4 4 4 4");
    // Runs of whole units in any meter stay where they are.
    for (const std::int64_t unit : {160, 320, 80, 96, 192, 40, 48}) {
        for (const Meter meter : {Meter{4, 4}, {3, 4}, {2, 2}, {7, 8}, {6, 8}, {5, 4}, {7, 8, {3, 2, 2}}}) {
            for (unsigned seed = 0; seed < 20; ++seed) {
                std::mt19937 random(seed);
                std::vector<std::int64_t> lengths;
                for (int i = 0; i < 40; ++i) lengths.push_back(unit * (1 + static_cast<std::int64_t>(random() % 5)));
                both(meter, lengths);
            }
        }
    }
}

TEST(Notation, BeamsFollowTheGroups) {
    // `[` begins a beam of eighths, `]` ends one.
    const auto beams = [](const Meter& meter, const std::vector<std::int64_t>& lengths) {
        std::string text;
        const Notation notation = notate(line(meter, lengths));
        for (const NotatedSymbol& symbol : notation.parts[0].staves[0].voices[0].symbols) {
            if (symbol.kind != SymbolKind::note) continue;
            text += std::string_view(".[-]fb")[static_cast<std::size_t>(symbol.beams[0])];
        }
        return text;
    };
    const auto eighths = [](std::size_t count) { return std::vector<std::int64_t>(count, eighth); };
    EXPECT_EQ(beams({4, 4}, eighths(8)), "[--][--]");
    EXPECT_EQ(beams({3, 4}, eighths(6)), "[----]");
    EXPECT_EQ(beams({6, 8}, eighths(6)), "[-][-]");
    EXPECT_EQ(beams({7, 8}, eighths(7)), "[-][][]");
    EXPECT_EQ(beams({3, 8}, eighths(3)), "[-]");
    EXPECT_EQ(beams({4, 8}, eighths(4)), "[][]");
    EXPECT_EQ(beams({8, 8}, eighths(8)), "[-][-][]");
    // Beats of grouped quarters.
    EXPECT_EQ(beams({8, 4, {4, 2, 2}}, {240, 120, 120, 120, 120, 240, 960, 1920}), "[-][-]..");
    EXPECT_EQ(beams({8, 4, {4, 2, 2}}, {240, 240, 240, 240, 960, 240, 240, 240, 240, 960}), "[--].[--].");
    EXPECT_EQ(beams({7, 8, {3, 2, 2}}, eighths(7)), "[-][][]");
    EXPECT_EQ(beams({4, 4}, {120, 120, 240, 240, 240, 480, -480}), "[-][].");
    EXPECT_EQ(beams({4, 4}, {240, 480, 240, 960}), "....");
    EXPECT_EQ(beams({4, 4}, {160, 160, 160, 160, 320, 960}), "[-]...");
}

TEST(Notation, HooksPointToTheNoteTheyBelongTo) {
    const auto second_beams = [](const std::vector<std::int64_t>& lengths) {
        std::string text;
        const Notation notation = notate(line({4, 4}, lengths));
        for (const NotatedSymbol& symbol : notation.parts[0].staves[0].voices[0].symbols) {
            if (symbol.kind == SymbolKind::note)
                text += std::string_view(".[-]fb")[static_cast<std::size_t>(symbol.beams[1])];
        }
        return text;
    };
    EXPECT_EQ(second_beams({360, 120, 1440}), ".b.");
    EXPECT_EQ(second_beams({120, 360, 1440}), "f..");
    EXPECT_EQ(second_beams({120, 240, 120, 1440}), "f.b.");
    EXPECT_EQ(second_beams({120, 120, 120, 120, 1440}), "[--].");
}

TEST(Notation, ShortNotesAreBeamedByEighths) {
    const auto beams = [](const std::vector<std::int64_t>& lengths, std::size_t level) {
        std::string text;
        const Notation notation = notate(line({4, 4}, lengths));
        for (const NotatedSymbol& symbol : notation.parts[0].staves[0].voices[0].symbols) {
            if (symbol.kind != SymbolKind::note) continue;
            text += std::string_view(".[-]fb")[static_cast<std::size_t>(symbol.beams[level])];
        }
        return text;
    };
    std::vector<std::int64_t> lengths(8, 60);
    lengths.push_back(1440);
    EXPECT_EQ(beams(lengths, 0), "[------].");
    EXPECT_EQ(beams(lengths, 1), "[--][--].");
    EXPECT_EQ(beams(lengths, 2), "[--][--].");
    // A hook stays in its eighth.
    EXPECT_EQ(beams({180, 60, 60, 60, 120, 1440}, 1), "[][-].");
    EXPECT_EQ(beams({180, 60, 60, 60, 120, 1440}, 2), ".b[]..");
    EXPECT_EQ(beams({-120, 120, 60, 60, 60, 60, 1440}, 1), "f[--].");
}

TEST(Notation, WhatFallsOnNoGridIsMovedAndCounted) {
    // Sevenths of a beat are rounded to ticks.
    const TestScore sevenths = line({4, 4}, {69, 68, 69, 274});
    EXPECT_EQ(notate(sevenths).moved, 0u);
    EXPECT_EQ(joined(notate(sevenths)), plain(sevenths.notes));
    const Notation thirteenths = notate(line({4, 4}, {37, 37, 37, 369}));
    EXPECT_EQ(thirteenths.moved, 4u);
    EXPECT_EQ(joined(thirteenths), (std::vector<PlainNote>{{0, 30, 72}, {30, 30, 72}, {60, 60, 72}, {120, 360, 72}}));
    // Too short for any sign: one 64th each, in order.
    const Notation crumbs = notate(line({4, 4}, {1, 1, 1, 477}));
    EXPECT_EQ(crumbs.moved, 4u);
    EXPECT_EQ(joined(crumbs), (std::vector<PlainNote>{{0, 30, 72}, {30, 30, 72}, {60, 30, 72}, {90, 390, 72}}));
    EXPECT_EQ(notate(line({4, 4}, {480, 30, 450})).moved, 0u);
}

/// A staff in words: `treble`, `bass+1`, … for each change, with its onset in quarters.
std::string changes(const Staff& staff) {
    static const std::map<Clef, std::string> names = {{Clef::treble, "treble"},       {Clef::bass, "bass"},
                                                      {Clef::alto, "alto"},           {Clef::tenor, "tenor"},
                                                      {Clef::treble_8, "treble_8"},   {Clef::bass_8, "bass_8"},
                                                      {Clef::treble_up_8, "treble^8"}};
    std::string text;
    for (const StaffChange& change : staff.changes) {
        text += (text.empty() ? "" : ", ") + std::to_string(change.onset / 480) + " " + names.at(change.clef);
        if (change.octaves != 0) text += (change.octaves > 0 ? "+" : "") + std::to_string(change.octaves);
    }
    return text;
}

std::vector<Staff> staves_of(int program, const std::vector<double>& keys) {
    TestScore score = line({4, 4}, std::vector<std::int64_t>(keys.size(), 480));
    score.head.parts[0].program = program;
    for (std::size_t i = 0; i < keys.size(); ++i) score.notes[i].key = keys[i];
    return notate(score).parts.front().staves;
}

std::vector<double> keys_of(const Staff& staff) {
    std::vector<double> keys;
    for (const NotatedVoice& voice : staff.voices) {
        for (const NotatedSymbol& symbol : voice.symbols) {
            if (symbol.kind == SymbolKind::note && !symbol.tied_back) keys.push_back(symbol.pitch.key());
        }
    }
    return keys;
}

constexpr int piano = 0;
constexpr int vibraphone = 11;

TEST(Notation, AMelodyHasOneStaff) {
    // Around middle C, over three octaves: never torn.
    for (const int program : {vibraphone, 40, 42, 73}) {
        EXPECT_EQ(staves_of(program, {48, 62, 55, 72, 59, 60, 84, 61}).size(), 1u) << program;
    }
    EXPECT_EQ(changes(staves_of(vibraphone, {60, 62, 64, 72}).front()), "0 treble");
    // Below the range of the instrument, too.
    EXPECT_EQ(changes(staves_of(vibraphone, {48, 50, 52, 53}).front()), "0 treble");
    EXPECT_EQ(changes(staves_of(12, {48, 50, 52, 53}).front()), "0 bass");
    EXPECT_EQ(changes(staves_of(vibraphone, {}).front()), "0 treble");
    EXPECT_EQ(changes(staves_of(41, {60, 55, 62, 64}).front()), "0 alto");
    EXPECT_EQ(changes(staves_of(24, {52, 60, 64, 55}).front()), "0 treble_8");
    EXPECT_EQ(changes(staves_of(33, {31, 28, 36, 40}).front()), "0 bass_8");
    EXPECT_EQ(changes(staves_of(70, {40, 43, 50, 36}).front()), "0 bass");
    // A celesta is written an octave lower than it sounds.
    EXPECT_EQ(changes(staves_of(8, {86, 89, 91, 96}).front()), "0 treble^8");
    EXPECT_EQ(changes(staves_of(8, {60, 62, 64, 72}).front()), "0 treble");
}

TEST(Notation, ClefsChangeByPhrase) {
    std::vector<double> keys(8, 74);
    keys.insert(keys.end(), 8, 43);
    keys.insert(keys.end(), 8, 74);
    EXPECT_EQ(changes(staves_of(vibraphone, keys).front()), "0 treble, 8 bass, 16 treble");
    // A single low note is no phrase.
    std::vector<double> single(16, 67);
    single[7] = 55;
    EXPECT_EQ(changes(staves_of(vibraphone, single).front()), "0 treble");
}

TEST(Notation, ManyLedgerLinesBecomeALineOf8va) {
    std::vector<double> keys(8, 76);
    keys.insert(keys.end(), 8, 96);
    keys.insert(keys.end(), 8, 76);
    EXPECT_EQ(changes(staves_of(73, keys).front()), "0 treble, 8 treble+1, 16 treble");
    EXPECT_EQ(changes(staves_of(73, std::vector<double>(8, 108)).front()), "0 treble+2");
    EXPECT_EQ(changes(staves_of(58, std::vector<double>(8, 24)).front()), "0 bass-1");
    EXPECT_EQ(changes(staves_of(vibraphone, std::vector<double>(8, 125)).front()), "0 treble+3");
    // The piccolo is written an octave lower, where it is high.
    EXPECT_EQ(changes(staves_of(72, std::vector<double>(8, 92)).front()), "0 treble^8");
    EXPECT_EQ(changes(staves_of(72, std::vector<double>(8, 72)).front()), "0 treble");
    // The double bass never leaves its octave.
    std::vector<double> bass(8, 33);
    bass.insert(bass.end(), 16, 58);
    EXPECT_EQ(changes(staves_of(43, bass).front()), "0 bass_8, 8 treble_8");
}

TEST(Notation, KeyboardsHaveTwoHands) {
    EXPECT_EQ(staves_of(piano, {60, 62, 64, 72, 74, 79}).size(), 1u);
    EXPECT_EQ(staves_of(piano, {40, 43, 45, 48, 52, 55}).size(), 1u);
    std::vector<double> keys(8, 76);
    keys.insert(keys.end(), 8, 43);
    keys[3] = 59;   // stays in the right hand
    keys[12] = 60;  // stays in the left hand
    const std::vector<Staff> staves = staves_of(piano, keys);
    ASSERT_EQ(staves.size(), 2u);
    EXPECT_EQ(changes(staves[0]), "0 treble");
    EXPECT_EQ(changes(staves[1]), "0 bass");
    EXPECT_EQ(keys_of(staves[0]), std::vector<double>(keys.begin(), keys.begin() + 8));
    EXPECT_EQ(keys_of(staves[1]), std::vector<double>(keys.begin() + 8, keys.end()));
}

TEST(Notation, VoicesOfAKeyboardAreSharedBetweenTheHands) {
    TestScore score;
    score.head.parts = {plain_part("Piano", 3)};
    const std::array<double, 3> voice_keys = {48, 67, 72};
    for (std::int16_t voice = 0; voice < 3; ++voice) {
        Note note{.duration = 1920, .key = voice_keys[static_cast<std::size_t>(voice)], .voice = voice};
        score.notes.push_back(note);
    }
    const Notation notation = notate(score);
    EXPECT_EQ(notation.parts[0].bracket, Bracket::brace);
    ASSERT_EQ(notation.parts[0].staves.size(), 2u);
    EXPECT_EQ(keys_of(notation.parts[0].staves[0]), (std::vector<double>{72, 67}));
    EXPECT_EQ(keys_of(notation.parts[0].staves[1]), (std::vector<double>{48}));
}

/// `voices` voices, of which the fourth never sounds.
TestScore many_voices(int voices) {
    TestScore score;
    score.head.parts = {plain_part("Many", voices), plain_part("Silent", 2)};
    for (std::int16_t voice = 0; voice < voices; ++voice) {
        if (voice == 3) continue;
        Note note{.duration = 1920, .key = 90.0 - 2 * voice, .voice = voice};
        score.notes.push_back(note);
    }
    return score;
}

TEST(Notation, AMelodyThatTheLeftHandNeverPlaysHasOneStaff) {
    std::vector<double> keys(8, 74);
    keys.insert(keys.end(), 8, 110);
    EXPECT_EQ(staves_of(piano, keys).size(), 1u);
}

/// Notes of a quarter: voice, onset in quarters, key.
TestScore quarters(Part part, const std::vector<std::tuple<int, double, double>>& list) {
    TestScore score;
    score.head.parts = {std::move(part)};
    for (const auto& [voice, onset, key] : list) {
        Note note{.onset = static_cast<std::int64_t>(onset * 480),
                  .duration = 480,
                  .key = key,
                  .voice = static_cast<std::int16_t>(voice)};
        score.notes.push_back(note);
    }
    score.end = 1920;
    return score;
}

TEST(Notation, AnAccompanimentHasOneStaff) {
    Part part = plain_part("Strings", 3);
    part.is_accompaniment = true;
    part.program = 48;
    const Notation chords =
        notate(quarters(part, {{0, 0, 48}, {1, 0, 55}, {2, 0, 64.14}, {0, 1, 50}, {1, 1, 57}, {2, 1, 65}}));
    ASSERT_EQ(chords.parts[0].staves.size(), 1u);
    ASSERT_EQ(chords.parts[0].staves[0].voices.size(), 1u);
    const NotatedSymbol& first = chords.parts[0].staves[0].voices[0].symbols[0];
    ASSERT_EQ(first.chord.size(), 2u);
    EXPECT_EQ(printed_cents(first), std::vector<int>{14});
    // What it repeats is printed once.
    const Notation bars = notate(quarters(part, {{0, 0, 48}, {1, 0, 55.02}, {0, 4, 48}, {1, 4, 55.02}}));
    const std::vector<NotatedSymbol>& fifths = bars.parts[0].staves[0].voices[0].symbols;
    EXPECT_EQ(printed_cents(fifths[0]), std::vector<int>{2});
    const auto second = std::find_if(fifths.begin(), fifths.end(),
                                     [](const NotatedSymbol& symbol) { return symbol.onset == 4 * 480; });
    ASSERT_NE(second, fifths.end());
    EXPECT_EQ(printed_cents(*second), std::vector<int>{});
    // Voices with rhythms of their own stay apart, wherever they meet.
    const Notation drone = notate(quarters(part, {{0, 0, 55}, {0, 1, 60}, {1, 0, 48}}));
    ASSERT_EQ(drone.parts[0].staves.size(), 1u);
    ASSERT_EQ(drone.parts[0].staves[0].voices.size(), 2u);
    EXPECT_TRUE(drone.parts[0].staves[0].voices[0].symbols[0].chord.empty());
}

constexpr int foot = 36;
constexpr int snare = 38;
constexpr int ride = 51;

Part drum_part(int voices) {
    Part part = plain_part("Drums", voices);
    part.is_drums = true;
    return part;
}

TEST(Notation, DrumsAreHandsAndFeet) {
    // Every beat a ride, a snare with two of them, a bass drum on the first and between the third and the fourth.
    const Notation notation = notate(quarters(drum_part(3), {{0, 0, ride},
                                                             {0, 1, ride},
                                                             {0, 2, ride},
                                                             {0, 3, ride},
                                                             {1, 1, snare},
                                                             {1, 3, snare},
                                                             {2, 0, foot},
                                                             {2, 2.5, foot}}));
    ASSERT_EQ(notation.parts[0].staves.size(), 1u);
    const Staff& staff = notation.parts[0].staves[0];
    ASSERT_EQ(staff.voices.size(), 2u);
    EXPECT_EQ(words(notation), "4 4 4 4");
    EXPECT_EQ(staff.voices[0].symbols[1].chord.size(), 1u);
    std::string feet;
    for (const NotatedSymbol& symbol : staff.voices[1].symbols) {
        feet += symbol.kind == SymbolKind::note ? "x" : "r";
        feet += std::to_string(symbol.value.divisor);
        EXPECT_FALSE(symbol.tied_forward);
    }
    EXPECT_EQ(feet, "x4r4r8x8r4");
}

TEST(Notation, StrokesHaveNoTies) {
    // A stroke for two thirds of a beat, over the end of the beat.
    TestScore score = quarters(drum_part(1), {{0, 0, ride}, {0, 1, ride}});
    score.notes[0].onset = 320;
    score.notes[0].duration = 320;
    score.notes[1].onset = 960;
    const Notation notation = notate(score);
    for (const NotatedSymbol& symbol : notation.parts[0].staves[0].voices[0].symbols) {
        EXPECT_FALSE(symbol.tied_forward || symbol.tied_back);
    }
    EXPECT_EQ(words(notation), "r4 8 r4 4 r4");
    EXPECT_EQ(notation.moved, 0u);
    // One drum alone has one line.
    EXPECT_EQ(notation.parts[0].staves[0].lines, 1);
}

TEST(Notation, LinesThatFitNoGridStayApart) {
    // Triplets against 16ths.
    TestScore score = quarters(drum_part(2), {});
    for (std::int16_t voice = 0; voice < 2; ++voice) {
        const std::int64_t step = voice == 0 ? 160 : 120;
        for (std::int64_t onset = 0; onset < 480; onset += step) {
            Note note{.onset = onset,
                      .duration = step,
                      .key = static_cast<double>(voice == 0 ? ride : snare),
                      .voice = voice};
            score.notes.push_back(note);
        }
    }
    const Notation notation = notate(score);
    EXPECT_EQ(notation.parts[0].staves[0].voices.size(), 2u);
    EXPECT_EQ(notation.moved, 0u);
}

TEST(Notation, PartsOfOneNameAreNumbered) {
    TestScore score;
    Part part = plain_part("Acoustic Grand Piano", 1);
    part.has_instrument_name = true;
    score.head.parts = {part, plain_part("Mridangam of the left", 1), part};
    for (std::int16_t voice = 0; voice < 3; ++voice) {
        Note note{.duration = 1920, .voice = voice};
        score.notes.push_back(note);
    }
    score.notes[2].key = 40;
    // Two lines of one keyboard are for two hands.
    EXPECT_EQ(notate(score).parts.size(), 2u);
    score.head.parts[0].program = score.head.parts[2].program = 40;
    const Notation notation = notate(score);
    ASSERT_EQ(notation.parts.size(), 3u);
    EXPECT_EQ(notation.parts[0].name + ", " + notation.parts[0].abbreviation, "Violin 1, Vln. 1");
    EXPECT_EQ(notation.parts[1].name + ", " + notation.parts[1].abbreviation, "Mridangam of the left, Mridangam");
    EXPECT_EQ(notation.parts[2].name + ", " + notation.parts[2].abbreviation, "Violin 2, Vln. 2");
}

TEST(Notation, PartsOnOneTonicHaveOneSignature) {
    TestScore score;
    score.head.parts = {plain_part("Major", 1), plain_part("Minor", 1), plain_part("Elsewhere", 1)};
    score.head.parts[0].key = KeySignature{0, false};
    score.head.parts[1].key = KeySignature{-3, true};
    score.head.parts[1].spelling = spelling_of({0, 2, 3, 5, 7, 8, 10}, {0, 0});
    score.head.parts[2].key = KeySignature{1, false};
    const auto add = [&](std::int16_t voice, const std::vector<double>& keys) {
        for (std::size_t i = 0; i < keys.size(); ++i) {
            Note note{.onset = static_cast<std::int64_t>(i) * 480, .duration = 480, .key = keys[i], .voice = voice};
            score.notes.push_back(note);
        }
    };
    add(0, {60, 64, 65});  // a sign in minor
    add(1, {60, 63, 68});  // two signs in major
    add(2, {66});          // F# is in neither
    const auto fifths = [](const Notation& notation) {
        std::vector<int> list;
        for (const NotatedPart& part : notation.parts) list.push_back(part.keys.front().key->fifths);
        return list;
    };
    EXPECT_EQ(fifths(notate(score)), (std::vector<int>{-3, -3, 1}));
    score.notes.back().key = 67;  // G is in all
    EXPECT_EQ(fifths(notate(score)), (std::vector<int>{-3, -3, -3}));
}

TEST(Notation, EveryVoiceHasAStaff) {
    const TestScore score = many_voices(12);
    const Notation notation = notate(score);
    ASSERT_EQ(notation.parts[0].staves.size(), 11u);
    EXPECT_EQ(notation.parts[0].bracket, Bracket::bracket);
    for (const Staff& staff : notation.parts[0].staves) EXPECT_EQ(staff.voices.size(), 1u);
    EXPECT_EQ(notation.parts[0].staves[3].voices[0].voice, 4);
    ASSERT_EQ(notation.parts[1].staves.size(), 1u);
    EXPECT_EQ(notation.parts[1].staves[0].voices[0].symbols.front().kind, SymbolKind::bar_rest);
    EXPECT_EQ(joined(notation), plain(score.notes));
}

TEST(Notation, VeryManyVoicesShareStavesAndMergeUnisons) {
    TestScore score = many_voices(25);
    const Notation notation = notate(score);
    ASSERT_EQ(notation.parts[0].staves.size(), 12u);
    for (const Staff& staff : notation.parts[0].staves) EXPECT_EQ(staff.voices.size(), 2u);
    EXPECT_EQ(joined(notation), plain(score.notes));
    for (Note& note : score.notes) note.key = note.voice < 10 ? 60 : 64;
    const Notation merged = notate(score);
    EXPECT_EQ(merged.merged, 22u);
    ASSERT_EQ(merged.parts[0].staves.size(), 2u);
    EXPECT_EQ(keys_of(merged.parts[0].staves[0]), (std::vector<double>{64}));
    EXPECT_EQ(keys_of(merged.parts[0].staves[1]), (std::vector<double>{60}));
}

TEST(Notation, OneRestOfABarIsEnough) {
    TestScore score;
    score.head.parts = {plain_part("Four", 4)};
    Note note;
    for (std::int16_t voice = 0; voice < 4; ++voice) {
        note.voice = voice;
        note.key = 80 - 10 * voice;
        note.duration = 1920;
        note.onset = 1920 * (1 + voice % 2);
        score.notes.push_back(note);
    }
    score.end = 4 * 1920;
    const Notation notation = notate(score);
    const auto kinds = [&](std::size_t voice) {
        std::vector<SymbolKind> list;
        for (const NotatedSymbol& symbol : notation.parts[0].staves[0].voices[voice].symbols)
            list.push_back(symbol.kind);
        return list;
    };
    EXPECT_EQ(kinds(0), (std::vector{SymbolKind::bar_rest, SymbolKind::note, SymbolKind::gap, SymbolKind::bar_rest}));
    EXPECT_EQ(kinds(1), (std::vector{SymbolKind::gap, SymbolKind::gap, SymbolKind::note, SymbolKind::gap}));
}

TEST(Notation, DynamicsFollowTheVelocities) {
    using Kind = DynamicMark::Kind;
    const auto marks = [](const std::vector<int>& velocities) {
        TestScore score = line({4, 4}, std::vector<std::int64_t>(velocities.size(), 1920));
        for (std::size_t i = 0; i < velocities.size(); ++i) {
            score.notes[i].velocity = static_cast<std::uint8_t>(velocities[i]);
        }
        return notate(score).parts[0].staves[0].dynamics;
    };
    EXPECT_EQ(marks({80, 78, 84, 75}), (std::vector<DynamicMark>{{0, Kind::level, 4}}));
    EXPECT_EQ(marks({33, 112}), (std::vector<DynamicMark>{{0, Kind::level, 1}, {1920, Kind::level, 6}}));
    // The border between two levels is not crossed by a step.
    EXPECT_EQ(marks({80, 71, 73, 71, 89}), (std::vector<DynamicMark>{{0, Kind::level, 4}}));
    // From bar 2 on it rises, until it is forte in bar 4.
    EXPECT_EQ(
        marks({80, 78, 84, 94, 95}),
        (std::vector<DynamicMark>{{0, Kind::level, 4}, {1920, Kind::crescendo, 4}, {3 * 1920, Kind::level, 5}}));
    EXPECT_EQ(marks({1, 127}).front().level, 0);
    EXPECT_EQ(marks({1, 127}).back().level, 7);
}

TEST(Notation, HairpinsEndBeforeRests) {
    using Kind = DynamicMark::Kind;
    TestScore score = line({4, 4}, {960, 480, -480, 1920});
    score.notes[0].velocity = score.notes[1].velocity = 48;
    score.notes[2].velocity = 96;
    EXPECT_EQ(notate(score).parts[0].staves[0].dynamics,
              (std::vector<DynamicMark>{
                  {0, Kind::level, 2}, {0, Kind::crescendo, 2}, {1440, Kind::end, 2}, {1920, Kind::level, 5}}));
    // A single note has none.
    TestScore single = line({4, 4}, {960, -960, 1920});
    single.notes[0].velocity = 48;
    single.notes[1].velocity = 96;
    EXPECT_EQ(notate(single).parts[0].staves[0].dynamics,
              (std::vector<DynamicMark>{{0, Kind::level, 2}, {1920, Kind::level, 5}}));
}

TEST(Notation, LoudNotesHaveAccents) {
    TestScore score = line({4, 4}, std::vector<std::int64_t>(8, 480));
    score.notes[2].velocity = 110;
    const Notation notation = notate(score);
    const auto& symbols = notation.parts[0].staves[0].voices[0].symbols;
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(symbols[i].is_accented, i == 2) << i;
    score.notes[2].velocity = 80;
    for (std::size_t i = 1; i < 8; i += 2) score.notes[i].velocity = 110;
    const Notation many = notate(score);
    for (const NotatedSymbol& symbol : many.parts[0].staves[0].voices[0].symbols) EXPECT_FALSE(symbol.is_accented);
}

TEST(Notation, SignsHoldToTheEndOfTheBar) {
    const auto signs = [](const std::vector<double>& keys, std::optional<KeySignature> key, std::int64_t length) {
        TestScore score = line({4, 4}, std::vector<std::int64_t>(keys.size(), length));
        score.head.parts[0].spelling = spelling_of({0, 2, 4, 5, 7, 9, 11}, {4, 0});  // G major: F#
        score.head.parts[0].key = key;
        for (std::size_t i = 0; i < keys.size(); ++i) score.notes[i].key = keys[i];
        std::string text;
        const Notation notation = notate(score);
        for (const NotatedSymbol& symbol : notation.parts[0].staves[0].voices[0].symbols) {
            if (symbol.kind == SymbolKind::note) text += symbol.has_sign ? 'x' : '.';
        }
        return text;
    };
    const KeySignature g_major{1, false};
    EXPECT_EQ(signs({66, 66, 78, 66}, {}, 480), "x.x.");
    EXPECT_EQ(signs({66, 66, 66, 66}, g_major, 480), "....");
    EXPECT_EQ(signs({65, 65, 66, 66, 65}, g_major, 480), "x.x.x");
    EXPECT_EQ(signs({66, 66, 66, 66, 66, 66}, {}, 960), "x.x.x.");
    // Tied over the bar line: no sign, and the next note has it again.
    EXPECT_EQ(signs({66, 66}, {}, 5 * 480), "x.x.");
}

TEST(Notation, KeySignaturesSetSigns) {
    EXPECT_EQ(signs_of(KeySignature{2, false}), (std::array{1, 0, 0, 1, 0, 0, 0}));
    EXPECT_EQ(signs_of(KeySignature{-3, true}), (std::array{0, 0, -1, 0, 0, -1, -1}));
    EXPECT_EQ(signs_of(KeySignature{7, false}), (std::array{1, 1, 1, 1, 1, 1, 1}));
    EXPECT_EQ(signs_of(KeySignature{-7, false}), (std::array{-1, -1, -1, -1, -1, -1, -1}));
    EXPECT_EQ(signs_of(std::nullopt), (std::array{0, 0, 0, 0, 0, 0, 0}));
}

TEST(Notation, PitchesAreSpelledToTheQuarterTone) {
    const auto c_major = spelling_of({0, 2, 4, 5, 7, 9, 11}, {0, 0});
    EXPECT_EQ(spelled(60, c_major), (Pitch{0, 4, 0}));
    EXPECT_EQ(spelled(127, c_major), (Pitch{4, 9, 0}));
    EXPECT_EQ(spelled(0, c_major), (Pitch{0, -1, 0}));
    EXPECT_EQ(spelled(59.8, c_major), (Pitch{0, 4, 0}));
    // Rast: E and B half flat.
    const auto rast = spelling_of({0, 2, 3.5, 5, 7, 9, 10.5}, {0, 0});
    EXPECT_EQ(spelled(63.5, rast), (Pitch{2, 4, -1}));
    EXPECT_EQ(spelled(70.5, rast), (Pitch{6, 4, -1}));
    EXPECT_EQ(spelled(63.3, rast), (Pitch{2, 4, -1}));
    EXPECT_EQ(spelled(63.2, rast), (Pitch{2, 4, -2}));
    EXPECT_EQ(spelled(65.5, c_major).quarters, 1);  // F half sharp
    for (int tonic = 0; tonic < 7; ++tonic) {
        for (int sign = -2; sign <= 2; ++sign) {
            for (const auto& steps : std::vector<std::vector<double>>{{0, 2, 4, 5, 7, 9, 11}, {0, 3, 5, 6, 7, 10}}) {
                const auto spelling = spelling_of(steps, {tonic, sign});
                for (int half = 0; half <= 254; ++half) {
                    const Pitch pitch = spelled(0.5 * half, spelling);
                    EXPECT_EQ(pitch.key(), 0.5 * half);
                    EXPECT_LE(std::abs(pitch.quarters), 4);
                }
            }
        }
    }
}

TEST(Notation, WhatIsNoQuarterToneIsCounted) {
    TestScore score = line({4, 4}, {480, 480, 480, 480});
    score.notes[0].key = 60.5;
    score.notes[1].key = 63.8631;  // just third
    score.notes[2].key = 60.009;
    score.notes[3].key = 60.3;
    const Notation notation = notate(score);
    EXPECT_EQ(notation.bent, 2u);
    const auto& symbols = notation.parts[0].staves[0].voices[0].symbols;
    EXPECT_EQ(symbols[1].pitch.key(), 64);
    EXPECT_EQ(symbols[3].pitch.key(), 60.5);
    EXPECT_EQ(symbols[0].cents, 0);
    EXPECT_EQ(symbols[1].cents, -14);
    EXPECT_EQ(symbols[2].cents, 0);
    EXPECT_EQ(symbols[3].cents, -20);
}

TEST(Notation, RefusesWhatNobodyPrints) {
    TestScore score = line({4, 4}, {});
    std::vector<Note> notes(200'001);
    for (std::size_t i = 0; i < notes.size(); ++i) {
        notes[i].onset = static_cast<std::int64_t>(i) * 120;
        notes[i].duration = 120;
    }
    Notator fits(score.head);
    fits.notes(std::span(notes).first(200'000));
    fits.finish(200'000 * 120);
    EXPECT_EQ(fits.notation().bars, 12'500);
    Notator overflows(score.head);
    try {
        overflows.notes(std::span(notes).first(100'000));
        overflows.notes(std::span(notes).subspan(100'000));
        FAIL();
    } catch (const ScoreError& error) {
        EXPECT_TRUE(has(error.what(), "200000"));
        EXPECT_TRUE(has(error.what(), "limit the bars"));
    }
    Notator long_one(score.head);
    EXPECT_THROW(long_one.finish(std::int64_t{1920} * 100'001), ScoreError);
    Notator stranger(score.head);
    Note note{.voice = 1};
    EXPECT_THROW(stranger.notes({&note, 1}), ScoreError);
    note.voice = -1;
    EXPECT_THROW(stranger.notes({&note, 1}), ScoreError);
}

}  // namespace sikku::notation_test
