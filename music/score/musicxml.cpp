#include "music/score/score_formats.h"

#include "engine/base/text.h"
#include "music/score/chord_signs.h"
#include "music/score/drums.h"
#include "music/score/dynamics.h"
#include "music/score/labels.h"
#include "music/score/swing.h"
#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {
namespace {

constexpr int voice_numbers_per_staff = 4;

/// Name of a note value. @param divisor  a power of two
std::string_view type_name(int divisor) {
    static constexpr std::array<std::string_view, 7> names = {"whole", "half", "quarter", "eighth",
                                                              "16th",  "32nd", "64th"};
    return names[static_cast<std::size_t>(std::min(std::countr_zero(static_cast<unsigned>(divisor)), 6))];
}

std::string_view accidental_name(int quarters) {
    static constexpr std::array<std::string_view, 9> names = {
        "flat-flat", "three-quarters-flat",  "flat",        "quarter-flat", "natural", "quarter-sharp",
        "sharp",     "three-quarters-sharp", "double-sharp"};
    return names[static_cast<std::size_t>(std::clamp(quarters, -4, 4) + 4)];
}

/// Staves of a part that form a separate part in the file. Brackets join parts, because programs give the staves of
/// one part a brace, and some allow at most four.
struct XmlPart {
    const NotatedPart* part = nullptr;
    std::span<const Staff> staves;
    std::string name;
    std::string abbreviation;
    bool begins_group = false;
    bool ends_group = false;
};

/// Progress in writing the changes of a staff.
struct StaffState {
    const Staff* staff = nullptr;
    std::size_t index = 0;
    Clef clef = Clef::treble;
    int octaves = 0;
    bool is_hairpin = false;
    std::size_t change = 0;
    std::size_t mark = 0;
    std::size_t chord = 0;
};

class MusicXmlWriter : private TextWriter {
public:
    MusicXmlWriter(const Notation& notation, const ScoreHead& head, Output& sink)
        : TextWriter(sink), notation_(notation), head_(head) {}

    void write() {
        find_unit();
        divide_parts();
        write_head();
        for (std::size_t i = 0; i < parts_.size(); ++i) write_part(i);
        put("</score-partwise>\n");
        flush();
    }

private:
    /// Sets the ticks of a division: the largest number that divides every duration.
    void find_unit() {
        unit_ = std::gcd(ticks_per_quarter, head_.meter.bar());
        for (const SectionChange& change : notation_.changes) unit_ = std::gcd(unit_, change.to.meter.bar());
        each_symbol(notation_, [&](const NotatedSymbol& symbol) { unit_ = std::gcd(unit_, symbol.length); });
    }

    void divide_parts() {
        for (const NotatedPart& part : notation_.parts) {
            const std::span<const Staff> staves = part.staves;
            if (part.bracket != Bracket::bracket || staves.size() < 2) {
                parts_.push_back({&part, staves, part.name, part.abbreviation});
                continue;
            }
            for (std::size_t i = 0; i < staves.size(); ++i) {
                parts_.push_back({&part, staves.subspan(i, 1), line_name(part.name, i, staves.size()),
                                  line_name(part.abbreviation, i, staves.size()), i == 0, i + 1 == staves.size()});
            }
        }
    }

