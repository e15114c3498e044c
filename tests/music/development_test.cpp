// tests/music/development_test.cpp: sections of a form that are changed, and the place of the highest note.
#include "music/scores.h"

#include "engine/check.h"
#include "music/arrangement.h"
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
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::development_test {

const std::string hilbert =
    "title: H\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nderivation length: 4\n"
    "phrases: 2\nbreath: none\n";

NoteList notes_of(const std::string& text) {
    const Document document = parse("d.lsys", text);
    return list_notes({&document, 1}, {}, {});
}

/// Degrees above C4 in C major.
std::int64_t degree_of(double key) {
    const auto semitones = static_cast<std::int64_t>(std::lround(key)) - 60;
    const std::int64_t octave = (semitones >= 0 ? semitones : semitones - 11) / 12;
    static const std::map<std::int64_t, std::int64_t> major = {{0, 0}, {2, 1}, {4, 2}, {5, 3},
                                                               {7, 4}, {9, 5}, {11, 6}};
    return 7 * octave + major.at(semitones - 12 * octave);
}

/// Onset, end and degree of each note.
using Told = std::vector<std::tuple<std::int64_t, std::int64_t, std::int64_t>>;
Told told(const NoteList& list) {
    Told all;
    for (const Note& note : list.notes) all.emplace_back(note.onset, note.onset + note.duration, degree_of(note.key));
    std::sort(all.begin(), all.end());
    return all;
}
Told form(const std::string& sections, const std::string& more = "") {
    return told(notes_of(hilbert + "form: " + sections + "\n" + more));
}

/// What `change` makes of each note.
template <class Change>
Told changed(Told notes, Change change) {
    for (auto& [onset, end, degree] : notes) change(onset, end, degree);
    std::sort(notes.begin(), notes.end());
    return notes;
}

TEST(Sections, AreMovedInvertedReversedAndStretched) {
    for (const char* section : {"A", "B", "F"}) {
        const Told plain = form(section);
        ASSERT_GT(plain.size(), 5u);
        const std::int64_t first = std::get<2>(plain.front());
        const std::int64_t last = std::get<1>(plain.back());
        EXPECT_EQ(form(fmt::format("{}+2", section)),
                  changed(plain, [](auto&, auto&, auto& degree) { degree += 2; }));
        EXPECT_EQ(form(fmt::format("{}-9", section)),
                  changed(plain, [](auto&, auto&, auto& degree) { degree -= 9; }));
        EXPECT_EQ(form(fmt::format("{}i", section)),
                  changed(plain, [&](auto&, auto&, auto& degree) { degree = 2 * first - degree; }));
        EXPECT_EQ(form(fmt::format("{}r", section)), changed(plain, [&](auto& onset, auto& end, auto&) {
                      onset = last - std::exchange(end, last - onset);
                  }));
        EXPECT_EQ(form(fmt::format("{}*3", section)), changed(plain, [](auto& onset, auto& end, auto&) {
                      onset *= 3;
                      end *= 3;
                  }));
        EXPECT_EQ(form(fmt::format("{}/2", section)), changed(plain, [](auto& onset, auto& end, auto&) {
                      onset /= 2;
                      end /= 2;
                  }));
        // All at once: reversed, then mirrored at the note that is first now, and moved.
        const std::int64_t axis = std::get<2>(plain.back());
        EXPECT_EQ(form(fmt::format("{}ri*2+3", section)), changed(plain, [&](auto& onset, auto& end, auto& degree) {
                      onset = 2 * (last - std::exchange(end, 2 * (last - onset)));
                      degree = 2 * axis - degree + 3;
                  }));
    }
}

TEST(Sections, FollowOneAnotherAtBarLines) {
    // A sequence: each a degree higher than the one before, a whole number of bars later.
    const Told all = form("A A+1 A+2");
    const Told one = form("A");
    ASSERT_EQ(all.size(), 3 * one.size());
    const std::int64_t bars = (std::get<1>(one.back()) + 1919) / 1920;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto times = static_cast<std::int64_t>(i / one.size());
        const auto& [onset, end, degree] = one[i % one.size()];
        EXPECT_EQ(std::get<0>(all[i]), onset + times * bars * 1920) << i;
        EXPECT_EQ(std::get<2>(all[i]), degree + times) << i;
    }
    // Endings come after changes; a form in retrograde reverses what is reversed.
    for (const char* sections : {"Ai", "A+1 ", "Ar", "A/2 ", "A"}) {
        EXPECT_EQ((std::get<2>(form(sections + std::string("2")).back()) + 70) % 7, 0) << sections;
        EXPECT_EQ((std::get<2>(form(sections + std::string("1")).back()) + 70) % 7, 4) << sections;
    }
    EXPECT_EQ(form("Ar", "retrograde: yes\n"), form("A"));
    // A range holds.
    for (const auto& [onset, end, degree] : form("A+5 A+9 Ai", "range: fold C4-C5\n")) {
        EXPECT_GE(degree, 0);
        EXPECT_LE(degree, 7);
    }
    for (const char* range : {"reflect C4-D5", "clamp C4-D5"}) {
        const Told bounded = form("A+13", fmt::format("range: {}\n", range));
        for (const auto& [onset, end, degree] : bounded) {
            EXPECT_GE(degree, 0);
            EXPECT_LE(degree, 8);
        }
        // All are beyond the range: mirrored they still move, clamped they do not.
        std::set<std::int64_t> degrees;
        for (const auto& [onset, end, degree] : bounded) degrees.insert(degree);
        EXPECT_EQ(degrees.size() == 1, range[0] == 'c') << range;
    }
    EXPECT_NE(error_of([] { form("A+13", "range: refuse C4-D5\n"); }).find("beyond the keys 60 to 74"),
              std::string::npos);
}

