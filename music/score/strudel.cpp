#include "music/score/score_formats.h"

#include "engine/base/base64.h"
#include "music/score/comments.h"
#include "music/score/drums.h"
#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>

namespace sikku {
namespace {

/// A number with at most four decimals.
std::string number(double value) {
    return sikku::number(value, 4);
}

/// Name of a key: `c4`, `f#3`, or the number of one between two semitones.
std::string name_of(double key) {
    static constexpr std::array<std::string_view, 12> names = {"c",  "c#", "d",  "d#", "e",  "f",
                                                               "f#", "g",  "g#", "a",  "a#", "b"};
    const auto whole = static_cast<int>(std::lround(key));
    if (std::fabs(key - whole) > 0.005 || whole < 12) return number(key);
    return fmt::format("{}{}", names[static_cast<std::size_t>(whole % 12)], whole / 12 - 1);
}

/// One voice in mini-notation, from 0 to `end`.
std::string sequence(const std::vector<Note>& notes, std::int64_t end, bool is_drums) {
    std::int64_t unit = end;
    for (const Note& note : notes) unit = std::gcd(unit, std::gcd(note.onset, note.duration));
    std::string text;
    const auto add = [&](std::string_view what, std::int64_t ticks) {
        if (ticks <= 0) return;
        // Breaks lines, for readability.
        constexpr std::size_t line_bytes = 100;
        const std::size_t line = text.rfind('\n');
        const bool is_long = text.size() - (line == std::string::npos ? 0 : line) > line_bytes;
        if (!text.empty()) text += is_long ? "\n  " : " ";
        text += what;
        if (ticks != unit) text += fmt::format("@{}", ticks / unit);
    };
    std::int64_t here = 0;
    for (const Note& note : notes) {
        add("~", note.onset - here);
        add(is_drums ? std::string(drum_of(static_cast<int>(std::lround(note.key))).strudel) : name_of(note.key),
            note.duration);
        here = note.onset + note.duration;
    }
    add("~", end - here);
    return text;
}

/// Converts a tick to the one that sounds at the same time in the first tempo, because mini-notation has a single
/// tempo.
std::int64_t at_first_tempo(std::int64_t tick, const ScoreHead& head) {
    double ticks = 0;
    std::int64_t here = 0;
    double tempo = head.tempo;
    for (const SectionChange& change : head.changes) {
        if (change.onset >= tick) break;
        ticks += static_cast<double>(change.onset - here) * head.tempo / tempo;
        here = change.onset;
        tempo = change.to.tempo;
    }
    return std::llround(ticks + static_cast<double>(tick - here) * head.tempo / tempo);
}

std::string program_of(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end) {
    const std::int64_t bar = head.meter.bar();
    const std::int64_t bars = std::max<std::int64_t>(1, (end + bar - 1) / bar);
    std::string text = fmt::format("// {}\nsetcpm({} / {})\n", single_line(head.title), number(head.tempo),
                                   number(static_cast<double>(bar) / static_cast<double>(ticks_per_quarter)));
    std::size_t first = 0;
    for (const Part& part : head.parts) {
        for (std::size_t voice = first; voice < first + static_cast<std::size_t>(part.voices); ++voice) {
            std::vector<Note> line;
            std::copy_if(notes.begin(), notes.end(), std::back_inserter(line),
                         [&](const Note& note) { return static_cast<std::size_t>(note.voice) == voice; });
            if (line.empty()) continue;
            if (part.is_drums) {
                fmt::format_to(std::back_inserter(text), "$: sound(`{}`)\n  .slow({})\n",
                               sequence(line, bars * bar, true), bars);
                continue;
            }
            fmt::format_to(std::back_inserter(text), "$: note(`{}`)\n  .slow({}).sound(\"{}\")\n",
                           sequence(line, bars * bar, false), bars, part.program < 8 ? "piano" : "triangle");
        }
        first += static_cast<std::size_t>(part.voices);
    }
    return text;
}

}  // namespace

std::string strudel_link(const std::string& program) {
    std::string link = "https://strudel.cc/#";
    for (const char letter : to_base64(program, Base64::padded)) {
        const bool is_plain = std::string_view("+/=").find(letter) == std::string_view::npos;
        link += is_plain ? std::string(1, letter) : fmt::format("%{:02X}", static_cast<int>(letter));
    }
    return link;
}

void write_strudel(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out) {
    // The first cycle begins with rests before an upbeat.
    const std::int64_t lead = head.upbeat > 0 ? head.meter.bar() - head.upbeat : 0;
    std::vector<Note> timed = notes;
    for (Note& note : timed) {
        const std::int64_t note_end = at_first_tempo(note.onset + note.duration, head);
        note.onset = at_first_tempo(note.onset, head);
        note.duration = std::max<std::int64_t>(1, note_end - note.onset);
        note.onset += lead;
    }
    const std::string program = program_of(head, timed, at_first_tempo(end, head) + lead);
    out.write(fmt::format("// {}\n\n{}\n{}", strudel_link(program), head_comments(head, "//"), program));
}

}  // namespace sikku
