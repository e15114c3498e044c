// tests/music/expression_test.cpp: curves of velocity, tempo, pan, controllers and pitch, as a reader of MIDI sees
// them.
#include "music/score/curves.h"
#include "music/scores.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace sikku::expression_test {

/// Degrees 0, 1, 2, 1 in notes of 1, 1, 1 and 2 steps; x goes from 0 to 5.
const std::string steps = "heading: 0\nturn: left\nangle factor: 4\naxiom: F+F-F+F-F-F+FF\n";
/// Eight notes in sub-curves of two, four and eight.
const std::string nested =
    "mapping: symbols\nnote A: degree 0 1/4\nderivation length: 3\naxiom: X\nX --> YY\nY --> ZZ\nZ --> AA\n";

MidiFile midi_of(const std::string& text, const OptionValues& values = {}) {
    const std::string bytes = play(parse("e.lsys", text), "mid", values);
    EXPECT_EQ(midi_faults(bytes), "");
    return read_midi(bytes);
}

struct Point {
    std::int64_t tick;
    double value;
    bool operator==(const Point&) const = default;
};

std::vector<Point> controller(const MidiFile& file, int number) {
    std::vector<Point> points;
    for (const MidiEvent& event : file.events) {
        if ((event.status & 0xF0) == 0xB0 && event.data[0] == number) {
            points.push_back({event.tick, static_cast<double>(event.data[1])});
        }
    }
    return points;
}

/// Quarters a minute.
std::vector<Point> tempos(const MidiFile& file) {
    std::vector<Point> points;
    for (const MidiEvent& event : file.events) {
        if (event.status != 0xFF || event.type != 0x51) continue;
        double micro = 0;
        for (const char byte : event.data) micro = micro * 256 + static_cast<unsigned char>(byte);
        points.push_back({event.tick, 60e6 / micro});
    }
    return points;
}

/// Semitones, in a bend range of 12.
std::vector<Point> bends(const MidiFile& file) {
    std::vector<Point> points;
    for (const MidiEvent& event : file.events) {
        if ((event.status & 0xF0) != 0xE0) continue;
        const int value = static_cast<unsigned char>(event.data[0]) + 128 * static_cast<unsigned char>(event.data[1]);
        points.push_back({event.tick, 12.0 * (value - 8192) / 8192});
    }
    return points;
}

std::string error_of(const std::string& text) {
    try {
        play(parse("e.lsys", steps + text), "mid");
    } catch (const PatternError& error) {
        return error.diagnostics().front().message;
    } catch (const std::exception& error) {
        return error.what();
    }
    return "none";
}

TEST(Expression, VelocityFollowsTheCurve) {
    const auto velocities = [](const std::string& text) {
        std::vector<int> all;
        for (const MidiNote& note : midi_of(text).notes) all.push_back(note.velocity);
        return all;
    };
    EXPECT_EQ(velocities(steps + "velocity: by y 40-80\n"), (std::vector<int>{40, 60, 80, 60}));
    EXPECT_EQ(velocities(steps + "velocity: by y 80-40\n"), (std::vector<int>{80, 60, 40, 60}));
    EXPECT_EQ(velocities(steps + "velocity: by length 50-100\n"), (std::vector<int>{50, 50, 50, 100}));
    // Middles of the runs: 0.5, 1.5, 2.5 and 4 of 5 steps.
    EXPECT_EQ(velocities(steps + "velocity: by x 1-101\n"), (std::vector<int>{11, 31, 51, 81}));
}