/// A korvai is played three times; the test finds the pause by trying all.
TEST(Sections, CloseWithACoda) {
    for (const char* section : {"A", "B", "D"}) {
        const std::string slow = "unit: 1/4\n";
        const Told plain = form(section, slow);
        const std::int64_t bars = (std::get<1>(plain.back()) + 1919) / 1920;
        ASSERT_GE(bars, 2);
        Told expected;
        for (const auto& [onset, end, degree] : plain) {
            const std::int64_t first = (bars - 2) * 1920, last = (bars - 1) * 1920;
            if (end > first) expected.emplace_back(std::max<std::int64_t>(0, onset - first), end - first, degree);
            if (end <= last) continue;
            expected.emplace_back(2 * 1920 + 2 * std::max<std::int64_t>(0, onset - last), 2 * 1920 + 2 * (end - last),
                                  degree);
        }
        std::sort(expected.begin(), expected.end());
        const Told coda = form(std::string(section) + "c", slow);
        // The last notes lead to the tonic.
        EXPECT_EQ((std::get<2>(coda.back()) + 70) % 7, 0) << section;
        ASSERT_EQ(coda.size(), expected.size()) << section;
        for (std::size_t i = 0; i < coda.size(); ++i) {
            EXPECT_EQ(std::get<0>(coda[i]), std::get<0>(expected[i])) << section << i;
            EXPECT_EQ(std::get<1>(coda[i]), std::get<1>(expected[i])) << section << i;
            if (i + 3 < coda.size()) {
                EXPECT_EQ(std::get<2>(coda[i]), std::get<2>(expected[i])) << section << i;
            }
        }
        // Chords end with the melody.
        const NoteList chords = notes_of(hilbert + slow + "harmony: triads\nform: A " + section + "c\n");
        std::int64_t melody_end = 0;
        for (const Note& note : chords.notes) {
            if (note.voice == 0) melody_end = std::max(melody_end, note.onset + note.duration);
        }
        EXPECT_EQ(chords.end, melody_end) << section;
        // It begins at the bar line after the section.
        EXPECT_EQ(std::get<0>(form(std::string(section) + section + "c", slow)[plain.size()]), bars * 1920)
            << section;
    }
}

