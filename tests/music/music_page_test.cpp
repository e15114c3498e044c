#include "music/score/music_page.h"

#include "music/scores.h"

#include "tests/checks.h"
#include "tests/files.h"
#include "tests/pages.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::music_page_test {

class Memory : public MemoryOutput {
public:
    const std::string& text = bytes_;
};

Note note(std::int64_t onset, std::int64_t duration, double key, glm::dvec2 from, glm::dvec2 to,
          std::int16_t voice = 0) {
    Note result{.onset = onset, .duration = duration, .key = key, .voice = voice, .from = from, .to = to};
    return result;
}

/// The Hilbert curve of order 2, its first edge upwards, in C major: six notes.
std::vector<Note> hilbert() {
    return {note(0, 240, 62, {0, 1}, {1, 1}),    note(240, 480, 60, {1, 0}, {3, 0}),
            note(720, 240, 62, {3, 1}, {2, 1}),  note(960, 240, 64, {2, 2}, {3, 2}),
            note(1200, 480, 65, {3, 3}, {1, 3}), note(1680, 240, 64, {1, 2}, {0, 2})};
}

ScoreHead head() {
    ScoreHead result;
    result.title = "Hilbert curve";
    result.source = "David Hilbert 1891";
    result.pattern = "title: Hilbert curve\naxiom: X\n";
    result.made = "sikku 0.1.0, -n 2";
    return result;
}

std::string svg(const ScoreHead& about, const std::vector<Note>& notes, std::int64_t end) {
    Memory memory;
    write_music_svg(about, notes, end, memory);
    return memory.text;
}
std::string page(const ScoreHead& about, const std::vector<Note>& notes, std::int64_t end) {
    Memory memory;
    write_music_page(about, notes, end, memory);
    return memory.text;
}

pugi::xml_node group(const pugi::xml_document& document, const char* id) {
    return document.document_element().find_child_by_attribute("g", "id", id);
}
std::vector<pugi::xml_node> children(const pugi::xml_node& parent, const char* name) {
    const auto range = parent.children(name);
    return {range.begin(), range.end()};
}

/// How light a colour is to the eye, 0 to 1: relative luminance.
double luminance(const std::string& colour) {
    const auto linear = [&](std::size_t at) {
        const double value = std::stoi(colour.substr(at, 2), nullptr, 16) / 255.0;
        return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5);
}

