// tests/music/rhythm_test.cpp: ghost notes, chance, repetitions, and rhythms and rests by level.
#include "music/melody/rhythm_template.h"
#include "music/scores.h"

#include "engine/check.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::rhythm_test {

constexpr std::int64_t unit = 240;

/// Two to the n steps, each a note; each sub-curve has half of the steps of the next one.
std::string steps(int n) {
    return fmt::format(
        "title: S\naxiom: F\nF --> F+F\nangle increment: 90\nderivation length: {}\n"
        "mapping: symbols\nruns: each step\n",
        n);
}

NoteList notes_of(const std::string& text, const std::string& from_bar = "") {
    const Document document = parse("r.lsys", text);
    OptionValues values;
    if (!from_bar.empty()) values.push_back({"from-bar", from_bar});
    return list_notes({&document, 1}, values, {});
}

/// Slots of a template: x, X, o, with `?` for chance.
std::string slots_of(const std::string& text) {
    std::string problem;
    const RhythmTemplate rhythm = read_rhythm_template(text, problem);
    std::string slots(static_cast<std::size_t>(rhythm.slots), '~');
    for (const RhythmTemplate::Hit& hit : rhythm.hits) {
        for (std::int64_t i = 0; i < hit.length; ++i) slots[static_cast<std::size_t>(hit.onset + i)] = '.';
        slots[static_cast<std::size_t>(hit.onset)] = "xXo"[static_cast<std::size_t>(hit.stress)];
    }
    for (const RhythmTemplate::Hit& hit : rhythm.hits) {
        if (hit.percent < 100) slots += fmt::format(" {}:{}", hit.onset, hit.percent);
    }
    return slots;
}

std::string problem_of(const std::string& text) {
    std::string problem;
    return read_rhythm_template(text, problem).empty() ? problem : "";
}

TEST(Templates, HaveGhostNotesChanceAndRepetitions) {
    EXPECT_EQ(slots_of("Xo.x"), "Xo.x");
    EXPECT_EQ(slots_of("x?x?30.X?99~o?"), "xx.X~o 0:50 1:30 3:99 5:50");
    EXPECT_EQ(slots_of("(x.x.)3 xxXo"), "x.x.x.x.x.x.xxXo");
    EXPECT_EQ(slots_of("(x(o.)2 x)2~"), "xo.o.xxo.o.x~");
    EXPECT_EQ(slots_of("(x?10)2.."), "xx.. 0:10 1:10");
    EXPECT_EQ(slots_of("(x.)128").size(), 256u);
    for (const char* bad : {"(x.", "x)", "x?0", "x?100", "x?99999999999", "(.x)2", "x()2", "(x)0", "(x.)129",
                            "((((((((((x))))))))))", "?x", "x??", "(E(3,8))2", "o.x2"}) {
        EXPECT_EQ(slots_of(bad), "") << bad;
    }
    EXPECT_EQ(problem_of("(x."), "this `(` is not closed");
    EXPECT_EQ(problem_of("x?100"), "a note sounds with a probability of 1 to 99 percent, as in x?30");
    for (const char* bad : {"(x.)129", "(x)0", "(x.) 3", "(x.)"}) {
        EXPECT_EQ(problem_of(bad), "a part is repeated 1 to 256 times, as in (x.)3, within 256 slots") << bad;
    }
    EXPECT_EQ(problem_of(""), "a template begins with x, X or o and has up to 256 slots");
}

TEST(GhostNotes, AreSofterThanOthersByAFixedVelocity) {
    std::vector<int> velocities;
    for (const Note& note : notes_of(steps(3) + "rhythm: Xxox\n").notes) velocities.push_back(note.velocity);
    EXPECT_EQ(velocities, (std::vector<int>{96, 80, 48, 80, 96, 80, 48, 80}));
}

/// The slots that sound.
std::set<std::int64_t> sounding(const NoteList& list, std::int64_t ticks = unit) {
    std::set<std::int64_t> slots;
    for (const Note& note : list.notes) slots.insert(note.onset / ticks);
    return slots;
}

