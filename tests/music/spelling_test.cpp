#include "music/score/spelling.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace sikku::spelling_test {

Scale scale_of(const std::string& id, const std::vector<double>& semitones, std::vector<double> descent = {}) {
    Scale scale;
    scale.id = id;
    scale.ascent = semitones;
    scale.descent = descent.empty() ? semitones : std::move(descent);
    for (double& value : scale.ascent) value *= 100.0;
    for (double& value : scale.descent) value *= 100.0;
    return scale;
}

Spelling tonic_of(const std::string& name) {
    return parse_note(name)->spelling;
}

/// `C Eb F`: how the notes of the scale are written, by ascending pitch.
std::string written(const Scale& scale, const std::string& tonic, const std::vector<double>& semitones) {
    const auto spelling = spell(scale, tonic_of(tonic));
    std::string result;
    for (const double above : semitones) {
        const std::string name = note_name(parse_note(tonic)->key + above, spelling);
        result += (result.empty() ? "" : " ") + name.substr(0, name.find_first_of("-0123456789"));
    }
    return result;
}

std::string written(const std::string& id, const std::string& tonic, const std::vector<double>& semitones) {
    return written(scale_of(id, semitones), tonic, semitones);
}

const std::vector<double> major = {0, 2, 4, 5, 7, 9, 11};
const std::vector<double> minor = {0, 2, 3, 5, 7, 8, 10};
const std::vector<double> dorian = {0, 2, 3, 5, 7, 9, 10};

TEST(Spelling, SevenNotesHaveSevenLetters) {
    EXPECT_EQ(written("major", "C", major), "C D E F G A B");
    EXPECT_EQ(written("major", "F#", major), "F# G# A# B C# D# E#");
    EXPECT_EQ(written("major", "Gb", major), "Gb Ab Bb Cb Db Eb F");
    EXPECT_EQ(written("major", "Cb", major), "Cb Db Eb Fb Gb Ab Bb");
    EXPECT_EQ(written("major", "G#", major), "G# A# B# C# D# E# F##");
    EXPECT_EQ(written("dorian", "D", dorian), "D E F G A B C");
    EXPECT_EQ(written("minor", "C#", minor), "C# D# E F# G# A B");
    EXPECT_EQ(written("harmonic-minor", "A", {0, 2, 3, 5, 7, 8, 11}), "A B C D E F G#");
    EXPECT_EQ(written("phrygian-dominant", "E", {0, 1, 4, 5, 7, 8, 10}), "E F G# A B C D");
    // The raga Mayamalavagowla, and the melakarta Kanakangi and Rasikapriya with their narrow steps.
    EXPECT_EQ(written("mela-15", "C", {0, 1, 4, 5, 7, 8, 11}), "C Db E F G Ab B");
    EXPECT_EQ(written("mela-1", "C", {0, 1, 2, 5, 7, 8, 9}), "C Db Ebb F G Ab Bbb");
    EXPECT_EQ(written("mela-72", "C", {0, 3, 4, 6, 7, 10, 11}), "C D# E F# G A# B");
}

TEST(Spelling, EveryModeOfEveryTonicUsesEachLetterOnce) {
    for (const char* tonic : {"C", "G", "D", "A", "E", "B", "F#", "C#", "F", "Bb", "Eb", "Ab", "Db", "Gb", "Cb"}) {
        for (const auto& steps : {major, minor, dorian}) {
            const auto spelling = spell(scale_of("x", steps), tonic_of(tonic));
            std::set<int> letters;
            for (const double step : steps) {
                const int found = (static_cast<int>(parse_note(tonic)->key + step) % 12 + 12) % 12;
                letters.insert(spelling[static_cast<std::size_t>(found)].letter);
            }
            EXPECT_EQ(letters.size(), 7u) << tonic;
        }
    }
}

TEST(Spelling, TheDescentKeepsTheLettersOfItsDegrees) {
    const Scale melodic = scale_of("melodic-minor", {0, 2, 3, 5, 7, 9, 11}, {0, 2, 3, 5, 7, 8, 10});
    EXPECT_EQ(written(melodic, "A", {0, 2, 3, 5, 7, 8, 9, 10, 11}), "A B C D E F F# G G#");
    // Five up, seven down.
    const Scale bilahari = scale_of("raga-bilahari", {0, 2, 4, 7, 9}, {0, 2, 4, 5, 7, 9, 11});
    EXPECT_EQ(written(bilahari, "Db", {0, 2, 4, 5, 7, 9, 11}), "Db Eb F Gb Ab Bb C");
}

