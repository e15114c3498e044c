#include "music/rendition.h"

#include "engine/base/memory.h"
#include "music/score/unisons.h"

namespace sikku {
namespace {

/// True if drums sound together on their channel.
bool has_drum_voices(const ScoreHead& head) {
    int voices = 0;
    for (const Part& part : head.parts) voices += part.is_drums ? part.voices : 0;
    return voices > 1;
}

}  // namespace

NoteCollector Rendition::collect() {
    NoteCollector collector;
    report = perform(ensemble, playing, use, human, collector);
    return collector;
}

const Notation& Rendition::print() {
    Notator notator(head);
    report = perform(ensemble, playing, use, {}, notator);
    notation = notator.notation();
    return *notation;
}

void Rendition::write_midi(Output& output) {
    const auto writer = sikku::write_midi(head, output, midi);
    if (!midi.share_channels && !has_drum_voices(head)) {
        report = perform(ensemble, playing, use, human, *writer);
        return;
    }
    UnisonMerger merger(*writer, head, static_cast<std::size_t>(available_memory() / 4 / sizeof(Note)),
                        midi.share_channels);
    report = perform(ensemble, playing, use, human, merger);
}

}  // namespace sikku