/// Velocities, pan and controllers are given as the notes pass; with a tempo they are collected: by two ways the
/// same.
TEST(Expression, CurvesAreTheSameInStreams) {
    const std::string curve =
        "angle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 4\nunit: 1/16\n";
    for (const char* source : {"x", "y", "depth", "turn 20-90", "length 20-90"}) {
        for (const char* more : {"", "harmony: triads\n", "vertical: voice\n", "vertical: glissando\n",
                                 "harmony: bass 2\n", "retrograde: yes\n", "canon: 2 -12\n"}) {
            const std::string range = std::string(source).find(' ') == std::string::npos ? " 20-90" : "";
            const std::string text = curve + more + "velocity: by " + source + range + "\n";
            const auto events = [](const MidiFile& file) {
                std::vector<std::tuple<std::int64_t, int, std::string>> all;
                for (const MidiEvent& event : file.events) {
                    if (event.status < 0xF0) all.emplace_back(event.tick, event.status, event.data);
                }
                return all;
            };
            const OptionValues options = {{"humanise", "0.4"}};
            for (const std::string& other :
                 {std::string(), "pan: by x\n" + fmt::format("controller: 74 by {}\n", source)}) {
                const auto streamed = events(midi_of(text + other, options));
                EXPECT_EQ(streamed, events(midi_of(text + other + "tempo: 96 by y 80-112\n", options))) << text;
                EXPECT_GT(streamed.size(), 200u);
            }
        }
    }
}

TEST(Expression, LevelsAreOrdersOfSubCurves) {
    std::vector<int> velocities;
    for (const MidiNote& note : midi_of(nested + "velocity: by level 10-100\n").notes) {
        velocities.push_back(note.velocity);
    }
    EXPECT_EQ(velocities, (std::vector<int>{100, 10, 40, 10, 70, 10, 40, 10}));
}

/// Levels in a piece from the middle equal those of the whole, with and without phrases, in all mappings.
TEST(Expression, LevelsOfPiecesAreThoseOfTheWhole) {
    const std::string curve =
        "angle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 6\nunit: 1/16\n";
    for (const char* more : {"", "phrases: 2\n", "vertical: voice\n", "vertical: glissando\n", "vertical: extend\n",
                             "mapping: counterpoint\n", "mapping: symbols\n"}) {
        const std::vector<Document> documents = {parse("e.lsys", curve + more + "velocity: by level 10-100\n")};
        const NoteList whole = list_notes(documents, {}, {});
        const NoteList piece = list_notes(documents, {{"from-bar", "21"}, {"bars", "16"}}, {});
        const std::int64_t from = 20 * whole.meter.bar();
        std::map<std::pair<std::int64_t, int>, int> levels;
        for (const Note& note : whole.notes) levels[{note.onset - from, note.voice}] = note.level;
        int highest = 0;
        for (const Note& note : piece.notes) {
            if (note.onset > 0) {
                EXPECT_EQ(note.level, (levels[{note.onset, note.voice}])) << more << note.onset;
            }
            highest = std::max<int>(highest, note.level);
        }
        EXPECT_GE(highest, 3) << more;
        EXPECT_EQ(whole.notes.front().level, 6) << more;
    }
}

TEST(Expression, DepthCountsBrackets) {
    std::vector<int> velocities;
    const MidiFile file = midi_of(
        "mapping: symbols\nbrackets: sequence\nnote A:\naxiom: A[A[A]A]A\n"
        "velocity: by depth 100-60\n");
    for (const MidiNote& note : file.notes) velocities.push_back(note.velocity);
    EXPECT_EQ(velocities, (std::vector<int>{100, 80, 60, 80, 100}));
}

TEST(Expression, PanAndControllerAreRampsAlongTheRun) {
    const MidiFile file = midi_of(steps + "pan: by x 0-100\ncontroller: 74 by y 0-100\n");
    const std::vector<Point> pan = controller(file, 10);
    ASSERT_FALSE(pan.empty());
    // A note of a step is 240 ticks and a fifth of the width: 20 in 8 points, 2.5 apart.
    EXPECT_EQ(pan[0], (Point{0, 0}));
    EXPECT_EQ(pan[1], (Point{30, 3}));
    EXPECT_EQ(pan[2], (Point{60, 5}));
    for (const Point& point : pan) {
        EXPECT_NEAR(point.value, 100 * static_cast<double>(point.tick) / 1200, 0.501) << point.tick;
    }
    EXPECT_EQ(controller(file, 74), (std::vector<Point>{{0, 0}, {240, 50}, {480, 100}, {720, 50}}));
    EXPECT_EQ(file.notes.size(), 4u);
    EXPECT_TRUE(controller(midi_of(steps), 10).empty());
}

