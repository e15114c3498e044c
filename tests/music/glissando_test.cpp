// tests/music/glissando_test.cpp: `vertical: glissando` as notes that slide, as readers of MIDI, XML and text see
// them.
#include "music/note_stream.h"
#include "music/score/glides.h"
#include "music/scores.h"
#include "tests/midi_tools.h"
#include "tests/works.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace sikku::glissando_test {

constexpr std::int64_t quarter = ticks_per_quarter;
const std::string head =
    "heading: 0\nturn: left\nangle factor: 4\nunit: 1/4\ntempo: 60\nvertical: glissando\naxiom: ";
/// A quarter on C that slides to F in three, two quarters on F that slide to E in one, a quarter on E.
const std::string steps = head + "F+FFF-FF-F+F\n";
const std::string hilbert =
    "angle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 5\nunit: 1/16\n"
    "vertical: glissando\n";

MidiFile midi_of(const std::string& text, const OptionValues& values = {}) {
    const std::string bytes = play(parse("g.lsys", text), "mid", values);
    EXPECT_EQ(midi_faults(bytes), "");
    return read_midi(bytes);
}

/// What sounds on a channel from a tick on: a pitch, or nothing (0).
using Sounding = std::map<std::int64_t, double>;

/// Follows note-ons, note-offs and bends of a channel. @param range  semitones of a full bend
Sounding sounding(const MidiFile& file, int channel, double range) {
    Sounding result;
    int key = -1;
    double bend = 0;
    for (const MidiEvent& event : file.events) {
        if (event.status >= 0xF0 || (event.status & 0x0F) != channel) continue;
        const int first = static_cast<unsigned char>(event.data[0]);
        if ((event.status & 0xF0) == 0x90) key = first;
        if ((event.status & 0xF0) == 0x80 && key == first) key = -1;
        if ((event.status & 0xF0) == 0xE0) {
            bend = range * (first + 128 * static_cast<unsigned char>(event.data[1]) - 8192) / 8192;
        }
        result[event.tick] = key < 0 ? 0 : key + bend;
    }
    return result;
}

double at(const Sounding& sounding, std::int64_t tick) {
    const auto after = sounding.upper_bound(tick);
    return after == sounding.begin() ? 0 : std::prev(after)->second;
}

std::vector<std::string> struck(const MidiFile& file) {
    std::vector<std::string> notes;
    for (const MidiNote& note : file.notes) {
        notes.push_back(fmt::format("{}:{}+{}", note.key, note.onset / quarter, note.duration / quarter));
    }
    return notes;
}

using Strings = std::vector<std::string>;

TEST(Glissando, OneNoteBendsToTheNext) {
    const MidiFile file = midi_of(steps);
    EXPECT_EQ(struck(file), (Strings{"60:0+4", "65:4+3", "64:7+1"}));
    std::vector<int> range;
    for (const MidiEvent& event : file.events) {
        if (event.status == 0xB0 && event.data[0] == 6) range.push_back(event.data[1]);
    }
    EXPECT_EQ(range, std::vector<int>{24});
    const Sounding pitch = sounding(file, 0, 24);
    for (std::int64_t tick = 0; tick < quarter; ++tick) EXPECT_EQ(at(pitch, tick), 60);
    for (std::int64_t tick = quarter; tick < 4 * quarter; ++tick) {
        // Steps of 3 cents, the last of which reaches F.
        const double line = 60 + 5.0 * static_cast<double>(tick - quarter) / (3 * quarter);
        ASSERT_NEAR(at(pitch, tick), line + 0.015, 0.02) << tick;
    }
    EXPECT_NEAR(at(pitch, 4 * quarter - 1), 65, 0.003);
    EXPECT_EQ(at(pitch, 4 * quarter), 65);
    EXPECT_NEAR(at(pitch, 7 * quarter - 1), 64, 0.003);
    EXPECT_EQ(at(pitch, 7 * quarter), 64);
    for (const double key : {60.0, 65.0, 64.0}) {
        const MidiNote& note = file.notes[key == 60 ? 0 : key == 65 ? 1 : 2];
        EXPECT_EQ(note.bend, 0) << key;
    }
    EXPECT_EQ(midi_of(steps, {{"midi-format", "0"}}).notes.size(), 3u);
}

