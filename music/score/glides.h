// music/score/glides.h: slides of pitch: their pieces, and their points for MIDI.
#pragma once

#include "music/score/score.h"

#include <cstdint>
#include <vector>

namespace sikku {

/// Semitones of a full pitch bend in scores with glides: the widest that write_midi() accepts.
constexpr int glide_bend_range = 24;

/// Cuts a note to the part that sounds between two ticks, which must not be empty. A note that then begins within its
/// slide gets the key reached there, possibly fractional.
void cut(Note& note, std::int64_t from, std::int64_t to);

/// The key that sounds at the end of a note.
inline double last_key(const Note& note) {
    return note.key + static_cast<double>(note.glide.semitones);
}

/// A key from a tick on.
struct GlidePoint {
    std::int64_t tick = 0;
    double key = 0;
    bool operator==(const GlidePoint&) const = default;
};

/// The slide of a note as steps, all within the note; the last one reaches its end. Steps are at most 3 cents wide,
/// but at least 4 ms apart.
/// @param tempo  quarters a minute
std::vector<GlidePoint> glide_points(const Note& note, double tempo);

}  // namespace sikku