TEST(Expression, TempoIsAMapOfBeats) {
    // All at one height: the middle of the range.
    const std::string flat = "heading: 0\naxiom: FfFfFf\n";
    for (const Point& point : tempos(midi_of(flat + "tempo: 100 by y 80-120\n"))) EXPECT_EQ(point.value, 100);
    std::string rising = "heading: 0\nturn: left\nunit: 1/4\naxiom: ";
    for (int i = 0; i < 12; ++i) rising += "F+F-";
    const MidiFile file = midi_of(rising + "\ntempo: 100 by y 80-125\n");
    const std::vector<Point> map = tempos(file);
    ASSERT_EQ(map.size(), 12u);  // one for each quarter, and no other at the beginning
    for (std::size_t i = 1; i < map.size(); ++i) {
        EXPECT_GT(map[i].value, map[i - 1].value);
        EXPECT_EQ(map[i].tick - map[i - 1].tick, 480);
    }
    // In the midst smoothing changes nothing of a straight line: the seventh of twelve heights.
    EXPECT_NEAR(map[6].value, 80 + 45.0 * 6 / 11, 0.01);
}

TEST(Expression, PagesHaveTheTemposOfMidi) {
    const std::string text = steps + "vertical: extend\nunit: 1/2\nending: ritardando\ntempo: 90 by y 70-110\n";
    const std::vector<Point> map = tempos(midi_of(text));
    const std::string page = play(parse("e.lsys", text), "html");
    const std::size_t begin = page.find("id=\"score\">") + 11;
    const auto data = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    ASSERT_EQ(data["tempos"].size(), map.size());
    ASSERT_GT(map.size(), 9u);
    for (std::size_t i = 0; i < map.size(); ++i) {
        EXPECT_EQ(data["tempos"][i][0].get<std::int64_t>(), map[i].tick);
        EXPECT_NEAR(data["tempos"][i][1].get<double>() * 90, map[i].value, 0.01);
    }
    EXPECT_LT(map.back().value, 0.61 * 110);
}

TEST(Expression, SecondsAreThoseOfTheMap) {
    const std::vector<TempoPoint> map = {{480, 0.5}, {960, 2}};
    EXPECT_DOUBLE_EQ(seconds_at(240, 120, map), 0.25);
    EXPECT_DOUBLE_EQ(seconds_at(960, 120, map), 0.5 + 1);
    EXPECT_DOUBLE_EQ(seconds_at(1920, 120, map), 0.5 + 1 + 0.5);
    ScoreHead head;
    head.ritardando = 3840;
    const std::vector<TempoPoint> falls = tempo_map(head, {}, 9600);
    ASSERT_EQ(falls.size(), 8u);
    EXPECT_EQ(falls.front().tick, 5760);
    EXPECT_DOUBLE_EQ(falls.back().factor, 0.6);
    // The number of points does not depend on the end, which a stream of notes does not know.
    Curves curves;
    curves.tempo = {{0, 1.1}, {480, 0.9}, {9000, 1}};
    EXPECT_EQ(tempo_map(head, curves, 0).size(), tempo_map(head, curves, 9600).size());
}

