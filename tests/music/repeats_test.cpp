// tests/music/repeats_test.cpp: repeat signs: compares the passages with those of a second algorithm, and the notes
// that are read from sign to sign.
#include "music/score/repeats.h"

#include "music/score/dynamics.h"
#include "music/score/player_parts.h"
#include "music/score/score_formats.h"
#include "music/scores.h"
#include "tests/notation_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <regex>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::repeats_test {

/// Bars named by letters: equal letters are equal bars, `-` is silent; `|` before a bar: something changes there; `_`
/// before a bar, or at the end: a note crosses the bar line.
ComparedBars bars_of(const std::string& text) {
    ComparedBars bars;
    bool is_change = false;
    bool is_open = false;
    for (const char letter : text) {
        if (letter == '|') {
            is_change = true;
        } else if (letter == '_') {
            is_open = true;
        } else if (letter != ' ') {
            bars.contents.push_back(static_cast<std::uint32_t>(letter));
            bars.is_silent.push_back(letter == '-');
            bars.is_change.push_back(std::exchange(is_change, false));
            bars.is_open.push_back(std::exchange(is_open, false));
        }
    }
    bars.is_open.push_back(is_open);
    return bars;
}

/// The bars as they are printed: `|: abcd :|`, `|: abc |1 d :|2 e |` and `|: abcd :|3` for three times.
std::string printed(const std::string& letters) {
    const ComparedBars bars = bars_of(letters);
    std::string text;
    std::size_t here = 0;
    const auto put = [&](std::size_t end) {
        for (; here < end; ++here) text += static_cast<char>(bars.contents[here]);
    };
    for (const RepeatedBars& repeat : find_repeats(bars)) {
        put(repeat.first);
        text += text.empty() ? "|: " : " |: ";
        put(repeat.first + repeat.count - repeat.ending);
        if (repeat.ending > 0) {
            text += repeat.times > 2 ? " |1-" + std::to_string(repeat.times - 1) + " " : " |1 ";
            put(repeat.first + repeat.count);
            text += " :|" + std::to_string(repeat.times) + " ";
            here = repeat.end() - repeat.ending;
            put(repeat.end());
            text += " | ";
        } else {
            text += " :|" + (repeat.times > 2 ? std::to_string(repeat.times) : "") + " ";
            here = repeat.end();
        }
    }
    put(bars.contents.size());
    while (text.ends_with(' ')) text.pop_back();
    return text;
}

TEST(Repeats, PassagesAreFound) {
    EXPECT_EQ(printed("abcdabcd"), "|: abcd :|");
    EXPECT_EQ(printed("abcdefghabcdefghijklmnopabcdefgh"), "|: abcdefgh :| ijklmnopabcdefgh");
    EXPECT_EQ(printed("abcdabcdefghefgh"), "|: abcd :|  |: efgh :|");
    EXPECT_EQ(printed("abcdefgabcdefxyz"), "|: abcdef |1 g :|2 x | yz");
    EXPECT_EQ(printed("abcdefghabcdefyz"), "|: abcdef |1 gh :|2 yz |");
}

TEST(Repeats, PassagesHaveFourBarsAndThreeOfThemAreEqual) {
    EXPECT_EQ(printed("abcabc"), "abcabc");
    EXPECT_EQ(printed("abcdabcx"), "|: abc |1 d :|2 x |");
    EXPECT_EQ(printed("abcdabxy"), "abcdabxy");
    EXPECT_EQ(printed("abcdefghabcdexyz"), "abcdefghabcdexyz");
    EXPECT_EQ(printed("xabcdeyzabcdexw"), "xabcdeyzabcdexw");
    EXPECT_EQ(printed("a"), "a");
    EXPECT_EQ(printed(""), "");
}

