#include "music/held_ending.h"

#include <algorithm>

namespace sikku {

int HeldEnding::line_of(int voice) const {
    int line = -1;
    for (const Player& player : ensemble_.players) {
        if (voice < player.first_voice) break;
        const int within = voice - player.first_voice;
        const bool is_drum = player.has_drums && within >= player.drums_from;
        const bool is_chord = player.melody.accompanying_voices() > 0 && within >= player.chords_from;
        // Sections before the last have ended already.
        const bool is_over =
            player.section != 0 && !ensemble_.form.empty() && player.section != 'A' + ensemble_.form.back().letter;
        line = is_drum || is_over ? -1 : 2 * player.first_voice + (is_chord ? 1 : 0);
    }
    return line;
}

void HeldEnding::notes(std::span<const Note> notes) {
    passing_.clear();
    for (const Note& note : notes) {
        auto& last = last_[note.voice];
        if (last) passing_.push_back(*last);
        last = note;
    }
    if (!passing_.empty()) sink_.notes(passing_);
}

std::int64_t HeldEnding::finish(std::int64_t end, const BarLines& bars, std::int64_t most) {
    const std::int64_t bar = bars.length(std::max<std::int64_t>(0, end - 1));
    std::map<int, std::int64_t> onsets;  // onset of the last note, by line
    std::int64_t last_onset = 0;
    for (const auto& [voice, note] : last_) {
        const int line = line_of(voice);
        if (line < 0) continue;
        onsets[line] = std::max(onsets[line], note->onset);
        last_onset = std::max(last_onset, note->onset);
    }
    std::int64_t until = bars.next(end);
    if (2 * (until - last_onset) < bar) until += bar;
    until = std::max(end, std::min(until, most));
    for (auto& [voice, last] : last_) {
        Note& note = *last;
        const int line = line_of(voice);
        const std::int64_t note_end = note.onset + note.duration;
        if (line < 0 || note_end <= onsets[line] || note_end < end - bar) continue;
        note.duration = until - note.onset;
        note.glide = {};
        note.has_fermata = true;
    }
    forward();
    return until;
}

std::int64_t HeldEnding::finish_as_cut(std::int64_t end) {
    forward();
    return end;
}

void HeldEnding::forward() {
    passing_.clear();
    for (const auto& [voice, note] : last_) passing_.push_back(*note);
    if (!passing_.empty()) sink_.notes(passing_);
    last_.clear();
}

}  // namespace sikku
