#include "music/score/score_formats.h"

#include "engine/base/diagnostic.h"
#include "music/score/chord_signs.h"
#include "music/score/comments.h"
#include "music/score/drums.h"
#include "music/score/dynamics.h"
#include "music/score/instruments.h"
#include "music/score/labels.h"
#include "music/score/swing.h"
#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

constexpr std::string_view rit = "\\markup \\normal-text \\italic \"rit.\" ";

/// The name of a pitch: c d e … b, a sign (also for quarter tones), the octave: c' is middle C.
std::string pitch_name(const Pitch& pitch) {
    static constexpr std::array<std::string_view, 9> signs = {"eses", "eseh", "es",   "eh",  "",
                                                              "ih",   "is",   "isih", "isis"};
    std::string name(1, "cdefgab"[pitch.letter]);
    name += signs[static_cast<std::size_t>(std::clamp(pitch.quarters, -4, 4) + 4)];
    // c without a mark is C3.
    const int marks = pitch.octave - 3;
    return name.append(static_cast<std::size_t>(std::abs(marks)), marks > 0 ? '\'' : ',');
}

/// A length in ticks as a fraction of a whole note.
std::string part_of_whole(std::int64_t ticks) {
    const std::int64_t common = std::gcd(ticks, 4 * ticks_per_quarter);
    return fmt::format("{}/{}", ticks / common, 4 * ticks_per_quarter / common);
}

std::string length_name(NoteValue value) {
    return fmt::format("{}{}", value.divisor, value.dotted ? "." : "");
}

std::string_view clef_name(Clef clef) {
    static constexpr std::array<std::string_view, 8> names = {
        "treble", "bass", "alto", "tenor", "\"treble_8\"", "\"bass_8\"", "\"treble^8\"", "percussion"};
    return names[static_cast<std::size_t>(clef)];
}

/// The meter, with groups if the pattern states them or LilyPond does not support them by default.
std::string meter_name(const Meter& meter) {
    const std::string fraction = fmt::format("{}/{}", meter.beats, meter.unit);
    if (!has_groups(meter)) return "\\time " + fraction;
    std::vector<std::int64_t> groups = groups_of(meter);
    for (std::int64_t& group : groups) group = group * meter.unit / (4 * ticks_per_quarter);
    if (meter.groups[0] == 0) return fmt::format("\\time {} {}", fmt::join(groups, ","), fraction);
    return fmt::format("\\compoundMeter #'(({} {}))", fmt::join(groups, " "), meter.unit);
}

std::string key_name(const KeySignature& key) {
    // Along the fifths, from the tonic of seven flats in lydian on.
    constexpr std::string_view letters = "fcgdaeb";
    const int from_f = std::clamp(key.fifths, -7, 7) + static_cast<int>(key.mode);
    const int letter = (from_f + 7) % 7;
    const int sharps = (from_f - letter) / 7;
    return fmt::format("\\key {}{} \\{}", letters[static_cast<std::size_t>(letter)],
                       sharps < 0   ? "es"
                       : sharps > 0 ? "is"
                                    : "",
                       mode_name(key.mode));
}

class LilypondWriter : private TextWriter {
public:
    LilypondWriter(const Notation& notation, const ScoreHead& head, Output& sink)
        : TextWriter(sink), notation_(notation), head_(head) {}

