#include "music/score/score_formats.h"

#include "music/score/comments.h"
#include "music/score/glides.h"
#include "music/score/note_order.h"
#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

/// A number with at most six decimals.
std::string number(double value) {
    return sikku::number(value, 6);
}

double quarters(std::int64_t ticks) {
    return static_cast<double>(ticks) / static_cast<double>(ticks_per_quarter);
}

bool has_pan(const Curves& curves) {
    return std::any_of(curves.controls.begin(), curves.controls.end(),
                       [](const ControlPoint& point) { return point.number == ControlPoint::pan; });
}

/// The tempo as a `t` statement: at a sudden change it has two values for one beat.
std::string tempo_statement(const ScoreHead& head, const Curves& curves, std::int64_t end) {
    std::string text = fmt::format("t 0 {}", number(head.tempo));
    double last = head.tempo;
    for (const TempoPoint& point : tempo_map(head, curves, end)) {
        const double tempo = head.tempo * point.factor;
        if (point.tick > 0) text += fmt::format(" {} {}", number(quarters(point.tick)), number(last));
        if (point.tick == 0) text = fmt::format("t 0 {}", number(tempo));
        if (point.tick > 0) text += fmt::format(" {} {}", number(quarters(point.tick)), number(tempo));
        last = tempo;
    }
    return text + "\n";
}

/// The pan of a note, 0 to 1.
double pan_of(const Note& note, const Curves& curves) {
    double pan = 64;
    for (const ControlPoint& point : curves.of_voice(note.voice)) {
        if (point.tick > note.onset) break;
        if (point.number == ControlPoint::pan) pan = point.value;
    }
    return pan / 127;
}

bool has_glides(const std::vector<Note>& notes) {
    return std::any_of(notes.begin(), notes.end(), [](const Note& note) { return note.glide.semitones != 0; });
}

double frequency(double key) {
    return 440 * std::exp2((key - 69) / 12);
}

void write_statements(const ScoreHead& head, std::vector<Note> notes, std::int64_t end, Output& out,
                      const Curves& curves) {
    sort_by_time(notes);
    TextWriter writer(out);
    writer.put("{}", tempo_statement(head, curves, end));
    const bool glides = has_glides(notes);
    const bool is_panned = has_pan(curves) || glides;
    for (const Note& note : notes) {
        const std::size_t part = head.part_index(note.voice);
        const bool is_drum = head.parts[part].is_drums;
        writer.put("i {} {} {} {} {} {}{}", part + 1, number(quarters(note.onset)), number(quarters(note.duration)),
                   number(is_drum ? note.key : frequency(note.key)), number(note.velocity / 127.0), note.voice + 1,
                   is_panned ? " " + number(pan_of(note, curves)) : "");
        if (glides && !is_drum) {
            const std::int64_t level = note.duration - note.glide.ticks;
            writer.put(" {} {}", number(frequency(last_key(note))),
                       number(static_cast<double>(level) / static_cast<double>(note.duration)));
        }
        writer.put("\n");
    }
    writer.put("f 0 {}\ne\n", number(quarters(end) + 2));
    writer.flush();
}

/// The greatest sum of the velocities that sound together, 1 for one at its loudest.
double loudest_sum(const std::vector<Note>& notes) {
    std::vector<std::pair<std::int64_t, int>> changes;  // ends come before beginnings
    for (const Note& note : notes) {
        changes.emplace_back(note.onset, note.velocity);
        changes.emplace_back(note.onset + note.duration, -note.velocity);
    }
    std::sort(changes.begin(), changes.end());
    int sum = 0;
    int most = 0;
    for (const auto& [tick, change] : changes) most = std::max(most, sum += change);
    return most / 127.0;
}

