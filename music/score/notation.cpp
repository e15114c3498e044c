#include "music/score/notation.h"

#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_notes = 200'000;
constexpr std::int64_t most_bars = 100'000;
constexpr double middle_c = 60.0;
constexpr double two_octaves = 24.0;
constexpr std::size_t voices_per_staff = 4;
constexpr double unheard = 0.01;  // semitones

/// In 64ths, longest first. A dotted 64th would need 128ths.
constexpr std::array<std::int64_t, 13> printable_list = {96, 64, 48, 32, 24, 16, 12, 8, 6, 4, 3, 2, 1};

std::int64_t nearest_64th(std::int64_t ticks) {
    return (ticks + ticks_per_sixty_fourth / 2) / ticks_per_sixty_fourth;
}

/// Where the beats of a meter are, in 64ths.
struct Beats {
    std::int64_t bar;
    std::int64_t beat;
    std::int64_t middle;  ///< the bar's length if it has no middle
    bool dotted;          ///< three units make a beat

    explicit Beats(const Meter& meter)
        : bar(64 * meter.beats / meter.unit), dotted(meter.beats > 3 && meter.beats % 3 == 0 && meter.unit >= 8) {
        beat = dotted ? 3 * 64 / meter.unit : 64 / meter.unit;
        middle = (bar / beat) % 2 == 0 ? bar / 2 : bar;
    }

    bool fits(std::int64_t from, std::int64_t to) const {
        const bool on_beat = from % beat == 0;
        if (dotted) {
            const std::int64_t beat_end = (from / beat + 1) * beat;
            return to <= beat_end || (on_beat && to % beat == 0);
        }
        if (on_beat) return true;
        if (from < middle && to > middle) return false;
        // The largest power of two in `from` is its metrical place.
        const std::int64_t wider = 4 * (from & -from);
        return to <= (from / wider + 1) * wider;
    }
};

double median(std::vector<double> keys) {
    const auto middle = keys.begin() + static_cast<std::ptrdiff_t>(keys.size() / 2);
    std::nth_element(keys.begin(), middle, keys.end());
    return *middle;
}

/// Says which notes need their sign printed: signs hold to the end of the bar, for their octave, in all voices of the
/// staff; a note tied over the bar line needs none and sets none.
void set_signs(Staff& staff, const std::array<int, 7>& key, std::int64_t bar) {
    std::vector<NotatedSymbol*> notes;
    for (NotatedVoice& voice : staff.voices) {
        for (NotatedSymbol& symbol : voice.symbols) {
            if (symbol.kind == SymbolKind::note && !symbol.tied_back) notes.push_back(&symbol);
        }
    }
    std::stable_sort(notes.begin(), notes.end(),
                     [](const NotatedSymbol* a, const NotatedSymbol* b) { return a->onset < b->onset; });
    std::int64_t current_bar = -1;
    std::map<std::pair<int, int>, int> in_force;
    for (NotatedSymbol* note : notes) {
        if (note->onset / bar != current_bar) {
            current_bar = note->onset / bar;
            in_force.clear();
        }
        const Pitch& pitch = note->pitch;
        const auto [entry, is_new] =
            in_force.try_emplace({pitch.octave, pitch.letter}, 2 * key[static_cast<std::size_t>(pitch.letter)]);
        note->has_sign = entry->second != pitch.quarters;
        entry->second = pitch.quarters;
    }
}

}  // namespace

double Pitch::key() const {
    return 12 * (octave + 1) + letter_semitones(letter) + 0.5 * quarters;
}

NoteValue note_value(std::int64_t length) {
    // 3, 6, 12, … are the dotted ones.
    const bool dotted = length % 3 == 0;
    return {static_cast<int>(64 / (dotted ? length / 3 * 2 : length)), dotted};
}

Pitch spelled(double key, const std::array<Spelling, 12>& spelling) {
    const auto written = [&](int semitone, int quarters) {
        const Spelling found = spelling[static_cast<std::size_t>((semitone % 12 + 12) % 12)];
        const int natural = semitone - found.alteration - letter_semitones(found.letter);
        return Pitch{found.letter, natural / 12 - 1, 2 * found.alteration + quarters};
    };
    const int nearest = static_cast<int>(std::lround(key));
    if (std::fabs(key - nearest) <= 0.25) return written(nearest, 0);
    // From the semitone below or from the one above: the smaller sign, and of equal ones that from above.
    const int below = static_cast<int>(std::floor(key));
    const Pitch raised = written(below, 1);
    const Pitch lowered = written(below + 1, -1);
    return std::abs(raised.quarters) < std::abs(lowered.quarters) ? raised : lowered;
}

