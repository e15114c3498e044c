#include "music/score/unisons.h"

#include "music/excerpt.h"
#include "music/score/midi.h"
#include "music/scores.h"
#include "tests/midi_reader.h"
#include "tests/midi_tools.h"
#include "tests/notation_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::unisons_test {

class Collector : public NoteSink {
public:
    void notes(std::span<const Note> block) override { list.insert(list.end(), block.begin(), block.end()); }
    void finish(std::int64_t at) override { end = at; }
    std::vector<Note> list;
    std::int64_t end = 0;
};

TestScore random_voices(unsigned seed, int parts, int voices) {
    std::mt19937 random(seed);
    TestScore score;
    std::int16_t voice = 0;
    for (int part = 0; part < parts; ++part) {
        score.head.parts.push_back(plain_part("Part", voices));
        for (int i = 0; i < voices; ++i, ++voice) {
            std::int64_t here = 0;
            for (int n = 0; n < 30; ++n) {
                Note note{.onset = here + static_cast<std::int64_t>(random() % 3) * 60,
                          .duration = 60 * (1 + static_cast<std::int64_t>(random() % 5)),
                          .key = 60 + static_cast<double>(random() % 6),
                          .voice = voice,
                          .velocity = static_cast<std::uint8_t>(60 + random() % 40)};
                here = note.onset + note.duration;
                score.notes.push_back(note);
            }
            score.end = std::max(score.end, here);
        }
    }
    return score;
}

/// Where a key of a part sounds, sixteenth by sixteenth, and where it is struck.
using Sound = std::set<std::tuple<int, int, std::int64_t>>;
std::pair<Sound, Sound> heard(const std::vector<Note>& notes, int voices) {
    std::pair<Sound, Sound> result;
    for (const Note& note : notes) {
        const int part = note.voice / voices;
        const int key = static_cast<int>(note.key);
        result.second.emplace(part, key, note.onset);
        for (std::int64_t at = note.onset; at < note.onset + note.duration; at += 60)
            result.first.emplace(part, key, at);
    }
    return result;
}

