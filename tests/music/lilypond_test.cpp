#include "music/score/score_formats.h"

#include "tests/files.h"
#include "tests/notation_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::lilypond_test {

std::string lilypond_of(const TestScore& score) {
    MemorySink sink;
    write_lilypond(notate(score), score.head, sink);
    return sink.text;
}

/// The notes of the \new Voice blocks, read with a pattern for tokens: names are taken apart sign by sign, bar checks
/// must lie on bar lines of the meters that the first voice states, tuplets scale what they contain, beams and
/// tuplets must end.
std::vector<PlainNote> read_notes(const std::string& text) {
    static const std::map<char, int> semitones = {{'c', 0}, {'d', 2}, {'e', 4}, {'f', 5},
                                                  {'g', 7}, {'a', 9}, {'b', 11}};
    static const std::regex token(
        R"(([a-g])((?:is|es|ih|eh)*)([',]*)(\d+)(\.?)(~?)([\[\]]?)(->)?(\^\\markup\\teeny"(?:\+|\xE2\x88\x92)\d+")?|)"
        R"([rs](\d+)(\.?)|[Rs]1\*(\d+)/(\d+))");
    static const std::regex dynamics(R"((\\[mpf]+|\\<|\\>)+$)");
    std::vector<PlainNote> list;
    std::istringstream stream(text);
    bool in_voice = false;
    bool tied = false;
    bool is_beamed = false;
    std::int64_t here = 0;
    std::int64_t bar_begin = 0;
    std::map<std::int64_t, std::int64_t> bars;  // lengths, from a tick on
    std::int64_t number = 0;
    std::int64_t actual = 1;
    std::int64_t normal = 1;
    for (std::string row; std::getline(stream, row);) {
        if (row.find("\\new Voice {") != std::string::npos) {
            in_voice = true;
            here = bar_begin = number = 0;
            continue;
        }
        if (row == "      }" && in_voice) {
            in_voice = false;
            EXPECT_FALSE(tied || is_beamed);
            EXPECT_EQ(actual, 1);
        }
        if (!in_voice) continue;
        std::istringstream words(row);
        for (std::string word; words >> word;) {
            if (word == "|") {
                EXPECT_EQ(here, bar_begin + std::prev(bars.upper_bound(bar_begin))->second);
                bar_begin = here;
                ++number;
                EXPECT_EQ(actual, 1);
                words >> word;
                EXPECT_EQ(word, "%");
                words >> word;
                EXPECT_EQ(word, std::to_string(number));
                continue;
            }
            if (word == "\\tuplet") {
                char slash = 0;
                EXPECT_EQ(actual, 1);
                words >> actual >> slash >> normal >> word;
                EXPECT_EQ(word, "{");
                continue;
            }
            if (word == "}") {
                EXPECT_NE(actual, 1);
                actual = normal = 1;
                continue;
            }
            if (word == "\\set") {
                words >> word >> word >> word;
                continue;
            }
            if (word == "\\time") {
                words >> word;
                if (word.find('/') == std::string::npos) words >> word;  // groups
                EXPECT_EQ(here, bar_begin);
                bars[here] = 4 * ticks_per_quarter * std::stoi(word) / std::stoi(word.substr(word.find('/') + 1));
                continue;
            }
            if (word == "\\tempo") {
                while (word != "=" && words >> word) continue;
                words >> word;
                continue;
            }
            if (word.starts_with("\\voice")) continue;
            if (word == "\\key") {
                words >> word >> word;
                continue;
            }
            if (word == "\\clef" || word == "\\ottava" || word == "\\bar") {
                words >> word;
                continue;
            }
            word = std::regex_replace(word, dynamics, "");
            std::smatch match;
            if (!std::regex_match(word, match, token)) {
                ADD_FAILURE() << "what is " << word << " in: " << row;
                continue;
            }
            const auto length = [&](std::size_t digits, std::size_t dot) {
                const std::int64_t whole = 4 * ticks_per_quarter / std::stoi(match[digits]);
                const std::int64_t written = match[dot].length() > 0 ? whole * 3 / 2 : whole;
                EXPECT_EQ(written * normal % actual, 0);
                return written * normal / actual;
            };
            if (match[12].matched) {
                here += 4 * ticks_per_quarter * std::stoi(match[12]) / std::stoi(match[13]);
            } else if (match[10].matched) {
                here += length(10, 11);
            } else {
                double key = 48 + semitones.at(match[1].str().front());
                const std::string signs = match[2];
                for (std::size_t i = 0; i < signs.size(); i += 2) {
                    const double size = signs[i + 1] == 's' ? 1.0 : 0.5;
                    key += signs[i] == 'i' ? size : -size;
                }
                for (const char mark : match[3].str()) key += mark == '\'' ? 12 : -12;
                if (tied) {
                    EXPECT_EQ(list.back().key, key);
                    list.back().duration += length(4, 5);
                } else {
                    list.push_back({here, length(4, 5), key});
                }
                tied = match[6].length() > 0;
                if (match[7].length() > 0) {
                    EXPECT_EQ(match[7] == "]", is_beamed);
                    is_beamed = match[7] == "[";
                }
                if (is_beamed) {
                    EXPECT_GE(std::stoi(match[4]), 8);
                }
                here += length(4, 5);
            }
        }
    }
    std::sort(list.begin(), list.end());
    return list;
}