    void write() {
        each_symbol(notation_, [&](const NotatedSymbol& symbol) {
            if (symbol.grace) graces_.insert(symbol.onset);
        });
        put("\\version \"2.24.0\"\n\n");
        put("{}", head_comments(head_, "%"));
        put("\n\\header {{\n");
        if (!head_.title.empty()) put("  title = {}\n", text_lines(head_.title, title_width));
        if (!head_.composer.empty()) put("  composer = {}\n", text_lines(head_.composer, composer_width));
        // The name of a single part stands above it, as in printed music; those of several stand before their staves.
        const bool is_solo = notation_.parts.size() == 1;
        if (is_solo) put("  instrument = {}\n", text_lines(notation_.parts.front().name, title_width));
        if (notation_.is_concert) put("  poet = \"{}\"\n", concert_text);
        if (!head_.source.empty()) put("  copyright = {}\n", text_lines(head_.source, source_width));
        put("  tagline = ##f\n}}\n\n");
        write_drum_table();
        if (has_chords()) write_chord_exceptions();
        write_paper();
        const bool has_repeats = !notation_.repeats.empty();
        put("{}\n  <<\n", has_repeats ? "sikkuMusic =" : "\\score {");
        for (std::size_t i = 0; i < notation_.parts.size(); ++i) write_part(i);
        put("  >>\n{}", has_repeats ? "\n\\score {\n  \\sikkuMusic\n" : "");
        write_layout();
        // A repeated passage is printed once and unfolded for MIDI.
        if (has_repeats) put("}}\n\n\\score {{\n  \\unfoldRepeats \\sikkuMusic\n");
        // Cues and names of chords are read, not heard.
        put("  \\midi {{{}{} }}\n}}\n", has_cues() ? " \\context { \\CueVoice \\remove \"Note_performer\" }" : "",
            has_chords() ? " \\context { \\ChordNames \\remove \"Note_performer\" }" : "");
        flush();
    }

private:
    /// Writes a table of the drums used, as LilyPond's own tables lack some.
    void write_drum_table() {
        const bool has_drums = std::any_of(notation_.parts.begin(), notation_.parts.end(),
                                           [](const NotatedPart& one) { return one.part.is_drums; });
        if (!has_drums) return;
        put("#(define sikkuDrums (alist->hash-table '(\n");
        for (const int key : drums_of(notation_)) {
            const Drum& drum = drum_of(key);
            // Counted from the middle line.
            const int place = Pitch{drum.letter, drum.octave, 0}.height() - Pitch{6, 4, 0}.height();
            put("  {}  ; {}\n", drum_row(key, place), drum.name);
        }
        put(")))\n\n");
    }

    /// LilyPond names an added ninth like one with a seventh.
    void write_chord_exceptions() {
        put("sikkuChords = #(append (sequential-music-to-chord-exceptions #{{ {{\n"
            "  <c e g d'>1-\\markup \\super \"add9\"\n"
            "  <c es g d'>1-\\markup {{ m \\super \"add9\" }}\n"
            "}} #}} #t) ignatzekExceptions)\n\n");
    }

    /// Sets systems farther apart than their staves, and keeps the foot of the page free.
    void write_paper() {
        constexpr int usual = 20;
        if (const int size = staff_size(notation_); size != usual) put("#(set-global-staff-size {})\n\n", size);
        put("\\paper {{\n"
            "  system-system-spacing = #'((basic-distance . 14) (minimum-distance . 8) (padding . 3) "
            "(stretchability . 60))\n"
            "  last-bottom-spacing = #'((basic-distance . 6) (minimum-distance . 5) (padding . 4) "
            "(stretchability . 30))\n");
        // LilyPond underestimates the height of systems with tuplets, and would have to squeeze a page.
        if (has_tuplets()) put("  page-breaking-system-system-spacing.padding = #5\n");
        // Players turn pages at rests; a part of two pages begins on a left one.
        if (notation_.is_extracted) put("  page-breaking = #ly:page-turn-breaking\n  auto-first-page-number = ##t\n");
        put("}}\n\n");
    }

    bool has_tuplets() const {
        bool has_any = false;
        each_voice(notation_, [&](const NotatedVoice& voice) { has_any = has_any || !voice.tuplets.empty(); });
        return has_any;
    }

    bool has_slides() const {
        bool has_any = false;
        each_symbol(notation_, [&](const NotatedSymbol& symbol) { has_any = has_any || symbol.begins_slide; });
        return has_any;
    }

    bool has_cues() const {
        return std::any_of(notation_.parts.begin(), notation_.parts.end(), [](const NotatedPart& part) {
            return std::any_of(part.staves.begin(), part.staves.end(),
                               [](const Staff& staff) { return !staff.cues.empty(); });
        });
    }

    bool has_chords() const {
        return std::any_of(notation_.parts.begin(), notation_.parts.end(),
                           [](const NotatedPart& part) { return !part.chords.empty(); });
    }