TEST(NoteCollector, KeepsAllUpToALimit) {
    NoteCollector collector(4);
    const std::vector<Note> some(2);
    collector.notes(some);
    collector.notes(some);
    collector.finish(99);
    EXPECT_EQ(collector.notes().size(), 4U);
    EXPECT_EQ(collector.end(), 99);
    try {
        collector.notes(std::vector<Note>(1));
        ADD_FAILURE() << "nothing was thrown";
    } catch (const ScoreError& error) {
        EXPECT_TRUE(has(error.what(), "limit the bars"));
        EXPECT_TRUE(has(error.what(), "4 notes"));
    }
    EXPECT_EQ(collector.notes().size(), 4U);
    NoteCollector usual;
    EXPECT_NO_THROW(usual.notes(std::vector<Note>(100'000)));
    EXPECT_THROW(usual.notes(some), ScoreError);
}

TEST(MusicSvg, DrawsEachNoteTwiceInOneColour) {
    pugi::xml_document document;
    const std::string text = svg(head(), hilbert(), 1920);
    ASSERT_TRUE(document.load_string(text.c_str()));
    EXPECT_STREQ(document.document_element().attribute("width").value(), "297mm");
    EXPECT_STREQ(document.document_element().attribute("viewBox").value(), "0 0 297 210");
    const auto lines = children(group(document, "curve"), "line");
    const auto blocks = children(group(document, "roll"), "rect");
    ASSERT_EQ(lines.size(), 6U);
    ASSERT_EQ(blocks.size(), 6U);
    const std::vector<Note> notes = hilbert();
    std::map<double, std::string> colours;
    for (std::size_t i = 0; i < 6; ++i) {
        const std::string colour = lines[i].attribute("stroke").value();
        EXPECT_EQ(colour, blocks[i].attribute("fill").value());
        EXPECT_EQ(colours.emplace(notes[i].key, colour).first->second, colour);
    }
    ASSERT_EQ(colours.size(), 4U);
    // The higher, the lighter.
    double before = -1.0;
    for (const auto& [key, colour] : colours) {
        EXPECT_GT(luminance(colour), before) << key;
        before = luminance(colour);
    }
}

TEST(MusicSvg, PlacesNotesInScaleAndUpwards) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg(head(), hilbert(), 1920).c_str()));
    const auto lines = children(group(document, "curve"), "line");
    const std::vector<Note> notes = hilbert();
    const double step = lines[1].attribute("x2").as_double() - lines[1].attribute("x1").as_double();
    ASSERT_GT(step, 0.0);
    const double left = lines[0].attribute("x1").as_double();
    const double bottom = lines[1].attribute("y1").as_double();
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(lines[i].attribute("x1").as_double(), left + 0.5 * step * notes[i].from.x, 0.003);
        EXPECT_NEAR(lines[i].attribute("x2").as_double(), left + 0.5 * step * notes[i].to.x, 0.003);
        EXPECT_NEAR(lines[i].attribute("y1").as_double(), bottom - 0.5 * step * notes[i].from.y, 0.003);
        EXPECT_NEAR(lines[i].attribute("y2").as_double(), bottom - 0.5 * step * notes[i].to.y, 0.003);
    }
    const auto blocks = children(group(document, "roll"), "rect");
    const auto middle = [&](std::size_t i) {
        return blocks[i].attribute("y").as_double() + 0.5 * blocks[i].attribute("height").as_double();
    };
    const double origin = blocks[0].attribute("x").as_double();
    const double tick = (blocks[5].attribute("x").as_double() - origin) / 1680.0;
    const double key = (middle(1) - middle(4)) / 5.0;
    EXPECT_GT(tick, 0.0);
    EXPECT_GT(key, 0.0);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(blocks[i].attribute("x").as_double(), origin + tick * static_cast<double>(notes[i].onset), 0.003);
        EXPECT_NEAR(middle(i), middle(1) - key * (notes[i].key - 60.0), 0.003);
        const double full = tick * static_cast<double>(notes[i].duration);
        EXPECT_LE(blocks[i].attribute("width").as_double(), full);
        EXPECT_GE(blocks[i].attribute("width").as_double(), 0.6 * full);
    }
    // Everything is on the page.
    for (const auto& line : lines) {
        for (const char* name : {"x1", "x2"}) {
            EXPECT_GT(line.attribute(name).as_double(), 10.0);
            EXPECT_LT(line.attribute(name).as_double(), origin);
        }
        for (const char* name : {"y1", "y2"}) {
            EXPECT_GT(line.attribute(name).as_double(), 30.0);
            EXPECT_LT(line.attribute(name).as_double(), 195.0);
        }
    }
    for (const auto& block : blocks) {
        EXPECT_LT(block.attribute("x").as_double() + block.attribute("width").as_double(), 287.0);
    }
}

TEST(MusicSvg, MicrotonesLieBetweenTheKeys) {
    pugi::xml_document document;
    const std::vector<Note> notes = {note(0, 480, 60, {0, 0}, {1, 0}), note(480, 480, 60.5, {1, 1}, {2, 1}),
                                     note(960, 480, 62, {2, 2}, {3, 2})};
    ASSERT_TRUE(document.load_string(svg(head(), notes, 1440).c_str()));
    const auto blocks = children(group(document, "roll"), "rect");
    ASSERT_EQ(blocks.size(), 3U);
    const double low = blocks[0].attribute("y").as_double();
    const double high = blocks[2].attribute("y").as_double();
    EXPECT_NEAR(blocks[1].attribute("y").as_double(), low + (high - low) / 4.0, 0.002);
}