TEST(Repeats, PassagesArePlayedUpToFourTimes) {
    EXPECT_EQ(printed("abcdabcdabcd"), "|: abcd :|3");
    EXPECT_EQ(printed("abcdabcdabcdabcd"), "|: abcd :|4");
    EXPECT_EQ(printed("abcdabcdabcdabcdabcd"), "|: abcd :|4 abcd");
    EXPECT_EQ(printed("abcdabcdabcdabcdabcdabcdabcdabcd"), "|: abcdabcd :|4");
    EXPECT_EQ(printed("abcdabcdabcx"), "|: abc |1-2 d :|3 x |");
    EXPECT_EQ(printed(std::string(100, 'a')), "|: " + std::string(25, 'a') + " :|4");
    EXPECT_EQ(printed("aaaaaaa"), "aaaaaaa");
    EXPECT_EQ(printed("aaaaaaaa"), "|: aaaa :|");
}

TEST(Repeats, NothingCrossesTheirBordersOrChangesWithin) {
    EXPECT_EQ(printed("abcd|abcd"), "abcdabcd");
    EXPECT_EQ(printed("ab|cdabcd"), "abcdabcd");
    EXPECT_EQ(printed("|abcdabcd|x"), "|: abcd :| x");
    EXPECT_EQ(printed("abcd_abcd"), "abcdabcd");
    EXPECT_EQ(printed("abcdabcd_x"), "abcdabcdx");
    EXPECT_EQ(printed("x_abcdabcd"), "xabcdabcd");
    EXPECT_EQ(printed("a_bc_da_bc_d"), "|: abcd :|");
    EXPECT_EQ(printed("abcdabce_fg"), "|: abc |1 d :|2 e | fg");
    // The ending begins earlier.
    EXPECT_EQ(printed("abcdefg_habcdefg_x"), "|: abcdef |1 gh :|2 gx |");
    // The passage begins later.
    EXPECT_EQ(printed("x_abcdeabcdeab"), "xa |: bcdea :| b");
}

TEST(Repeats, PassagesBeginWithABarThatSounds) {
    EXPECT_EQ(printed("-abcdefg-abcdefg-"), "- |: abcdefg- :|");
    EXPECT_EQ(printed("--ab--ab"), "|: --ab :|");
}

/// True if the bars from a on and those from b on are equal, also in the notes that lead into them.
bool are_equal(const ComparedBars& bars, std::size_t a, std::size_t b, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        if (bars.contents[a + i] != bars.contents[b + i] || bars.is_open[a + i] != bars.is_open[b + i]) return false;
    }
    return true;
}

bool is_possible(const ComparedBars& bars, const RepeatedBars& one) {
    if (bars.is_open[one.end()]) {
        // A note can be held over the end only if the second ending differs.
        const std::size_t last = one.end() - one.count;
        if (one.ending == 0 || are_equal(bars, one.first, last, one.count)) return false;
    }
    for (std::size_t pass = 0; pass < one.times; ++pass) {
        if (bars.is_open[one.first + pass * one.count]) return false;
        if (one.ending > 0 && bars.is_open[one.first + (pass + 1) * one.count - one.ending]) return false;
        const std::size_t equal = one.count - (pass + 1 == one.times ? one.ending : 0);
        if (!are_equal(bars, one.first, one.first + pass * one.count, equal)) return false;
    }
    for (std::size_t i = one.first + 1; i < one.end(); ++i) {
        if (bars.is_change[i]) return false;
    }
    return true;
}

/// All passages of all lengths, one after the other, and the best of them; then the same before and after it.
void choose_slowly(const ComparedBars& bars, std::size_t most, std::size_t from, std::size_t to,
                   std::vector<RepeatedBars>& chosen) {
    const auto rank = [&](const RepeatedBars& one) {
        return std::tuple(one.saved(), one.count, !bars.is_silent[one.first], -static_cast<long>(one.first));
    };
    std::optional<RepeatedBars> best;
    for (std::size_t count = 4; from + 2 * count <= to; ++count) {
        for (std::size_t first = from; first + 2 * count <= to; ++first) {
            for (std::size_t times = 2; times <= most && first + times * count <= to; ++times) {
                for (std::size_t ending = 0; ending <= count / 4; ++ending) {
                    const RepeatedBars one{first, count, ending, times};
                    if (is_possible(bars, one) && (!best || rank(one) > rank(*best))) best = one;
                }
            }
        }
    }
    if (!best) return;
    choose_slowly(bars, most, from, best->first, chosen);
    chosen.push_back(*best);
    choose_slowly(bars, most, best->end(), to, chosen);
}