    /// Reserves room for names, and leaves out staves that rest throughout a system.
    void write_layout() {
        std::size_t longest = 0;
        std::size_t shortest = 0;
        std::size_t staves = 0;
        for (const NotatedPart& part : notation_.parts) {
            for (std::size_t i = 0; i < part.staves.size(); ++i) {
                const auto [name, abbreviation] = names_of(part, i);
                for (const std::string& line : lines_of(name)) longest = std::max(longest, line.size());
                shortest = std::max(shortest, abbreviation.size());
            }
            staves += part.bracket == Bracket::brace ? 1 : part.staves.size();
        }
        // Millimetres for a name in LilyPond's font, with a gap before the bracket.
        const auto room = [](std::size_t letters, std::size_t gap) {
            return letters == 0 ? 0 : std::min<std::size_t>(gap + 2 * letters, 80);
        };
        put("  \\layout {{\n    indent = {}\\mm\n    short-indent = {}\\mm\n", room(longest, 10), room(shortest, 6));
        const bool has_bracket = std::any_of(
            notation_.parts.begin(), notation_.parts.end(),
            [](const NotatedPart& one) { return one.bracket == Bracket::bracket && one.staves.size() > 1; });
        // Bar numbers stand clear of the tips of brackets.
        put("    \\context {{ \\Score \\autoBeamOff{}{} }}\n",
            has_bracket ? " \\override BarNumber.padding = #2" : "", notation_.is_extracted ? " skipBars = ##t" : "");
        for (const std::string_view context : {"Staff", "DrumStaff"}) {
            put("    \\context {{ \\{} \\numericTimeSignature{} }}\n", context,
                notation_.is_extracted ? " \\consists \"Page_turn_engraver\"" : "");
        }
        if (has_slides()) {
            put("    \\context {{ \\Voice \\override Glissando.minimum-length = #4 "
                "\\override Glissando.springs-and-rods = #ly:spanner::set-spacing-rods }}\n");
        }
        if (staves > 1 && !notation_.is_extracted) {
            put("    \\context {{ \\Staff \\RemoveEmptyStaves }}\n    \\context {{ \\DrumStaff \\RemoveEmptyStaves "
                "}}\n");
        }
        put("  }}\n");
    }

    static bool is_pedal(const NotatedPart& part, std::size_t staff) {
        return part.has_pedal && staff + 1 == part.staves.size();
    }

    /// The name and the abbreviation of a staff, or of both hands. Staves of a bracket are numbered; a single part
    /// has its name above the score.
    std::pair<std::string, std::string> names_of(const NotatedPart& part, std::size_t staff) const {
        if (is_pedal(part, staff)) return {"Pedal", "Ped."};
        const bool is_solo = notation_.parts.size() == 1;
        constexpr std::size_t most = 45;
        const std::string name = is_solo ? "" : shortened(part.name, most);
        const std::size_t count = part.bracket == Bracket::bracket ? part.staves.size() : 1;
        return {line_name(name, staff, count), line_name(is_solo ? "" : part.abbreviation, staff, count)};
    }

    /// Numbers of letters that fit on a line of a page.
    static constexpr std::size_t title_width = 50;
    static constexpr std::size_t composer_width = 40;
    static constexpr std::size_t source_width = 100;

    /// A text, or the beginning of one that would fill the page or exceed the limits of PostScript.
    static std::string shortened(std::string_view text, std::size_t most) {
        std::string shown = single_line(text.substr(0, most + 3));  // whole letters
        if (shown.size() <= most && text.size() <= most) return shown;
        std::size_t end = 0;
        for (std::size_t next = 0; next <= std::min(most, shown.size());) {
            end = next;
            next += std::max<std::size_t>(1, utf8_length(std::string_view(shown).substr(end)));
        }
        shown.resize(end);
        while (shown.ends_with(' ')) shown.pop_back();
        return shown + "\u2026";
    }

    /// A text as a string, or as up to four centred lines of similar length and a little space.
    static std::string text_lines(std::string_view text, std::size_t width) {
        const std::string shown = shortened(text, 7 * width / 2);
        std::vector<std::string> lines = lines_of(shown, width, width);
        if (lines.size() < 2) return lilypond_string(shown);
        while (lines_of(shown, width - 1, width - 1).size() == lines.size()) {
            --width;
            lines = lines_of(shown, width, width);
        }
        return fmt::format("\\markup \\center-column {{ {} \\vspace #0.2 }}", strings_of(lines));
    }

    /// Lines of at most `most` bytes, except for words up to `longest_word`; longer words are divided.
    static std::vector<std::string> lines_of(std::string_view name, std::size_t most = 16,
                                             std::size_t longest_word = 32) {
        std::vector<std::string> lines;
        while (!name.empty()) {
            const std::size_t end = std::min(name.find(' '), name.size());
            std::string_view word = name.substr(0, end);
            name.remove_prefix(std::min(end + 1, name.size()));
            while (word.size() > longest_word) {
                std::size_t part = 0;
                while (part < most) part += std::max<std::size_t>(1, utf8_length(word.substr(part)));
                part = std::min(part, word.size());
                lines.emplace_back(word.substr(0, part));
                word.remove_prefix(part);
            }
            if (word.empty()) continue;
            const bool is_number = word.size() <= 4 && word.find_first_not_of("0123456789.") == word.npos;
            if (lines.empty() || (lines.back().size() + 1 + word.size() > most && !is_number)) {
                lines.emplace_back(word);
            } else {
                lines.back().append(" ").append(word);
            }
        }
        return lines;
    }

