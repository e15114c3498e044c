// tests/music/harmony_test.cpp: chords, drones and canons of scores, compared with rules of their own.
#include "music/scores.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace sikku::harmony_test {

const std::string hilbert =
    "title: H\naxiom: X\nderivation length: 5\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nrange: reflect "
    "C4-C6\n";

NoteList notes_of(const std::string& text) {
    const Document document = parse("h.lsys", text);
    return list_notes({&document, 1}, {}, {});
}

std::map<int, std::vector<Note>> by_voice(const NoteList& list) {
    std::map<int, std::vector<Note>> voices;
    for (const Note& note : list.notes) voices[note.voice].push_back(note);
    return voices;
}

/// Unisons, octaves and fifths that follow each other between voices that both move, at each onset of both.
int parallels(const std::vector<Note>& a, const std::vector<Note>& b) {
    int count = 0;
    for (std::size_t i = 1; i < a.size(); ++i) {
        const auto same =
            std::find_if(b.begin(), b.end(), [&](const Note& note) { return note.onset == a[i].onset; });
        if (same == b.end() || same == b.begin()) continue;
        if (a[i].key == a[i - 1].key || same->key == (same - 1)->key) continue;
        const auto before = std::lround(std::fabs(a[i - 1].key - (same - 1)->key)) % 12;
        const auto now = std::lround(std::fabs(a[i].key - same->key)) % 12;
        count += before == now && (now == 0 || now == 7) ? 1 : 0;
    }
    return count;
}

TEST(Chords, NoVoicesMoveInParallel) {
    for (const char* scale : {"major", "minor", "dorian", "harmonic minor", "phrygian", "mela 65"}) {
        for (const char* harmony :
             {"triads", "progression I-IV-V-I", "progression I-II-III-IV-V-VI-VII", "progression I-V-II-VI",
              "progression blues", "progression I-VI-IV-V7-I-IV-V-I"}) {
            const NoteList list = notes_of(fmt::format("{}scale: {}\nharmony: {}\n", hilbert, scale, harmony));
            const auto voices = by_voice(list);
            ASSERT_EQ(voices.size(), 4u) << harmony;
            for (int i = 1; i < 4; ++i) {
                for (int j = i + 1; j < 4; ++j) {
                    EXPECT_EQ(parallels(voices.at(i), voices.at(j)), 0) << scale << ", " << harmony;
                }
                // No voice leaps about: without parallels, seconds from chord to chord need leaps of fourths.
                double moves = 0;
                const std::vector<Note>& line = voices.at(i);
                for (std::size_t k = 1; k < line.size(); ++k) moves += std::fabs(line[k].key - line[k - 1].key);
                if (i > 1 && harmony[0] == 'p') {
                    EXPECT_LT(moves / static_cast<double>(line.size()), 6.5) << harmony;
                }
            }
            for (std::size_t k = 0; k < voices.at(1).size(); ++k) {
                EXPECT_LT(voices.at(1)[k].key, voices.at(2)[k].key);
                EXPECT_LT(voices.at(2)[k].key, voices.at(3)[k].key);
            }
        }
    }
    // Sevenths of a blues have their third and seventh above the bass, which change by a step at most.
    const auto voices = by_voice(notes_of(hilbert + "scale: blues\nharmony: progression blues\n"));
    for (int voice = 2; voice < 4; ++voice) {
        const std::vector<Note>& line = voices.at(voice);
        for (std::size_t k = 1; k < line.size(); ++k) EXPECT_LE(std::fabs(line[k].key - line[k - 1].key), 2) << k;
    }
}

