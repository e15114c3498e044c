#include "music/score/score_formats.h"

#include "tests/checks.h"
#include "tests/files.h"
#include "tests/notation_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace sikku::musicxml_test {

std::string xml_of(const TestScore& score) {
    MemorySink sink;
    write_musicxml(notate(score), score.head, sink);
    return sink.text;
}

pugi::xml_document parsed(const std::string& text) {
    pugi::xml_document document;
    const auto result = document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_ws_pcdata);
    EXPECT_TRUE(result) << result.description();
    return document;
}

std::int64_t length_of_type(const std::string& type, bool dotted) {
    static const std::map<std::string, std::int64_t> ticks = {
        {"whole", 1920}, {"half", 960}, {"quarter", 480}, {"eighth", 240}, {"16th", 120}, {"32nd", 60}, {"64th", 30}};
    return dotted ? ticks.at(type) * 3 / 2 : ticks.at(type);
}

/// A note as it stands in the file, untied.
struct ReadNote {
    std::int64_t onset = 0;
    std::int64_t bar = 0;
    std::string staff;
    std::string step;
    int octave = 0;
    double alter = 0.0;
    std::string accidental;
    bool tied_back = false;
};

/// What MusicXML says, read as its tutorial tells: durations move a cursor, backup and forward too.
struct ReadPart {
    std::vector<PlainNote> notes;  ///< joined at ties
    std::vector<ReadNote> printed;
    std::int64_t end = 0;
    int fifths = 0;
};

/// A tuplet of a voice that has begun.
struct OpenTuplet {
    bool is_open = false;
    int actual = 0;
    int normal = 0;
    std::string type;
    std::int64_t begin = 0;
};

/// Notes with a time modification stand between the marks of a tuplet, which is as long as it says.
void follow_tuplet(OpenTuplet& tuplet, const pugi::xml_node& note, std::int64_t here, std::int64_t duration) {
    const auto modification = note.child("time-modification");
    const auto marks = note.child("notations").children("tuplet");
    for (const auto mark : marks) {
        if (std::string(mark.attribute("type").value()) != "start") continue;
        EXPECT_FALSE(tuplet.is_open);
        tuplet = {true, modification.child("actual-notes").text().as_int(),
                  modification.child("normal-notes").text().as_int(), modification.child_value("normal-type"), here};
    }
    EXPECT_EQ(tuplet.is_open, !modification.empty());
    if (!tuplet.is_open) return;
    EXPECT_EQ(modification.child("actual-notes").text().as_int(), tuplet.actual);
    EXPECT_EQ(modification.child("normal-notes").text().as_int(), tuplet.normal);
    EXPECT_EQ(modification.child_value("normal-type"), tuplet.type);
    for (const auto mark : marks) {
        if (std::string(mark.attribute("type").value()) != "stop") continue;
        EXPECT_EQ(here + duration - tuplet.begin, tuplet.normal * length_of_type(tuplet.type, false));
        tuplet.is_open = false;
    }
}

/// Beams begin, go on and end, as many as the note value has, and none on longer notes.
void follow_beams(std::array<bool, 4>& open, const pugi::xml_node& note) {
    const std::string type = note.child_value("type");
    const std::size_t most = type == "eighth" ? 1 : type == "16th" ? 2 : type == "32nd" ? 3 : type == "64th" ? 4 : 0;
    std::size_t count = 0;
    for (const auto beam : note.children("beam")) {
        const auto level = beam.attribute("number").as_ullong() - 1;
        EXPECT_EQ(level, count++);
        ASSERT_LT(level, 4u);
        const std::string kind = beam.child_value();
        EXPECT_EQ(open[level], kind == "continue" || kind == "end") << kind;
        open[level] = kind == "begin" || kind == "continue";
    }
    EXPECT_TRUE(count == 0 || count == most) << type;
    for (std::size_t level = count; level < 4; ++level) EXPECT_FALSE(open[level]);
}

