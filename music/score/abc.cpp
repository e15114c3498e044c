#include "music/score/score_formats.h"

#include "music/score/chord_signs.h"
#include "music/score/comments.h"
#include "music/score/drums.h"
#include "music/score/dynamics.h"
#include "music/score/swing.h"
#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace sikku {
namespace {

constexpr std::int64_t eighth_note = ticks_per_quarter / 2;

/// The text of a field: without comments and escapes.
std::string field(std::string_view text) {
    std::string result;
    for (const char byte : single_line(text)) {
        if (byte == '%' || byte == '\\') result += '\\';
        result += byte;
    }
    return result;
}

/// Lengths in eighths: `2`, `/2`, `3/2`, nothing for 1.
std::string length_of(std::int64_t ticks) {
    const std::int64_t divisor = std::gcd(ticks, eighth_note);
    const std::int64_t above = ticks / divisor;
    const std::int64_t below = eighth_note / divisor;
    return (above == 1 ? "" : std::to_string(above)) + (below == 1 ? "" : "/" + std::to_string(below));
}

std::string_view sign_of(int quarters) {
    static constexpr std::array<std::string_view, 9> signs = {"__", "_3/2", "_", "_/", "=", "^/", "^", "^3/2", "^^"};
    return signs[static_cast<std::size_t>(std::clamp(quarters, -4, 4) + 4)];
}

/// Formats a letter: `C,`, `C` (middle C), `c`, `c'`. @param octaves  octaves that players add for the clef
std::string letter_of(const Pitch& pitch, int octaves = 0) {
    const int octave = pitch.octave - octaves;
    std::string text(1, (octave > 4 ? "cdefgab" : "CDEFGAB")[pitch.letter]);
    const int marks = octave > 4 ? octave - 5 : 4 - octave;
    return text.append(static_cast<std::size_t>(marks), octave > 4 ? '\'' : ',');
}

std::string_view clef_name(Clef clef) {
    static constexpr std::array<std::string_view, 8> names = {"treble",   "bass",   "alto",     "tenor",
                                                              "treble-8", "bass-8", "treble+8", "perc"};
    return names[static_cast<std::size_t>(clef)];
}

std::string key_name(const std::optional<KeySignature>& key) {
    if (!key) return "C";
    static constexpr std::array<std::string_view, 7> modes = {"lyd", "", "mix", "dor", "min", "phr", "loc"};
    const int from_f = std::clamp(key->fifths, -7, 7) + static_cast<int>(key->mode);
    const int letter = (from_f + 7) % 7;
    const int sharps = (from_f - letter) / 7;
    return fmt::format("{}{}{}", "FCGDAEB"[letter],
                       sharps < 0   ? "b"
                       : sharps > 0 ? "#"
                                    : "",
                       modes[static_cast<std::size_t>(key->mode)]);
}

std::string meter_name(const Meter& meter) {
    return fmt::format("{}/{}", meter.groups[0] == 0 ? beats_text(meter) : "(" + beats_text(meter) + ")", meter.unit);
}

class AbcWriter : private TextWriter {
public:
    AbcWriter(const Notation& notation, const ScoreHead& head, Output& out)
        : TextWriter(out), notation_(notation), head_(head) {}

