#include "engine/base/keys.h"

#include <algorithm>
#include <array>

namespace sikku {
namespace {

using enum KeyOwner;

constexpr std::array language = {
    KeyInfo{"axiom", engine, "a word", "an error", "Initial word"},
    KeyInfo{"derivation length", engine, "a whole number, 0 or more", "0", "Number of derivation steps, n"},
    KeyInfo{"angle factor", engine, "a whole number k, 1 or more", "",
            "Angle increment as 360/k degrees, exactly; excludes `angle increment`"},
    KeyInfo{"angle increment", engine, "degrees such as 25.7 or 360/7", "90", "Angle by which `+` and `-` turn"},
    KeyInfo{"turn", engine, "right, left", "right", "Direction in which `+` turns"},
    KeyInfo{"heading", engine, "degrees", "90", "Initial heading, anticlockwise from the x axis"},
    KeyInfo{"tropism", engine, "three numbers", "none", "Force that bends segments: see `elasticity`"},
    KeyInfo{"elasticity", engine, "a number", "0",
            "Turn after each segment, in radians for each unit of segment x force"},
    KeyInfo{"forward", engine, "symbols", "F", "Symbols that draw a step"},
    KeyInfo{"move", engine, "symbols", "f", "Symbols that move a step without drawing"},
    KeyInfo{"ignore", engine, "symbols", "none", "Symbols that context matching ignores; excludes `consider`"},
    KeyInfo{"consider", engine, "symbols", "all", "The only symbols that context matching sees"},
    KeyInfo{"symbols", engine, "names", "none", "Names of several characters, each one symbol"},
    KeyInfo{"schedule", engine, "tables with counts, such as grow*(n-2) decorate*2", "the only table in every step",
            "Table applied in each step"},
    KeyInfo{"seed", engine, "a whole number", "0", "Seed of random choices"},
    KeyInfo{"scale factor", engine, "a percentage", "100", "Share of the page that a fitted drawing fills"},
    KeyInfo{"title", engine, "text", "", "Title of prints and scores"},
    KeyInfo{"source", engine, "text", "", "Publication the system comes from"},
    KeyInfo{"description", engine, "text", "", "Remarks"},

    KeyInfo{"line", art, "straight, spline, spline with lifts", "straight",
            "Straight segments, or a uniform cubic B-spline over all positions of the turtle"},
    KeyInfo{"hand", art, "a number from 0 to 1", "0",
            "Lines as rice flour falls from a hand: how much they waver and swell"},
    KeyInfo{"stroke", art, "a width and a colour such as 0.4mm #fff or 0.2 step white; none", "0.4mm black",
            "Width of the pen in mm (or cm, in, pt, px) or in steps, and its colour"},
    KeyInfo{"ground", art, "a colour, none", "white", "Colour of the page; none is transparent"},
    KeyInfo{"fill", art, "a colour", "the palette's first, or the stroke's",
            "Colour of polygons and discs with colour index 0"},
    KeyInfo{"palette", art, "colours", "eight colours", "Colours of the indices 0, 1, 2 …, repeated from the end"},
    KeyInfo{"dots", art, "a size and a colour such as 0.2 step white; none", "none", "Dots of a kolam"},
    KeyInfo{"border", art, "kaavi, padi, lotus, rope, diamonds, waves; a pattern file, or two; none", "none",
            "Frame around the drawing; of pattern files, the first is repeated, the second stands in the corners"},
    KeyInfo{"view", art, "AZIMUTH ELEVATION [perspective [DISTANCE]]; front, side, top", "front",
            "Direction from which a drawing in space is seen, in degrees around and up"},

    KeyInfo{"scale", music, "a name, or a Scala file such as x.scl", "major", "Scale of the melody"},
    KeyInfo{"keyboard", music, "a Scala key map such as x.kbm", "none", "Key map that gives all pitches"},
    KeyInfo{"tonic", music, "C4, F#3, Bb, or a frequency", "C4", "Pitch of degree 0"},
    KeyInfo{"anchor", music, "first note, piece, lowest note, lowest vertex, centre", "first note",
            "Height of the curve that sounds the tonic"},
    KeyInfo{"unit", music, "a note value such as 1/16, up to 16 whole notes", "1/8", "Duration of a step"},
    KeyInfo{"vertical", music, "ignore, rest, extend, glissando, voice", "ignore", "Meaning of a vertical run"},
    KeyInfo{"runs", music, "merged, each step", "merged", "One note for a straight run, or for each step"},
    KeyInfo{"sloped", music, "project, skip, refuse", "project", "Treatment of runs that slope"},
    KeyInfo{"range", music, "fold, reflect, clamp, refuse; fold C2-C7", "fold",
            "Treatment of notes outside the keys of MIDI, or outside the given range"},
    KeyInfo{"tempo", music, "quarters a minute", "120", "Tempo"},
    KeyInfo{"velocity", music, "fixed, by turn, by depth, by length", "fixed", "What decides how loud a note is"},
    KeyInfo{"mapping", music, "runs, counterpoint, symbols", "runs", "Reading of the curve as notes"},
    KeyInfo{"meter", music, "4/4, 7/8", "4/4", "Meter"},
    KeyInfo{"instrument", music, "a General MIDI name or number", "piano", "Instrument"},
};

}  // namespace

std::span<const KeyInfo> language_keys() {
    return language;
}

const KeyInfo* find_language_key(std::string_view name) {
    const auto* found =
        std::find_if(language.begin(), language.end(), [&](const KeyInfo& key) { return key.name == name; });
    return found == language.end() ? nullptr : found;
}

std::vector<std::string_view> keys_of(KeyOwner owner) {
    std::vector<std::string_view> names;
    for (const KeyInfo& key : language) {
        if (key.owner == owner) names.push_back(key.name);
    }
    return names;
}

}  // namespace sikku
