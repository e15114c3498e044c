#include "music/score/musicxml.h"

#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t flush_bytes = std::size_t{1} << 16;
constexpr int voices_per_staff = 4;

std::string_view type_name(int divisor) {
    switch (divisor) {
        case 1:
            return "whole";
        case 2:
            return "half";
        case 4:
            return "quarter";
        case 8:
            return "eighth";
        case 16:
            return "16th";
        case 32:
            return "32nd";
        default:
            return "64th";
    }
}

std::string_view accidental_name(int quarters) {
    static constexpr std::array<std::string_view, 9> names = {
        "flat-flat", "three-quarters-flat",  "flat",        "quarter-flat", "natural", "quarter-sharp",
        "sharp",     "three-quarters-sharp", "double-sharp"};
    return names[static_cast<std::size_t>(std::clamp(quarters, -4, 4) + 4)];
}

class Writer {
public:
    Writer(const Notation& notation, const ScoreHead& head, Output& sink)
        : notation_(notation), head_(head), sink_(sink) {}

    void write() {
        write_head();
        for (std::size_t i = 0; i < notation_.parts.size(); ++i) write_part(i);
        put("</score-partwise>\n");
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

    void write_head() {
        put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<!DOCTYPE score-partwise PUBLIC \"-//Recordare//DTD MusicXML 4.0 Partwise//EN\" "
            "\"http://www.musicxml.org/dtds/partwise.dtd\">\n"
            "<score-partwise version=\"4.0\">\n");
        if (!head_.title.empty()) put("<work><work-title>{}</work-title></work>\n", xml_escaped(head_.title));
        put("<identification>\n");
        if (!head_.composer.empty()) put("<creator type=\"composer\">{}</creator>\n", xml_escaped(head_.composer));
        const std::string software = head_.made.substr(0, head_.made.find(','));
        put("<encoding><software>{}</software>"
            "<supports element=\"accidental\" type=\"yes\"/><supports element=\"beam\" type=\"no\"/></encoding>\n",
            xml_escaped(software.empty() ? "sikku" : software));
        put("<miscellaneous>\n");
        put("<miscellaneous-field name=\"made\">{}</miscellaneous-field>\n", xml_escaped(head_.made));
        put("<miscellaneous-field name=\"pattern\">{}</miscellaneous-field>\n", xml_escaped(head_.pattern));
        put("</miscellaneous>\n</identification>\n<part-list>\n");
        for (std::size_t i = 0; i < head_.parts.size(); ++i) {
            const Part& part = head_.parts[i];
            // Sixteen channels, of which the tenth is for drums.
            const std::size_t channel = i % 15 < 9 ? i % 15 + 1 : i % 15 + 2;
            put("<score-part id=\"P{0}\"><part-name>{1}</part-name>"
                "<score-instrument id=\"P{0}-I1\"><instrument-name>{1}</instrument-name></score-instrument>"
                "<midi-instrument id=\"P{0}-I1\"><midi-channel>{2}</midi-channel>"
                "<midi-program>{3}</midi-program></midi-instrument></score-part>\n",
                i + 1, xml_escaped(part.name), channel, part.program + 1);
        }
        put("</part-list>\n");
    }

    void write_part(std::size_t index) {
        const NotatedPart& part = notation_.parts[index];
        put("<part id=\"P{}\">\n", index + 1);
        std::vector<std::vector<std::size_t>> next;  // of each staff and voice
        for (const Staff& staff : part.staves) next.emplace_back(staff.voices.size(), 0);
        for (std::int64_t bar = 0; bar < notation_.bars; ++bar) {
            put("<measure number=\"{}\">\n", bar + 1);
            if (bar == 0) write_attributes(part, head_.parts[index]);
            if (bar == 0 && index == 0) write_tempo();
            here_ = bar * notation_.bar_length;
            for (std::size_t staff = 0; staff < part.staves.size(); ++staff) {
                for (std::size_t voice = 0; voice < part.staves[staff].voices.size(); ++voice) {
                    staff_ = part.staves.size() > 1 ? staff + 1 : 0;
                    voice_ = static_cast<int>(staff) * voices_per_staff + static_cast<int>(voice) + 1;
                    write_bar(part.staves[staff].voices[voice].symbols, next[staff][voice], bar);
                }
            }
            // A bar ends where its last voice did.
            go_to((bar + 1) * notation_.bar_length);
            put("</measure>\n");
            if (text_.size() > flush_bytes) flush();
        }
        put("</part>\n");
    }