TEST(LilyPond, RandomScoresAreReadBack) {
    for (unsigned seed = 0; seed < 150; ++seed) {
        const TestScore score = random_score(seed, seed % 3 == 0);
        ASSERT_EQ(read_notes(lilypond_of(score)), plain(score.notes)) << seed;
    }
}

TEST(LilyPond, WritesALineForEachBar) {
    TestScore score = line({4, 4}, {5 * 480, -480, 480, -480 + -1920});
    score.notes[1].key = 66;
    score.head.title = "A \"quoted\" \\ title";
    score.head.made = "sikku 0.1.0, -n 2";
    score.head.pattern = "axiom: X\r\n\n%{ no comment\n";
    score.head.parts[0].key = KeySignature{-3, true};
    EXPECT_EQ(lilypond_of(score), R"(\version "2.24.0"

% sikku 0.1.0, -n 2
% axiom: X
%
% %{ no comment

\header {
  title = "A \"quoted\" \\ title"
  instrument = "Voice"
  tagline = ##f
}

\paper {
  system-system-spacing = #'((basic-distance . 14) (minimum-distance . 8) (padding . 3) (stretchability . 60))
  last-bottom-spacing = #'((basic-distance . 6) (minimum-distance . 5) (padding . 4) (stretchability . 30))
}

\score {
  <<
    \new Staff \with { midiInstrument = "acoustic grand" } <<
      \new Voice {
        \clef treble \key c \minor \time 4/4
        \tempo 4 = 120
        c''1~\mf | % 1
        c''4 r4 fis'4 r4 | % 2
        R1*4/4 \bar "|." | % 3
      }
    >>
  >>
  \layout {
    indent = 0\mm
    short-indent = 0\mm
    \context { \Score \autoBeamOff }
    \context { \Staff \numericTimeSignature }
    \context { \DrumStaff \numericTimeSignature }
  }
  \midi { }
}
)");
}

TEST(LilyPond, NamesOfPartsHaveRoomBeforeTheirStaves) {
    TestScore score = line({4, 4}, {480});
    score.head.parts.push_back(score.head.parts.front());
    score.head.parts[1].name = "Acoustic Grand Piano 2";
    score.notes.push_back(score.notes.front());
    score.notes.back().voice = 1;
    const std::string text = lilypond_of(score);
    EXPECT_NE(text.find("instrumentName = \\markup \\right-column { \"Acoustic Grand\" \"Piano 2\" } "
                        "shortInstrumentName = \"Acoustic\""),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("indent = 38\\mm\n    short-indent = 22\\mm"), std::string::npos) << text;
    EXPECT_NE(text.find("\\Staff \\RemoveEmptyStaves"), std::string::npos) << text;
    EXPECT_EQ(text.find("instrument = "), std::string::npos);
}

TEST(LilyPond, KeysHaveTheirTonic) {
    const std::map<int, std::string> majors = {{-7, "ces"}, {-2, "bes"}, {0, "c"}, {1, "g"}, {6, "fis"}, {7, "cis"}};
    const std::map<int, std::string> minors = {{-7, "aes"}, {-2, "g"}, {0, "a"}, {1, "e"}, {6, "dis"}, {7, "ais"}};
    TestScore score = line({4, 4}, {480});
    for (const auto& [fifths, tonic] : majors) {
        score.head.parts[0].key = KeySignature{fifths, false};
        EXPECT_NE(lilypond_of(score).find("\\key " + tonic + " \\major"), std::string::npos) << fifths;
    }
    for (const auto& [fifths, tonic] : minors) {
        score.head.parts[0].key = KeySignature{fifths, true};
        EXPECT_NE(lilypond_of(score).find("\\key " + tonic + " \\minor"), std::string::npos) << fifths;
    }
    score.head.parts[0].key.reset();
    EXPECT_EQ(lilypond_of(score).find("\\key"), std::string::npos);
}

TEST(LilyPond, TheTempoIsAWholeNumber) {
    const std::map<double, std::string> printed = {{92.0, "92"}, {92.5, "93"}, {92.4, "92"}, {0.1, "1"}};
    TestScore score = line({4, 4}, {480});
    for (const auto& [tempo, number] : printed) {
        score.head.tempo = tempo;
        EXPECT_NE(lilypond_of(score).find("\\tempo 4 = " + number + "\n"), std::string::npos) << tempo;
    }
}

TEST(LilyPond, TheTempoIsInBeats) {
    const auto mark = [](const Meter& meter) {
        TestScore score = line(meter, {480});
        score.head.tempo = 100;
        const std::string text = lilypond_of(score);
        const std::size_t begin = text.find("\\tempo ");
        return text.substr(begin + 7, text.find('\n', begin) - begin - 7);
    };
    EXPECT_EQ(mark({3, 4}), "4 = 100");
    EXPECT_EQ(mark({6, 8}), "4. = 67");
    EXPECT_EQ(mark({7, 8}), "8 = 200");
    EXPECT_EQ(mark({7, 8, {3, 2, 2}}), "8 = 200");
    EXPECT_EQ(mark({2, 2}), "2 = 50");
    EXPECT_EQ(mark({9, 16}), "8. = 133");
}

TEST(LilyPond, DynamicsOfSeveralVoicesAreBelowTheirStaff) {
    TestScore score;
    score.head.parts = {plain_part("Strings", 2)};
    score.head.parts[0].is_accompaniment = true;
    score.head.parts[0].program = 48;
    for (std::int16_t voice = 0; voice < 2; ++voice) {
        for (int i = 0; i < 4; ++i) {
            Note note{.onset = i * 960,
                      .duration = voice == 0 ? 960 : 480,
                      .key = 60.0 - 5 * voice,
                      .voice = voice,
                      .velocity = static_cast<std::uint8_t>(i < 2 ? 80 : 112)};
            score.notes.push_back(note);
        }
    }
    std::stable_sort(score.notes.begin(), score.notes.end(),
                     [](const Note& a, const Note& b) { return a.onset < b.onset; });
    const std::string text = lilypond_of(score);
    EXPECT_NE(text.find("      \\new Voice {\n      s1*1920/1920\\mf\\< s1*1920/1920\\ff\n      }\n    >>\n"),
              std::string::npos)
        << text;
}

TEST(LilyPond, SecondaryBeamsAreCutAtEighths) {
    std::vector<std::int64_t> lengths(8, 60);
    lengths.push_back(1440);
    const std::string text = lilypond_of(line({4, 4}, lengths));
    EXPECT_NE(
        text.find("\\set stemLeftBeamCount = #3 \\set stemRightBeamCount = #1 c''32 \\set stemLeftBeamCount = #1 "
                  "\\set stemRightBeamCount = #3 c''32"),
        std::string::npos)
        << text;
}

TEST(LilyPond, IsTheSameInAnyLocale) {
    TestScore score = random_score(3, true);
    score.head.tempo = 1234.5;
    const std::string before = lilypond_of(score);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
        std::setlocale(LC_ALL, name);
        EXPECT_EQ(lilypond_of(score), before);
    }
    std::setlocale(LC_ALL, "C");
}

