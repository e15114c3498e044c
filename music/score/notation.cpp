#include "music/score/notation.h"

#include "music/score/chord_signs.h"
#include "music/score/drums.h"
#include "music/score/dynamics.h"
#include "music/score/labels.h"
#include "music/score/notation_excerpt.h"
#include "music/score/notation_repeats.h"
#include "music/score/note_order.h"
#include "music/score/signs.h"
#include "music/score/spelling.h"
#include "music/score/staves.h"
#include "music/score/strokes.h"
#include "music/score/syllables.h"
#include "music/score/transposing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <set>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_notes = 200'000;
constexpr std::int64_t most_bars = 100'000;
constexpr double unheard = 0.01;  // semitones

/// Hides the rests of an upbeat in voices that are silent in it; if all voices are, the rests of the first one stay.
void hide_rests_of_upbeat(Staff& staff, std::int64_t upbeat) {
    const auto sounds = [&](const NotatedVoice& voice) {
        return std::any_of(voice.symbols.begin(), voice.symbols.end(), [&](const NotatedSymbol& symbol) {
            return symbol.kind == SymbolKind::note && symbol.onset < upbeat;
        });
    };
    bool is_shown = std::any_of(staff.voices.begin(), staff.voices.end(), sounds);
    for (NotatedVoice& voice : staff.voices) {
        if (sounds(voice)) continue;
        for (NotatedSymbol& symbol : voice.symbols) {
            if (is_shown && symbol.onset < upbeat) symbol.kind = SymbolKind::gap;
        }
        is_shown = true;
    }
}

/// Hides rests: a bar's rest is printed once, and only if all voices rest; rests of more than two voices do not fit.
void hide_rests(Staff& staff, std::int64_t bars, const BarLines& bar_lines) {
    std::vector<bool> has_notes(static_cast<std::size_t>(bars), false);
    const auto bar_of = [&](const NotatedSymbol& symbol) {
        return static_cast<std::size_t>(bar_lines.number(symbol.onset));
    };
    for (const NotatedVoice& voice : staff.voices) {
        for (const NotatedSymbol& symbol : voice.symbols) {
            if (symbol.kind != SymbolKind::bar_rest) has_notes[bar_of(symbol)] = true;
        }
    }
    for (std::size_t i = 0; i < staff.voices.size(); ++i) {
        for (NotatedSymbol& symbol : staff.voices[i].symbols) {
            if (symbol.kind == SymbolKind::bar_rest && (i > 0 || has_notes[bar_of(symbol)])) {
                symbol.kind = SymbolKind::gap;
            }
            if (symbol.kind == SymbolKind::rest && i > 1) symbol.kind = SymbolKind::gap;
        }
    }
    if (bar_lines.upbeat() > 0) hide_rests_of_upbeat(staff, bar_lines.upbeat());
}

/// Gives hands that state dynamics their own, if these are fewer marks.
void divide_dynamics(const PartPlan& plan, const BarLines& bars, std::int64_t fresh_from,
                     std::span<const PrintedRepeat> repeats, NotatedPart& notated) {
    std::vector<std::vector<DynamicMark>> of_hands;
    std::size_t count = 0;
    bool is_stated = false;
    for (const StaffPlan& planned : plan.staves) {
        std::vector<Note> notes;
        for (const StaffVoice& voice : planned.voices) {
            notes.insert(notes.end(), voice.notes.begin(), voice.notes.end());
        }
        sort_by_onset(notes);
        is_stated = is_stated || std::any_of(notes.begin(), notes.end(),
                                             [](const Note& note) { return note.emphasis.dynamic >= 0; });
        of_hands.push_back(dynamics_of(notes, bars, fresh_from, repeats));
        count += of_hands.back().size();
    }
    if (!is_stated || count >= notated.staves.front().dynamics.size()) return;
    for (std::size_t i = 0; i < of_hands.size(); ++i) notated.staves[i].dynamics = std::move(of_hands[i]);
}

/// Moves notes to the grid. @return number of notes moved
std::uint64_t snap(std::vector<Note>& notes, const Grid& grid) {
    std::uint64_t moved = 0;
    std::int64_t free = 0;
    for (Note& note : notes) {
        const std::int64_t onset = std::max(grid.nearest(note.onset), free);
        const std::int64_t end = std::max(grid.nearest(note.onset + note.duration), grid.after(onset));
        if (onset != note.onset || end != note.onset + note.duration) ++moved;
        note.onset = onset;
        note.duration = end - onset;
        free = end;
    }
    return moved;
}

