// tests/music/mapping_test.cpp: compares the notes of curves with sequences computed by hand and by another method.
#include "music/melody/mapping.h"

#include "music/melody/melody_fold.h"
#include "tests/checks.h"
#include "tests/hilbert.h"
#include "tests/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace sikku::mapping_test {

using reference::grammar_of;

class Collector : public NoteSink {
public:
    void notes(std::span<const Note> some) override { all.insert(all.end(), some.begin(), some.end()); }
    void finish(std::int64_t at) override {
        end = at;
        ++finished;
    }
    std::vector<Note> all;
    std::int64_t end = -1;
    int finished = 0;
};

constexpr std::int64_t unit = 240;

/// A melody in which a key is a degree above key 40.
Melody plain() {
    Melody melody;
    melody.scale.ascent.clear();
    for (int i = 0; i < 12; ++i) melody.scale.ascent.push_back(100.0 * i);
    melody.scale.descent = melody.scale.ascent;
    melody.scale.period = 1200;
    melody.tonic = 40;
    melody.unit = unit;
    melody.anchor = Anchor::lowest_vertex;
    return melody;
}

Collector played(const Grammar& grammar, const Melody& melody, const PlayOptions& options = {}) {
    Collector collector;
    play(grammar, melody, collector, options);
    EXPECT_EQ(collector.finished, 1);
    return collector;
}

/// `3:1 r:1 2:2`: degrees and units; rests between notes and at the ends are `r`.
std::string told(const Collector& collector, std::size_t most = 40) {
    std::string text;
    std::int64_t now = 0;
    std::size_t count = 0;
    const auto add = [&](const std::string& item) { text += (text.empty() ? "" : " ") + item; };
    for (const Note& note : collector.all) {
        if (count++ == most) return text;
        if (note.onset > now) add(fmt::format("r:{}", (note.onset - now) / unit));
        add(fmt::format("{}:{}", note.key - 40, note.duration / unit));
        now = note.onset + note.duration;
    }
    if (collector.end > now) add(fmt::format("r:{}", (collector.end - now) / unit));
    return text;
}

Grammar hilbert(int n, const std::string& more = "turn: left\n") {
    return grammar_of(
        fmt::format("derivation length: {}\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n{}", n, more));
}
Grammar peano(int n, const std::string& more) {
    return grammar_of(
        fmt::format("derivation length: {}\naxiom: X\nturn: left\n{}X --> XFYFX+F+YFXFY-F-XFYFX\n"
                    "Y --> YFXFY-F-XFYFX+F+YFXFY\n",
                    n, more));
}
Grammar dragon(int n, const std::string& more) {
    return grammar_of(
        fmt::format("derivation length: {}\naxiom: FX\nturn: left\n{}X --> X+YF+\nY --> -FX-Y\n", n, more));
}
const std::string right = "turn: left\nheading: 0\n";

TEST(Runs, SequencesOfHilbert) {
    EXPECT_EQ(told(played(hilbert(2), plain())), "1:1 0:2 1:1 2:1 3:2 2:1");
    EXPECT_EQ(told(played(hilbert(2, right), plain())), "3:1 2:1 0:1 1:1 0:1 2:1 3:1");
    EXPECT_EQ(
        told(played(hilbert(3), plain())),
        "0:1 1:1 3:1 2:1 3:1 1:1 0:2 1:1 0:2 1:1 2:1 3:2 2:1 5:1 4:2 5:1 6:1 7:2 6:1 7:2 6:1 4:1 5:1 4:1 6:1 7:1");
    EXPECT_EQ(told(played(hilbert(3, right), plain())),
              "6:1 7:2 6:1 5:1 4:2 5:1 3:1 2:1 0:1 1:1 0:1 2:1 3:3 2:1 0:1 1:1 0:1 2:1 3:1 5:1 4:2 5:1 6:1 7:2 6:1");
    EXPECT_EQ(told(played(hilbert(3, "heading: 0\n"), plain())),
              "1:1 0:2 1:1 2:1 3:2 2:1 4:1 5:1 7:1 6:1 7:1 5:1 4:3 5:1 7:1 6:1 7:1 5:1 4:1 2:1 3:2 2:1 1:1 0:2 1:1");
    // Heading up, the sense of + and the axiom make no difference.
    EXPECT_EQ(told(played(hilbert(4), plain()), 999), told(played(hilbert(4, ""), plain()), 999));
}

TEST(Runs, SequencesOfPeanoAndTheDragon) {
    EXPECT_EQ(told(played(peano(1, "heading: 90\n"), plain())), "2:1 0:1");
    EXPECT_EQ(told(played(peano(2, "heading: 0\n"), plain())),
              "0:2 1:2 2:5 1:2 0:5 1:2 2:2 3:2 4:2 5:5 4:2 3:5 4:2 5:2 6:2 7:2 8:5 7:2 6:5 7:2 8:2");
    EXPECT_EQ(told(played(dragon(4, "heading: 90\n"), plain())), "5:1 4:1 3:1 2:1 1:1 2:1 1:1 0:1");
    EXPECT_EQ(told(played(dragon(6, "heading: 0\n"), plain()), 12),
              "9:1 10:1 11:1 10:1 11:1 10:1 9:1 8:1 9:1 8:1 7:1 8:1");
    EXPECT_EQ(played(dragon(10, "heading: 0\n"), plain()).all.size(), 512u);
}

TEST(Runs, NotesTellTheSymbolAtWhichTheyBegin) {
    for (const int n : {3, 7}) {  // of the longer word, parts are read as blocks
        const Grammar grammar = hilbert(n);
        const std::string word = reference::derived_text(grammar);
        for (const Runs runs : {Runs::merged, Runs::each_step}) {
            Melody melody = plain();
            melody.runs = runs;
            const Collector collector = played(grammar, melody);
            std::uint64_t last = 0;
            for (const Note& note : collector.all) {
                ASSERT_GT(note.symbol, last);
                ASSERT_EQ(word.at(note.symbol - 1), 'F');
                if (runs == Runs::merged && note.symbol > 1) {
                    const std::size_t before = word.find_last_of("F+-", note.symbol - 2);
                    if (before != std::string::npos) {
                        ASSERT_NE(word[before], 'F');
                    }
                }
                last = note.symbol;
            }
        }
    }
}

TEST(Runs, WhatVerticalRunsAre) {
    Melody melody = plain();
    melody.vertical = Vertical::rest;
    EXPECT_EQ(told(played(hilbert(2), melody)), "r:1 1:1 r:1 0:2 r:1 1:1 r:1 2:1 r:1 3:2 r:1 2:1 r:1");
    EXPECT_EQ(told(played(hilbert(2, right), melody)), "3:1 r:1 2:1 r:2 0:1 r:1 1:1 r:1 0:1 r:2 2:1 r:1 3:1");
    melody.vertical = Vertical::extend;
    EXPECT_EQ(told(played(hilbert(2), melody)), "1:3 0:3 1:2 2:2 3:3 2:2");
    EXPECT_EQ(told(played(hilbert(2, right), melody)), "3:2 2:3 0:2 1:2 0:3 2:2 3:1");
    EXPECT_EQ(
        told(played(hilbert(3), melody)),
        "0:2 1:3 3:2 2:2 3:3 1:2 0:3 1:2 0:3 1:2 2:2 3:3 2:4 5:2 4:3 5:2 6:2 7:3 6:2 7:3 6:3 4:2 5:2 4:3 6:2 7:1");
    melody.vertical = Vertical::glissando;
    EXPECT_EQ(told(played(hilbert(1, right), melody)), "1:1 0:2");
    EXPECT_EQ(told(played(grammar_of("turn: left\nheading: 0\naxiom: F+FFF-FF-F+F\n"), melody)), "0:4 3:3 2:1");
    melody.vertical = Vertical::voice;
    const Collector two = played(hilbert(4), melody);
    std::int64_t across = 0;
    std::int64_t up = 0;
    for (const Note& note : two.all) (note.voice == 0 ? across : up) += note.duration / unit;
    EXPECT_EQ(across + up, 255);
    EXPECT_EQ(std::max(across, up) * unit, two.end);
}