std::string text_of(const std::vector<RepeatedBars>& repeats) {
    std::string text;
    for (const RepeatedBars& one : repeats) {
        text += std::to_string(one.first) + ": " + std::to_string(one.times) + " times " + std::to_string(one.count) +
                " ending " + std::to_string(one.ending) + "\n";
    }
    return text;
}

TEST(Repeats, TheyAreThoseOfASlowSearch) {
    std::size_t found = 0, with_endings = 0, often = 0;
    for (unsigned seed = 0; seed < 2000; ++seed) {
        std::mt19937 random(seed);
        const auto below = [&](unsigned limit) { return static_cast<unsigned>(random() % limit); };
        ComparedBars bars;
        const unsigned letters = 1 + below(5);
        const unsigned crossed = below(3) == 0 ? 0 : 2 + below(12);
        const unsigned changing = below(2) == 0 ? 0 : 5 + below(30);
        const std::size_t count = below(70);
        const std::size_t most = 2 + below(3);
        while (bars.contents.size() < count) {
            // Some bars of before, or new ones.
            const std::size_t known = bars.contents.size();
            const std::size_t source = known > 0 && below(3) > 0 ? below(static_cast<unsigned>(known)) : known;
            for (std::size_t i = 0; i < 1 + below(12); ++i) {
                const bool is_copy = source + i < bars.contents.size() && below(20) > 0;
                bars.contents.push_back(is_copy ? bars.contents[source + i] : below(letters));
                bars.is_open.push_back(is_copy ? bars.is_open[source + i] : crossed > 0 && below(crossed) == 0);
                bars.is_change.push_back(changing > 0 && below(changing) == 0);
            }
        }
        for (const std::uint32_t content : bars.contents) bars.is_silent.push_back(content == 0);
        bars.is_open.push_back(crossed > 0 && below(crossed) == 0);
        std::vector<RepeatedBars> slow;
        choose_slowly(bars, most, 0, bars.contents.size(), slow);
        ASSERT_EQ(text_of(find_repeats(bars, most)), text_of(slow)) << "seed " << seed;
        found += slow.size();
        for (const RepeatedBars& one : slow) {
            with_endings += one.ending > 0 ? 1 : 0;
            often += one.times > 2 ? 1 : 0;
        }
    }
    EXPECT_GT(found, 2000u);
    EXPECT_GT(with_endings, 250u);
    EXPECT_GT(often, 250u);
}

/// Sections of random notes in a random order, some of them with another note towards their end; perhaps an upbeat,
/// other meters and tempos, louder and softer bars.
TestScore random_form(unsigned seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    TestScore source = random_score(2 * seed, seed % 5 == 0);
    const std::int64_t bar = source.head.meter.bar();
    const auto bars = static_cast<std::int64_t>(4 + below(5));
    const bool is_clipped = below(3) > 0;
    const std::size_t loudness = below(3);
    std::vector<std::vector<Note>> sections(3);
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const std::int64_t from = static_cast<std::int64_t>(i) * bars * bar;
        for (Note note : source.notes) {
            note.onset -= from;
            if (note.onset < 0 || note.onset >= bars * bar) continue;
            if (is_clipped) note.duration = std::min(note.duration, bars * bar - note.onset);
            note.velocity = static_cast<std::uint8_t>(loudness == 0   ? 80
                                                      : loudness == 1 ? 30 + 8 * (note.onset / bar)
                                                                      : 40 + 8 * (note.onset / bar * 7 % 8));
            if (seed % 3 > 0) note.chord = {0, static_cast<std::int8_t>(note.onset / bar * 5 % 12)};
            note.is_sliding = below(40) == 0;
            sections[i].push_back(note);
        }
    }
    TestScore score;
    score.head = source.head;
    score.head.changes.clear();
    score.head.has_chord_signs = true;
    score.head.upbeat = seed % 4 == 0 ? bar / 4 : 0;
    std::map<int, std::int64_t> free;  // where the last note of a voice ends
    std::size_t section = 0;
    for (std::size_t i = 0; i < 3 + below(6); ++i) {
        if (below(2)) section = below(sections.size());
        if (i > 0 && score.head.upbeat == 0 && below(6) == 0) {
            TempoAndMeter frame{score.head.tempo + static_cast<double>(i), {}, score.head.meter};
            score.head.changes.push_back({score.end, frame});
        }
        const std::size_t changed = below(3) == 0 ? below(6) : 0;
        const std::vector<Note>& notes = sections[section];
        for (std::size_t k = 0; k < notes.size(); ++k) {
            Note note = notes[k];
            if (k + changed >= notes.size()) note.key += 1;
            note.onset += score.end;
            if (note.onset < free[note.voice]) continue;
            free[note.voice] = note.onset + note.duration;
            score.notes.push_back(note);
        }
        score.end += bars * bar;
    }
    return score;
}