    void write_attributes(const NotatedPart& part, const Part& told) {
        put("<attributes>\n<divisions>{}</divisions>\n", sixty_fourths_per_quarter);
        if (told.key) {
            put("<key><fifths>{}</fifths>{}</key>\n", told.key->fifths, told.key->minor ? "<mode>minor</mode>" : "");
        } else {
            put("<key><fifths>0</fifths></key>\n");
        }
        put("<time><beats>{}</beats><beat-type>{}</beat-type></time>\n", head_.meter.beats, head_.meter.unit);
        if (part.staves.size() > 1) put("<staves>{}</staves>\n", part.staves.size());
        for (std::size_t i = 0; i < part.staves.size(); ++i) {
            const std::string number = part.staves.size() > 1 ? fmt::format(" number=\"{}\"", i + 1) : "";
            const bool treble = part.staves[i].clef == Clef::treble;
            put("<clef{}><sign>{}</sign><line>{}</line></clef>\n", number, treble ? 'G' : 'F', treble ? 2 : 4);
        }
        put("</attributes>\n");
    }

    void write_tempo() {
        const std::string tempo = fmt::format("{}", head_.tempo);
        put("<direction placement=\"above\"><direction-type><metronome><beat-unit>quarter</beat-unit>"
            "<per-minute>{0}</per-minute></metronome></direction-type><sound tempo=\"{0}\"/></direction>\n",
            tempo);
    }

    void go_to(std::int64_t time) {
        if (time < here_) put("<backup><duration>{}</duration></backup>\n", here_ - time);
        if (time > here_) put("<forward><duration>{}</duration></forward>\n", time - here_);
        here_ = time;
    }

    void write_bar(const std::vector<NotatedSymbol>& symbols, std::size_t& next, std::int64_t bar) {
        const std::int64_t end = (bar + 1) * notation_.bar_length;
        for (; next < symbols.size() && symbols[next].onset < end; ++next) {
            const NotatedSymbol& symbol = symbols[next];
            if (symbol.kind == SymbolKind::gap && symbol.length == notation_.bar_length) continue;
            go_to(symbol.onset);
            write_symbol(symbol);
            here_ += symbol.length;
        }
    }

    void write_symbol(const NotatedSymbol& symbol) {
        const bool is_note = symbol.kind == SymbolKind::note;
        put("<note{}>", symbol.kind == SymbolKind::gap ? " print-object=\"no\"" : "");
        if (is_note) {
            write_pitch(symbol);
        } else {
            put("{}", symbol.kind == SymbolKind::bar_rest ? "<rest measure=\"yes\"/>" : "<rest/>");
        }
        put("<duration>{}</duration>", symbol.length);
        if (is_note && symbol.tied_back) put("<tie type=\"stop\"/>");
        if (is_note && symbol.tied_forward) put("<tie type=\"start\"/>");
        put("<voice>{}</voice>", voice_);
        if (symbol.kind != SymbolKind::bar_rest) {
            const NoteValue value = note_value(symbol.length);
            put("<type>{}</type>{}", type_name(value.divisor), value.dotted ? "<dot/>" : "");
        }
        if (is_note && symbol.has_sign) put("<accidental>{}</accidental>", accidental_name(symbol.pitch.quarters));
        if (staff_ > 0) put("<staff>{}</staff>", staff_);
        if (is_note && (symbol.tied_back || symbol.tied_forward)) {
            put("<notations>{}{}</notations>", symbol.tied_back ? "<tied type=\"stop\"/>" : "",
                symbol.tied_forward ? "<tied type=\"start\"/>" : "");
        }
        put("</note>\n");
    }

    void write_pitch(const NotatedSymbol& symbol) {
        const Pitch& pitch = symbol.pitch;
        if (pitch.octave < 0) {
            throw ScoreError(fmt::format("bar {} has a note below C0, the lowest that MusicXML can tell",
                                         symbol.onset / notation_.bar_length + 1));
        }
        put("<pitch><step>{}</step>", "CDEFGAB"[pitch.letter]);
        if (pitch.quarters != 0) put("<alter>{}</alter>", 0.5 * pitch.quarters);
        put("<octave>{}</octave></pitch>", pitch.octave);
    }

    const Notation& notation_;
    const ScoreHead& head_;
    Output& sink_;
    fmt::memory_buffer text_;
    std::int64_t here_ = 0;  ///< where the reader is, in 64ths
    std::size_t staff_ = 0;  ///< from 1; 0 if there is but one
    int voice_ = 1;
};

}  // namespace

void write_musicxml(const Notation& notation, const ScoreHead& head, Output& sink) {
    Writer(notation, head, sink).write();
}

}  // namespace sikku