/// Bars have the length of the meter that the part states.
ReadPart read_part(const pugi::xml_node& part) {
    static const std::map<std::string, int> semitones = {{"C", 0}, {"D", 2}, {"E", 4}, {"F", 5},
                                                         {"G", 7}, {"A", 9}, {"B", 11}};
    ReadPart result;
    std::int64_t divisions = 0;
    std::int64_t bar_ticks = 0;
    std::map<std::string, PlainNote> open;  // tied forward, by voice
    std::int64_t bar_begin = 0;
    std::int64_t bar_number = 0;
    for (const pugi::xml_node measure : part.children("measure")) {
        EXPECT_EQ(measure.attribute("number").as_llong(), ++bar_number);
        if (const auto attributes = measure.child("attributes"); attributes.child("divisions")) {
            divisions = attributes.child("divisions").text().as_llong();
            result.fifths = attributes.child("key").child("fifths").text().as_int();
        }
        for (const auto attributes : measure.children("attributes")) {
            const auto time = attributes.child("time");
            if (!time) continue;
            bar_ticks = 4 * ticks_per_quarter * time.child("beats").text().as_llong() /
                        time.child("beat-type").text().as_llong();
        }
        const auto ticks = [&](const pugi::xml_node& node) {
            return node.child("duration").text().as_llong() * ticks_per_quarter / divisions;
        };
        std::int64_t here = bar_begin;
        std::map<std::string, std::int64_t> sums;
        std::map<std::string, OpenTuplet> tuplets;
        std::map<std::string, std::array<bool, 4>> beams;
        for (const pugi::xml_node node : measure.children()) {
            const std::string name = node.name();
            if (name == "backup") {
                here -= ticks(node);
                EXPECT_GE(here, bar_begin);
            } else if (name == "forward") {
                here += ticks(node);
            } else if (name == "note") {
                const std::string voice = node.child("voice").text().as_string();
                const std::int64_t duration = ticks(node);
                sums[voice] += duration;
                if (const auto type = node.child("type")) {
                    const auto modification = node.child("time-modification");
                    const std::int64_t actual =
                        modification ? modification.child("actual-notes").text().as_llong() : 1;
                    const std::int64_t normal =
                        modification ? modification.child("normal-notes").text().as_llong() : 1;
                    EXPECT_EQ(duration * actual,
                              length_of_type(type.text().as_string(), !node.child("dot").empty()) * normal);
                    follow_tuplet(tuplets[voice], node, here, duration);
                    follow_beams(beams[voice], node);
                } else {
                    EXPECT_STREQ(node.child("rest").attribute("measure").value(), "yes");
                    EXPECT_EQ(duration, bar_ticks);
                }
                bool back = false;
                bool forward = false;
                for (const auto tie : node.children("tie")) {
                    (std::string(tie.attribute("type").value()) == "stop" ? back : forward) = true;
                }
                bool shown_back = false;
                bool shown_forward = false;
                for (const auto tied : node.child("notations").children("tied")) {
                    (std::string(tied.attribute("type").value()) == "stop" ? shown_back : shown_forward) = true;
                }
                EXPECT_EQ(back, shown_back);
                EXPECT_EQ(forward, shown_forward);
                EXPECT_EQ(open.contains(voice), back);
                if (const auto pitch = node.child("pitch")) {
                    const std::string step = pitch.child("step").text().as_string();
                    const int octave = pitch.child("octave").text().as_int();
                    const double alter = pitch.child("alter").text().as_double();
                    const double key = 12 * (octave + 1) + semitones.at(step) + alter;
                    result.printed.push_back({here, bar_number, node.child("staff").text().as_string(), step, octave,
                                              alter, node.child("accidental").text().as_string(), back});
                    PlainNote note{here, duration, key};
                    if (back) {
                        EXPECT_EQ(open[voice].key, key);
                        EXPECT_EQ(open[voice].onset + open[voice].duration, here);
                        note.onset = open[voice].onset;
                        note.duration += open[voice].duration;
                        open.erase(voice);
                    }
                    if (forward) {
                        open[voice] = note;
                    } else {
                        result.notes.push_back(note);
                    }
                } else {
                    EXPECT_TRUE(node.child("rest"));
                }
                here += duration;
            }
            EXPECT_LE(here, bar_begin + bar_ticks);
        }
        // Voices are whole bars, and the bar ends at its end.
        EXPECT_EQ(here, bar_begin + bar_ticks);
        for (const auto& [voice, sum] : sums) EXPECT_EQ(sum, bar_ticks) << "voice " << voice;
        for (const auto& [voice, tuplet] : tuplets) EXPECT_FALSE(tuplet.is_open) << "voice " << voice;
        for (const auto& [voice, open_beams] : beams) EXPECT_EQ(open_beams, (std::array<bool, 4>{})) << voice;
        bar_begin += bar_ticks;
    }
    EXPECT_TRUE(open.empty());
    result.end = bar_begin;
    std::sort(result.notes.begin(), result.notes.end());
    return result;
}