/// Bars of the print, and where they are played.
struct PlayedStretch {
    std::int64_t from = 0;
    std::int64_t to = 0;
    std::int64_t at = 0;
};

/// A print as it is played, sign after sign.
std::vector<PlayedStretch> played(const Notation& notation) {
    std::vector<PlayedStretch> stretches;
    std::int64_t at = 0;
    const auto play = [&](std::int64_t from, std::int64_t to) {
        if (to > from) stretches.push_back({from, to, at});
        at += to - from;
    };
    std::int64_t here = 0;
    for (const PrintedRepeat& repeat : notation.repeats) {
        play(here, repeat.begin);
        for (std::size_t pass = 1; pass < repeat.times; ++pass) play(repeat.begin, repeat.end);
        play(repeat.begin, repeat.ending);
        play(repeat.end, repeat.last);
        here = repeat.last;
    }
    play(here, notation.end());
    return stretches;
}

using PlayedNote = std::tuple<std::int64_t, std::size_t, double, int, std::int64_t, bool, bool, int, bool, bool>;
/// All noteheads of a print, each as often as it is played.
std::vector<PlayedNote> noteheads(const Notation& notation) {
    std::vector<PlayedNote> notes;
    for (const PlayedStretch& stretch : played(notation)) {
        for (std::size_t part = 0; part < notation.parts.size(); ++part) {
            for (const Staff& staff : notation.parts[part].staves) {
                for (const NotatedVoice& voice : staff.voices) {
                    for (const NotatedSymbol& symbol : voice.symbols) {
                        if (symbol.kind != SymbolKind::note || symbol.onset < stretch.from ||
                            symbol.onset >= stretch.to) {
                            continue;
                        }
                        const std::int64_t onset = symbol.onset - stretch.from + stretch.at;
                        const auto add = [&](const Pitch& pitch, int drum) {
                            notes.emplace_back(onset, part, pitch.key(), drum, symbol.length, symbol.tied_back,
                                               symbol.tied_forward, symbol.value.divisor, symbol.value.dotted,
                                               symbol.tuplet >= 0);
                        };
                        add(symbol.pitch, symbol.drum);
                        for (const ChordNote& other : symbol.chord) add(other.pitch, other.drum);
                    }
                }
            }
        }
    }
    std::sort(notes.begin(), notes.end());
    return notes;
}

/// The last element that begins up to a tick; null: none.
template <class Change>
const Change* in_force(const std::vector<Change>& changes, std::int64_t tick) {
    const Change* last = nullptr;
    for (const Change& change : changes) {
        if (change.onset <= tick) last = &change;
    }
    return last;
}