TEST(Sections, EndAKorvaiOnTheDownbeat) {
    for (const char* meter : {"4/4", "3/4", "5/8", "7/8"}) {
        const std::int64_t bar = meter[2] == '4' ? (meter[0] - '0') * 480 : (meter[0] - '0') * 240;
        const std::string keys = fmt::format("meter: {}\n", meter);
        for (const char* section : {"A", "B", "F"}) {
            const Told plain = form(section, keys);
            const std::int64_t length = std::get<1>(plain.back());
            std::int64_t rest = bar, pause = 0;
            for (std::int64_t tried = 240; tried < bar; tried += 240) {
                std::int64_t before = 0;
                while ((before + 3 * length + 2 * tried) % bar != 0) before += 240;
                if (before < rest) std::tie(rest, pause) = std::pair(before, tried);
            }
            Told expected;
            for (std::int64_t i = 0; i < 3; ++i) {
                for (auto [onset, end, degree] : plain) {
                    const std::int64_t later = rest + i * (length + pause);
                    expected.emplace_back(onset + later, end + later, degree);
                }
            }
            const std::int64_t end = std::get<1>(expected.back());
            ASSERT_EQ(end % bar, 0);
            Told landed = form(section + std::string("k"), keys);
            ASSERT_EQ(landed.size(), expected.size() + 1);
            // The tonic is held for a bar.
            const auto [onset, until, degree] = landed.back();
            EXPECT_EQ(onset, end);
            EXPECT_EQ(until, end + bar);
            EXPECT_EQ((degree + 70) % 7, 0);
            EXPECT_LE(std::abs(degree - std::get<2>(expected.back())), 3);
            landed.pop_back();
            EXPECT_EQ(landed, expected) << meter << section;
            // In the middle the next section follows at once.
            const Told middle = form(section + std::string("k C"), keys);
            EXPECT_EQ(std::get<0>(middle[expected.size()]), end);
        }
    }
    EXPECT_EQ(form("Ak+2").size(), form("Ak").size());
    EXPECT_NE(error_of([] { form("Akk"); }).find("a korvai"), std::string::npos);
}

TEST(Thinning, KeepsBeatsThenStrongBeats) {
    for (const char* meter : {"4/4", "3/4", "2+3/8"}) {
        const bool is_additive = meter[1] == '+';
        const std::int64_t bar = is_additive ? 1200 : (meter[0] - '0') * 480;
        const std::string keys = fmt::format("meter: {}\nunit: 1/16\n", meter);
        const Told one = form("A", keys);
        const std::int64_t length = (std::get<1>(one.back()) + bar - 1) / bar * bar;
        for (const double share : {0.3, 0.5, 1.0}) {
            const Told plain = form("A B", keys);
            const Told thin = form("A B", keys + fmt::format("thinning: {}\n", share));
            Told expected;
            for (std::size_t i = 0; i < plain.size(); ++i) {
                const auto& [onset, end, degree] = plain[i];
                const bool is_second = onset >= length;
                const std::int64_t begin = is_second ? length : 0;
                const std::int64_t stop = std::get<1>(is_second ? plain.back() : one.back());
                const bool is_last = i + 1 == plain.size() || (!is_second && std::get<0>(plain[i + 1]) >= length);
                const double left = static_cast<double>(stop - onset) / static_cast<double>(stop - begin);
                const std::int64_t place = onset % bar;
                const bool is_beat = is_additive ? place == 0 || place == 480 : place % 480 == 0;
                const bool is_strong = is_additive ? is_beat : place == 0 || (meter[0] == '4' && place == 960);
                if (left > share || is_last || (left > share / 2 ? is_beat : is_strong)) {
                    expected.push_back(plain[i]);
                } else if (!expected.empty() && std::get<1>(expected.back()) == onset &&
                           (std::get<0>(expected.back()) >= length) == is_second) {
                    std::get<1>(expected.back()) = end;
                }
            }
            EXPECT_LE(expected.size(), share > 0.3 ? plain.size() - 1 : plain.size());
            EXPECT_EQ(thin, expected) << meter << share;
        }
        EXPECT_EQ(form("A B", keys + "thinning: none\n"), form("A B", keys));
    }
    const auto said = [](const std::string& more) { return error_of([&] { notes_of(hilbert + more); }); };
    EXPECT_NE(said("thinning: 2\n").find("from 0 to 1"), std::string::npos);
    EXPECT_NE(said("thinning: 0.5\nvertical: glissando\n").find("cannot be combined"), std::string::npos);
    EXPECT_NE(error_of([] { notes_of("axiom: F+F\nthinning: 0.5\n"); }).find("needs 'phrases:'"), std::string::npos);
    EXPECT_NE(said("form: Ak\nharmony: bass 1\n").find("a korvai cannot be combined"), std::string::npos);
    // Chords stay.
    const auto chords = [](const std::string& more) {
        const NoteList list = notes_of(hilbert + "harmony: triads\n" + more);
        return std::count_if(list.notes.begin(), list.notes.end(), [](const Note& note) { return note.voice > 0; });
    };
    EXPECT_EQ(chords("thinning: 0.5\n"), chords(""));
}

