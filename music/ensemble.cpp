#include "music/ensemble.h"

#include "music/form/block.h"
#include "music/form/counterpoint.h"
#include "music/held_ending.h"
#include "music/score/glides.h"
#include "music/score/note_order.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t most_score_bars = 1'000'000;

/// Ratio that converts ticks of a part to ticks of the score.
Ratio to_score(const Player& player) {
    const Ratio tempo = player.melody.layout.tempo;
    return {tempo.below, tempo.above};
}

/// Forwards the notes of one part, as voices after those of the parts before it, but not finish().
class PartSink : public NoteSink {
public:
    /// @param later  ticks added to every onset, after the change of tempo
    PartSink(NoteSink& sink, const Player& player, std::int64_t later)
        : sink_(sink), player_(player), later_(later), ratio_(to_score(player)) {}
    void notes(std::span<const Note> notes) override {
        if (player_.first_voice == 0 && later_ == 0 && ratio_.is_one()) return sink_.notes(notes);
        moved_.assign(notes.begin(), notes.end());
        for (Note& note : moved_) {
            note.voice = static_cast<std::int16_t>(note.voice + player_.first_voice);
            note.begins_phrase = note.begins_phrase && !player_.is_follower;
            scale_times(note, ratio_);
            note.onset += later_;
        }
        sink_.notes(moved_);
    }
    void finish(std::int64_t) override {}

private:
    NoteSink& sink_;
    const Player& player_;
    std::int64_t later_;
    Ratio ratio_;
    std::vector<Note> moved_;
};

void add(PlayReport& all, const PlayReport& one) {
    all.notes += one.notes;
    all.moved += one.moved;
    all.lost += one.lost;
    all.lowest = std::min(all.lowest, one.lowest);
    all.highest = std::max(all.highest, one.highest);
    all.past = all.past && one.past;
    for (const auto& [symbol, count] : one.skipped) all.skipped[symbol] += count;
    for (const std::string& symbol : one.unused) {
        if (std::find(all.unused.begin(), all.unused.end(), symbol) == all.unused.end()) all.unused.push_back(symbol);
    }
}

/// Ticks of whole or partial bars before the first bar of a part.
std::int64_t ticks_before(const Player& player, const Meter& meter) {
    return std::llround(player.melody.layout.start * static_cast<double>(meter.bar()));
}

/// @throws ScoreError always: the melody ends before its excerpt
[[noreturn]] void refuse_excerpt(const Player& player) {
    const auto known = census(player.document.grammar(), player.melody);
    throw ScoreError(fmt::format("the excerpt contains no notes: the melody ends {}",
                                 known ? "at bar " + last_bar(known->ticks, player.melody).str()
                                       : fmt::format("before bar {}", player.melody.layout.first_bar)));
}

/// Forwards the parts as they are read.
EnsembleReport stream(const Ensemble& ensemble, const PlayOptions& playing, NoteSink& sink) {
    EnsembleReport all;
    all.past = true;
    for (const Player& player : ensemble.players) {
        std::uint64_t& moved = all.moved_of.emplace_back();
        const std::int64_t start = start_of(player, ensemble.meter, ensemble);
        const std::int64_t later = std::max<std::int64_t>(0, start - playing.from);
        PartSink part(sink, player, later);
        PlayOptions options = playing;
        options.drums_from = player.drums_from;
        options.chords_from = player.chords_from;
        if (player.is_bass) {
            if (all.end == 0) continue;
            options.to = std::min(playing.to, playing.from + all.end);
        }
        options = piece_of_part(player, ensemble, options);
        if (options.from >= options.to) continue;
        PlayReport report = player.play(part, options);
        report.end = to_score(player).of(std::min(report.end, std::int64_t{1} << 50));
        add(all, report);
        moved = report.moved;
        all.end = std::max(all.end, report.end + (report.notes > 0 ? later : 0));
    }
    return all;
}