/// Reads what is in force at each symbol of a staff in each pass. It has to be the same whenever a place is read.
void expect_one_meaning(const Notation& notation, const NotatedPart& part, const Staff& staff) {
    std::map<std::int64_t, std::tuple<int, int, int>> known;
    int level = -1;
    int chord = -1;
    int root = -1;
    const auto levels = [&] {
        std::vector<DynamicMark> marks;
        for (const DynamicMark& mark : staff.dynamics) {
            if (mark.kind == DynamicMark::Kind::level) marks.push_back(mark);
        }
        return marks;
    }();
    for (const PlayedStretch& stretch : played(notation)) {
        for (const NotatedSymbol& symbol : staff.voices.front().symbols) {
            if (symbol.onset < stretch.from || symbol.onset >= stretch.to) continue;
            // What is stated in this stretch up to here.
            const DynamicMark* stated = in_force(levels, symbol.onset);
            if (stated && stated->onset >= stretch.from) level = stated->level;
            const ChordMark* named = in_force(part.chords, symbol.onset);
            if (named && named->onset >= stretch.from) {
                chord = named->quality;
                root = named->root.height();
            }
            if (symbol.kind != SymbolKind::note) continue;
            const std::tuple<int, int, int> now(level, chord, root);
            EXPECT_EQ(known.try_emplace(symbol.onset, now).first->second, now) << "at " << symbol.onset;
        }
    }
}

/// No slur, hairpin or 8va line crosses a sign, and each clef is the one that was read last.
void expect_clean_borders(const Notation& notation, const Staff& staff) {
    for (const std::int64_t border : jumps_of(notation.repeats)) {
        for (const NotatedVoice& voice : staff.voices) {
            bool is_in_slur = false;
            for (const NotatedSymbol& symbol : voice.symbols) {
                if (symbol.onset >= border) break;
                EXPECT_LE(symbol.onset + symbol.length, border);
                is_in_slur = (is_in_slur || symbol.begins_slur) && !symbol.ends_slur;
                const bool is_before = symbol.onset + symbol.length == border;
                EXPECT_FALSE(is_before && (symbol.tied_forward || symbol.begins_slide));
            }
            EXPECT_FALSE(is_in_slur);
        }
        for (std::size_t i = 0; i < staff.dynamics.size(); ++i) {
            const DynamicMark& mark = staff.dynamics[i];
            if (mark.onset >= border || mark.kind == DynamicMark::Kind::level ||
                mark.kind == DynamicMark::Kind::end) {
                continue;
            }
            ASSERT_LT(i + 1, staff.dynamics.size());
            EXPECT_LT(staff.dynamics[i + 1].onset, border);
        }
        const StaffChange* before = in_force(staff.changes, border - 1);
        const StaffChange* here = in_force(staff.changes, border);
        if (before && before->octaves != 0) {
            EXPECT_EQ(here->onset, border);
            EXPECT_TRUE(here->restarts_line || here->octaves != before->octaves);
        }
    }
    for (const PrintedRepeat& repeat : notation.repeats) {
        if (!repeat.has_endings()) continue;
        const Clef read =
            repeat.ending == 0 ? staff.changes.front().clef : in_force(staff.changes, repeat.ending - 1)->clef;
        const StaffChange* second = in_force(staff.changes, repeat.end);
        EXPECT_TRUE(second->clef == read || (second->onset == repeat.end));
        const StaffChange* first = in_force(staff.changes, repeat.end - 1);
        if (first->clef != read) {
            EXPECT_EQ(second->onset, repeat.end);
            EXPECT_TRUE(second->restates_clef || second->clef != first->clef);
        }
    }
}

/// Numbers of rests end at each sign, and cues lie between signs.
void expect_clean_parts(const Notation& notation, std::size_t& rests, std::size_t& cues) {
    for (const PlayerPart& player : player_parts(notation, true)) {
        const Notation& own = player.notation;
        EXPECT_EQ(own.repeats.size(), notation.repeats.size());
        for (const auto& [bar, count] : own.gathered_rests) {
            const std::int64_t from = own.bar_lines.onset(bar);
            const std::int64_t to = own.bar_lines.onset(bar + count);
            for (const std::int64_t border : borders_of(own.repeats)) EXPECT_FALSE(from < border && border < to);
            ++rests;
        }
        for (const Staff& staff : own.parts.front().staves) {
            for (const Cue& cue : staff.cues) {
                for (const std::int64_t jump : jumps_of(own.repeats)) EXPECT_FALSE(cue.from < jump && jump < cue.to);
                for (const PrintedRepeat& repeat : own.repeats) EXPECT_NE(cue.to, repeat.end);
                ++cues;
            }
        }
    }
}

