#include "music/note_stream.h"

#include "music/scores.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace sikku::note_stream_test {

const std::string hilbert =
    "angle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 5\nunit: 1/16\n";
const std::string arrowhead =
    "angle factor: 6\naxiom: YF\nX --> YF+XF+Y\nY --> XF-YF-X\nderivation length: 6\nmapping: runs\n";

Document document_of(const std::string& text) {
    Diagnostics diagnostics;
    Document document = Document::compile("test", text, {}, diagnostics);
    diagnostics.throw_if_errors();
    return document;
}

using Heard = std::tuple<std::int64_t, int, std::int64_t, double, int>;  // onset, voice, end, key, velocity

/// The notes of the windows of one pass from `tick` on, put together.
std::vector<Heard> collect(NoteStream& stream, std::int64_t* end = nullptr, std::size_t* most = nullptr) {
    std::vector<Heard> heard;
    std::map<int, std::size_t> open;  // of voices
    std::int64_t at = -1;
    for (;;) {
        const NoteWindow window = stream.next();
        EXPECT_TRUE(at < 0 || window.from == at) << window.from;
        at = window.to;
        if (most) *most = std::max(*most, window.notes.size());
        for (const NoteWindow::End& one : window.ends) {
            EXPECT_TRUE(open.contains(one.voice)) << "a note ends that was not open";
            std::get<2>(heard[open[one.voice]]) = one.tick;
            open.erase(one.voice);
        }
        for (const Note& note : window.notes) {
            EXPECT_GE(note.onset, window.from);
            EXPECT_LT(note.onset, window.is_last ? INT64_MAX : window.to);
            if (note.duration == 0) open[note.voice] = heard.size();
            heard.emplace_back(note.onset, note.voice, note.onset + note.duration, note.key, note.velocity);
        }
        if (!window.is_last) continue;
        EXPECT_TRUE(open.empty()) << "a note does not end";
        if (end) *end = window.end.value();
        std::sort(heard.begin(), heard.end());
        return heard;
    }
}

std::vector<Heard> heard_in(const NoteList& list) {
    std::vector<Heard> heard;
    for (const Note& note : list.notes) {
        heard.emplace_back(note.onset, note.voice, note.onset + note.duration, note.key, note.velocity);
    }
    std::sort(heard.begin(), heard.end());
    return heard;
}

/// What the windows hold is what the whole score holds.
TEST(NoteStream, WindowsMakeTheWhole) {
    const std::vector<OptionValues> all = {
        {},
        {{"unit", "1/1"}},
        {{"unit", "7/4"}},
        {{"vertical", "voice"}},
        {{"vertical", "glissando"}},
        {{"vertical", "extend"}},
        {{"mapping", "counterpoint"}},
        {{"mapping", "counterpoint"}, {"unit", "3/2"}},
        {{"mapping", "symbols"}},
        {{"rhythm", "E(3,8)"}, {"swing", "67"}},
        {{"phrases", "2"}, {"cadence", "alternate"}},
        {{"harmony", "drone"}},
        {{"harmony", "triads"}},
        {{"harmony", "triads"}, {"unit", "7/4"}},
        {{"harmony", "triads"}, {"unit", "4/1"}, {"from-bar", "9"}, {"bars", "57"}},
        {{"harmony", "progression I-IV-V7-I"}, {"meter", "3/4"}},
        {{"harmony", "bass 2"}},
        {{"canon", "2 -12, 3.5 fifth below"}},
        {{"anchor", "lowest note"}},
        {{"anchor", "centre"}, {"range", "reflect C4-C5"}},
        {{"anchor", "piece"}},
        {{"anchor", "piece"}, {"from-bar", "7"}, {"inversion", "yes"}},
        {{"anchor", "piece"}, {"from-bar", "7"}, {"mapping", "symbols"}},
        {{"anchor", "piece"}, {"from-bar", "7"}, {"harmony", "triads"}, {"cadence", "tonic"}},
        {{"anchor", "piece"}, {"from-bar", "7"}, {"mapping", "counterpoint"}},
        {{"from-bar", "9"}, {"bars", "13"}, {"ending", "ritardando"}},
        {{"seconds", "17.3"}},
        {{"speed", "3:2"}},
        {{"speed", "11:7"}, {"start", "1.5"}},
        {{"speed", "64:61"}},
        {{"start", "9"}},
        {{"excerpt", "3-9"}},
        {{"retrograde", "yes"}},
        {{"loop", "3"}},
        {{"augmentation", "3/2"}},
        {{"humanise", "1"}, {"seed", "4"}},
        {{"scale", "hamsadhwani"}, {"articulation", "detached"}, {"velocity", "by length"}},
        {{"velocity", "by y 20-120"}, {"humanise", "0.5"}},
        {{"velocity", "by level 20-120"}, {"phrases", "2"}},
        {{"velocity", "by turn 20-120"}, {"mapping", "counterpoint"}, {"from-bar", "7"}},
        {{"velocity", "by level 20-120"}, {"from-bar", "9"}, {"bars", "13"}},
        {{"velocity", "by length"}, {"from-bar", "9"}, {"bars", "13"}, {"unit", "7/4"}},
    };
    for (const std::string& text : {hilbert, arrowhead}) {
        const std::vector<Document> documents = {document_of(text)};
        for (const OptionValues& values : all) {
            std::string name;
            for (const OptionValue& value : values) name += value.name + " " + value.text + ", ";
            SCOPED_TRACE(name + (text == hilbert ? "hilbert" : "arrowhead"));
            NoteList list;
            try {
                list = list_notes(documents, values, {});
            } catch (const ScoreError& error) {
                EXPECT_THROW(stream_notes(documents, values), ScoreError) << error.what();
                continue;
            }
            const auto stream = stream_notes(documents, values);
            std::int64_t end = 0;
            const std::vector<Heard> whole = heard_in(list);
            ASSERT_EQ(collect(*stream, &end), whole);
            EXPECT_EQ(end, list.end);
            // It begins again.
            ASSERT_EQ(collect(*stream), whole);
            // And from any tick.
            for (const std::int64_t from : {1LL, 1919LL, 1920LL, 10'000LL, 27'001LL}) {
                if (from >= list.end) continue;
                stream->seek(from);
                const std::vector<Heard> later(std::lower_bound(whole.begin(), whole.end(), Heard{from, 0, 0, 0, 0}),
                                               whole.end());
                ASSERT_EQ(collect(*stream), later) << from;
            }
        }
    }
}

