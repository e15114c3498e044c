// tests/music/form_test.cpp: phrases that begin at bar lines, endings, and basses of scores.
#include "music/scores.h"

#include "engine/check.h"
#include "music/arrangement.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::form_test {

const std::string hilbert = "title: H\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\n";
const std::string hilbert_4 = hilbert + "derivation length: 4\n";

NoteList notes_of(const std::string& text) {
    const Document document = parse("f.lsys", text);
    return list_notes({&document, 1}, {}, {});
}

std::vector<Note> of_voice(const NoteList& list, int voice) {
    std::vector<Note> notes;
    for (const Note& note : list.notes) {
        if (note.voice == voice) notes.push_back(note);
    }
    return notes;
}

std::int64_t end_of(const Note& note) {
    return note.onset + note.duration;
}

/// The phrases of a voice, separated by rests.
std::vector<std::vector<Note>> phrases_of(const std::vector<Note>& notes) {
    std::vector<std::vector<Note>> phrases;
    for (const Note& note : notes) {
        if (phrases.empty() || note.onset > end_of(phrases.back().back())) phrases.emplace_back();
        phrases.back().push_back(note);
    }
    return phrases;
}

TEST(Breath, LastsUntilTheBarLine) {
    // The sub-curves themselves: what a phrase has without a breath.
    std::vector<std::size_t> sizes;
    for (const auto& phrase : phrases_of(notes_of(hilbert_4 + "vertical: extend\nphrases: 2\nbreath: 2\n").notes)) {
        sizes.push_back(phrase.size());
    }
    ASSERT_EQ(sizes.size(), 16u);
    for (const auto& [breath, least] : {std::pair<std::string, int>{"bar", 0}, {"1/8 bar", 240}, {"1/2 bar", 960}}) {
        for (const char* meter : {"4/4", "3/4", "7/8"}) {
            const NoteList list = notes_of(
                fmt::format("{}vertical: extend\nphrases: 2\nbreath: {}\nmeter: {}\n", hilbert_4, breath, meter));
            const std::int64_t bar = list.meter.bar();
            std::size_t at = 0;
            for (std::size_t i = 0; i < sizes.size(); ++i) {
                const Note& first = list.notes[at];
                EXPECT_EQ(first.onset % bar, 0) << breath << meter << i;
                if (i > 0) {
                    const std::int64_t rest = first.onset - end_of(list.notes[at - 1]);
                    EXPECT_GE(rest, least);
                    EXPECT_LT(rest, least + bar);
                }
                at += sizes[i];
            }
            EXPECT_EQ(at, list.notes.size());
        }
    }
    // The rhythm begins with the phrase.
    for (const auto& phrase :
         phrases_of(notes_of(hilbert_4 + "phrases: 2\nbreath: 1/2 bar\nrhythm: Xx.xx.xx\n").notes)) {
        EXPECT_EQ(phrase.front().onset % 1920, 0);
        EXPECT_EQ(phrase.front().velocity, 96);
    }
    // Two voices begin together.
    const NoteList two = notes_of(hilbert_4 + "vertical: voice\nphrases: 2\nbreath: 1/4 bar\n");
    std::map<std::int64_t, std::set<int>> begins;
    for (int voice = 0; voice < 2; ++voice) {
        for (const Note& note : of_voice(two, voice)) {
            if (note.onset % 1920 == 0) begins[note.onset].insert(voice);
        }
    }
    EXPECT_EQ(std::count_if(begins.begin(), begins.end(), [](const auto& one) { return one.second.size() == 2; }),
              16);
    // Sections of forms are whole bars, those at the end of the curve, too.
    const NoteList form = notes_of(hilbert_4 + "vertical: extend\nphrases: 2\nbreath: 1/4 bar\nform: P A P\n");
    const std::vector<Note> notes = form.notes;
    const std::size_t first = sizes.back();
    ASSERT_EQ(notes.size(), 2 * first + sizes.front());
    EXPECT_EQ(notes[first].onset % 1920, 0);
    EXPECT_GE(notes[first].onset - end_of(notes[first - 1]), 480);
    EXPECT_EQ(notes[first + sizes.front()].onset % 1920, 0);
    EXPECT_EQ(form.end, end_of(notes.back()));
    for (const char* bad : {"bars", "0 bar", "1/8 bars", "x bar", "17 bar"}) {
        EXPECT_THROW(notes_of(hilbert_4 + "phrases: 2\nbreath: " + bad + "\n"), PatternError) << bad;
    }
}

