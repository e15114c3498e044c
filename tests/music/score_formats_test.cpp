// The formats that need little code: ABC, Csound, Strudel, compressed MusicXML.
#include "music/score/score_formats.h"
#include "music/score/comments.h"
#include "music/scores.h"
#include "tests/files.h"
#include "tests/notation_tools.h"
#include "tests/tools.h"
#include "tests/works.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::score_formats_test {

std::string abc_of(const TestScore& score) {
    MemorySink sink;
    write_abc(notate(score), score.head, sink);
    return sink.text;
}

/// Signs of the letters from C in a key of ABC, by counting fifths.
std::map<char, double> key_of(const std::string& name) {
    static const std::map<std::string, int> modes = {{"lyd", 0}, {"", 1},    {"mix", 2}, {"dor", 3},
                                                     {"min", 4}, {"phr", 5}, {"loc", 6}};
    const std::string order = "FCGDAEB";
    const std::size_t sign = name.find_first_of("#b", 1) == 1 ? 1 : 0;
    int fifths = static_cast<int>(order.find(name[0])) - (sign == 0 ? 0 : name[1] == '#' ? -7 : 7);
    fifths -= modes.at(name.substr(1 + sign));
    std::map<char, double> signs;
    for (int i = 0; i < 7; ++i) {
        if (i < fifths) signs[order[static_cast<std::size_t>(i)]] = 1;
        if (i < -fifths) signs[order[static_cast<std::size_t>(6 - i)]] = -1;
    }
    return signs;
}

/// Reads the notes of a tune: lengths in eighths, tuplets count notes and rests, accidentals hold to the bar line for
/// their letter in all octaves if `wide`, else for the note alone; clefs with an 8 transpose. Bars have the length
/// that the voice states.
std::vector<PlainNote> read_abc(const std::string& text, bool wide) {
    static const std::map<char, int> semitones = {{'C', 0}, {'D', 2}, {'E', 4}, {'F', 5},
                                                  {'G', 7}, {'A', 9}, {'B', 11}};
    static const std::map<std::string, double> signs = {{"__", -2},   {"_3/2", -1.5}, {"_", -1},
                                                        {"_/", -0.5}, {"=", 0},       {"^/", 0.5},
                                                        {"^", 1},     {"^3/2", 1.5},  {"^^", 2}};
    static const std::regex token(
        R"(^(?:(\[K:([A-G][^\]]*)\])|(\[K:clef=[-+\w]+\])|(\|[|\]]?)|(!![^!]*!|![^!]*!)|("[^"]*")|\((\d+):(\d+):(\d+)|)"
        R"((__|\^\^|_3/2|\^3/2|_/|\^/|_|\^|=)?([A-Ga-g])([',]*)(\d*)(?:/(\d+))?(-)?|([zx])(\d*)(?:/(\d+))?|(y0|[ \n]+)))");
    std::vector<PlainNote> list;
    std::istringstream stream(text);
    std::string row;
    std::string voice;
    std::map<char, double> key;
    std::map<char, double> in_force;
    std::int64_t here = 0;
    std::int64_t bar_begin = 0;
    std::int64_t bar = 0;
    std::int64_t first_bar = 0;
    const auto bar_of = [](const std::string& meter) {
        return 4 * ticks_per_quarter * std::stoi(meter) / std::stoi(meter.substr(meter.find('/') + 1));
    };
    std::int64_t actual = 1;
    std::int64_t normal = 1;
    int left = 0;
    bool tied = false;
    double transposition = 0;
    for (bool in_voice = false; std::getline(stream, row);) {
        if (row.starts_with("V:")) {
            EXPECT_FALSE(tied);
            in_voice = true;
            here = bar_begin = 0;
            bar = first_bar;
            const char octave = row[row.find("clef=") + row.substr(row.find("clef=")).find_first_of(" -+\n")];
            transposition = octave == '-' ? -12 : octave == '+' ? 12 : 0;
            continue;
        }
        if (!in_voice && row.starts_with("M:")) first_bar = bar_of(row.substr(2));
        if (!in_voice || row.starts_with("%")) continue;
        row += "\n";
        for (std::smatch match; !row.empty(); row = match.suffix()) {
            for (; row.starts_with("[M:") || row.starts_with("[Q:"); row = row.substr(row.find(']') + 2)) {
                EXPECT_EQ(here, bar_begin);
                if (row[1] == 'M') bar = bar_of(row.substr(3));
            }
            if (!std::regex_search(row, match, token) || match.length() == 0) {
                ADD_FAILURE() << "what is " << row;
                return list;
            }
            const auto length = [&](std::size_t above, std::size_t below) {
                std::int64_t ticks = 240 * (match[above].length() > 0 ? std::stoi(match[above]) : 1);
                if (match[below].matched) ticks /= std::stoi(match[below]);
                if (left > 0) {
                    EXPECT_EQ(ticks * normal % actual, 0);
                    ticks = ticks * normal / actual;
                    --left;
                }
                return ticks;
            };
            if (match[2].matched) {
                const std::string name = match[2];
                key = key_of(name.substr(0, name.find(' ')));
            } else if (match[4].matched) {
                EXPECT_EQ(here, bar_begin + bar);
                bar_begin = here;
                EXPECT_EQ(left, 0);
                in_force.clear();
            } else if (match[7].matched) {
                EXPECT_EQ(left, 0);
                actual = std::stoi(match[7]);
                normal = std::stoi(match[8]);
                left = std::stoi(match[9]);
            } else if (match[11].matched) {
                const char letter = match[11].str()[0];
                const char upper = static_cast<char>(std::toupper(letter));
                double sign = key.contains(upper) ? key[upper] : 0;
                if (wide && in_force.contains(upper)) sign = in_force[upper];
                if (match[10].matched) sign = in_force[upper] = signs.at(match[10]);
                double pitch = (letter == upper ? 60 : 72) + semitones.at(upper) + sign + transposition;
                for (const char mark : match[12].str()) pitch += mark == '\'' ? 12 : -12;
                const std::int64_t ticks = length(13, 14);
                if (tied) {
                    EXPECT_EQ(list.back().key, pitch);
                    list.back().duration += ticks;
                } else {
                    list.push_back({here, ticks, pitch});
                }
                tied = match[15].matched;
                here += ticks;
            } else if (match[16].matched) {
                here += length(17, 18);
            }
        }
    }
    std::sort(list.begin(), list.end());
    return list;
}