/// The ticks at which loops of a section end together: `rest`, and every `period` after it.
struct CommonEnds {
    std::int64_t rest = 0;
    std::int64_t period = 1;
    std::int64_t earliest = 0;  ///< time by which all have been played once

    /// Adds a loop. @throws ScoreError if they would never end together, or too late
    void meet(std::int64_t start, std::int64_t length, std::int64_t bar) {
        earliest = std::max(earliest, start + length);
        const std::int64_t common = std::gcd(period, length);
        if ((start - rest) % common != 0) {
            throw ScoreError(
                "the loops begin at different bars and would never end together; use `loop: fill` to end them with "
                "the longest part");
        }
        if (period / common > most_score_bars * bar / length) {
            throw ScoreError(
                "the loops would end together only after more than 1000000 bars; use `loop: fill` to end them "
                "with the longest part");
        }
        // One of the common ends so far is also an end of this loop.
        const std::int64_t modulus = length / common;
        const std::int64_t wanted = ((start - rest) / common % modulus + modulus) % modulus;
        const Integer repeats = Integer(wanted) * inverse(period / common % modulus, modulus) % modulus;
        rest += repeats.convert_to<std::int64_t>() * period;
        period = period / common * length;
        rest %= period;
    }
    std::int64_t first() const {
        return rest + std::max<std::int64_t>(0, (earliest - rest + period - 1) / period) * period;
    }

private:
    /// The inverse of `value` modulo `modulus`, to which it is coprime.
    static std::int64_t inverse(std::int64_t value, std::int64_t modulus) {
        std::int64_t before = 0;
        std::int64_t here = 1;
        for (std::int64_t a = modulus, b = value; b > 1;) {
            before = std::exchange(here, before - a / b * here);
            a = std::exchange(b, a % b);
        }
        return modulus == 1 ? 0 : (here % modulus + modulus) % modulus;
    }
};

/// A part held in memory as a whole.
struct WholePart {
    const Player* player = nullptr;
    Block block;
    std::int64_t start = 0;   ///< ticks of the score, or of its section
    std::int64_t later = 0;   ///< of them, those by which the upbeat of the score exceeds that of the part
    std::int64_t period = 0;  ///< ticks from one repetition to the next
    std::int64_t repeats = 1;
    std::int64_t until = INT64_MAX;  ///< tick at which repetitions are cut off
    std::vector<FormNote> notes;     ///< in ticks of the score, with the voices of the score
    std::int64_t end = 0;
    std::int64_t last() const { return start + repeats * period; }
    /// The tick at which it ends, in bars from its first bar line: those of other parts may have another upbeat.
    std::int64_t end_in_bars() const {
        return (repeats > 1 ? last() : start + end_of_sections(block, player->melody)) - later;
    }
};

/// Plays whole parts and combines them.
class WholeScore {
public:
    WholeScore(const Ensemble& ensemble, const PlayOptions& playing) : ensemble_(ensemble), playing_(playing) {}

    EnsembleReport play(NoteSink& sink) {
        report_.past = true;
        read();
        repeat();
        place();
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (parts_[i].player->melody.layout.is_strict) make_strict(i);
        }
        report_.lowest = PlayReport().lowest;
        report_.highest = PlayReport().highest;
        report_.notes = 0;
        std::int64_t end = 0;
        for (WholePart& part : parts_) {
            write(part, sink);
            end = std::max(end, part.end);
        }
        report_.end = std::max<std::int64_t>(0, std::min(end, playing_.to) - playing_.from);
        report_.past = end <= playing_.from;
        return report_;
    }

    std::vector<SectionStart> sections() {
        read();
        repeat();
        std::vector<SectionStart> starts;
        std::int64_t at = 0;
        for (const FormSection& section : ensemble_.form) {
            const auto letter = static_cast<char>('A' + section.letter);
            starts.push_back({at > 0 ? at + ensemble_.upbeat : 0, letter});
            at += section_length(letter);
        }
        return starts;
    }

