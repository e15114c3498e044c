#include "music/score/lilypond.h"

#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
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

/// Converts text to a single line for LilyPond. Line and paragraph separators (U+2028, U+2029), which make it abort,
/// and direction marks, which may make it hang, become blanks.
std::string one_line(std::string_view text) {
    constexpr std::array<std::string_view, 6> marks = {"\n", "\u2028", "\u2029", "\u200E", "\u200F", "\u061C"};
    const std::string whole = printable(text, std::string::npos);
    std::string result;
    for (std::string_view rest = whole; !rest.empty();) {
        const std::size_t plain = std::min(rest.find_first_of("\n\xD8\xE2"), rest.size());  // where no mark begins
        result += rest.substr(0, plain);
        rest.remove_prefix(plain);
        if (rest.empty()) break;
        const auto mark = std::find_if(marks.begin(), marks.end(),
                                       [rest](std::string_view candidate) { return rest.starts_with(candidate); });
        result += mark == marks.end() ? rest.front() : ' ';
        rest.remove_prefix(mark == marks.end() ? 1 : mark->size());
    }
    return result;
}

}  // namespace

std::string lilypond_string(std::string_view text) {
    std::string result = "\"";
    for (const char byte : one_line(text)) {
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

std::string length_name(std::int64_t length) {
    const NoteValue value = note_value(length);
    return fmt::format("{}{}", value.divisor, value.dotted ? "." : "");
}

/// How the beats of 5/8, 7/8, … are beamed, which LilyPond does not know by itself: twos and a three.
std::string beams(const Meter& meter) {
    if (meter.unit < 8 || meter.beats < 5 || meter.beats % 2 == 0 || meter.beats % 3 == 0) return {};
    std::string groups;
    for (int left = meter.beats; left > 3; left -= 2) groups += "2,";
    return groups + "3 ";
}

std::string key_name(const KeySignature& key) {
    // From seven flats to seven sharps; minor keys lie three fifths further on.
    static constexpr std::array<std::string_view, 18> tonics = {"ces", "ges", "des", "aes", "ees", "bes",
                                                                "f",   "c",   "g",   "d",   "a",   "e",
                                                                "b",   "fis", "cis", "gis", "dis", "ais"};
    const int at = std::clamp(key.fifths, -7, 7) + 7 + (key.minor ? 3 : 0);
    return fmt::format("\\key {} {}", tonics[static_cast<std::size_t>(at)], key.minor ? "\\minor" : "\\major");
}

class Writer {
public:
    Writer(const Notation& notation, const ScoreHead& head, Output& sink)
        : notation_(notation), head_(head), sink_(sink) {}

    void write() {
        put("\\version \"2.24.0\"\n\n");
        comment(head_.made);
        comment(head_.pattern);
        put("\n\\header {{\n");
        if (!head_.title.empty()) put("  title = {}\n", lilypond_string(head_.title));
        if (!head_.composer.empty()) put("  composer = {}\n", lilypond_string(head_.composer));
        // The name of a single part stands above it, as in printed music; those of several stand before their staves.
        const bool is_solo = head_.parts.size() == 1;
        if (is_solo) put("  instrument = {}\n", lilypond_string(head_.parts.front().name));
        put("  tagline = ##f\n}}\n\n");
        // LilyPond takes systems for a little lower than they are, and then has to squeeze a page.
        put("\\paper {{\n  page-breaking-system-system-spacing.padding = #6\n}}\n\n\\score {{\n  <<\n");
        for (std::size_t i = 0; i < notation_.parts.size(); ++i) write_part(i);
        put("  >>\n  \\layout {{ indent = {}\\mm }}\n  \\midi {{ }}\n}}\n", is_solo ? 0 : indent());
        flush();
    }

private:
    template <typename... Arguments>
    void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
    }

    void flush() {
        sink_.write({text_.data(), text_.size()});
        text_.clear();
    }

    void comment(std::string_view text) {
        while (!text.empty()) {
            const std::size_t end = std::min(text.find('\n'), text.size());
            std::string line(text.substr(0, end));
            if (line.ends_with('\r')) line.pop_back();
            std::replace(line.begin(), line.end(), '\t', ' ');
            put("%{}{}\n", line.empty() ? "" : " ", one_line(line));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }

    /// Millimetres that the longest name takes in LilyPond's font, with a gap before the staff.
    std::size_t indent() const {
        std::size_t longest = 0;
        for (const Part& part : head_.parts) longest = std::max(longest, part.name.size());
        return std::min<std::size_t>(6 + 2 * longest, 60);
    }

    void write_part(std::size_t index) {
        const NotatedPart& part = notation_.parts[index];
        const Part& told = head_.parts[index];
        const bool is_named = head_.parts.size() > 1;
        const std::string with =
            fmt::format("\\with {{ {}midiInstrument = {} }}",
                        is_named ? fmt::format("instrumentName = {} ", lilypond_string(told.name)) : "",
                        lilypond_string(instruments[static_cast<std::size_t>(std::clamp(told.program, 0, 127))]));
        if (part.staves.size() == 1) {
            write_staff(part.staves.front(), told, fmt::format("\\new Staff {}", with), index == 0);
            return;
        }
        // MIDI programs belong to staves, the name to the group.
        put("    \\new {} {} <<\n", part.staves.size() == 2 ? "PianoStaff" : "StaffGroup", with);
        for (std::size_t i = 0; i < part.staves.size(); ++i) {
            write_staff(part.staves[i], told, "\\new Staff", index == 0 && i == 0);
        }
        put("    >>\n");
    }

    void write_staff(const Staff& staff, const Part& told, std::string_view opening, bool has_tempo) {
        put("    {} <<\n", opening);
        for (std::size_t i = 0; i < staff.voices.size(); ++i) {
            static constexpr std::array<std::string_view, 4> numbers = {"One", "Two", "Three", "Four"};
            put("      \\new Voice {{\n");
            if (i == 0) {
                put("        \\clef {} {}{}\\time {}{}/{}\n", staff.clef == Clef::treble ? "treble" : "bass",
                    told.key ? key_name(*told.key) : "", told.key ? " " : "", beams(head_.meter), head_.meter.beats,
                    head_.meter.unit);
                if (has_tempo) {
                    // A whole number: LilyPond takes no other, and its MIDI files cut fractions off.
                    put("        \\tempo 4 = {}\n", std::max<long long>(1, std::llround(head_.tempo)));
                }
            }
            if (staff.voices.size() > 1) put("        \\voice{}\n", numbers[i % 4]);
            write_voice(staff.voices[i]);
            put("      }}\n");
        }
        put("    >>\n");
    }

    void write_voice(const NotatedVoice& voice) {
        const std::int64_t bar = notation_.bar_length;
        put("        ");
        for (const NotatedSymbol& symbol : voice.symbols) {
            switch (symbol.kind) {
                case SymbolKind::note:
                    put("{}{}{} ", pitch_name(symbol.pitch), length_name(symbol.length),
                        symbol.tied_forward ? "~" : "");
                    break;
                case SymbolKind::rest:
                    put("r{} ", length_name(symbol.length));
                    break;
                case SymbolKind::bar_rest:
                    put("R1*{}/{} ", head_.meter.beats, head_.meter.unit);
                    break;
                case SymbolKind::gap:
                    if (symbol.length == bar) {
                        put("s1*{}/{} ", head_.meter.beats, head_.meter.unit);
                    } else {
                        put("s{} ", length_name(symbol.length));
                    }
                    break;
            }
            const std::int64_t end = symbol.onset + symbol.length;
            if (end % bar != 0) continue;
            put("| % {}\n", end / bar);
            if (end / bar < notation_.bars) put("        ");
            if (text_.size() > flush_bytes) flush();
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