TEST(Sections, KeepTheDirectionOfRagas) {
    // Melodic minor: a repeated note sounds like the one before it.
    const std::string text =
        "axiom: X\nX --> F-FF+F-F+F\nmapping: symbols\nruns: each step\nderivation length: 1\n"
        "scale: melodic minor\ntonic: C4\n";
    const auto keys = [&](const std::string& more) {
        std::vector<double> all;
        for (const Note& note : notes_of(text + more).notes) all.push_back(note.key);
        return all;
    };
    std::vector<double> higher = keys("form: A order 1\n");
    EXPECT_EQ(higher, keys(""));
    for (double& key : higher) key += 12;
    EXPECT_EQ(keys("form: A+7 order 1\n"), higher);
    EXPECT_EQ(keys("phrases: 1\nclimax: 0\n"), keys(""));
}

TEST(Sections, OtherFormsAreRefused) {
    for (const char* bad : {"A+", "A+0", "A+128", "Aii", "Arr", "A*1", "A/0", "A*17", "A*2/2", "+1", "A+1-1", "a"}) {
        EXPECT_NE(error_of([&] { form(bad); }).find("expected the order of sub-curves"), std::string::npos) << bad;
    }
    EXPECT_NE(error_of([] { form("A A+1", "harmony: triads\n"); }).find("the chords would stay"), std::string::npos);
    EXPECT_NE(form("A Ar", "harmony: triads\n").size(), 0u);
    const auto read = [](const std::string& sections) {
        return read_arrangement("p.toml",
                                "form = \"" + sections +
                                    "\"\n[[track]]\npattern = \"h\"\nsection = \"A\"\n[[pattern]]\nname = \"h\"\n"
                                    "text = '''\naxiom: F\n'''\n",
                                [](const std::string&) -> NamedPattern { throw std::runtime_error("no file"); });
    };
    EXPECT_NE(error_of([&] { read("A A+1"); }).find("the `form` of a track"), std::string::npos);
    EXPECT_EQ(error_of([&] { read("A A2"); }), "");
}

/// The phrase that has the highest note, if no other has one as high; and the number of phrases.
std::pair<int, int> highest_phrase(const Told& notes, std::int64_t phrase) {
    std::map<std::int64_t, std::int64_t> highest;
    for (const auto& [onset, end, degree] : notes) {
        highest[onset / phrase] = std::max(highest.try_emplace(onset / phrase, degree).first->second, degree);
    }
    std::vector<std::pair<std::int64_t, std::int64_t>> order;
    for (const auto& [number, degree] : highest) order.emplace_back(degree, number);
    std::sort(order.rbegin(), order.rend());
    const bool is_one = order.size() < 2 || order[0].first > order[1].first;
    return {is_one ? static_cast<int>(order[0].second) : -1, static_cast<int>(highest.size())};
}