/// Writes the notes and rests of one voice, one after the other.
class VoiceWriter {
public:
    VoiceWriter(const Grid& grid, const BarLines& bars, NotatedVoice& voice)
        : grid_(grid), bars_(bars), voice_(voice) {}

    /// Writes a stroke: the longest value that ends by `end`, and rests.
    void add_stroke(std::int64_t end, const NotatedSymbol& stroke) {
        const std::int64_t begin = here_;
        const std::size_t first = voice_.symbols.size();
        add(end, &stroke);
        if (voice_.symbols.size() < first + 2) return;
        voice_.symbols.resize(first + 1);
        voice_.symbols.back().tied_forward = false;
        here_ = begin + voice_.symbols.back().length;
        add(end, nullptr);
    }

    /// Writes a note up to `end`, or a rest if `note` is null.
    void add(std::int64_t end, const NotatedSymbol* note) {
        const std::int64_t begin = here_;
        while (here_ < end) {
            const std::int64_t bar_begin = bars_.begin(here_);
            const std::int64_t bar = bars_.length(here_);
            std::int64_t piece_end = std::min(end, bars_.end(here_));
            if (!note && piece_end - here_ == bar) {
                put({{bar, {}}}, -1);
                voice_.symbols.back().kind = SymbolKind::bar_rest;
                continue;
            }
            const std::size_t at = grid_.tuplet_from(here_);
            const std::vector<TupletSpan>& tuplets = grid_.tuplets();
            const bool is_inside = at < tuplets.size() && tuplets[at].from <= here_;
            if (at < tuplets.size()) piece_end = std::min(piece_end, is_inside ? tuplets[at].to : tuplets[at].from);
            const std::size_t first = voice_.symbols.size();
            if (is_inside) {
                put(note ? written_values(here_, piece_end, tuplets[at])
                         : written_rests(here_, piece_end, tuplets[at]),
                    static_cast<int>(at));
            } else {
                const std::int64_t from = here_ - bar_begin;
                const std::int64_t to = piece_end - bar_begin;
                const Meter& meter = bars_.meter(here_);
                put(note ? written_values(from, to, meter) : written_rests(from, to, meter), -1);
            }
            for (std::size_t i = first; note && i < voice_.symbols.size(); ++i) {
                NotatedSymbol& symbol = voice_.symbols[i];
                symbol.kind = SymbolKind::note;
                symbol.pitch = note->pitch;
                symbol.drum = note->drum;
                symbol.chord = note->chord;
                symbol.cents = note->cents;
                symbol.tied_back = symbol.onset > begin;
                symbol.tied_forward = symbol.onset + symbol.length < end;
                symbol.is_accented = note->is_accented && !symbol.tied_back;
                symbol.is_ghost = note->is_ghost && !symbol.tied_back;
                symbol.begins_slide = note->begins_slide && !symbol.tied_forward;
                symbol.ends_slide = note->ends_slide && !symbol.tied_back;
                symbol.leaves = symbol.tied_forward ? 0 : note->leaves;
                symbol.has_fermata = note->has_fermata && !symbol.tied_forward;
                symbol.begins_slur = note->begins_slur && !symbol.tied_back;
                symbol.ends_slur = note->ends_slur && !symbol.tied_forward;
                symbol.is_staccato = note->is_staccato && !symbol.tied_back && !symbol.tied_forward;
                if (!symbol.tied_back) symbol.syllable = note->syllable;
                if (!symbol.tied_back) symbol.grace = note->grace;
            }
        }
    }

private:
    void put(const std::vector<WrittenValue>& values, int tuplet) {
        for (const WrittenValue& value : values) {
            NotatedSymbol& symbol = voice_.symbols.emplace_back();
            symbol.onset = here_;
            symbol.length = value.length;
            symbol.value = value.value;
            symbol.tuplet = tuplet;
            here_ += value.length;
        }
    }

    const Grid& grid_;
    const BarLines& bars_;
    NotatedVoice& voice_;
    std::int64_t here_ = 0;
};

/// Sets a single drum on a staff of one line, which is the lowest of the five.
void set_on_one_line(Staff& staff) {
    staff.lines = 1;
    for (NotatedVoice& voice : staff.voices) {
        for (NotatedSymbol& symbol : voice.symbols) symbol.pitch = {2, 4, 0};
    }
}

void beam(NotatedVoice& voice, const BarLines& bars) {
    std::vector<BeamedNote> notes;
    for (const NotatedSymbol& symbol : voice.symbols) {
        notes.push_back(
            {symbol.onset, symbol.length, symbol.value, symbol.kind == SymbolKind::note, symbol.tuplet, {}});
    }
    set_beams(notes, voice.tuplets, bars);
    for (std::size_t i = 0; i < notes.size(); ++i) voice.symbols[i].beams = notes[i].beams;
}

