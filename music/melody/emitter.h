// music/melody/emitter.h: passes notes from the readers of words to a sink.
#pragma once

#include "music/melody/accompaniment.h"
#include "music/melody/degree_range.h"
#include "music/melody/mapping.h"
#include "music/melody/shaper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sikku::mapping {

/// Represents a height, a degree or a position that is not known yet.
constexpr std::int64_t unknown = std::numeric_limits<std::int64_t>::min();

/// Converts degrees to keys and passes the notes of the requested piece to the sink, counted and in blocks.
class Emitter {
public:
    Emitter(const Melody& melody, NoteSink& sink, const PlayOptions& options)
        : melody_(melody), sink_(sink), options_(options) {
        if (melody.is_shaped()) shaper_.emplace(melody);
        if (melody.accompanying_voices() > 0) accompaniment_.emplace(melody);
        block_.reserve(notes_in_block);
        for (auto& keys : keys_) keys.assign(2 * cached_degrees, Placed{});
    }

    /// State of a voice between its notes.
    struct Line {
        int voice = -1;
        std::int64_t last_degree = unknown;
        bool falling = false;
    };

    /// @param symbol  as in Note
    void note(Line& line, std::int64_t degree, std::int64_t onset, std::int64_t end, int velocity, glm::dvec2 from,
              glm::dvec2 to, std::uint64_t symbol) {
        if (melody_.is_inverted) degree = -degree;
        degree += melody_.shift;
        if (shaper_) {
            take_time(line, onset, end);
            Shaper::Draft draft{degree, onset, end, velocity, depth, level, from, to, symbol};
            draft.emphasis = emphasis;
            shaper_->add(line.voice, draft);
            return hand_on();
        }
        place(line, degree, onset, end, velocity, from, to, symbol);
    }

    /// Passes on a note of a table of symbols; a fixed key sounds as stated.
    void note(Line& line, Shaper::Draft draft) {
        take_time(line, draft.onset, draft.end);
        draft.voice = line.voice;
        draft.depth = depth;
        draft.level = level;
        draft.emphasis = emphasis;
        if (!shaper_) return place_fixed(line, draft);
        shaper_->add(line.voice, draft);
        hand_on();
    }

    /// Passes on a note whose pitch slides.
    void gliding_note(Line& line, Shaper::Draft draft) {
        for (std::int64_t* degree : {&draft.degree, &draft.goal}) {
            *degree = (melody_.is_inverted ? -*degree : *degree) + melody_.shift;
        }
        take_time(line, draft.onset, draft.end);
        draft.voice = line.voice;
        draft.depth = depth;
        draft.level = level;
        draft.emphasis = emphasis;
        if (!shaper_) return place_gliding(line, draft);
        shaper_->add(line.voice, draft);
        hand_on();
    }

    /// Ends the phrase of a voice with its last note.
    void end_phrase(int voice, bool is_odd) {
        if (!shaper_) return;
        shaper_->end_phrase(voice, is_odd);
        hand_on();
    }

    /// Records that a phrase has ended and the next begins at `tick`.
    void begin_phrase(std::int64_t tick) const {
        if (options_.phrase_ends) options_.phrase_ends->push_back(tick - options_.from);
    }

    /// True if symbols read from `tick` on, the end of the piece or later, cannot affect the piece.
    bool may_stop(std::int64_t tick) const {
        return !shaper_ || shaper_->first_pending() >= options_.to || tick >= options_.to + 64 * melody_.meter.bar();
    }

    bool is_shaped() const { return shaper_.has_value(); }

    /// Lets triads follow this voice instead of the first.
    void follow(int voice) {
        if (shaper_) shaper_->follow(voice);
    }

    int depth = 0;        ///< brackets around the next note
    int level = 0;        ///< level of the next note, as in Note
    Emphasis emphasis{};  ///< emphasis of the next note; its velocity does not include the accent

private:
    /// Places the notes that are shaped.
    void hand_on() {
        const int here = depth;
        const int begun = level;
        const Emphasis stated = emphasis;
        for (const Shaper::Draft& note : shaper_->take()) {
            const auto at = static_cast<std::size_t>(note.voice);
            if (at >= shaped_.size()) shaped_.resize(at + 1);
            shaped_[at].voice = note.voice;
            depth = note.depth;
            level = note.level;
            emphasis = note.emphasis;
            if (note.is_moved && note.end > options_.from && note.onset < options_.to) ++report.moved;
            if (note.is_fixed()) {
                place_fixed(shaped_[at], note);
                continue;
            }
            if (note.glide > 0) {
                place_gliding(shaped_[at], note);
                continue;
            }
            place(shaped_[at], note.degree, note.onset, note.end, note.velocity, note.from, note.to, note.symbol);
        }
        depth = here;
        level = begun;
        emphasis = stated;
        for (const auto& [begin, end, chord] : shaper_->take_chords()) {
            const std::int64_t bar = melody_.meter.bar();
            std::int64_t at = std::max(begin, options_.from / bar * bar);
            for (; at < std::min(end, options_.to); at += bar) accompany(at, chord);
        }
    }