    void write_head() {
        put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<!DOCTYPE score-partwise PUBLIC \"-//Recordare//DTD MusicXML 4.0 Partwise//EN\" "
            "\"http://www.musicxml.org/dtds/partwise.dtd\">\n"
            "<score-partwise version=\"4.0\">\n");
        if (!head_.title.empty()) put("<work><work-title>{}</work-title></work>\n", xml_escaped(head_.title));
        put("<identification>\n");
        if (!head_.composer.empty()) put("<creator type=\"composer\">{}</creator>\n", xml_escaped(head_.composer));
        // Programs print the rights at the foot of the first page.
        if (!head_.source.empty()) put("<rights type=\"source\">{}</rights>\n", xml_escaped(head_.source));
        const std::string software = head_.made.substr(0, head_.made.find(','));
        put("<encoding><software>{}</software>"
            "<supports element=\"accidental\" type=\"yes\"/><supports element=\"beam\" type=\"yes\"/></encoding>\n",
            xml_escaped(software.empty() ? "sikku" : software));
        if (!head_.source.empty()) put("<source>{}</source>\n", xml_escaped(head_.source));
        put("<miscellaneous>\n");
        put("<miscellaneous-field name=\"made\">{}</miscellaneous-field>\n", xml_escaped(head_.made));
        put("<miscellaneous-field name=\"pattern\">{}</miscellaneous-field>\n", xml_escaped(head_.pattern));
        constexpr double points_per_millimetre = 72.27 / 25.4;
        // A staff is 40 tenths high.
        put("</miscellaneous>\n</identification>\n"
            "<defaults><scaling><millimeters>{:.2f}</millimeters><tenths>40</tenths></scaling></defaults>\n"
            "<part-list>\n",
            staff_size(notation_) / points_per_millimetre);
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            const XmlPart& told = parts_[i];
            if (told.begins_group) {
                put("<part-group type=\"start\" number=\"1\"><group-symbol>bracket</group-symbol>"
                    "<group-barline>yes</group-barline></part-group>\n");
            }
            if (told.part->part.is_drums) {
                write_drum_part(i);
            } else {
                // Sixteen channels, of which the tenth is for drums.
                const std::size_t channel = i % 15 < 9 ? i % 15 + 1 : i % 15 + 2;
                put("<score-part id=\"P{0}\">{1}"
                    "<score-instrument id=\"P{0}-I1\"><instrument-name>{2}</instrument-name></score-instrument>"
                    "<midi-instrument id=\"P{0}-I1\"><midi-channel>{3}</midi-channel>"
                    "<midi-program>{4}</midi-program></midi-instrument></score-part>\n",
                    i + 1, names_of(told), xml_escaped(told.name), channel, told.part->part.program + 1);
            }
            if (told.ends_group) put("<part-group type=\"stop\" number=\"1\"/>\n");
        }
        put("</part-list>\n");
    }

    static std::string names_of(const XmlPart& part) {
        return fmt::format("<part-name>{}</part-name><part-abbreviation>{}</part-abbreviation>",
                           xml_escaped(part.name), xml_escaped(part.abbreviation));
    }

    /// Writes a part with an instrument for each drum that it uses.
    void write_drum_part(std::size_t index) {
        std::set<int> used;
        for (const Staff& staff : parts_[index].staves) {
            const std::vector<int> drums = drums_of(staff);
            used.insert(drums.begin(), drums.end());
        }
        put("<score-part id=\"P{}\">{}", index + 1, names_of(parts_[index]));
        for (const int key : used) {
            put("<score-instrument id=\"P{}-I{}\"><instrument-name>{}</instrument-name></score-instrument>",
                index + 1, key, drum_of(key).name);
        }
        for (const int key : used) {
            put("<midi-instrument id=\"P{}-I{}\"><midi-channel>10</midi-channel><midi-program>1</midi-program>"
                "<midi-unpitched>{}</midi-unpitched></midi-instrument>",
                index + 1, key, key + 1);
        }
        put("</score-part>\n");
    }

    void write_part(std::size_t index) {
        part_ = index + 1;
        const XmlPart& part = parts_[index];
        const std::vector<KeyChange>& keys = part.part->keys;
        put("<part id=\"P{}\">\n", index + 1);
        std::vector<std::vector<std::size_t>> next;  // next symbol of each staff and voice
        std::vector<StaffState> states;
        for (const Staff& staff : part.staves) {
            next.emplace_back(staff.voices.size(), 0);
            states.push_back({&staff, states.size(), staff.changes.front().clef});
        }
        std::size_t key = 0;
        auto change = notation_.changes.begin();
        TempoAndMeter before = tempo_and_meter_of(head_);
        const std::vector<std::int64_t>& doubled = notation_.double_bars;
        for (std::int64_t bar = 0; bar < notation_.bars; ++bar) {
            const bool is_upbeat = bar == 0 && notation_.bar_lines.upbeat() > 0;
            put("<measure number=\"{}\"{}>\n",
                head_.first_bar - 1 + notation_.bar_lines.printed_number(notation_.bar_lines.onset(bar)),
                is_upbeat ? " implicit=\"yes\"" : "");
            const std::int64_t begin = notation_.bar_lines.onset(bar);
            write_left_signs(begin);
            if (bar == 0) write_attributes(part);
            const bool has_key = key + 1 < keys.size() && keys[key + 1].onset == begin;
            const bool has_change = change != notation_.changes.end() && change->onset == begin;
            const bool has_meter = has_change && change->to.meter != before.meter;
            if (has_key || has_meter) {
                put("<attributes>\n");
                if (has_key) write_key(keys[++key].key);
                if (has_meter) write_meter(change->to.meter);
                put("</attributes>\n");
            }
            if (const std::int64_t rests = notation_.bars_of_rest(begin); rests > 1) {
                put("<attributes><measure-style><multiple-rest>{}</multiple-rest></measure-style></attributes>\n",
                    rests);
            }
            if (bar == 0 && index == 0 && notation_.is_concert) {
                put("<direction placement=\"above\"><direction-type><words>{}</words></direction-type></direction>\n",
                    concert_text);
            }
            if (bar == 0 && notation_.is_extracted) {
                put("<direction placement=\"above\"><direction-type><words font-weight=\"bold\">{}</words>"
                    "</direction-type></direction>\n",
                    xml_escaped(part.name));
            }
            if (bar == 0 && index == 0) write_tempo(before);
            if (has_change) {
                if (index == 0 && needs_tempo_mark(before, change->to)) write_tempo(change->to);
                before = change++->to;
            }
            if (bar == 0 && part.part->part.swing.is_on()) {
                write_swing(part.part->part.swing, index == 0 || !common_swing(notation_));
            }
            here_ = begin;
            for (std::size_t staff = 0; staff < part.staves.size(); ++staff) {
                for (std::size_t voice = 0; voice < part.staves[staff].voices.size(); ++voice) {
                    staff_ = part.staves.size() > 1 ? staff + 1 : 0;
                    voice_ = static_cast<int>(staff) * voice_numbers_per_staff + static_cast<int>(voice) + 1;
                    write_bar(part.staves[staff].voices[voice], next[staff][voice], bar,
                              voice == 0 ? &states[staff] : nullptr, part);
                }
                write_cues(part.staves[staff], bar);
            }
            // A bar ends where its last voice did.
            go_to(notation_.bar_lines.onset(bar + 1));
            const bool is_last = bar + 1 == notation_.bars && !notation_.is_cut;
            write_right_signs(is_last                                                     ? "light-heavy"
                              : std::binary_search(doubled.begin(), doubled.end(), here_) ? "light-light"
                                                                                          : "",
                              index == 0);
            put("</measure>\n");
        }
        put("</part>\n");
    }

    /// Writes the repeat or the ending that begins with a bar.
    void write_left_signs(std::int64_t begin) {
        const RepeatSigns signs = signs_at(notation_.repeats, begin);
        if (signs.begun) {
            put("<barline location=\"left\"><bar-style>heavy-light</bar-style><repeat direction=\"forward\"/>"
                "</barline>\n");
        }
        if (signs.first_ending) {
            put("<barline location=\"left\"><ending number=\"{}\" type=\"start\">{}.</ending></barline>\n",
                passes_of_first_ending(*signs.first_ending, ","), passes_of_first_ending(*signs.first_ending, "., "));
        }
        if (signs.ended && signs.ended->has_endings()) {
            put("<barline location=\"left\"><ending number=\"{0}\" type=\"start\">{0}.</ending></barline>\n",
                signs.ended->times);
        }
    }

    /// Writes the bar line at the end of a bar, with the repeat or the ending that it ends. @param style  of the
    /// line, unless a repeat determines it; empty: a plain line
    void write_right_signs(std::string_view style, bool has_count) {
        const RepeatSigns signs = signs_at(notation_.repeats, here_);
        if (!signs.ended && !signs.closed && style.empty()) return;
        const PrintedRepeat* repeat = signs.ended;
        if (repeat && has_count && repeat->times > 2 && !repeat->has_endings()) {
            put("<direction placement=\"above\"><direction-type><words halign=\"right\">{}</words></direction-type>"
                "</direction>\n",
                count_of_repeats(*repeat));
        }
        put("<barline location=\"right\">");
        if (repeat) style = "light-heavy";
        if (!style.empty()) put("<bar-style>{}</bar-style>", style);
        if (repeat && repeat->has_endings()) {
            put("<ending number=\"{}\" type=\"stop\"/>", passes_of_first_ending(*repeat, ","));
        }
        // The bracket stays open unless the score ends.
        if (signs.closed) {
            put("<ending number=\"{}\" type=\"{}\"/>", signs.closed->times,
                style == "light-heavy" ? "stop" : "discontinue");
        }
        if (repeat) {
            put("<repeat direction=\"backward\"{}/>",
                repeat->times > 2 ? fmt::format(" times=\"{}\"", repeat->times) : "");
        }
        put("</barline>\n");
    }

    void write_key(const std::optional<KeySignature>& key) {
        put("<key><fifths>{}</fifths>{}</key>\n", key ? key->fifths : 0,
            key ? fmt::format("<mode>{}</mode>", mode_name(key->mode)) : "");
    }

    void write_attributes(const XmlPart& part) {
        put("<attributes>\n<divisions>{}</divisions>\n", ticks_per_quarter / unit_);
        write_key(part.part->keys.front().key);
        write_meter(head_.meter);
        if (part.staves.size() > 1) put("<staves>{}</staves>\n", part.staves.size());
        if (part.part->has_pedal) put("<part-symbol top-staff=\"1\" bottom-staff=\"2\">brace</part-symbol>\n");
        for (std::size_t i = 0; i < part.staves.size(); ++i) write_clef(part.staves[i].changes.front().clef, part, i);
        if (part.staves.front().lines == 1) put("<staff-details><staff-lines>1</staff-lines></staff-details>\n");
        if (const auto& by = part.part->transposition) write_transposition(*by);
        put("</attributes>\n");
    }

    void write_meter(const Meter& meter) {
        put("<time><beats>{}</beats><beat-type>{}</beat-type></time>\n", beats_text(meter), meter.unit);
    }

    void write_transposition(const Transposition& by) {
        const int octaves = by.semitones / 12;
        put("<transpose><diatonic>{}</diatonic><chromatic>{}</chromatic>{}</transpose>\n",
            -(by.letters - 7 * octaves), -(by.semitones - 12 * octaves),
            octaves > 0 ? fmt::format("<octave-change>{}</octave-change>", -octaves) : "");
    }

    void write_clef(Clef clef, const XmlPart& part, std::size_t staff) {
        const std::string staff_number = part.staves.size() > 1 ? fmt::format(" number=\"{}\"", staff + 1) : "";
        if (clef == Clef::percussion) {
            put("<clef{}><sign>percussion</sign></clef>\n", staff_number);
            return;
        }
        const ClefForm& form = form_of(clef);
        put("<clef{}><sign>{}</sign><line>{}</line>{}</clef>\n", staff_number, form.sign, form.line,
            form.octaves != 0 ? fmt::format("<clef-octave-change>{}</clef-octave-change>", form.octaves) : "");
    }

    /// Writes the tempo in beats of the meter, rounded to a whole number unless beats are quarters.
    void write_tempo(const TempoAndMeter& now) {
        const BeatUnit beat = beat_unit(now.meter);
        const double tempo = beat.quarters == 1 ? now.tempo : std::max(1.0, std::round(now.tempo / beat.quarters));
        const std::string words =
            now.tempo_words.empty()
                ? ""
                : fmt::format("<direction-type><words font-weight=\"bold\">{} </words></direction-type>",
                              xml_escaped(now.tempo_words));
        put("<direction placement=\"above\">{}<direction-type><metronome><beat-unit>{}</beat-unit>{}"
            "<per-minute>{}</per-minute></metronome></direction-type><sound tempo=\"{}\"/></direction>\n",
            words, type_name(beat.value.divisor), beat.value.dotted ? "<beat-unit-dot/>" : "", tempo, now.tempo);
    }

    /// Programs play eighths and sixteenths with swing. @param has_words  prints it, too
    void write_swing(const Swing& swing, bool has_words) {
        const std::int64_t eighth = ticks_per_quarter / 2;
        const auto [first, second] = swing_ratio(swing);
        const std::string sound =
            swing.unit != eighth && swing.unit != eighth / 2
                ? ""
                : fmt::format(
                      "<sound><swing><first>{}</first><second>{}</second><swing-type>{}</swing-type></swing></sound>",
                      first, second, swing.unit == eighth ? "eighth" : "16th");
        if (!has_words) return put("{}\n", sound);
        put("<direction placement=\"above\"><direction-type><words font-weight=\"bold\">{}</words></direction-type>{}"
            "</direction>\n",
            swing_words(swing), sound);
    }

    void go_to(std::int64_t time) {
        if (time < here_) put("<backup><duration>{}</duration></backup>\n", (here_ - time) / unit_);
        if (time > here_) put("<forward><duration>{}</duration></forward>\n", (time - here_) / unit_);
        here_ = time;
    }

    void write_direction(std::string_view type, std::string_view placement) {
        put("<direction placement=\"{}\"><direction-type>{}</direction-type>", placement, type);
        if (staff_ > 0) put("<staff>{}</staff>", staff_);
        put("</direction>\n");
    }

    /// Writes clefs, 8va lines and dynamics that begin before `end`.
    void write_changes(StaffState& state, std::int64_t end, const XmlPart& part) {
        const Staff& staff = *state.staff;
        for (; state.change < staff.changes.size() && staff.changes[state.change].onset < end; ++state.change) {
            const StaffChange& change = staff.changes[state.change];
            go_to(change.onset);
            if (change.clef != state.clef || change.restates_clef) {
                put("<attributes>\n");
                write_clef(change.clef, part, state.index);
                put("</attributes>\n");
            }
            if (change.octaves != state.octaves || change.restarts_line) {
                if (state.octaves != 0) write_shift(state, "stop", state.octaves);
                if (change.octaves != 0) write_shift(state, change.octaves > 0 ? "down" : "up", change.octaves);
            }
            state.clef = change.clef;
            state.octaves = change.octaves;
        }
        const std::vector<ChordMark>& chords = part.part->chords;
        for (; &staff == &part.part->staves.front() && state.chord < chords.size() && chords[state.chord].onset < end;
             ++state.chord) {
            go_to(chords[state.chord].onset);
            write_chord_mark(chords[state.chord]);
        }
        for (; state.mark < staff.dynamics.size() && staff.dynamics[state.mark].onset < end; ++state.mark) {
            const DynamicMark& mark = staff.dynamics[state.mark];
            go_to(mark.onset);
            if (state.is_hairpin) write_direction("<wedge type=\"stop\"/>", "below");
            using enum DynamicMark::Kind;
            state.is_hairpin = mark.kind == crescendo || mark.kind == diminuendo;
            if (state.is_hairpin) {
                const bool rises = mark.kind == crescendo;
                write_direction(fmt::format("<wedge type=\"{}\"/>", rises ? "crescendo" : "diminuendo"), "below");
            } else if (mark.kind == level) {
                write_direction(fmt::format("<dynamics><{}/></dynamics>", dynamic_name(mark.level)), "below");
            }
        }
    }

    void write_chord_mark(const ChordMark& chord) {
        const std::string staff = staff_ > 0 ? fmt::format("<staff>{}</staff>", staff_) : "";
        if (chord.quality < 0) {
            // A dash ends a name where a chord without one follows.
            return put(
                "<harmony placement=\"above\"><root><root-step text=\"\">C</root-step></root>"
                "<kind text=\"\u2013\">none</kind>{}</harmony>\n",
                staff);
        }
        const ChordQuality& quality = chord_qualities()[static_cast<std::size_t>(chord.quality)];
        const auto pitch = [](std::string_view name, const Pitch& one) {
            return fmt::format(
                "<{0}><{0}-step>{1}</{0}-step>{2}</{0}>", name, "CDEFGAB"[one.letter],
                one.quarters != 0 ? fmt::format("<{0}-alter>{1}</{0}-alter>", name, one.quarters / 2) : "");
        };
        const std::string added = quality.added == 0
                                      ? ""
                                      : fmt::format(
                                            "<degree print-object=\"no\"><degree-value>{}</degree-value>"
                                            "<degree-alter>0</degree-alter><degree-type>add</degree-type></degree>",
                                            quality.added);
        put("<harmony placement=\"above\">{}<kind text=\"{}\">{}</kind>{}{}{}</harmony>\n", pitch("root", chord.root),
            quality.printed, quality.musicxml, chord.bass ? pitch("bass", *chord.bass) : "", added, staff);
    }

    void write_shift(const StaffState& state, std::string_view type, int octaves) {
        write_direction(fmt::format("<octave-shift type=\"{}\" size=\"{}\" number=\"{}\"/>", type,
                                    7 * std::abs(octaves) + 1, state.index % 16 + 1),
                        octaves > 0 ? "above" : "below");
    }

    /// Writes the cues of a bar, as the voice after those of the staff.
    void write_cues(const Staff& staff, std::int64_t bar) {
        const std::int64_t begin = notation_.bar_lines.onset(bar);
        for (const Cue& cue : staff.cues) {
            if (begin < cue.from || begin >= cue.to) continue;
            go_to(begin);
            if (begin == cue.from) {
                write_direction(fmt::format("<words font-size=\"7\">{}</words>", xml_escaped(cue.name)), "above");
            }
            ++voice_;
            is_cue_ = true;
            auto next = static_cast<std::size_t>(
                std::find_if(cue.voice.symbols.begin(), cue.voice.symbols.end(),
                             [&](const NotatedSymbol& symbol) { return symbol.onset >= begin; }) -
                cue.voice.symbols.begin());
            write_bar(cue.voice, next, bar, nullptr, {});
            is_cue_ = false;
        }
    }

    void write_bar(const NotatedVoice& voice, std::size_t& next, std::int64_t bar, StaffState* state,
                   const XmlPart& part) {
        const std::int64_t end = notation_.bar_lines.onset(bar + 1);
        for (; next < voice.symbols.size() && voice.symbols[next].onset < end; ++next) {
            const NotatedSymbol& symbol = voice.symbols[next];
            if (state) write_changes(*state, symbol.onset + symbol.length, part);
            const bool is_empty = symbol.kind == SymbolKind::gap && notation_.is_whole_rest(symbol);
            if (is_empty && !symbol.slows_down) continue;
            go_to(symbol.onset);
            if (const std::vector<int> cents = printed_cents(symbol); !cents.empty()) {
                std::string words;
                for (const int one : cents) words += (words.empty() ? "" : "\n") + cents_text(one);
                write_direction(fmt::format("<words font-size=\"7\">{}</words>", words), "above");
            }
            if (symbol.slows_down) write_direction("<words font-style=\"italic\">rit.</words>", "above");
            if (is_empty) continue;
            if (symbol.grace) write_grace(*symbol.grace, symbol.onset);
            write_symbol(symbol, voice);
            for (const ChordNote& note : symbol.chord) write_chord_note(symbol, note, voice);
            here_ += symbol.length;
        }
        if (state && bar + 1 == notation_.bars && state->octaves != 0) {
            go_to(end);
            write_shift(*state, "stop", state->octaves);
            state->octaves = 0;
        }
    }

    /// Writes a further note of a chord like its first note, but without marks that are written once.
    void write_chord_note(const NotatedSymbol& first, const ChordNote& note, const NotatedVoice& voice) {
        NotatedSymbol symbol = first;
        symbol.pitch = note.pitch;
        symbol.drum = note.drum;
        symbol.has_sign = note.has_sign;
        symbol.begins_slur = symbol.ends_slur = symbol.is_staccato = false;
        symbol.is_accented = symbol.begins_slide = symbol.ends_slide = symbol.has_fermata = false;
        symbol.leaves = 0;
        symbol.beams = {};
        write_symbol(symbol, voice, true);
    }

    void write_symbol(const NotatedSymbol& symbol, const NotatedVoice& voice, bool is_chord = false) {
        const bool is_note = symbol.kind == SymbolKind::note;
        put("<note{}>{}{}", symbol.kind == SymbolKind::gap ? " print-object=\"no\"" : "", is_cue_ ? "<cue/>" : "",
            is_chord ? "<chord/>" : "");
        if (is_note) {
            write_pitch(symbol);
        } else {
            put("{}", symbol.kind == SymbolKind::bar_rest ? "<rest measure=\"yes\"/>" : "<rest/>");
        }
        put("<duration>{}</duration>", symbol.length / unit_);
        if (is_note && symbol.tied_back && !is_cue_) put("<tie type=\"stop\"/>");
        if (is_note && symbol.tied_forward && !is_cue_) put("<tie type=\"start\"/>");
        if (symbol.drum > 0) put("<instrument id=\"P{}-I{}\"/>", part_, symbol.drum);
        put("<voice>{}</voice>", voice_);
        if (symbol.kind != SymbolKind::bar_rest) {
            put("<type{}>{}</type>{}", is_cue_ ? " size=\"cue\"" : "", type_name(symbol.value.divisor),
                symbol.value.dotted ? "<dot/>" : "");
        }
        if (is_note && symbol.has_sign) put("<accidental>{}</accidental>", accidental_name(symbol.pitch.quarters));
        const TupletSpan* tuplet =
            symbol.tuplet >= 0 ? &voice.tuplets[static_cast<std::size_t>(symbol.tuplet)] : nullptr;
        if (tuplet) {
            put("<time-modification><actual-notes>{}</actual-notes><normal-notes>{}</normal-notes>"
                "<normal-type>{}</normal-type></time-modification>",
                tuplet->actual, tuplet->normal, type_name(tuplet->divisor));
        }
        if (is_cue_ && is_note) put("<stem>up</stem>");
        static constexpr std::array<std::string_view, 4> heads = {"normal", "x", "diamond", "triangle"};
        const NoteHead head = symbol.drum > 0 ? drum_of(symbol.drum).head : NoteHead::normal;
        if (symbol.is_ghost || head != NoteHead::normal) {
            put("<notehead{}>{}</notehead>", symbol.is_ghost ? " parentheses=\"yes\"" : "",
                heads[static_cast<std::size_t>(head)]);
        }
        if (staff_ > 0) put("<staff>{}</staff>", staff_);
        write_beams(symbol);
        write_notations(symbol, is_chord ? nullptr : tuplet);
        if (!symbol.syllable.empty() && !is_chord) {
            put("<lyric><syllabic>single</syllabic><text>{}</text></lyric>", symbol.syllable);
        }
        put("</note>\n");
    }

    /// Writes a note before the beat, with a stroke through its stem.
    void write_grace(const ChordNote& grace, std::int64_t onset) {
        NotatedSymbol symbol;
        symbol.onset = onset;
        symbol.pitch = grace.pitch;
        put("<note><grace slash=\"yes\"/>");
        write_pitch(symbol);
        put("<voice>{}</voice><type>eighth</type>", voice_);
        if (grace.has_sign) put("<accidental>{}</accidental>", accidental_name(grace.pitch.quarters));
        if (staff_ > 0) put("<staff>{}</staff>", staff_);
        put("</note>\n");
    }

    void write_beams(const NotatedSymbol& symbol) {
        static constexpr std::array<std::string_view, 6> names = {"",    "begin",        "continue",
                                                                  "end", "forward hook", "backward hook"};
        for (std::size_t i = 0; i < symbol.beams.size() && symbol.beams[i] != Beam::none; ++i) {
            put("<beam number=\"{}\">{}</beam>", i + 1, names[static_cast<std::size_t>(symbol.beams[i])]);
        }
    }

    void write_notations(const NotatedSymbol& symbol, const TupletSpan* tuplet) {
        const bool is_first = tuplet && tuplet->from == symbol.onset;
        const bool is_last = tuplet && tuplet->to == symbol.onset + symbol.length;
        if (!symbol.tied_back && !symbol.tied_forward && !is_first && !is_last && !symbol.is_accented &&
            !symbol.begins_slide && !symbol.ends_slide && symbol.leaves == 0 && !symbol.has_fermata &&
            !symbol.begins_slur && !symbol.ends_slur && !symbol.is_staccato) {
            return;
        }
        put("<notations>{}{}", symbol.tied_back ? "<tied type=\"stop\"/>" : "",
            symbol.tied_forward ? "<tied type=\"start\"/>" : "");
        if (is_first) put("<tuplet type=\"start\"/>");
        if (is_last) put("<tuplet type=\"stop\"/>");
        const int slide = (voice_ - 1) % 6 + 1;
        if (symbol.ends_slide) put("<slide type=\"stop\" number=\"{}\"/>", slide);
        if (symbol.begins_slide) put("<slide type=\"start\" number=\"{}\" line-type=\"solid\"/>", slide);
        if (symbol.ends_slur) put("<slur type=\"stop\" number=\"{}\"/>", slide);
        if (symbol.begins_slur) put("<slur type=\"start\" number=\"{}\"/>", slide);
        if (symbol.is_accented || symbol.is_staccato || symbol.leaves != 0) {
            put("<articulations>{}{}{}</articulations>", symbol.is_accented ? "<accent/>" : "",
                symbol.is_staccato ? "<staccato/>" : "",
                symbol.leaves > 0   ? "<doit/>"
                : symbol.leaves < 0 ? "<falloff/>"
                                    : "");
        }
        // Second voices have theirs below the staff.
        if (symbol.has_fermata)
            put("{}", voice_ % voice_numbers_per_staff % 2 == 0 ? "<fermata type=\"inverted\"/>" : "<fermata/>");
        put("</notations>");
    }

    void write_pitch(const NotatedSymbol& symbol) {
        const Pitch& pitch = symbol.pitch;
        if (symbol.drum > 0) {
            put("<unpitched><display-step>{}</display-step><display-octave>{}</display-octave></unpitched>",
                "CDEFGAB"[pitch.letter], pitch.octave);
            return;
        }
        if (pitch.octave < 0) {
            throw ScoreError(fmt::format("bar {} has a note below C0, the lowest that MusicXML can tell",
                                         notation_.bar_lines.printed_number(symbol.onset)));
        }
        put("<pitch><step>{}</step>", "CDEFGAB"[pitch.letter]);
        if (pitch.quarters != 0) put("<alter>{}</alter>", 0.5 * pitch.quarters);
        put("<octave>{}</octave></pitch>", pitch.octave);
    }

    const Notation& notation_;
    const ScoreHead& head_;
    std::vector<XmlPart> parts_;
    std::int64_t unit_ = 1;  ///< ticks of a division
    std::int64_t here_ = 0;  ///< position of the reader, in ticks
    std::size_t part_ = 1;   ///< from 1
    std::size_t staff_ = 0;  ///< from 1; 0 if there is only one
    int voice_ = 1;
    bool is_cue_ = false;
};

}  // namespace

void write_musicxml(const Notation& notation, const ScoreHead& head, Output& sink) {
    MusicXmlWriter(notation, head, sink).write();
}

}  // namespace sikku