/// The printed cents by which a key sounds higher than written.
int cents_above(double key, const Pitch& pitch) {
    const double away = key - pitch.key();
    return std::fabs(away) > unheard ? static_cast<int>(std::lround(100 * away)) : 0;
}

/// The spelling of a key that a chord contains, by the letters from its root on, if the spelling of the scale has a
/// sign there; else that of the scale. @param up  semitones by which the part is written higher
Pitch spelled_in(const ChordSign& chord, double key, int up, const std::array<Spelling, 12>& spelling) {
    const Pitch plain = spelled(key, spelling);
    if (chord.quality < 0 || plain.quarters == 0 || std::fabs(key - std::round(key)) > unheard) return plain;
    // Letters of the tones, by their semitones above the root: a third is two letters above it.
    static constexpr std::array<int, 12> letters = {0, 1, 1, 2, 2, 3, 4, 4, 4, 5, 6, 6};
    const Pitch root = spelled(60 + chord.root + up, spelling);
    const int above = ((static_cast<int>(std::lround(key)) - static_cast<int>(root.key())) % 12 + 12) % 12;
    const auto& tones = chord_qualities()[static_cast<std::size_t>(chord.quality)].tones;
    if (std::find(tones.begin(), tones.end(), above) == tones.end()) return plain;
    Pitch pitch{(root.letter + letters[static_cast<std::size_t>(above)]) % 7, plain.octave, 0};
    pitch.octave += static_cast<int>(std::lround((key - pitch.key()) / 12));
    pitch.quarters = static_cast<int>(std::lround(2 * (key - pitch.key())));
    return std::abs(pitch.quarters) <= 2 ? pitch : plain;
}

/// Indices of notes.
struct Slur {
    std::size_t first = 0;
    std::size_t last = 0;
};

/// Slurs over the notes of a phrase from one rest, or bar line of `jumps`, to the next: at least two, not all of one
/// pitch, in at most four bars. With swing, players shape their phrases themselves.
std::vector<Slur> slurs_of(const Part& part, const std::vector<Note>& notes, const BarLines& bars,
                           const std::vector<std::int64_t>& jumps) {
    constexpr std::int64_t most_bars_of_slur = 4;
    std::vector<Slur> slurs;
    if (!part.touch.has_phrases || part.swing.is_on() || part.touch.sounding < 1 || part.touch.is_by_depth ||
        !has_slurs(part.program)) {
        return slurs;
    }
    for (std::size_t first = 0; first < notes.size();) {
        std::size_t last = first;
        bool differs = false;
        while (last + 1 < notes.size() && notes[last].onset + notes[last].duration == notes[last + 1].onset &&
               !std::binary_search(jumps.begin(), jumps.end(), notes[last + 1].onset)) {
            ++last;
            differs = differs || notes[last].key != notes[first].key;
        }
        const std::int64_t length = notes[last].onset - notes[first].onset;
        if (differs && length < most_bars_of_slur * bars.length(notes[first].onset)) slurs.push_back({first, last});
        first = last + 1;
    }
    return slurs;
}

/// True for a note of at most a quarter of which at most 65 % sound.
bool is_staccato(const Touch& touch, const Note& note) {
    constexpr double most_sounding = 0.65;
    return touch.share(note.depth) <= most_sounding && note.duration <= ticks_per_quarter &&
           note.glide.semitones == 0;
}

void add_drums(const NotatedVoice& voice, std::set<int>& drums) {
    for (const NotatedSymbol& symbol : voice.symbols) {
        if (symbol.drum == 0) continue;
        drums.insert(symbol.drum);
        for (const ChordNote& note : symbol.chord) drums.insert(note.drum);
    }
}

}  // namespace

double Pitch::key() const {
    return 12 * (octave + 1) + letter_semitones(letter) + 0.5 * quarters;
}

Pitch spelled(double key, const std::array<Spelling, 12>& spelling) {
    const auto written = [&](int semitone, int quarters) {
        const Spelling found = spelling[static_cast<std::size_t>((semitone % 12 + 12) % 12)];
        const int natural = semitone - found.alteration - letter_semitones(found.letter);
        return Pitch{found.letter, natural / 12 - 1, 2 * found.alteration + quarters};
    };
    const int nearest = static_cast<int>(std::lround(key));
    if (std::fabs(key - nearest) <= 0.25) return written(nearest, 0);
    // Raises the semitone below or lowers the one above, by the smaller sign; of equal ones, lowers.
    const int below = static_cast<int>(std::floor(key));
    const Pitch raised = written(below, 1);
    const Pitch lowered = written(below + 1, -1);
    return std::abs(raised.quarters) < std::abs(lowered.quarters) ? raised : lowered;
}

