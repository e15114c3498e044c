#include "tests/notation_tools.h"

namespace sikku {

std::vector<PlainNote> plain(const std::vector<Note>& notes) {
    std::vector<PlainNote> list;
    for (const Note& note : notes) list.push_back({note.onset, note.duration, note.key});
    std::sort(list.begin(), list.end());
    return list;
}

std::array<Spelling, 12> spelling_of(const std::vector<double>& semitones, Spelling tonic) {
    Scale scale;
    for (const double step : semitones) scale.ascent.push_back(100.0 * step);
    scale.descent = scale.ascent;
    return spell(scale, tonic);
}

Part plain_part(const std::string& name, int voices) {
    Part part;
    part.name = name;
    part.voices = voices;
    part.spelling = spelling_of({0, 2, 4, 5, 7, 9, 11}, {0, 0});
    part.key = KeySignature{0, false};
    return part;
}

Notation notate(const TestScore& score, std::size_t block) {
    Notator notator(score.head);
    for (std::size_t i = 0; i < score.notes.size(); i += block) {
        notator.notes(std::span(score.notes).subspan(i, std::min(block, score.notes.size() - i)));
    }
    notator.finish(score.end);
    return notator.notation();
}

TestScore line(const Meter& meter, const std::vector<std::int64_t>& lengths, double key) {
    TestScore score;
    score.head.title = "A line";
    score.head.meter = meter;
    score.head.parts.push_back(plain_part("Voice", 1));
    for (const std::int64_t length : lengths) {
        if (length > 0) {
            Note note{.onset = score.end, .duration = length, .key = key};
            score.notes.push_back(note);
        }
        score.end += std::abs(length);
    }
    return score;
}

TestScore held_score(const Meter& meter) {
    const std::int64_t bar = meter.bar();
    TestScore score = line(meter, {bar, bar, 480, 2 * bar - 480});
    score.notes.back().has_fermata = true;
    score.head.ritardando = 2 * bar;
    score.head.parts.push_back(plain_part("Bass", 1));
    score.notes.push_back({.onset = 0, .duration = 480, .key = 40, .voice = 1});
    return score;
}

std::vector<std::int64_t> bar_onsets(const ScoreHead& head, std::int64_t end) {
    std::vector<std::int64_t> onsets;
    Meter meter = head.meter;
    for (std::int64_t at = 0; at <= end; at += meter.bar()) {
        for (const SectionChange& change : head.changes) {
            if (change.onset == at) meter = change.to.meter;
        }
        onsets.push_back(at);
    }
    return onsets;
}

TestScore random_score(unsigned seed, bool quarter_tones) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    static constexpr std::array<Meter, 9> meters = {
        {{4, 4}, {3, 4}, {5, 8}, {7, 8}, {6, 8}, {2, 2}, {9, 8}, {5, 16}, {12, 8}}};
    static constexpr std::array<std::int64_t, 5> units = {120, 240, 480, 960, 1920};
    TestScore score;
    score.head.title = "Random score";
    score.head.meter = meters[below(meters.size())];
    score.head.tempo = 40.0 + static_cast<double>(below(400)) / 2;
    score.head.made = "sikku 0.1.0, -n 4";
    const std::int64_t unit = units[below(units.size())];
    std::int16_t voice = 0;
    const std::size_t parts = 1 + below(3);
    for (std::size_t i = 0; i < parts; ++i) {
        const auto voices = static_cast<int>(1 + below(4));
        Part part = plain_part("Part " + std::to_string(i + 1), voices);
        part.program = static_cast<int>(below(128));
        const Spelling tonic = {static_cast<int>(below(7)), static_cast<int>(below(3)) - 1};
        const std::vector<double> steps =
            below(2) ? std::vector<double>{0, 2, 4, 5, 7, 9, 11} : std::vector<double>{0, 3, 5, 6, 7, 10};
        part.spelling = spelling_of(steps, tonic);
        part.key.reset();
        if (below(2)) part.key = KeySignature{static_cast<int>(below(15)) - 7, below(2) == 1};
        score.head.parts.push_back(part);
        const int low = 36 + static_cast<int>(below(30));
        const std::size_t range = 3 + below(40);
        for (int k = 0; k < voices; ++k, ++voice) {
            std::int64_t here = 0;
            const std::size_t count = below(12) == 0 ? 0 : 5 + below(40);
            for (std::size_t n = 0; n < count; ++n) {
                const std::int64_t length = unit * static_cast<std::int64_t>(1 + below(n % 3 ? 3 : 9));
                if (below(5) > 0) {
                    Note note{
                        .onset = here,
                        .duration = length,
                        .key = low + static_cast<double>(below(range)) + (quarter_tones && below(3) == 0 ? 0.5 : 0.0),
                        .voice = voice};
                    score.notes.push_back(note);
                }
                here += length;
            }
            score.end = std::max(score.end, here);
        }
    }
    if (seed % 2 == 0) return score;
    std::int64_t at = 0;
    TempoAndMeter frame{score.head.tempo, {}, score.head.meter};
    for (std::size_t i = 0; i < below(4); ++i) {
        at += frame.meter.bar() * static_cast<std::int64_t>(1 + below(6));
        if (at >= score.end) break;
        frame.meter = meters[below(meters.size())];
        if (below(2)) frame.tempo = 40.0 + static_cast<double>(below(200));
        frame.tempo_words = below(3) ? "" : "Andante";
        score.head.changes.push_back({at, frame});
    }
    return score;
}

}  // namespace sikku