TEST(Climax, ComesAtItsPlace) {
    // Phrases of four bars each, with 16 notes: one for each step.
    const std::string text =
        "title: S\naxiom: F\nF --> F+F-F-F+F\nangle increment: 90\nmapping: symbols\nruns: each step\nunit: 1/8\n"
        "derivation length: 3\nphrases: 1\nbreath: none\n";
    const Told plain = told(notes_of(text));
    constexpr std::int64_t phrase = std::int64_t{5} * 240;
    for (const double share : {0.0, 0.2, 0.5, 0.6, 0.85, 1.0}) {
        const Told raised = told(notes_of(text + fmt::format("climax: {}\n", share)));
        ASSERT_EQ(raised.size(), plain.size());
        const auto [place, count] = highest_phrase(raised, phrase);
        ASSERT_EQ(count, 25);
        EXPECT_GE(place, std::floor((share - 0.05) * count) - 1) << share;
        EXPECT_LE(place, std::ceil((share + 0.05) * count)) << share;
        // A phrase keeps its shape, and no note sinks.
        std::map<std::int64_t, std::set<std::int64_t>> moved;
        for (std::size_t i = 0; i < plain.size(); ++i) {
            EXPECT_EQ(std::get<0>(plain[i]), std::get<0>(raised[i]));
            moved[std::get<0>(plain[i]) / phrase].insert(std::get<2>(raised[i]) - std::get<2>(plain[i]));
        }
        for (const auto& [number, by] : moved) {
            EXPECT_EQ(by.size(), 1u) << number;
            EXPECT_GE(*by.begin(), 0) << number;
            EXPECT_LE(2 * *by.begin(), number == place ? 28 : *moved[place].begin()) << number;
        }
    }
    EXPECT_EQ(told(notes_of(text + "climax: none\n")), plain);
    const Told sections = form("A B A B", "climax: 0.3\n");
    EXPECT_EQ(highest_phrase(sections, 1920).first, 1);
}

TEST(Climax, IsRefusedWhereItCannotBe) {
    const auto said = [](const std::string& more) { return error_of([&] { notes_of(hilbert + more); }); };
    EXPECT_NE(said("climax: 2\n").find("from 0 to 1"), std::string::npos);
    EXPECT_NE(said("climax: nan\n").find("from 0 to 1"), std::string::npos);
    EXPECT_NE(said("climax: 0.5\nharmony: triads\n").find("the chords would stay"), std::string::npos);
    EXPECT_NE(said("climax: 0.5\nrange: fold C4-D4\n").find("a wider `range`"), std::string::npos);
    EXPECT_NE(error_of([] { notes_of("axiom: F+F\nclimax: 0.5\n"); }).find("needs 'phrases:'"), std::string::npos);
    // A single phrase is the highest.
    EXPECT_EQ(told(notes_of("axiom: F+F\nphrases: 1\nheading: 0\nclimax: 0.5\n")),
              told(notes_of("axiom: F+F\nphrases: 1\nheading: 0\n")));
    // No notes, no climax.
    EXPECT_NE(error_of([] { notes_of("axiom: +\nphrases: 1\nclimax: 1\n"); }), "");
    EXPECT_NE(said("climax: 1\nexcerpt: 400-500\n").find("the excerpt contains no notes"), std::string::npos);
    EXPECT_NE(said("climax: 1\nvertical: glissando\n").find("cannot be moved"), std::string::npos);
    EXPECT_NE(said("form: A/7\n").find("whole numbers of ticks"), std::string::npos);
}

}  // namespace sikku::development_test