int staff_size(const Notation& notation) {
    std::size_t staves = 0;
    for (const NotatedPart& part : notation.parts) staves += part.staves.size();
    return staves >= 10 ? 13 : staves >= 7 ? 15 : staves >= 4 ? 16 : staves >= 2 ? 18 : 20;
}

std::vector<int> drums_of(const Staff& staff) {
    std::set<int> drums;
    for (const NotatedVoice& voice : staff.voices) add_drums(voice, drums);
    return {drums.begin(), drums.end()};
}

std::vector<int> drums_of(const Notation& notation) {
    std::set<int> drums;
    each_voice(notation, [&](const NotatedVoice& voice) { add_drums(voice, drums); });
    return {drums.begin(), drums.end()};
}

std::vector<int> printed_cents(const NotatedSymbol& symbol) {
    std::vector<std::pair<double, int>> all = {{-symbol.pitch.key(), symbol.cents}};
    for (const ChordNote& note : symbol.chord) all.emplace_back(-note.pitch.key(), note.cents);
    std::sort(all.begin(), all.end());
    std::vector<int> cents;
    for (const auto& [key, one] : all) {
        if (one != 0) cents.push_back(one);
    }
    return cents;
}

std::string cents_text(int cents) {
    return fmt::format("{}{}", cents < 0 ? "\u2212" : "+", std::abs(cents));
}

const ClefForm& form_of(Clef clef) {
    static constexpr std::array<ClefForm, 8> forms = {
        {{'G', 2, 0}, {'F', 4, 0}, {'C', 3, 0}, {'C', 4, 0}, {'G', 2, -1}, {'F', 4, -1}, {'G', 2, 1}, {'G', 2, 0}}};
    return forms[static_cast<std::size_t>(clef)];
}

int middle_line(Clef clef) {
    const ClefForm& form = form_of(clef);
    const Pitch named = form.sign == 'G' ? Pitch{4, 4} : form.sign == 'F' ? Pitch{3, 3} : Pitch{0, 4};
    return named.height() + 2 * (3 - form.line) + 7 * form.octaves;
}

std::string_view mode_name(Mode mode) {
    static constexpr std::array<std::string_view, 7> names = {"lydian", "major",    "mixolydian", "dorian",
                                                              "minor",  "phrygian", "locrian"};
    return names[static_cast<std::size_t>(mode)];
}

std::optional<KeySignature> printed_key(const Part& part) {
    return part.signature ? part.signature : part.key;
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

Notator::Notator(const ScoreHead& head, const Bars& bars)
    : parts_(head.parts),
      bar_lines_(head),
      changes_(head.changes),
      is_transposed_(head.is_transposed),
      syllables_(head.syllables),
      has_chord_signs_(head.has_chord_signs),
      has_graces_(head.has_graces),
      most_repeats_(head.most_repeats),
      ritardando_(head.ritardando),
      printed_bars_(bars) {
    std::size_t voices = 0;
    for (const Part& part : parts_) voices += static_cast<std::size_t>(part.voices);
    voices_.resize(voices);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        part_indices_.insert(part_indices_.end(), static_cast<std::size_t>(parts_[i].voices), i);
    }
}

void Notator::notes(std::span<const Note> notes) {
    count_ += notes.size();
    if (count_ > most_notes) {
        throw TooLongToPrint(fmt::format("more than {} notes are too many to print; limit the bars", most_notes));
    }
    for (const Note& note : notes) {
        if (note.voice < 0 || static_cast<std::size_t>(note.voice) >= voices_.size()) {
            throw ScoreError(fmt::format("voice {} belongs to no part of the score", note.voice + 1));
        }
        if (std::fabs(2 * note.key - std::round(2 * note.key)) > 2 * unheard) ++notation_.bent;
        voices_[static_cast<std::size_t>(note.voice)].push_back(note);
        if (note.chord.quality == ChordSign::no_chord) continue;
        auto& [until, sign] = chord_signs_[{part_indices_[static_cast<std::size_t>(note.voice)], note.onset}];
        until = std::max(until, note.onset + note.duration);
        sign = note.chord;
    }
}