/// The instruments. Each voice has a share of the full scale, so that their sum does not exceed it, even in unison.
std::string orchestra(const ScoreHead& head, const std::vector<Note>& notes, bool is_panned, bool glides) {
    int voices = 0;
    for (const Part& part : head.parts) voices += part.voices;
    // Notes end a little after their time, so that more may sound together than computed.
    constexpr double usual = 0.7;
    const double share = usual / std::max({std::sqrt(voices), loudest_sum(notes), 1.0});
    std::string text = "sr = 44100\nksmps = 32\nnchnls = 2\n0dbfs = 1\n";
    const std::string_view outs = is_panned
                                      ? "  outs asound * aenvelope * sqrt(1 - p7), asound * aenvelope * sqrt(p7)\n"
                                      : "  outs asound * aenvelope, asound * aenvelope\n";
    // Slides from p4 to p8 Hz, after the part p9 of the note.
    constexpr std::string_view slide =
        "  ktime timeinsts\n"
        "  kpart limit (ktime / p3 - p9) / (1.000001 - p9), 0, 1\n"
        "  kpitch = p4 * pow(p8 / p4, kpart)\n";
    const std::string_view pitch = glides ? "kpitch" : "p4";
    for (std::size_t i = 0; i < head.parts.size(); ++i) {
        if (head.parts[i].is_drums) {
            // Bass drums and toms are falling tones, others noise: snares low, metal high. p4 is the key of the drum.
            fmt::format_to(
                std::back_inserter(text),
                "instr {}  ; {}\n"
                "  ivoice = p6\n"
                "  ilow = (p4 <= 36 || p4 == 41 || p4 == 43 || p4 == 45 || p4 == 47 || p4 == 48 || p4 == 50 || "
                "p4 >= 60 && p4 <= 66 ? 1 : 0)\n"
                "  ilong = (p4 == 46 || p4 == 49 || p4 == 51 || p4 == 52 || p4 == 55 || p4 == 57 ? 0.6 : 0.12)\n"
                "  p3 = (ilow == 1 ? 0.3 : ilong)\n"
                "  aenvelope expon 1, p3, 0.001\n"
                "  ktone expon 60 + 8 * (p4 - 35) + 60, p3, 40 + 6 * (p4 - 35)\n"
                "  askin oscili ilow, ktone\n"
                "  ahiss noise 1 - ilow, 0\n"
                "  ahiss buthp ahiss, (p4 < 42 ? 800 : 5000)\n"
                "  asound = (askin + ahiss) * p5 * {}\n"
                "  outs asound * aenvelope, asound * aenvelope\n"
                "endin\n",
                i + 1, single_line(head.parts[i].name), number(share), outs);
            continue;
        }
        fmt::format_to(std::back_inserter(text),
                       "instr {}  ; {}\n"
                       "  ivoice = p6\n"
                       "  aenvelope linsegr 0, 0.005, 1, 0.3, 0.5, 3, 0.1, 0.1, 0\n"
                       "{}"
                       "  awave vco2 p5 * {}, {}, 12\n"
                       "  asound tone awave, {} * 4\n"
                       "{}endin\n",
                       i + 1, single_line(head.parts[i].name), glides ? slide : "", number(share), pitch, pitch,
                       outs);
    }
    return text;
}

}  // namespace

void write_csound_score(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                        const Curves& curves) {
    out.write("; score for Csound\n\n" + head_comments(head, ";") + "\n");
    write_statements(head, notes, end, out, curves);
}

void write_csound_file(const ScoreHead& head, const std::vector<Note>& notes, std::int64_t end, Output& out,
                       const Curves& curves) {
    out.write("<CsoundSynthesizer>\n<CsOptions>\n-o dac\n</CsOptions>\n<CsInstruments>\n");
    const bool glides = has_glides(notes);
    out.write(orchestra(head, notes, has_pan(curves) || glides, glides) + "</CsInstruments>\n<CsScore>\n");
    write_statements(head, notes, end, out, curves);
    // Csound ignores text after the end of the document.
    out.write("</CsScore>\n</CsoundSynthesizer>\n\n" + head_comments(head, ";"));
}

}  // namespace sikku