/// Where scales lack thirds, chords are fifths, octaves or fourths, so that no two voices of neighbouring bars move
/// in parallel.
TEST(Chords, FifthsWithoutThirdsDoNotMoveInParallel) {
    int pairs = 0;
    for (const char* scale : {"blues", "major-blues", "major-pentatonic", "suspended-pentatonic", "raga-sivaranjani",
                              "raga-suddha-saveri", "slendro-equal", "in-sen", "kumoi", "messiaen-4"}) {
        for (const char* chords : {"I-IV-V-I", "I-II-V-I", "I-VI-II-V", "I-V-IV"}) {
            const NoteList list =
                notes_of(fmt::format("{}scale: {}\nharmony: progression {}\n", hilbert, scale, chords));
            std::map<std::int64_t, std::map<int, double>> bars;
            for (const Note& note : list.notes) {
                if (note.voice > 0) bars[note.onset / 1920][note.voice] = note.key;
            }
            for (const auto& [bar, keys] : bars) {
                const auto& before = bars[std::max<std::int64_t>(0, bar - 1)];
                for (const auto& [high, high_key] : keys) {
                    for (int low = 1; low < high; ++low) {
                        if (!before.contains(low) || !before.contains(high)) continue;
                        pairs += keys.size() == 2 ? 1 : 0;
                        if (before.at(low) == keys.at(low) || before.at(high) == high_key) continue;
                        const auto then = std::lround(before.at(high) - before.at(low)) % 12;
                        const auto now = std::lround(high_key - keys.at(low)) % 12;
                        EXPECT_FALSE(then == now && (now == 0 || now == 7)) << scale << ' ' << chords << ' ' << bar;
                    }
                }
            }
        }
    }
    EXPECT_GT(pairs, 300);
}

/// Where a note is held over bars, its chord sounds in each.
TEST(Chords, GoOnUnderLongNotes) {
    const std::string leaf = "axiom: X\nX --> F[+X][-X]FX\nF --> FF\nmapping: symbols\nderivation length: 5\n";
    for (const std::string& text :
         {leaf, leaf + "brackets: sequence\n", hilbert + "unit: 5/4\n", hilbert + "unit: 4/1\n"}) {
        const NoteList list = notes_of(text + "harmony: triads\n");
        int chords = 0;  // the first of their voices
        for (const Note& note : list.notes) chords = std::max(chords, note.voice - 2);
        std::map<std::int64_t, std::set<double>> bars;
        std::map<std::int64_t, std::int64_t> begins;  // onsets of the first voice by their bars
        for (const Note& note : list.notes) {
            if (note.voice >= chords) bars[note.onset / 1920].insert(note.key);
            if (note.voice == 0) begins[note.onset / 1920] = note.onset;
        }
        EXPECT_EQ(static_cast<std::int64_t>(bars.size()), list.end / 1920);
        for (const auto& [bar, keys] : bars) {
            ASSERT_EQ(keys.size(), 3u);
            if (begins.contains(bar)) continue;
            std::set<int> classes;
            std::set<int> before;
            for (const double key : keys) classes.insert(static_cast<int>(key) % 12);
            for (const double key : bars.at(bar - 1)) before.insert(static_cast<int>(key) % 12);
            EXPECT_EQ(classes, before) << bar;
        }
    }
}

TEST(Chords, FollowTheFirstVoiceThatSounds) {
    const std::string head = "title: T\nheading: 0\nmapping: symbols\nunit: 1/4\naxiom: ";
    const std::string line = "F+F+F+F-F--FF+F";
    for (const char* harmony : {"triads", "progression I-IV", "drone"}) {
        const auto accompaniment = [&](const std::string& axiom, int first) {
            std::vector<std::tuple<std::int64_t, std::int64_t, double>> notes;
            for (const Note& note : notes_of(fmt::format("{}{}\nharmony: {}\n", head, axiom, harmony)).notes) {
                if (note.voice >= first) notes.emplace_back(note.onset, note.duration, note.key);
            }
            return notes;
        };
        const auto alone = accompaniment(line, 1);
        EXPECT_FALSE(alone.empty());
        // The line itself is a voice, although it is silent.
        EXPECT_EQ(accompaniment("[" + line + "]", 2), alone) << harmony;
        EXPECT_EQ(accompaniment("[" + line + "][++FFFF]", 3), alone) << harmony;
    }
}