private:
    void read() {
        std::int64_t leading = 0;            // length of the last part other than a bass, in its own ticks
        std::int64_t arranged = 0;           // the same in its form, without chords after the end
        std::vector<std::int64_t> sections;  // ends of the sections in its form
        for (const Player& player : ensemble_.players) {
            const Layout& layout = player.melody.layout;
            WholePart part;
            part.player = &player;
            part.start = start_of(player, ensemble_.meter_of(player), ensemble_);
            PlayOptions options = playing_;
            options.drums_from = player.drums_from;
            options.chords_from = player.chords_from;
            const std::int64_t begin = player.melody.begin();
            options.from = begin;
            options.to = player.is_bass ? begin + leading : INT64_MAX;
            if (!layout.needs_whole() && player.section == 0 && playing_.to < INT64_MAX) {
                options.to = std::min(
                    options.to,
                    begin + std::max<std::int64_t>(
                                1, layout.tempo.of(std::max<std::int64_t>(0, playing_.to - part.start)) + 1));
            }
            cut_excerpt(player, options);
            // A drone continues evenly, independently of the form of the melody.
            const bool has_drone = player.melody.harmony == Harmony::drone;
            Melody alone = player.melody;
            if (has_drone) alone.harmony = Harmony::none;
            PlayReport one;
            try {
                part.block = play_block(*player.playable, alone, options, one);
            } catch (const BudgetError& error) {
                if (options.to < INT64_MAX) throw;
                throw BudgetError(fmt::format(
                    "parts in forms, with a climax, reversed, repeated or strict are read as a whole, but "
                    "{}; `excerpt: 1-64` reads a part of it",
                    error.what()));
            }
            if (one.past && has_excerpt(player) && (!layout.form.empty() || layout.thinning > 0 || layout.climax))
                refuse_excerpt(player);
            add(report_, one);
            report_.moved_of.push_back(one.moved);
            if (!player.is_bass) leading = part.block.length;
            if (layout.form.empty()) {
                if (layout.is_retrograde) reverse(part.block);
            } else {
                part.block = in_form(part.block, player.document.grammar(), player.melody, layout.form,
                                     player.is_bass ? sections : std::vector<std::int64_t>());
            }
            if (layout.thinning > 0) thin_out(part.block, player.melody, layout.thinning);
            if (layout.climax && !part.block.notes.empty()) {
                raise_to_climax(part.block, player.melody, *layout.climax);
            }
            if (!player.is_bass) sections = part.block.ends;
            if (has_drone) add_drone(part.block, player.melody, options.chords_from);
            const std::int64_t bar = player.melody.meter.bar();
            // The chords of a bar may last until the end of the next upbeat.
            if (!player.is_bass) arranged = end_of_sections(part.block, player.melody);
            part.period = to_score(player).of((arranged + bar - 1) / bar * bar);
            part.later = upbeat_rest(player, ensemble_);
            scale_times(part.block, to_score(player));
            parts_.push_back(std::move(part));
        }
    }

    /// Determines how often each part is played within its section.
    void repeat() {
        std::map<char, std::int64_t> longest;  // end of each section, without parts that fill it
        std::map<char, CommonEnds> common;
        for (WholePart& part : parts_) {
            const Layout& layout = part.player->melody.layout;
            if (layout.loop == Loop::times) part.repeats = layout.times;
            std::int64_t& end = longest[part.player->section];
            if (layout.loop == Loop::fill) continue;
            if (layout.loop == Loop::common && part.period > 0) {
                common[part.player->section].meet(part.start - part.later, part.period,
                                                  ensemble_.meter_of(*part.player).bar());
                continue;
            }
            end = std::max(end, part.end_in_bars());
        }
        for (WholePart& part : parts_) {
            const char section = part.player->section;
            const Loop loop = part.player->melody.layout.loop;
            if (loop == Loop::common && part.period > 0) {
                part.repeats = (common[section].first() + part.later - part.start) / part.period;
                longest[section] = std::max(longest[section], part.last() - part.later);
            }
        }
        for (WholePart& part : parts_) {
            const char section = part.player->section;
            if (part.player->melody.layout.loop != Loop::fill || part.period == 0) continue;
            if (section == 0 && !ensemble_.form.empty()) {
                longest[0] = std::max(longest[0], form_length());
            }
            part.until = longest[section] + part.later;
            if (part.until <= part.start) part.until = part.last();
            part.repeats = (part.until - part.start + part.period - 1) / part.period;
        }
        double notes = 0;
        for (const WholePart& part : parts_) {
            notes += static_cast<double>(part.repeats) * static_cast<double>(part.block.notes.size()) *
                     (part.player->section == 0 ? 1.0 : static_cast<double>(ensemble_.form.size()));
        }
        if (notes > static_cast<double>(most_block_notes)) {
            throw ScoreError(
                fmt::format("the parts would have {:.0f} notes together, repetitions included; the limit is {}",
                            notes, most_block_notes));
        }
    }

    std::int64_t section_length(char section) const {
        std::int64_t end = 0;
        for (const WholePart& part : parts_) {
            if (part.player->section != section) continue;
            end = std::max(end, part.until < INT64_MAX ? std::min(part.until - part.later, part.end_in_bars())
                                                       : part.end_in_bars());
        }
        const std::int64_t bar = ensemble_.of_section(section).meter.bar();
        return (end + bar - 1) / bar * bar;
    }

    std::int64_t form_length() const {
        std::int64_t length = 0;
        for (const FormSection& section : ensemble_.form)
            length += section_length(static_cast<char>('A' + section.letter));
        return length;
    }

    void place() {
        for (WholePart& part : parts_) {
            if (part.player->section == 0) place(part, 0, Ending::none);
        }
        std::int64_t at = 0;
        for (const FormSection& section : ensemble_.form) {
            const auto letter = static_cast<char>('A' + section.letter);
            for (WholePart& part : parts_) {
                if (part.player->section == letter) place(part, at, section.ending);
            }
            at += section_length(letter);
        }
    }

    /// Adds all repetitions of a part. @param ending  ending of the last
    void place(WholePart& part, std::int64_t at, Ending ending) const {
        for (std::int64_t i = 0; i < part.repeats; ++i) {
            const std::int64_t from = part.start + i * part.period;
            Block block;
            const bool is_last = i + 1 == part.repeats;
            if (is_last && ending != Ending::none) {
                block = part.block;
                end_on(block, part.player->melody, ending);
            }
            for (FormNote one : block.notes.empty() ? part.block.notes : block.notes) {
                if (!is_last) hold_through_upbeat(one, part);
                one.note.onset += from;
                if (one.note.onset >= part.until) continue;
                sikku::cut(one.note, one.note.onset, part.until);
                one.note.onset += at;
                one.note.voice = static_cast<std::int16_t>(one.note.voice + part.player->first_voice);
                part.notes.push_back(one);
            }
        }
        const std::int64_t last = part.start + (part.repeats - 1) * part.period + part.block.length;
        part.end = std::max(part.end, at + std::min(part.until, last));
    }

    /// A drone that is repeated continues during the next upbeat.
    static void hold_through_upbeat(FormNote& one, const WholePart& part) {
        const Melody& melody = part.player->melody;
        const bool is_drone = melody.harmony == Harmony::drone && one.note.voice >= part.block.chords_from;
        if (!is_drone || is_drum(part, one) || one.note.onset + one.note.duration < part.period) return;
        one.note.duration += to_score(*part.player).of(melody.layout.opening());
    }

    static bool is_drum(const WholePart& part, const FormNote& note) {
        const Player& player = *part.player;
        return player.has_drums && note.note.voice >= player.first_voice + player.drums_from;
    }

    void make_strict(std::size_t i) {
        std::vector<FormNote> fixed;
        for (std::size_t before = 0; before < i; ++before) {
            const std::vector<FormNote>& notes = parts_[before].notes;
            std::copy_if(notes.begin(), notes.end(), std::back_inserter(fixed),
                         [&](const FormNote& note) { return !is_drum(parts_[before], note); });
        }
        const Melody& melody = parts_[i].player->melody;
        // Drums are left out, as they form no intervals.
        std::vector<FormNote>& notes = parts_[i].notes;
        const auto first = std::stable_partition(notes.begin(), notes.end(),
                                                 [&](const FormNote& note) { return !is_drum(parts_[i], note); });
        const std::vector<FormNote> drums(first, notes.end());
        notes.erase(first, notes.end());
        report_.moved_by_strictness += sikku::make_strict(fixed, notes, melody, ensemble_.bar_lines());
        notes.insert(notes.end(), drums.begin(), drums.end());
        report_.is_strict = true;
    }

    void write(WholePart& part, NoteSink& sink) {
        link_glides(part.notes);
        std::vector<Note> notes;
        for (const FormNote& one : part.notes) {
            Note note = one.note;
            if (std::max(note.onset, playing_.from) >= std::min(note.onset + note.duration, playing_.to)) continue;
            cut(note, playing_.from, playing_.to);
            note.onset -= playing_.from;
            note.begins_phrase = note.begins_phrase && !part.player->is_follower;
            if (!is_drum(part, one)) {
                report_.lowest = std::min(report_.lowest, note.key);
                report_.highest = std::max(report_.highest, note.key);
            }
            notes.push_back(note);
        }
        sort_by_time(notes);
        report_.notes += notes.size();
        constexpr std::size_t at_once = 1024;
        for (std::size_t i = 0; i < notes.size(); i += at_once) {
            sink.notes(std::span(notes).subspan(i, std::min(at_once, notes.size() - i)));
        }
    }

    const Ensemble& ensemble_;
    const PlayOptions& playing_;
    std::vector<WholePart> parts_;
    EnsembleReport report_;
};