TEST(Expression, KampitaSwingsToTheDegreeAbove) {
    // A note of two seconds on degree 1, D; E is a tone above.
    const std::string text = "mapping: symbols\ntempo: 60\nnote A: degree 1 1/2\nnote B: degree 0 1/2\naxiom: AB\n";
    const std::vector<Point> points = bends(midi_of(text + "gamaka: kampita 1\n"));
    ASSERT_FALSE(points.empty());
    int tops = 0;
    double highest = 0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        highest = std::max(highest, points[i].value);
        if (points[i].value > points[i - 1].value && points[i].value >= points[i + 1].value) ++tops;
        EXPECT_LE(points[i].tick, 960);
        EXPECT_GE(points[i].value, 0);
    }
    EXPECT_EQ(tops, 10);  // five a second
    EXPECT_NEAR(highest, 2, 0.15);
    EXPECT_EQ(points.back(), (Point{960, 0}));
    EXPECT_TRUE(bends(midi_of(text)).empty());
}

TEST(Expression, SlidesMeetTheirNeighbours) {
    const std::string text = "mapping: symbols\ntempo: 60\nnote A: C4 1/2\nnote B: G4 1/2\naxiom: AB\n";
    const std::vector<Point> into = bends(midi_of(text + "gamaka: jaru 4\n"));
    ASSERT_GT(into.size(), 4u);
    EXPECT_EQ(into.front().tick, 960);
    EXPECT_NEAR(into.front().value, -7, 0.01);
    EXPECT_EQ(into.back(), (Point{960 + 120, 0}));  // a quarter of a second
    const std::vector<Point> out = bends(midi_of(text + "gamaka: meend all\n"));
    EXPECT_GT(out.front().tick, 960 - 120);
    EXPECT_TRUE(
        std::is_sorted(out.begin(), out.end() - 1, [](const Point& a, const Point& b) { return a.value < b.value; }));
    EXPECT_NEAR((out.end() - 2)->value, 7, 0.4);
    EXPECT_EQ(out.back(), (Point{960, 0}));
    // In print a line leads from note to note, from the last of those that are tied.
    EXPECT_TRUE(has(play(parse("e.lsys", text + "gamaka: meend all\n"), "ly"), "c'2\\glissando\\mf g'2"));
    pugi::xml_document xml;
    const std::string tied = "mapping: symbols\nnote A: C4 3/4\nnote B: G4 3/4\naxiom: AB\ngamaka: jaru all\n";
    ASSERT_TRUE(xml.load_string(play(parse("e.lsys", tied), "musicxml").c_str()));
    // There is room for the line.
    EXPECT_TRUE(has(play(parse("e.lsys", text + "gamaka: meend all\n"), "ly"), "Glissando.minimum-length"));
    EXPECT_FALSE(has(play(parse("e.lsys", text), "ly"), "Glissando"));
    std::vector<std::string> slides;
    for (const auto& note : xml.select_nodes("//note[pitch]")) {
        const pugi::xml_node slide = note.node().child("notations").child("slide");
        slides.push_back(std::string(note.node().child("pitch").child_value("step")) +
                         slide.attribute("type").value());
    }
    EXPECT_EQ(slides, (std::vector<std::string>{"Cstart", "Gstop", "G"}));
    EXPECT_FALSE(has(play(parse("e.lsys", text + "gamaka: kampita all\n"), "ly"), "gliss"));
}

TEST(Expression, GamakasDependOnTheApproach) {
    // C E D: the second note rises, the third falls, the first has none before it.
    const std::string text =
        "mapping: symbols\ntempo: 60\nnote A: degree 0 1/2\nnote B: degree 2 1/2\nnote C: degree 1 1/2\naxiom: ABC\n";
    const auto bent_notes = [&](const std::string& gamaka) {
        std::set<std::int64_t> notes;
        for (const Point& point : bends(midi_of(text + "gamaka: " + gamaka + "\n"))) {
            if (point.value != 0) notes.insert(point.tick / 960);
        }
        return notes;
    };
    using Numbers = std::set<std::int64_t>;
    EXPECT_EQ(bent_notes("kampita all"), (Numbers{0, 1, 2}));
    EXPECT_EQ(bent_notes("kampita all rising"), Numbers{1});
    EXPECT_EQ(bent_notes("kampita all falling"), Numbers{2});
    EXPECT_EQ(bent_notes("jaru 1 falling, kampita 2 rising"), (Numbers{1, 2}));
    EXPECT_EQ(bent_notes("jaru 1 rising"), Numbers());
    // Only the first rule that applies is used.
    EXPECT_LT(bends(midi_of(text + "gamaka: jaru all rising, kampita all\n")).front().tick, 960);
}