TEST(Abc, RandomScoresAreReadBack) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const TestScore score = random_score(seed, seed % 3 == 0);
        for (const bool wide : {false, true}) {
            const std::string text = abc_of(score);
            ASSERT_EQ(read_abc(text, wide), plain(score.notes)) << seed << text;
        }
    }
}

TEST(Abc, TupletsAreReadBack) {
    for (const std::int64_t unit : {160, 80, 96, 192}) {
        std::vector<std::int64_t> lengths;
        for (int i = 0; i < 30; ++i) lengths.push_back(unit * (1 + i * i % 4));
        const TestScore score = line({4, 4}, lengths);
        EXPECT_EQ(read_abc(abc_of(score), true), plain(score.notes));
    }
}

TEST(Abc, TellsWhatTheScoreIs) {
    TestScore score = line({7, 8, {3, 2, 2}}, {240, 240, 1200});
    score.head.title = "100% \\ title\nK:x";
    score.head.composer = "Peano";
    score.head.made = "sikku 0.1.0, -n 2";
    score.head.pattern = "axiom: X\n\nX --> F\n";
    score.head.parts[0].key = KeySignature{-3, true};
    score.head.parts[0].program = 40;
    const std::string text = abc_of(score);
    EXPECT_TRUE(text.starts_with("%abc-2.1\n\n% sikku 0.1.0, -n 2\n% axiom: X\n%\n% X --> F\n\nX:1\n")) << text;
    for (const char* row : {"T:100\\% \\\\ title K:x\n", "C:Peano\n", "M:(3+2+2)/8\n", "K:Cmin\n",
                            "%%MIDI program 40\n", "V:1 clef=treble name=\"Voice\"\n"}) {
        EXPECT_TRUE(has(text, row)) << row << text;
    }
}

