// music/score/note_order.h: the order of notes in lists.
#pragma once

#include "music/score/score.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace sikku {

/// Sorts notes by onset, then by voice.
inline void sort_by_time(std::vector<Note>& notes) {
    std::stable_sort(notes.begin(), notes.end(), [](const Note& a, const Note& b) {
        return std::tie(a.onset, a.voice) < std::tie(b.onset, b.voice);
    });
}

/// Sorts notes by onset; those of one onset keep their order.
inline void sort_by_onset(std::vector<Note>& notes) {
    std::stable_sort(notes.begin(), notes.end(), [](const Note& a, const Note& b) { return a.onset < b.onset; });
}

}  // namespace sikku