/// In retrograde, forms are played from their ends; breaths and cadences stay behind their phrases.
TEST(Forms, InRetrogradeCloseAtTheEnd) {
    const std::string text = hilbert_4 + "vertical: extend\nphrases: 2\nbreath: 1/4 bar\nform: A B C\n";
    const NoteList plain = notes_of(text);
    const NoteList back = notes_of(text + "retrograde: yes\n");
    ASSERT_EQ(back.notes.size(), plain.notes.size());
    for (std::size_t i = 0; i < plain.notes.size(); ++i) {
        const Note& before = plain.notes[plain.notes.size() - 1 - i];
        EXPECT_EQ(back.notes[i].key, before.key) << i;
        EXPECT_EQ(back.notes[i].duration, before.duration) << i;
    }
    EXPECT_EQ(back.notes.front().onset, 0);
    const auto sizes = [](const NoteList& list) {
        std::vector<std::size_t> result;
        for (const auto& phrase : phrases_of(list.notes)) result.push_back(phrase.size());
        return result;
    };
    std::vector<std::size_t> reversed = sizes(plain);
    ASSERT_EQ(reversed.size(), 3u);
    std::reverse(reversed.begin(), reversed.end());
    EXPECT_EQ(sizes(back), reversed);
    // Chords do not move the breath.
    NoteList accompanied = notes_of(text + "harmony: triads\nretrograde: yes\n");
    accompanied.notes = of_voice(accompanied, 0);
    EXPECT_EQ(accompanied.notes.front().onset, 0);
    EXPECT_EQ(sizes(accompanied), reversed);
    for (const char* form : {"A B C", "B A", "A1 C A2", "A2 C A1", "A A B A"}) {
        const NoteList closed =
            notes_of(hilbert_4 + "tonic: C4\nscale: major\nphrases: 2\nbreath: 1/4 bar\ncadence: " +
                     "alternate\nretrograde: yes\nform: " + form + "\n");
        const bool is_open = std::string(form) == "A1 C A2";  // A1 is played last
        EXPECT_EQ(static_cast<int>(closed.notes.back().key) % 12, is_open ? 7 : 0) << form;
    }
}

/// A curve without end begins as its sub-curves do, and its first bars may be put in any order.
TEST(Excerpts, OfCurvesWithoutEnd) {
    for (const char* more : {"", "retrograde: yes\n", "loop: 3\n", "form: B A order 2\n", "harmony: triads\n",
                             "canon: 2 -12\ncounterpoint: strict\n"}) {
        const auto text = [&](int n) {
            return fmt::format("{}derivation length: {}\nexcerpt: 3-10\n{}", hilbert, n, more);
        };
        const MidiFile endless = read_midi(play(parse("f.lsys", text(40)), "mid"));
        const MidiFile other = read_midi(play(parse("f.lsys", text(8)), "mid"));
        ASSERT_GT(other.notes.size(), 5u) << more;
        ASSERT_EQ(endless.notes.size(), other.notes.size()) << more;
        for (std::size_t i = 0; i < other.notes.size(); ++i) {
            EXPECT_EQ(endless.notes[i].onset, other.notes[i].onset) << more << i;
            EXPECT_EQ(endless.notes[i].key, other.notes[i].key) << more << i;
        }
        // The report counts what is played.
        const Document document = parse("f.lsys", text(40));
        const std::string report = describe_score({&document, 1}, {}, {});
        const NoteList list = list_notes({&document, 1}, {}, {});
        const std::int64_t bars = (list.end + list.meter.bar() - 1) / list.meter.bar();
        EXPECT_TRUE(report.find(fmt::format("{} bars", bars)) != std::string::npos ||
                    report.find(fmt::format("bars      {}\n", bars)) != std::string::npos)
            << more << report;
        if (std::string(more).find("canon") != std::string::npos) continue;
        EXPECT_TRUE(has(report, fmt::format("notes     {}\n", list.notes.size()))) << more << report;
        EXPECT_FALSE(has(report, "together")) << more;
    }
}