TEST(MusicSvg, SilentRunsAreThinAndJumpsAreNotDrawn) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg(head(), hilbert(), 1920).c_str()));
    auto silent = children(group(document, "curve"), "path");
    ASSERT_EQ(silent.size(), 1U);
    // Five runs between six notes, one of them on the spot of nothing: all are vertical here.
    const std::string runs = silent[0].attribute("d").value();
    EXPECT_EQ(std::count(runs.begin(), runs.end(), 'M'), 5);
    EXPECT_LT(silent[0].attribute("stroke-width").as_double(),
              0.5 * group(document, "curve").attribute("stroke-width").as_double());
    // A jump aslant, notes without a gap, and another voice.
    const std::vector<Note> jumps = {note(0, 480, 60, {0, 0}, {1, 0}), note(480, 480, 62, {3, 2}, {4, 2}),
                                     note(960, 480, 62, {4, 2}, {5, 2}), note(0, 480, 62, {1, 1}, {2, 1}, 1)};
    ASSERT_TRUE(document.load_string(svg(head(), jumps, 1440).c_str()));
    EXPECT_EQ(children(group(document, "curve"), "path").size(), 0U);
    EXPECT_EQ(children(group(document, "curve"), "line").size(), 4U);
}

TEST(MusicSvg, HasOctavesAndBars) {
    std::vector<Note> notes;
    for (int i = 0; i < 16; ++i) notes.push_back(note(960 * i, 960, 36 + 3 * i, {i, i}, {i + 1, i}));
    ScoreHead about = head();
    about.meter = {3, 4};
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg(about, notes, 960 * 16).c_str()));
    // From 36 to 81, with a key of air: C2 to C5.
    std::set<std::string> names;
    for (const auto& text : children(group(document, "keys"), "text")) names.insert(text.child_value());
    EXPECT_EQ(names, (std::set<std::string>{"C2", "C3", "C4", "C5"}));
    // 32 quarters are 10 bars of 3/4 and two quarters more.
    const auto bars = children(group(document, "bars"), "path");
    EXPECT_EQ(bars.size(), 11U);
    // A score of thousands of bars has not thousands of lines.
    notes.push_back(note(4'000'000, 960, 60, {0, 0}, {1, 0}));
    ASSERT_TRUE(document.load_string(svg(about, notes, 0).c_str()));
    EXPECT_LT(children(group(document, "bars"), "path").size(), 150U);
    EXPECT_GT(children(group(document, "bars"), "path").size(), 20U);
}

TEST(MusicSvg, WithoutACurveHasTheRollAlone) {
    pugi::xml_document document;
    const std::vector<Note> notes = {note(0, 480, 60, {}, {}), note(480, 480, 64, {}, {})};
    ASSERT_TRUE(document.load_string(svg(head(), notes, 960).c_str()));
    EXPECT_FALSE(group(document, "curve"));
    EXPECT_EQ(children(group(document, "roll"), "rect").size(), 2U);
    // Not even a note.
    ASSERT_TRUE(document.load_string(svg(head(), {}, 0).c_str()));
    EXPECT_EQ(children(group(document, "roll"), "rect").size(), 0U);
    // A curve without height, and one without width.
    for (const glm::dvec2 to : {glm::dvec2(5, 0), glm::dvec2(0, 5)}) {
        const std::string text = svg(head(), {note(0, 480, 60, {0, 0}, to)}, 480);
        ASSERT_TRUE(document.load_string(text.c_str()));
        EXPECT_EQ(children(group(document, "curve"), "line").size(), 1U);
        EXPECT_FALSE(has(text, "nan"));
        EXPECT_FALSE(has(text, "inf\""));
    }
}

constexpr std::string_view evil =
    "<b>&amp; \"A\" & 'B' </script><script>alert(1)</script> --> ]]> </title> \xF0\x9F\x8E\xB5 \x01\xFF";