    static std::string strings_of(const std::vector<std::string>& lines) {
        std::string text;
        for (const std::string& line : lines) text += (text.empty() ? "" : " ") + lilypond_string(line);
        return text;
    }

    static std::string name_of(std::string_view name) {
        const std::vector<std::string> lines = lines_of(name);
        return lines.size() < 2 ? lilypond_string(name)
                                : fmt::format("\\markup \\right-column {{ {} }}", strings_of(lines));
    }

    static std::string drum_row(int key, int place) {
        static constexpr std::array<std::string_view, 4> heads = {"default", "cross", "diamond", "triangle"};
        const Drum& drum = drum_of(key);
        return fmt::format("({} {} #f {})", drum.lilypond, heads[static_cast<std::size_t>(drum.head)], place);
    }

    static std::string drum_settings(const Staff& staff) {
        if (staff.lines != 1) return "drumStyleTable = #sikkuDrums ";
        const std::vector<int> drums = drums_of(staff);
        return fmt::format("drumStyleTable = #(alist->hash-table '({})) \\override StaffSymbol.line-count = 1 ",
                           drums.empty() ? "" : drum_row(drums.front(), 0));
    }

    /// The opening of a context. @param are_hands  true for the group of both hands, which has their name
    std::string opening_of(const NotatedPart& part, std::size_t staff, bool are_hands) const {
        const bool is_drums = part.part.is_drums;
        const bool has_hands = part.bracket == Bracket::brace && part.staves.size() > 1;
        std::string settings;
        if (are_hands || !has_hands || is_pedal(part, staff)) {
            const auto [name, abbreviation] = names_of(part, staff);
            if (!name.empty()) {
                settings += fmt::format("instrumentName = {} shortInstrumentName = {} ", name_of(name),
                                        lilypond_string(abbreviation));
            }
            settings += is_drums ? drum_settings(part.staves[staff])
                                 : fmt::format("midiInstrument = {} ",
                                               lilypond_string(instrument_of(part.part.program).lilypond));
        }
        return fmt::format("\\new {}{}",
                           are_hands  ? "PianoStaff"
                           : is_drums ? "DrumStaff"
                                      : "Staff",
                           settings.empty() ? "" : " \\with { " + settings + "}");
    }

    void write_part(std::size_t index) {
        const NotatedPart& part = notation_.parts[index];
        const bool are_hands = part.bracket == Bracket::brace;
        const bool is_group = part.staves.size() > 1;
        // Dynamics of both hands stand between them.
        const bool is_shared = are_hands && is_group && part.staves.back().dynamics.empty();
        write_chords(part.chords);
        if (is_group) put("    {} <<\n", are_hands ? opening_of(part, 0, true) : "\\new StaffGroup");
        for (std::size_t i = 0; i < part.staves.size(); ++i) {
            write_staff(part.staves[i], part, opening_of(part, i, false), index == 0 && i == 0, !is_shared);
            // The pedal of an organ stands below the brace.
            if (part.has_pedal && i + 2 == part.staves.size()) put("    >>\n");
            if (is_shared && i == 0) {
                put("    \\new Dynamics {{\n");
                write_dynamics(part.staves[i].dynamics);
                put("    }}\n");
            }
        }
        if (is_group && !part.has_pedal) put("    >>\n");
    }

    /// The tempo in beats of the meter, as a whole number: LilyPond does not accept fractions, and truncates them in
    /// MIDI files.
    static std::string tempo_mark(double tempo, const Meter& meter, std::string words, bool slows_down) {
        const BeatUnit beat = beat_unit(meter);
        if (!words.empty()) words = lilypond_string(words) + " ";
        const std::string text = !slows_down     ? words
                                 : words.empty() ? std::string(rit)
                                                 : fmt::format("\\markup {{ {}{} }} ", words, rit.substr(8));
        return fmt::format("\\tempo {}{}{} = {}", text, beat.value.divisor, beat.value.dotted ? "." : "",
                           std::max<long long>(1, std::llround(tempo / beat.quarters)));
    }

