// tests/music/accompaniment_test.cpp: figures of accompaniments, rhythms by phrase and leaps, compared with tables.
#include "music/melody/figure.h"
#include "music/scores.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::accompaniment_test {

const std::string hilbert =
    "title: H\naxiom: X\nderivation length: 4\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nrange: reflect "
    "C4-C6\nharmony: progression C-Am-Dm-G7\n";
/// A level line: a sub-curve of order k has 2^k steps.
const std::string steady =
    "title: D\naxiom: F\nderivation length: 7\nF --> FF\nheading: 0\nunit: 1/8\nruns: each step\n";

NoteList notes_of(const std::string& text, const OptionValues& values = {}) {
    const Document document = parse("h.lsys", text);
    return list_notes({&document, 1}, values, {});
}

/// Onsets of the accompaniment in a bar, by voice from the bass.
std::array<std::vector<std::int64_t>, 3> onsets_in_bar(const NoteList& list, std::int64_t number) {
    std::array<std::vector<std::int64_t>, 3> onsets;
    for (const Note& note : list.notes) {
        if (note.voice == 0 || note.onset / list.meter.bar() != number) continue;
        onsets[static_cast<std::size_t>(note.voice) - 1].push_back(note.onset % list.meter.bar());
    }
    return onsets;
}

TEST(Figures, StrokesOfOomPahByMeter) {
    using Ticks = std::vector<std::int64_t>;
    for (const auto& [meter, bass, chords] :
         std::vector<std::tuple<std::string, Ticks, Ticks>>{{"4/4", {0, 960}, {480, 1440}},
                                                            {"3/4", {0}, {480, 960}},
                                                            {"2/4", {0, 480}, {}},
                                                            {"6/8", {0, 720}, {240, 480, 960, 1200}},
                                                            {"7/8", {0, 720, 1200}, {240, 480, 960, 1440}},
                                                            {"2+3/8", {0, 480}, {240, 720, 960}}}) {
        const NoteList list = notes_of(hilbert + "accompaniment: oom-pah\nmeter: " + meter + "\n");
        const auto onsets = onsets_in_bar(list, 1);
        EXPECT_EQ(onsets[0], bass) << meter;
        EXPECT_EQ(onsets[1], chords) << meter;
        EXPECT_EQ(onsets[2], chords) << meter;
    }
}

TEST(Figures, SoundTheirChords) {
    const std::array<std::set<int>, 4> chords = {{{0, 4, 7}, {9, 0, 4}, {2, 5, 9}, {7, 11, 5, 2}}};
    const std::array<int, 4> roots = {0, 9, 2, 7};
    for (const std::string figure : {"block", "oom-pah", "arpeggio", "arpeggio-down", "alberti", "strum", "bossa",
                                     "walking bass", "b.~.5.b. & ~~.C.c.c", "o|u|l|a"}) {
        const NoteList list = notes_of(hilbert + "accompaniment: " + figure + " on guitar\n");
        const std::int64_t bar = list.meter.bar();
        std::map<int, std::int64_t> until;
        std::map<std::int64_t, double> bass;
        int count = 0;
        for (const Note& note : list.notes) {
            if (note.voice == 0) continue;
            EXPECT_GE(note.onset, until[note.voice]) << figure;
            until[note.voice] = note.onset + note.duration;
            const std::int64_t number = note.onset / bar;
            EXPECT_LE(note.onset + note.duration, (number + 1) * bar) << figure;
            const int tone = static_cast<int>(note.key) % 12;
            const bool is_approach = figure == "walking bass" && note.onset % bar == bar * 3 / 4;
            if (is_approach) {
                const int next = roots[static_cast<std::size_t>((number + 1) % 4)];
                EXPECT_TRUE(tone == (next + 1) % 12 || tone == (next + 11) % 12) << number;
            } else {
                EXPECT_TRUE(chords[static_cast<std::size_t>(number % 4)].contains(tone)) << figure << number;
            }
            if (note.onset % bar == 0 && note.voice == 1) {
                bass[number] = note.key;
                EXPECT_EQ(tone, roots[static_cast<std::size_t>(number % 4)]) << figure;
            }
            ++count;
        }
        EXPECT_GT(count, 30) << figure;
    }
}

TEST(Figures, LastBarIsHeld) {
    const NoteList list = notes_of(hilbert + "accompaniment: alberti\n");
    const std::int64_t last = (list.end - 1) / list.meter.bar();
    for (const Note& note : list.notes) {
        if (note.voice > 0 && note.onset / list.meter.bar() == last) {
            EXPECT_EQ(note.duration, list.meter.bar());
        }
    }
    EXPECT_EQ(onsets_in_bar(list, last), (std::array<std::vector<std::int64_t>, 3>{{{0}, {0}, {0}}}));
    EXPECT_EQ(onsets_in_bar(list, last - 1)[1].size() + onsets_in_bar(list, last - 1)[2].size(), 6u);
}