TEST(Repeats, ArePlayedAsTheScoreWithoutThem) {
    std::size_t found = 0, with_endings = 0, often = 0, with_upbeat = 0, changing = 0, rests = 0, cues = 0,
                chords = 0;
    for (unsigned seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(seed);
        TestScore score = random_form(seed);
        const Notation plain = notate(score);
        score.head.most_repeats = 2 + seed % 3;
        const Notation folded = notate(score);
        EXPECT_EQ(folded.played_bars(), plain.bars);
        EXPECT_EQ(noteheads(folded), noteheads(plain));
        for (const NotatedPart& part : folded.parts) {
            for (const Staff& staff : part.staves) {
                expect_one_meaning(folded, part, staff);
                expect_clean_borders(folded, staff);
            }
        }
        if (!folded.repeats.empty()) expect_clean_parts(folded, rests, cues);
        for (const NotatedPart& part : folded.parts) chords += folded.repeats.empty() ? 0 : part.chords.size();
        for (const PrintedRepeat& repeat : folded.repeats) {
            EXPECT_GE(folded.bar_lines.number(repeat.end) - folded.bar_lines.number(repeat.begin), 4);
            EXPECT_GE(repeat.begin, score.head.upbeat);
            with_endings += repeat.has_endings() ? 1 : 0;
            often += repeat.times > 2 ? 1 : 0;
        }
        found += folded.repeats.size();
        if (!folded.repeats.empty()) {
            with_upbeat += score.head.upbeat > 0 ? 1 : 0;
            changing += score.head.changes.empty() ? 0 : 1;
        }
        if (HasFailure()) break;
    }
    EXPECT_GT(found, 300u);
    EXPECT_GT(with_endings, 40u);
    EXPECT_GT(often, 30u);
    EXPECT_GT(with_upbeat, 40u);
    EXPECT_GT(changing, 40u);
    EXPECT_GT(chords, 500u);
    EXPECT_GT(rests, 50u);
    EXPECT_GT(cues, 0u);
}