TEST(Runs, PublishedInvariantsOfHilbert) {
    const std::vector<std::size_t> up = {2, 6, 26, 102, 410, 1638, 6554, 26214};
    const std::vector<std::size_t> level = {1, 7, 25, 103, 409, 1639, 6553, 26215};
    const std::vector<std::uint64_t> sums_up = {5, 82, 2385, 70519, 2189641, 68945503};
    const std::vector<std::uint64_t> sums_right = {1, 72, 1872, 56992, 1738400, 54657920};
    for (int n = 1; n <= 8; ++n) {
        Melody melody = plain();
        melody.tonic = 0;
        melody.scale.period = 120;  // tenths of a semitone, so that 256 degrees are within the keys
        for (double& cents : melody.scale.ascent) cents /= 10;
        melody.scale.descent = melody.scale.ascent;
        for (const bool is_up : {true, false}) {
            const Collector found = played(hilbert(n, is_up ? "turn: left\n" : right), melody);
            const auto& notes = found.all;
            ASSERT_EQ(notes.size(), (is_up ? up : level)[static_cast<std::size_t>(n - 1)]);
            const std::int64_t total = (std::int64_t{1} << (2 * n)) / 2 - (is_up ? 0 : 1);
            std::int64_t sum = 0;
            std::uint64_t check = 0;
            std::set<std::int64_t> degrees;
            for (std::size_t i = 0; i < notes.size(); ++i) {
                const auto degree = static_cast<std::int64_t>(std::lround(notes[i].key * 10));
                const std::int64_t duration = notes[i].duration / unit;
                EXPECT_EQ(notes[i].onset, sum * unit);
                sum += duration;
                degrees.insert(degree);
                EXPECT_TRUE(duration >= 1 && duration <= 3);
                check = (check + (i + 1) * static_cast<std::uint64_t>((degree + 1) * duration)) % 1'000'000'007;
                // Lying, a palindrome; upright, backwards and upside down itself.
                const Note& mirror = notes[notes.size() - 1 - i];
                EXPECT_EQ(mirror.duration, notes[i].duration);
                const auto other = static_cast<std::int64_t>(std::lround(mirror.key * 10));
                EXPECT_EQ(other, is_up ? (std::int64_t{1} << n) - 1 - degree : degree);
            }
            EXPECT_EQ(sum, total);
            EXPECT_EQ(found.end, total * unit);
            if (n <= 6) {
                EXPECT_EQ(check, (is_up ? sums_up : sums_right)[static_cast<std::size_t>(n - 1)]);
            }
            if (n >= 2) {
                EXPECT_EQ(degrees.size(), std::size_t{1} << n);
            }
        }
    }
}

TEST(Runs, TheOtherForm) {
    // Horizontal runs of the bit-twiddling form of the curve, x and y exchanged: heading up.
    for (int n = 1; n <= 7; ++n) {
        const int side = 1 << n;
        std::string expected;
        std::int64_t run = 0;
        std::int64_t height = 0;
        const auto end_run = [&] {
            if (run > 0) expected += fmt::format("{}{}:{}", expected.empty() ? "" : " ", height, run);
            run = 0;
        };
        glm::dvec2 last = hilbert_point(side, 0);
        int direction = 0;
        for (int d = 1; d < side * side; ++d) {
            const glm::dvec2 next = hilbert_point(side, d);
            // Exchanged: what it calls y is across.
            const int here = next.y > last.y ? 1 : next.y < last.y ? -1 : 0;
            if (here == 0 || here != direction) end_run();
            if (here != 0) {
                ++run;
                height = static_cast<std::int64_t>(next.x);
            }
            direction = here;
            last = next;
        }
        end_run();
        Melody melody = plain();
        melody.tonic = 40;
        melody.range = Range::refuse;
        melody.scale.period = 12;
        for (double& cents : melody.scale.ascent) cents /= 100;
        melody.scale.descent = melody.scale.ascent;
        Collector found = played(hilbert(n), melody);
        for (Note& note : found.all) note.key = 40 + std::round((note.key - 40) * 100);
        EXPECT_EQ(told(found, 99999), expected) << n;
    }
}

TEST(Runs, Anchors) {
    Melody melody = plain();
    melody.anchor = Anchor::first_note;
    EXPECT_EQ(played(hilbert(4, right), melody).all.front().key, 40);
    melody.anchor = Anchor::centre;
    EXPECT_EQ(told(played(hilbert(2), melody)), "0:1 -1:2 0:1 1:1 2:2 1:1");
    // The lowest note may lie above the lowest vertex: a curve that dives and comes back.
    const std::string dive = "turn: left\nheading: 0\naxiom: F-FF+f+FFF-F\n";
    melody.anchor = Anchor::lowest_note;
    EXPECT_EQ(told(played(grammar_of(dive), melody)), "0:1 r:1 1:1");
    melody.anchor = Anchor::lowest_vertex;
    EXPECT_EQ(told(played(grammar_of(dive), melody)), "2:1 r:1 3:1");
    // With brackets only looking tells.
    const std::string branch = "turn: left\nheading: 0\naxiom: F[-FFF]F\n";
    EXPECT_EQ(told(played(grammar_of(branch), melody)), "3:2");
}

TEST(Runs, StepsAreHeardOneByOneOnRequest) {
    Melody melody = plain();
    melody.runs = Runs::each_step;
    EXPECT_EQ(told(played(hilbert(2), melody)), "1:1 0:1 0:1 1:1 2:1 3:1 3:1 2:1");
}

TEST(Runs, SlopingRuns) {
    Melody melody = plain();
    const std::string koch = "angle factor: 6\nheading: 0\nturn: left\naxiom: F+F--F+F\n";
    const Collector found = played(grammar_of(koch), melody);
    ASSERT_EQ(found.all.size(), 4u);
    EXPECT_EQ(found.all[1].duration, unit / 2);
    EXPECT_EQ(found.all[1].key, 40);  // its middle is at 0.43
    EXPECT_EQ(found.end, 3 * unit);
    melody.sloped = Sloped::skip;
    EXPECT_EQ(played(grammar_of(koch), melody).all.size(), 2u);
    melody.sloped = Sloped::refuse;
    EXPECT_THROW(played(grammar_of(koch), melody), ScoreError);
}