TEST(Glissando, StepsAreNarrowOrFourMillisecondsApart) {
    Note note = midi_note(100, 960, 60);
    note.glide = {480, -12, 0};
    const std::vector<GlidePoint> points = glide_points(note, 120);  // half a second
    ASSERT_EQ(points.size(), 120u);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(points[i].tick, 580 + 4 * static_cast<std::int64_t>(i));
        EXPECT_NEAR(points[i].key, 60 - 0.1 * static_cast<double>(i + 1), 1e-9);
    }
    note.glide = {480, 0.3F, 0};
    EXPECT_EQ(glide_points(note, 120).size(), 11u);
    note.glide = {1, 12, 0};
    EXPECT_EQ(glide_points(note, 1000), (std::vector<GlidePoint>{{1059, 72}}));
    note.glide = {};
    EXPECT_TRUE(glide_points(note, 120).empty());
}

TEST(Glissando, WideIntervalsAreStruckAnewBeyondTheBendRange) {
    const std::string three_octaves = head + "F+" + std::string(21, 'F') + "-F\n";
    const MidiFile bent = midi_of(three_octaves);
    ASSERT_EQ(bent.notes.size(), 3u);
    EXPECT_EQ(bent.notes[0].key, 60);
    EXPECT_EQ(bent.notes[1].key, 84);
    EXPECT_EQ(bent.notes[2].key, 96);
    EXPECT_EQ(bent.notes[0].onset + bent.notes[0].duration, bent.notes[1].onset);
    EXPECT_EQ(bent.notes[1].velocity, bent.notes[0].velocity);
    const Sounding pitch = sounding(bent, 0, 24);
    for (std::int64_t tick = quarter; tick < 22 * quarter; tick += 10) {
        const double line = 60 + 36.0 * static_cast<double>(tick - quarter) / (21 * quarter);
        ASSERT_NEAR(at(pitch, tick), line, 0.035) << tick;
    }
    const MidiFile mpe = midi_of(three_octaves, {{"tuning", "mpe"}});
    ASSERT_EQ(mpe.notes.size(), 2u);
    EXPECT_NE(mpe.notes[0].channel, mpe.notes[1].channel);
    EXPECT_NEAR(at(sounding(mpe, mpe.notes[0].channel, 48), 22 * quarter - 1), 96, 0.006);
}

TEST(Glissando, RunsThatNoNoteLeadsIntoAreNotes) {
    // Up to F, back to D, and on to a note on D; then down to C and no note there.
    const MidiFile file = midi_of(head + "+FFF--FF+F-F\n");
    EXPECT_EQ(struck(file), (Strings{"60:0+3", "65:3+2", "62:5+2"}));
    const Sounding pitch = sounding(file, 0, 24);
    EXPECT_NEAR(at(pitch, 3 * quarter - 1), 65, 0.003);
    EXPECT_NEAR(at(pitch, 5 * quarter - 1), 62, 0.003);
    EXPECT_EQ(at(pitch, 6 * quarter - 1), 62);
    EXPECT_NEAR(at(pitch, 7 * quarter - 1), 60, 0.003);
    // Steps on their own are one slide, too.
    EXPECT_EQ(struck(midi_of(steps + "runs: each step\n")), (Strings{"60:0+4", "65:4+1", "65:5+2", "64:7+1"}));
}