TEST(Expression, GamakasArePrintedAsGraceNotes) {
    // C E D, and F sharp in between, whose neighbours need signs.
    const std::string text =
        "mapping: symbols\ntempo: 60\nnote A: degree 0 1/2\nnote B: degree 2 1/2\nnote C: degree 1 1/2\n"
        "scale: lydian\nnote G: degree 3 1/2\nnote H: degree 4 1/2\naxiom: ABCHG\n";
    const auto printed = [&](const std::string& gamaka, const std::string& format, bool has_graces = true) {
        return play(parse("e.lsys", text + "gamaka: " + gamaka + "\n"), format,
                    has_graces ? OptionValues{{"grace-notes", "true"}} : OptionValues());
    };
    const std::string ly = printed("jaru 1, kampita 2", "ly");
    EXPECT_TRUE(has(ly, "c'2\\mf \\acciaccatura fis'8 e'2")) << ly;
    EXPECT_TRUE(has(ly, "\\acciaccatura e'8 d'2 ")) << ly;
    EXPECT_FALSE(has(ly, "\\glissando")) << ly;
    const std::string lines = printed("jaru 1, kampita 2", "ly", false);
    EXPECT_FALSE(has(lines, "\\acciaccatura"));
    EXPECT_TRUE(has(lines, "e'2\\glissando | % 1")) << lines;
    EXPECT_TRUE(has(printed("meend 0, kampita 2", "ly"), "c'2\\glissando\\mf \\acciaccatura fis'8 e'2"));
    EXPECT_TRUE(has(printed("jaru 1, kampita 2", "abc"), "{/F}E4 | {/E}D4")) << printed("jaru 1, kampita 2", "abc");
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(printed("jaru 1, kampita 2", "musicxml").c_str()));
    std::string notes;
    for (const auto& found : xml.select_nodes("//note[pitch]")) {
        const pugi::xml_node note = found.node();
        notes += fmt::format("{}{} ", note.child("pitch").child_value("step"), note.child("grace") ? "/" : "");
        EXPECT_EQ(note.child("duration").empty(), !note.child("grace").empty());
    }
    EXPECT_EQ(notes, "C F/ E E/ D G F ");
    // Other staves leave room, so that bar lines and clefs stay in line.
    const std::string staves =
        "mapping: symbols\ntempo: 60\ninstrument: violin\nnote A: degree 0 1/2\nnote B: degree 4 1/2\n"
        "axiom: [AABA][BBAB]\ngamaka: kampita 0\n";
    const std::string both = play(parse("e.lsys", staves), "ly", {{"grace-notes", "true"}});
    EXPECT_EQ(count_of(both, "\\acciaccatura"), 4u) << both;
    EXPECT_EQ(count_of(both, "\\grace s8 g'2"), 4u) << both;
    // The degree above may be more than a tone away.
    const std::string wide =
        "mapping: symbols\ntempo: 60\naxiom: A\nnote A: degree 2 1/2\nscale: major pentatonic\n"
        "gamaka: kampita all\n";
    EXPECT_TRUE(has(play(parse("e.lsys", wide), "ly", {{"grace-notes", "true"}}), "\\acciaccatura g'8 e'2"));
    // An accidental of a grace note applies to the end of the bar.
    const std::string signs =
        "mapping: symbols\nnote A: degree 2 1/4\nnote B: degree 3 1/4\naxiom: AB\nscale: lydian\n"
        "tonic: D4\ngamaka: kampita 2\ntempo: 60\n";
    ASSERT_TRUE(xml.load_string(play(parse("e.lsys", signs), "musicxml", {{"grace-notes", "true"}}).c_str()));
    EXPECT_EQ(xml.select_nodes("//note[grace]").size(), 1u);
    EXPECT_LE(xml.select_nodes("//accidental").size(), 1u);
}