void Notator::finish(std::int64_t end) {
    std::size_t first_voice = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const bool has_chords = parts_[i].has_chords && !parts_[i].is_drums;
        if (has_chords || parts_[i].is_accompaniment) gather_chords(i, first_voice);
        first_voice += static_cast<std::size_t>(parts_[i].voices);
    }
    std::int64_t last = (end + shortest_value / 2) / shortest_value * shortest_value;
    for (auto& voice : voices_) {
        notation_.moved += snap(voice, grid_of(voice, bar_lines_));
        if (!voice.empty()) last = std::max(last, voice.back().onset + voice.back().duration);
    }
    all_bars_ = std::max<std::int64_t>(1, bar_lines_.count(last));
    if (all_bars_ > most_bars) {
        throw TooLongToPrint(fmt::format("{} bars are too many to print; at most {} are possible: limit the bars",
                                         all_bars_, most_bars));
    }
    printed_bars_.first = std::min(printed_bars_.first, all_bars_ - 1);
    printed_bars_.count = std::min(printed_bars_.count, all_bars_ - printed_bars_.first);
    agree_on_swing();
    printed_ = share_parts(parts_, voices_, bar_lines_);
    share_chords();
    std::vector<std::vector<double>> others(printed_.size());
    for (const auto& [place, keys] : chords_) {
        std::vector<double>& list = others[std::get<0>(place)];
        list.insert(list.end(), keys.begin(), keys.end());
    }
    agree_on_keys(printed_, others);
    find_outside();
    for (std::size_t i = 0; i < printed_.size() && is_transposed_; ++i) transpose_part(i);
    if (most_repeats_ > 1) end = fold_repeats(end);
    notation_.bars = printed_bars_.count;
    notation_.bar_lines = bar_lines_.from(first_tick());
    notation_.is_cut = printed_bars_.first + printed_bars_.count < all_bars_;
    for (const auto& [place, chord] : chord_signs_) chords_by_onset_.emplace(place.second, chord);
    for (std::size_t i = 0; i < printed_.size(); ++i) notate_part(i);
    name_chords();
    mark_ending(end);
    set_labels(notation_.parts);
    std::vector<std::int64_t>& bars = notation_.double_bars;
    for (const NotatedPart& part : notation_.parts) {
        for (const KeyChange& key : part.keys) {
            if (key.onset > 0) bars.push_back(key.onset);
        }
    }
    notation_.changes = changes_after(changes_, first_tick());
    std::erase_if(notation_.changes, [&](const SectionChange& change) { return change.onset >= notation_.end(); });
    for (const SectionChange& change : notation_.changes) bars.push_back(change.onset);
    std::sort(bars.begin(), bars.end());
    bars.erase(std::unique(bars.begin(), bars.end()), bars.end());
    std::erase_if(bars, [&](std::int64_t onset) { return signs_at(notation_.repeats, onset).has_sign(); });
}

/// Moves notes into chords: those that begin with the same symbol as a note of an earlier voice, and in an
/// accompaniment voices with one rhythm.
void Notator::gather_chords(std::size_t part, std::size_t first_voice) {
    if (parts_[part].is_accompaniment) return gather_accompaniment(part, first_voice);
    std::map<ChordPlace, const Note*> first;
    for (std::size_t i = first_voice; i < first_voice + static_cast<std::size_t>(parts_[part].voices); ++i) {
        std::vector<Note> kept;
        for (const Note& note : voices_[i]) {
            const ChordPlace place(part, note.symbol, note.onset);
            const auto known = first.find(place);
            if (note.symbol == 0 || known == first.end() || known->second->duration != note.duration) {
                kept.push_back(note);
            } else {
                chords_[place].push_back(note.key);
            }
        }
        voices_[i] = std::move(kept);
        for (const Note& note : voices_[i]) first.try_emplace({part, note.symbol, note.onset}, &note);
    }
}

void Notator::gather_accompaniment(std::size_t part, std::size_t first_voice) {
    const auto has_one_rhythm = [](const std::vector<Note>& a, const std::vector<Note>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Note& one, const Note& other) {
            return one.onset == other.onset && one.duration == other.duration;
        });
    };
    const std::size_t end = first_voice + static_cast<std::size_t>(parts_[part].voices);
    for (std::size_t i = first_voice; i < end; ++i) {
        // Chords of several rhythms may begin together.
        for (Note& note : voices_[i]) note.symbol = i + 1;
        for (std::size_t k = i + 1; k < end && !voices_[i].empty(); ++k) {
            if (!has_one_rhythm(voices_[i], voices_[k])) continue;
            for (const Note& note : voices_[k]) chords_[{part, i + 1, note.onset}].push_back(note.key);
            voices_[k].clear();
        }
    }
}