/// Explains why there are no notes. @throws ScoreError always
[[noreturn]] void refuse_silence(const Ensemble& ensemble, const PlayOptions& playing, const PlayReport& all) {
    if (playing.from > 0 && all.past) {
        Integer bars = 0;
        for (const Player& player : ensemble.players) {
            const auto known = census(player.document.grammar(), player.melody);
            if (!known || player.melody.layout.needs_whole() || !ensemble.form.empty()) {
                throw ScoreError("the requested bars contain no notes: the melody ends before them");
            }
            bars = std::max(bars, last_bar(known->ticks, player.melody));
        }
        throw ScoreError(fmt::format("the requested bars contain no notes: the melody ends at bar {}", bars.str()));
    }
    const Layout& layout = ensemble.players.front().melody.layout;
    if (all.past && layout.first_bar > 1) refuse_excerpt(ensemble.players.front());
    if (playing.to <= playing.from)
        throw ScoreError("the requested time is shorter than a tick, a 480th of a quarter");
    throw ScoreError(
        fmt::format("the {} no notes{}",
                    playing.from > 0 || playing.to < INT64_MAX ? "requested bars contain" : "melody contains",
                    reason_of_silence(ensemble.players.front(), all.lost)));
}

}  // namespace

std::int64_t upbeat_rest(const Player& player, const Ensemble& ensemble) {
    return ensemble.upbeat - player.melody.layout.opening();
}