TEST(Expression, AllFormsOfMidiHaveTheCurves) {
    const std::string text = steps + "scale: 31-edo\npan: by x 0-100\n";
    const std::vector<Point> pan = controller(midi_of(text), 10);
    EXPECT_EQ(controller(midi_of(text, {{"midi-format", "0"}}), 10), pan);
    EXPECT_EQ(controller(midi_of(text, {{"tuning", "mts"}}), 10), pan);
    std::vector<double> keys;
    for (const MidiFile& file : {midi_of(text), midi_of(text, {{"tuning", "mts"}})}) {
        for (const MidiNote& note : file.notes) keys.push_back(note.key + note.bend);
    }
    ASSERT_EQ(keys.size(), 8u);
    const std::vector<double> degrees = {0, 1, 2, 1};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(keys[i], 60 + degrees[i] * 12 / 31, 0.01);
        EXPECT_NEAR(keys[i], keys[i + 4], 0.01);
    }
}

/// Key and controllers that a synthesizer hears at a tick, by track.
struct Heard {
    int track = 0;
    double key = 0;
    std::map<int, int> controllers;
};

/// What sounds at each of the ticks.
std::vector<std::vector<Heard>> heard(const MidiFile& file, const std::vector<std::int64_t>& ticks) {
    const auto rank = [](const MidiEvent& event) {
        const int kind = event.status & 0xF0;
        return kind == 0xB0 ? 1 : kind == 0x80 ? 2 : kind == 0xE0 ? 3 : kind == 0x90 ? 4 : 0;
    };
    std::vector<const MidiEvent*> events;
    for (const MidiEvent& event : file.events) events.push_back(&event);
    std::stable_sort(events.begin(), events.end(), [&](const MidiEvent* a, const MidiEvent* b) {
        return std::tuple(a->tick, rank(*a)) < std::tuple(b->tick, rank(*b));
    });
    std::array<double, 16> ranges{};
    std::array<double, 16> bent{};
    std::array<std::map<int, int>, 16> controllers;
    std::map<std::pair<int, int>, int> sounding;  // tracks by channel and key
    std::vector<std::vector<Heard>> result;
    auto next = events.begin();
    for (const std::int64_t tick : ticks) {
        for (; next != events.end() && (*next)->tick <= tick; ++next) {
            const MidiEvent& event = **next;
            if (event.status >= 0xF0 || event.status < 0x80) continue;
            const auto at = static_cast<std::size_t>(event.status & 0x0F);
            const int first = static_cast<unsigned char>(event.data[0]);
            const int second = event.data.size() > 1 ? static_cast<unsigned char>(event.data[1]) : 0;
            const std::pair key(static_cast<int>(at), first);
            if (rank(event) == 1 && first == 6) ranges[at] = second;
            if (rank(event) == 1) controllers[at][first] = second;
            if (rank(event) == 2) sounding.erase(key);
            if (rank(event) == 3) bent[at] = (first + 128 * second - 8192) / 8192.0;
            if (rank(event) == 4) sounding[key] = event.track;
        }
        std::vector<Heard>& now = result.emplace_back();
        for (const auto& [key, track] : sounding) {
            const auto at = static_cast<std::size_t>(key.first);
            now.push_back({track, key.second + bent[at] * ranges[at], controllers[at]});
        }
        std::sort(now.begin(), now.end(), [](const Heard& a, const Heard& b) {
            return std::tuple(a.track, a.key) < std::tuple(b.track, b.key);
        });
    }
    return result;
}

