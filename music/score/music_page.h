// music/score/music_page.h: draws a melody, its curve coloured by notes beside a piano roll, as an SVG or as a page
// that plays.
#pragma once

#include "music/score/curves.h"
#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// Keeps a whole melody, for pictures and pages, which need all notes before the first is written.
class NoteCollector : public NoteSink {
public:
    static constexpr std::size_t most_points = 4'000'000;

    /// @param most  notes above which a ScoreError is thrown; it suggests to limit the bars or seconds. Curves may
    /// have `most_points` points.
    explicit NoteCollector(std::size_t most = 100'000) : most_(most) {}

    void curves(const Curves& curves) override { curves_ = curves; }
    void controls(std::span<const ControlPoint> points) override;
    void notes(std::span<const Note> notes) override;
    void finish(std::int64_t end) override;

    const std::vector<Note>& notes() const { return notes_; }
    std::int64_t end() const { return end_; }  ///< ticks; 0 before finish()
    const Curves& curves() const { return curves_; }

private:
    std::size_t most_;
    std::vector<Note> notes_;
    std::int64_t end_ = 0;
    Curves curves_;
};

/// One picture on a landscape A4 page: the curve on the left, where each note is drawn over the piece of the curve it
/// comes from, and beside it the notes over time (to the right) and key (upwards) in the same colours. Pieces of the
/// curve that are silent and parallel to an axis join the notes as thin lines. Notes that all come from one point
/// have no curve, and the roll is given the whole page. The title, the pattern's text and `made` are in the file.
///
/// Each note is a `line` in the group `curve` and a `rect` in the group `roll`, both ordered by onset, then by voice.
/// Memory: a copy of the notes.
/// @param notes  in any order
/// @param end    end of the score, in ticks; notes that sound longer extend it
/// @throws exceptions of `out`
void write_music_svg(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out);

/// One HTML page that needs only a browser, and no network: it draws the curve while it plays the notes. Notes are in
/// the file with exact ticks and keys to 4 decimals. Tests and other scripts find in `window.sikku` the `notes`
/// ([onset, duration, key, voice, velocity, from x, from y, to x, to y], ordered by onset, then by voice, and for
/// notes that slide ticks, semitones and rise of the glide) and `state()`: whether it is `playing`, `tick` and the
/// sound's `time` in seconds, `tempo`, how many notes have `sounded`, and `recent`, the indices of the last of them.
/// Arguments, memory and errors: see write_music_svg().
void write_music_page(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                      const Curves& curves = {});

}  // namespace sikku