std::vector<std::int64_t> printable_lengths(std::int64_t from, std::int64_t to, const Meter& meter) {
    const Beats beats(meter);
    std::vector<std::int64_t> lengths;
    while (from < to) {
        // A 64th always fits.
        const auto length = std::find_if(
            printable_list.begin(), printable_list.end() - 1,
            [&](std::int64_t candidate) { return from + candidate <= to && beats.fits(from, from + candidate); });
        lengths.push_back(*length);
        from += *length;
    }
    return lengths;
}

std::array<int, 7> signs_of(const std::optional<KeySignature>& key) {
    static constexpr std::array<std::size_t, 7> sharps = {3, 0, 4, 1, 5, 2, 6};
    std::array<int, 7> signs{};
    if (!key) return signs;
    for (std::size_t i = 0; i < 7; ++i) {
        if (static_cast<int>(i) < key->fifths) signs[sharps[i]] = 1;
        if (static_cast<int>(i) < -key->fifths) signs[sharps[6 - i]] = -1;
    }
    return signs;
}

Notator::Notator(const ScoreHead& head) : parts_(head.parts), meter_(head.meter) {
    std::size_t voices = 0;
    for (const Part& part : parts_) voices += static_cast<std::size_t>(part.voices);
    voices_.resize(voices);
    notation_.bar_length = Beats(meter_).bar;
}

void Notator::notes(std::span<const Note> notes) {
    count_ += notes.size();
    if (count_ > most_notes) {
        throw ScoreError(fmt::format("more than {} notes are too many to print; limit the bars", most_notes));
    }
    for (const Note& note : notes) {
        if (note.voice < 0 || static_cast<std::size_t>(note.voice) >= voices_.size()) {
            throw ScoreError(fmt::format("voice {} belongs to no part of the score", note.voice + 1));
        }
        auto& voice = voices_[static_cast<std::size_t>(note.voice)];
        Placed placed{nearest_64th(note.onset), nearest_64th(note.onset + note.duration), note.key};
        if (!voice.empty()) placed.onset = std::max(placed.onset, voice.back().end);
        placed.end = std::max(placed.end, placed.onset + 1);
        if (placed.onset * ticks_per_sixty_fourth != note.onset ||
            placed.end * ticks_per_sixty_fourth != note.onset + note.duration) {
            ++notation_.moved;
        }
        if (std::fabs(2 * note.key - std::round(2 * note.key)) > 2 * unheard) ++notation_.bent;
        voice.push_back(placed);
    }
}

void Notator::finish(std::int64_t end) {
    std::int64_t last = nearest_64th(end);
    for (const auto& voice : voices_) {
        if (!voice.empty()) last = std::max(last, voice.back().end);
    }
    const std::int64_t bar = notation_.bar_length;
    notation_.bars = std::max<std::int64_t>(1, (last + bar - 1) / bar);
    if (notation_.bars > most_bars) {
        throw ScoreError(fmt::format("{} bars are too many to print; at most {} are possible: limit the bars",
                                     notation_.bars, most_bars));
    }
    std::size_t first_voice = 0;
    for (std::size_t part = 0; part < parts_.size(); ++part) {
        notate_part(part, first_voice);
        first_voice += static_cast<std::size_t>(parts_[part].voices);
    }
}

void Notator::notate_part(std::size_t part, std::size_t first_voice) {
    const Part& told = parts_[part];
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto voices = static_cast<std::size_t>(told.voices);
    double lowest = infinity;
    double highest = -infinity;
    std::size_t sounding = 0;
    for (std::size_t i = 0; i < voices; ++i) {
        const auto& notes = voices_[first_voice + i];
        if (!notes.empty()) ++sounding;
        for (const Placed& note : notes) {
            lowest = std::min(lowest, note.key);
            highest = std::max(highest, note.key);
        }
    }

    auto& staves = notation_.parts.emplace_back().staves;
    if (sounding > voices_per_staff) {
        for (std::size_t i = 0; i < voices;) {
            std::size_t count = 0;
            std::size_t taken = 0;
            while (i + taken < voices && count < voices_per_staff) {
                if (!voices_[first_voice + i + taken++].empty()) ++count;
            }
            if (count > 0) staves.push_back(make_staff(told, first_voice + i, taken, -infinity, infinity));
            i += taken;
        }
    } else if (highest - lowest > two_octaves && lowest < middle_c && highest >= middle_c) {
        staves.push_back(make_staff(told, first_voice, voices, middle_c, infinity));
        staves.push_back(make_staff(told, first_voice, voices, -infinity, middle_c));
        staves[0].clef = Clef::treble;
        staves[1].clef = Clef::bass;
    } else {
        staves.push_back(make_staff(told, first_voice, voices, -infinity, infinity));
    }
    for (Staff& staff : staves) set_signs(staff, signs_of(told.key), notation_.bar_length);
}

