#include "music/strict_check.h"

#include "music/form/counterpoint.h"
#include "music/score/note_order.h"

#include <cstddef>
#include <utility>

namespace sikku {

void StrictCheck::notes(std::span<const Note> notes) {
    for (const Note& note : notes) {
        const auto voice = static_cast<std::size_t>(note.voice);
        if (voice >= voices_.size()) voices_.resize(voice + 1);
        voices_[voice].push_back(note);
    }
    sink_.notes(notes);
}

std::vector<std::int64_t> StrictCheck::faults(std::int64_t late) {
    std::vector<SoundingVoice> voices;
    const auto add = [&](int number, bool is_led) {
        if (static_cast<std::size_t>(number) >= voices_.size()) return;
        SoundingVoice voice{std::move(voices_[static_cast<std::size_t>(number)]), is_led};
        sort_by_onset(voice.notes);
        voices.push_back(std::move(voice));
    };
    for (const Player& player : ensemble_.players) {
        // The melody adapts to its chords, which follow its voices; drums follow both.
        const int chords = player.melody.accompanying_voices();
        if (player.has_drums && player.drums_from == 0) continue;
        for (int i = 0; i < chords; ++i) add(player.first_voice + player.chords_from + i, false);
        for (int i = 0; i < player.chords_from; ++i) add(player.first_voice + i, player.melody.layout.is_strict);
    }
    return sounding_faults(voices, bars_, late);
}

}  // namespace sikku