TEST(Figures, SilentChordsBendTheMelody) {
    const auto melody_of = [](const NoteList& list) {
        std::vector<std::pair<std::int64_t, double>> notes;
        for (const Note& note : list.notes) {
            if (note.voice == 0) notes.emplace_back(note.onset, note.key);
        }
        return notes;
    };
    const NoteList silent = notes_of(hilbert + "accompaniment: silent\n");
    EXPECT_EQ(melody_of(silent).size(), silent.notes.size());
    EXPECT_EQ(melody_of(silent), melody_of(notes_of(hilbert)));
    EXPECT_EQ(silent.parts.size(), 1u);
}

/// No voice plays two notes at once, whatever is done with the part.
TEST(Figures, KeepTheirVoicesInForms) {
    int count = 0;
    for (const std::string meter : {"4/4", "3/4", "7/8"}) {
        for (const std::string figure : {"oom-pah", "alberti", "strum", "walking bass"}) {
            for (const std::string layout : {"form: A1 B2", "form: ABA\ncadence: tonic", "form: A B\nretrograde: yes",
                                             "loop: 2", "retrograde: yes", "counterpoint: strict", "canon: 1 -12",
                                             "speed: 3:2", "augmentation: 2", "cadence: alternate\nbreath: bar"}) {
                for (const std::string harmony : {"triads", "progression I-IV-V7-vi", "progression C5-G5"}) {
                    const NoteList list = notes_of(
                        fmt::format("{}harmony: {}\naccompaniment: {}\nmeter: {}\nphrases: 2\n{}\n",
                                    hilbert.substr(0, hilbert.rfind("harmony")), harmony, figure, meter, layout));
                    std::map<int, std::int64_t> until;
                    for (const Note& note : list.notes) {
                        EXPECT_GE(note.onset, until[note.voice]) << meter << figure << layout << harmony;
                        until[note.voice] = note.onset + note.duration;
                    }
                    ++count;
                }
            }
        }
    }
    EXPECT_EQ(count, 360);
}

TEST(Figures, InstrumentsAndAccents) {
    const NoteList list = notes_of(hilbert + "accompaniment: A.c. on nylon\n");
    ASSERT_EQ(list.parts.size(), 2u);
    EXPECT_EQ(list.parts[1].program, 24);
    for (const Note& note : list.notes) {
        if (note.voice == 0 || note.duration == list.meter.bar()) continue;
        EXPECT_EQ(note.velocity, note.onset % list.meter.bar() == 0 ? 54 + accent_velocity : 54);
    }
    EXPECT_EQ(notes_of(hilbert).parts[1].program, 48);
}