using Event = std::tuple<std::int64_t, int, int>;  // tick, kind and value

constexpr int bend_kind = 200;
constexpr int tempo_kind = 300;

/// The last event of each kind at each tick, where it changes anything.
std::vector<Event> changes(const std::vector<Event>& events) {
    std::map<std::pair<std::int64_t, int>, int> all;
    for (const auto& [tick, kind, value] : events) all[{tick, kind}] = value;
    std::vector<Event> result;
    std::map<int, int> last = {{bend_kind, 0}};
    for (const auto& [key, value] : all) {
        const auto known = last.find(key.second);
        if (known != last.end() && known->second == value) continue;
        last[key.second] = value;
        result.emplace_back(key.first, key.second, value);
    }
    return result;
}

/// Controllers, bends in a range of 12 semitones, and tempos in microseconds a quarter.
std::vector<Event> curves_of(const MidiFile& file) {
    std::vector<Event> events;
    for (const MidiEvent& event : file.events) {
        const auto byte = [&](std::size_t i) { return static_cast<int>(static_cast<unsigned char>(event.data[i])); };
        if ((event.status & 0xF0) == 0xB0 && (byte(0) == 10 || byte(0) == 74)) {
            events.emplace_back(event.tick, byte(0), byte(1));
        }
        if ((event.status & 0xF0) == 0xE0) events.emplace_back(event.tick, bend_kind, byte(0) + 128 * byte(1) - 8192);
        if (event.status == 0xFF && event.type == 0x51) {
            events.emplace_back(event.tick, tempo_kind, byte(0) * 65536 + byte(1) * 256 + byte(2));
        }
    }
    return changes(events);
}

std::vector<Event> curves_of(NoteStream& stream, std::int64_t from) {
    const auto tempo = [&](double factor) {
        return static_cast<int>(std::round(60e6 / (stream.head().tempo * factor)));
    };
    std::vector<Event> events = {{from, tempo_kind, tempo(1)}};
    stream.seek(from);
    for (NoteWindow window;;) {
        window = stream.next();
        for (const Note& note : window.notes) events.emplace_back(note.onset, bend_kind, 0);
        for (const ControlPoint& point : window.controls) {
            if (point.number != ControlPoint::bend) {
                events.emplace_back(point.tick, point.number, static_cast<int>(point.value));
            } else {
                events.emplace_back(point.tick, bend_kind, static_cast<int>(std::lround(point.value * 8192 / 12)));
            }
        }
        for (const TempoPoint& point : window.tempos)
            events.emplace_back(point.tick, tempo_kind, tempo(point.factor));
        if (window.is_last) return changes(events);
    }
}

