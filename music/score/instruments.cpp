#include "music/score/instruments.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

namespace sikku {
namespace {

constexpr std::array<Instrument, 128> instrument_table = {{
    {"Acoustic Grand Piano", "Piano", "Pno.", "acoustic grand"},
    {"Bright Acoustic Piano", "Piano", "Pno.", "bright acoustic"},
    {"Electric Grand Piano", "Electric Grand", "E. Pno.", "electric grand"},
    {"Honky-tonk Piano", "Honky-tonk Piano", "Pno.", "honky-tonk"},
    {"Electric Piano 1", "Electric Piano", "E. Pno.", "electric piano 1"},
    {"Electric Piano 2", "Electric Piano", "E. Pno.", "electric piano 2"},
    {"Harpsichord", "Harpsichord", "Hpsd.", "harpsichord"},
    {"Clavinet", "Clavinet", "Clav.", "clav"},
    {"Celesta", "Celesta", "Cel.", "celesta"},
    {"Glockenspiel", "Glockenspiel", "Glock.", "glockenspiel"},
    {"Music Box", "Music Box", "M. Box", "music box"},
    {"Vibraphone", "Vibraphone", "Vib.", "vibraphone"},
    {"Marimba", "Marimba", "Mar.", "marimba"},
    {"Xylophone", "Xylophone", "Xyl.", "xylophone"},
    {"Tubular Bells", "Tubular Bells", "T. B.", "tubular bells"},
    {"Dulcimer", "Dulcimer", "Dulc.", "dulcimer"},
    {"Drawbar Organ", "Hammond Organ", "Org.", "drawbar organ"},
    {"Percussive Organ", "Percussive Organ", "Org.", "percussive organ"},
    {"Rock Organ", "Rock Organ", "Org.", "rock organ"},
    {"Church Organ", "Organ", "Org.", "church organ"},
    {"Reed Organ", "Harmonium", "Harm.", "reed organ"},
    {"Accordion", "Accordion", "Acc.", "accordion"},
    {"Harmonica", "Harmonica", "Harm.", "harmonica"},
    {"Tango Accordion", "Bandoneon", "Band.", "concertina"},
    {"Acoustic Guitar (nylon)", "Guitar", "Gtr.", "acoustic guitar (nylon)"},
    {"Acoustic Guitar (steel)", "Steel Guitar", "Gtr.", "acoustic guitar (steel)"},
    {"Electric Guitar (jazz)", "Electric Guitar", "E. Gtr.", "electric guitar (jazz)"},
    {"Electric Guitar (clean)", "Electric Guitar", "E. Gtr.", "electric guitar (clean)"},
    {"Electric Guitar (muted)", "Electric Guitar", "E. Gtr.", "electric guitar (muted)"},
    {"Overdriven Guitar", "Electric Guitar", "E. Gtr.", "overdriven guitar"},
    {"Distortion Guitar", "Electric Guitar", "E. Gtr.", "distorted guitar"},
    {"Guitar Harmonics", "Electric Guitar", "E. Gtr.", "guitar harmonics"},
    {"Acoustic Bass", "Double Bass", "Db.", "acoustic bass"},
    {"Electric Bass (finger)", "Electric Bass", "E. B.", "electric bass (finger)"},
    {"Electric Bass (pick)", "Electric Bass", "E. B.", "electric bass (pick)"},
    {"Fretless Bass", "Fretless Bass", "E. B.", "fretless bass"},
    {"Slap Bass 1", "Slap Bass", "E. B.", "slap bass 1"},
    {"Slap Bass 2", "Slap Bass", "E. B.", "slap bass 2"},
    {"Synth Bass 1", "Synth Bass", "S. B.", "synth bass 1"},
    {"Synth Bass 2", "Synth Bass", "S. B.", "synth bass 2"},
    {"Violin", "Violin", "Vln.", "violin"},
    {"Viola", "Viola", "Vla.", "viola"},
    {"Cello", "Cello", "Vc.", "cello"},
    {"Contrabass", "Contrabass", "Cb.", "contrabass"},
    {"Tremolo Strings", "Strings", "Str.", "tremolo strings"},
    {"Pizzicato Strings", "Strings", "Str.", "pizzicato strings"},
    {"Orchestral Harp", "Harp", "Hp.", "orchestral harp"},
    {"Timpani", "Timpani", "Timp.", "timpani"},
    {"String Ensemble 1", "Strings", "Str.", "string ensemble 1"},
    {"String Ensemble 2", "Strings", "Str.", "string ensemble 2"},
    {"Synth Strings 1", "Synth Strings", "Synth", "synthstrings 1"},
    {"Synth Strings 2", "Synth Strings", "Synth", "synthstrings 2"},
    {"Choir Aahs", "Choir", "Ch.", "choir aahs"},
    {"Voice Oohs", "Choir", "Ch.", "voice oohs"},
    {"Synth Voice", "Synth Voice", "Voice", "synth voice"},
    {"Orchestra Hit", "Orchestra Hit", "Orch.", "orchestra hit"},
    {"Trumpet", "Trumpet", "Tpt.", "trumpet"},
    {"Trombone", "Trombone", "Tbn.", "trombone"},
    {"Tuba", "Tuba", "Tba.", "tuba"},
    {"Muted Trumpet", "Muted Trumpet", "Tpt.", "muted trumpet"},
    {"French Horn", "Horn", "Hn.", "french horn"},
    {"Brass Section", "Brass", "Brass", "brass section"},
    {"Synth Brass 1", "Synth Brass", "Brass", "synthbrass 1"},
    {"Synth Brass 2", "Synth Brass", "Brass", "synthbrass 2"},
    {"Soprano Sax", "Soprano Sax", "S. Sax", "soprano sax"},
    {"Alto Sax", "Alto Sax", "A. Sax", "alto sax"},
    {"Tenor Sax", "Tenor Sax", "T. Sax", "tenor sax"},
    {"Baritone Sax", "Baritone Sax", "B. Sax", "baritone sax"},
    {"Oboe", "Oboe", "Ob.", "oboe"},
    {"English Horn", "English Horn", "E. H.", "english horn"},
    {"Bassoon", "Bassoon", "Bsn.", "bassoon"},
    {"Clarinet", "Clarinet", "Cl.", "clarinet"},
    {"Piccolo", "Piccolo", "Picc.", "piccolo"},
    {"Flute", "Flute", "Fl.", "flute"},
    {"Recorder", "Recorder", "Rec.", "recorder"},
    {"Pan Flute", "Pan Flute", "Pan Fl.", "pan flute"},
    {"Blown Bottle", "Blown Bottle", "Bottle", "blown bottle"},
    {"Shakuhachi", "Shakuhachi", "Shak.", "shakuhachi"},
    {"Whistle", "Whistle", "Whist.", "whistle"},
    {"Ocarina", "Ocarina", "Oc.", "ocarina"},
    {"Lead 1 (square)", "Square Lead", "Lead", "lead 1 (square)"},
    {"Lead 2 (sawtooth)", "Sawtooth Lead", "Lead", "lead 2 (sawtooth)"},
    {"Lead 3 (calliope)", "Calliope", "Call.", "lead 3 (calliope)"},
    {"Lead 4 (chiff)", "Chiff Lead", "Lead", "lead 4 (chiff)"},
    {"Lead 5 (charang)", "Charang", "Char.", "lead 5 (charang)"},
    {"Lead 6 (voice)", "Voice Lead", "Lead", "lead 6 (voice)"},
    {"Lead 7 (fifths)", "Fifths Lead", "Lead", "lead 7 (fifths)"},
    {"Lead 8 (bass + lead)", "Bass and Lead", "Lead", "lead 8 (bass+lead)"},
    {"Pad 1 (new age)", "New Age Pad", "Pad", "pad 1 (new age)"},
    {"Pad 2 (warm)", "Warm Pad", "Pad", "pad 2 (warm)"},
    {"Pad 3 (polysynth)", "Polysynth", "Synth", "pad 3 (polysynth)"},
    {"Pad 4 (choir)", "Choir Pad", "Pad", "pad 4 (choir)"},
    {"Pad 5 (bowed)", "Bowed Pad", "Pad", "pad 5 (bowed)"},
    {"Pad 6 (metallic)", "Metallic Pad", "Pad", "pad 6 (metallic)"},
    {"Pad 7 (halo)", "Halo Pad", "Pad", "pad 7 (halo)"},
    {"Pad 8 (sweep)", "Sweep Pad", "Pad", "pad 8 (sweep)"},
    {"FX 1 (rain)", "Rain", "Rain", "fx 1 (rain)"},
    {"FX 2 (soundtrack)", "Soundtrack", "Sdtk.", "fx 2 (soundtrack)"},
    {"FX 3 (crystal)", "Crystal", "Cryst.", "fx 3 (crystal)"},
    {"FX 4 (atmosphere)", "Atmosphere", "Atm.", "fx 4 (atmosphere)"},
    {"FX 5 (brightness)", "Brightness", "Bright.", "fx 5 (brightness)"},
    {"FX 6 (goblins)", "Goblins", "Gobl.", "fx 6 (goblins)"},
    {"FX 7 (echoes)", "Echoes", "Echo", "fx 7 (echoes)"},
    {"FX 8 (sci-fi)", "Sci-fi", "Sci-fi", "fx 8 (sci-fi)"},
    {"Sitar", "Sitar", "Sit.", "sitar"},
    {"Banjo", "Banjo", "Bj.", "banjo"},
    {"Shamisen", "Shamisen", "Sham.", "shamisen"},
    {"Koto", "Koto", "Koto", "koto"},
    {"Kalimba", "Kalimba", "Kal.", "kalimba"},
    {"Bagpipe", "Bagpipe", "Bagp.", "bagpipe"},
    {"Fiddle", "Fiddle", "Fid.", "fiddle"},
    {"Shanai", "Shanai", "Shan.", "shanai"},
    {"Tinkle Bell", "Tinkle Bell", "Bell", "tinkle bell"},
    {"Agogo", "Agogo", "Ago.", "agogo"},
    {"Steel Drums", "Steel Drums", "St. Dr.", "steel drums"},
    {"Woodblock", "Woodblock", "W. Bl.", "woodblock"},
    {"Taiko Drum", "Taiko", "Taiko", "taiko drum"},
    {"Melodic Tom", "Tom-toms", "Toms", "melodic tom"},
    {"Synth Drum", "Synth Drum", "S. Dr.", "synth drum"},
    {"Reverse Cymbal", "Reverse Cymbal", "Cym.", "reverse cymbal"},
    {"Guitar Fret Noise", "Guitar Fret Noise", "Fret", "guitar fret noise"},
    {"Breath Noise", "Breath Noise", "Breath", "breath noise"},
    {"Seashore", "Seashore", "Sea", "seashore"},
    {"Bird Tweet", "Bird Tweet", "Birds", "bird tweet"},
    {"Telephone Ring", "Telephone", "Tel.", "telephone ring"},
    {"Helicopter", "Helicopter", "Heli.", "helicopter"},
    {"Applause", "Applause", "Appl.", "applause"},
    {"Gunshot", "Gunshot", "Gun", "gunshot"},
}};

struct TransposingInstrument {
    int program;
    Transposition by;
};
constexpr std::array<TransposingInstrument, 9> transposing = {{{56, {2, 1, "B♭", "bes"}},
                                                               {59, {2, 1, "B♭", "bes"}},
                                                               {60, {7, 4, "F", "f"}},
                                                               {64, {2, 1, "B♭", "bes"}},
                                                               {65, {9, 5, "E♭", "es"}},
                                                               {66, {14, 8, "B♭", "bes,"}},
                                                               {67, {21, 12, "E♭", "es,"}},
                                                               {69, {7, 4, "F", "f"}},
                                                               {71, {2, 1, "B♭", "bes"}}}};

struct RangedInstrument {
    int program;
    KeyRange range;
};
constexpr std::array<RangedInstrument, 42> ranged = {
    {{0, {21, 108}},  {1, {21, 108}},  {2, {21, 108}},  {6, {29, 89}},    {8, {60, 108}},  {9, {79, 108}},
     {11, {53, 89}},  {12, {36, 96}},  {13, {65, 108}}, {14, {60, 79}},   {24, {40, 83}},  {25, {40, 84}},
     {26, {40, 88}},  {27, {40, 88}},  {32, {28, 67}},  {33, {28, 67}},   {34, {28, 67}},  {35, {28, 67}},
     {40, {55, 103}}, {41, {48, 88}},  {42, {36, 84}},  {43, {28, 67}},   {46, {23, 104}}, {47, {38, 60}},
     {56, {52, 85}},  {57, {40, 77}},  {58, {26, 65}},  {59, {52, 85}},   {60, {35, 77}},  {64, {56, 88}},
     {65, {49, 81}},  {66, {44, 76}},  {67, {36, 69}},  {68, {58, 93}},   {69, {52, 81}},  {70, {34, 76}},
     {71, {50, 94}},  {72, {74, 108}}, {73, {59, 98}},  {110, {55, 103}}, {45, {28, 103}}, {48, {28, 103}}}};

}  // namespace

std::optional<Transposition> transposition_of(int program) {
    const auto* row = std::find_if(transposing.begin(), transposing.end(),
                                   [&](const TransposingInstrument& one) { return one.program == program; });
    return row == transposing.end() ? std::nullopt : std::optional(row->by);
}

bool is_without_dynamics(int program) {
    constexpr int harpsichord = 6, first_organ = 16, last_organ = 20;
    return program == harpsichord || (program >= first_organ && program <= last_organ);
}

bool has_slurs(int program) {
    constexpr std::pair<int, int> ranges[] = {{0, 5}, {16, 23}, {40, 44}, {48, 54}, {56, 79}, {109, 111}};
    return std::any_of(std::begin(ranges), std::end(ranges),
                       [&](const auto& range) { return program >= range.first && program <= range.second; });
}

std::optional<KeyRange> range_of_instrument(int program) {
    const auto* row = std::find_if(ranged.begin(), ranged.end(),
                                   [&](const RangedInstrument& one) { return one.program == program; });
    return row == ranged.end() ? std::nullopt : std::optional(row->range);
}

const Instrument& instrument_of(int program) {
    return instrument_table[static_cast<std::size_t>(std::clamp(program, 0, 127))];
}

}  // namespace sikku