/// Plays from the page: the key signature and the printed accidentals alone have to give every alteration.
void expect_signs_suffice(const ReadPart& part) {
    static const std::map<std::string, double> values = {
        {"flat-flat", -2},  {"three-quarters-flat", -1.5}, {"flat", -1}, {"quarter-flat", -0.5},
        {"natural", 0},     {"quarter-sharp", 0.5},        {"sharp", 1}, {"three-quarters-sharp", 1.5},
        {"double-sharp", 2}};
    auto notes = part.printed;
    std::stable_sort(notes.begin(), notes.end(),
                     [](const ReadNote& a, const ReadNote& b) { return a.onset < b.onset; });
    const std::string order = "FCGDAEB";
    std::map<std::string, double> in_force;
    std::int64_t bar = 0;
    for (const ReadNote& note : notes) {
        if (note.tied_back) {
            EXPECT_EQ(note.accidental, "");
            continue;
        }
        if (note.bar != bar) in_force.clear();
        bar = note.bar;
        const std::string place = note.staff + note.step + std::to_string(note.octave);
        if (!note.accidental.empty()) in_force[place] = values.at(note.accidental);
        const auto rank = static_cast<int>(order.find(note.step));
        const double by_key = part.fifths > rank ? 1 : -part.fifths > 6 - rank ? -1 : 0;
        const double heard = in_force.contains(place) ? in_force[place] : by_key;
        EXPECT_EQ(heard, note.alter);
    }
}

TEST(MusicXml, EndsWithAFermata) {
    const pugi::xml_document document = parsed(xml_of(held_score({4, 4})));
    const auto held = document.select_nodes("//note[notations/fermata]");
    ASSERT_EQ(held.size(), 2u);
    for (const auto& each : held) EXPECT_EQ(each.parent().attribute("number").as_int(), 4);
    const auto words = document.select_nodes("//words[text()='rit.']");
    ASSERT_EQ(words.size(), 1u);
    EXPECT_EQ(words.first().parent().parent().parent().attribute("number").as_int(), 3);
}

TEST(MusicXml, RandomScoresAreReadBack) {
    for (unsigned seed = 0; seed < 150; ++seed) {
        const TestScore score = random_score(seed, seed % 3 == 0);
        const auto document = parsed(xml_of(score));
        std::vector<PlainNote> all;
        std::int64_t end = 0;
        for (const pugi::xml_node part : document.child("score-partwise").children("part")) {
            const ReadPart read = read_part(part);
            all.insert(all.end(), read.notes.begin(), read.notes.end());
            expect_signs_suffice(read);
            if (end > 0) {
                EXPECT_EQ(read.end, end);
            }
            end = read.end;
        }
        std::sort(all.begin(), all.end());
        ASSERT_EQ(all, plain(score.notes)) << seed;
    }
}