TEST(Chords, StrongBeatsAreThoseOfTheGroups) {
    for (const auto& [meter, beats] : {std::pair<std::string, std::vector<int>>{"3+2+2/8", {0, 3, 5}},
                                       {"7/8", {0, 3, 5}},
                                       {"4+2+2/8", {0, 4, 6}},
                                       {"6/8", {0, 3}},
                                       {"3/4", {0}},
                                       {"4/4", {0, 4}}}) {
        for (const char* harmony : {"triads", "progression I-IV-V-I"}) {
            const NoteList list = notes_of(fmt::format("{}meter: {}\nharmony: {}\n", hilbert, meter, harmony));
            const auto voices = by_voice(list);
            std::map<std::int64_t, std::set<int>> chords;
            const std::int64_t bar = list.meter.bar();
            for (int voice = 1; voice < 4; ++voice) {
                for (const Note& note : voices.at(voice)) {
                    chords[note.onset / bar].insert(static_cast<int>(note.key) % 12);
                }
            }
            int strong = 0;
            for (const Note& note : voices.at(0)) {
                const auto eighth = static_cast<int>(note.onset % bar / 240);
                if (note.onset % 240 != 0 || std::find(beats.begin(), beats.end(), eighth) == beats.end()) continue;
                ++strong;
                EXPECT_TRUE(chords[note.onset / bar].contains(static_cast<int>(note.key) % 12))
                    << meter << ' ' << note.onset / bar << ' ' << eighth;
            }
            EXPECT_GT(strong, 40) << meter;
        }
    }
}

/// A phrase ends on a tone of its chord, which is approached by step.
TEST(Chords, CadencesLeadToTheirTones) {
    const NoteList list = notes_of(hilbert + "phrases: 2\ncadence: alternate\nharmony: progression I-VI-IV-V\n");
    const auto voices = by_voice(list);
    const std::vector<std::set<int>> chords = {{0, 4, 7}, {9, 0, 4}, {5, 9, 0}, {7, 11, 2}};
    const std::vector<Note>& line = voices.at(0);
    int phrases = 0;
    int steps = 0;
    for (std::size_t i = 2; i < line.size(); ++i) {
        const bool is_last = i + 1 == line.size() || line[i + 1].onset > line[i].onset + line[i].duration;
        if (!is_last) continue;
        ++phrases;
        const bool is_end = i + 1 == line.size();
        const auto& chord = is_end ? chords[0] : chords[static_cast<std::size_t>(line[i].onset / 1920 % 4)];
        EXPECT_TRUE(chord.contains(static_cast<int>(line[i].key) % 12)) << i;
        // What begins on a strong beat before it belongs to its own chord.
        const bool is_free = line[i - 1].onset % 960 != 0;
        if (!is_free) continue;
        ++steps;
        const double step = std::fabs(line[i].key - line[i - 1].key);
        EXPECT_TRUE(step == 1 || step == 2) << i << ' ' << step;
    }
    EXPECT_GT(phrases, 50);
    EXPECT_GT(steps, 30);
}