    void write() {
        find_drums();
        bars_on_a_line_ = bars_on_a_line();
        put("%abc-2.1\n\n{}\nX:1\nT:{}\n", head_comments(head_, "%"), field(head_.title));
        if (!head_.composer.empty()) put("C:{}\n", field(head_.composer));
        if (!head_.source.empty()) put("S:{}\n", field(head_.source));
        const auto swing = common_swing(notation_);
        put("M:{}\nL:1/8\nQ:{}\n{}", meter_name(head_.meter),
            tempo_mark(head_.tempo, head_.meter, words_of_tempo(notation_, head_)), score());
        // Otherwise abc2midi doubles the length of fermatas, which are held already, and arpeggiates chords slightly.
        if (notation_.is_held) put("%%MIDI fermatafixed\n");
        put("%%MIDI chordattack 0\n");
        write_chord_kinds();
        put("K:{}\n", key_name(notation_.parts.front().keys.front().key));
        if (head_.first_bar > 1 && head_.first_bar < INT32_MAX) put("%%setbarnb {}\n", head_.first_bar);
        if (notation_.is_concert) put("%%text {}\n", concert_text);
        int number = 0;
        const bool has_transposition =
            std::any_of(notation_.parts.begin(), notation_.parts.end(),
                        [](const NotatedPart& part) { return part.transposition.has_value(); });
        for (const NotatedPart& notated : notation_.parts) {
            const Part& part = notated.part;
            // A transposition stated for one voice would also apply to the voices after it.
            const int lower = notated.transposition ? notated.transposition->semitones : 0;
            const std::string transposition = has_transposition ? fmt::format("\n%%MIDI transpose {}", -lower) : "";
            const VoiceMarks marks = marks_of(notated);
            for (const Staff& staff : notated.staves) {
                // Both hands share one name.
                const bool is_other_hand = notated.bracket == Bracket::brace && &staff != &notated.staves.front();
                for (std::size_t k = 0; k < staff.voices.size(); ++k) {
                    const bool is_pedal = notated.has_pedal && &staff == &notated.staves.back();
                    const bool has_name = k == 0 && (!is_other_hand || is_pedal) && !notated.name.empty();
                    const std::string_view clef = clef_name(staff.changes.front().clef);
                    // Keys without a clef would reset the octaves.
                    put("V:{} clef={}{}\n{}\n[K:{} clef={}] ", ++number, clef,
                        has_name ? fmt::format(" name=\"{}\"", is_pedal ? "Pedal" : quoted(notated.name)) : "",
                        (part.is_drums ? drum_map() : fmt::format("%%MIDI program {}", part.program)) + transposition,
                        key_name(notated.keys.front().key), clef);
                    if (has_name && part.swing.is_on() && !swing) put("\"^{}\"", swing_words(part.swing));
                    const bool is_top = k == 0 && &staff == &notated.staves.front();
                    write_voice(staff, k, notated.keys, marks.at(&staff.voices[k]),
                                is_top ? std::span(notated.chords) : std::span<const ChordMark>{});
                }
            }
        }
        flush();
    }

private:
    /// `"Andante" 1/4=72`.
    static std::string tempo_mark(double tempo, const Meter& meter, const std::string& words) {
        const BeatUnit beat = beat_unit(meter);
        return fmt::format("{}{}/{}={}", words.empty() ? "" : fmt::format("\"{}\" ", field(words)),
                           beat.value.dotted ? 3 : 1, beat.value.divisor * (beat.value.dotted ? 2 : 1),
                           std::max<long long>(1, std::llround(tempo / beat.quarters)));
    }

    /// Writes what changes where a section begins; the tempo in the first voice.
    void write_section_change(const SectionChange& change, bool is_first) {
        const TempoAndMeter& after = change.to;
        const TempoAndMeter before =
            tempo_and_meter_at(tempo_and_meter_of(head_), notation_.changes, change.onset - 1);
        if (after.meter != before.meter) put("[M:{}] ", meter_name(after.meter));
        if (!is_first || !needs_tempo_mark(before, after)) return;
        // A bracket would end the field.
        std::string words = after.tempo_words;
        std::replace(words.begin(), words.end(), '[', '(');
        std::replace(words.begin(), words.end(), ']', ')');
        put("[Q:{}] ", tempo_mark(after.tempo, after.meter, words));
    }

    static std::string quoted(std::string_view text) {
        std::string result = field(text);
        std::replace(result.begin(), result.end(), '"', '\'');
        return result;
    }

    /// States which voices share a staff, and which staves are joined.
    std::string score() const {
        std::string text;
        int number = 0;
        for (const NotatedPart& part : notation_.parts) {
            std::string staves, pedal;
            for (const Staff& staff : part.staves) {
                std::string voices;
                for (std::size_t i = 0; i < staff.voices.size(); ++i) {
                    voices += fmt::format("{}{}", i > 0 ? " " : "", ++number);
                }
                std::string& group = part.has_pedal && &staff == &part.staves.back() ? pedal : staves;
                group += (staves.empty() ? "" : " ") + (staff.voices.size() > 1 ? "(" + voices + ")" : voices);
            }
            text += part.bracket == Bracket::brace     ? fmt::format(" {{{}}}{}", staves, pedal)
                    : part.bracket == Bracket::bracket ? " [" + staves + "]"
                                                       : " " + staves;
        }
        return number > 1 ? "%%score" + text + "\n" : "";
    }