TEST(Abc, LinesHaveFewBarsOfManyNotes) {
    const auto lines = [](const std::vector<std::int64_t>& lengths) {
        const std::string text = abc_of(line({4, 4}, lengths));
        const std::string music = text.substr(text.find("[K:"));
        return std::count(music.begin(), music.end(), '\n');
    };
    EXPECT_EQ(lines(std::vector<std::int64_t>(16, 480)), 1);  // four bars
    EXPECT_EQ(lines(std::vector<std::int64_t>(64, 120)), 2);
    EXPECT_EQ(lines(std::vector<std::int64_t>(128, 60)), 4);
}

TEST(Abc, LinesOf8vaStandBetweenNotes) {
    TestScore score = line({4, 4}, std::vector<std::int64_t>(24, 480));
    for (std::size_t i = 8; i < 16; ++i) score.notes[i].key = 96;
    const std::string once = abc_of(score);
    EXPECT_TRUE(has(once, "c2 | !8va(!y0 c''2 c''2"));
    EXPECT_TRUE(has(once, "c''2 |\n!8va)!y0 c2"));
    // Two octaves are a line of one.
    for (std::size_t i = 8; i < 16; ++i) score.notes[i].key = 115;
    const std::string twice = abc_of(score);
    EXPECT_TRUE(has(twice, "!8va(!y0 "));
    EXPECT_FALSE(has(twice, "15ma"));
}

TEST(Abc, EndsWithAFermata) {
    const std::string text = abc_of(held_score({4, 4}));
    EXPECT_TRUE(has(text, "c8 | c8 | \"^rit.\"c2 c6- | !fermata!c8 |]"));
    EXPECT_TRUE(has(text, "!fermata!z8 |]"));
}

TEST(Csound, StatementsAreTheNotes) {
    const TestScore score = random_score(5, true);
    MemorySink sink;
    write_csound_score(score.head, score.notes, score.end, sink);
    std::istringstream stream(sink.text);
    std::vector<PlainNote> read;
    for (std::string row; std::getline(stream, row);) {
        if (!row.starts_with("i ")) continue;
        std::istringstream fields(row.substr(2));
        double instrument = 0, onset = 0, duration = 0, frequency = 0, amplitude = 0;
        fields >> instrument >> onset >> duration >> frequency >> amplitude;
        EXPECT_GT(amplitude, 0);
        read.push_back({std::llround(onset * 480), std::llround(duration * 480),
                        std::round(2 * (69 + 12 * std::log2(frequency / 440))) / 2});
    }
    std::sort(read.begin(), read.end());
    EXPECT_EQ(read, plain(score.notes));
}