TEST(LilyPond, EndsWithAFermata) {
    TestScore score = held_score({3, 4});
    const std::string text = lilypond_of(score);
    EXPECT_NE(text.find("| % 2\n        \\tempo \\markup \\normal-text \\italic \"rit.\" c''4 c''2~ | % 3\n"
                        "        c''2.\\fermata \\bar"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("R1*3/4\\fermata \\bar"), std::string::npos) << text;
    // A ritardando alone has no fermata.
    score.notes[score.notes.size() - 2].has_fermata = false;
    const std::string slower = lilypond_of(score);
    EXPECT_NE(slower.find("\"rit.\""), std::string::npos);
    EXPECT_EQ(slower.find("fermata"), std::string::npos);
    // At the beginning there is one mark, as LilyPond prints no two.
    score.head.ritardando = 4 * 1440;
    EXPECT_NE(lilypond_of(score).find("\\tempo \\markup \\normal-text \\italic \"rit.\" 4 = 120\n"),
              std::string::npos);
}

TEST(LilyPond, LongTextsAreLines) {
    TestScore score = line({4, 4}, {480});
    score.head.title = "A title of ten words that is too long for one line of a page";
    score.head.source = std::string(100'000, 'x');
    score.head.composer.clear();
    for (int i = 0; i < 1000; ++i) score.head.composer += "\u0101";
    score.head.parts.front().name = std::string(100'000, 'y');
    const std::string text = lilypond_of(score);
    EXPECT_NE(text.find("  title = \\markup \\center-column { \"A title of ten words that is\" "
                        "\"too long for one line of a page\" \\vspace #0.2 }\n"),
              std::string::npos)
        << text;
    for (const std::string_view field : {"  copyright = ", "  composer = ", "  instrument = "}) {
        const std::size_t at = text.find(field);
        EXPECT_LT(text.find('\n', at) - at, 500u) << field;
        EXPECT_LT(text.find("\u2026\" \\vspace #0.2 }\n", at) - at, 500u) << field;
    }
    EXPECT_EQ(text.find('?'), std::string::npos);
}

// Takes seconds, so only where LilyPond happens to be: everything that is written at once.
TEST(LilyPond, CompilesWithoutWarnings) {
    NEEDS("lilypond");
    const ScratchFolder folder;
    TestScore score = random_score(5, true);
    score.head.title = "\"#{}$\\ <é> \xFF \x01";
    score.head.composer = "\\\"" + std::string(100'000, 'x');
    score.head.ritardando = score.head.meter.bar();
    score.notes.back().has_fermata = true;
    for (Note& note : score.notes) note.is_sliding = note.onset % 960 == 0;
    score.head.pattern = "%{\n\\\n\"\n\xFF\x00 %}\n";
    score.head.tempo = 92.5;
    score.head.parts[0].name = "a \"b\" \\c";
    const std::string file = folder.write("score.ly", lilypond_of(score));
    const auto outcome = run_tool("cd '" + folder.path().string() + "' && lilypond --loglevel=WARNING score.ly");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    EXPECT_GT(contents(folder / "score.pdf").size(), 1000u);
    EXPECT_GT(contents(folder / "score.midi").size(), 100u);
}

}  // namespace sikku::lilypond_test