    /// Writes what changes where a section begins. @return true if the tempo is stated
    bool write_section_change(const SectionChange& change, bool slows_down) {
        const TempoAndMeter& after = change.to;
        const TempoAndMeter before =
            tempo_and_meter_at(tempo_and_meter_of(head_), notation_.changes, change.onset - 1);
        if (after.meter != before.meter) put("{} ", meter_name(after.meter));
        const bool has_tempo = needs_tempo_mark(before, after);
        if (has_tempo) put("{} ", tempo_mark(after.tempo, after.meter, after.tempo_words, slows_down));
        return has_tempo;
    }

    void write_staff(const Staff& staff, const NotatedPart& part, std::string_view opening, bool has_tempo,
                     bool has_dynamics) {
        const Part& told = part.part;
        const bool is_single = staff.voices.size() == 1;
        const std::string_view context = told.is_drums ? "DrumVoice" : "Voice";
        put("    {} <<\n", opening);
        for (std::size_t i = 0; i < staff.voices.size(); ++i) {
            static constexpr std::array<std::string_view, 4> numbers = {"One", "Two", "Three", "Four"};
            put("      \\new {} {{\n", context);
            if (told.is_drums) put("        \\drummode {{\n");
            if (i == 0) {
                const std::optional<KeySignature>& key = part.keys.front().key;
                put("        \\clef {} {}{}{}\n", clef_name(staff.changes.front().clef), key ? key_name(*key) : "",
                    key ? " " : "", meter_name(head_.meter));
                if (const std::int64_t upbeat = notation_.bar_lines.upbeat(); upbeat > 0) {
                    put("        \\partial 1*{}\n", part_of_whole(upbeat));
                }
                if (has_tempo && head_.first_bar > 1 && head_.first_bar < INT32_MAX) {
                    put("        \\set Score.currentBarNumber = #{}\n", head_.first_bar);
                }
                if (part.transposition) put("        \\transposition {}\n", part.transposition->lilypond);
                if (has_tempo) {
                    put("        {}\n", tempo_mark(head_.tempo, head_.meter, words_of_tempo(notation_, head_),
                                                   staff.voices.front().symbols.front().slows_down));
                }
                if (told.swing.is_on() && &staff == &part.staves.front() && !common_swing(notation_)) {
                    put("        <>^\\markup \\bold \"{}\"\n", swing_words(told.swing));
                }
            }
            if (!is_single) put("        \\voice{}\n", numbers[i % 4]);
            cues_ = staff.cues;
            write_voice(staff.voices[i], i == 0 ? staff.changes : std::vector<StaffChange>{},
                        i == 0 ? std::span(part.keys).subspan(1) : std::span<const KeyChange>{},
                        has_dynamics && is_single ? staff.dynamics : std::vector<DynamicMark>{},
                        has_tempo && i == 0 ? std::span(notation_.changes) : std::span<const SectionChange>{});
            cues_ = {};
            put("{}      }}\n", told.is_drums ? "        }\n" : "");
        }
        if (has_dynamics && !is_single && !staff.dynamics.empty()) {
            put("      \\new {} {{\n", context);
            write_dynamics(staff.dynamics);
            put("      }}\n");
        }
        for (const Cue& cue : staff.cues) write_cue(cue);
        put("    >>\n");
        if (is_single) write_syllables(staff.voices.front());
    }

    /// The repeats and endings that end or begin at a bar line. @param has_count  prints how often a passage is
    /// played, if not twice
    std::string turn(std::int64_t onset, bool has_count) const {
        const RepeatSigns signs = signs_at(notation_.repeats, onset);
        std::string text;
        if (signs.closed) text += "} } ";
        if (signs.ended && has_count && signs.ended->times > 2 && !signs.ended->has_endings()) {
            text += fmt::format("\\textEndMark \"{}\" ", count_of_repeats(*signs.ended));
        }
        if (signs.ended) text += signs.ended->has_endings() ? "} { " : "} ";
        if (signs.first_ending) text += "} \\alternative { { ";
        if (signs.begun) text += fmt::format("\\repeat volta {} {{ ", signs.begun->times);
        return text;
    }

    /// A skip of some ticks.
    void skip(std::int64_t from, std::int64_t to) {
        if (to > from) put(" s1*{}/{}", to - from, 4 * ticks_per_quarter);
    }