TEST(MusicSvg, TextsAreTexts) {
    ScoreHead about = head();
    about.title = evil;
    about.source = evil;
    about.made = evil;
    about.pattern = evil;
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svg(about, hilbert(), 1920).c_str()));
    const std::string expected =
        "<b>&amp; \"A\" & 'B' </script><script>alert(1)</script> --> ]]> </title> \xF0\x9F\x8E\xB5 "
        "\xEF\xBF\xBD\xEF\xBF\xBD";
    EXPECT_EQ(document.document_element().child("title").child_value(), expected);
    EXPECT_EQ(document.document_element().child("desc").child_value(), expected);
    const ScratchFolder folder;
    NEEDS("xmllint");
    const ToolOutcome outcome =
        run_tool("xmllint --nonet --noout '" + folder.write("x.svg", svg(about, hilbert(), 1920)) + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
    EXPECT_EQ(outcome.text, "");
}

TEST(MusicSvg, HoldsVeryMany) {
    std::vector<Note> notes;
    for (int i = 0; i < 100'000; ++i)
        notes.push_back(note(240 * i, 240, 40 + i % 50, {i % 300, i / 300}, {i % 300 + 1, i / 300}));
    const ScratchFolder folder;
    const std::string text = svg(head(), notes, 0);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(text.c_str()));
    EXPECT_EQ(children(group(document, "roll"), "rect").size(), 100'000U);
    NEEDS("xmllint");
    const ToolOutcome outcome = run_tool("xmllint --nonet --noout '" + folder.write("x.svg", text) + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
}

/// The numbers of the page's notes, as they are written.
std::vector<std::vector<std::string>> page_notes(const std::string& text) {
    std::vector<std::vector<std::string>> result;
    const std::size_t begin = text.find("\"notes\":[");
    const std::size_t end = text.find("]}</script>", begin);
    EXPECT_NE(end, std::string::npos);
    for (std::size_t at = text.find("\n[", begin); at < end; at = text.find("\n[", at + 1)) {
        std::vector<std::string> row(1);
        for (std::size_t i = at + 2; text[i] != ']'; ++i) {
            if (text[i] == ',') {
                row.emplace_back();
            } else {
                row.back() += text[i];
            }
        }
        result.push_back(row);
    }
    return result;
}

TEST(MusicPage, HoldsTheNotesExactly) {
    std::vector<Note> notes = {note(9'007'199'254'740'000, 7, 60.12346, {-0.00001, 0.5}, {1.0 / 3.0, -2}),
                               note(480, 1, 127, {0, 0}, {1, 0}, 3), note(480, 333, 59.99996, {0, 0}, {1, 0}, 2)};
    notes[1].velocity = 127;
    const auto rows = page_notes(page(head(), notes, 0));
    using Row = std::vector<std::string>;
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0], (Row{"480", "333", "60", "2", "80", "0", "0", "1", "0"}));
    EXPECT_EQ(rows[1], (Row{"480", "1", "127", "3", "127", "0", "0", "1", "0"}));
    EXPECT_EQ(rows[2], (Row{"9007199254740000", "7", "60.1235", "0", "80", "0", "0.5", "0.3333", "-2"}));
    EXPECT_TRUE(page(head(), notes, 0).find("\"end\":9007199254740007,") != std::string::npos);
}

TEST(MusicPage, NeedsNothingFromElsewhere) {
    const std::string text = page(head(), hilbert(), 1920);
    EXPECT_FALSE(has(text, "://"));
    for (const char* word :
         {"src=", "@import", "url(", "fetch(", "XMLHttpRequest", "import(", "Date", "localStorage"}) {
        EXPECT_FALSE(has(text, word)) << word;
    }
    EXPECT_TRUE(has(text, "default-src 'none'"));
}

TEST(MusicPage, IsWellFormedAndNamesWhatItHas) {
    pugi::xml_document document;
    const pugi::xml_parse_result result =
        document.load_string(markup(page(head(), hilbert(), 1920)).c_str(),
                             pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata);
    ASSERT_TRUE(result) << result.description() << " at " << result.offset;
    const pugi::xml_node html = document.child("html");
    EXPECT_STREQ(html.attribute("lang").value(), "en");
    EXPECT_STREQ(html.child("head").child("title").child_value(), "Hilbert curve");
    const pugi::xml_node body = html.child("body").child("main");
    EXPECT_STREQ(body.child("h1").child_value(), "Hilbert curve");
    EXPECT_STREQ(body.child("details").child("pre").child_value(), "title: Hilbert curve\naxiom: X\n");
    // Every control has a name, every picture a text.
    const auto inputs = html.select_nodes("//input");
    EXPECT_EQ(inputs.size(), 4U);
    // The time changes every second, and is no part of a name that a screen reader would read again.
    EXPECT_STREQ(html.select_node("//input[@id='place']").node().attribute("aria-label").value(), "Position");
    EXPECT_STREQ(html.select_node("//*[@id='place-text']").node().attribute("aria-hidden").value(), "true");
    for (const auto& input : inputs) EXPECT_STREQ(input.node().parent().name(), "label");
    for (const auto& canvas : html.select_nodes("//canvas")) {
        EXPECT_TRUE(canvas.node().attribute("aria-label") || canvas.node().attribute("aria-hidden"));
    }
    expect_ids(html, page(head(), hilbert(), 1920));
}

TEST(MusicPage, TextsAreTexts) {
    ScoreHead about = head();
    about.title = evil;
    about.source = evil;
    about.made = evil;
    about.pattern = "\n" + std::string(evil);
    const std::string text = page(about, hilbert(), 1920);
    EXPECT_EQ(count_of(text, "<script"), count_of(page(head(), hilbert(), 1920), "<script"));
    EXPECT_EQ(count_of(text, "</script"), 2U);
    EXPECT_EQ(count_of(text, "</title"), 1U);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(markup(text).c_str(), pugi::parse_default | pugi::parse_ws_pcdata));
    const std::string expected =
        "<b>&amp; \"A\" & 'B' </script><script>alert(1)</script> --> ]]> </title> \xF0\x9F\x8E\xB5 "
        "\xEF\xBF\xBD\xEF\xBF\xBD";
    const pugi::xml_node main = document.child("html").child("body").child("main");
    EXPECT_EQ(main.child("h1").child_value(), expected);
    // A parser of HTML drops the first line feed.
    EXPECT_EQ(main.child("details").child("pre").child_value(), "\n\n" + expected);
}