TEST(Runs, Ranges) {
    Melody melody = plain();
    melody.tonic = 120;
    const auto keys = [&](Range range) {
        melody.range = range;
        Collector collector;
        const PlayReport report = play(hilbert(4), melody, collector, {});
        EXPECT_EQ(report.moved > 0, true);
        double lowest = 200;
        double highest = -200;
        for (const Note& note : collector.all) {
            lowest = std::min(lowest, note.key);
            highest = std::max(highest, note.key);
        }
        return std::pair(lowest, highest);
    };
    EXPECT_EQ(keys(Range::fold), std::pair(116.0, 127.0));
    EXPECT_EQ(keys(Range::clamp), std::pair(120.0, 127.0));
    EXPECT_EQ(keys(Range::reflect).second, 127.0);
    // Between keys of one's own, and with a tonic that is itself beyond.
    melody.lowest = 48;
    melody.highest = 72;
    EXPECT_EQ(keys(Range::fold), std::pair(61.0, 72.0));
    EXPECT_EQ(keys(Range::clamp), std::pair(72.0, 72.0));
    EXPECT_LT(keys(Range::reflect).first, 72.0);
    melody.range = Range::refuse;
    EXPECT_THROW(played(hilbert(4), melody), ScoreError);
}

TEST(Runs, BranchesAreVoices) {
    Melody melody = plain();
    const Grammar grammar = grammar_of("turn: left\nheading: 0\naxiom: FF[+F-FFF]FF[-F+FF]F\n");
    const Collector found = played(grammar, melody);
    // The stem goes straight on through its branches.
    std::vector<std::vector<std::pair<std::int64_t, std::int64_t>>> voices(3);
    for (const Note& note : found.all) {
        ASSERT_LT(note.voice, 3);
        voices[static_cast<std::size_t>(note.voice)].emplace_back(note.onset / unit, note.duration / unit);
    }
    using Times = std::vector<std::pair<std::int64_t, std::int64_t>>;
    std::sort(voices.begin(), voices.end());
    EXPECT_EQ(voices[0], (Times{{0, 5}}));
    EXPECT_EQ(voices[1], (Times{{2, 3}}));
    EXPECT_EQ(voices[2], (Times{{4, 2}}));
    PlayOptions few;
    few.most_voices = 2;
    Collector collector;
    EXPECT_THROW(play(grammar, melody, collector, few), ScoreError);
}

TEST(Runs, ABranchBeginsWhereAndWhenTheTurtleIs) {
    Melody melody = plain();
    const auto onsets = [&](const std::string& axiom) {
        std::string text;
        for (const Note& note : played(grammar_of("turn: left\n" + axiom), melody).all) {
            text += fmt::format("{}{}:{}@{}", text.empty() ? "" : " ", note.voice, note.key - 40, note.onset / unit);
        }
        return text;
    };
    melody.anchor = Anchor::first_note;
    melody.vertical = Vertical::rest;
    EXPECT_EQ(onsets("axiom: FF[-F]FF-F\n"), "1:0@2 0:2@4");
    melody.vertical = Vertical::ignore;
    EXPECT_EQ(onsets("axiom: FF[-F]FF-F\n"), "1:0@0 0:2@0");
    // The note that is heard first sounds the tonic, though the branch within it ends before.
    EXPECT_EQ(onsets("heading: 0\naxiom: FF[+F-F]FF\n"), "1:1@2 0:0@0");
    melody.vertical = Vertical::voice;
    EXPECT_EQ(onsets("axiom: FF[-F+F]FF\n"), "2:0@0 3:1@2 1:0@0");
    melody.vertical = Vertical::ignore;
    melody.sloped = Sloped::skip;
    EXPECT_EQ(onsets("angle factor: 8\nheading: 45\naxiom: FF[-F]FF-F\n"), "1:0@0 0:2@0");
}

/// Onset:degree:duration of each note, in units, of one voice.
std::string times_of(const Collector& collector) {
    std::string text;
    for (const Note& note : collector.all) {
        EXPECT_EQ(note.voice, 0);
        const auto units = [](std::int64_t ticks) {
            return fmt::format("{:.4g}", static_cast<double>(ticks) / unit);
        };
        text += fmt::format("{}{}:{}:{}", text.empty() ? "" : " ", units(note.onset), note.key - 40,
                            units(note.duration));
    }
    return text;
}

TEST(Brackets, FollowOneAnother) {
    Melody melody = plain();
    melody.branches = Branches::sequence;
    melody.mapping = Mapping::symbols;
    // After Worth & Stepney: `]` restores the pitch, and time goes on.
    EXPECT_EQ(times_of(played(grammar_of("axiom: FF[+F[+F]F]F[-f-F]F\n"), melody)),
              "0:0:2 2:1:1 3:2:1 4:1:1 5:0:1 7:-2:1 8:0:1");
    melody.mapping = Mapping::runs;
    melody.anchor = Anchor::first_note;
    EXPECT_EQ(times_of(played(grammar_of("turn: left\nheading: 0\naxiom: FF[+F-FFF]FF[-F+FF]F\n"), melody)),
              "0:0:2 2:1:3 5:0:2 7:-1:2 9:0:1");
    melody.vertical = Vertical::rest;
    EXPECT_EQ(times_of(played(grammar_of("turn: left\nheading: 0\naxiom: FF[+F-FFF]FF\n"), melody)),
              "0:0:2 3:1:3 6:0:2");
    EXPECT_THROW(played(grammar_of("axiom: F[+F\n"), melody), WordError);
    EXPECT_THROW(played(grammar_of("axiom: F]+F\n"), melody), WordError);
}

TEST(Brackets, ShareAStepOfTheirStem) {
    Melody melody = plain();
    melody.branches = Branches::shares;
    melody.mapping = Mapping::symbols;
    EXPECT_EQ(times_of(played(grammar_of("axiom: F[+F[+FF]-F]F[-f-F]F[]F\n"), melody)),
              "0:0:1 1:1:0.3333 1.333:2:0.3333 1.667:0:0.3333 2:0:1 3.5:-2:0.5 4:0:1 5:0:1");
    melody.mapping = Mapping::runs;
    melody.anchor = Anchor::first_note;
    melody.vertical = Vertical::rest;
    EXPECT_EQ(times_of(played(grammar_of("turn: left\nheading: 0\naxiom: FF[+F-FFF]FF\n"), melody)),
              "0:0:2 2.25:1:0.75 3:0:2");
}

TEST(Brackets, InSequencePiecesEqualTheWholeCut) {
    const Grammar tree = grammar_of("derivation length: 7\nangle increment: 25.7\naxiom: F\nF --> FF[+F]F[-F-f]\n");
    const Grammar comb = grammar_of("derivation length: 6\nturn: left\nheading: 0\naxiom: F\nF --> F+F[-F+F]-F\n");
    for (const bool is_tree : {true, false}) {
        Melody melody = plain();
        melody.branches = Branches::sequence;
        melody.anchor = Anchor::first_note;
        melody.range = Range::clamp;
        if (is_tree) melody.mapping = Mapping::symbols;
        const Grammar& grammar = is_tree ? tree : comb;
        const Collector whole = played(grammar, melody);
        for (const std::int64_t from : {0, 100, 3001, 9999}) {
            PlayOptions options;
            options.from = from * unit;
            options.to = (from + 57) * unit;
            const Collector piece = played(grammar, melody, options);
            std::string expected;
            std::string found;
            for (const Note& note : whole.all) {
                const std::int64_t onset = std::max(note.onset, options.from);
                const std::int64_t end = std::min(note.onset + note.duration, options.to);
                if (onset < end) expected += fmt::format("{}+{}:{} ", onset - options.from, end - onset, note.key);
            }
            for (const Note& note : piece.all) {
                found += fmt::format("{}+{}:{} ", note.onset, note.duration, note.key);
            }
            EXPECT_EQ(found, expected) << is_tree << " from " << from;
        }
    }
    // Any order starts anywhere.
    Melody melody = plain();
    melody.branches = Branches::sequence;
    melody.mapping = Mapping::symbols;
    melody.range = Range::clamp;
    PlayOptions options;
    options.from = 123'456'789'012'345 * unit;
    options.to = options.from + 64 * unit;
    EXPECT_GT(played(grammar_of("derivation length: 25\nangle increment: 25.7\naxiom: F\nF --> FF[+F]F[-F-f]\n"),
                     melody, options)
                  .all.size(),
              10u);
}

