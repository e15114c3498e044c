#include "music/score/notation.h"

#include "tests/notation_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace sikku {
namespace {

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
                    const std::int64_t duration = symbol.length * ticks_per_sixty_fourth;
                    if (symbol.tied_back) {
                        EXPECT_EQ(list.back().key, symbol.pitch.key());
                        list.back().duration += duration;
                    } else {
                        list.push_back({symbol.onset * ticks_per_sixty_fourth, duration, symbol.pitch.key()});
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
        if (symbol.onset % notation.bar_length == 0 && symbol.onset > 0) text += "| ";
        if (symbol.kind == SymbolKind::bar_rest) {
            text += "R ";
            continue;
        }
        const NoteValue value = note_value(symbol.length);
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

TEST(Notation, FiveUnitsAreFourAndOne) {
    for (const auto& [unit, expected] : std::vector<std::pair<std::int64_t, std::string>>{
             {120, "4~ 16 r8. r2"}, {240, "2~ 8 r4."}, {480, "1~ | 4 r2."}, {960, "1~ | 1~ | 2 r2"}}) {
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
    EXPECT_EQ(words({2, 2}, {480, 960, 480}), "4 4~ 4 4");
    EXPECT_EQ(words({5, 8}, {5 * eighth, 3 * eighth, 2 * eighth}), "2~ 8 | 4. 4");
    EXPECT_EQ(words({7, 8}, {7 * eighth}), "2.~ 8");
    EXPECT_EQ(words({8, 4}, {16 * eighth}), "1.~ 2");
    // Beats of three eighths.
    EXPECT_EQ(words({6, 8}, {4 * eighth, 2 * eighth}), "4.~ 8 4");
    EXPECT_EQ(words({6, 8}, {eighth, 4 * eighth, eighth}), "8 4~ 4 8");
    EXPECT_EQ(words({9, 8}, {9 * eighth}), "2.~ 4.");
    EXPECT_EQ(words({12, 8}, {12 * eighth}), "1.");
    EXPECT_EQ(words({3, 8}, {2 * eighth, 4 * eighth}), "4 8~ | 4.");
}

TEST(Notation, RestsFillGapsAndTheLastBar) {
    EXPECT_EQ(words({4, 4}, {-480, 480, -960, -1920, 480}), "r4 4 r2 | R | 4 r2.");
    EXPECT_EQ(words({5, 8}, {-5 * eighth, 5 * eighth}), "R | 2~ 8");
    EXPECT_EQ(words({4, 4}, {}), "R");
    EXPECT_EQ(words({4, 4}, {480, -5000}), "4 r2. | R | R");
    EXPECT_EQ(notate(line({4, 4}, {1920})).bars, 1);
    EXPECT_EQ(notate(line({4, 4}, {1920, 30})).bars, 2);
}

TEST(Notation, RandomScoresSayTheSameAsTheirNotes) {
    for (unsigned seed = 0; seed < 400; ++seed) {
        const TestScore score = random_score(seed, seed % 4 == 0);
        const Notation notation = notate(score, 1 + seed % 50);
        ASSERT_EQ(joined(notation), plain(score.notes)) << seed;
        EXPECT_EQ(notation.moved, 0u);
        EXPECT_EQ(notation.bent, 0u);
        EXPECT_EQ(notation.bar_length * ticks_per_sixty_fourth, score.head.meter.bar());
        EXPECT_GE(notation.bars * score.head.meter.bar(), score.end);
        EXPECT_LT((notation.bars - 1) * score.head.meter.bar(), std::max<std::int64_t>(score.end, 1));
        ASSERT_EQ(notation.parts.size(), score.head.parts.size());
        for (const NotatedPart& part : notation.parts) {
            ASSERT_FALSE(part.staves.empty());
            for (const Staff& staff : part.staves) {
                ASSERT_GE(staff.voices.size(), 1u);
                ASSERT_LE(staff.voices.size(), 4u);
                for (const NotatedVoice& voice : staff.voices) {
                    std::vector<std::int64_t> sums(static_cast<std::size_t>(notation.bars), 0);
                    std::int64_t here = 0;
                    for (const NotatedSymbol& symbol : voice.symbols) {
                        ASSERT_EQ(symbol.onset, here);
                        here += symbol.length;
                        const std::int64_t bar = symbol.onset / notation.bar_length;
                        sums[static_cast<std::size_t>(bar)] += symbol.length;
                        if (symbol.kind == SymbolKind::bar_rest) {
                            EXPECT_EQ(symbol.length, notation.bar_length);
                            continue;
                        }
                        if (symbol.kind == SymbolKind::gap && symbol.length == notation.bar_length) continue;
                        const NoteValue value = note_value(symbol.length);
                        EXPECT_EQ(symbol.length, 64 / value.divisor * (value.dotted ? 3 : 2) / 2);
                        EXPECT_TRUE((std::set{1, 2, 4, 8, 16, 32, 64}.contains(value.divisor)));
                    }
                    for (const std::int64_t sum : sums) ASSERT_EQ(sum, notation.bar_length);
                }
            }
        }
    }
}

TEST(Notation, EveryStretchOfEveryBarIsPrintable) {
    for (const Meter meter :
         {Meter{4, 4}, {3, 4}, {2, 4}, {5, 8}, {6, 8}, {7, 16}, {1, 64}, {9, 32}, {3, 2}, {1, 1}}) {
        const std::int64_t bar = 64 * meter.beats / meter.unit;
        for (std::int64_t from = 0; from < bar; ++from) {
            for (std::int64_t to = from + 1; to <= bar; ++to) {
                std::int64_t sum = 0;
                for (const std::int64_t length : printable_lengths(from, to, meter)) {
                    sum += length;
                    EXPECT_TRUE(
                        (std::set<std::int64_t>{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96}.contains(length)));
                }
                ASSERT_EQ(sum, to - from);
            }
        }
    }
    // Off the beat nothing hides the middle.
    for (std::int64_t from = 1; from < 32; ++from) {
        if (from % 16 == 0) continue;
        std::int64_t here = from;
        for (const std::int64_t length : printable_lengths(from, 64, {4, 4})) {
            EXPECT_FALSE(here < 32 && here % 16 != 0 && here + length > 32) << from;
            here += length;
        }
    }
}

TEST(Notation, WhatFallsBetween64thsIsMovedAndCounted) {
    // Triplets of an eighth.
    const Notation triplets = notate(line({4, 4}, {160, 160, 160}));
    EXPECT_EQ(triplets.moved, 3u);
    EXPECT_EQ(joined(triplets), (std::vector<PlainNote>{{0, 150, 72}, {150, 180, 72}, {330, 150, 72}}));
    // Too short for any sign: one 64th each, in order.
    const Notation crumbs = notate(line({4, 4}, {1, 1, 1, 477}));
    EXPECT_EQ(crumbs.moved, 4u);
    EXPECT_EQ(joined(crumbs), (std::vector<PlainNote>{{0, 30, 72}, {30, 30, 72}, {60, 30, 72}, {90, 390, 72}}));
    EXPECT_EQ(notate(line({4, 4}, {480, 30, 450})).moved, 0u);
}

TEST(Notation, StavesAndClefs) {
    const auto staves_of = [](const std::vector<double>& keys) {
        TestScore score = line({4, 4}, std::vector<std::int64_t>(keys.size(), 480));
        for (std::size_t i = 0; i < keys.size(); ++i) score.notes[i].key = keys[i];
        return notate(score).parts.front().staves;
    };
    EXPECT_EQ(staves_of({60, 62, 64}).front().clef, Clef::treble);
    EXPECT_EQ(staves_of({59, 58, 64}).front().clef, Clef::bass);
    EXPECT_EQ(staves_of({}).front().clef, Clef::treble);
    EXPECT_EQ(staves_of({48, 72}).size(), 1u);  // two octaves, not over them
    EXPECT_EQ(staves_of({60, 100}).size(), 1u);
    EXPECT_EQ(staves_of({20, 59}).size(), 1u);
    const auto grand = staves_of({48, 73, 59, 60});
    ASSERT_EQ(grand.size(), 2u);
    EXPECT_EQ(grand[0].clef, Clef::treble);
    EXPECT_EQ(grand[1].clef, Clef::bass);
    const auto keys_of = [](const Staff& staff) {
        std::vector<double> keys;
        for (const NotatedSymbol& symbol : staff.voices.front().symbols) {
            if (symbol.kind == SymbolKind::note) keys.push_back(symbol.pitch.key());
        }
        return keys;
    };
    EXPECT_EQ(keys_of(grand[0]), (std::vector<double>{73, 60}));
    EXPECT_EQ(keys_of(grand[1]), (std::vector<double>{48, 59}));
}

TEST(Notation, ManyVoicesHaveAStaffForEveryFour) {
    TestScore score;
    score.head.parts = {plain_part("Many", 12), plain_part("Silent", 2)};
    for (std::int16_t voice = 0; voice < 12; ++voice) {
        if (voice == 3) continue;  // never sounds
        Note note;
        note.duration = 1920;
        note.key = 70 - 2 * voice;
        note.voice = voice;
        score.notes.push_back(note);
    }
    const Notation notation = notate(score);
    ASSERT_EQ(notation.parts[0].staves.size(), 3u);
    EXPECT_EQ(notation.parts[0].staves[0].voices.size(), 4u);
    EXPECT_EQ(notation.parts[0].staves[2].voices.size(), 3u);
    EXPECT_EQ(notation.parts[0].staves[0].voices[3].voice, 4);
    EXPECT_EQ(notation.parts[0].staves[2].clef, Clef::bass);
    ASSERT_EQ(notation.parts[1].staves.size(), 1u);
    EXPECT_EQ(notation.parts[1].staves[0].voices[0].symbols.front().kind, SymbolKind::bar_rest);
    EXPECT_EQ(joined(notation), plain(score.notes));
}

TEST(Notation, OneRestOfABarIsEnough) {
    TestScore score;
    score.head.parts = {plain_part("Two", 2)};
    Note note;
    note.duration = 1920;
    note.onset = 1920;
    score.notes.push_back(note);
    note.voice = 1;
    note.onset = 2 * 1920;
    score.notes.push_back(note);
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
        EXPECT_NE(std::string(error.what()).find("200000"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("limit the bars"), std::string::npos) << error.what();
    }
    Notator long_one(score.head);
    EXPECT_THROW(long_one.finish(std::int64_t{1920} * 100'001), ScoreError);
    Notator stranger(score.head);
    Note note;
    note.voice = 1;
    EXPECT_THROW(stranger.notes({&note, 1}), ScoreError);
    note.voice = -1;
    EXPECT_THROW(stranger.notes({&note, 1}), ScoreError);
}

}  // namespace
}  // namespace sikku
