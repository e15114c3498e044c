#include "music/score/drums.h"

#include "engine/base/text.h"

#include <algorithm>
#include <string>

namespace sikku {
namespace {

using enum NoteHead;

constexpr std::array<Drum, 47> drum_table = {{
    {35, "Acoustic Bass Drum", "", "acousticbassdrum", "bd", 2, 4, normal},
    {36, "Bass Drum 1", "bass drum", "bassdrum", "bd", 3, 4, normal},
    {37, "Side Stick", "", "sidestick", "rim", 0, 5, cross},
    {38, "Acoustic Snare", "snare drum", "acousticsnare", "sd", 0, 5, normal},
    {39, "Hand Clap", "clap", "handclap", "cp", 0, 5, triangle},
    {40, "Electric Snare", "", "electricsnare", "sd", 0, 5, normal},
    {41, "Low Floor Tom", "", "lowfloortom", "lt", 4, 4, normal},
    {42, "Closed Hi-Hat", "hi-hat", "closedhihat", "hh", 4, 5, cross},
    {43, "High Floor Tom", "", "highfloortom", "lt", 5, 4, normal},
    {44, "Pedal Hi-Hat", "", "pedalhihat", "hh", 1, 4, cross},
    {45, "Low Tom", "", "lowtom", "lt", 6, 4, normal},
    {46, "Open Hi-Hat", "", "openhihat", "oh", 4, 5, diamond},
    {47, "Low-Mid Tom", "", "lowmidtom", "mt", 1, 5, normal},
    {48, "Hi-Mid Tom", "", "himidtom", "mt", 2, 5, normal},
    {49, "Crash Cymbal 1", "crash cymbal", "crashcymbala", "cr", 5, 5, cross},
    {50, "High Tom", "", "hightom", "ht", 2, 5, normal},
    {51, "Ride Cymbal 1", "ride cymbal", "ridecymbala", "rd", 3, 5, cross},
    {52, "Chinese Cymbal", "", "chinesecymbal", "cr", 5, 5, diamond},
    {53, "Ride Bell", "", "ridebell", "rd", 3, 5, diamond},
    {54, "Tambourine", "", "tambourine", "tb", 2, 5, triangle},
    {55, "Splash Cymbal", "", "splashcymbal", "cr", 5, 5, triangle},
    {56, "Cowbell", "", "cowbell", "cb", 2, 5, triangle},
    {57, "Crash Cymbal 2", "", "crashcymbalb", "cr", 5, 5, cross},
    {58, "Vibraslap", "", "vibraslap", "perc", 2, 5, diamond},
    {59, "Ride Cymbal 2", "", "ridecymbalb", "rd", 3, 5, cross},
    {60, "Hi Bongo", "", "hibongo", "perc", 2, 5, normal},
    {61, "Low Bongo", "", "lobongo", "perc", 6, 4, normal},
    {62, "Mute Hi Conga", "", "mutehiconga", "perc", 2, 5, cross},
    {63, "Open Hi Conga", "", "openhiconga", "perc", 2, 5, normal},
    {64, "Low Conga", "", "loconga", "perc", 6, 4, normal},
    {65, "High Timbale", "", "hitimbale", "perc", 2, 5, normal},
    {66, "Low Timbale", "", "lotimbale", "perc", 6, 4, normal},
    {67, "High Agogo", "", "hiagogo", "cb", 2, 5, triangle},
    {68, "Low Agogo", "", "loagogo", "cb", 6, 4, triangle},
    {69, "Cabasa", "", "cabasa", "sh", 6, 4, cross},
    {70, "Maracas", "", "maracas", "sh", 6, 4, cross},
    {71, "Short Whistle", "", "shortwhistle", "misc", 4, 5, diamond},
    {72, "Long Whistle", "", "longwhistle", "misc", 4, 5, diamond},
    {73, "Short Guiro", "", "shortguiro", "perc", 6, 4, cross},
    {74, "Long Guiro", "", "longguiro", "perc", 6, 4, cross},
    {75, "Claves", "", "claves", "rim", 6, 4, cross},
    {76, "Hi Wood Block", "", "hiwoodblock", "perc", 2, 5, triangle},
    {77, "Low Wood Block", "", "lowoodblock", "perc", 6, 4, triangle},
    {78, "Mute Cuica", "", "mutecuica", "perc", 6, 4, cross},
    {79, "Open Cuica", "", "opencuica", "perc", 6, 4, normal},
    {80, "Mute Triangle", "", "mutetriangle", "perc", 4, 5, triangle},
    {81, "Open Triangle", "triangle", "opentriangle", "perc", 4, 5, triangle},
}};

/// A name in lower case, with blanks for hyphens and `hi` for `high`.
std::string plain(std::string_view name) {
    std::string result = lower_case(name);
    std::replace(result.begin(), result.end(), '-', ' ');
    if (result.starts_with("high ")) result.erase(2, 2);
    return result;
}

}  // namespace

std::span<const Drum> drums() {
    return drum_table;
}

const Drum& drum_of(int key) {
    return drum_table[static_cast<std::size_t>(std::clamp(key, drum_table.front().key, drum_table.back().key) -
                                               drum_table.front().key)];
}

const Drum* find_drum(std::string_view name) {
    const std::string wanted = plain(name);
    const auto* found = std::find_if(drum_table.begin(), drum_table.end(), [&](const Drum& drum) {
        return plain(drum.name) == wanted || (!drum.alias.empty() && plain(drum.alias) == wanted) ||
               std::to_string(drum.key) == wanted;
    });
    return found == drum_table.end() ? nullptr : found;
}

}  // namespace sikku