TEST(Chance, SilencesNotesAsOftenAsStated) {
    // Of 4096 slots with probability p, p ± 4 standard deviations sound.
    for (const int percent : {5, 30, 50, 90}) {
        const auto heard =
            static_cast<double>(notes_of(steps(12) + fmt::format("seed: 3\nrhythm: x?{}\n", percent)).notes.size());
        const double p = percent / 100.0;
        EXPECT_NEAR(heard, 4096 * p, 4 * std::sqrt(4096 * p * (1 - p))) << percent;
    }
    // Others always sound.
    const std::set<std::int64_t> slots = sounding(notes_of(steps(10) + "rhythm: xx?~\n"));
    for (std::int64_t slot = 0; slot < 512; ++slot) EXPECT_EQ(slots.count(3 * slot), 1u) << slot;
    EXPECT_GT(slots.size(), 700u);
    EXPECT_LT(slots.size(), 820u);
}

TEST(Chance, IsThatOfTheSeedInExcerptsAugmentationsAndCanons) {
    const std::string text = steps(9) + "rhythm: xx?x?o?30\n";
    const std::set<std::int64_t> slots = sounding(notes_of(text));
    EXPECT_EQ(slots, sounding(notes_of(text)));
    EXPECT_NE(slots, sounding(notes_of(text + "seed: 1\n")));
    // From bar 20 on, of eight slots each.
    std::set<std::int64_t> later;
    for (const std::int64_t slot : sounding(notes_of(text, "20"))) later.insert(slot + std::int64_t{19} * 8);
    EXPECT_EQ(later, std::set<std::int64_t>(slots.lower_bound(std::int64_t{19} * 8), slots.end()));
    EXPECT_EQ(slots, sounding(notes_of(text + "augmentation: 2\n"), 2 * unit));
    // The voice that follows plays the same.
    std::map<int, std::set<std::int64_t>> voices;
    for (const Note& note : notes_of(text + "canon: 2 7\n").notes) voices[note.voice].insert(note.onset);
    ASSERT_EQ(voices.size(), 2u);
    for (const std::int64_t onset : voices[0]) EXPECT_EQ(voices[1].count(onset + std::int64_t{16} * unit), 1u);
    EXPECT_EQ(voices[0].size(), voices[1].size());
}

TEST(Chance, FollowsTheSlotsOfSlopingSteps) {
    // Sums of cosines miss whole steps slightly.
    const std::string text =
        "title: S\naxiom: F\nF --> F+F-F\nangle increment: 25.7\nderivation length: 6\nruns: each step\n";
    const auto velocities = [&](const std::string& rhythm) {
        std::vector<int> all;
        for (const Note& note : notes_of(text + "rhythm: " + rhythm + "\n").notes) all.push_back(note.velocity);
        return all;
    };
    const std::vector<int> stressed = velocities("Xo");
    ASSERT_GT(stressed.size(), 600u);
    for (std::size_t i = 0; i < stressed.size(); ++i) EXPECT_EQ(stressed[i], i % 2 == 0 ? 96 : 48) << i;
    // Every other note sounds always.
    EXPECT_GE(velocities("xx?1").size(), stressed.size() / 2);
    EXPECT_LE(velocities("xx?1").size(), stressed.size() / 2 + 20);
}

TEST(Chance, OfAllNotesIsReported) {
    const std::string said = error_of([] { notes_of("axiom: F\nheading: 0\nrhythm: x?1\nseed: 1\n"); });
    EXPECT_NE(said.find("chance silences all of them"), std::string::npos) << said;
    // The length is known as before; the number of notes is not.
    const Document document =
        parse("h.lsys", "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 60\nrhythm: x?\n");
    EXPECT_NE(describe_score({&document, 1}, {}, {}).find("notes     at most "), std::string::npos);
}

/// Rests between notes, in units.
std::vector<std::int64_t> rests_of(const NoteList& list) {
    std::vector<std::int64_t> rests;
    for (std::size_t i = 1; i < list.notes.size(); ++i) {
        const Note& before = list.notes[i - 1];
        const std::int64_t rest = list.notes[i].onset - before.onset - before.duration;
        if (rest > 0) rests.push_back(rest / unit);
    }
    return rests;
}