/// The leaf of Worth & Stepney 2005. One branch after another it is one voice of 67 notes with seven values; of its
/// branches as voices, after five steps, nine pitches sound at once.
TEST(Branches, LeafOfWorthAndStepney) {
    const std::string leaf = "axiom: X\nX --> F[+X][-X]FX\nF --> FF\nmapping: symbols\nunit: 1/16\n";
    const NoteList list = notes_of(leaf + "derivation length: 4\nbrackets: sequence\n");
    EXPECT_EQ(list.notes.size(), 67u);
    std::set<std::int64_t> values;
    std::int64_t now = 0;
    for (const Note& note : list.notes) {
        EXPECT_EQ(note.voice, 0);
        EXPECT_EQ(note.onset, now);
        now = end_of(note);
        values.insert(note.duration);
    }
    EXPECT_EQ(values.size(), 7u);
    EXPECT_EQ(now / 960, 16);  // seconds, at 120 quarters a minute
    const NoteList naive = notes_of(leaf + "derivation length: 5\n");
    std::size_t most = 0;
    for (const Note& first : naive.notes) {
        std::set<double> keys;
        for (const Note& note : naive.notes) {
            if (note.onset <= first.onset && end_of(note) > first.onset) keys.insert(note.key);
        }
        most = std::max(most, keys.size());
    }
    EXPECT_EQ(most, 9u);
}

TEST(Forms, LastSubCurveRestsAsOthers) {
    // Played before another one, a sub-curve lasts the same whether or not the curve goes on after it.
    for (const char* body : {"FF+F-F+F-", "FF+F-ff", "Ff", "F+F+"}) {
        for (const char* rhythm : {"x~~", "xx~", "x.~~", "xxx~", "curve"}) {
            for (const char* breath : {"none", "1/4", "bar", "1/8 bar"}) {
                for (const char* mapping : {"runs", "counterpoint", "symbols"}) {
                    const auto played = [&](const char* axiom) {
                        return notes_of(
                            fmt::format("axiom: {}\nX --> {}\nheading: 0\nderivation length: 1\n"
                                        "unit: 1/4\nmapping: {}\nrhythm: {}\nphrases: 1\n"
                                        "breath: {}\nform: DA order 1\n",
                                        axiom, body, mapping, rhythm, breath));
                    };
                    const NoteList last = played("XXXX");
                    const NoteList inner = played("XXXXX");
                    const std::string place = fmt::format("{} {} {} {}", body, rhythm, breath, mapping);
                    ASSERT_EQ(last.notes.size(), inner.notes.size()) << place;
                    for (std::size_t i = 0; i < last.notes.size(); ++i) {
                        EXPECT_EQ(last.notes[i].onset, inner.notes[i].onset) << place << ' ' << i;
                        EXPECT_EQ(last.notes[i].duration, inner.notes[i].duration) << place << ' ' << i;
                    }
                }
            }
        }
    }
}