    /// Writes what is sung under a staff, each syllable as long as its note.
    void write_syllables(const NotatedVoice& voice) {
        const auto is_sung = [](const NotatedSymbol& symbol) { return !symbol.syllable.empty(); };
        if (std::none_of(voice.symbols.begin(), voice.symbols.end(), is_sung)) return;
        put("    \\new Lyrics \\lyricmode {{\n     ");
        std::int64_t here = 0;
        const auto go_to = [&](std::int64_t onset) {
            if (onset > here) put(" \\skip 1*{}/{}", onset - here, 4 * ticks_per_quarter);
            here = std::max(here, onset);
        };
        const auto turn_at = [&](std::int64_t onset) {
            const std::string turns = turn(onset, false);
            if (turns.empty()) return;
            go_to(onset);
            put(" {}", turns.substr(0, turns.size() - 1));
        };
        for (const NotatedSymbol& symbol : voice.symbols) {
            turn_at(symbol.onset);
            if (!is_sung(symbol)) continue;
            go_to(symbol.onset);
            put(" {}1*{}/{}", lilypond_string(symbol.syllable), symbol.length, 4 * ticks_per_quarter);
            here = symbol.onset + symbol.length;
        }
        turn_at(notation_.end());
        put("\n    }}\n");
    }

    /// Writes the names of chords above a staff.
    void write_chords(const std::vector<ChordMark>& chords) {
        if (chords.empty()) return;
        const auto name = [](Pitch pitch) {
            pitch.octave = 3;  // c without a mark
            return pitch_name(pitch);
        };
        // A dash ends a name where a chord without one follows.
        put("    \\new ChordNames \\with {{ noChordSymbol = \"\u2013\" chordNameExceptions = #sikkuChords }} "
            "\\chordmode {{\n     ");
        skip(0, chords.front().onset);
        for (std::size_t i = 0; i < chords.size(); ++i) {
            const ChordMark& chord = chords[i];
            const std::int64_t end = i + 1 < chords.size() ? chords[i + 1].onset : notation_.end();
            const auto length = fmt::format("1*{}/{}", end - chord.onset, 4 * ticks_per_quarter);
            if (chord.quality < 0) {
                put(" r{}", length);
                continue;
            }
            put(" {}{}{}{}", name(chord.root), length,
                chord_qualities()[static_cast<std::size_t>(chord.quality)].lilypond,
                chord.bass ? "/+" + name(*chord.bass) : "");
        }
        put("\n    }}\n");
    }

    /// Writes a cue as a voice of its own, above the rests of the player.
    void write_cue(const Cue& cue) {
        put("      \\new CueVoice {{\n        \\voiceOne s1*{}/{} <>^\\markup \\tiny {}\n", cue.from,
            4 * ticks_per_quarter, lilypond_string(cue.name));
        write_voice(cue.voice, {}, {}, {}, {}, true);
        put("\n      }}\n");
    }

    /// Writes dynamics that stand between the staves of two hands, or below several voices.
    void write_dynamics(const std::vector<DynamicMark>& marks) {
        if (marks.empty()) return;
        std::set<std::int64_t> places;
        for (const DynamicMark& mark : marks) places.insert(mark.onset);
        for (const std::int64_t border : borders_of(notation_.repeats)) places.insert(border);
        put("     ");
        skip(0, *places.begin());
        auto mark = marks.begin();
        for (auto place = places.begin(); place != places.end();) {
            const std::int64_t onset = *place++;
            if (const std::string turns = turn(onset, false); !turns.empty()) {
                put(" {}", turns.substr(0, turns.size() - 1));
            }
            skip(onset, place != places.end() ? *place : notation_.end());
            for (; mark != marks.end() && mark->onset == onset; ++mark) put("{}", mark_text(*mark));
        }
        put("\n");
    }

    static std::string mark_text(const DynamicMark& mark) {
        using enum DynamicMark::Kind;
        if (mark.kind == level) return fmt::format("\\{}", dynamic_name(mark.level));
        return mark.kind == crescendo ? "\\<" : mark.kind == diminuendo ? "\\>" : "\\!";
    }

    /// Writes a clef or a line of 8va that begins with a symbol; the first clef is written already.
    void write_change(const StaffChange& change, Clef& clef, int& octaves) {
        if (change.clef == clef && change.restates_clef) put("\\set Staff.forceClef = ##t ");
        if (change.clef != clef || change.restates_clef) put("\\clef {} ", clef_name(change.clef));
        if (change.octaves != octaves || change.restarts_line) put("\\ottava #{} ", change.octaves);
        clef = change.clef;
        octaves = change.octaves;
    }

