// music/melody/emitter.h: passes notes from the readers of words to a sink.
#pragma once

#include "music/melody/accompaniment.h"
#include "music/melody/degree_range.h"
#include "music/melody/mapping.h"
#include "music/melody/shaper.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku::mapping {

/// Represents a height, a degree or a position that is not known yet.
constexpr std::int64_t unknown = std::numeric_limits<std::int64_t>::min();

/// Converts degrees to keys and passes the notes of the requested piece to the sink, counted and in blocks.
class Emitter {
public:
    Emitter(const Melody& melody, NoteSink& sink, const PlayOptions& options);

    /// State of a voice between its notes.
    struct Line {
        int voice = -1;
        std::int64_t last_degree = unknown;
        bool falling = false;
        // With `leaps`: the last degree of a phrase, how far it was moved, and the phrase.
        std::int64_t leapt_to = unknown;
        std::int64_t leapt_by = 0;
        std::uint64_t phrase = 0;
    };

    /// Passes on a note of the curve, whose degree is turned and moved as the melody states.
    void note(Line& line, Shaper::Draft draft) {
        if (is_rest(line, draft)) return;
        draft.degree = moved(draft.degree);
        if (melody_.leaps > 0) limit_leap(line, draft);
        describe(draft);
        shaper_ ? shape(line, draft) : place(line, draft);
    }
    /// Passes on a note of a table of symbols; a fixed key sounds as stated.
    void table_note(Line& line, Shaper::Draft draft) {
        if (is_rest(line, draft)) return;
        take_time(line, draft.onset, draft.end);
        describe(draft);
        shaper_ ? shape(line, draft) : place_fixed(line, draft);
    }
    /// Passes on a note of the curve whose pitch slides.
    void gliding_note(Line& line, Shaper::Draft draft) {
        if (is_rest(line, draft)) return;
        draft.degree = moved(draft.degree);
        draft.goal = moved(draft.goal);
        if (melody_.leaps > 0) limit_leap(line, draft);
        take_time(line, draft.onset, draft.end);
        describe(draft);
        shaper_ ? shape(line, draft) : place_gliding(line, draft);
    }

    /// Ends the phrase of a voice with its last note.
    void end_phrase(int voice, bool is_odd);

    /// Records that a phrase has ended and the next begins at `tick`.
    void begin_phrase(std::int64_t tick) const {
        if (options_.phrase_ends) options_.phrase_ends->push_back(tick - options_.from);
    }

    /// Records that a part of the word was skipped, so that the next note can lie within a phrase.
    void skip() { sounding_phrase_ = phrase_; }

    /// True if symbols read from `tick` on, the end of the piece or later, cannot affect the piece.
    bool may_stop(std::int64_t tick) const {
        return !shaper_ || shaper_->first_pending() >= options_.to || tick >= options_.to + 64 * melody_.meter.bar();
    }

    bool is_shaped() const { return shaper_.has_value(); }

    /// Makes triads follow this voice instead of the first.
    void follow(int voice) {
        if (shaper_) shaper_->follow(voice);
    }

    /// Assigns a voice to a line that exists from the beginning.
    void take(Line& line, int voice) {
        line.voice = voice;
        if (held_.size() <= static_cast<std::size_t>(voice)) held_.resize(voice + 1U, 0);
        held_[static_cast<std::size_t>(voice)] = 1;
    }

    /// Frees the voice of a branch that has ended.
    void release(const Line& line) {
        if (held_back_ > 0 && line.voice >= 0) settle(line.voice, nullptr, false);
        if (line.voice >= 0) held_[static_cast<std::size_t>(line.voice)] = false;
    }

    void finish(std::int64_t end);

    PlayReport report;
    int depth = 0;        ///< brackets around the next note
    int level = 0;        ///< level of the next note, as in Note
    Emphasis emphasis{};  ///< emphasis of the next note; its velocity does not include the accent

private:
    struct Placed {
        double key = std::numeric_limits<double>::quiet_NaN();  // not looked up yet
        bool is_moved = false;
        bool is_silent = false;
        std::int64_t degree = 0;  // sounding degree
    };