TEST(MusicXml, TellsWhatTheScoreIs) {
    TestScore score = line({5, 8}, {1200, 240});
    score.head.composer = "Peano";
    score.head.source = "peano.lsys";
    score.head.made = "sikku 0.1.0, -n 4";
    score.head.pattern = "axiom: X\nX --> F\n";
    score.head.tempo = 92.5;
    score.head.parts[0].program = 40;
    score.head.parts[0].key = KeySignature{-3, true};
    const auto document = parsed(xml_of(score));
    const auto root = document.child("score-partwise");
    EXPECT_STREQ(root.attribute("version").value(), "4.0");
    EXPECT_STREQ(root.child("work").child_value("work-title"), "A line");
    const auto identification = root.child("identification");
    EXPECT_STREQ(identification.child_value("creator"), "Peano");
    EXPECT_STREQ(identification.child_value("source"), "peano.lsys");
    EXPECT_STREQ(identification.child_value("rights"), "peano.lsys");
    // A staff of 20 points.
    EXPECT_STREQ(root.child("defaults").child("scaling").child_value("millimeters"), "7.03");
    EXPECT_STREQ(identification.child("encoding").child_value("software"), "sikku 0.1.0");
    EXPECT_FALSE(identification.child("encoding").child("encoding-date"));
    const auto field = [&](const char* name) {
        return std::string(
            identification.child("miscellaneous").find_child_by_attribute("name", name).text().as_string());
    };
    EXPECT_EQ(field("made"), score.head.made);
    EXPECT_EQ(field("pattern"), score.head.pattern);
    const auto told = root.child("part-list").child("score-part");
    EXPECT_STREQ(told.child_value("part-name"), "Voice");
    EXPECT_STREQ(told.child("midi-instrument").child_value("midi-program"), "41");
    EXPECT_STREQ(told.attribute("id").value(), root.child("part").attribute("id").value());
    const auto measure = root.child("part").child("measure");
    const auto attributes = measure.child("attributes");
    EXPECT_STREQ(attributes.child("key").child_value("fifths"), "-3");
    EXPECT_STREQ(attributes.child("key").child_value("mode"), "minor");
    EXPECT_STREQ(attributes.child("time").child_value("beats"), "5");
    EXPECT_STREQ(attributes.child("time").child_value("beat-type"), "8");
    EXPECT_STREQ(attributes.child("clef").child_value("sign"), "G");
    EXPECT_STREQ(measure.child("direction").child("sound").attribute("tempo").value(), "92.5");
    EXPECT_STREQ(measure.child("direction").child("direction-type").child("metronome").child_value("beat-unit"),
                 "eighth");
    EXPECT_STREQ(measure.child("direction").child("direction-type").child("metronome").child_value("per-minute"),
                 "185");
    // Peano's five units.
    const auto first = measure.child("note");
    EXPECT_STREQ(first.child_value("type"), "quarter");
    EXPECT_FALSE(first.child("dot").empty());
    EXPECT_STREQ(first.next_sibling("note").child_value("type"), "quarter");
    EXPECT_STREQ(first.child("tie").attribute("type").value(), "start");
}

TEST(MusicXml, PartsHaveChannelsOfTheirOwn) {
    TestScore score;
    for (int i = 0; i < 15; ++i) score.head.parts.push_back(plain_part("P" + std::to_string(i), 1));
    const auto document = parsed(xml_of(score));
    std::vector<int> channels;
    for (const auto part : document.child("score-partwise").child("part-list").children("score-part")) {
        channels.push_back(part.child("midi-instrument").child("midi-channel").text().as_int());
    }
    EXPECT_EQ(channels, (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14, 15, 16}));
}