    /// @param keys  keys after the first, which is written already
    /// @param sections  changes of tempo and meter; empty for all voices but one
    void write_voice(const NotatedVoice& voice, const std::vector<StaffChange>& changes,
                     std::span<const KeyChange> keys, const std::vector<DynamicMark>& marks,
                     std::span<const SectionChange> sections, bool is_cue = false) {
        const BarLines& bar_lines = notation_.bar_lines;
        auto section = sections.begin();
        auto change = changes.begin();
        auto mark = marks.begin();
        auto key = keys.begin();
        Clef clef = changes.empty() ? Clef::treble : changes.front().clef;
        int octaves = 0;
        int tuplet = -1;
        const bool is_first = &voice == &notation_.parts.front().staves.front().voices.front();
        put("        ");
        for (std::size_t i = 0; i < voice.symbols.size(); ++i) {
            const NotatedSymbol& symbol = voice.symbols[i];
            if (const std::string turns = is_cue ? "" : turn(symbol.onset, is_first); !turns.empty()) {
                put("{}\n        ", turns.substr(0, turns.size() - 1));
            }
            for (; key != keys.end() && key->onset <= symbol.onset; ++key) {
                put("{} ", key->key ? key_name(*key->key) : "\\key c \\major");
            }
            bool has_tempo = false;
            for (; section != sections.end() && section->onset <= symbol.onset; ++section) {
                has_tempo = write_section_change(*section, symbol.slows_down);
            }
            for (; change != changes.end() && change->onset <= symbol.onset; ++change) {
                write_change(*change, clef, octaves);
            }
            if (symbol.tuplet >= 0 && symbol.tuplet != tuplet) {
                const TupletSpan& span = voice.tuplets[static_cast<std::size_t>(symbol.tuplet)];
                put("\\tuplet {}/{} {{ ", span.actual, span.normal);
            }
            tuplet = symbol.tuplet;
            if (symbol.slows_down && symbol.onset > 0 && !has_tempo) put("\\tempo {}", rit);
            // Staves without it would print bar lines, clefs and meters before those that have it.
            if (!symbol.grace && graces_.contains(symbol.onset)) put("\\grace s8 ");
            write_beam_counts(voice.symbols, i);
            const std::int64_t bars = notation_.bars_of(symbol);
            write_symbol(symbol, bars);
            std::string end_marks = symbol.has_fermata ? "\\fermata" : "";
            for (; mark != marks.end() && mark->onset <= symbol.onset; ++mark) end_marks += mark_text(*mark);
            put("{} ", end_marks);
            const std::int64_t end = symbol.onset + symbol.length + (bars - 1) * bar_lines.length(symbol.onset);
            i += static_cast<std::size_t>(bars - 1);
            if (tuplet >= 0 && end == voice.tuplets[static_cast<std::size_t>(tuplet)].to) put("}} ");
            if (bar_lines.place(end) != 0) continue;
            const bool is_last = end == notation_.end();
            const bool ends_with_sign = signs_at(notation_.repeats, end).ended != nullptr;
            if (is_last && octaves != 0) put("\\ottava #0 ");
            const std::vector<std::int64_t>& doubled = notation_.double_bars;
            put("{}| % {}\n",
                is_last && !notation_.is_cut && !ends_with_sign           ? "\\bar \"|.\" "
                : std::binary_search(doubled.begin(), doubled.end(), end) ? "\\bar \"||\" "
                                                                          : "",
                head_.first_bar - 2 + bar_lines.printed_number(end));
            if (!is_last) put("        ");
            if (const std::string turns = is_last && !is_cue ? turn(end, is_first) : ""; !turns.empty()) {
                put("        {}\n", turns.substr(0, turns.size() - 1));
            }
        }
    }

    /// States the number of beams where fewer lead from one note to the next than both have.
    void write_beam_counts(const std::vector<NotatedSymbol>& symbols, std::size_t index) {
        const auto count = [&](std::size_t i, std::initializer_list<Beam> kinds) {
            const auto& beams = symbols[i].beams;
            return std::count_if(beams.begin(), beams.end(), [&](Beam beam) {
                return std::find(kinds.begin(), kinds.end(), beam) != kinds.end();
            });
        };
        const auto total = [&](std::size_t i) {
            return 4 - std::count(symbols[i].beams.begin(), symbols[i].beams.end(), Beam::none);
        };
        const auto is_cut_after = [&](std::size_t i) {
            const auto led = count(i, {Beam::begin, Beam::inside});
            return led > 0 && i + 1 < symbols.size() && led < std::min(total(i), total(i + 1));
        };
        if (!is_cut_after(index) && (index == 0 || !is_cut_after(index - 1))) return;
        put("\\set stemLeftBeamCount = #{} ", count(index, {Beam::inside, Beam::end, Beam::backward_hook}));
        put("\\set stemRightBeamCount = #{} ", count(index, {Beam::begin, Beam::inside, Beam::forward_hook}));
    }

