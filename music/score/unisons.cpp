#include "music/score/unisons.h"

#include "music/score/midi.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace sikku {

std::vector<std::size_t> unison_parts(const ScoreHead& head, bool merges_all) {
    std::vector<std::size_t> parts;
    const std::vector<int> slots = merges_all ? channel_slots(head) : std::vector<int>(head.parts.size());
    constexpr std::size_t drums = 0;  // all drum parts are one, on one channel
    for (std::size_t i = 0; i < head.parts.size(); ++i) {
        for (int voice = 0; voice < head.parts[i].voices; ++voice) {
            const std::size_t own = merges_all ? static_cast<std::size_t>(slots[i]) : parts.size();
            parts.push_back(head.parts[i].is_drums ? drums : own + 1);
        }
    }
    return parts;
}

void LastStrokes::add(const Note& note) {
    Stroke& last = last_[{parts_.at(static_cast<std::size_t>(note.voice)), note.key}];
    if (last.velocity > 0 && last.onset > note.onset) return;
    const bool is_together = last.velocity > 0 && last.onset == note.onset;
    last = {note.onset, is_together ? std::max(last.velocity, note.velocity) : note.velocity};
}

std::optional<std::uint8_t> LastStrokes::velocity(const Note& note) const {
    const auto found = last_.find({parts_.at(static_cast<std::size_t>(note.voice)), note.key});
    return found == last_.end() ? std::nullopt : std::optional(found->second.velocity);
}

UnisonMerger::UnisonMerger(NoteSink& sink, const ScoreHead& head, std::size_t most, bool merges_all)
    : sink_(sink), most_(most), parts_(unison_parts(head, merges_all)), before_(parts_) {}

void UnisonMerger::notes(std::span<const Note> notes) {
    if (notes.size() > most_ - notes_.size()) {
        throw ScoreError(
            fmt::format("more than {} notes in voices that share channels do not fit into memory; limit "
                        "the bars or seconds",
                        most_));
    }
    notes_.insert(notes_.end(), notes.begin(), notes.end());
}

void UnisonMerger::finish(std::int64_t end) {
    const auto part_of = [&](const Note& note) { return parts_.at(static_cast<std::size_t>(note.voice)); };
    for (Note& note : notes_) {
        if (note.is_remainder) note.velocity = before_.velocity(note).value_or(note.velocity);
    }
    std::sort(notes_.begin(), notes_.end(), [](const Note& a, const Note& b) {
        return std::tuple(a.onset, !a.is_remainder, -a.duration, a.voice) <
               std::tuple(b.onset, !b.is_remainder, -b.duration, b.voice);
    });
    std::map<std::pair<std::size_t, double>, Note*> sounding;
    for (Note& note : notes_) {
        Note*& last = sounding[{part_of(note), note.key}];
        if (last && last->onset == note.onset && last->is_remainder == note.is_remainder) {
            last->velocity = std::max(last->velocity, note.velocity);
            note.duration = 0;
            continue;
        }
        if (last && last->onset + last->duration > note.onset) {
            note.duration = std::max(note.duration, last->onset + last->duration - note.onset);
            last->duration = note.onset - last->onset;
        }
        last = &note;
    }
    notes_.erase(std::remove_if(notes_.begin(), notes_.end(), [](const Note& note) { return note.duration == 0; }),
                 notes_.end());
    // A note extended for another may overlap the next one of its voice, so voices are reassigned.
    std::map<std::size_t, std::vector<std::pair<std::int16_t, std::int64_t>>> free_at;  // by part, voices and ends
    std::vector<std::vector<Note>> voices(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) free_at[parts_[i]].emplace_back(static_cast<std::int16_t>(i), 0);
    for (Note note : notes_) {
        auto& places = free_at[part_of(note)];
        const std::int16_t own = note.voice;
        auto place = std::find_if(places.begin(), places.end(), [&](const auto& one) { return one.first == own; });
        if (place->second > note.onset) {
            place =
                std::find_if(places.begin(), places.end(), [&](const auto& one) { return one.second <= note.onset; });
        }
        // At most as many notes sound as before, so a place is free.
        place->second = note.onset + note.duration;
        note.voice = place->first;
        voices[static_cast<std::size_t>(note.voice)].push_back(note);
    }
    for (const std::vector<Note>& voice : voices) {
        if (!voice.empty()) sink_.notes(voice);
    }
    sink_.finish(end);
}

}  // namespace sikku