/// A staff of those notes of the voices whose keys lie from `low` up to, without, `high`.
Staff Notator::make_staff(const Part& part, std::size_t first_voice, std::size_t voices, double low,
                          double high) const {
    Staff staff;
    std::vector<double> keys;
    std::vector<Placed> notes;
    for (std::size_t i = first_voice; i < first_voice + voices; ++i) {
        notes.clear();
        for (const Placed& note : voices_[i]) {
            if (note.key < low || note.key >= high) continue;
            notes.push_back(note);
            keys.push_back(note.key);
        }
        if (!notes.empty()) staff.voices.push_back({static_cast<int>(i), fill(notes, part)});
    }
    if (staff.voices.empty()) staff.voices.push_back({static_cast<int>(first_voice), fill({}, part)});
    if (!keys.empty() && median(std::move(keys)) < middle_c) staff.clef = Clef::bass;

    // A bar's rest is printed once, and not where another voice sounds; rests of more than two voices have no room.
    const auto bars = static_cast<std::size_t>(notation_.bars);
    std::vector<bool> has_notes(bars, false);
    for (const NotatedVoice& voice : staff.voices) {
        for (const NotatedSymbol& symbol : voice.symbols) {
            if (symbol.kind != SymbolKind::bar_rest) {
                has_notes[static_cast<std::size_t>(symbol.onset / notation_.bar_length)] = true;
            }
        }
    }
    for (std::size_t i = 0; i < staff.voices.size(); ++i) {
        for (NotatedSymbol& symbol : staff.voices[i].symbols) {
            if (symbol.kind == SymbolKind::bar_rest &&
                (i > 0 || has_notes[static_cast<std::size_t>(symbol.onset / notation_.bar_length)])) {
                symbol.kind = SymbolKind::gap;
            }
            if (symbol.kind == SymbolKind::rest && i > 1) symbol.kind = SymbolKind::gap;
        }
    }
    return staff;
}

std::vector<NotatedSymbol> Notator::fill(std::span<const Placed> notes, const Part& part) const {
    std::vector<NotatedSymbol> symbols;
    std::int64_t here = 0;
    for (const Placed& note : notes) {
        add_rests(symbols, here, note.onset);
        add_note(symbols, note.onset, note.end, spelled(note.key, part.spelling));
        here = note.end;
    }
    add_rests(symbols, here, notation_.bars * notation_.bar_length);
    return symbols;
}

void Notator::add_rests(std::vector<NotatedSymbol>& symbols, std::int64_t from, std::int64_t to) const {
    const std::int64_t bar = notation_.bar_length;
    while (from < to) {
        const std::int64_t bar_begin = from / bar * bar;
        const std::int64_t piece_end = std::min(to, bar_begin + bar);
        NotatedSymbol symbol;
        if (piece_end - from == bar) {
            symbol.kind = SymbolKind::bar_rest;
            symbol.onset = from;
            symbol.length = bar;
            symbols.push_back(symbol);
        } else {
            for (const std::int64_t length : printable_lengths(from - bar_begin, piece_end - bar_begin, meter_)) {
                symbol.onset = from;
                symbol.length = length;
                symbols.push_back(symbol);
                from += length;
            }
        }
        from = piece_end;
    }
}

void Notator::add_note(std::vector<NotatedSymbol>& symbols, std::int64_t from, std::int64_t to, Pitch pitch) const {
    const std::int64_t bar = notation_.bar_length;
    const std::int64_t begin = from;
    while (from < to) {
        const std::int64_t bar_begin = from / bar * bar;
        const std::int64_t piece_end = std::min(to, bar_begin + bar);
        for (const std::int64_t length : printable_lengths(from - bar_begin, piece_end - bar_begin, meter_)) {
            NotatedSymbol symbol;
            symbol.kind = SymbolKind::note;
            symbol.onset = from;
            symbol.length = length;
            symbol.tied_back = from > begin;
            symbol.tied_forward = from + length < to;
            symbol.pitch = pitch;
            symbols.push_back(symbol);
            from += length;
        }
    }
}

}  // namespace sikku