    /// Finds the notes of the drums on the staff; a sign distinguishes drums with the same place.
    void find_drums() {
        std::map<int, int> at_height;
        for (const int key : drums_of(notation_)) drum_notes_.try_emplace(key);
        static constexpr std::array<std::string_view, 5> signs = {"=", "^", "_", "^^", "__"};
        for (auto& [key, note] : drum_notes_) {
            const Drum& drum = drum_of(key);
            const Pitch place{drum.letter, drum.octave, 0};
            const int others = at_height[place.height()]++;
            note = std::string(signs[static_cast<std::size_t>(others) % signs.size()]) + letter_of(place);
        }
    }

    /// Number of bars on a line, which programs print unchanged: fewer if a bar has many notes.
    std::int64_t bars_on_a_line() const {
        std::ptrdiff_t most = 0;
        each_voice(notation_, [&](const NotatedVoice& voice) {
            std::map<std::int64_t, std::ptrdiff_t> count;
            for (const NotatedSymbol& symbol : voice.symbols) {
                most = std::max(most, ++count[notation_.bar_lines.number(symbol.onset)]);
            }
        });
        return most <= 12 ? 4 : most <= 24 ? 2 : 1;
    }

    std::string drum_map() const {
        std::string text = "%%MIDI channel 10";
        for (const auto& [key, note] : drum_notes_) text += fmt::format("\n%%MIDI drummap {} {}", note, key);
        return text;
    }

    using VoiceMarks = std::map<const NotatedVoice*, std::vector<DynamicMark>>;

    static bool begins_note(const NotatedVoice& voice, std::int64_t onset) {
        const auto symbol =
            std::lower_bound(voice.symbols.begin(), voice.symbols.end(), onset,
                             [](const NotatedSymbol& one, std::int64_t tick) { return one.onset < tick; });
        return symbol != voice.symbols.end() && symbol->onset == onset && symbol->kind == SymbolKind::note;
    }

    /// The dynamics of a part by voice: a level stands in the first voice of its staff, or of the other hand, in
    /// which a note begins; hairpins and their ends in the first voice of the staff.
    static VoiceMarks marks_of(const NotatedPart& part) {
        VoiceMarks marks;
        for (const Staff& staff : part.staves) {
            for (const NotatedVoice& voice : staff.voices) marks[&voice];
        }
        for (const Staff& staff : part.staves) {
            const std::span<const Staff> staves =
                part.bracket == Bracket::brace && part.staves.back().dynamics.empty() ? std::span(part.staves)
                                                                                      : std::span(&staff, 1);
            bool is_hairpin = false;
            for (const DynamicMark& mark : staff.dynamics) {
                const NotatedVoice* in = &staff.voices.front();
                const bool is_free = mark.kind == DynamicMark::Kind::level && !is_hairpin;
                for (const Staff& one : staves) {
                    for (const NotatedVoice& voice : one.voices) {
                        const bool is_late = is_free && !begins_note(*in, mark.onset);
                        if (is_late && begins_note(voice, mark.onset)) in = &voice;
                    }
                }
                marks[in].push_back(mark);
                is_hairpin = mark.kind == DynamicMark::Kind::crescendo || mark.kind == DynamicMark::Kind::diminuendo;
            }
        }
        return marks;
    }

