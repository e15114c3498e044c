#include "music/score/strokes.h"

#include "music/score/drums.h"
#include "music/score/notation.h"
#include "music/score/note_order.h"
#include "music/score/rhythm.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

namespace sikku {
namespace {

int drum_key(const Note& note) {
    return drum_of(static_cast<int>(std::lround(note.key))).key;
}

bool is_foot(const Note& note) {
    constexpr int bass_drum = 35;
    constexpr int other_bass_drum = 36;
    constexpr int pedal_hi_hat = 44;
    const int key = drum_key(note);
    return key == bass_drum || key == other_bass_drum || key == pedal_hi_hat;
}

int height_of(const Note& note) {
    const Drum& drum = drum_of(drum_key(note));
    return Pitch{drum.letter, drum.octave, 0}.height();
}

/// The stress of two strokes at once: ghost notes have parentheses only by themselves.
Stress louder(Stress a, Stress b) {
    if (a == Stress::accent || b == Stress::accent) return Stress::accent;
    return a == b ? a : Stress::plain;
}

/// Joins strokes that begin together. @param notes  in any order @param merged  incremented for each merged stroke
StrokeLine line_of(std::vector<Note> notes, const BarLines& bars, std::uint64_t& merged) {
    sort_by_onset(notes);
    StrokeLine line;
    for (const Note& note : notes) {
        if (line.strokes.empty() || line.strokes.back().onset != note.onset) {
            line.strokes.push_back(note);
            line.others.emplace_back();
            continue;
        }
        Note& first = line.strokes.back();
        std::vector<double>& others = line.others.back();
        first.duration = std::max(first.duration, note.duration);
        first.velocity = std::max(first.velocity, note.velocity);
        first.emphasis.stress = louder(first.emphasis.stress, note.emphasis.stress);
        first.emphasis.dynamic = std::max(first.emphasis.dynamic, note.emphasis.dynamic);
        const double key = drum_key(note);
        if (drum_key(first) == drum_key(note) || std::find(others.begin(), others.end(), key) != others.end()) {
            ++merged;
        } else {
            others.push_back(key);
        }
    }
    for (std::size_t i = 0; i < line.strokes.size(); ++i) {
        Note& stroke = line.strokes[i];
        const std::int64_t beat = beat_end(stroke.onset, bars);
        const std::int64_t end = stroke.onset + stroke.duration;
        const bool lasts_for_beats = end > beat && beat_end(end - 1, bars) == end;
        const std::int64_t written = lasts_for_beats ? end : beat;
        const bool has_next = i + 1 < line.strokes.size();
        stroke.duration = (has_next ? std::min(written, line.strokes[i + 1].onset) : written) - stroke.onset;
    }
    return line;
}

/// The shortest note of a tuplet, in ticks.
std::int64_t shortest_of(const Grid& grid) {
    std::int64_t shortest = std::numeric_limits<std::int64_t>::max();
    for (const TupletSpan& tuplet : grid.tuplets()) shortest = std::min(shortest, tuplet.step());
    return shortest;
}

/// @return false if the strokes together need shorter notes than each voice alone, or would be moved
bool fits_a_grid(const StrokeLine& line, std::span<const std::vector<Note>> voices, const BarLines& bars) {
    const Grid grid = grid_of(line.strokes, bars);
    std::int64_t shortest = std::numeric_limits<std::int64_t>::max();
    for (const std::vector<Note>& voice : voices) shortest = std::min(shortest, shortest_of(grid_of(voice, bars)));
    return shortest_of(grid) >= shortest &&
           std::all_of(line.strokes.begin(), line.strokes.end(), [&](const Note& stroke) {
               return grid.nearest(stroke.onset) == stroke.onset &&
                      grid.nearest(stroke.onset + stroke.duration) == stroke.onset + stroke.duration;
           });
}

bool has_several_drums(std::span<const std::vector<Note>> voices) {
    std::set<int> drums;
    for (const std::vector<Note>& voice : voices) {
        for (const Note& note : voice) drums.insert(drum_key(note));
    }
    return drums.size() > 1;
}

double mean_height(const StrokeLine& line) {
    double sum = 0;
    for (const Note& stroke : line.strokes) sum += height_of(stroke);
    return sum / static_cast<double>(line.strokes.size());
}

}  // namespace

StrokeLines stroke_lines(std::span<const std::vector<Note>> voices, const BarLines& bars) {
    StrokeLines result;
    const bool is_set = has_several_drums(voices);
    for (const bool are_feet : {false, true}) {
        std::vector<std::vector<Note>> parts;
        std::vector<Note> all;
        for (const std::vector<Note>& voice : voices) {
            std::vector<Note>& part = parts.emplace_back();
            std::copy_if(voice.begin(), voice.end(), std::back_inserter(part),
                         [&](const Note& note) { return is_foot(note) == are_feet; });
            for (Note& note : part) {
                if (is_set) note.emphasis.dynamic = -1;
            }
            all.insert(all.end(), part.begin(), part.end());
        }
        if (all.empty()) continue;
        std::uint64_t merged = 0;
        StrokeLine together = line_of(std::move(all), bars, merged);
        if (fits_a_grid(together, parts, bars)) {
            result.lines.push_back(std::move(together));
            result.merged += merged;
            continue;
        }
        std::vector<StrokeLine> apart;
        for (std::vector<Note>& part : parts) {
            if (!part.empty()) apart.push_back(line_of(std::move(part), bars, result.merged));
        }
        std::stable_sort(apart.begin(), apart.end(),
                         [](const StrokeLine& a, const StrokeLine& b) { return mean_height(a) > mean_height(b); });
        for (StrokeLine& line : apart) result.lines.push_back(std::move(line));
    }
    if (result.lines.empty()) result.lines.emplace_back();
    return result;
}

}  // namespace sikku