TEST(MusicXml, StavesOfABracketAreParts) {
    TestScore score;
    score.head.parts = {plain_part("Solo", 1), plain_part("Voices", 6)};
    for (std::int16_t voice = 0; voice < 7; ++voice) {
        Note note{.duration = 1920, .voice = voice};
        score.head.parts[0].program = score.head.parts[1].program = 40;
        score.notes.push_back(note);
    }
    const auto document = parsed(xml_of(score));
    const auto list = document.child("score-partwise").child("part-list");
    std::string text;
    for (const auto node : list.children()) {
        if (node.type() != pugi::node_element) continue;
        text += std::string(node.name()) == "part-group" ? std::string(node.attribute("type").value()) + " "
                                                         : std::string(node.child_value("part-name")) + ", ";
    }
    EXPECT_EQ(text, "Solo, start Voices 1, Voices 2, Voices 3, Voices 4, Voices 5, Voices 6, stop ");
    EXPECT_STREQ(list.child("part-group").child_value("group-symbol"), "bracket");
    EXPECT_FALSE(document.child("score-partwise").child("part").child("measure").child("attributes").child("staves"));
}

TEST(MusicXml, ASingleDrumHasOneLine) {
    TestScore score = line({4, 4}, {480, 480}, 39);
    score.head.parts[0].is_drums = true;
    const auto document = parsed(xml_of(score));
    const auto measure = document.child("score-partwise").child("part").child("measure");
    EXPECT_STREQ(measure.child("attributes").child("staff-details").child_value("staff-lines"), "1");
    EXPECT_STREQ(measure.child("note").child("unpitched").child_value("display-step"), "E");
    EXPECT_STREQ(measure.child("note").child_value("notehead"), "triangle");
}

TEST(MusicXml, TextsAreEscaped) {
    TestScore score = line({4, 4}, {480});
    const std::string text = "A<b> & \"c\" 'd' ]]> é \xE0\xAE\x95\r\n\ttab";
    score.head.title = text;
    score.head.composer = text;
    score.head.pattern = text;
    score.head.parts[0].name = text;
    const auto document = parsed(xml_of(score));
    const auto root = document.child("score-partwise");
    EXPECT_EQ(root.child("work").child_value("work-title"), text);
    EXPECT_EQ(root.child("identification").child_value("creator"), text);
    EXPECT_EQ(root.child("part-list").child("score-part").child_value("part-name"), text);
    // What XML cannot hold.
    score.head.title = std::string("a\0b\x01 \xFF \xEF\xBF\xBF", 10);
    EXPECT_STREQ(parsed(xml_of(score)).child("score-partwise").child("work").child_value("work-title"),
                 "a\uFFFDb\uFFFD \uFFFD \uFFFD\uFFFD\uFFFD");
}

TEST(MusicXml, IsWellFormedToOthers) {
    NEEDS("xmllint");
    const ScratchFolder folder;
    for (unsigned seed = 0; seed < 8; ++seed) {
        TestScore score = random_score(seed, true);
        score.head.title = "<&\" \x02 \xC3";
        const auto outcome =
            run_tool("xmllint --nonet --noout '" + folder.write("score.musicxml", xml_of(score)) + "'");
        EXPECT_TRUE(outcome.ok) << outcome.text;
        EXPECT_EQ(outcome.text, "");
    }
}

TEST(MusicXml, HasNoOctaveBelowZero) {
    TestScore score = line({4, 4}, {480, 480, 960, 480}, 12);
    EXPECT_NO_THROW(xml_of(score));
    score.notes.back().key = 11;
    EXPECT_EQ(error_of<ScoreError>([&] { xml_of(score); }),
              "bar 2 has a note below C0, the lowest that MusicXML can tell");
    score.notes.back().key = 127;
    EXPECT_NO_THROW(xml_of(score));
}

TEST(MusicXml, IsTheSameInAnyLocale) {
    TestScore score = random_score(3, true);
    score.head.tempo = 1234.5;
    const std::string before = xml_of(score);
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
        std::setlocale(LC_ALL, name);
        EXPECT_EQ(xml_of(score), before);
    }
    std::setlocale(LC_ALL, "C");
    EXPECT_FALSE(has(before, "1,234"));
}

}  // namespace sikku::musicxml_test