    void write_voice(const Staff& staff, std::size_t index, const std::vector<KeyChange>& keys,
                     const std::vector<DynamicMark>& marks, std::span<const ChordMark> chords) {
        const NotatedVoice& voice = staff.voices[index];
        const BarLines& bar_lines = notation_.bar_lines;
        const bool is_first_of_score = &voice == &notation_.parts.front().staves.front().voices.front();
        auto section = notation_.changes.begin();
        std::array<int, 7> signs = signs_of(keys.front().key);
        auto key = keys.begin() + 1;
        const bool is_first = index == 0;
        std::size_t change = 0;
        std::size_t mark = 0;
        Clef clef = staff.changes.front().clef;
        int octaves = 0;
        std::string_view hairpin;
        auto chord = chords.begin();
        std::string sung;       // syllables of the line
        std::set<int> altered;  // letters whose sign is not that of the key
        put("{}", bar_beginning(0));
        for (std::size_t i = 0; i < voice.symbols.size(); ++i) {
            const NotatedSymbol& symbol = voice.symbols[i];
            for (; key != keys.end() && key->onset <= symbol.onset; ++key) {
                signs = signs_of(key->key);
                put("[K:{} clef={}] ", key_name(key->key), clef_name(clef));
            }
            for (; section != notation_.changes.end() && section->onset <= symbol.onset; ++section) {
                write_section_change(*section, is_first_of_score);
            }
            for (; is_first && change < staff.changes.size() && staff.changes[change].onset <= symbol.onset;
                 ++change) {
                const StaffChange& next = staff.changes[change];
                if (next.clef != clef || next.restates_clef) put("[K:clef={}] ", clef_name(next.clef));
                clef = next.clef;
                const int line = std::clamp(next.octaves, -1, 1);
                if (octaves != line || next.restarts_line)
                    put("{}{}", line_of_octaves(octaves, ')'), line_of_octaves(line, '('));
                octaves = line;
            }
            for (; mark < marks.size() && marks[mark].onset <= symbol.onset; ++mark) {
                if (!hairpin.empty()) put("!{})!", hairpin);
                const DynamicMark& next = marks[mark];
                using enum DynamicMark::Kind;
                hairpin = next.kind == crescendo ? "<" : next.kind == diminuendo ? ">" : "";
                if (!hairpin.empty()) put("!{}(!", hairpin);
                if (next.kind == level) put("!{}!", dynamic_name(next.level));
            }
            for (; chord != chords.end() && chord->onset <= symbol.onset; ++chord)
                put("\"{}\"", chord->quality < 0 ? "^\u2013" : chord_name(*chord));
            if (symbol.begins_slur) put("(");
            if (symbol.tuplet >= 0) write_tuplet(voice, symbol);
            const std::int64_t bars = notation_.bars_of(symbol);
            if (bars > 1) {
                if (symbol.slows_down) put("\"^rit.\"");
                put("{}{}", symbol.kind == SymbolKind::gap ? "X" : "Z", bars);
            } else {
                write_symbol(symbol, form_of(clef).octaves, signs, altered);
            }
            if (symbol.ends_slur) put(")");
            if (symbol.kind == SymbolKind::note) {
                sung += fmt::format(" {}", symbol.syllable.empty() ? "*" : symbol.syllable);
            }
            const std::int64_t end = symbol.onset + bars * symbol.length;
            i += static_cast<std::size_t>(bars - 1);
            const bool is_beamed = symbol.beams[0] == Beam::begin || symbol.beams[0] == Beam::inside;
            if (bar_lines.place(end) != 0) {
                put("{}", is_beamed ? "" : " ");
                continue;
            }
            altered.clear();
            const bool is_last = end == notation_.end();
            const std::int64_t full_bars = bar_lines.printed_number(end) - 1;
            const bool ends_line = is_last || (full_bars > 0 && full_bars % bars_on_a_line_ == 0);
            if (is_last) put("{}", line_of_octaves(octaves, ')'));
            const std::string line = bar_line(end, is_last, ends_line);
            const std::string beginning = is_last ? "" : bar_beginning(end);
            // A repeat that begins where another one ends: `:||:`.
            const bool are_joined = !line.empty() && beginning.starts_with('|');
            put("{}{}{}", line.empty() ? "" : " ", line, ends_line ? "\n" : are_joined ? "" : " ");
            if (ends_line) {
                if (sung.find_first_not_of(" *") != std::string::npos) put("w:{}\n", sung);
                sung.clear();
            }
            put("{}", beginning);
        }
    }

    /// The bar line at the end of a bar: `|`, `:|`, `||` or `|]`; empty if the next sign contains it.
    std::string bar_line(std::int64_t end, bool is_last, bool ends_line) const {
        const RepeatSigns signs = signs_at(notation_.repeats, end);
        if (signs.ended) return ":|";
        if (signs.begun && !ends_line) return "";
        if (is_last) return notation_.is_cut ? "|" : "|]";
        const std::vector<std::int64_t>& doubled = notation_.double_bars;
        // A double bar ends the bracket of a second ending.
        return signs.closed || std::binary_search(doubled.begin(), doubled.end(), end) ? "||" : "|";
    }

    /// The sign at the beginning of a bar: `|:`, `[1` or `[2`.
    std::string bar_beginning(std::int64_t begin) const {
        const RepeatSigns signs = signs_at(notation_.repeats, begin);
        if (signs.first_ending) return "[1 ";
        if (signs.ended && signs.ended->has_endings()) return "[2 ";
        return signs.begun ? "|: " : "";
    }