/// Combines the chords of parts that share staves, whose notes never begin at the same time.
void Notator::share_chords() {
    if (chords_.empty()) return;
    std::vector<std::size_t> index(parts_.size());
    for (std::size_t i = 0; i < printed_.size(); ++i) {
        for (const std::size_t source : printed_[i].sources) index[source] = i;
    }
    std::map<ChordPlace, std::vector<double>> shared;
    for (auto& [place, keys] : chords_) {
        shared[{index[std::get<0>(place)], std::get<1>(place), std::get<2>(place)}] = std::move(keys);
    }
    chords_ = std::move(shared);
}

/// Gives parts without off-beats the swing of the others, if these agree: it would not move their notes.
void Notator::agree_on_swing() {
    Swing common;
    for (const Part& part : parts_) {
        if (!part.swing.is_on()) continue;
        if (common.is_on() && common != part.swing) return;
        common = part.swing;
    }
    if (!common.is_on()) return;
    std::size_t first_voice = 0;
    for (Part& part : parts_) {
        const auto begin = voices_.begin() + static_cast<std::ptrdiff_t>(first_voice);
        const bool has_off_beats = std::any_of(begin, begin + part.voices, [&](const std::vector<Note>& voice) {
            return std::any_of(voice.begin(), voice.end(), [&](const Note& note) {
                return common.moves(bar_lines_.place(note.onset), bar_lines_.length(note.onset));
            });
        });
        if (!has_off_beats) part.swing = common;
        first_voice += static_cast<std::size_t>(part.voices);
    }
}

void Notator::transpose_part(std::size_t index) {
    PrintedPart& printed = printed_[index];
    const auto by = transposition_of(printed.part.program);
    if (!by || printed.part.is_drums) return;
    transpose(printed, *by);
    for (auto& [place, keys] : chords_) {
        if (std::get<0>(place) != index) continue;
        for (double& key : keys) key += by->semitones;
    }
}

/// Counts notes that their instrument cannot play.
void Notator::find_outside() {
    for (const PrintedPart& printed : printed_) {
        const auto range = range_of_instrument(printed.part.program);
        if (!range || printed.part.is_drums || printed.part.is_accompaniment) continue;
        for (const std::vector<Note>& voice : printed.voices) {
            for (const Note& note : voice) {
                if (note.key > range->lowest - 0.5 && note.key < range->highest + 0.5) continue;
                Notation::Outside& outside = notation_.outside[printed.part.program];
                ++outside.notes;
                outside.lowest = std::min(outside.lowest, note.key);
                outside.highest = std::max(outside.highest, note.key);
            }
        }
    }
}

/// The chord that a note belongs to, or that sounds with it in any part.
ChordSign Notator::chord_at(const Note& note) const {
    if (note.chord.quality != ChordSign::no_chord || chords_by_onset_.empty()) return note.chord;
    const auto after = chords_by_onset_.upper_bound(note.onset);
    if (after == chords_by_onset_.begin()) return {};
    const auto& [until, sign] = std::prev(after)->second;
    return until > note.onset ? sign : ChordSign{};
}

int Notator::transposed_by(const Part& part) const {
    const auto by = transposition_of(part.program);
    return is_transposed_ && by && !part.is_drums ? by->semitones : 0;
}

NotatedPart& Notator::begin_part(const PrintedPart& printed) {
    NotatedPart& notated = notation_.parts.emplace_back();
    notated.part = printed.part;
    if (const auto by = transposition_of(printed.part.program); by && !printed.part.is_drums) {
        if (is_transposed_) notated.transposition = by;
        notation_.is_concert = notation_.is_concert || !is_transposed_;
    }
    for (const KeyOfBars& key : printed.keys) {
        const bool is_new = notated.keys.empty() || signs_of(key.key) != signs_of(notated.keys.back().key);
        if (!is_new) continue;
        notated.keys.push_back({key.onset, key.key});
    }
    return notated;
}

/// Keeps the printed bars of a part.
void Notator::cut(NotatedPart& part) const {
    if (printed_bars_.first == 0 && printed_bars_.count == all_bars_) return;
    cut_bars(part, first_tick(), first_tick() + notation_.end());
}

void Notator::finish_staff(Staff& staff, const NotatedPart& part) const {
    hide_rests(staff, notation_.bars, notation_.bar_lines);
    if (part.part.is_drums) return;
    set_signs(staff, part.keys, part.part.is_accompaniment, notation_.bar_lines, entries_of(notation_.repeats));
}

