#include "engine/base/keys.h"

#include "engine/base/text.h"

#include <string>
#include <unordered_map>

namespace sikku {
namespace {

using enum KeyOwner;

constexpr bool names_any_file(std::string_view value) {
    return !value.empty() && value != "none";
}
bool names_scale_file(std::string_view value) {
    return lower_case(value).ends_with(".scl");
}
/// One pattern file or two, separated by a comma; other names are those of bundled borders and patterns.
bool names_border_file(std::string_view value) {
    return lower_case(value).find(".lsys") != std::string::npos;
}

constexpr KeyInfo language[] = {
    {"axiom", engine, "a word", "an error", "Initial word", KeyScope::all},
    {"derivation length", engine, "a whole number, 0 or more", "0", "Number of derivation steps, n", KeyScope::all},
    {"angle factor", engine, "a whole number k, 1 or more", "",
     "Angle increment as 360/k degrees, exactly; excludes `angle increment`"},
    {"angle increment", engine, "degrees such as 25.7 or 360/7", "90", "Angle by which `+` and `-` turn"},
    {"turn", engine, "right, left", "right", "Direction in which `+` turns"},
    {"heading", engine, "degrees", "90", "Initial heading, anticlockwise from the x axis"},
    {"tropism", engine, "three numbers", "none", "Force that bends segments: see `elasticity`"},
    {"elasticity", engine, "a number", "0", "Turn after each segment, in radians for each unit of segment x force"},
    {"forward", engine, "symbols", "F", "Symbols that draw a step"},
    {"move", engine, "symbols", "f", "Symbols that move a step without drawing"},
    {"edge SYMBOL", engine, "a word of moves and turns such as -f++f-", "",
     "Length of a straight step: from the start to the end of the word, exactly"},
    {"mirror", engine, "pairs of symbols such as A a B b", "none",
     "Symbols that are mirror images: one of a pair has the productions of the other, with left and right "
     "exchanged"},
    {"polygons", engine, "outline, framework", "outline",
     "Vertices of polygons: where `{` stands and the end of each step, or the marks on a framework of branches"},
    {"edges", engine, "two symbols such as ? #", "none",
     "Symbols that begin and end an inserted edge, instead of what else they mean"},
    {"surface", engine, "NAME = FILE, such as leaf = leaf.s; several with commas", "none",
     "Surface files of cpfg (.s), beside the pattern, for `~NAME`", KeyScope::words, names_any_file},
    {"label SYMBOL", engine, "a text such as {1} or A({1}, {2})", "",
     "Text that a symbol writes, upright, with its middle at the turtle; {1}, {2} … are its parameters"},
    {"lettering", engine, "a number of steps", "0.4", "Height of the capital letters of labels"},
    {"ignore", engine, "symbols", "none", "Symbols that context matching ignores; excludes `consider`"},
    {"consider", engine, "symbols", "all", "The only symbols that context matching sees"},
    {"symbols", engine, "names", "none", "Names of several characters, each one symbol", KeyScope::all},
    {"schedule", engine, "tables with counts, such as grow*(n-2) decorate*2", "the only table in every step",
     "Table applied in each step", KeyScope::all},
    {"seed", engine, "a whole number", "0", "Seed of random choices", KeyScope::all},
    {"scale factor", engine, "a percentage", "100", "Share of the page that a fitted drawing fills", KeyScope::all},
    {"title", engine, "text", "", "Title of prints and scores", KeyScope::all},
    {"source", engine, "text", "", "Publication the system comes from", KeyScope::all},
    {"composer", engine, "text", "", "Composer, for printed scores", KeyScope::all},
    {"description", engine, "text", "", "Remarks", KeyScope::all},

    {"map", engine, "clockwise, anticlockwise", "not a map",
     "Makes the pattern a map, and states how the axiom runs around its cell", KeyScope::maps},
    {"divide", engine, "once, all", "once", "Divisions of a cell in one step: one, or as long as branches match",
     KeyScope::maps},
    {"place", engine, "straight, gravity, pressure", "straight", "Placement of the vertices", KeyScope::maps},
    {"outline", engine, "polygon, circle", "polygon", "Outline that `place: gravity` holds fixed", KeyScope::maps},
    {"growth", engine, "a number from 0 to 1", "1",
     "Growth of cells under `place: pressure`: 0 shares out the mother's content, 1 repeats it", KeyScope::maps},
    {"stretch", engine, "a number above 0, from 0.001 to 1000", "1", "Factor of the height, after placing",
     KeyScope::maps},

    {"line", art, "straight, spline, spline with lifts", "straight",
     "Straight segments, or a uniform cubic B-spline over all positions of the turtle"},
    {"hand", art, "a number from 0 to 1", "0", "How much lines waver and swell, as if strewn with rice flour by hand",
     KeyScope::all},
    {"stroke", art, "a width and a colour such as 0.4mm #fff or 0.2 step white; none", "0.4mm black",
     "Width of the pen in mm (or cm, in, pt, px) or in steps, and its colour", KeyScope::all},
    {"ground", art, "a colour, none; red-earth, cow-dung, slate, concrete", "white",
     "Colour of the page, none is transparent; or a floor, which pictures show and other formats in its mean colour",
     KeyScope::all},
    {"paper", art, "white, none", "none",
     "White paper instead of the ground, to save ink: lines, dots and fills that would vanish on it take the colour "
     "of the ground, or of red earth",
     KeyScope::all},
    {"fill", art, "a colour; of maps also age, sides, none", "the palette's first, or the stroke's; none in maps",
     "Colour of polygons and discs with colour index 0, or of the cells of a map", KeyScope::all},
    {"palette", art, "colours, or a set of powders", "eight colours",
     "Colours of the indices 0, 1, 2 …, repeated from the end", KeyScope::all},
    {"dots", art, "a size and a colour such as 0.2 step white; none", "none", "Dots of a kolam"},
    {"border", art, "kaavi, padi, lotus, rope, diamonds, waves, marigolds, lamps; a pattern file, or two; none",
     "none",
     "Frame around the drawing; the first pattern file is repeated along the sides, the second drawn in the "
     "corners",
     KeyScope::all, names_border_file},
    {"fields", art, "chessboard, by kind, by distance, by centre, by strand, by symmetry; none", "none",
     "How the fields between closed lines are coloured"},
    {"tile colours", art,
     "by shape, by hand, by direction, by distance, by neighbours, by generation [STEPS], by worms; blank; none",
     "none", "How polygons are coloured, instead of by their pens; blank leaves them unfilled"},
    {"tile edges", art, "each, once, border, none", "each",
     "Edges of polygons: each draws its own, shared edges are drawn once, only the border of all, or none"},
    {"decorate", art,
     "kolam, truchet, worms, dots, strands; tile NUMBER … arc FROM TO line FROM TO dot colour NUMBER; none", "none",
     "Lines drawn on polygons and joined from one to the next: a kind of line, or lines between places on the "
     "outlines of polygons of a colour"},
    {"powders", art, "colours or none; festival, pongal, lotus, peacock, temple, marigold, monsoon, distinct",
     "festival", "Colours of the fields, or of the tiles"},
    {"weave", art, "yes; a gap in stroke widths, 0 to 5; none", "none",
     "Makes lines pass over and under each other alternately"},
    {"parallel", art, "a number of lines, 1 to 9, and their distance in stroke widths", "1 2",
     "Draws each line as several parallel lines"},
    {"view", art, "AZIMUTH ELEVATION [perspective [DISTANCE]]; front, side, top", "front",
     "Direction from which a drawing in space is seen, in degrees around and up"},
    {"light", art, "flat, sun, sky; AZIMUTH ELEVATION [SUN]", "flat",
     "Light of pictures of drawings in space: flat shades each facet evenly, sun and sky cast shadows; angles "
     "place the sun to the right of the eye and 5 to 90 degrees high, and SUN, 0 to 1, is its share of the light"},
    {"sway", art, "degrees from 0 to 90", "0",
     "Largest angle at which branches of a drawing in space lean from their exact directions, at random"},
    {"ground plane", art, "shadow, none", "shadow",
     "Whether a drawing in space casts its shadow on the ground, unless the light is flat"},

    {"cells", art, "walls, splines, both", "walls",
     "Outlines of cells: walls between them, a closed spline in each cell, or both", KeyScope::maps},
    {"tension", art, "a number from 0 to 1000000", "0", "Tension of the splines: 0 is round, 8 looks like tissue",
     KeyScope::maps},
    {"inset", art, "a number from 0 to less than 1", "0.07", "Share by which splines are smaller than their cells",
     KeyScope::maps},
    {"wall width", art, "even, age", "even",
     "Width of walls: that of the stroke, or as many strokes as the wall is steps old", KeyScope::maps},
    {"tissue", art, "a colour, none", "none", "Colour of the area within the outer wall, under the cells",
     KeyScope::maps},

    {"scale", music, "a name, or a Scala file such as x.scl", "major", "Scale of the melody", KeyScope::words,
     names_scale_file},
    {"keyboard", music, "a Scala key map such as x.kbm", "none", "Key map that gives all pitches", KeyScope::words,
     names_any_file},
    {"tonic", music, "C4, F#3, Bb, or a frequency", "C4", "Pitch of degree 0"},
    {"anchor", music, "first note, piece, lowest note, lowest vertex, centre", "first note",
     "Height of the curve that sounds the tonic"},
    {"unit", music, "a note value such as 1/16, up to 16 whole notes", "1/8", "Duration of a step"},
    {"vertical", music, "ignore, rest, extend, glissando, voice", "ignore", "Meaning of a vertical run"},
    {"runs", music, "merged, each step", "merged", "One note for a straight run, or for each step"},
    {"sloped", music, "project, skip, refuse", "project", "Treatment of runs that slope"},
    {"range", music, "fold, reflect, clamp, refuse; fold C2-C7", "fold",
     "Treatment of notes outside the keys of MIDI, or outside the given range"},
    {"tempo", music, "quarters a minute; 96 Andante; Allegro; 96 by y 84-108", "120",
     "Tempo, which may follow the curve, and words that are printed with it"},
    {"velocity", music, "fixed, by turn, by depth, by length; by x, by y, by level, by y 50-110", "fixed",
     "Loudness of notes"},
    {"pan", music, "by x, by y, by level, …; by x 14-114; none", "none",
     "Place of notes between left, 0, and right, 127"},
    {"controller", music, "74 by y, 1 by depth 0-100; none", "none", "Controller of MIDI that follows the curve"},
    {"gamaka", music, "kampita 2 6, jaru 1 falling, meend all; none", "none",
     "Ornaments of degrees by pitch bend: oscillations, slides from the note before and to the next; with rising or "
     "falling, only after a lower or a higher note"},
    {"mapping", music, "runs, counterpoint, symbols", "runs", "Reading of the curve as notes"},
    {"note SYMBOL", music, "C4 1/8 mf; degree 3 1/4; nothing", "",
     "Note that a symbol sounds: a pitch, a note value, a velocity"},
    {"drum SYMBOL", music, "bass drum 1/8 f; bass drum + open hi-hat", "",
     "Drums of General MIDI that a symbol sounds"},
    {"chord SYMBOL", music, "IV 1/2 p; Am7; C4 E4 G4; degrees 0 2 4", "", "Chord that a symbol sounds"},
    {"rest SYMBOL", music, "1/4; nothing", "", "Rest that a symbol stands for"},
    {"change SYMBOL", music, "louder, softer, p, 90, octave up, octave down, up 2, down 2", "",
     "What a symbol changes for the notes after it, up to the end of its branch"},
    {"named notes", music, "no, yes", "no", "Whether symbols such as A, C4 and Bb3 sound the notes that they name"},
    {"rhythm", music,
     "x..x..x., xo.x?30, (x.x.)3 xxxx, E(3,8), 4+2+2, adi, misra chapu, …; several by phrase: x.x. / x..x, or by "
     "level: x.x. / x..x by level; curve",
     "curve", "Rhythm of the steps, slot by slot; curve: every step lasts the unit"},
    {"leaps", music, "semitones such as 7, none", "none",
     "Largest leap within a phrase; notes farther away move by octaves"},
    {"swing", music, "50 to 80 percent, and a note value such as 1/16", "50",
     "Share of the first of two eighths, or of two of that note value"},
    {"phrases", music, "an order k, none", "none", "Sub-curves of order k are phrases"},
    {"breath", music, "a note value such as 1/8, bar, 1/8 bar, 1/8 by level, none", "1/8",
     "Rest after each phrase; bar: until the next bar line; 1/8 bar: likewise, but at least an eighth; by level: "
     "longer after larger sub-curves"},
    {"cadence", music, "none, tonic, alternate", "none",
     "Where the last notes of a phrase lead: to the tonic, or to the fifth and the tonic in turn"},
    {"articulation", music, "legato, detached, by depth, a percentage", "legato",
     "Share of a note that sounds; by depth: less in each branch"},
    {"harmony", music, "none, drone, triads, bass, bass k, progression I-IV-V-I, progression blues", "none",
     "What sounds with the melody: tonic and fifth, the triad that fits a bar, the curve k orders coarser, or "
     "given chords"},
    {"accompaniment", music,
     "block, oom-pah, arpeggio, arpeggio down, alberti, strum, bossa, walking bass, silent; strokes such as bc5c; "
     "optionally followed by on guitar",
     "block", "Figure in which triads and progressions are played, and its instrument"},
    {"inversion", music, "no, yes", "no", "Whether up and down change places around the tonic"},
    {"retrograde", music, "no, yes", "no", "Whether the part is played from its end to its beginning"},
    {"augmentation", music, "2, 3, 1/2, 3/2, …", "1", "How many times longer all notes are"},
    {"speed", music, "3:2, 2, …", "1", "Tempo of the part, compared with that of the score"},
    {"start", music, "a number of bars", "0", "Bars of the score before the part begins"},
    {"upbeat", music, "a note value such as 1/4, none", "none",
     "Duration of the upbeat, the part of the melody before the first bar line; each section of a form begins with "
     "one"},
    {"excerpt", music, "bars such as 1-8 or 9-, all", "all", "Bars of the melody that are played"},
    {"form", music, "AABA, A1 A2 B A2, A A+1 Ai Ar A*2 Ak Ac, AB order 2; curve", "curve",
     "Order of the sub-curves; 1 ends on the fifth, 2 on the tonic; +1 moves a section by degrees, i inverts it, r "
     "reverses it, *2 and /2 make its notes longer or shorter, k plays it three times, so that it ends at a bar "
     "line; c keeps its last two bars as a coda and repeats the last one twice as long"},
    {"thinning", music, "a share of the phrase, 0 to 1; none", "none",
     "Share of each phrase or section, at its end, that keeps only notes on beats, and in its second half only those "
     "on strong beats"},
    {"climax", music, "a share of the part, 0 to 1; none", "none",
     "Place of the phrase or section with the highest note: all are moved up by degrees, less the farther they are "
     "from it"},
    {"loop", music, "a number, fill, common", "1",
     "How often the part is played; until the longest part ends, or until all loops end together"},
    {"canon", music, "bars and an interval for each voice: 2 -12, 4 fifth below; none", "none",
     "Voices that repeat the part later, so many semitones or degrees higher"},
    {"counterpoint", music, "free, strict", "free",
     "Whether notes give way to the parts before, where fifths or octaves are parallel or strong beats dissonant"},
    {"transposition", music, "semitones, -127 to 127", "0", "Semitones added to every note"},
    {"ending", music, "none, ritardando, fermata", "none",
     "ritardando: the last two bars slow down; fermata: the last notes are also held"},
    {"brackets", music, "voices, sequence, shares", "voices",
     "Branches are voices, follow one another, or share the duration of a step"},
    {"meter", music, "4/4, 7/8; with groups 3+2+2/8", "4/4", "Meter"},
    {"instrument", music, "a General MIDI name or number", "piano", "Instrument"},
};

}  // namespace

std::span<const KeyInfo> language_keys() {
    return language;
}

const KeyInfo* find_language_key(std::string_view name) {
    static const auto rows = [] {
        std::unordered_map<std::string_view, const KeyInfo*> by_name;
        for (const KeyInfo& key : language) by_name.emplace(key.name, &key);
        return by_name;
    }();
    if (const auto row = rows.find(name); row != rows.end()) return row->second;
    const std::size_t blank = name.find(' ');
    if (blank == std::string_view::npos || blank + 1 == name.size()) return nullptr;
    const auto row = rows.find(std::string(name.substr(0, blank)).append(KeyInfo::symbol_place));
    return row == rows.end() ? nullptr : row->second;
}

std::vector<std::string_view> keys_of(KeyOwner owner) {
    std::vector<std::string_view> names;
    for (const KeyInfo& key : language) {
        if (key.owner == owner && !key.is_for_symbols()) names.push_back(key.name);
    }
    return names;
}

}  // namespace sikku