/// Tempo, controllers and bends of the windows are those of the file, from any tick on.
TEST(NoteStream, WindowsHaveTheCurves) {
    const std::vector<OptionValues> all = {
        {{"pan", "by x"}, {"controller", "74 by y"}},
        {{"tempo", "96 by y 80-112"}},
        {{"tempo", "96 by level 80-112"}, {"phrases", "2"}, {"harmony", "triads"}},
        {{"tempo", "96 by length 80-112"}, {"meter", "1/64"}, {"unit", "3/32"}},
        {{"gamaka", "kampita 2 6, jaru 1, meend all"}, {"unit", "1/4"}},
        {{"gamaka", "jaru all"}, {"pan", "by turn 10-90"}, {"unit", "1/4"}},
        {{"gamaka", "meend all"}, {"tempo", "96 by x 80-112"}, {"from-bar", "9"}, {"bars", "13"}},
    };
    for (const std::string& text : {hilbert, arrowhead}) {
        const Document document = document_of(text);
        for (const OptionValues& values : all) {
            SCOPED_TRACE(values.front().name + " " + values.front().text);
            const MidiFile file = read_midi(play(document, "mid", values));
            const auto stream = stream_notes(std::span(&document, 1), values);
            const std::vector<Event> whole = curves_of(file);
            ASSERT_GT(whole.size(), 20u);
            EXPECT_EQ(curves_of(*stream, 0), whole);
            for (const std::int64_t from : {1920LL, 9'000LL}) {
                // Until `from` the last of each counts.
                std::vector<Event> later;
                std::map<int, int> last;
                for (const auto& [tick, kind, value] : whole) {
                    if (tick <= from) last[kind] = value;
                }
                for (const auto& [kind, value] : last) later.emplace_back(from, kind, value);
                for (const Event& event : whole) {
                    if (std::get<0>(event) > from) later.push_back(event);
                }
                std::erase_if(later, [&](const Event& event) { return std::get<1>(event) == bend_kind; });
                auto found = curves_of(*stream, from);
                std::erase_if(found, [&](const Event& event) { return std::get<1>(event) == bend_kind; });
                EXPECT_EQ(found, later) << from;
            }
        }
    }
}

/// Their ranges are known from the fold.
TEST(NoteStream, EndlessCurvesHaveExpression) {
    const Document endless = document_of(hilbert).with({{"-n", "derivation length", "40"}});
    const OptionValues values = {{"velocity", "by y 20-120"}, {"pan", "by x"}, {"tempo", "96 by y 80-112"}};
    const auto stream = stream_notes(std::span(&endless, 1), values);
    const NoteWindow window = stream->next();
    EXPECT_EQ(window.notes.front().velocity, 20);
    EXPECT_NEAR(window.tempos.front().factor, 80.0 / 96, 1e-6);
}

TEST(NoteStream, PartsOfAnArrangement) {
    const std::vector<Document> documents = {
        document_of(hilbert), document_of(hilbert + "start: 3\nmeter: 3/4\nspeed: 4:3\nharmony: triads\n"),
        document_of(arrowhead + "start: 30\n")};
    const NoteList list = list_notes(documents, {}, {});
    const auto stream = stream_notes(documents, {});
    std::int64_t end = 0;
    EXPECT_EQ(collect(*stream, &end), heard_in(list));
    EXPECT_EQ(end, list.end);
}

TEST(NoteStream, BranchesAreReadWhole) {
    const std::vector<Document> documents = {
        document_of("angle factor: 16\naxiom: F\nF --> FF-[-F+F+F]+[+F-F-F]\nderivation length: 2\n")};
    const NoteList list = list_notes(documents, {}, {});
    EXPECT_GT(list.parts.front().voices, 1);
    EXPECT_EQ(collect(*stream_notes(documents, {})), heard_in(list));
}

/// A note is longer than what is read after a window.
TEST(NoteStream, ALongNoteEndsOnce) {
    const std::vector<Document> documents = {document_of("axiom: +" + std::string(4000, 'F') + "-F+F\n")};
    const NoteList list = list_notes(documents, {}, {});
    ASSERT_EQ(list.notes.front().duration, 4000 * 240);
    EXPECT_EQ(collect(*stream_notes(documents, {})), heard_in(list));
}

TEST(NoteStream, SilenceIsAnError) {
    const std::vector<Document> documents = {document_of("axiom: F\n")};
    EXPECT_THROW(stream_notes(documents, {}), ScoreError);
}

/// Four to the power of forty steps.
TEST(NoteStream, AnEndlessCurveBeginsAtOnce) {
    const std::vector<Document> documents = {document_of(hilbert).with({{"-n", "derivation length", "40"}})};
    const auto stream = stream_notes(documents, {{"anchor", "piece"}, {"from-bar", "1000000000"}});
    const NoteList list =
        list_notes(documents, {{"anchor", "piece"}, {"from-bar", "1000000000"}, {"bars", "100"}}, {});
    std::vector<Heard> heard;
    std::vector<Heard> expected = heard_in(list);
    while (heard.size() < expected.size()) {
        const NoteWindow window = stream->next();
        ASSERT_LT(window.notes.size(), 1000u);
        ASSERT_FALSE(window.end);
        for (const Note& note : window.notes) {
            heard.emplace_back(note.onset, note.voice, note.onset + note.duration, note.key, note.velocity);
        }
    }
    // The last note is cut in the list.
    heard.resize(expected.size() - 1);
    expected.pop_back();
    EXPECT_EQ(heard, expected);
}

/// Of a curve without end a level is known in a piece only.
TEST(NoteStream, SaysWhyItHasToBeReadFirst) {
    const Document document = document_of(
        "angle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 40\n"
        "velocity: by level\n");
    EXPECT_TRUE(has(error_of<BudgetError>([&] {
                        stream_notes({&document, 1}, {});
                    }),
                    "curves of expression need the least and greatest value"));
    EXPECT_GT(collect(*stream_notes({&document, 1}, {{"bars", "4"}})).size(), 20u);
}

}  // namespace sikku::note_stream_test