    /// Names of chords are read, not heard; abc2midi has to know them all the same.
    void write_chord_kinds() {
        std::set<int> used;
        for (const NotatedPart& part : notation_.parts) {
            for (const ChordMark& chord : part.chords) used.insert(chord.quality);
        }
        for (const int kind : used) {
            if (kind < 0) continue;
            const ChordQuality& quality = chord_qualities()[static_cast<std::size_t>(kind)];
            if (quality.name == "maj") continue;  // written without a name
            put("%%MIDI chordname {}", quality.name);
            for (const int tone : quality.tones) {
                if (tone >= 0) put(" {}", tone);
            }
            put("\n");
        }
        if (!used.empty()) put("%%MIDI gchordoff\n");
    }

    /// `F#m7`, `C/G`.
    static std::string chord_name(const ChordMark& chord) {
        const auto name = [](const Pitch& pitch) {
            return fmt::format("{}{}", "CDEFGAB"[pitch.letter],
                               pitch.quarters < 0   ? "b"
                               : pitch.quarters > 0 ? "#"
                                                    : "");
        };
        std::string quality(chord_qualities()[static_cast<std::size_t>(chord.quality)].name);
        if (quality == "maj") quality.clear();
        return name(chord.root) + quality + (chord.bass ? "/" + name(*chord.bass) : "");
    }

    /// A mark at a space without width between notes, as programs disagree on whether a note with the mark is under
    /// the line. They do not support lines of two octaves.
    static std::string line_of_octaves(int octaves, char side) {
        if (octaves == 0) return {};
        return fmt::format("!8v{}{}!y0 ", octaves > 0 ? 'a' : 'b', side);
    }

    void write_tuplet(const NotatedVoice& voice, const NotatedSymbol& symbol) {
        const TupletSpan& tuplet = voice.tuplets[static_cast<std::size_t>(symbol.tuplet)];
        if (tuplet.from != symbol.onset) return;
        const auto count = std::count_if(voice.symbols.begin(), voice.symbols.end(),
                                         [&](const NotatedSymbol& each) { return each.tuplet == symbol.tuplet; });
        put("({}:{}:{}", tuplet.actual, tuplet.normal, count);
    }

    /// A note without its length.
    std::string head_of(const Pitch& pitch, int drum, int octaves, const std::array<int, 7>& signs,
                        std::set<int>& altered) const {
        if (drum > 0) return drum_notes_.at(drum);
        const bool is_plain = pitch.quarters == 2 * signs[static_cast<std::size_t>(pitch.letter)];
        if (!is_plain) altered.insert(pitch.letter);
        const bool is_signed = altered.count(pitch.letter) > 0;
        return (is_signed ? std::string(sign_of(pitch.quarters)) : "") + letter_of(pitch, octaves);
    }

    /// @param octaves  octaves that players add for the clef
    void write_symbol(const NotatedSymbol& symbol, int octaves, const std::array<int, 7>& signs,
                      std::set<int>& altered) {
        const bool is_bar =
            symbol.length == notation_.bar_lines.written(symbol.onset) && symbol.kind != SymbolKind::note;
        const std::string length = length_of(is_bar ? symbol.length : symbol.value.ticks());
        if (symbol.slows_down) put("\"^rit.\"");
        if (symbol.has_fermata) put("!fermata!");
        if (symbol.kind != SymbolKind::note) {
            put("{}{}", symbol.kind == SymbolKind::gap ? "x" : "z", length);
            return;
        }
        const Pitch& pitch = symbol.pitch;
        if (symbol.is_accented) put("!accent!");
        if (symbol.is_staccato) put(".");
        if (symbol.ends_slide) put("!~)!");
        if (symbol.begins_slide) put("!~(!");
        if (symbol.leaves != 0) put("\"^gliss.\"");
        for (const int cents : printed_cents(symbol)) put("\"^{:+}\"", cents);
        if (symbol.grace) put("{{/{}}}", head_of(symbol.grace->pitch, 0, octaves, signs, altered));
        std::string text = head_of(pitch, symbol.drum, octaves, signs, altered);
        for (const ChordNote& note : symbol.chord) text += head_of(note.pitch, note.drum, octaves, signs, altered);
        put("{}{}{}", symbol.chord.empty() ? text : "[" + text + "]", length, symbol.tied_forward ? "-" : "");
    }

    const Notation& notation_;
    const ScoreHead& head_;
    std::map<int, std::string> drum_notes_;  // by key
    std::int64_t bars_on_a_line_ = 4;
};

}  // namespace

void write_abc(const Notation& notation, const ScoreHead& head, Output& out) {
    AbcWriter(notation, head, out).write();
}

}  // namespace sikku