TEST(Unisons, KeysSoundOnceAndNothingIsLost) {
    for (unsigned seed = 0; seed < 30; ++seed) {
        const TestScore score = random_voices(seed, 2, 10);
        Collector collector;
        UnisonMerger merger(collector, score.head, 10'000);
        merger.notes(score.notes);
        merger.finish(score.end);
        EXPECT_EQ(collector.end, score.end);
        EXPECT_EQ(heard(collector.list, 10), heard(score.notes, 10));
        std::map<std::pair<int, double>, std::int64_t> key_ends;
        std::map<int, std::int64_t> voice_ends;
        std::sort(collector.list.begin(), collector.list.end(),
                  [](const Note& a, const Note& b) { return a.onset < b.onset; });
        for (const Note& note : collector.list) {
            auto& key_end = key_ends[{note.voice / 10, note.key}];
            EXPECT_LE(key_end, note.onset);
            key_end = note.onset + note.duration;
            EXPECT_LE(voice_ends[note.voice], note.onset);
            voice_ends[note.voice] = note.onset + note.duration;
            EXPECT_GT(note.duration, 0);
        }
    }
}

TEST(Unisons, VoicesOfAPartShareItsChannel) {
    const TestScore score = random_voices(1, 2, 12);
    MemorySink sink;
    MidiOptions options{.share_channels = true};
    const auto writer = write_midi(score.head, sink, options);
    UnisonMerger merger(*writer, score.head, 10'000);
    merger.notes(score.notes);
    merger.finish(score.end);
    std::set<int> channels;
    std::size_t notes = 0;
    const MidiFile read = read_midi(sink.text);
    for (const MidiNote& note : read.notes) {
        channels.insert(note.channel);
        ++notes;
    }
    EXPECT_EQ(channels, (std::set<int>{0, 1}));
    EXPECT_GT(notes, 300u);
}

/// With more parts than channels, those of an instrument share one.
TEST(Unisons, PartsOfAnInstrumentShareAChannel) {
    TestScore score = random_voices(2, 40, 1);
    for (std::size_t i = 0; i < 40; ++i) score.head.parts[i].program = static_cast<int>(i % 15);
    MemorySink sink;
    MidiOptions options{.share_channels = true};
    const auto writer = write_midi(score.head, sink, options);
    UnisonMerger merger(*writer, score.head, 10'000);
    merger.notes(score.notes);
    merger.finish(score.end);
    EXPECT_EQ(midi_faults(sink.text), "");
    std::map<int, std::set<int>> programs;
    for (const MidiEvent& event : read_midi(sink.text).events) {
        if ((event.status & 0xF0) == 0xC0) programs[event.status & 0x0F].insert(event.data[0]);
    }
    EXPECT_EQ(programs.size(), 15u);
    for (const auto& [channel, own] : programs) EXPECT_EQ(own.size(), 1u) << channel;
    score.head.parts[39].program = 15;
    EXPECT_THROW(write_midi(score.head, sink, options), ScoreError);
}

/// No part shares a channel while another is free.
TEST(Unisons, PartsHaveChannelsOfTheirOwnAsFarAsTheyGo) {
    ScoreHead head;
    head.parts.resize(18);
    for (std::size_t i = 0; i < 18; ++i) head.parts[i].program = i == 16 ? 7 : static_cast<int>(i % 2);
    head.parts[3].is_drums = true;
    EXPECT_EQ(channel_slots(head), (std::vector<int>{0, 1, 2, 0, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 1, 14, 1}));
}

/// What sounds of some notes between two ticks, as (part, key, onset, duration, velocity).
using Strokes = std::set<std::tuple<int, double, std::int64_t, std::int64_t, int>>;
Strokes strokes_within(const std::vector<Note>& notes, int voices, std::int64_t from, std::int64_t to) {
    Strokes result;
    for (const Note& note : notes) {
        const std::int64_t begin = std::max(note.onset, from);
        const std::int64_t end = std::min(note.onset + note.duration, to);
        if (begin < end) result.emplace(note.voice / voices, note.key, begin - from, end - begin, note.velocity);
    }
    return result;
}

TEST(Unisons, ExcerptsAreCutOutsOfTheWhole) {
    std::size_t most = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const TestScore score = random_voices(seed, 2, 5);
        Collector whole;
        UnisonMerger merger(whole, score.head, 10'000);
        merger.notes(score.notes);
        merger.finish(score.end);
        for (std::int64_t from = 60; from < score.end; from += 300) {
            const std::int64_t to = from + 720;
            Collector excerpt;
            UnisonMerger late(excerpt, score.head, 10'000);
            ExcerptSink cutter(late, from, to, &late.strokes_before());
            cutter.notes(score.notes);
            cutter.finish(score.end);
            const Strokes expected = strokes_within(whole.list, 5, from, to);
            ASSERT_EQ(strokes_within(excerpt.list, 5, 0, INT64_MAX), expected) << seed << " from " << from;
            most = std::max(most, expected.size());
        }
    }
    EXPECT_GT(most, 10u);
}

/// Two lines of one drum: strokes of three quarters at 110, and of one quarter at 60 in the first two bars.
TEST(Unisons, DrumsOfAnExcerptAreAsLoudAsInTheWhole) {
    const Document document = parse("drums.lsys",
                                    "axiom: [kkkkkkkk][HHHH]\nmapping: symbols\ntempo: 120\n"
                                    "drum k: closed hi-hat 1/4 60\ndrum H: closed hi-hat 3/4 110\n");
    const auto struck = [&](const OptionValues& values) {
        std::vector<std::tuple<std::int64_t, std::int64_t, int>> result;
        for (const MidiNote& note : read_midi(play(document, "mid", values)).notes)
            result.emplace_back(note.onset / 480, note.duration / 480, note.velocity);
        std::sort(result.begin(), result.end());
        return result;
    };
    using Struck = decltype(struck({}));
    EXPECT_EQ(struck({}), (Struck{{0, 1, 110},
                                  {1, 1, 60},
                                  {2, 1, 60},
                                  {3, 1, 110},
                                  {4, 1, 60},
                                  {5, 1, 60},
                                  {6, 1, 110},
                                  {7, 2, 60},
                                  {9, 3, 110}}));
    // The stroke at 4 ends the remainder of the stroke at 3; the stroke at 7 continues, though its own note
    // ends.
    EXPECT_EQ(struck({{"from-bar", "2"}, {"bars", "1"}}), (Struck{{0, 1, 60}, {1, 1, 60}, {2, 1, 110}, {3, 1, 60}}));
    EXPECT_EQ(struck({{"from-bar", "3"}}), (Struck{{0, 1, 60}, {1, 3, 110}}));
}

TEST(Unisons, HasALimit) {
    const TestScore score = random_voices(1, 1, 2);
    Collector collector;
    UnisonMerger merger(collector, score.head, 59);
    EXPECT_THROW(merger.notes(score.notes), ScoreError);
}

}  // namespace sikku::unisons_test