TEST(MusicPage, TheTempoIsWithinItsSlider) {
    for (const double tempo : {1.0, 0.5, 3.7, 60.0, 120.5, 999.0, 12000.0}) {
        ScoreHead about = head();
        about.tempo = tempo;
        pugi::xml_document document;
        ASSERT_TRUE(document.load_string(markup(page(about, hilbert(), 1920)).c_str()));
        const pugi::xml_node slider = document.select_node("//input[@id='tempo']").node();
        EXPECT_LE(slider.attribute("min").as_double(), tempo);
        EXPECT_GT(slider.attribute("min").as_double(), 0.0);
        EXPECT_GE(slider.attribute("max").as_double(), tempo);
        EXPECT_NEAR(slider.attribute("value").as_double(), tempo, 1e-4);
        // Half of it can be reached.
        EXPECT_LE(slider.attribute("min").as_double(), tempo / 2.0);
    }
}

TEST(MusicPage, IsTheSameWhateverTheOrderAndTheLocale) {
    std::vector<Note> notes = hilbert();
    notes.push_back(note(240, 960, 48.5, {0, 0.5}, {2, 0.5}, 1));
    const std::string first_svg = svg(head(), notes, 1920);
    const std::string first_page = page(head(), notes, 1920);
    std::reverse(notes.begin(), notes.end());
    for (const char* locale : {"C", "de_DE.UTF-8"}) {
        std::setlocale(LC_ALL, locale);
        EXPECT_TRUE(svg(head(), notes, 1920) == first_svg);
        EXPECT_TRUE(page(head(), notes, 1920) == first_page);
    }
    std::setlocale(LC_ALL, "C");
}

TEST(MusicPage, WithoutNotesIsAPage) {
    const std::string text = page(head(), {}, 0);
    EXPECT_TRUE(page_notes(text).empty());
    EXPECT_TRUE(has(text, "\"end\":1,"));
}