/// With MPE the curves belong to the channels of the notes: at any time the same is heard.
TEST(Expression, MpeSoundsLikePitchBends) {
    const std::string text = R"(title: two
axiom: X
derivation length: 3
X --> -YF+XFX+FY-
Y --> +XF-YFY-FX+
scale: kalyani
vertical: extend
harmony: drone
gamaka: kampita 2 6, meend 1, jaru 4
pan: by x
controller: 74 by y 10-120
)";
    const MidiFile bend = midi_of(text);
    const MidiFile mpe = midi_of(text, {{"tuning", "mpe"}});
    std::vector<std::int64_t> ticks;
    for (std::int64_t tick = 3; tick < bend.ends.front(); tick += 29) ticks.push_back(tick);
    const auto expected = heard(bend, ticks);
    const auto found = heard(mpe, ticks);
    std::size_t bent = 0;
    std::set<int> pans;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        ASSERT_EQ(found[i].size(), expected[i].size()) << ticks[i];
        for (std::size_t j = 0; j < found[i].size(); ++j) {
            const Heard& one = found[i][j];
            const Heard& other = expected[i][j];
            EXPECT_EQ(one.track, other.track) << ticks[i];
            EXPECT_NEAR(one.key, other.key, 0.01) << ticks[i];
            // What the drone has not set is the middle.
            const auto value = [](const Heard& note, int number) {
                const auto set = note.controllers.find(number);
                return set == note.controllers.end() ? 64 : set->second;
            };
            EXPECT_EQ(value(one, 10), value(other, 10)) << ticks[i];
            EXPECT_EQ(value(one, 74), value(other, 74)) << ticks[i];
            pans.insert(value(one, 10));
            bent += std::fabs(one.key - std::round(one.key)) > 0.05 ? 1 : 0;
        }
    }
    EXPECT_GT(bent, 20u);
    EXPECT_GT(pans.size(), 50u);
    EXPECT_EQ(error_of("gamaka: kampita all\n"), "none");
    EXPECT_THROW(play(parse("e.lsys", text), "mid", {{"tuning", "mts"}}), SettingError);
}

TEST(Expression, ErrorsSayWhatIsExpected) {
    EXPECT_EQ(error_of("velocity: by y 0-300\n"),
              "expected velocities from 1 to 127, such as by y 50-110; by x, y, depth, turn, length or level");
    EXPECT_EQ(error_of("velocity: by z 10-20\n"),
              "expected velocities from 1 to 127, such as by y 50-110; by x, y, depth, turn, length or level");
    EXPECT_EQ(
        error_of("tempo: 100 by y 2-90\n"),
        "expected quarters a minute from 4 to 1000, such as 96 by y 84-108; by x, y, depth, turn, length or level");
    EXPECT_EQ(
        error_of("pan: left\n"),
        "expected none, or places from 0, left, to 127, right, such as by x 14-114; by x, y, depth, turn, length "
        "or level");
    EXPECT_EQ(error_of("controller: 101 by y\n"),
              "controller 101 has a fixed use; expected another such as 1 (modulation), 11 (expression) or 74 "
              "(brightness)");
    EXPECT_EQ(error_of("gamaka: kampita 7\n"), "degree 7 is not in the scale; expected 0 to 6");
    EXPECT_EQ(
        error_of("gamaka: shake 2\n"),
        "expected none, or kampita, jaru or meend with degrees of the scale, 0 for the tonic, or all, optionally "
        "followed by rising or falling, such as kampita 2 6, jaru 1 falling, meend all");
    for (const char* bad : {"kampita rising", "rising", "kampita falling 2", "kampita all rising falling"}) {
        EXPECT_NE(error_of(std::string("gamaka: ") + bad + "\n"), "none") << bad;
    }
    EXPECT_THROW(play(parse("e.lsys", steps + "gamaka: meend all\n"), "mid", {{"tuning", "mts"}}), SettingError);
}

}  // namespace sikku::expression_test
