#include "tests/midi_tools.h"

namespace sikku {

std::span<const std::uint8_t> midi_span(const std::string& bytes) {
    return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

std::vector<MidiFault> check_midi(const std::string& bytes) {
    return check_midi(midi_span(bytes));
}

std::string midi_faults(const std::string& bytes) {
    std::string text;
    for (const MidiFault& fault : check_midi(bytes)) text += std::to_string(fault.at) + ": " + fault.what + "\n";
    return text;
}

std::string make_midi(const MidiScore& score, const MidiOptions& options, std::size_t block) {
    MidiMemory memory;
    const auto writer = write_midi(score.head, memory, options);
    for (std::size_t i = 0; i < score.notes.size(); i += block) {
        writer->notes(std::span(score.notes).subspan(i, std::min(block, score.notes.size() - i)));
    }
    writer->finish(score.end);
    return memory.bytes();
}

ScoreHead midi_head(int voices) {
    ScoreHead head;
    head.title = "A test";
    head.pattern = "axiom: F\n";
    head.made = "sikku 0.1.0, -n 4";
    Part part;
    part.name = "Flute";
    part.program = 73;
    part.voices = voices;
    head.parts = {part};
    return head;
}

Note midi_note(std::int64_t onset, std::int64_t duration, double key, int voice, int velocity) {
    Note note{.onset = onset,
              .duration = duration,
              .key = key,
              .voice = static_cast<std::int16_t>(voice),
              .velocity = static_cast<std::uint8_t>(velocity)};
    return note;
}

MidiScore random_midi_score(std::mt19937& chance, int voices, int notes, bool microtonal) {
    const auto pick = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(chance); };
    const auto ticks = [&](int least) {
        return pick(0, 9) == 0 ? pick(least, 3'000'000) : pick(least, pick(least, 500));
    };
    MidiScore score;
    score.head = midi_head(voices);
    score.head.tempo = pick(20, 300);
    score.head.meter = {pick(1, 17), 1 << pick(0, 6)};
    score.head.parts.front().key = KeySignature{pick(-7, 7), pick(0, 1) == 1};
    std::vector<std::int64_t> now(static_cast<std::size_t>(voices), 0);
    for (int left = notes; left > 0;) {
        const int voice = pick(0, voices - 1);
        auto& tick = now[static_cast<std::size_t>(voice)];
        for (int run = pick(1, 8); run > 0 && left > 0; --run, --left) {
            if (pick(0, 2) == 0) tick += ticks(0);
            double key = pick(0, 127);
            if (microtonal && pick(0, 2) > 0) key = std::clamp(key + pick(-50, 50) / 100.0, 0.0, 127.0);
            score.notes.push_back(midi_note(tick, ticks(1), key, voice, pick(1, 127)));
            tick += score.notes.back().duration;
        }
    }
    score.end = *std::max_element(now.begin(), now.end()) + pick(0, 5000);
    return score;
}

std::vector<Note> by_onset(std::vector<Note> notes) {
    std::sort(notes.begin(), notes.end(), [](const Note& a, const Note& b) {
        return std::tie(a.onset, a.voice, a.key) < std::tie(b.onset, b.voice, b.key);
    });
    return notes;
}

int midi_channel(int voice) {
    return voice < 9 ? voice : voice + 1;
}

std::string hex_bytes(std::string_view digits) {
    std::string bytes;
    int half = -1;
    for (const char digit : digits) {
        if (digit == ' ' || digit == '\n') continue;
        const int value = digit <= '9' ? digit - '0' : digit - 'A' + 10;
        if (half < 0) {
            half = value;
        } else {
            bytes += static_cast<char>(half * 16 + value);
            half = -1;
        }
    }
    return bytes;
}

std::string midi_chunk(std::string_view kind, const std::string& data) {
    std::string bytes(kind);
    for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(data.size() >> shift & 0xFF);
    return bytes + data;
}

}  // namespace sikku