TEST(Spelling, OtherScalesLieAroundTheTonic) {
    EXPECT_EQ(written("blues", "C", {0, 3, 5, 6, 7, 10}), "C Eb F Gb G Bb");
    EXPECT_EQ(written("blues", "E", {0, 3, 5, 6, 7, 10}), "E G A Bb B D");
    EXPECT_EQ(written("major-pentatonic", "D", {0, 2, 4, 7, 9}), "D E F# A B");
    EXPECT_EQ(written("minor-pentatonic", "F", {0, 3, 5, 7, 10}), "F Ab Bb C Eb");
    EXPECT_EQ(written("hirajoshi", "C", {0, 2, 3, 7, 8}), "C D Eb G Ab");
    EXPECT_EQ(written("iwato", "C", {0, 1, 5, 6, 10}), "C Db F Gb Bb");
    EXPECT_EQ(written("chinese", "C", {0, 4, 6, 7, 11}), "C E F# G B");
    EXPECT_EQ(written("whole-tone", "C", {0, 2, 4, 6, 8, 10}), "C D E F# Ab Bb");
}

TEST(Spelling, FewerOrMoreNotesThanSevenHaveNoSignsOnEBCF) {
    const std::vector<std::vector<double>> lists = {{0, 3, 5, 6, 7, 10},
                                                    {0, 2, 4, 7, 9},
                                                    {0, 3, 5, 7, 10},
                                                    {0, 1, 4, 5, 8, 9},
                                                    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
    for (int letter = 0; letter < 7; ++letter) {
        for (int alteration = -2; alteration <= 2; ++alteration) {
            for (const auto& list : lists) {
                const auto spelling = spell(scale_of("x", list), {letter, alteration});
                for (int found = 0; found < 12; ++found) {
                    const Spelling entry = spelling[static_cast<std::size_t>(found)];
                    EXPECT_EQ((letter_semitones(entry.letter) + entry.alteration + 12) % 12, found);
                    EXPECT_LE(std::abs(entry.alteration), 1);
                    const bool half_step_above = entry.letter == 2 || entry.letter == 6;
                    const bool half_step_below = entry.letter == 0 || entry.letter == 3;
                    EXPECT_FALSE(entry.alteration > 0 && half_step_above);
                    EXPECT_FALSE(entry.alteration < 0 && half_step_below);
                }
            }
        }
    }
}

TEST(Spelling, EveryPitchClassIsItself) {
    for (int letter = 0; letter < 7; ++letter) {
        for (int alteration = -2; alteration <= 2; ++alteration) {
            for (const auto& list : {major, minor, dorian}) {
                const auto spelling = spell(scale_of("x", list), {letter, alteration});
                for (int found = 0; found < 12; ++found) {
                    const Spelling entry = spelling[static_cast<std::size_t>(found)];
                    EXPECT_EQ((letter_semitones(entry.letter) + entry.alteration + 24) % 12, found);
                    EXPECT_LE(std::abs(entry.alteration), 2);
                }
            }
        }
    }
}

TEST(Spelling, QuarterTonesHaveTheLetterOfTheirDegree) {
    // Rast: E half flat and B half flat, so that both E and Eb are the degree's.
    const auto spelling = spell(scale_of("rast", {0, 2, 3.5, 5, 7, 9, 10.5}), {0, 0});
    for (const int found : {3, 4}) EXPECT_EQ(spelling[static_cast<std::size_t>(found)].letter, 2);
    for (const int found : {10, 11}) EXPECT_EQ(spelling[static_cast<std::size_t>(found)].letter, 6);
}

TEST(KeySignature, OfMajorMinorAndTheModes) {
    const auto fifths = [](const std::vector<double>& steps, const std::string& tonic) {
        const auto key = key_signature(scale_of("x", steps), tonic_of(tonic));
        return key ? key->fifths : 99;
    };
    EXPECT_EQ(fifths(major, "C"), 0);
    EXPECT_EQ(fifths(major, "F#"), 6);
    EXPECT_EQ(fifths(major, "C#"), 7);
    EXPECT_EQ(fifths(major, "Cb"), -7);
    EXPECT_EQ(fifths(major, "G#"), 99);
    EXPECT_EQ(fifths(minor, "A"), 0);
    EXPECT_EQ(fifths(minor, "C"), -3);
    EXPECT_EQ(fifths(minor, "D#"), 6);
    EXPECT_EQ(fifths(minor, "Cb"), 99);
    // The white keys from each of the seven letters.
    EXPECT_EQ(fifths(dorian, "D"), 0);
    EXPECT_EQ(fifths({0, 1, 3, 5, 7, 8, 10}, "E"), 0);
    EXPECT_EQ(fifths({0, 2, 4, 6, 7, 9, 11}, "F"), 0);
    EXPECT_EQ(fifths({0, 2, 4, 5, 7, 9, 10}, "G"), 0);
    EXPECT_EQ(fifths({0, 1, 3, 5, 6, 8, 10}, "B"), 0);
    EXPECT_TRUE(key_signature(scale_of("x", minor), {5, 0})->minor);
    EXPECT_FALSE(key_signature(scale_of("x", dorian), {1, 0})->minor);
    EXPECT_FALSE(key_signature(scale_of("x", major), {0, 0})->minor);
}

TEST(KeySignature, OfNothingElse) {
    const auto has_key = [](const Scale& scale) { return key_signature(scale, {0, 0}).has_value(); };
    EXPECT_FALSE(has_key(scale_of("harmonic-minor", {0, 2, 3, 5, 7, 8, 11})));
    EXPECT_FALSE(has_key(scale_of("blues", {0, 3, 5, 6, 7, 10})));
    EXPECT_FALSE(has_key(scale_of("major-pentatonic", {0, 2, 4, 7, 9})));
    EXPECT_FALSE(has_key(scale_of("rast", {0, 2, 3.5, 5, 7, 9, 10.5})));
    EXPECT_FALSE(has_key(scale_of("melodic-minor", {0, 2, 3, 5, 7, 9, 11}, {0, 2, 3, 5, 7, 8, 10})));
    EXPECT_FALSE(has_key(scale_of("bilahari", {0, 2, 4, 7, 9}, {0, 2, 4, 5, 7, 9, 11})));
    Scale stretched = scale_of("x", major);
    stretched.period = 1902;
    EXPECT_FALSE(has_key(stretched));
    // Just major is major.
    EXPECT_TRUE(has_key(scale_of("just", {0, 2.0391, 3.8631, 4.9804, 7.0196, 8.8436, 10.8827})));
}

TEST(Notes, HaveNames) {
    const auto flats = spell(scale_of("blues", {0, 3, 5, 6, 7, 10}), {0, 0});
    EXPECT_EQ(note_name(60, flats), "C4");
    EXPECT_EQ(note_name(82, flats), "Bb5");
    EXPECT_EQ(note_name(0, flats), "C-1");
    EXPECT_EQ(note_name(127, flats), "G9");
    EXPECT_EQ(note_name(60.4, flats), "C4");
    EXPECT_EQ(note_name(54, spell(scale_of("major", major), {4, 0})), "F#3");
    // The octave is the letter's: Cb4 sounds as B3, B#3 as C4.
    EXPECT_EQ(note_name(59, spell(scale_of("major", major), {4, -1})), "Cb4");
    EXPECT_EQ(note_name(60, spell(scale_of("major", major), {0, 1})), "B#3");
}

TEST(Notes, AreReadBack) {
    const auto key = [](const char* text) { return parse_note(text)->key; };
    EXPECT_EQ(key("C4"), 60);
    EXPECT_EQ(key("c4"), 60);
    EXPECT_EQ(key("F#3"), 54);
    EXPECT_EQ(key("Bb"), 70);
    EXPECT_EQ(key("bb"), 70);
    EXPECT_EQ(key("Eb5"), 75);
    EXPECT_EQ(key("A4"), 69);
    EXPECT_EQ(key("C-1"), 0);
    EXPECT_EQ(key("G9"), 127);
    EXPECT_EQ(key("B9"), 131);
    EXPECT_EQ(key("Cb-1"), -1);
    EXPECT_EQ(key("B#3"), 60);
    EXPECT_EQ(key("F##4"), 67);
    EXPECT_EQ(key("Bbb"), 69);
    EXPECT_EQ(key("D\u266F4"), 63);
    EXPECT_EQ(key("D\u266D4"), 61);
    EXPECT_EQ(parse_note("Eb5")->spelling.letter, 2);
    EXPECT_EQ(parse_note("Eb5")->spelling.alteration, -1);
    for (const auto& tonic : {"C", "F#", "Gb", "Db", "G#"}) {
        const auto spelling = spell(scale_of("major", major), tonic_of(tonic));
        for (int i = 3; i <= 127; ++i) EXPECT_EQ(parse_note(note_name(i, spelling))->key, i);
    }
}

TEST(Notes, AreNothingElse) {
    for (const char* bad : {"", "H", "4", "C 4", " C4", "C4 ", "C10", "C-2", "C#b", "Cb#", "C###", "Cbbb", "C4.5",
                            "CC", "C+4", "C--1", "261.63", "C\u266F\u266F", "Cx"}) {
        EXPECT_FALSE(parse_note(bad)) << bad;
    }
}

TEST(Spelling, PrintHasSignaturesForMoreScales) {
    const auto signature = [](const std::string& id, const std::string& tonic) {
        const auto found = print_signature(*find_scale(id), parse_note(tonic)->spelling);
        return found ? std::to_string(found->fifths) + " " + std::to_string(static_cast<int>(found->mode)) : "none";
    };
    EXPECT_EQ(signature("major", "D"), "2 1");
    EXPECT_EQ(signature("dorian", "D"), "0 3");
    EXPECT_EQ(signature("minor", "A"), "0 4");
    EXPECT_EQ(signature("harmonic-minor", "D"), "-1 4");
    EXPECT_EQ(signature("major-pentatonic", "G"), "1 1");
    EXPECT_EQ(signature("minor-pentatonic", "D"), "-1 4");
    EXPECT_EQ(signature("blues", "C"), "-3 4");
    EXPECT_EQ(signature("raga-bilahari", "D"), "2 1");
    EXPECT_EQ(signature("raga-hamsadhwani", "D"), "2 1");
    EXPECT_EQ(signature("todi-that", "C"), "-4 5");
    EXPECT_EQ(signature("whole-tone", "C"), "none");
    EXPECT_EQ(signature("chromatic", "C"), "none");
    EXPECT_EQ(signature("shruti", "C"), "none");
}

}  // namespace sikku::spelling_test