TEST(Forms, AlternateCadencesCloseOnTheTonic) {
    for (const char* form : {"AABA", "A", "ABC", "BA", "ABA1"}) {
        for (const char* more : {"", "harmony: triads\n", "harmony: progression I-IV-V-I\n", "range: reflect C4-C5\n",
                                 "scale: blues\n", "ending: fermata\n"}) {
            const NoteList list =
                notes_of(hilbert_4 + fmt::format("form: {}\nphrases: 2\ncadence: alternate\n{}", form, more));
            const bool is_open = std::string(form).ends_with('1');
            const double last = of_voice(list, 0).back().key;
            EXPECT_EQ(std::fmod(last - 60 + 48, 12), is_open ? 7 : 0) << form << ' ' << more;
            if (std::string(more).find("harmony") == std::string::npos) continue;
            // The last chord contains the note, and a tonic is its root.
            const auto bass = of_voice(list, 1).back();
            EXPECT_GE(end_of(bass), end_of(of_voice(list, 0).back()));
            std::set<double> classes;
            for (const int voice : {1, 2, 3}) classes.insert(std::fmod(of_voice(list, voice).back().key, 12));
            EXPECT_TRUE(classes.contains(std::fmod(last, 12))) << form << ' ' << more;
            if (!is_open) {
                EXPECT_EQ(std::fmod(bass.key, 12), 0) << form << ' ' << more;
            }
        }
    }
}

TEST(Forms, ChordsBeginWithSectionsAndNotInRests) {
    for (const char* form : {"AABA", "ABCD", "BD"}) {
        for (const char* rhythm : {"curve", "x.xx", "xx~"}) {
            const NoteList list =
                notes_of(hilbert_4 +
                         fmt::format("form: {} order 2\nharmony: triads\nbreath: 1/4\nrhythm: {}\n", form, rhythm));
            const std::vector<Note> melody = of_voice(list, 0);
            const std::vector<Note> bass = of_voice(list, 1);
            ASSERT_FALSE(bass.empty());
            const bool has_rests = std::string(rhythm).find('~') != std::string::npos;
            for (const Note& chord : bass) {
                const bool is_heard = std::any_of(melody.begin(), melody.end(), [&](const Note& note) {
                    return note.onset <= chord.onset && end_of(note) > chord.onset;
                });
                EXPECT_TRUE(is_heard || has_rests) << form << ' ' << rhythm << " at " << chord.onset;
                EXPECT_GE(chord.duration, 480) << form << ' ' << rhythm << " at " << chord.onset;
            }
            if (has_rests) continue;
            for (const auto& section : phrases_of(melody)) {
                const bool begins = std::any_of(bass.begin(), bass.end(), [&](const Note& chord) {
                    return chord.onset == section.front().onset;
                });
                EXPECT_TRUE(begins) << form << ' ' << rhythm << " at " << section.front().onset;
            }
        }
    }
}

TEST(Forms, EndingsOfSectionsKeepBranches) {
    // Voices of branches come before those of chords, and their notes are those of a plain section.
    const auto read = [](const char* form) {
        const std::string text = fmt::format(
            "form = \"{}\"\n[[track]]\nsection = \"A\"\npattern = \"plant\"\nharmony = \"triads\"\n", form);
        const Arrangement piece = read_arrangement("a.toml", text, [](const std::string& name) {
            return NamedPattern{
                name, "title: P\nheading: 0\nmapping: symbols\nunit: 1/4\naxiom: F+F[+F+FFF]F[-FF-F]+F+F\n"};
        });
        return list_notes(piece, {}, {});
    };
    const NoteList plain = read("A");
    const NoteList closed = read("A2");
    int voices = 0;
    for (const Note& note : plain.notes) voices = std::max(voices, note.voice + 1);
    ASSERT_EQ(voices, 6);
    for (const int voice : {1, 2}) {
        const std::vector<Note> before = of_voice(plain, voice);
        const std::vector<Note> after = of_voice(closed, voice);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].key, after[i].key);
    }
    EXPECT_EQ(std::fmod(of_voice(closed, 0).back().key, 12), 0);
    EXPECT_EQ(std::fmod(of_voice(closed, 3).back().key, 12), 0);
}