TEST(Levels, MakeRestsLongerAfterLargerSubCurves) {
    // The powers of two that divide the number of the phrase: the ruler.
    const std::vector<std::int64_t> ruler = {1, 2, 1, 3, 1, 2, 1};
    EXPECT_EQ(rests_of(notes_of(steps(4) + "phrases: 1\nbreath: 1/8 by level\n")), ruler);
    // With notes by the curve, by two voices, and by a table.
    const std::string curve = "title: S\naxiom: F\nF --> FF\nderivation length: 4\nruns: each step\nheading: 0\n";
    EXPECT_EQ(rests_of(notes_of(curve + "phrases: 1\nbreath: 1/8 by level\n")), ruler);
    const std::string table =
        "title: S\naxiom: A\nA --> AA\nderivation length: 4\nmapping: symbols\nnote A: C4 1/8\n";
    EXPECT_EQ(rests_of(notes_of(table + "phrases: 1\nbreath: 1/8 by level\n")), ruler);
    std::vector<std::int64_t> doubled;
    for (const std::int64_t rest : ruler) doubled.push_back(2 * rest);
    EXPECT_EQ(rests_of(notes_of(table + "phrases: 1\nbreath: 1/4 by level\n")), doubled);
    // An excerpt begins as in the whole.
    const NoteList whole = notes_of(steps(7) + "phrases: 2\nbreath: 1/8 by level\n");
    const NoteList part = notes_of(steps(7) + "phrases: 2\nbreath: 1/8 by level\n", "9");
    const std::int64_t from = std::int64_t{8} * 8 * unit;
    std::set<std::int64_t> expected;
    std::set<std::int64_t> found;
    for (const Note& note : whole.notes) {
        if (note.onset >= from) expected.insert(note.onset - from);
    }
    for (const Note& note : part.notes) found.insert(note.onset);
    EXPECT_EQ(found, expected);
}

/// A word with marks: the order of each sub-curve that ends.
std::string marked(const std::map<char, std::string>& rules, const std::string& word, int n) {
    std::string result;
    for (const char symbol : word) {
        const auto rule = rules.find(symbol);
        result += rule == rules.end() || n == 0 ? std::string(1, symbol) : marked(rules, rule->second, n - 1);
        if (rule != rules.end() && n > 0) result += std::to_string(n);
    }
    return result;
}

TEST(Levels, CountOnlySubCurvesThatEndWithTheirPhrases) {
    // Some sub-curves of the dragon end with further steps.
    const std::map<char, std::string> rules = {{'X', "X+YF+"}, {'Y', "-FX-Y"}};
    for (const int order : {1, 2, 3}) {
        std::vector<std::int64_t> expected;
        int largest = 0;
        bool has_phrase = false;
        bool has_sounded = false;
        for (const char symbol : marked(rules, "FX", 6)) {
            if (symbol == 'F') {
                if (has_phrase && has_sounded) expected.push_back(1 + largest - order);
                has_sounded = true;
                has_phrase = false;
                largest = 0;
            } else if (symbol >= '1' && symbol <= '9') {
                has_phrase = has_phrase || symbol - '0' == order;
                largest = std::max(largest, symbol - '0');
            }
        }
        ASSERT_GT(expected.size(), 5u);
        EXPECT_EQ(rests_of(notes_of(fmt::format(
                      "axiom: FX\nX --> X+YF+\nY --> -FX-Y\nderivation length: 6\nmapping: symbols\nruns: each step\n"
                      "phrases: {}\nbreath: 1/8 by level\n",
                      order))),
                  expected)
            << order;
    }
}

TEST(Levels, ChooseRhythms) {
    // The first phrase begins the whole curve, the others sub-curves as the ruler says.
    const NoteList list = notes_of(steps(4) + "phrases: 1\nbreath: none\nrhythm: xx / Xx / ox by level\n");
    std::string first;
    for (std::size_t i = 0; i < list.notes.size(); i += 2) {
        first += list.notes[i].velocity == 96 ? 'X' : list.notes[i].velocity == 48 ? 'o' : 'x';
    }
    EXPECT_EQ(first, "oxXxoxXx");
    for (const auto& [keys, message] :
         {std::pair<std::string, std::string>{"phrases: 1\nrhythm: xx by level\n", "expected several rhythms"},
          {"rhythm: xx / x. by level\n", "several rhythms need `phrases: k`"},
          {"phrases: 1\nbreath: by level\n", "expected a note value"},
          {"phrases: 1\nbreath: none by level\n", "has a note value"},
          {"phrases: 1\nbreath: bar by level\n", "has a note value"}}) {
        const std::string said = error_of([&, &bad = keys] { notes_of(steps(4) + bad); });
        EXPECT_NE(said.find(message), std::string::npos) << keys << said;
    }
}

}  // namespace sikku::rhythm_test