TEST(Drones, ContinueEvenly) {
    const std::string text = hilbert + "harmony: drone\nphrases: 3\nbreath: 3/16\n";
    for (const char* more : {"", "form: A B A C A2\n", "retrograde: yes\n", "form: B A\nretrograde: yes\n"}) {
        const NoteList list = notes_of(text + more);
        const auto voices = by_voice(list);
        const std::vector<Note>& plucked = voices.at(1);
        const std::vector<Note>& low = voices.at(2);
        ASSERT_EQ(plucked.size(), 3 * low.size()) << more;
        for (std::size_t bar = 0; bar < low.size(); ++bar) {
            const auto begin = static_cast<std::int64_t>(bar) * 1920;
            EXPECT_EQ(low[bar].onset, begin) << more;
            EXPECT_EQ(low[bar].duration, 1920) << more;
            EXPECT_EQ(plucked[3 * bar].onset, begin) << more;
            EXPECT_EQ(plucked[3 * bar + 1].onset, begin + 480) << more;
            EXPECT_EQ(plucked[3 * bar + 2].onset, begin + 960) << more;
            EXPECT_EQ(static_cast<int>(plucked[3 * bar].key) % 12, 7) << more;
        }
        EXPECT_EQ(list.end, static_cast<std::int64_t>(low.size()) * 1920) << more;
        EXPECT_GE(list.end, voices.at(0).back().onset + voices.at(0).back().duration) << more;
    }
    // If a bar has three groups, they are plucked.
    for (const auto& [meter, plucks] : {std::pair<std::string, std::vector<int>>{"3+2+2/8", {0, 3, 5}},
                                        {"4+2+2/4", {0, 8, 12}},
                                        {"3/4", {0, 2, 4}},
                                        {"9/8", {0, 3, 6}},
                                        {"6/8", {0, 2, 4}},
                                        {"5/4", {0, 2, 4}},
                                        {"2/4", {0, 1, 2}}}) {
        const auto voices = by_voice(notes_of(text + "meter: " + meter + "\n"));
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(voices.at(1)[i].onset, plucks[i] * 240) << meter;
    }
}

TEST(Canons, BeginAfterFractionsOfBars) {
    const NoteList fraction = notes_of(hilbert + "canon: 1/2 7, 3/2 -12\n");
    const NoteList decimal = notes_of(hilbert + "canon: 0.5 7, 1.5 -12\n");
    ASSERT_EQ(fraction.notes.size(), decimal.notes.size());
    for (std::size_t i = 0; i < decimal.notes.size(); ++i) {
        EXPECT_EQ(fraction.notes[i].onset, decimal.notes[i].onset);
        EXPECT_EQ(fraction.notes[i].key, decimal.notes[i].key);
    }
}

TEST(Canons, ImitateExactly) {
    for (const char* interval : {"0", "-12", "7", "fifth below", "octave below", "third"}) {
        for (const char* range : {"fold", "fold C4-C5", "reflect C4-C5", "clamp E4-A5"}) {
            for (const char* harmony : {"none", "drone", "triads", "progression I-IV-V-I", "progression I-IV"}) {
                const std::string text =
                    fmt::format("{}range: {}\nharmony: {}\nphrases: 2\ncadence: alternate\ncanon: 2 {}\n",
                                hilbert.substr(0, hilbert.rfind("range")), range, harmony, interval);
                const NoteList list = notes_of(text);
                const auto voices = by_voice(list);
                const int last = voices.rbegin()->first;
                const std::vector<Note>& leader = voices.at(0);
                const std::vector<Note>& follower = voices.at(last);
                ASSERT_EQ(leader.size(), follower.size()) << text;
                std::set<double> apart;
                for (std::size_t i = 0; i < leader.size(); ++i) {
                    EXPECT_EQ(follower[i].onset - leader[i].onset, 2 * 1920);
                    EXPECT_EQ(follower[i].duration, leader[i].duration);
                    apart.insert(follower[i].key - leader[i].key);
                }
                // Intervals of the scale may be a semitone wider in one place than in another.
                EXPECT_LE(*apart.rbegin() - *apart.begin(), 1) << text;
                if (std::string(interval) == "-12") {
                    EXPECT_EQ(apart, std::set<double>{-12}) << text;
                }
            }
        }
    }
}

/// A melody with chords gives way to them.
TEST(Counterpoint, AdaptsToItsOwnChords) {
    const std::string text = hilbert + "harmony: progression I-VI-IV-V-I-IV-V-I\nrhythm: x.x.x.xxx..xx.~~\n";
    const auto faults = [](const NoteList& list) {
        const auto voices = by_voice(list);
        int count = 0;
        for (int voice = 1; voice < 4; ++voice) count += parallels(voices.at(0), voices.at(voice));
        return count;
    };
    EXPECT_GT(faults(notes_of(text)), 3);
    EXPECT_EQ(faults(notes_of(text + "counterpoint: strict\n")), 0);
}

}  // namespace sikku::harmony_test
