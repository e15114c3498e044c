#include "music/score_remarks.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/lattice.h"
#include "music/melody/melody_fold.h"
#include "music/score/instruments.h"
#include "music/score/midi.h"
#include "music/score/rhythm.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {
namespace {

/// Treatment of notes beyond the range of a melody, for a remark.
std::string_view fate_of(const Melody& melody) {
    const double period = std::fabs(melody.scale.period) / 100;
    if (melody.range == Range::reflect) return "reflected";
    // A range narrower than a period contains no other octave of most notes.
    return melody.range == Range::fold && period <= melody.highest - melody.lowest ? "folded back"
                                                                                   : "held at the last key";
}

/// Adds a remark for each range that notes lay beyond.
void report_moved(const Ensemble& ensemble, const PlayOptions& playing, const EnsembleReport& report, Made& made) {
    struct Moved {
        const Melody* melody;
        std::uint64_t notes;
        std::vector<std::string_view> instruments;
        bool is_anchored;  // by the first note of the whole melody
    };
    std::vector<Moved> ranges;
    for (std::size_t i = 0; i < report.moved_of.size(); ++i) {
        if (report.moved_of[i] == 0) continue;
        const Melody& melody = ensemble.players[i].melody;
        const auto is_same = [&](const Moved& one) {
            return one.melody->lowest == melody.lowest && one.melody->highest == melody.highest &&
                   fate_of(*one.melody) == fate_of(melody);
        };
        auto known = std::find_if(ranges.begin(), ranges.end(), is_same);
        if (known == ranges.end()) known = ranges.insert(known, {&melody, 0, {}, false});
        known->notes += report.moved_of[i];
        known->is_anchored = known->is_anchored || melody.anchor != Anchor::piece;
        const std::string_view name = instrument_of(melody.program).name;
        auto& names = known->instruments;
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    for (const Moved& one : ranges) {
        const auto spelling = spell(one.melody->scale, one.melody->tonic_spelling);
        made.warn(fmt::format(
            "{}{} {} beyond {} to {} and {}{}{}", counted(one.notes, "note"),
            ranges.size() > 1 ? fmt::format(" of {}", fmt::join(one.instruments, ", ")) : "",
            one.notes == 1 ? "was" : "were", note_name(one.melody->lowest, spelling),
            note_name(one.melody->highest, spelling), fate_of(*one.melody),
            playing.is_excerpt() && ensemble.needs_whole() ? " in the whole score" : "",
            playing.from > 0 && one.is_anchored ? "; with `anchor: piece` the piece begins on the tonic" : ""));
    }
}

/// Suggests a key with which notes would begin and end on note values; empty if none is known.
std::string_view remedy_for_moved(const Ensemble& ensemble) {
    for (const Player& player : ensemble.players) {
        const Melody& melody = player.melody;
        Note step;
        step.duration = melody.unit;
        const Grid grid = grid_of(std::span(&step, 1), ensemble.meter);
        if (grid.nearest(melody.unit) != melody.unit) return "; another `unit` such as 1/8 keeps the rhythm";
        int first = 0;
        const bool is_on_square_grid = is_on_grid(make_lattice(player.document.grammar()), first);
        if (melody.mapping == Mapping::runs && melody.rhythm.empty() && !is_on_square_grid) {
            return "; the curve leaves the square grid, where `rhythm: x` makes each step last one unit";
        }
    }
    return {};
}

/// Names of the parts that share a MIDI channel on which a voice has pan or a controller of its own.
/// @param head            head of the ensemble, whose voices are numbered
/// @param share_channels  as in MidiOptions
std::vector<std::string> parts_controlled_together(const Ensemble& ensemble, const ScoreHead& head,
                                                   bool share_channels) {
    struct Channel {
        int voices = 0;
        bool is_controlled = false;
    };
    constexpr int drums = -1;
    const std::vector<int> slots = share_channels ? channel_slots(head) : std::vector<int>();
    std::map<int, Channel> channels;
    const auto is_controlled = [&](int voice) {
        const auto next = std::find_if(ensemble.players.begin(), ensemble.players.end(),
                                       [&](const Player& player) { return player.first_voice > voice; });
        const MelodicExpression& expression = std::prev(next)->melody.expression;
        return expression.pan.is_on() || expression.control.is_on();
    };
    // Voices of a part use one channel if channels are shared; those of drums always do.
    const auto each_shared = [&](const auto& visit) {
        int voice = 0;
        for (std::size_t i = 0; i < head.parts.size(); voice += head.parts[i].voices, ++i) {
            if (head.parts[i].is_drums || share_channels) {
                visit(head.parts[i], head.parts[i].is_drums ? drums : slots[i], voice);
            }
        }
    };
    each_shared([&](const Part& part, int channel, int voice) {
        channels[channel].voices += part.voices;
        // Accompaniments have no place on the curve to follow.
        if (!part.is_accompaniment && is_controlled(voice)) channels[channel].is_controlled = true;
    });
    std::vector<std::string> names;
    each_shared([&](const Part& part, int channel, int) {
        if (channels[channel].voices < 2 || !channels[channel].is_controlled) return;
        if (std::find(names.begin(), names.end(), part.name) == names.end()) names.push_back(part.name);
    });
    return names;
}

/// `, in bars 9, 13 and 21`
std::string bars_with_faults(const std::vector<std::int64_t>& ticks, const BarLines& lines) {
    constexpr std::size_t most_named = 4;
    std::vector<std::int64_t> bars;
    for (const std::int64_t tick : ticks) {
        const std::int64_t bar = lines.printed_number(tick);
        if (bars.empty() || bars.back() != bar) bars.push_back(bar);
    }
    if (bars.empty()) return "";
    const std::size_t named = std::min(bars.size(), most_named);
    std::string text = fmt::format(", in bar{} {}", bars.size() == 1 ? "" : "s", bars.front());
    for (std::size_t i = 1; i < named; ++i) {
        text += fmt::format("{}{}", i + 1 == bars.size() ? " and " : ", ", bars[i]);
    }
    return bars.size() > named ? fmt::format("{} and {} others", text, bars.size() - named) : text;
}

}  // namespace

void report_shared_channels(const Ensemble& ensemble, const ScoreHead& head, bool share_channels, Made& made) {
    const std::vector<std::string> names = parts_controlled_together(ensemble, head, share_channels);
    if (names.empty()) return;
    made.warn(fmt::format("voices of {} share MIDI channels, and with them pan and controllers{}",
                          fmt::join(names, ", "), share_channels ? "; 'tuning' mpe gives each note a channel" : ""));
}

void report_notes(const Ensemble& ensemble, const PlayOptions& playing, const EnsembleReport& report, Made& made) {
    const Melody& first = ensemble.players.front().melody;
    made.fact(fmt::format("{}, {}, {}, {}", counted(report.notes, "note"),
                          counted(ensemble.bar_lines().from(playing.from).count(report.end), "bar"),
                          report.seconds > 0 ? time_text(report.seconds) : time_of(report.end, ensemble.tempo),
                          range_of(report, first)));
    if (report.is_strict) {
        std::vector<std::int64_t> faults = report.strict_faults;
        for (std::int64_t& tick : faults) tick += playing.from;
        made.fact(fmt::format("counterpoint: {} moved{}, {} left{}", counted(report.moved_by_strictness, "note"),
                              playing.is_excerpt() ? " in the whole score" : "",
                              counted(report.strict_faults.size(), "fault"),
                              bars_with_faults(faults, ensemble.bar_lines())));
    }
    if (report.has_own_ranges) {
        made.warn(
            "the whole score is too long to play for this excerpt: velocities, controllers and tempo that follow the "
            "curve use the range of the nearby bars only");
    }
    report_moved(ensemble, playing, report, made);
    if (report.lost > 0) {
        made.warn(counted(report.lost, "note") + " too short for a tick, or without a key, left out");
    }
    if (!report.skipped.empty()) made.fact("symbols without a sound: " + skipped_text(report.skipped));
    for (const std::string& symbol : report.unused) {
        made.warn(fmt::format("the pattern does not contain the symbol '{}' of the table{}", printable(symbol),
                              symbol.size() > 1 ? "; names are listed under `symbols:`" : ""));
    }
    for (const Player& player : ensemble.players) {
        const Melody& melody = player.melody;
        if (player.is_bass || player.is_follower) continue;
        const Meter meter = ensemble.meter_of(player);
        const bool has_meter = melody.meter.beats == meter.beats && melody.meter.unit == meter.unit;
        if (melody.tempo != ensemble.piece.tempo || (!has_meter && !player.document.has_override("meter"))) {
            made.warn(printable(player.document.text("title")) +
                      " is played in the tempo and meter of the first pattern");
        }
    }
}

void report_notation(const Notation& notation, const Ensemble& ensemble, Made& made) {
    if (notation.moved > 0) {
        const bool is_one = notation.moved == 1;
        made.warn(
            fmt::format("{} not begin or end at a 64th or in a tuplet of 3, 5, 6, 7, 10 or 12 and {} written at the "
                        "nearest 64th{}",
                        is_one ? "1 note does" : counted(notation.moved, "note") + " do", is_one ? "is" : "are",
                        remedy_for_moved(ensemble)));
    }
    for (const auto& [program, outside] : notation.outside) {
        const KeyRange range = *range_of_instrument(program);
        const auto spelling = spell(*find_scale("major"), {});
        const bool is_low = outside.lowest < range.lowest;
        made.warn(fmt::format("{} {} outside the range of {} ({} to {}); the {} is {}",
                              counted(outside.notes, "note"), outside.notes == 1 ? "lies" : "lie",
                              instrument_of(program).printed, note_name(range.lowest, spelling),
                              note_name(range.highest, spelling), is_low ? "lowest" : "highest",
                              note_name(is_low ? outside.lowest : outside.highest, spelling)));
    }
    if (notation.merged > 0) {
        made.fact(fmt::format("{} in unison with other voices printed once", counted(notation.merged, "note")));
    }
    if (notation.bent > 0) {
        made.warn(fmt::format("{} written as the nearest quarter tone, with the difference in cents",
                              notation.bent == 1 ? "1 note is" : counted(notation.bent, "note") + " are"));
    }
}

}  // namespace sikku