TEST(Csound, PlaysTheFile) {
    NEEDS("csound");
    const ScratchFolder folder;
    TestScore score = random_score(5, true);
    score.head.pattern = "</CsScore>\naxiom: X\n";
    // Voices in unison, as loud as they can be.
    for (int i = 0; i < 16; ++i) {
        score.notes.push_back({.onset = score.end, .duration = 480, .key = 60, .velocity = 127});
    }
    score.end += 480;
    MemorySink sink;
    write_csound_file(score.head, score.notes, score.end, sink);
    const auto outcome =
        run_tool("cd '" + folder.path().string() + "' && csound -n '" + folder.write("x.csd", sink.text) + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    EXPECT_TRUE(has(outcome.text, "0 errors in performance"));
    EXPECT_FALSE(has(outcome.text, "WARNING"));
    EXPECT_TRUE(std::regex_search(outcome.text, std::regex("overall samples out of range:\\D+0\\D+0\\D")))
        << outcome.text;
}

TEST(Strudel, WeightsAreDurations) {
    const TestScore score = line({4, 4}, {480, 240, -240, 960, 480});
    MemorySink sink;
    write_strudel(score.head, score.notes, score.end, sink);
    EXPECT_TRUE(has(sink.text, "setcpm(120 / 4)\n$: note(`c5@2 c5 ~ c5@4 c5@2 ~@6`)\n  .slow(2).sound(\"piano\")\n"));
    EXPECT_TRUE(sink.text.starts_with("// https://strudel.cc/#"));
    // RFC 4648, section 10, with the signs that links reserve escaped.
    EXPECT_EQ(strudel_link("foobar"), "https://strudel.cc/#Zm9vYmFy");
    EXPECT_EQ(strudel_link("fooba"), "https://strudel.cc/#Zm9vYmE%3D");
    EXPECT_EQ(strudel_link("foob"), "https://strudel.cc/#Zm9vYg%3D%3D");
    EXPECT_EQ(strudel_link("\xFF\xEF\xBE"), "https://strudel.cc/#%2F%2B%2B%2B");
}

TEST(Swing, IsPrintedAndHeard) {
    const std::string tune = "heading: 0\naxiom: FFFFFFFF\nmapping: runs\nruns: each step\nunit: 1/8\n";
    const Document one = parse("tune.lsys", tune);
    const auto score = [&](std::string_view format, const std::string& swing) {
        return play(one, format, {{"swing", swing}});
    };
    EXPECT_TRUE(has(score("ly", "67"), "\\tempo \"Swing\" 4 = 120"));
    EXPECT_TRUE(has(score("ly", "58"), "\"Light swing\""));
    EXPECT_TRUE(has(score("abc", "75 1/16"), "Q:\"Hard swing (sixteenths)\" 1/4=120"));
    const std::string xml = score("musicxml", "60");
    EXPECT_TRUE(has(xml, "<words font-weight=\"bold\">Light swing</words>"));
    EXPECT_TRUE(has(xml, "<swing><first>3</first><second>2</second><swing-type>eighth</swing-type></swing>"));
    EXPECT_FALSE(has(score("musicxml", "50"), "<swing>"));
    EXPECT_TRUE(has(score("strudel", "75"), "c4@3 c4 c4@3"));
    EXPECT_TRUE(has(score("csd", "75"), "i 1 0.75 0.25 "));
    // Quarters on the beat do not mind.
    const std::vector<Document> walking = {
        parse("tune.lsys", tune + "swing: 66\n"),
        parse("bass.lsys", "heading: 0\naxiom: FFFF\nruns: each step\nunit: 1/4\ninstrument: tuba\n")};
    MemoryDestination one_tempo;
    plan_score(walking, "ly", {})->make(one_tempo, "a.ly", {}, 1);
    EXPECT_TRUE(has(one_tempo.take("a.ly"), "\\tempo \"Swing\""));
    // Parts that differ each have their own words.
    const std::vector<Document> both = {parse("tune.lsys", tune + "swing: 66\n"),
                                        parse("other.lsys", tune + "instrument: flute\n")};
    MemoryDestination destination;
    plan_score(both, "ly", {})->make(destination, "a.ly", {}, 1);
    const std::string parts = destination.take("a.ly");
    EXPECT_EQ(count_of(parts, "\"Swing\""), 1U);
    EXPECT_TRUE(has(parts, "<>^\\markup \\bold \"Swing\""));
}

/// Written pitches and keys of the usual transposing instruments, from a scale of C major.
TEST(Transposing, PartsAreWrittenAsTheyAreRead) {
    const std::string tune = "heading: 0\nmapping: symbols\nunit: 1/4\naxiom: F+F+F\ninstrument: ";
    const auto score = [&](const std::string& instrument, std::string_view format, const OptionValues& values = {}) {
        return play(parse("tune.lsys", tune + instrument + "\n"), format, values);
    };
    struct Row {
        const char *instrument, *transpose, *fifths, *first, *lilypond;
    };
    for (const Row& row : std::vector<Row>{
             {"clarinet", "<diatonic>-1</diatonic><chromatic>-2</chromatic></transpose>", "2", "D4",
              "\\transposition bes\n"},
             {"trumpet", "<diatonic>-1</diatonic><chromatic>-2</chromatic></transpose>", "2", "D4",
              "\\transposition bes\n"},
             {"french horn", "<diatonic>-4</diatonic><chromatic>-7</chromatic></transpose>", "1", "G4",
              "\\transposition f\n"},
             {"alto sax", "<diatonic>-5</diatonic><chromatic>-9</chromatic></transpose>", "3", "A4",
              "\\transposition es\n"},
             {"tenor sax", "<diatonic>-1</diatonic><chromatic>-2</chromatic><octave-change>-1</octave-change>", "2",
              "D5", "\\transposition bes,\n"},
             {"baritone sax", "<diatonic>-5</diatonic><chromatic>-9</chromatic><octave-change>-1</octave-change>",
              "3", "A5", "\\transposition es,\n"}}) {
        const std::string xml = score(row.instrument, "musicxml");
        EXPECT_TRUE(has(xml, row.transpose)) << row.instrument;
        EXPECT_TRUE(has(xml, "<key><fifths>" + std::string(row.fifths))) << row.instrument;
        const std::string first =
            fmt::format("<pitch><step>{}</step><octave>{}</octave>", row.first[0], row.first[1]);
        EXPECT_EQ(xml.find("<pitch>"), xml.find(first)) << row.instrument;
        EXPECT_TRUE(has(score(row.instrument, "ly"), row.lilypond)) << row.instrument;
        const std::string concert = score(row.instrument, "musicxml", {{"score", "concert"}});
        EXPECT_FALSE(has(concert, "<transpose>"));
        EXPECT_TRUE(has(concert, "<words>Score in C</words>"));
        EXPECT_TRUE(has(concert, "<pitch><step>C</step><octave>4</octave>"));
    }
    EXPECT_TRUE(has(score("clarinet", "abc"), "%%MIDI transpose -2"));
    EXPECT_TRUE(has(score("clarinet", "ly"), "Clarinet in B♭"));
    EXPECT_FALSE(has(score("oboe", "musicxml"), "<transpose>"));
    // Five sharps and two more are seven; nine become three flats.
    EXPECT_TRUE(has(score("clarinet\ntonic: B4", "musicxml"), "<fifths>7"));
    EXPECT_TRUE(has(score("clarinet\ntonic: C#5", "musicxml"), "<fifths>-3"));
}

/// Excerpts keep the numbers of their bars, and have no final bar line unless the whole ends there.
TEST(Excerpts, AreNotEndings) {
    const Document tune = parse("tune.lsys", "heading: 0\naxiom: FFFFFFFFFFFFFFFF\nruns: each step\nunit: 1/4\n");
    const auto score = [&](std::string_view format, const OptionValues& values) {
        return play(tune, format, values);
    };
    const OptionValues middle = {{"from-bar", "2"}, {"bars", "2"}};
    const OptionValues last = {{"from-bar", "3"}};
    EXPECT_TRUE(has(score("musicxml", middle), "<measure number=\"2\">"));
    EXPECT_FALSE(has(score("musicxml", middle), "light-heavy"));
    EXPECT_TRUE(has(score("musicxml", last), "light-heavy"));
    EXPECT_TRUE(has(score("ly", middle), "\\set Score.currentBarNumber = #2"));
    EXPECT_FALSE(has(score("ly", middle), "|."));
    EXPECT_TRUE(has(score("ly", last), "|."));
    EXPECT_TRUE(has(score("abc", middle), "%%setbarnb 2"));
    EXPECT_FALSE(has(score("abc", middle), "|]"));
    EXPECT_TRUE(has(score("ly", {{"bars", "2"}, {"ending", "fermata"}}), "|."));
}

TEST(Mxl, IsReadByOthers) {
    NEEDS("python3");
    const ScratchFolder folder;
    TestScore score = random_score(4, true);
    score.head.pattern = "axiom: X\n";
    MemorySink xml;
    write_musicxml(notate(score), score.head, xml);
    MemorySink packed;
    write_mxl(xml.text, packed);
    EXPECT_LT(packed.text.size(), xml.text.size() / 4);
    folder.write("x.mxl", packed.text);
    folder.write("x.musicxml", xml.text);
    const auto outcome =
        run_tool("cd '" + folder.path().string() +
                 "' && python3 -c \"import zipfile; z = zipfile.ZipFile('x.mxl'); assert z.testzip() is None; "
                 "assert z.read('score.musicxml') == open('x.musicxml', 'rb').read(); "
                 "assert b'score.musicxml' in z.read('META-INF/container.xml')\"");
    EXPECT_TRUE(outcome.ok) << outcome.text;
}

/// Comments cannot contain all characters of a pattern: without a warning, `show` would print another text.
TEST(ScoreFormats, LossesOfCommentsAreReported) {
    EXPECT_TRUE(comments_keep("axiom: F\r\n\ttitle: கோலம்\n"));
    for (const char* lost : {"// \x1b[0m", "a\u2028b", "a\u200Fb", "\xff"}) EXPECT_FALSE(comments_keep(lost)) << lost;
    const auto is_reported = [](const std::string& text, const std::string& format) {
        const std::string remarks = made_work(scores(), parse("a.lsys", text), format).remarks;
        return has(remarks, "the pattern with blanks") || has(remarks, "the pattern with U+FFFD");
    };
    const std::string plain = "axiom: F+F\nangle factor: 4\n";
    for (const char* format : {"abc", "ly", "sco", "csd", "strudel"}) {
        EXPECT_TRUE(is_reported(plain + "// \u2028\n", format)) << format;
        EXPECT_FALSE(is_reported(plain, format)) << format;
    }
    // XML holds marks of direction, but not escapes.
    for (const char* format : {"musicxml", "mxl", "html"}) {
        EXPECT_TRUE(is_reported(plain + "// \x1b[0m\n", format)) << format;
        EXPECT_FALSE(is_reported(plain + "// \u2028\n", format)) << format;
    }
    for (const char* lost : {"// \u2028\n", "// \x1b[0m\n"}) EXPECT_FALSE(is_reported(plain + lost, "mid"));
}

/// Ghost notes have parentheses; drums that are struck together only if all are ghost notes.
TEST(ScoreFormats, GhostNotesHaveParentheses) {
    const auto made = [](const std::string& text, const std::string& format) {
        return made_work(scores(), parse("a.lsys", text), format).bytes();
    };
    const std::string melody = "axiom: F+F+F+F\nmapping: symbols\nrhythm: xo\n";
    EXPECT_TRUE(has(made(melody, "ly"), "c'8["));
    EXPECT_EQ(count_of(made(melody, "ly"), "\\parenthesize "), 2u);
    EXPECT_EQ(count_of(made(melody, "musicxml"), "<notehead parentheses=\"yes\">normal</notehead>"), 2u);
    const std::string drums =
        "mapping: symbols\nunit: 1/8\ndrum s: acoustic snare\ndrum h: closed hi-hat\nrhythm: xo\n";
    EXPECT_EQ(count_of(made("axiom: ssss\n" + drums, "ly"), "\\parenthesize "), 2u);
    EXPECT_EQ(count_of(made("axiom: hhhh\n" + drums, "musicxml"), "<notehead parentheses=\"yes\">x</notehead>"), 2u);
}

/// Words before the tempo are printed as they are written; some state a tempo.
TEST(ScoreFormats, TempoHasWords) {
    const auto made = [](const std::string& tempo, const std::string& format, const std::string& more = "") {
        return made_work(scores(), parse("a.lsys", "axiom: F+F\nangle factor: 4\ntempo: " + tempo + "\n" + more),
                         format)
            .bytes();
    };
    const std::string more = "96 Con moto <e> %";
    EXPECT_TRUE(has(made(more, "ly"), "\\tempo \"Con moto <e> %\" 4 = 96\n"));
    EXPECT_TRUE(has(made(more, "abc"), "Q:\"Con moto <e> \\%\" 1/4=96\n"));
    EXPECT_TRUE(
        has(made(more, "musicxml"), ">Con moto &lt;e&gt; % </words></direction-type><direction-type><metronome>"));
    EXPECT_TRUE(has(made(more, "ly", "swing: 67\n"), "\\tempo \"Con moto <e> %, Swing\" 4 = 96\n"));
    EXPECT_TRUE(has(made("Allegro con brio", "ly"), "\\tempo \"Allegro con brio\" 4 = 138\n"));
    EXPECT_TRUE(has(made("96", "ly"), "\\tempo 4 = 96\n"));
    for (const std::string& bad : std::vector<std::string>{"Slowly", "96 a\"b", "3 Largo", "Allegro by y",
                                                           "Andante 96", "96 84-108", "96 " + std::string(61, 'a')}) {
        EXPECT_NE(error_of([&] { made(bad, "ly"); }), "") << bad;
    }
}

}  // namespace sikku::score_formats_test