TEST(OtherMappings, CounterpointHasTwoVoicesThatFillTheTime) {
    Melody melody = plain();
    melody.mapping = Mapping::counterpoint;
    melody.tonic = 64;
    const Collector found = played(dragon(8, ""), melody);
    for (int voice = 0; voice < 2; ++voice) {
        std::int64_t now = 0;
        for (const Note& note : found.all) {
            if (note.voice != voice) continue;
            EXPECT_EQ(note.onset, now);
            now += note.duration;
        }
        EXPECT_EQ(now, 256 * unit);
    }
}

TEST(OtherMappings, CounterpointIsAnchoredByItsUpperVoice) {
    Melody melody = plain();
    melody.mapping = Mapping::counterpoint;
    melody.anchor = Anchor::lowest_note;
    melody.tonic = 60;
    double lowest = 127;
    for (const Note& note : played(dragon(6, ""), melody).all) {
        if (note.voice == 0) lowest = std::min(lowest, note.key);
    }
    EXPECT_EQ(lowest, 60);
    EXPECT_THROW(played(grammar_of("axiom: F[+F\n"), melody), WordError);
}

TEST(OtherMappings, VelocitiesFollowTheTurns) {
    for (const Mapping mapping : {Mapping::runs, Mapping::counterpoint, Mapping::symbols}) {
        Melody melody = plain();
        melody.mapping = mapping;
        melody.range = Range::clamp;
        for (const Loudness loudness : {Loudness::by_turn, Loudness::by_length}) {
            melody.loudness = loudness;
            std::set<int> velocities;
            for (const Note& note : played(hilbert(4), melody).all) velocities.insert(note.velocity);
            EXPECT_GE(velocities.size(), 2u) << static_cast<int>(mapping);
        }
    }
}

TEST(OtherMappings, Symbols) {
    Melody melody = plain();
    melody.mapping = Mapping::symbols;
    EXPECT_EQ(told(played(grammar_of("axiom: F+FF-fF--F\n"), melody)), "0:1 1:2 r:1 0:1 -2:1");
    const Collector two = played(grammar_of("axiom: F[+F]F\n"), melody);
    // The stem's note goes on through its branches.
    ASSERT_EQ(two.all.size(), 2u);
    EXPECT_EQ(std::tuple(two.all[0].onset, two.all[0].duration, two.all[0].voice), std::tuple(unit, unit, 1));
    EXPECT_EQ(std::tuple(two.all[1].onset, two.all[1].duration, two.all[1].voice), std::tuple(0, 2 * unit, 0));
}

TEST(Census, EqualsWhatIsPlayed) {
    for (int n = 1; n <= 6; ++n) {
        for (const std::string& more : {std::string(), right, std::string("heading: 180\n")}) {
            for (const Grammar& grammar :
                 {hilbert(n, more), dragon(2 * n, "heading: 0\n"), peano(std::min(n, 3), "heading: 270\n")}) {
                Melody melody = plain();
                melody.range = Range::clamp;
                for (const Vertical vertical :
                     {Vertical::ignore, Vertical::rest, Vertical::extend, Vertical::glissando, Vertical::voice}) {
                    melody.vertical = vertical;
                    const auto told = census(grammar, melody);
                    ASSERT_TRUE(told);
                    const Collector found = played(grammar, melody);
                    EXPECT_EQ(told->notes, found.all.size());
                    EXPECT_EQ(told->ticks, found.end);
                }
            }
        }
    }
    // Steps that are not drawn, and long ones.
    for (const char* axiom : {"FfF+fF-F", "F(5)+F(5)-f(2)F", "fF+F(3)f+FF"}) {
        for (const Runs runs : {Runs::merged, Runs::each_step}) {
            for (const Vertical vertical :
                 {Vertical::ignore, Vertical::rest, Vertical::extend, Vertical::glissando, Vertical::voice}) {
                Melody melody = plain();
                melody.runs = runs;
                melody.vertical = vertical;
                const Grammar grammar = grammar_of(fmt::format("turn: left\nheading: 0\naxiom: {}\n", axiom));
                const auto told = census(grammar, melody);
                ASSERT_TRUE(told);
                const Collector found = played(grammar, melody);
                EXPECT_EQ(told->notes, found.all.size()) << axiom << " " << static_cast<int>(vertical);
                EXPECT_EQ(told->ticks, found.end) << axiom << " " << static_cast<int>(vertical);
            }
        }
    }
    const auto large = census(hilbert(12), plain());
    EXPECT_EQ(large->notes, 6'710'886);
    EXPECT_EQ(large->height, 4095);
    EXPECT_EQ(census(hilbert(40), plain())->ticks, (Integer(1) << 79) * unit);
    EXPECT_FALSE(census(grammar_of("axiom: F[F]F\n"), plain()));
    EXPECT_FALSE(census(grammar_of("angle factor: 6\naxiom: F+F\n"), plain()));
}

TEST(Pieces, BeyondTheTicksOf64Bits) {
    // Sub-curves of equal order are equal, so that a bar of a far one sounds as in the first, degrees higher.
    for (const auto& [rhythm, breath] : {std::pair("", 0), {"x..xx.", 0}, {"", 100}, {"x..xx.", 100}, {"", 240}}) {
        Melody melody = plain();
        melody.anchor = Anchor::piece;
        if (breath > 0) {
            melody.phrase_order = 2;
            melody.breath = breath;
            melody.cadence = Cadence::alternate;
        }
        if (*rhythm != 0) {
            std::string problem;
            melody.rhythm = read_rhythm_template(rhythm, problem);
        }
        const Grammar grammar = hilbert(60, "heading: 0\n");
        PlayOptions near;
        near.from = std::int64_t{1} << 50;
        near.to = near.from + 8 * melody.meter.bar();
        PlayOptions split = near;
        split.ahead = ((Integer(1) << 50) - (Integer(1) << 49)) / period(melody) * period(melody);
        split.from = (Integer(near.from) - split.ahead).convert_to<std::int64_t>();
        split.to = split.from + 8 * melody.meter.bar();
        EXPECT_EQ(told(played(grammar, melody, split)), told(played(grammar, melody, near))) << rhythm << breath;
        PlayOptions far = near;
        far.ahead = Integer("1920000000000000000000") / period(melody) * period(melody);
        EXPECT_GT(played(grammar, melody, far).all.size(), 20u) << rhythm << breath;
    }
    PlayOptions far;
    far.ahead = Integer(1) << 70;
    far.from = std::int64_t{1} << 50;
    far.to = far.from + 1920;
    Melody phrased = plain();
    phrased.phrase_order = 2;
    phrased.breathes_to_bar = true;
    EXPECT_THROW(played(hilbert(60), phrased, far), ScoreError);
    EXPECT_THROW(played(grammar_of("angle factor: 6\naxiom: F+F\n"), plain(), far), ScoreError);
}