    std::int64_t moved(std::int64_t degree) const { return (melody_.is_inverted ? -degree : degree) + melody_.shift; }
    /// Notes that chance silences keep their voice.
    bool is_rest(Line& line, const Shaper::Draft& draft) {
        if (!draft.is_silent) return false;
        shaper_ ? take_time(line, draft.onset, draft.end) : reserve(line, draft.onset, draft.end);
        return true;
    }
    void describe(Shaper::Draft& draft) {
        draft.is_first = std::exchange(sounding_phrase_, phrase_) != phrase_;
        draft.depth = depth;
        draft.level = level;
        draft.emphasis = emphasis;
    }
    /// Moves a note by periods to within a leap of the one before it in the phrase, if it is farther away.
    void limit_leap(Line& line, Shaper::Draft& draft) const;
    void shape(Line& line, Shaper::Draft& draft);
    /// Places the notes that are shaped.
    void hand_on();
    /// Plays the accompaniment of a bar.
    void accompany(std::int64_t begin, const Chord* chord, const Chord* next = nullptr, bool is_last = false);
    /// Places a note by its degree. Hot: the notes of most melodies come here.
    void place(Line& line, const Shaper::Draft& note);
    /// Places a note by its fixed key, or else by its degree.
    void place_fixed(Line& line, const Shaper::Draft& note);
    /// Holds a note back until it is known where its pitch slides.
    void place_gliding(Line& line, const Shaper::Draft& note);
    /// Passes on the note of a voice that was held back. @param next  the note after it; null if there is none
    void settle(int voice, const Shaper::Draft* next, bool falling);
    void follow_line(Line& line, std::int64_t degree) const;
    void reserve(Line& line, std::int64_t onset, std::int64_t end);
    bool is_in_piece(const Shaper::Draft& note) const { return note.end > options_.from && note.onset < options_.to; }

    void extend_range(double key) {
        report.lowest = std::min(report.lowest, key);
        report.highest = std::max(report.highest, key);
    }
    /// Adds a note of the melody, cut to the piece. @param degree  as in PlayOptions::degrees
    void put(const Shaper::Draft& draft, const Placed& placed, int voice, std::int64_t degree,
             const Glide& glide = {});
    void put(const Note& note, std::int64_t degree);
    void flush() {
        if (!block_.empty()) sink_.notes(block_);
        block_.clear();
    }

    int free_voice(std::int64_t onset);
    /// Assigns a voice to a line, until `end`.
    void take_time(Line& line, std::int64_t onset, std::int64_t end);

    Placed key_of(std::int64_t degree, bool falling);
    bool is_within(double key) const { return key >= melody_.lowest && key <= melody_.highest; }
    Placed look_up(std::int64_t degree, bool falling);
    /// The sound of a degree within the range, moved by the interval of a canon.
    Placed answered(Placed placed, bool falling) const;
    /// @param raw  the key of the degree, possibly beyond the range
    Placed within_range(double raw, std::int64_t degree, bool falling);
    [[noreturn]] void refuse(std::int64_t degree, const std::string& key) const;

    const Melody& melody_;
    NoteSink& sink_;
    const PlayOptions& options_;
    std::vector<Note> block_;
    std::array<std::vector<Placed>, 2> keys_;
    std::optional<DegreeRange> range_;  // created once a note lies beyond it
    std::optional<Shaper> shaper_;
    std::optional<Accompaniment> accompaniment_;
    std::uint64_t phrase_ = 1;               // phrases that have begun
    std::uint64_t sounding_phrase_ = 0;      // phrase of the last note; 0: none
    std::int64_t accompanied_ = 0;           // tick of the score up to which chords have been added
    std::vector<Line> shaped_;               // line of each voice
    std::vector<std::int64_t> busy_until_;   // by voice, from the notes already placed
    std::vector<std::int64_t> taken_until_;  // likewise before shaping, if there is a shaper
    std::vector<char> held_;                 // voices held by a branch that has not ended
    struct Gliding {
        Shaper::Draft note;
        bool falling = false;
        bool is_held = false;
    };
    std::vector<Gliding> gliding_;  // by voice
    int held_back_ = 0;             // number of those held
};

}  // namespace sikku::mapping