/// Drums have one staff for up to four lines.
void Notator::notate_drums(std::size_t index) {
    const PrintedPart& printed = printed_[index];
    constexpr std::size_t lines_per_staff = 4;
    const StrokeLines strokes = stroke_lines(printed.voices, bar_lines_);
    notation_.merged += strokes.merged;
    NotatedPart& notated = begin_part(printed);
    if (strokes.lines.size() > lines_per_staff) notated.bracket = Bracket::bracket;
    int number = printed.first_voice;
    for (std::size_t begin = 0; begin < strokes.lines.size(); begin += lines_per_staff) {
        Staff& staff = notated.staves.emplace_back();
        staff.changes = {{0, Clef::percussion, 0}};
        std::vector<Note> together;
        for (std::size_t i = begin; i < std::min(strokes.lines.size(), begin + lines_per_staff); ++i) {
            const StrokeLine& line = strokes.lines[i];
            staff.voices.push_back(fill(number++, line.strokes, index, line.others));
            together.insert(together.end(), line.strokes.begin(), line.strokes.end());
        }
        if (drums_of(staff).size() == 1) set_on_one_line(staff);
        sort_by_onset(together);
        staff.dynamics = dynamics_of(together, bar_lines_, first_tick(), repeats_);
    }
    cut(notated);
    for (Staff& staff : notated.staves) finish_staff(staff, notated);
}

void Notator::notate_part(std::size_t index) {
    const PrintedPart& printed = printed_[index];
    const Part& part = printed.part;
    if (part.is_drums) return notate_drums(index);
    PartPlan plan = plan_staves(part, printed.voices, printed.first_voice, bar_lines_);
    notation_.merged += plan.merged;
    if (plan.staves.empty()) plan.staves.push_back({{{printed.first_voice, {}}}, {}});
    NotatedPart& notated = begin_part(printed);
    notated.bracket = plan.bracket;
    notated.has_pedal = plan.has_pedal;
    std::vector<Note> together;  // notes of all staves for two hands
    for (const StaffPlan& planned : plan.staves) {
        Staff& staff = notated.staves.emplace_back();
        if (plan.bracket != Bracket::brace) together.clear();
        for (const StaffVoice& voice : planned.voices) {
            staff.voices.push_back(fill(voice.voice, voice.notes, index, chords_of(voice.notes, index)));
            together.insert(together.end(), voice.notes.begin(), voice.notes.end());
        }
        // Syllables of several voices would be confused.
        for (NotatedVoice& voice : staff.voices) {
            for (NotatedSymbol& symbol : voice.symbols)
                symbol.syllable = staff.voices.size() > 1 ? "" : symbol.syllable;
        }
        staff.changes = choose_clefs(part, planned.clef, staff.voices, bar_lines_);
        if (!repeats_.empty()) restate_clefs(staff.changes, repeats_);
        sort_by_onset(together);
        Staff& marked = plan.bracket == Bracket::brace ? notated.staves.front() : staff;
        marked.dynamics = dynamics_of(together, bar_lines_, first_tick(), repeats_);
    }
    if (plan.bracket == Bracket::brace) divide_dynamics(plan, bar_lines_, first_tick(), repeats_, notated);
    if (is_without_dynamics(part.program)) {
        for (Staff& staff : notated.staves) staff.dynamics.clear();
    }
    cut(notated);
    for (Staff& staff : notated.staves) finish_staff(staff, notated);
}

/// Begins a ritardando in the first voice. If one voice has a fermata, all get one: those that do not hold their last
/// note, at the end.
void Notator::mark_ending(std::int64_t end) {
    std::vector<NotatedSymbol>& first = notation_.parts.front().staves.front().voices.front().symbols;
    const std::int64_t slow_from = end - ritardando_ - first_tick();
    const auto slow = std::find_if(first.begin(), first.end(), [&](const NotatedSymbol& symbol) {
        return symbol.onset >= std::max<std::int64_t>(0, slow_from);
    });
    if (ritardando_ > 0 && slow != first.end()) slow->slows_down = true;
    if (notation_.is_cut) return;
    const auto is_held = [](const NotatedSymbol& symbol) { return symbol.has_fermata; };
    std::vector<std::vector<NotatedSymbol>*> others;
    for (NotatedPart& part : notation_.parts) {
        for (Staff& staff : part.staves) {
            for (NotatedVoice& voice : staff.voices) {
                const bool holds = std::any_of(voice.symbols.begin(), voice.symbols.end(), is_held);
                notation_.is_held = notation_.is_held || holds;
                if (!holds && voice.symbols.back().kind != SymbolKind::gap) others.push_back(&voice.symbols);
            }
        }
    }
    for (auto* symbols : others) symbols->back().has_fermata = notation_.is_held;
}

