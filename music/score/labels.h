// music/score/labels.h: the names of parts and their lines, for staves in print and tracks of MIDI files.
#pragma once

#include "music/score/notation.h"
#include "music/score/score.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

struct Label {
    std::string name;
    std::string abbreviation;
};

/// Names and abbreviations of parts: those of their instruments, or their own names. Parts with the same name are
/// numbered.
std::vector<Label> labels_of(std::span<const Part> parts);

/// Sets name and abbreviation of parts in print.
void set_labels(std::span<NotatedPart> parts);

/// The name of a staff or a voice of a part: that of the part, and its number if there are several. `Flute 2`, and
/// `Flute 1.2` in a part that is numbered itself.
/// @param part   name or abbreviation of the part; may be empty
/// @param index  counted from 0
std::string line_name(std::string_view part, std::size_t index, std::size_t count);

}  // namespace sikku