TEST(Glissando, EveryPieceSoundsAsInTheWhole) {
    const Sounding all = sounding(midi_of(hilbert), 0, 24);
    for (int bar = 1; bar < 30; bar += 4) {
        const MidiFile piece = midi_of(hilbert, {{"from-bar", std::to_string(bar)}, {"bars", "2"}});
        const Sounding part = sounding(piece, 0, 24);
        const std::int64_t from = (bar - 1) * 4 * quarter;
        for (std::int64_t tick = 0; tick < 8 * quarter; tick += 7) {
            ASSERT_NEAR(at(part, tick), at(all, from + tick), 0.1) << bar << " " << tick;
        }
    }
    // From the midst of a slide: half of the way from C to F.
    const MidiFile cut = midi_of(head + "FF+" + std::string(4, 'F') + "-F\n", {{"from-bar", "2"}});
    ASSERT_EQ(cut.notes.size(), 2u);
    EXPECT_EQ(cut.notes[0].duration, 2 * quarter);
    EXPECT_NEAR(cut.notes[0].key + cut.notes[0].bend, 60 + 3.5, 0.01);
}

TEST(Glissando, StreamsSlideAsFiles) {
    for (const std::string& more : {std::string(), std::string("unit: 3/4\n"), std::string("retrograde: yes\n")}) {
        const std::string text =
            (more.starts_with("unit") ? hilbert.substr(0, hilbert.find("unit")) + "vertical: glissando\n" : hilbert) +
            more;
        const Document document = parse("g.lsys", text);
        const Sounding file = sounding(midi_of(text), 0, 24);
        const auto stream = stream_notes(std::span(&document, 1), {});
        Sounding heard;
        std::size_t points = 0;
        for (bool is_last = false; !is_last;) {
            const NoteWindow window = stream->next();
            for (const NoteWindow::Pitch& one : window.pitches) {
                heard[one.tick] = one.key;
                ++points;
            }
            for (const Note& note : window.notes) heard[note.onset] = note.key;
            is_last = window.is_last;
        }
        EXPECT_GT(points, 1000u);
        std::size_t apart = 0;
        for (const auto& [tick, key] : heard) apart += std::fabs(at(file, tick) - key) > 0.1 ? 1 : 0;
        EXPECT_EQ(apart, 0u) << more;
    }
}

TEST(Glissando, SlidesToNotesThatMoved) {
    // The cadence leads the last note to the tonic; the note before it slides there, and the last one is held.
    const MidiFile file = midi_of(head + "F+FF-F+F-F+FF\ncadence: tonic\n");
    const Sounding pitch = sounding(file, 0, 24);
    for (std::size_t i = 0; i + 1 < file.notes.size(); ++i) {
        const MidiNote& note = file.notes[i];
        EXPECT_NEAR(at(pitch, note.onset + note.duration - 1), file.notes[i + 1].key, 0.003);
    }
    EXPECT_EQ(file.notes.back().key % 12, 0);
    EXPECT_EQ(at(pitch, file.notes.back().onset + file.notes.back().duration - 1), file.notes.back().key);
    // Reversed, the later note slides to the earlier one.
    const MidiFile back = midi_of(steps + "retrograde: yes\n");
    EXPECT_EQ(struck(back), (Strings{"64:0+2", "65:2+5", "60:7+1"}));
    EXPECT_NEAR(at(sounding(back, 0, 24), 7 * quarter - 1), 60, 0.003);
    // What swings, is late or slower still slides to the end.
    for (const OptionValues& values : std::vector<OptionValues>{{{"swing", "67"}},
                                                                {{"articulation", "detached"}},
                                                                {{"humanise", "1"}},
                                                                {{"augmentation", "3/2"}},
                                                                {{"speed", "3:2"}}}) {
        const MidiFile other = midi_of(steps, values);
        ASSERT_EQ(other.notes.size(), 3u);
        const std::int64_t end = other.notes[0].onset + other.notes[0].duration;
        EXPECT_NEAR(at(sounding(other, 0, 24), end - 1), 65, 0.003) << values.front().name;
    }
}

TEST(Glissando, VoicesSlideOnTheirOwnChannels) {
    const MidiFile file = midi_of(head + "F[+FF-F]-FF+F\n");
    std::map<int, std::size_t> bends;
    for (const MidiEvent& event : file.events) {
        if ((event.status & 0xF0) == 0xE0) ++bends[event.status & 0x0F];
    }
    EXPECT_EQ(bends.size(), 2u);
    EXPECT_GT(bends[0], 50u);
    EXPECT_GT(bends[1], 50u);
}