TEST(Forms, MessagesNameOrders) {
    const auto refusal = [](const std::string& text) -> std::string {
        return error_of<std::runtime_error>([&] { notes_of(hilbert_4 + text); }, "none");
    };
    const auto expect = [&](const std::string& text, const char* expected) {
        EXPECT_TRUE(has(refusal(text), expected)) << text << ": " << refusal(text);
    };
    expect("phrases: 2\nform: AABA order 3\n", "the orders must agree: 'phrases:' has 2 and the form 3");
    expect("form: Q order 3\n", "`form: A B order 2`");
    expect("form: Q order 2\n", "has 16 sub-curves of order 2");
    expect("form: Q order 2\nharmony: triads\nrhythm: x.xx\n", "`form: A B order 1`");
    expect("phrases: 9\nform: AB\n", "1 sub-curve of order 9, that of 'phrases:'");
    expect("phrases: 9\nform: AB\n", "`phrases: 3`");
    expect("form: AABA\nexcerpt: 100-200\n", "the excerpt contains no notes: the melody ends at bar ");
}

TEST(Forms, CheckReportsWhatCannotBePlayed) {
    const Interpreter* const interpreters[] = {&scores()};
    const auto check = [&](const std::string& text) {
        std::string found;
        for (const Diagnostic& one : check_pattern("f.lsys", text, interpreters, {})) found += one.text() + "\n";
        return found;
    };
    const std::string grown = "title: T\nderivation length: 3\naxiom: A(1)\nA(x) --> FA(x+1)\n";
    EXPECT_EQ(check(grown), "");
    EXPECT_EQ(check(grown + "cadence: tonic\n"), "");
    EXPECT_TRUE(has(check(grown + "cadence: tonic\nphrases: 2\n"), "f.lsys:6:1: "));
    EXPECT_TRUE(has(check(grown + "form: AABA\n"), "f.lsys:5:1: "));
    EXPECT_TRUE(has(check(grown + "velocity: by level\n"), "f.lsys:5:1: "));
    // No sub-curve has that order.
    EXPECT_EQ(check(grown + "phrases: 4\n"), "");
    EXPECT_NO_THROW(notes_of(grown + "heading: 0\nphrases: 4\n"));
    EXPECT_EQ(check(hilbert_4 + "phrases: 2\nform: AABA\nvelocity: by level\n"), "");
    const std::string plant = "title: P\nderivation length: 2\naxiom: F\nF --> F[+F]F\n";
    EXPECT_TRUE(has(check(plant + "cadence: tonic\n"), "f.lsys:5:1: "));
    EXPECT_EQ(check(plant + "cadence: tonic\nbrackets: sequence\n"), "");
}

TEST(Endings, LastNotesAreHeld) {
    const auto ends = [](const std::string& text) {
        const NoteList plain = notes_of(text + "ending: ritardando\n");
        const NoteList held = notes_of(text + "ending: fermata\n");
        EXPECT_EQ(held.notes.size(), plain.notes.size()) << text;
        const std::int64_t bar = held.meter.bar();
        EXPECT_EQ(held.end % bar, 0) << text;
        EXPECT_GE(held.end, plain.end) << text;
        EXPECT_LE(held.end, plain.end + 2 * bar) << text;
        int longer = 0;
        for (std::size_t i = 0; i < plain.notes.size(); ++i) {
            EXPECT_EQ(held.notes[i].onset, plain.notes[i].onset);
            EXPECT_EQ(held.notes[i].key, plain.notes[i].key);
            if (held.notes[i].duration == plain.notes[i].duration) continue;
            ++longer;
            EXPECT_EQ(end_of(held.notes[i]), held.end) << text;
            EXPECT_GE(held.notes[i].duration, bar / 2);
        }
        return longer;
    };
    EXPECT_EQ(ends(hilbert_4), 1);
    EXPECT_EQ(ends(hilbert_4 + "meter: 7/8\nunit: 1/16\n"), 1);
    EXPECT_GE(ends(hilbert_4 + "vertical: voice\n"), 1);
    EXPECT_GE(ends(hilbert_4 + "harmony: triads\n"), 1);
    EXPECT_EQ(ends(hilbert_4 + "canon: 1 -12\ncounterpoint: strict\n"), 2);
    // The voice that was there first has ended long ago.
    EXPECT_EQ(ends(hilbert_4 + "canon: 5 -12\n"), 1);
    EXPECT_EQ(ends(hilbert_4 + "form: AABA\n"), 1);
    // Drums are not held, and notes that ended before the last one are not either.
    const std::string table =
        "title: T\naxiom: [AACB][kkkkk]\nmapping: symbols\nnote A: C4 1/4\nnote B: D4 1/8\n"
        "chord C: C4 E4 G4 1/8\ndrum k: bass drum 1/8\n";
    EXPECT_EQ(ends(table), 1);
    // A piece has no more bars than were asked for.
    const Document document = parse("f.lsys", hilbert_4 + "ending: fermata\n");
    EXPECT_EQ(list_notes({&document, 1}, {{"bars", "3"}}, {}).end, 3 * 1920);
    // Files and streams hold the same notes, whatever is shaped by the curve.
    const std::string shaped =
        hilbert_4 + "ending: fermata\nvelocity: by y\npan: by x\nharmony: progression I-IV-V-I\n";
    const MidiFile file = read_midi(play(parse("f.lsys", shaped), "mid"));
    const NoteList list = notes_of(shaped);
    ASSERT_EQ(file.notes.size(), list.notes.size());
    std::multiset<std::pair<std::int64_t, std::int64_t>> found;
    std::multiset<std::pair<std::int64_t, std::int64_t>> expected;
    for (const MidiNote& note : file.notes) found.emplace(note.onset, note.duration);
    for (const Note& note : list.notes) expected.emplace(note.onset, note.duration);
    EXPECT_EQ(found, expected);
}