std::int64_t start_of(const Player& player, const Meter& meter, const Ensemble& ensemble) {
    return ticks_before(player, meter) + upbeat_rest(player, ensemble);
}

std::int64_t upbeat_of(const std::vector<Player>& players, const Meter& meter, std::optional<char> first_section) {
    std::int64_t upbeat = 0;
    for (const Player& player : players) {
        if (player.section != 0 && player.section != first_section) continue;
        upbeat = std::max(upbeat, player.melody.layout.opening() - ticks_before(player, meter));
    }
    return upbeat;
}

PlayOptions piece_of_part(const Player& player, const Ensemble& ensemble, const PlayOptions& playing) {
    const Layout& layout = player.melody.layout;
    const std::int64_t start = start_of(player, ensemble.meter, ensemble);
    PlayOptions options = playing;
    options.from = std::max<std::int64_t>(0, playing.from - start);
    if (playing.to <= start) {
        options.to = options.from;
        return options;
    }
    if (options.to < INT64_MAX) options.to -= start;
    if (!layout.tempo.is_one()) {
        options.from = layout.tempo.of(options.from);
        if (options.to < INT64_MAX) options.to = layout.tempo.of(options.to);
    }
    options.from += player.melody.begin();
    if (options.to < INT64_MAX) options.to += player.melody.begin();
    cut_excerpt(player, options);
    return options;
}