TEST(Runs, WhereNothingIsDrawnMovesSound) {
    const std::string word = "turn: left\nheading: 0\naxiom: F+FF-FF\n";
    std::string moves = word;
    std::replace(moves.begin(), moves.end(), 'F', 'f');
    for (const Mapping mapping : {Mapping::runs, Mapping::counterpoint, Mapping::symbols}) {
        Melody melody = plain();
        melody.mapping = mapping;
        melody.anchor = Anchor::first_note;
        EXPECT_EQ(told(played(grammar_of(moves), melody)), told(played(grammar_of(word), melody)));
    }
    EXPECT_EQ(census(grammar_of(moves), plain())->notes, 2);
    EXPECT_EQ(told(played(grammar_of("heading: 0\naxiom: fFf\n"), plain())), "r:1 0:1 r:1");
}

using Played = std::vector<std::tuple<int, std::int64_t, std::int64_t, double>>;

/// A piece is what the whole would be if it were cut.
void expect_piece_of(const Grammar& grammar, const Melody& melody, const Collector& whole, std::int64_t from,
                     std::int64_t to) {
    Played expected;
    for (const Note& note : whole.all) {
        const std::int64_t onset = std::max(note.onset, from);
        const std::int64_t end = std::min(note.onset + note.duration, to);
        if (end > onset) expected.emplace_back(note.voice, onset - from, end - onset, note.key);
    }
    PlayOptions options;
    options.from = from;
    options.to = to;
    Played found;
    for (const Note& note : played(grammar, melody, options).all) {
        found.emplace_back(note.voice, note.onset, note.duration, note.key);
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << from << " to " << to;
}

TEST(Pieces, BeginAsTheWholeDoesWhateverComesFirst) {
    // Runs, rests and branches before the first note; the other mappings.
    const std::vector<Grammar> grammars = {
        hilbert(4),
        hilbert(5),
        hilbert(6),
        dragon(9, ""),
        grammar_of("turn: left\naxiom: ffFFF+FF-FFFF-FFF+F\n"),
        grammar_of("turn: left\nheading: 0\nderivation length: 2\naxiom: F\nF --> FF[+F-F]F\n")};
    for (const Grammar& grammar : grammars) {
        for (const Mapping mapping : {Mapping::runs, Mapping::counterpoint, Mapping::symbols}) {
            for (const Vertical vertical : {Vertical::ignore, Vertical::rest, Vertical::extend, Vertical::voice}) {
                Melody melody = plain();
                melody.mapping = mapping;
                melody.vertical = vertical;
                melody.anchor = Anchor::first_note;
                melody.range = Range::clamp;
                const Collector whole = played(grammar, melody);
                for (std::int64_t from = 1; from < whole.end; from += whole.end / 7 + 1) {
                    expect_piece_of(grammar, melody, whole, from, from + 10 * unit);
                }
            }
        }
    }
}

TEST(Pieces, MayBeginWithTheTonic) {
    for (const Mapping mapping : {Mapping::runs, Mapping::counterpoint, Mapping::symbols}) {
        Melody melody = plain();
        melody.mapping = mapping;
        melody.anchor = Anchor::piece;
        melody.tonic = 64;
        melody.range = Range::refuse;
        PlayOptions options;
        options.from = 1'000'000'000LL * melody.meter.bar();
        options.to = options.from + 2 * melody.meter.bar();
        const Collector piece = played(dragon(40, "heading: 0\n"), melody, options);
        ASSERT_FALSE(piece.all.empty());
        EXPECT_EQ(piece.all.front().onset, 0);
        const auto first = std::min_element(piece.all.begin(), piece.all.end(), [](const Note& a, const Note& b) {
            return std::tuple(a.voice, a.onset) < std::tuple(b.voice, b.onset);
        });
        EXPECT_EQ(first->key, 64);
        EXPECT_EQ(piece.end, 2 * melody.meter.bar());
    }
}

TEST(Pieces, FromTheMiddleEqualTheWholeCut) {
    for (const Vertical vertical : {Vertical::ignore, Vertical::rest, Vertical::extend, Vertical::voice}) {
        for (const Anchor anchor : {Anchor::first_note, Anchor::lowest_note, Anchor::lowest_vertex, Anchor::centre}) {
            Melody melody = plain();
            melody.vertical = vertical;
            melody.anchor = anchor;
            melody.range = Range::clamp;
            const Grammar grammar = hilbert(7);
            const Collector whole = played(grammar, melody);
            std::mt19937 random(7);
            for (int i = 0; i < 20; ++i) {
                const auto from = static_cast<std::int64_t>(random() % static_cast<unsigned>(whole.end));
                expect_piece_of(grammar, melody, whole, from,
                                from + static_cast<std::int64_t>(random() % 20'000) + 1);
            }
        }
    }
}

TEST(Pieces, OfOrdersWithoutMeasureCostWhatTheyAre) {
    PlayOptions options;
    options.to = 4 * plain().meter.bar();
    Melody melody = plain();
    melody.anchor = Anchor::first_note;
    EXPECT_GT(played(hilbert(100'000), melody, options).all.size(), 10u);
}

TEST(Pieces, AnyOrderStartsAnywhere) {
    Melody melody = plain();
    melody.range = Range::clamp;
    PlayOptions options;
    options.from = 1'000'000'000LL * melody.meter.bar();
    options.to = options.from + 16 * melody.meter.bar();
    std::uint64_t visited = 0;
    options.watch = [&](std::uint64_t symbols) { visited += symbols; };
    Collector piece;
    const PlayReport report = play(hilbert(40), melody, piece, options);
    EXPECT_LT(visited, 50'000u);
    EXPECT_EQ(piece.end, 16 * melody.meter.bar());
    EXPECT_GT(report.notes, 50u);
    // Order 20 holds bar 10^9, too, and order 40 begins as it does, turned or not, by self-similarity.
    Collector smaller;
    Melody first = melody;
    first.anchor = Anchor::first_note;
    play(hilbert(20), first, smaller, options);
    Collector larger;
    play(hilbert(40), first, larger, options);
    ASSERT_EQ(smaller.all.size(), larger.all.size());
    for (std::size_t i = 0; i < smaller.all.size(); ++i) {
        EXPECT_EQ(smaller.all[i].onset, larger.all[i].onset);
        EXPECT_EQ(smaller.all[i].key, larger.all[i].key);
    }
    // A piece of a tree in brackets is cut out, too.
    Melody symbols = plain();
    symbols.mapping = Mapping::symbols;
    Collector branch;
    PlayOptions piece_options;
    piece_options.from = 480;
    piece_options.to = 960;
    play(grammar_of("derivation length: 2\naxiom: F\nF --> FF[+F]F\n"), symbols, branch, piece_options);
    EXPECT_EQ(branch.end, 480);
}

std::string slots_of(const std::string& text) {
    std::string problem;
    const RhythmTemplate rhythm = read_rhythm_template(text, problem);
    std::string slots(static_cast<std::size_t>(rhythm.slots), '~');
    for (const auto& [onset, length, stress, percent] : rhythm.hits) {
        for (std::int64_t i = 0; i < length; ++i) slots[static_cast<std::size_t>(onset + i)] = '.';
        slots[static_cast<std::size_t>(onset)] = stress == Stress::accent ? 'X' : 'x';
    }
    return slots;
}

TEST(Rhythms, OfToussaintAndOfTalas) {
    EXPECT_EQ(slots_of("E(3,8)"), "x..x..x.");  // tresillo
    EXPECT_EQ(slots_of("E(5,8)"), "x.xx.xx.");  // cinquillo
    EXPECT_EQ(slots_of("E(5,12)"), "x..x.x..x.x.");
    EXPECT_EQ(slots_of("e(7, 16)"), "x..x.x.x..x.x.x.");
    EXPECT_EQ(slots_of("E(3,8,3)"), "x..x.x..");
    EXPECT_EQ(slots_of("E(4,4)"), "xxxx");
    EXPECT_EQ(slots_of("adi"), "X...x.x.");
    EXPECT_EQ(slots_of("Misra Chapu"), "X..x.x.");
    EXPECT_EQ(slots_of("3+3+2"), "X..x..x.");
    EXPECT_EQ(slots_of("x.~x | X.."), "x.~xX..");
    for (const char* bad : {"", "E(0,8)", "E(9,8)", "E(3)", "E(3,257)", "0+2", "4", ".x", "xyx", "adii", "300+1"}) {
        EXPECT_EQ(slots_of(bad), "") << bad;
    }
}

TEST(Rhythms, AreLaidOverTheStepsOfACurve) {
    Melody melody = plain();
    std::string problem;
    melody.rhythm = read_rhythm_template("E(3,8)", problem);
    EXPECT_EQ(told(played(dragon(4, ""), melody)), "5:3 4:3 3:2 2:3 1:3 2:2 1:3 0:3");
    melody.rhythm = read_rhythm_template("X.~x", problem);
    const Collector found = played(grammar_of("turn: left\nheading: 0\naxiom: F+F-FF+F-F\n"), melody);
    // A run of two steps is held over two hits.
    EXPECT_EQ(told(found), "0:2 r:1 1:3 r:1 2:1");
    EXPECT_EQ(found.all[0].velocity, 96);
    EXPECT_EQ(found.all[1].velocity, 80);
    // A step of any angle takes a hit, and of any length where all have the same.
    for (const char* steps : {"F", "F(0.2)"}) {
        const std::string f = steps;
        const Collector sloped = played(
            grammar_of(fmt::format("heading: 0\nangle increment: 60\naxiom: {0}+{0}+{0}+{0}{0}-{0}\n", f)), melody);
        std::string times;
        for (const Note& note : sloped.all) times += fmt::format("{}:{} ", note.onset / unit, note.duration / unit);
        EXPECT_EQ(times, "0:2 3:1 4:2 7:3 11:1 ") << f;
    }
    // Branches that are voices take the notes of the template from where they begin.
    melody.branches = Branches::voices;
    std::string times;
    for (const Note& note : played(grammar_of("turn: left\nheading: 0\naxiom: F[F+F-F]-F+F\n"), melody).all) {
        times += fmt::format("{}/{}:{} ", note.voice, note.onset / unit, note.duration / unit);
    }
    EXPECT_EQ(times, "1/3:1 1/4:2 0/0:2 0/3:1 ");
    for (const auto change :
         {+[](Melody& one) { one.phrase_order = 1; }, +[](Melody& one) { one.cadence = Cadence::tonic; }}) {
        Melody phrased = melody;
        change(phrased);
        Collector unheard;
        EXPECT_THROW(play(grammar_of("axiom: F[+F]F\n"), phrased, unheard, {}), ScoreError);
    }
}

/// The notes of a piece, and of the whole cut to it.
void expect_pieces(const Grammar& grammar, const Melody& melody, const std::vector<std::int64_t>& starts) {
    const Collector whole = played(grammar, melody);
    for (const std::int64_t from : starts) {
        PlayOptions options;
        options.from = from * unit;
        options.to = (from + 64) * unit;
        std::vector<std::tuple<int, std::int64_t, std::int64_t, double, int>> expected;
        std::vector<std::tuple<int, std::int64_t, std::int64_t, double, int>> found;
        for (const Note& note : whole.all) {
            const std::int64_t onset = std::max(note.onset, options.from);
            const std::int64_t end = std::min(note.onset + note.duration, options.to);
            if (onset < end) {
                expected.emplace_back(note.voice, onset - options.from, end - onset, note.key, note.velocity);
            }
        }
        for (const Note& note : played(grammar, melody, options).all) {
            found.emplace_back(note.voice, note.onset, note.duration, note.key, note.velocity);
        }
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected) << "from " << from;
    }
}

TEST(Form, PhrasesEndWhereSubCurvesDo) {
    Melody melody = plain();
    melody.anchor = Anchor::lowest_vertex;
    melody.phrase_order = 2;
    melody.breath = 2 * unit;
    // Four Hilbert curves of order 2; a run that goes on beyond the end of one ends the phrase.
    EXPECT_EQ(told(played(hilbert(3, right), melody)),
              "6:1 7:2 6:1 5:1 4:2 5:1 r:2 3:1 2:1 0:1 1:1 0:1 2:1 3:3 r:2 2:1 0:1 1:1 0:1 2:1 3:1 r:2 5:1 4:2 5:1 "
              "6:1 7:2 6:1");
    melody.cadence = Cadence::tonic;
    const Collector closed = played(hilbert(3, right), melody);
    for (std::size_t i = 0; i < closed.all.size(); ++i) {
        const bool is_last =
            i + 1 == closed.all.size() || closed.all[i + 1].onset > closed.all[i].onset + closed.all[i].duration;
        if (!is_last) continue;
        EXPECT_EQ(std::remainder(closed.all[i].key - 40, 12), 0) << i;
        EXPECT_EQ(std::fabs(closed.all[i - 1].key - closed.all[i].key), 1) << i;
    }
    // Phrases end on the fifth and the tonic in turn; the last one closes, though it is the third.
    melody.scale = *find_scale("major");
    melody.cadence = Cadence::alternate;
    melody.phrase_order = 1;
    std::vector<double> ends;
    const Collector open = played(grammar_of("derivation length: 1\nturn: left\nheading: 0\naxiom: X+F-X+F-X\n"
                                             "X --> F+F-F+F-F+F-F\n"),
                                  melody);
    for (std::size_t i = 0; i < open.all.size(); ++i) {
        const bool is_last =
            i + 1 == open.all.size() || open.all[i + 1].onset > open.all[i].onset + open.all[i].duration;
        if (is_last) ends.push_back(std::fmod(open.all[i].key - 40 + 24, 12));
    }
    EXPECT_EQ(ends, (std::vector<double>{7, 0, 0}));
    Collector unheard;
    EXPECT_THROW(play(grammar_of("axiom: F(1)\nderivation length: 3\nF(x) --> F(x+1)F(x)\n"), melody, unheard, {}),
                 ScoreError);
}

TEST(Form, PiecesEqualTheWholeCut) {
    std::string problem;
    for (const Mapping mapping : {Mapping::runs, Mapping::counterpoint, Mapping::symbols}) {
        Melody melody = plain();
        melody.mapping = mapping;
        melody.anchor = Anchor::first_note;
        melody.range = Range::clamp;
        melody.phrase_order = 2;
        melody.breath = unit;
        melody.cadence = Cadence::alternate;
        melody.articulation = Articulation::detached;
        melody.swing = 0.66;
        melody.swing_unit = unit;
        for (const char* rhythm : {"", "x.~xx", "E(5,8)", "bar x.~xx"}) {
            melody.breathes_to_bar = rhythm[0] == 'b';
            melody.rhythm = read_rhythm_template(rhythm + (melody.breathes_to_bar ? 4 : 0), problem);
            for (const Vertical vertical : {Vertical::ignore, Vertical::rest, Vertical::extend, Vertical::voice}) {
                if (mapping != Mapping::runs && vertical != Vertical::ignore) continue;
                melody.vertical = vertical;
                expect_pieces(hilbert(6), melody, {0, 64, 1000, 1729});
                expect_pieces(dragon(12, ""), melody, {0, 640, 3001});
            }
        }
        // Any order starts anywhere.
        PlayOptions options;
        options.from = 123'456'789'012'345 * 8 * unit;
        options.to = options.from + 128 * unit;
        melody.anchor = Anchor::piece;
        melody.breathes_to_bar = false;
        EXPECT_GT(played(hilbert(40), melody, options).all.size(), 10u);
    }
}

TEST(Form, SwingKeepsTheBeats) {
    Melody melody = plain();
    melody.swing = 2.0 / 3;
    melody.swing_unit = unit;
    std::vector<std::int64_t> onsets;
    for (const Note& note :
         played(grammar_of("heading: 0\nangle factor: 8\naxiom: F+F-F+F\nturn: left\n"), melody).all)
        onsets.push_back(note.onset);
    melody.runs = Runs::each_step;
    onsets.clear();
    for (const Note& note : played(grammar_of("heading: 0\naxiom: FFFF\n"), melody).all) onsets.push_back(note.onset);
    EXPECT_EQ(onsets, (std::vector<std::int64_t>{0, 320, 480, 800}));
}

/// A ride of triplets meets the swung off-beat: both sound after two thirds of a beat.
TEST(Form, SwingMovesOnlyBinaryOffBeats) {
    const auto onsets = [](std::int64_t length, int notes, double swing) {
        Melody melody = plain();
        melody.runs = Runs::each_step;
        melody.unit = length;
        melody.swing = swing;
        std::vector<std::int64_t> found;
        const std::string word(static_cast<std::size_t>(notes), 'F');
        for (const Note& note : played(grammar_of("heading: 0\naxiom: " + word + "\n"), melody).all) {
            EXPECT_TRUE(found.empty() || note.onset >= found.back());
            found.push_back(note.onset);
        }
        return found;
    };
    EXPECT_EQ(onsets(ticks_per_quarter / 3, 4, 0.66), (std::vector<std::int64_t>{0, 160, 320, 480}));
    EXPECT_EQ(onsets(ticks_per_quarter / 5, 6, 0.66), (std::vector<std::int64_t>{0, 96, 192, 288, 384, 480}));
    EXPECT_EQ(onsets(ticks_per_quarter / 2, 3, 0.66), (std::vector<std::int64_t>{0, 317, 480}));
    EXPECT_EQ(onsets(ticks_per_quarter / 4, 5, 0.75), (std::vector<std::int64_t>{0, 180, 360, 420, 480}));
}

std::vector<std::string> chord_names(const std::string& scale, const std::string& progression, double tonic = 60) {
    std::string problem;
    std::vector<std::string> names;
    for (const Chord& chord : read_progression(progression, *find_scale(scale), tonic, problem)) {
        std::string name;
        for (const double cents : chord.cents) name += fmt::format("{}{:.0f}", name.empty() ? "" : " ", cents / 100);
        names.push_back(name);
    }
    return names;
}

TEST(Harmonies, ChordsOfScales) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(chord_names("major", "I-IV-V7-vi"), (Names{"0 4 7", "5 9 12", "7 11 17 14", "9 12 16"}));
    EXPECT_EQ(chord_names("minor", "I-IV-V"), (Names{"0 3 7", "5 8 12", "7 10 14"}));
    // Without a third above, a chord is a fifth.
    EXPECT_EQ(chord_names("blues", "I-V"), (Names{"0 3 7", "7 10"}));
    EXPECT_EQ(chord_names("major", "blues").size(), 12U);
    for (const char* bad : {"", "I-", "I-VIII", "x", "I--I", "I8"})
        EXPECT_TRUE(chord_names("major", bad).empty()) << bad;
    EXPECT_EQ(find_scale("major")->cents(drone_degree(*find_scale("major")), false), 700);
    EXPECT_EQ(find_scale("hamsadhwani")->cents(drone_degree(*find_scale("hamsadhwani")), false), 700);
}

/// Spellings of chords in pitch classes above C, by the tables of any book of harmony.
TEST(Harmonies, ChordsByName) {
    const auto classes = [](const std::string& name, const std::string& scale, double tonic) {
        std::string problem;
        std::string text;
        const auto chords = read_progression(name, *find_scale(scale), tonic, problem);
        if (chords.size() != 1) return problem;
        std::set<int> sorted;
        for (const double cents : chords[0].cents) {
            sorted.insert(static_cast<int>(std::lround(cents / 100 + tonic + 120)) % 12);
        }
        for (const int pitch : sorted) text += fmt::format("{}{}", text.empty() ? "" : " ", pitch);
        return text;
    };
    const std::pair<const char*, const char*> names[] = {
        {"C", "0 4 7"},       {"Cm", "0 3 7"},        {"C7", "0 4 7 10"},      {"Cmaj7", "0 4 7 11"},
        {"CM7", "0 4 7 11"},  {"CΔ", "0 4 7 11"},     {"Cm7", "0 3 7 10"},     {"Cm7b5", "0 3 6 10"},
        {"Cø7", "0 3 6 10"},  {"C°7", "0 3 6 9"},     {"Cdim", "0 3 6"},       {"C+", "0 4 8"},
        {"C6", "0 4 7 9"},    {"Cm6", "0 3 7 9"},     {"Csus4", "0 5 7"},      {"C7sus4", "0 5 7 10"},
        {"Cadd9", "0 2 4 7"}, {"C9", "0 2 4 7 10"},   {"Cmaj9", "0 2 4 7 11"}, {"Cm9", "0 2 3 7 10"},
        {"C5", "0 7"},        {"Cmmaj7", "0 3 7 11"}, {"Am", "0 4 9"},         {"F#m7", "1 4 6 9"},
        {"B♭7", "2 5 8 10"},  {"Ebmaj7", "2 3 7 10"}, {"G7", "2 5 7 11"},      {"D/F#", "2 6 9"},
        {"C/Bb", "0 4 7 10"}, {"Cb", "3 6 11"},       {"B#", "0 4 7"},
    };
    for (const auto& [name, pitches] : names) {
        for (const double tonic : {60.0, 62.0, 59.0}) EXPECT_EQ(classes(name, "major", tonic), pitches) << name;
    }
    const std::pair<const char*, const char*> in_c[] = {
        {"ii7", "0 2 5 9"},   {"ii", "2 5 9"},        {"Imaj7", "0 4 7 11"}, {"iv", "0 5 8"},
        {"bVII", "2 5 10"},   {"♭VI", "0 3 8"},       {"V/V", "2 6 9"},      {"V7/V", "0 2 6 9"},
        {"V7/ii", "1 4 7 9"}, {"vii°7/V", "0 3 6 9"}, {"viiø7", "2 5 9 11"}, {"bII7", "1 5 8 11"},
        {"III", "4 7 11"},    {"IIImaj", "4 8 11"},   {"i", "0 3 7"},        {"V7/bVI", "1 3 7 10"},
        {"vi", "0 4 9"},      {"VI", "0 4 9"},        {"#ivdim", "0 6 9"},
    };
    for (const auto& [name, pitches] : in_c) EXPECT_EQ(classes(name, "major", 60), pitches) << name;
    // Third and seventh sound above another bass, before the root.
    EXPECT_EQ(chord_names("major", "C7/G-C7/E-C7/Bb-C/G"),
              (std::vector<std::string>{"-5 4 10 0", "-8 0 10 7", "-2 0 4 7", "-5 0 4"}));
    EXPECT_EQ(classes("iadd9", "major", 60), "0 2 3 7");
    EXPECT_EQ(classes("imaj9", "major", 60), "0 2 3 7 11");
    EXPECT_EQ(classes("III", "minor", 60), "3 7 10");
    EXPECT_EQ(classes("bIII", "minor", 60), "3 7 10") << "accidentals count from the major scale";
    EXPECT_EQ(classes("V", "minor", 60), "2 7 10") << "the triad of the scale";
    EXPECT_EQ(classes("V7", "minor", 60), "2 5 7 11");
    for (const char* bad :
         {"H", "c", "Cx", "I/V7", "I/G", "C/V", "C/", "Iv", "iI", "IIX", "C77", "bbbI", "♭", "imaj", "/V", "C/G/E"}) {
        EXPECT_TRUE(has(classes(bad, "major", 60), "unknown chord")) << bad;
    }
}

TEST(Harmonies, StrongBeatsAreTonesOfTheChord) {
    std::string problem;
    for (const Harmony harmony : {Harmony::progression, Harmony::triads}) {
        Melody melody = plain();
        melody.scale = *find_scale("major");
        melody.tonic = 60;
        melody.range = Range::clamp;
        melody.anchor = Anchor::lowest_vertex;
        melody.harmony = harmony;
        melody.progression.clear();
        if (harmony == Harmony::progression)
            melody.progression = read_progression("I-IV-V-I", melody.scale, melody.tonic, problem);
        const Collector found = played(hilbert(5), melody);
        std::map<std::int64_t, std::set<int>> chords;  // pitch classes by bar
        std::map<std::int64_t, int> voices;
        const std::int64_t bar = melody.meter.bar();
        for (const Note& note : found.all) {
            if (note.voice == 0) continue;
            EXPECT_EQ(note.onset % bar, 0);
            chords[note.onset / bar].insert(static_cast<int>(note.key) % 12);
            ++voices[note.onset / bar];
        }
        std::size_t strong = 0;
        for (const Note& note : found.all) {
            if (note.voice != 0 || note.onset % (bar / 2) != 0) continue;
            ++strong;
            EXPECT_TRUE(chords[note.onset / bar].contains(static_cast<int>(note.key) % 12)) << note.onset / bar;
        }
        EXPECT_GT(strong, 80U);
        for (const auto& [at, count] : voices) EXPECT_EQ(count, 3) << at;
        if (harmony == Harmony::progression) {
            EXPECT_EQ(chords[0], (std::set<int>{0, 4, 7}));
            EXPECT_EQ(chords[5], (std::set<int>{5, 9, 0}));
            EXPECT_EQ(chords[10], (std::set<int>{7, 11, 2}));
        }
        expect_pieces(hilbert(6), melody, {0, 64, 1024});
        PlayOptions options;
        options.from = 123'456'789'012'345 * 8 * unit;
        options.to = options.from + 128 * unit;
        melody.anchor = Anchor::piece;
        EXPECT_GT(played(hilbert(40), melody, options).all.size(), 40u);
    }
}

/// What is beyond the range is brought into it before its chord is chosen: the chord is that of what sounds.
TEST(Harmonies, FollowTheMelodyWithinItsRange) {
    std::string problem;
    for (const Range range : {Range::fold, Range::reflect, Range::clamp}) {
        for (const Harmony harmony : {Harmony::progression, Harmony::triads}) {
            Melody melody = plain();
            melody.scale = *find_scale("major");
            melody.tonic = 60;
            melody.anchor = Anchor::centre;
            melody.range = range;
            melody.lowest = 57;
            melody.highest = 74;
            melody.harmony = harmony;
            if (harmony == Harmony::progression) {
                melody.progression = read_progression("I-IV-V-II", melody.scale, melody.tonic, problem);
            }
            Collector found;
            EXPECT_GT(play(hilbert(6), melody, found, {}).moved, 500u);
            std::map<std::int64_t, std::set<int>> chords;  // pitch classes by bar
            std::map<std::int64_t, std::map<int, std::int64_t>> sounding;
            const std::int64_t bar = melody.meter.bar();
            for (const Note& note : found.all) {
                const int pitch = static_cast<int>(note.key) % 12;
                const std::int64_t at = note.onset / bar;
                if (note.voice != 0) {
                    chords[at].insert(pitch);
                    continue;
                }
                EXPECT_GE(note.key, 57);
                EXPECT_LE(note.key, 74);
                const bool is_strong = note.onset % (bar / 2) == 0;
                sounding[at][pitch] += (is_strong ? 2 : 1) * note.duration;
            }
            for (const Note& note : found.all) {
                if (note.voice != 0 || note.onset % (bar / 2) != 0) continue;
                EXPECT_TRUE(chords[note.onset / bar].contains(static_cast<int>(note.key) % 12)) << note.onset / bar;
            }
            if (harmony == Harmony::progression) continue;
            // The chord has at least half of what sounds: a triad that fits worse than another is not chosen.
            for (const auto& [at, pitches] : sounding) {
                std::int64_t fits = 0;
                std::int64_t all = 0;
                for (const auto& [pitch, weight] : pitches) {
                    all += weight;
                    if (chords[at].contains(pitch)) fits += weight;
                }
                EXPECT_GE(2 * fits, all) << at;
            }
            expect_pieces(hilbert(6), melody, {0, 64, 1024});
        }
        Melody melody = plain();
        melody.scale = *find_scale("major");
        melody.tonic = 60;
        melody.range = range;
        melody.lowest = 57;
        melody.highest = 74;
        melody.phrase_order = 2;
        melody.breath = unit;
        melody.cadence = Cadence::tonic;
        const Collector closed = played(hilbert(5), melody);
        for (std::size_t i = 0; i < closed.all.size(); ++i) {
            const bool is_last =
                i + 1 == closed.all.size() || closed.all[i + 1].onset > closed.all[i].onset + closed.all[i].duration;
            if (is_last) {
                EXPECT_EQ(std::remainder(closed.all[i].key - 60, 12), 0) << i;
            }
        }
    }
}

TEST(Harmonies, ADroneSoundsTonicAndFifth) {
    Melody melody = plain();
    melody.scale = *find_scale("hamsadhwani");
    melody.tonic = 60;
    melody.harmony = Harmony::drone;
    std::set<int> classes;
    std::int64_t until = 0;
    const Collector found = played(hilbert(4), melody);
    for (const Note& note : found.all) {
        if (note.voice == 0) continue;
        classes.insert(static_cast<int>(note.key) % 12);
        until = std::max(until, note.onset + note.duration);
    }
    EXPECT_EQ(classes, (std::set<int>{0, 7}));
    EXPECT_EQ(until, found.end);
}

TEST(Runs, MistakesOfTheWord) {
    EXPECT_THROW(played(grammar_of("axiom: F]\n"), plain()), WordError);
    EXPECT_THROW(played(grammar_of("axiom: [F\n"), plain()), WordError);
    EXPECT_THROW(played(grammar_of("axiom: F(1/0)\n"), plain()), WordError);
    EXPECT_THROW(played(hilbert(40), plain()), BudgetError);
}

}  // namespace sikku::mapping_test