TEST(Basses, OfWordsAnglesAndForms) {
    // 243 notes of the arrowhead over 27.
    const std::string arrowhead =
        "title: A\nangle factor: 6\naxiom: YF\nX --> YF+XF+Y\nY --> XF-YF-X\nmapping: symbols\n";
    const NoteList list = notes_of(arrowhead + "derivation length: 5\nharmony: bass 2\n");
    const std::vector<Note> bass = of_voice(list, 1);
    ASSERT_EQ(bass.size(), 27u);
    std::vector<double> coarse;
    for (const Note& note : notes_of(arrowhead + "derivation length: 3\n").notes) {
        coarse.push_back(note.key - 24);
    }
    for (std::size_t i = 0; i < bass.size(); ++i) {
        EXPECT_EQ(bass[i].onset, static_cast<std::int64_t>(i) * 9 * 240);
        EXPECT_EQ(bass[i].key, coarse[i]);
    }
    // A range moves with the bass.
    for (const Note& note : of_voice(notes_of(hilbert_4 + "range: reflect C4-C5\nharmony: bass\n"), 1)) {
        EXPECT_GE(note.key, 36);
        EXPECT_LE(note.key, 48);
    }
    // Sections end together, and what is repeated is the same again.
    const NoteList form = notes_of(hilbert + "derivation length: 5\nharmony: bass\nform: A1 A2 B A2\n");
    const std::vector<Note> upper = of_voice(form, 0);
    const std::vector<Note> lower = of_voice(form, 1);
    EXPECT_EQ(end_of(upper.back()), end_of(lower.back()));
    const auto starts = [](const std::vector<Note>& notes, std::int64_t tick) {
        return std::any_of(notes.begin(), notes.end(), [&](const Note& note) { return note.onset == tick; });
    };
    // A section of Hilbert's curve of order 5 has 64 steps, perhaps one more or less.
    int borders = 0;
    for (std::int64_t section = 1; section < 4; ++section) {
        for (std::int64_t tick = (64 * section - 3) * 240; tick <= (64 * section + 3) * 240; tick += 240) {
            borders += starts(upper, tick) && starts(lower, tick) ? 1 : 0;
        }
    }
    EXPECT_EQ(borders, 3);
    EXPECT_THROW(notes_of(hilbert_4 + "harmony: bass\nform: AB\nphrases: 2\n"), ScoreError);
    EXPECT_THROW(notes_of(hilbert_4 + "harmony: bass\nvertical: voice\n"), ScoreError);
    EXPECT_THROW(notes_of("axiom: F[+F]F\nF --> FF\nderivation length: 3\nharmony: bass\n"), ScoreError);
}

}  // namespace sikku::form_test