/// The numbers of a list in the data of a page: `"phrases":[0,480]`.
std::vector<std::int64_t> numbers_of(const std::string& text, const std::string& name) {
    std::vector<std::int64_t> numbers;
    const std::string begin = "\"" + name + "\":[";
    const std::size_t at = text.find(begin);
    EXPECT_NE(at, std::string::npos);
    for (const char* from = text.c_str() + at + begin.size(); *from != ']'; from += *from == ',' ? 1 : 0) {
        char* end = nullptr;
        numbers.push_back(std::strtoll(from, &end, 10));
        from = end;
    }
    return numbers;
}

const std::string phrased_curve =
    "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nderivation length: 5\nunit: 1/8\nphrases: 2\n";

/// The ticks at which notes begin after a rest, or with the melody: with `breath`, those of phrases.
std::vector<std::int64_t> begins_after_rests(const std::vector<Note>& notes) {
    std::map<std::int64_t, std::int64_t> line;  // ends by onset
    for (const Note& one : notes) line[one.onset] = std::max(line[one.onset], one.onset + one.duration);
    std::vector<std::int64_t> begins;
    std::int64_t end = -1;
    for (const auto& [onset, note_end] : line) {
        if (onset > end) begins.push_back(onset);
        end = std::max(end, note_end);
    }
    return begins;
}

TEST(MusicPage, NamesTheBeginningsOfPhrases) {
    const auto phrases = [](const std::string& keys, const OptionValues& values = {}) {
        return numbers_of(play(parse("p.lsys", phrased_curve + keys), "html", values), "phrases");
    };
    const auto notes = [](const std::string& keys) {
        const Document document = parse("p.lsys", phrased_curve + keys);
        std::vector<Note> first;  // voice
        for (const Note& one : list_notes({&document, 1}, {}, {}).notes) {
            if (one.voice == 0) first.push_back(one);
        }
        return first;
    };
    for (const std::string keys :
         {"", "breath: 1/4\n", "breath: 1/8 bar\n", "breath: 1/8 by level\n", "rhythm: x.xx\n",
          "cadence: alternate\n", "form: A B A\n", "form: A Br A\n", "form: A Ak\n", "form: A*2 B/2\n",
          "retrograde: yes\n", "retrograde: yes\nform: A B\n", "loop: 3\n", "start: 2\n", "canon: 2 7\n",
          "upbeat: 1/4\nbreath: 1/8 bar\n", "vertical: voice\nbreath: 1/8 bar\n", "swing: 66\ncadence: tonic\n",
          "leaps: 7\n"}) {
        const std::vector<std::int64_t> expected = begins_after_rests(notes(keys));
        EXPECT_EQ(phrases(keys), expected) << keys;
        EXPECT_GT(expected.size(), 1u) << keys;
    }
    // Without rests between phrases, their number is the same.
    EXPECT_EQ(phrases("breath: none\n").size(), phrases("").size());
    EXPECT_EQ(phrases("breath: none\nrange: fold\n").front(), 0);
    // Excerpts contain the phrases that begin within them, near the beginning and far from it.
    const std::vector<std::int64_t> whole = phrases("");
    for (const std::int64_t from : {2, 3, 7, 20, 33}) {
        const std::int64_t begin = (from - 1) * 1920;
        std::vector<std::int64_t> within;
        for (const std::int64_t tick : whole) {
            if (tick >= begin && tick < begin + 8 * 1920) within.push_back(tick - begin);
        }
        EXPECT_EQ(phrases("", {{"from-bar", std::to_string(from)}, {"bars", "8"}}), within) << from;
        EXPECT_FALSE(within.empty());
    }
    // Melodies without phrases have none, nor has an accompaniment.
    const auto all = [](const std::string& text) {
        return numbers_of(play(parse("p.lsys", text), "html"), "phrases");
    };
    EXPECT_EQ(all("axiom: F+F\n"), std::vector<std::int64_t>());
    EXPECT_EQ(phrases("harmony: progression I-V\n"), phrases(""));
    EXPECT_EQ(phrases("harmony: triads\naccompaniment: oom-pah\n"), phrases(""));
}

}  // namespace sikku::music_page_test