std::int64_t Ensemble::ritardando(const PlayOptions& playing) const {
    const std::int64_t last = playing.to < INT64_MAX ? playing.to - 1 : INT64_MAX;
    return 2 * tempo_and_meter(last).meter.bar();
}

TempoAndMeter Ensemble::of_section(char section) const {
    if (section == 0 || section_tempos.empty()) return {tempo, tempo_words, meter};
    TempoAndMeter result = piece;
    const auto stated = section_tempos.find(section);
    if (stated == section_tempos.end()) return result;
    if (stated->second.tempo) {
        result.tempo = *stated->second.tempo;
        result.tempo_words = stated->second.tempo_words;
    }
    if (stated->second.meter) result.meter = *stated->second.meter;
    return result;
}

std::vector<SectionStart> section_starts(const Ensemble& ensemble, const PlayOptions& whole) {
    return WholeScore(ensemble, whole).sections();
}

std::vector<SectionChange> section_changes(const Ensemble& ensemble) {
    std::vector<SectionChange> changes;
    TempoAndMeter before = ensemble.tempo_and_meter(0);
    for (const SectionStart& start : ensemble.sections) {
        const TempoAndMeter next = ensemble.of_section(start.section);
        if (start.onset > 0 && next != before) changes.push_back({start.onset, next});
        before = next;
    }
    return changes;
}

bool Ensemble::needs_whole() const {
    return !form.empty() || std::any_of(players.begin(), players.end(),
                                        [](const Player& player) { return player.melody.layout.needs_whole(); });
}

bool Ensemble::is_strict() const {
    return std::any_of(players.begin(), players.end(),
                       [](const Player& player) { return player.melody.layout.is_strict; });
}

bool Ensemble::has_expression() const {
    return std::any_of(players.begin(), players.end(),
                       [](const Player& player) { return player.melody.expression.any(); });
}

bool Ensemble::has_bends() const {
    return std::any_of(players.begin(), players.end(),
                       [](const Player& player) { return !player.melody.expression.gamakas.empty(); });
}

bool Ensemble::has_glides() const {
    return std::any_of(players.begin(), players.end(), [](const Player& player) {
        return player.melody.mapping == Mapping::runs && player.melody.vertical == Vertical::glissando;
    });
}

bool Ensemble::has_ending(const PlayOptions& playing) const {
    return close != Close::none && (!playing.is_excerpt() || ends_excerpts);
}

bool Ensemble::has_several_keys() const {
    const auto key_of = [](const Player& player) {
        return key_signature(player.melody.scale, player.melody.tonic_spelling);
    };
    return std::any_of(players.begin(), players.end(),
                       [&](const Player& player) { return key_of(player) != key_of(players.front()); });
}

bool Ensemble::has_tempo_ratio() const {
    return std::any_of(players.begin(), players.end(),
                       [](const Player& player) { return !player.melody.layout.tempo.is_one(); });
}