TEST(Figures, BadInput) {
    for (const auto& [text, meter, part] : std::vector<std::tuple<std::string, Meter, std::string>>{
             {"waltz", {4, 4}, "expected block, oom-pah"},
             {"bosa", {4, 4}, "did you mean 'bossa'"},
             {"", {4, 4}, "needs a stroke"},
             {"....", {4, 4}, "needs a stroke"},
             {"b & ", {4, 4}, "needs a stroke"},
             {"a...&bbbb", {4, 4}, "layer 2 and one before it play the bass"},
             {"b...&3535", {4, 4}, "play the bass"},
             {"u & l & oo", {4, 4}, "layer 3 and one before it play the upper voice"},
             {"alberti", {33, 4}, "alberti needs a bar of at most 64 eighths"},
             {"bossa", {7, 8}, "needs a meter of four quarters"},
             {"bossa", {4, 4, {2, 1, 1}}, "needs a meter of four quarters"},
             {"bcccccc", {4, 4}, "cannot be divided into 7 equal slots"},
             {std::string(65, 'b'), {4, 4}, "65 equal slots"},
             {std::string(100'000, 'b'), {4, 4}, "100000 equal slots"}}) {
        std::string problem;
        read_figure(text, meter, problem);
        EXPECT_NE(problem.find(part), std::string::npos) << text.substr(0, 20) << ": " << problem;
    }
    for (const std::string line : {"accompaniment: bossa on\n", "accompaniment: bossa on kazoo\n"}) {
        EXPECT_THROW(notes_of(hilbert + line), PatternError) << line;
    }
}

TEST(Leaps, MoveByOctavesWithinAPhrase) {
    // Notes of the plain curve as far apart as its runs are long.
    const std::string curve =
        "title: C\naxiom: X\nderivation length: 8\nX --> YXY\nY --> F-FFFFF+\nangle factor: 4\n"
        "unit: 1/8\nheading: 0\ntonic: C4\n";
    const auto greatest = [](const NoteList& list) {
        double most = 0;
        for (std::size_t i = 1; i < list.notes.size(); ++i) {
            most = std::max(most, std::fabs(list.notes[i].key - list.notes[i - 1].key));
        }
        return most;
    };
    const NoteList plain = notes_of(curve);
    ASSERT_GT(greatest(plain), 7);
    for (const int leaps : {6, 7, 9}) {
        const NoteList limited = notes_of(fmt::format("{}leaps: {}\n", curve, leaps));
        EXPECT_LE(greatest(limited), leaps);
        ASSERT_EQ(limited.notes.size(), plain.notes.size());
        for (std::size_t i = 0; i < plain.notes.size(); ++i) {
            EXPECT_EQ(limited.notes[i].onset, plain.notes[i].onset);
            EXPECT_EQ(std::fmod(limited.notes[i].key - plain.notes[i].key + 1200, 12), 0);
        }
    }
    // A phrase begins where the curve is, so that drifts end.
    const NoteList phrased = notes_of(curve + "leaps: 7\nphrases: 1\nbreath: none\n");
    double moved = 0;
    double moved_in_phrases = 0;
    const NoteList drifting = notes_of(curve + "leaps: 7\n");
    ASSERT_EQ(phrased.notes.size(), plain.notes.size());
    for (std::size_t i = 0; i < plain.notes.size(); ++i) {
        moved += std::fabs(drifting.notes[i].key - plain.notes[i].key);
        moved_in_phrases += std::fabs(phrased.notes[i].key - plain.notes[i].key);
    }
    EXPECT_GT(moved, moved_in_phrases);
    EXPECT_GT(moved_in_phrases, 0);
    // Excerpts agree with the whole.
    const NoteList part = notes_of(curve + "leaps: 7\n", {{"from-bar", "2"}, {"bars", "1"}});
    const NoteList whole = notes_of(curve + "leaps: 7\n");
    for (const Note& note : part.notes) {
        const auto same = std::find_if(whole.notes.begin(), whole.notes.end(), [&](const Note& one) {
            return one.onset + one.duration > note.onset + 1920 && one.onset <= note.onset + 1920;
        });
        ASSERT_NE(same, whole.notes.end());
        EXPECT_EQ(same->key, note.key);
    }
    for (const char* line : {"leaps: 0\n", "leaps: 5\n", "leaps: 128\n", "leaps: -7\n", "leaps: x\n"}) {
        EXPECT_THROW(notes_of(curve + line), PatternError) << line;
    }
}

TEST(Rhythms, FollowOneAnotherByPhrase) {
    const std::vector<std::pair<std::string, std::vector<std::int64_t>>> rhythms = {
        {"x.x.x.x.", {0, 2, 4, 6}}, {"X..x..x.", {0, 3, 6}}, {"x.x.x.x.", {0, 2, 4, 6}}, {"X~~~x~~~", {0, 4}}};
    std::string key = "rhythm: ";
    for (const auto& [text, hits] : rhythms) key += (key.ends_with(' ') ? "" : " / ") + text;
    for (const bool to_bar : {false, true}) {
        const NoteList list = notes_of(steady + key + "\nphrases: 3\nbreath: " + (to_bar ? "bar" : "1/8") + "\n");
        std::size_t next = 0;
        std::int64_t begin = 0;
        constexpr std::size_t steps = 8;
        for (std::size_t phrase = 0; phrase < 16; ++phrase) {
            const std::vector<std::int64_t>& hits = rhythms[phrase % 4].second;
            std::int64_t end = begin;
            for (std::size_t i = 0; i < steps; ++i, ++next) {
                ASSERT_LT(next, list.notes.size());
                const Note& note = list.notes[next];
                const auto cycle = static_cast<std::int64_t>(i / hits.size());
                EXPECT_EQ(note.onset, begin + 240 * (8 * cycle + hits[i % hits.size()])) << phrase << " " << i;
                end = note.onset + note.duration;
            }
            const auto cycles = static_cast<std::int64_t>(steps / hits.size());
            const std::int64_t following = begin + 240 * (8 * cycles + hits[steps % hits.size()]);
            begin = to_bar ? (end + 1919) / 1920 * 1920 : std::max(end + 240, following);
        }
        EXPECT_EQ(next, list.notes.size());
    }
    EXPECT_THROW(notes_of(steady + "rhythm: x. / x..\n"), PatternError);
    EXPECT_THROW(notes_of(steady + "phrases: 2\nrhythm: x. / \n"), PatternError);
    EXPECT_THROW(notes_of(steady + "phrases: 2\nrhythm: / x.\n"), PatternError);
}

}  // namespace sikku::accompaniment_test
