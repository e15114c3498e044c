#include "music/score/lilypond.h"

#include "music/score/comments.h"
#include "music/score/drums.h"
#include "music/score/dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t flush_bytes = std::size_t{1} << 16;

/// LilyPond's own names of the General MIDI programs; others it does not know.
constexpr std::array<std::string_view, 128> instruments = {
    "acoustic grand",
    "bright acoustic",
    "electric grand",
    "honky-tonk",
    "electric piano 1",
    "electric piano 2",
    "harpsichord",
    "clav",
    "celesta",
    "glockenspiel",
    "music box",
    "vibraphone",
    "marimba",
    "xylophone",
    "tubular bells",
    "dulcimer",
    "drawbar organ",
    "percussive organ",
    "rock organ",
    "church organ",
    "reed organ",
    "accordion",
    "harmonica",
    "concertina",
    "acoustic guitar (nylon)",
    "acoustic guitar (steel)",
    "electric guitar (jazz)",
    "electric guitar (clean)",
    "electric guitar (muted)",
    "overdriven guitar",
    "distorted guitar",
    "guitar harmonics",
    "acoustic bass",
    "electric bass (finger)",
    "electric bass (pick)",
    "fretless bass",
    "slap bass 1",
    "slap bass 2",
    "synth bass 1",
    "synth bass 2",
    "violin",
    "viola",
    "cello",
    "contrabass",
    "tremolo strings",
    "pizzicato strings",
    "orchestral harp",
    "timpani",
    "string ensemble 1",
    "string ensemble 2",
    "synthstrings 1",
    "synthstrings 2",
    "choir aahs",
    "voice oohs",
    "synth voice",
    "orchestra hit",
    "trumpet",
    "trombone",
    "tuba",
    "muted trumpet",
    "french horn",
    "brass section",
    "synthbrass 1",
    "synthbrass 2",
    "soprano sax",
    "alto sax",
    "tenor sax",
    "baritone sax",
    "oboe",
    "english horn",
    "bassoon",
    "clarinet",
    "piccolo",
    "flute",
    "recorder",
    "pan flute",
    "blown bottle",
    "shakuhachi",
    "whistle",
    "ocarina",
    "lead 1 (square)",
    "lead 2 (sawtooth)",
    "lead 3 (calliope)",
    "lead 4 (chiff)",
    "lead 5 (charang)",
    "lead 6 (voice)",
    "lead 7 (fifths)",
    "lead 8 (bass+lead)",
    "pad 1 (new age)",
    "pad 2 (warm)",
    "pad 3 (polysynth)",
    "pad 4 (choir)",
    "pad 5 (bowed)",
    "pad 6 (metallic)",
    "pad 7 (halo)",
    "pad 8 (sweep)",
    "fx 1 (rain)",
    "fx 2 (soundtrack)",
    "fx 3 (crystal)",
    "fx 4 (atmosphere)",
    "fx 5 (brightness)",
    "fx 6 (goblins)",
    "fx 7 (echoes)",
    "fx 8 (sci-fi)",
    "sitar",
    "banjo",
    "shamisen",
    "koto",
    "kalimba",
    "bagpipe",
    "fiddle",
    "shanai",
    "tinkle bell",
    "agogo",
    "steel drums",
    "woodblock",
    "taiko drum",
    "melodic tom",
    "synth drum",
    "reverse cymbal",
    "guitar fret noise",
    "breath noise",
    "seashore",
    "bird tweet",
    "telephone ring",
    "helicopter",
    "applause",
    "gunshot",
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

namespace {

/// c d e … b, the sign (quarter tones have theirs), the octave: c' is middle C.
std::string pitch_name(const Pitch& pitch) {
    static constexpr std::array<std::string_view, 9> signs = {"eses", "eseh", "es",   "eh",  "",
                                                              "ih",   "is",   "isih", "isis"};
    std::string name(1, "cdefgab"[pitch.letter]);
    name += signs[static_cast<std::size_t>(std::clamp(pitch.quarters, -4, 4) + 4)];
    // c without a mark is C3.
    const int marks = pitch.octave - 3;
    return name.append(static_cast<std::size_t>(std::abs(marks)), marks > 0 ? '\'' : ',');
}

std::string length_name(NoteValue value) {
    return fmt::format("{}{}", value.divisor, value.dotted ? "." : "");
}

std::string_view clef_name(Clef clef) {
    static constexpr std::array<std::string_view, 7> names = {"treble",       "bass",       "alto",      "tenor",
                                                              "\"treble_8\"", "\"bass_8\"", "percussion"};
    return names[static_cast<std::size_t>(clef)];
}

/// The meter, with its groups where the file says them or LilyPond does not know them.
std::string meter_name(const Meter& meter) {
    const std::string fraction = fmt::format("{}/{}", meter.beats, meter.unit);
    if (!has_groups(meter)) return "\\time " + fraction;
    std::vector<std::int64_t> groups = groups_of(meter);
    for (std::int64_t& group : groups) group = group * meter.unit / (4 * ticks_per_quarter);
    if (meter.groups[0] == 0) return fmt::format("\\time {} {}", fmt::join(groups, ","), fraction);
    return fmt::format("\\compoundMeter #'(({} {}))", fmt::join(groups, " "), meter.unit);
}

std::string key_name(const KeySignature& key) {
    static constexpr std::array<std::string_view, 7> modes = {"lydian", "major",    "mixolydian", "dorian",
                                                              "minor",  "phrygian", "locrian"};
    // Along the fifths, from the tonic of seven flats in lydian on.
    constexpr std::string_view letters = "fcgdaeb";
    const int from_f = std::clamp(key.fifths, -7, 7) + static_cast<int>(key.mode);
    const int letter = (from_f + 7) % 7;
    const int sharps = (from_f - letter) / 7;
    return fmt::format("\\key {}{} \\{}", letters[static_cast<std::size_t>(letter)],
                       sharps < 0   ? "es"
                       : sharps > 0 ? "is"
                                    : "",
                       modes[static_cast<std::size_t>(key.mode)]);
}

class Writer {
public:
    Writer(const Notation& notation, const ScoreHead& head, Output& sink)
        : notation_(notation), head_(head), sink_(sink) {}

    void write() {
        put("\\version \"2.24.0\"\n\n");
        put("{}", head_comments(head_, "%"));
        put("\n\\header {{\n");
        if (!head_.title.empty()) put("  title = {}\n", lilypond_string(head_.title));
        if (!head_.composer.empty()) put("  composer = {}\n", lilypond_string(head_.composer));
        // The name of a single part stands above it, as in printed music; those of several stand before their staves.
        const bool is_solo = notation_.parts.size() == 1;
        if (is_solo) put("  instrument = {}\n", lilypond_string(notation_.parts.front().part.name));
        if (!head_.source.empty()) put("  copyright = {}\n", lilypond_string(head_.source));
        put("  tagline = ##f\n}}\n\n");
        write_drum_table();
        // LilyPond takes systems for a little lower than they are, and then has to squeeze a page.
        put("\\paper {{\n  page-breaking-system-system-spacing.padding = #6\n}}\n\n\\score {{\n  <<\n");
        for (std::size_t i = 0; i < notation_.parts.size(); ++i) write_part(i);
        put("  >>\n  \\layout {{\n    indent = {}\\mm\n    \\context {{ \\Score \\autoBeamOff }}\n  }}\n  \\midi {{ "
            "}}\n}}\n",
            is_solo ? 0 : indent());
        flush();
    }

private:
    /// How the drums that are used are written, as LilyPond's own tables lack some.
    void write_drum_table() {
        std::set<int> used;
        for (const NotatedPart& part : notation_.parts) {
            for (const Staff& staff : part.staves) {
                for (const NotatedVoice& voice : staff.voices) {
                    for (const NotatedSymbol& symbol : voice.symbols) {
                        if (symbol.drum > 0) used.insert(symbol.drum);
                        for (const ChordNote& note : symbol.chord) {
                            if (note.drum > 0) used.insert(note.drum);
                        }
                    }
                }
            }
        }
        const bool has_drums = std::any_of(notation_.parts.begin(), notation_.parts.end(),
                                           [](const NotatedPart& one) { return one.part.is_drums; });
        if (!has_drums) return;
        put("#(define sikkuDrums (alist->hash-table '(\n");
        for (const int key : used) {
            static constexpr std::array<std::string_view, 4> heads = {"default", "cross", "diamond", "triangle"};
            const Drum& drum = drum_of(key);
            // Counted from the middle line.
            const int place = Pitch{drum.letter, drum.octave, 0}.height() - Pitch{6, 4, 0}.height();
            put("  ({} {} #f {})  ; {}\n", drum.lilypond, heads[static_cast<std::size_t>(drum.head)], place,
                drum.name);
        }
        put(")))\n\n");
    }

    template <typename... Arguments>
    void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    }

    void flush() {
        sink_.write({text_.data(), text_.size()});
        text_.clear();
    }

    /// Lines of at most 16 characters, where the words are not longer.
    static std::vector<std::string> lines_of(std::string_view name) {
        constexpr std::size_t most = 16;
        std::vector<std::string> lines;
        while (!name.empty()) {
            const std::size_t end = std::min(name.find(' '), name.size());
            const std::string_view word = name.substr(0, end);
            name.remove_prefix(std::min(end + 1, name.size()));
            if (word.empty()) continue;
            if (lines.empty() || lines.back().size() + 1 + word.size() > most) {
                lines.emplace_back(word);
            } else {
                lines.back().append(" ").append(word);
            }
        }
        return lines;
    }

    /// Millimetres that the longest line of a name takes in LilyPond's font, with a gap before the bracket.
    std::size_t indent() const {
        std::size_t longest = 0;
        for (const NotatedPart& one : notation_.parts) {
            for (const std::string& line : lines_of(one.part.name)) longest = std::max(longest, line.size());
        }
        return std::min<std::size_t>(10 + 2 * longest, 80);
    }

    static std::string name_of(std::string_view name) {
        const std::vector<std::string> lines = lines_of(name);
        if (lines.size() < 2) return lilypond_string(name);
        std::string text = "\\markup \\right-column {";
        for (const std::string& line : lines) text += " " + lilypond_string(line);
        return text + " }";
    }

    void write_part(std::size_t index) {
        const NotatedPart& part = notation_.parts[index];
        const Part& told = part.part;
        const bool is_named = notation_.parts.size() > 1;
        const std::string name = is_named ? fmt::format("instrumentName = {} ", name_of(told.name)) : "";
        const std::string with =
            told.is_drums
                ? fmt::format("\\with {{ {}drumStyleTable = #sikkuDrums }}", name)
                : fmt::format(
                      "\\with {{ {}midiInstrument = {} }}", name,
                      lilypond_string(instruments[static_cast<std::size_t>(std::clamp(told.program, 0, 127))]));
        const std::string_view staff = told.is_drums ? "DrumStaff" : "Staff";
        if (part.staves.size() == 1) {
            write_staff(part.staves.front(), part, fmt::format("\\new {} {}", staff, with), index == 0);
            return;
        }
        // MIDI programs belong to staves, the name to the group.
        const bool is_piano = part.bracket == Bracket::brace;
        put("    \\new {} {} <<\n", is_piano ? "PianoStaff" : "StaffGroup",
            told.is_drums ? fmt::format("\\with {{ {}}}", name) : with);
        for (std::size_t i = 0; i < part.staves.size(); ++i) {
            const std::string opening =
                told.is_drums ? "\\new DrumStaff \\with { drumStyleTable = #sikkuDrums }" : "\\new Staff";
            write_staff(part.staves[i], part, opening, index == 0 && i == 0, !is_piano);
            if (is_piano && i == 0) write_dynamics(part.staves[i].dynamics);
            if (!is_piano && part.staves[i].voices.size() > 1) write_dynamics(part.staves[i].dynamics);
        }
        put("    >>\n");
    }

    void write_staff(const Staff& staff, const NotatedPart& part, std::string_view opening, bool has_tempo,
                     bool has_dynamics = true) {
        const Part& told = part.part;
        put("    {} <<\n", opening);
        for (std::size_t i = 0; i < staff.voices.size(); ++i) {
            static constexpr std::array<std::string_view, 4> numbers = {"One", "Two", "Three", "Four"};
            put("      \\new {} {{\n", told.is_drums ? "DrumVoice" : "Voice");
            if (told.is_drums) put("        \\drummode {{\n");
            if (i == 0) {
                const std::optional<KeySignature>& key = part.keys.front().key;
                put("        \\clef {} {}{}{}\n", clef_name(staff.changes.front().clef), key ? key_name(*key) : "",
                    key ? " " : "", meter_name(head_.meter));
                if (has_tempo) {
                    // A whole number: LilyPond takes no other, and its MIDI files cut fractions off.
                    put("        \\tempo 4 = {}\n", std::max<long long>(1, std::llround(head_.tempo)));
                }
            }
            if (staff.voices.size() > 1) put("        \\voice{}\n", numbers[i % 4]);
            write_voice(staff.voices[i], i == 0 ? staff.changes : std::vector<StaffChange>{},
                        i == 0 ? std::span(part.keys).subspan(1) : std::span<const KeyChange>{},
                        has_dynamics && staff.voices.size() == 1 ? staff.dynamics : std::vector<DynamicMark>{});
            put("{}      }}\n", told.is_drums ? "        }\n" : "");
        }
        put("    >>\n");
    }

    /// Writes the dynamics of two hands between their staves, and those of several voices below them.
    void write_dynamics(const std::vector<DynamicMark>& marks) {
        if (marks.empty()) return;
        put("    \\new Dynamics {{\n     ");
        const auto skip = [&](std::int64_t from, std::int64_t to) {
            if (to > from) put(" s1*{}/{}", to - from, 4 * ticks_per_quarter);
        };
        skip(0, marks.front().onset);
        for (std::size_t i = 0; i < marks.size();) {
            const std::int64_t onset = marks[i].onset;
            std::string together;
            for (; i < marks.size() && marks[i].onset == onset; ++i) together += mark_text(marks[i]);
            skip(onset, i < marks.size() ? marks[i].onset : notation_.bars * notation_.bar_length);
            put("{}", together);
        }
        put("\n    }}\n");
    }

    static std::string mark_text(const DynamicMark& mark) {
        switch (mark.kind) {
            case DynamicMark::Kind::crescendo:
                return "\\<";
            case DynamicMark::Kind::diminuendo:
                return "\\>";
            case DynamicMark::Kind::level:
                break;
        }
        return fmt::format("\\{}", dynamic_name(mark.level));
    }

    /// Clefs and lines of 8va that begin with a symbol; the first clef is written already.
    void write_change(const StaffChange& change, Clef& clef, int& octaves) {
        if (change.clef != clef) put("\\clef {} ", clef_name(change.clef));
        if (change.octaves != octaves) put("\\ottava #{} ", change.octaves);
        clef = change.clef;
        octaves = change.octaves;
    }

    /// @param keys  after the first, which is written already
    void write_voice(const NotatedVoice& voice, const std::vector<StaffChange>& changes,
                     std::span<const KeyChange> keys, const std::vector<DynamicMark>& marks) {
        const std::int64_t bar = notation_.bar_length;
        auto change = changes.begin();
        auto mark = marks.begin();
        auto key = keys.begin();
        Clef clef = changes.empty() ? Clef::treble : changes.front().clef;
        int octaves = 0;
        int tuplet = -1;
        put("        ");
        for (const NotatedSymbol& symbol : voice.symbols) {
            for (; key != keys.end() && key->onset <= symbol.onset; ++key) {
                put("{} ", key->key ? key_name(*key->key) : "\\key c \\major");
            }
            for (; change != changes.end() && change->onset <= symbol.onset; ++change) {
                write_change(*change, clef, octaves);
            }
            if (symbol.tuplet >= 0 && symbol.tuplet != tuplet) {
                const TupletSpan& span = voice.tuplets[static_cast<std::size_t>(symbol.tuplet)];
                put("\\tuplet {}/{} {{ ", span.actual, span.normal);
            }
            tuplet = symbol.tuplet;
            write_symbol(symbol);
            std::string end_marks;
            for (; mark != marks.end() && mark->onset <= symbol.onset; ++mark) end_marks += mark_text(*mark);
            put("{} ", end_marks);
            const std::int64_t end = symbol.onset + symbol.length;
            if (tuplet >= 0 && end == voice.tuplets[static_cast<std::size_t>(tuplet)].to) put("}} ");
            if (end % bar != 0) continue;
            const bool is_last = end / bar == notation_.bars;
            if (is_last && octaves != 0) put("\\ottava #0 ");
            const std::vector<std::int64_t>& doubled = notation_.double_bars;
            put("{}| % {}\n",
                is_last                                                   ? "\\bar \"|.\" "
                : std::binary_search(doubled.begin(), doubled.end(), end) ? "\\bar \"||\" "
                                                                          : "",
                end / bar);
            if (!is_last) put("        ");
            if (text_.size() > flush_bytes) flush();
        }
    }

    /// `c'`, or a chord `<c' e' g'>`.
    void write_heads(const NotatedSymbol& symbol) {
        const auto name = [](const Pitch& pitch, int drum) {
            return drum > 0 ? std::string(drum_of(drum).lilypond) : pitch_name(pitch);
        };
        std::string text = name(symbol.pitch, symbol.drum);
        for (const ChordNote& note : symbol.chord) text += " " + name(note.pitch, note.drum);
        put("{}", symbol.chord.empty() ? text : "<" + text + ">");
    }

    void write_symbol(const NotatedSymbol& symbol) {
        switch (symbol.kind) {
            case SymbolKind::note:
                write_heads(symbol);
                put("{}", length_name(symbol.value));
                if (symbol.tied_forward) put("~");
                if (symbol.begins_slide) put("\\glissando");
                if (symbol.leaves != 0) put("\\bendAfter #{:+}", 4 * symbol.leaves);
                if (symbol.beams[0] == Beam::begin) put("[");
                if (symbol.beams[0] == Beam::end) put("]");
                if (symbol.is_accented) put("->");
                if (symbol.cents != 0) put("^\\markup\\teeny\"{:+}\"", symbol.cents);
                break;
            case SymbolKind::rest:
                put("r{}", length_name(symbol.value));
                break;
            case SymbolKind::bar_rest:
                put("R1*{}/{}", head_.meter.beats, head_.meter.unit);
                break;
            case SymbolKind::gap:
                if (symbol.length == notation_.bar_length) {
                    put("s1*{}/{}", head_.meter.beats, head_.meter.unit);
                } else {
                    put("s{}", length_name(symbol.value));
                }
                break;
        }
    }

    const Notation& notation_;
    const ScoreHead& head_;
    Output& sink_;
    fmt::memory_buffer text_;
};

}  // namespace

void write_lilypond(const Notation& notation, const ScoreHead& head, Output& sink) {
    Writer(notation, head, sink).write();
}

}  // namespace sikku