namespace {

/// Converts seconds, counted from a tick, to ticks.
double ticks_after(const Ensemble& ensemble, std::int64_t from, double seconds) {
    const auto ticks_in = [](double time, double tempo) {
        return time * tempo / 60 * static_cast<double>(ticks_per_quarter);
    };
    double tempo = ensemble.tempo_and_meter(from).tempo;
    double ticks = 0;
    for (const SectionChange& change : changes_after(ensemble.changes, from)) {
        const double until = static_cast<double>(change.onset) - ticks;
        if (ticks_in(seconds, tempo) <= until) break;
        seconds -= until / ticks_in(1, tempo);
        ticks = static_cast<double>(change.onset);
        tempo = change.to.tempo;
    }
    return ticks + ticks_in(seconds, tempo);
}

}  // namespace

PlayOptions piece_of(const PlaySettings& options, const Ensemble& ensemble, const Monitor& monitor) {
    PlayOptions playing;
    playing.most_voices = most_voices;
    playing.budget = options.budget;
    playing.watch = [monitor](std::uint64_t symbols) { monitor.advance(symbols); };
    const std::int64_t bar = ensemble.meter.bar();
    Integer from = Integer(options.from_bar - 1) * bar;
    // The first bar includes its upbeat.
    if (from > 0) from += ensemble.upbeat;
    const Integer farthest = Integer(1) << 60;
    if (from > farthest) {
        Integer periods = 1;
        bool is_plain = !ensemble.has_tempo_ratio() && ensemble.form.empty();
        for (const Player& player : ensemble.players) {
            periods = boost::multiprecision::lcm(periods, period(player.melody));
            is_plain = is_plain && !player.melody.layout.needs_whole();
        }
        if (periods > farthest / 4 || !is_plain) {
            throw SettingError("from-bar", std::to_string(options.from_bar),
                               "this bar is too far from the beginning for these parts");
        }
        playing.ahead = (from - (Integer(1) << 50)) / periods * periods;
        from -= playing.ahead;
    }
    playing.from = from.convert_to<std::int64_t>();
    if (!ensemble.changes.empty()) {
        const BarLines bars = ensemble.bar_lines();
        std::int64_t longest = bar;
        for (const SectionChange& change : ensemble.changes) longest = std::max(longest, change.to.meter.bar());
        const std::int64_t most_bars = (INT64_MAX / 8) / longest;
        const std::int64_t first = std::min(options.from_bar - 1, most_bars);
        playing.from = bars.onset(first);
        if (options.bars > 0) playing.to = bars.onset(first + std::min(options.bars, most_bars));
    } else if (options.bars > 0) {
        playing.to = playing.from + std::min(options.bars, (INT64_MAX / 4) / bar) * bar;
        if (playing.from == 0) playing.to += ensemble.upbeat;
    }
    if (options.seconds > 0) {
        const double ticks = ticks_after(ensemble, playing.from, options.seconds);
        playing.to = std::min(playing.to, playing.from + static_cast<std::int64_t>(std::min(ticks, 4e18)));
    }
    return playing;
}

EnsembleReport play_parts(const Ensemble& ensemble, const PlayOptions& playing, NoteSink& sink) {
    const auto play_into = [&](NoteSink& to) {
        return ensemble.needs_whole() ? WholeScore(ensemble, playing).play(to) : stream(ensemble, playing, to);
    };
    if (ensemble.close != Close::fermata) return play_into(sink);
    HeldEnding ending(ensemble, sink);
    EnsembleReport report = play_into(ending);
    const std::int64_t most = playing.to < INT64_MAX ? playing.to - playing.from : INT64_MAX;
    // An excerpt has an ending only if it contains the end of the whole, or if one is requested.
    report.end = report.end < most || ensemble.ends_excerpts
                     ? ending.finish(report.end, ensemble.bar_lines().from(playing.from), most)
                     : ending.finish_as_cut(report.end);
    return report;
}

EnsembleReport play_all(const Ensemble& ensemble, const PlayOptions& playing, NoteSink& sink) {
    EnsembleReport all = play_parts(ensemble, playing, sink);
    if (all.notes == 0) refuse_silence(ensemble, playing, all);
    sink.finish(all.end);
    return all;
}

}  // namespace sikku