/// The other keys of each note's chord.
std::vector<std::vector<double>> Notator::chords_of(std::span<const Note> notes, std::size_t index) const {
    std::vector<std::vector<double>> chords(notes.size());
    for (std::size_t i = 0; i < notes.size() && !chords_.empty(); ++i) {
        const auto chord = chords_.find({index, notes[i].symbol, notes[i].onset});
        if (chord != chords_.end()) chords[i] = chord->second;
    }
    return chords;
}

NotatedVoice Notator::fill(int number, std::vector<Note> notes, std::size_t index,
                           std::span<const std::vector<double>> chords) {
    const PrintedPart& part = printed_[index];
    const Grid grid = grid_of(notes, bar_lines_);
    // Notes that come from several voices may lie on several grids.
    notation_.moved += snap(notes, grid);
    const std::int64_t end = bar_lines_.onset(all_bars_);
    while (!notes.empty() && notes.back().onset >= end) notes.pop_back();
    if (!notes.empty()) notes.back().duration = std::min(notes.back().duration, end - notes.back().onset);
    NotatedVoice voice;
    voice.voice = number;
    voice.tuplets = grid.tuplets();
    VoiceWriter writer(grid, bar_lines_, voice);
    const std::vector<bool> accents = accents_of(notes, bar_lines_);
    const bool is_loud_by_touch = !is_without_dynamics(part.part.program);
    const std::vector<Slur> slurs = slurs_of(part.part, notes, bar_lines_, jumps_of(repeats_));
    auto slur = slurs.begin();
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const Note& note = notes[i];
        NotatedSymbol symbol;
        symbol.is_accented = is_loud_by_touch ? accents[i] : note.emphasis.is_accented();
        symbol.is_ghost = note.emphasis.is_ghost();
        symbol.has_fermata = note.has_fermata;
        const auto meets = [&](std::size_t one) {
            if (one + 1 >= notes.size() || !notes[one].is_sliding) return false;
            const Note& next = notes[one + 1];
            // A slide that is printed as a grace note has no line.
            const bool is_grace =
                has_graces_ && next.grace != 0 && std::fabs(100 * (notes[one].key - next.key) - next.grace) < 1;
            return notes[one].onset + notes[one].duration == next.onset && !is_grace;
        };
        symbol.begins_slide = meets(i);
        if (note.glide.semitones != 0 && !symbol.begins_slide) symbol.leaves = note.glide.semitones > 0 ? 1 : -1;
        symbol.ends_slide = i > 0 && meets(i - 1);
        if (part.part.is_drums) {
            const Drum& drum = drum_of(static_cast<int>(std::lround(note.key)));
            symbol.drum = drum.key;
            symbol.pitch = {drum.letter, drum.octave, 0};
            for (const double key : chords[i]) {
                const Drum& other = drum_of(static_cast<int>(std::lround(key)));
                symbol.chord.push_back({{other.letter, other.octave, 0}, other.key});
            }
            writer.add(note.onset, nullptr);
            writer.add_stroke(note.onset + note.duration, symbol);
            continue;
        }
        const KeyOfBars& signature = part.key_at(note.onset);
        const std::array<Spelling, 12>& spelling = signature.spelling;
        const ChordSign chord = chord_at(note);
        const int up = transposed_by(part.part);
        const auto written = [&](double key) { return spelled_in(chord, key, up, spelling); };
        symbol.pitch = written(note.key);
        if (!part.part.is_accompaniment && chords[i].empty())
            symbol.syllable = syllable_of(syllables_, symbol.pitch, signature);
        symbol.is_staccato = is_staccato(part.part.touch, note);
        while (slur != slurs.end() && slur->last < i) ++slur;
        symbol.begins_slur = slur != slurs.end() && slur->first == i;
        symbol.ends_slur = slur != slurs.end() && slur->last == i;
        symbol.cents = cents_above(note.key, symbol.pitch);
        if (has_graces_ && note.grace != 0) {
            const Pitch grace = written(note.key + 0.01 * note.grace);
            // The degree above may be nearer than a quarter tone.
            if (grace.key() != symbol.pitch.key()) symbol.grace = {grace, 0, 0, false};
        }
        for (const double key : chords[i]) {
            const Pitch pitch = written(key);
            symbol.chord.push_back({pitch, 0, cents_above(key, pitch)});
        }
        writer.add(note.onset, nullptr);
        writer.add(note.onset + note.duration, &symbol);
    }
    writer.add(end, nullptr);
    beam(voice, bar_lines_);
    return voice;
}

}  // namespace sikku
