// music/ensemble.h: all parts of a score and the order in which they are played.
#pragma once

#include "music/melody/layout.h"
#include "music/players.h"
#include "music/score/bar_lines.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Where a section of the score begins.
struct SectionStart {
    std::int64_t onset = 0;  ///< ticks; after the upbeat, except for the first section
    char section = 'A';
};

/// The parts of a score, with the tempo and meter with which it begins.
struct Ensemble {
    std::vector<Player> players;
    std::vector<FormSection> form;  ///< sections of the score; empty: all parts play from the beginning
    double tempo = 120;             ///< quarters a minute
    std::string tempo_words;        ///< printed before it; may be empty
    Meter meter;
    std::int64_t upbeat = 0;                        ///< ticks before the first bar line; 0: it begins at a bar line
    TempoAndMeter piece{};                          ///< those of sections that state none
    std::map<char, SectionTempo> section_tempos{};  ///< tempo and meter of sections that state them
    std::vector<SectionStart> sections{};           ///< of the form, ascending, if they are known
    std::vector<SectionChange> changes{};           ///< of tempo and meter, at the bar lines where sections begin
    Close close = Close::none;
    bool ends_excerpts = false;  ///< excerpts end with `close`, too, not only the whole

    BarLines bar_lines() const { return {meter, changes, upbeat}; }
    /// Tempo and meter from a tick on.
    TempoAndMeter tempo_and_meter(std::int64_t tick) const {
        return tempo_and_meter_at({tempo, tempo_words, meter}, changes, tick);
    }
    /// Tempo and meter of a section; 0: those with which the score begins.
    TempoAndMeter of_section(char section) const;
    /// The meter in which the bars of a player are counted.
    Meter meter_of(const Player& player) const { return of_section(player.section).meter; }
    /// Quarters a minute at a tick.
    double tempo_at(std::int64_t tick) const { return changes.empty() ? tempo : tempo_and_meter(tick).tempo; }
    /// Ticks before the end in which the tempo falls: two bars of the last meter.
    std::int64_t ritardando(const PlayOptions& playing) const;
    /// True if what is played ends with `close`, whatever it contains.
    bool has_ending(const PlayOptions& playing) const;
    /// True if whole parts must be known before the first note is played.
    bool needs_whole() const;
    /// True if a part gives way to others.
    bool is_strict() const;
    /// True if a key of a part makes velocity, tempo, pan or pitch follow the curve.
    bool has_expression() const;
    /// True if notes of a part have gamakas.
    bool has_bends() const;
    /// True if notes of a part slide to the next.
    bool has_glides() const;
    /// True if a part has a tempo of its own.
    bool has_tempo_ratio() const;
    /// True if the key signatures of two parts differ.
    bool has_several_keys() const;
};

/// Report about playing all parts.
struct EnsembleReport : PlayReport {
    std::vector<std::uint64_t> moved_of;      ///< `moved`, by player
    bool is_strict = false;                   ///< a part is strict
    std::uint64_t moved_by_strictness = 0;    ///< notes that give way to other parts
    std::vector<std::int64_t> strict_faults;  ///< see StrictCheck; set by perform()
    double seconds = 0;                       ///< with all changes of tempo; 0: unknown
    /// Curves of an excerpt have the ranges of the bars around it, because the whole is too long to be played for
    /// them.
    bool has_own_ranges = false;
};

/// Lists where the sections of the form begin. Reads all parts, because their lengths determine it.
/// @param whole  the whole score. @throws as play_all()
std::vector<SectionStart> section_starts(const Ensemble& ensemble, const PlayOptions& whole);

/// Lists the changes of tempo and meter between the sections that are known.
std::vector<SectionChange> section_changes(const Ensemble& ensemble);

/// The requested piece, in ticks. @throws SettingError
PlayOptions piece_of(const PlaySettings& options, const Ensemble& ensemble, const Monitor& monitor);

/// Ticks before the first bar line of a score, from the beginning of the part that begins first.
/// @param first_section  letter of the section with which a form begins
std::int64_t upbeat_of(const std::vector<Player>& players, const Meter& meter, std::optional<char> first_section);

/// Ticks by which the upbeat of the score exceeds that of a part; negative if it is shorter.
std::int64_t upbeat_rest(const Player& player, const Ensemble& ensemble);

/// Tick of the score, or of its section, at which a part begins. @param meter  of the section
std::int64_t start_of(const Player& player, const Meter& meter, const Ensemble& ensemble);

/// The piece of the score in ticks of a part. If `from` is not below `to`, the part is silent there.
PlayOptions piece_of_part(const Player& player, const Ensemble& ensemble, const PlayOptions& playing);

/// Plays all parts into `sink` like play_all(), but accepts silence and does not call finish().
EnsembleReport play_parts(const Ensemble& ensemble, const PlayOptions& playing, NoteSink& sink);

/// Plays all parts into `sink`. Parts that are reversed, looped, strict, in a form or in sections are held in memory,
/// with at most 4,000,000 notes together; others are passed on as they are read.
/// @throws as play(); ScoreError if there are no notes, or too many
EnsembleReport play_all(const Ensemble& ensemble, const PlayOptions& playing, NoteSink& sink);

}  // namespace sikku