/// A bar of four quarters for each letter.
TestScore bars_named(const std::string& letters, std::size_t most_repeats) {
    TestScore score = line({4, 4}, std::vector<std::int64_t>(4 * letters.size(), ticks_per_quarter));
    for (std::size_t i = 0; i < score.notes.size(); ++i)
        score.notes[i].key = 60 + (letters[i / 4] - 'a') + static_cast<int>(i % 4);
    score.head.most_repeats = most_repeats;
    return score;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// The text with every run of blanks and line ends as one blank, without comments.
std::string in_one_line(const std::string& text) {
    return std::regex_replace(std::regex_replace(text, std::regex("% \\d+\n"), "\n"), std::regex("\\s+"), " ");
}

template <void (*write)(const Notation&, const ScoreHead&, Output&)>
std::string text_of(const TestScore& score) {
    MemorySink sink;
    write(notate(score), score.head, sink);
    return sink.text;
}

TEST(Repeats, AreWrittenInEachFormat) {
    const TestScore endings = bars_named("abcdabcef", 4);
    const std::string xml = in_one_line(text_of<write_musicxml>(endings));
    EXPECT_EQ(count_of(xml, "<measure "), 6u);
    const std::string forward =
        "<measure number=\"1\"> <barline location=\"left\"><bar-style>heavy-light</bar-style>"
        "<repeat direction=\"forward\"/></barline>";
    EXPECT_TRUE(has(xml, forward));
    EXPECT_TRUE(has(xml, "<measure number=\"4\"> <barline location=\"left\"><ending number=\"1\" type=\"start\">1."));
    EXPECT_TRUE(has(xml,
                    "<bar-style>light-heavy</bar-style><ending number=\"1\" type=\"stop\"/>"
                    "<repeat direction=\"backward\"/></barline> </measure> <measure number=\"5\"> "
                    "<barline location=\"left\"><ending number=\"2\" type=\"start\">2.</ending></barline>"));
    EXPECT_TRUE(has(xml, "<barline location=\"right\"><ending number=\"2\" type=\"discontinue\"/></barline>"));
    EXPECT_EQ(count_of(xml, "<repeat "), 2u);
    const std::string ly = in_one_line(text_of<write_lilypond>(endings));
    EXPECT_TRUE(std::regex_search(
        ly, std::regex(R"(\\repeat volta 2 \{[^{}]*\} \\alternative \{ \{[^{}]*\} \{[^{}]*\} \} )")))
        << ly;
    EXPECT_EQ(count_of(ly, "\\unfoldRepeats"), 1u);
    EXPECT_EQ(count_of(ly, "\\midi"), 1u);
    const std::string abc = text_of<write_abc>(bars_named("abcdabcef", 2));
    const std::string signs =
        std::regex_replace(abc.substr(abc.rfind("] ") + 2), std::regex("![a-z]+!|[=^_]?[A-Ga-g][',]*2|[ \n]"), "");
    EXPECT_EQ(signs, "|:|||[1:|[2|||]") << abc;
}

TEST(Repeats, TheNumberOfTimesIsPrinted) {
    const TestScore often = bars_named("abcdabcdabcdefghefgh", 4);
    const std::string xml = in_one_line(text_of<write_musicxml>(often));
    EXPECT_EQ(count_of(xml, "<repeat direction=\"backward\" times=\"3\"/>"), 1u);
    EXPECT_EQ(count_of(xml, "<repeat direction=\"backward\"/>"), 1u);
    EXPECT_EQ(count_of(xml, ">3\u00D7</words>"), 1u);
    const std::string ly = in_one_line(text_of<write_lilypond>(often));
    EXPECT_TRUE(has(ly, "| \\textEndMark \"3\u00D7\" } \\repeat volta 2 {"));
    EXPECT_TRUE(has(ly, "\\repeat volta 3 {"));
    const std::string thrice = in_one_line(text_of<write_musicxml>(bars_named("abcdabcdabce", 4)));
    EXPECT_TRUE(has(thrice, "<ending number=\"1,2\" type=\"start\">1., 2.</ending>"));
    EXPECT_TRUE(has(thrice, "<ending number=\"3\" type=\"start\">3.</ending>"));
    EXPECT_FALSE(has(thrice, "\u00D7"));
    // In ABC, passages are played twice.
    EXPECT_EQ(notate(bars_named("abcdabcdabcd", 2)).bars, 8);
    EXPECT_TRUE(has(text_of<write_abc>(bars_named("abcdeabcdefghifghi", 2)), " :||: "));
    EXPECT_TRUE(has(text_of<write_abc>(bars_named("abcdabcdefghefgh", 2)), " :|\n|: "));
    EXPECT_TRUE(notate(bars_named("abcdabcd", 1)).repeats.empty());
}

TEST(Repeats, ArePrintedOnlyOnRequestAndElsewhereReported) {
    const std::string text = "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 3\nunit: 1/8\n";
    const Document document = parse("h.lsys", text + "loop: 2\n");
    for (const char* format : {"mid", "csd", "sco", "strudel", "svg", "html"}) {
        EXPECT_EQ(warnings_of(remarks_about(scores(), document, format, {{"repeats", "true"}})),
                  "'repeats' has no effect: it applies only to print\n")
            << format;
    }
    for (const char* format : {"musicxml", "mxl", "ly", "abc"}) {
        const Made made = remarks_about(scores(), document, format, {{"repeats", "true"}});
        EXPECT_TRUE(has(remarks_of(made), "printed as")) << format;
        EXPECT_EQ(warnings_of(made), "");
        EXPECT_FALSE(has(remarks_of(remarks_about(scores(), document, format)), "printed as"));
        EXPECT_EQ(warnings_of(remarks_about(scores(), parse("h.lsys", text + "canon: 1 -12\n"), format,
                                            {{"repeats", "true"}})),
                  "'repeats' has no effect: no passage of four bars or more is played twice in a row\n");
    }
}

}  // namespace sikku::repeats_test
