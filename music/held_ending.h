// music/held_ending.h: holds the last notes of a score to its end, under a fermata.
#pragma once

#include "music/score/score.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {

/// Forwards notes, but holds back the last one of each voice until the end of the score is known. Memory: O(voices).
class HeldEnding : public NoteSink {
public:
    /// The line of a voice; -1 for drums, which are not held. Voices of one line end together: their last notes are
    /// held if they sound when the last note of the line begins.
    using LineOf = std::function<int(int voice)>;
    HeldEnding(NoteSink& sink, LineOf line_of) : sink_(sink), line_of_(std::move(line_of)) {}

    void controls(std::span<const ControlPoint> points) override { sink_.controls(points); }
    void notes(std::span<const Note> notes) override {
        passing_.clear();
        for (const Note& note : notes) {
            auto& last = last_[note.voice];
            if (last) passing_.push_back(*last);
            last = note;
        }
        if (!passing_.empty()) sink_.notes(passing_);
    }
    void finish(std::int64_t) override {}

    /// Forwards the notes held back. The last notes of lines that ended within four bars of the end are extended to
    /// the end of the last bar, or of one more bar if the last of them would otherwise last less than half a bar.
    /// @param end  end of the score, in ticks
    /// @param most  limit of the new end
    /// @return the end of the score
    std::int64_t finish(std::int64_t end, const Meter& meter, std::int64_t most) {
        constexpr std::int64_t latest_bars = 4;
        const std::int64_t bar = meter.bar();
        std::map<int, std::int64_t> onsets;  // onset of the last note, by line
        std::int64_t last_onset = 0;
        for (const auto& [voice, note] : last_) {
            const int line = line_of_(voice);
            if (line < 0) continue;
            onsets[line] = std::max(onsets[line], note->onset);
            last_onset = std::max(last_onset, note->onset);
        }
        std::int64_t until = (end + bar - 1) / bar * bar;
        if (2 * (until - last_onset) < bar) until += bar;
        until = std::max(end, std::min(until, most));
        passing_.clear();
        for (auto& [voice, last] : last_) {
            Note& note = *last;
            const int line = line_of_(voice);
            const std::int64_t note_end = note.onset + note.duration;
            if (line >= 0 && note_end > onsets[line] && note_end > end - latest_bars * bar) {
                note.duration = until - note.onset;
                note.glide = {};
                note.has_fermata = true;
            }
            passing_.push_back(note);
        }
        if (!passing_.empty()) sink_.notes(passing_);
        last_.clear();
        return until;
    }

private:
    NoteSink& sink_;
    LineOf line_of_;
    std::map<int, std::optional<Note>> last_;  // by voice
    std::vector<Note> passing_;
};

}  // namespace sikku
