// music/melody/layout.h: the layout of a part in its score: start, speed, repetitions, order of sections, and canon.
#pragma once

#include "engine/language/pattern.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace sikku {

/// A ratio of whole numbers above 0.
struct Ratio {
    std::int64_t above = 1;
    std::int64_t below = 1;
    bool is_one() const { return above == below; }
    /// `ticks` times the ratio, rounded to the nearest. @param ticks  from 0 to 2^50
    std::int64_t of(std::int64_t ticks) const { return (2 * ticks * above + below) / (2 * below); }
};

/// Goal of the last notes of a section, approached by step: none, the fifth, or the tonic.
enum class Ending { none, open, closed };

/// A section of a form: `A`, `A1` with an open ending, `A2` with a closed one; `A+2` in sequence, two degrees higher;
/// `Ai` inverted, `Ar` reversed; `A*2` and `A/2` with longer or shorter notes; `Ak` three times, as a korvai; `Ac` as
/// a coda.
struct FormSection {
    int letter = 0;  ///< 0 is A
    Ending ending = Ending::none;
    std::int64_t degrees = 0;  ///< added to each note
    bool is_inverted = false;  ///< mirrored at its first note
    bool is_retrograde = false;
    Ratio augmentation;
    bool is_korvai = false;  ///< played three times, ending at a bar line
    bool is_coda = false;    ///< only its last two bars; the last one is repeated with notes twice as long
    bool has_other_degrees() const { return is_inverted || degrees != 0; }
    bool is_changed() const {
        return has_other_degrees() || is_retrograde || !augmentation.is_one() || is_korvai || is_coda;
    }
};

/// A voice that repeats a part.
struct Follower {
    double bars = 0;           ///< delay, in bars
    double semitones = 0;      ///< interval above the part, in semitones,
    std::int64_t degrees = 0;  ///< or in degrees of the scale
};

/// How often a part is played: once; a number of times; until the longest part ends; until all loops end together.
enum class Loop { none, times, fill, common };

/// Where and how a part is played.
struct Layout {
    double start = 0;            ///< bars of the score before it
    std::int64_t upbeat = 0;     ///< ticks before its first bar line, less than a bar; 0: it begins at a bar line
    Ratio tempo;                 ///< speed, compared with the score
    Ratio augmentation;          ///< factor of all durations
    std::int64_t first_bar = 1;  ///< first bar of the melody to play, counted from 1
    std::int64_t bars = 0;       ///< number of bars to play; 0: all from the first
    bool is_retrograde = false;
    std::vector<FormSection> form;     ///< sub-curves in the order in which they are played; empty: as in the curve
    std::int64_t form_order = 0;       ///< order of the sub-curves
    double thinning = 0;               ///< share of each phrase or section, at its end, in which notes thin out
    std::optional<double> climax;      ///< share of the part after which its highest phrase or section comes
    bool is_order_of_phrases = false;  ///< form_order is set by the key `phrases`
    Loop loop = Loop::none;
    std::int64_t times = 1;
    std::vector<Follower> canon;
    bool is_strict = false;  ///< notes yield to earlier parts: see counterpoint.h

    /// Ticks before its first bar line; 0 for an excerpt that begins later.
    std::int64_t opening() const { return first_bar > 1 ? 0 : upbeat; }
    /// True if all notes must be known before the first one is played.
    bool needs_whole() const {
        return is_retrograde || !form.empty() || thinning > 0 || climax || loop != Loop::none || is_strict;
    }
};

/// Reads the keys start, speed, augmentation, excerpt, retrograde, form, thinning, climax, loop, canon and
/// counterpoint. Errors go to `diagnostics`.
Layout read_layout(const Pattern& pattern, Diagnostics& diagnostics);

/// Reads `A1 A2 B A2`, `AABA` or `A A+1 Ai2`: up to 26 letters in up to 256 sections. Empty for other text.
std::vector<FormSection> read_form(std::string_view text);

}  // namespace sikku