    /// Writes cents above a note, those of a chord from the highest to the lowest.
    void write_cents(const NotatedSymbol& symbol) {
        const std::vector<int> cents = printed_cents(symbol);
        if (cents.empty()) return;
        std::string text;
        for (const int one : cents) text += fmt::format("\"{}\"", cents_text(one));
        put("^\\markup\\teeny{}", cents.size() > 1 ? "\\column{" + text + "}" : text);
    }

    /// Writes `c'`, or a chord `<c' e' g'>`.
    void write_heads(const NotatedSymbol& symbol) {
        const auto name = [](const Pitch& pitch, int drum) {
            return drum > 0 ? std::string(drum_of(drum).lilypond) : pitch_name(pitch);
        };
        const std::string_view parentheses = symbol.is_ghost ? "\\parenthesize " : "";
        std::string text = fmt::format("{}{}", parentheses, name(symbol.pitch, symbol.drum));
        for (const ChordNote& note : symbol.chord) {
            text += fmt::format(" {}{}", parentheses, name(note.pitch, note.drum));
        }
        put("{}", symbol.chord.empty() ? text : "<" + text + ">");
    }

    /// A rest or a gap of some bars. Rests stand below a cue.
    void write_bars(const NotatedSymbol& symbol, std::int64_t bars) {
        const bool is_rest = symbol.kind == SymbolKind::bar_rest;
        const bool is_below = is_rest && std::any_of(cues_.begin(), cues_.end(), [&](const Cue& cue) {
                                  return cue.from <= symbol.onset && symbol.onset < cue.to;
                              });
        const Meter& meter = notation_.bar_lines.meter(symbol.onset);
        const bool is_short = symbol.length < meter.bar();
        put("{}{}1*{}{}{}", is_below ? "\\voiceTwo " : "", is_rest ? "R" : "s",
            is_short ? part_of_whole(symbol.length) : fmt::format("{}/{}", meter.beats, meter.unit),
            bars > 1 ? fmt::format("*{}", bars) : "", is_below ? " \\oneVoice" : "");
    }

    void write_symbol(const NotatedSymbol& symbol, std::int64_t bars) {
        if (notation_.is_whole_rest(symbol)) return write_bars(symbol, bars);
        switch (symbol.kind) {
            case SymbolKind::note:
                if (symbol.grace) put("\\acciaccatura {}8 ", pitch_name(symbol.grace->pitch));
                write_heads(symbol);
                put("{}", length_name(symbol.value));
                if (symbol.tied_forward) put("~");
                if (symbol.begins_slide) put("\\glissando");
                if (symbol.leaves != 0) put("\\bendAfter #{:+}", 4 * symbol.leaves);
                if (symbol.beams[0] == Beam::begin) put("[");
                if (symbol.beams[0] == Beam::end) put("]");
                if (symbol.ends_slur) put(")");
                if (symbol.begins_slur) put("(");
                if (symbol.is_accented) put("->");
                if (symbol.is_staccato) put("-.");
                write_cents(symbol);
                break;
            case SymbolKind::rest:
                put("r{}", length_name(symbol.value));
                break;
            case SymbolKind::bar_rest:
            case SymbolKind::gap:
                put("s{}", length_name(symbol.value));
                break;
        }
    }

    const Notation& notation_;
    const ScoreHead& head_;
    std::span<const Cue> cues_;      ///< of the staff that is written
    std::set<std::int64_t> graces_;  ///< onsets of grace notes in any voice
};

}  // namespace

std::string lilypond_string(std::string_view text) {
    std::string result = "\"";
    for (const char byte : single_line(text)) {
        if (byte == '"' || byte == '\\') result += '\\';
        result += byte;
    }
    return result + '"';
}

void write_lilypond(const Notation& notation, const ScoreHead& head, Output& sink) {
    LilypondWriter(notation, head, sink).write();
}

}  // namespace sikku