    static std::uint8_t sounding_velocity(int velocity, const Emphasis& emphasis) {
        const int accent = emphasis.is_accented ? accent_velocity : 0;
        return static_cast<std::uint8_t>(std::clamp(velocity + accent, 1, 127));
    }

    /// Plays the accompaniment of a bar.
    void accompany(std::int64_t begin, const Chord* chord);
    /// Places a note by its fixed key, or else by its degree.
    void place_fixed(Line& line, const Shaper::Draft& note);
    void reserve(Line& line, std::int64_t onset, std::int64_t end);
    /// Holds a note back until it is known where its pitch slides.
    void place_gliding(Line& line, const Shaper::Draft& note);
    /// Passes on the note of a voice that was held back. @param next  the note after it; null if there is none
    void settle(int voice, const Shaper::Draft* next, bool falling);

    void place(Line& line, std::int64_t degree, std::int64_t onset, std::int64_t end, int velocity, glm::dvec2 from,
               glm::dvec2 to, std::uint64_t symbol) {
        if (line.last_degree != unknown && degree != line.last_degree) line.falling = degree < line.last_degree;
        line.last_degree = degree;
        if (end <= onset) {
            ++report.lost;
            return;
        }
        // Notes before the piece count, so that voices are those of the whole melody.
        if (line.voice < 0) line.voice = free_voice(onset);
        if (line.voice >= static_cast<int>(busy_until_.size())) busy_until_.resize(line.voice + 1U, 0);
        busy_until_[static_cast<std::size_t>(line.voice)] = end;
        if (held_back_ > 0) {
            Shaper::Draft next;
            next.degree = degree;
            next.onset = onset;
            settle(line.voice, &next, line.falling);
        }
        if (end <= options_.from || onset >= options_.to) return;
        const Placed placed = key_of(degree, line.falling);
        if (placed.is_silent) {
            ++report.lost;
            return;
        }
        report.moved += placed.is_moved ? 1 : 0;
        ++report.notes;
        report.lowest = std::min(report.lowest, placed.key);
        report.highest = std::max(report.highest, placed.key);
        onset = std::max(onset, options_.from);
        block_.push_back({onset - options_.from, std::min(end, options_.to) - onset, placed.key,
                          static_cast<std::int16_t>(line.voice), sounding_velocity(velocity, emphasis), from, to,
                          symbol, static_cast<std::uint8_t>(std::min(depth, 255)), static_cast<std::uint8_t>(level)});
        block_.back().emphasis = emphasis;
        if (options_.degrees) options_.degrees->push_back(placed.degree);
        if (block_.size() == notes_in_block) flush();
    }

public:
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

private:
    struct Placed {
        double key = std::numeric_limits<double>::quiet_NaN();  // not looked up yet
        bool is_moved = false;
        bool is_silent = false;
        std::int64_t degree = 0;  // sounding degree
    };

    void flush() {
        if (!block_.empty()) sink_.notes(block_);
        block_.clear();
    }

    int free_voice(std::int64_t onset);
    /// Assigns a voice to a line, until `end`.
    void take_time(Line& line, std::int64_t onset, std::int64_t end);

    Placed key_of(std::int64_t degree, bool falling) {
        if (degree < -cached_degrees || degree >= cached_degrees) return look_up(degree, falling);
        Placed& known = keys_[falling ? 1 : 0][static_cast<std::size_t>(degree + cached_degrees)];
        if (std::isnan(known.key)) known = look_up(degree, falling);
        return known;
    }

    bool is_within(double key) const { return key >= melody_.lowest && key <= melody_.highest; }

    Placed look_up(std::int64_t degree, bool falling);
    /// The sound of a degree within the range, moved by the interval of a canon.
    Placed answered(Placed placed, bool falling) const;
    /// @param raw  the key of the degree, possibly beyond the range
    Placed within_range(double raw, std::int64_t degree, bool falling);
    [[noreturn]] void refuse(std::int64_t degree, const std::string& key) const;

    static constexpr std::size_t notes_in_block = 1024;
    static constexpr std::int64_t cached_degrees = 8192;
    const Melody& melody_;
    NoteSink& sink_;
    const PlayOptions& options_;
    std::vector<Note> block_;
    std::array<std::vector<Placed>, 2> keys_;
    std::optional<DegreeRange> range_;  // created once a note lies beyond it
    std::optional<Shaper> shaper_;
    std::optional<Accompaniment> accompaniment_;
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