TEST(Glissando, PrintHasLines) {
    const std::string lily = play(parse("g.lsys", steps), "ly");
    EXPECT_TRUE(has(lily, "c'1\\glissando"));
    EXPECT_FALSE(has(lily, "bendAfter"));
    const std::string leaving = head + "F+FF\n";
    EXPECT_TRUE(has(play(parse("g.lsys", leaving), "ly"), "\\bendAfter #+4"));
    EXPECT_TRUE(has(play(parse("g.lsys", head + "F-FF\n"), "ly"), "\\bendAfter #-4"));
    pugi::xml_document xml;
    ASSERT_TRUE(xml.load_string(play(parse("g.lsys", steps), "musicxml").c_str()));
    Strings slides;
    for (const auto& slide : xml.select_nodes("//slide")) slides.push_back(slide.node().attribute("type").value());
    EXPECT_EQ(slides, (Strings{"start", "stop", "start", "stop"}));
    ASSERT_TRUE(xml.load_string(play(parse("g.lsys", leaving), "musicxml").c_str()));
    EXPECT_TRUE(xml.select_nodes("//slide").empty());
    EXPECT_EQ(xml.select_nodes("//articulations/doit").size(), 1u);
    const std::string abc = play(parse("g.lsys", steps), "abc");
    EXPECT_TRUE(has(abc, "!~(!C8"));
    EXPECT_TRUE(has(abc, "!~)!"));
    EXPECT_TRUE(has(play(parse("g.lsys", leaving), "abc"), "\"^gliss.\"C6"));
}

TEST(Glissando, CsoundAndPagesSlide) {
    const std::string score = play(parse("g.lsys", steps), "csd");
    // C4 for four quarters, to F4, from a quarter of it on.
    EXPECT_TRUE(has(score, "i 1 0 4 261.625565 0.629921 1 0.503937 349.228231 0.25\n"));
    EXPECT_TRUE(has(score, "kpitch"));
    EXPECT_FALSE(has(play(parse("g.lsys", steps), "csd", {{"vertical", "extend"}}), "kpitch"));
    const std::string page = play(parse("g.lsys", steps), "html");
    const std::size_t begin = page.find("id=\"score\">") + 11;
    const auto data = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
    ASSERT_EQ(data["notes"].size(), 3u);
    EXPECT_EQ(data["notes"][0], nlohmann::json::parse("[0,1920,60,0,80,0,0,1,0,1440,5,3]"));
    EXPECT_EQ(data["notes"][2].size(), 9u);
    const std::string picture = play(parse("g.lsys", steps), "notes.svg");
    pugi::xml_document svg;
    ASSERT_TRUE(svg.load_string(picture.c_str()));
    EXPECT_EQ(svg.select_nodes("//g[@id='curve']/path[@class='glide']").size(), 2u);
    EXPECT_EQ(svg.select_nodes("//g[@id='roll']/path[@class='glide']").size(), 2u);
}

TEST(Glissando, WhatCannotSlideIsReported) {
    EXPECT_THROW(play(parse("g.lsys", steps), "mid", {{"tuning", "mts"}}), SettingError);
    EXPECT_TRUE(has(made_work(scores(), parse("g.lsys", steps), "strudel").remarks, "do not slide"));
    // The writer refuses what its options cannot bend.
    MidiScore score{.head = midi_head(), .notes = {midi_note(0, 480, 60)}};
    score.notes.front().glide = {240, 2, 0};
    score.end = 480;
    EXPECT_THROW(make_midi(score), ScoreError);
    MidiOptions mts;
    mts.microtonal = true;
    mts.tuning = Tuning::mts;
    EXPECT_THROW(make_midi(score, mts), ScoreError);
}

}  // namespace sikku::glissando_test
