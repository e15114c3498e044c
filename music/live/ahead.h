// music/live/ahead.h: reads a stream of notes ahead, on a thread of its own.
#pragma once

#include "engine/base/monitor.h"
#include "music/note_stream.h"

#include <functional>
#include <memory>

namespace sikku::live {

/// Opens a stream that stops reading on a stop request of the monitor.
using OpenStream = std::function<std::unique_ptr<NoteStream>(const Monitor& monitor)>;

/// Opens a stream and reads two windows ahead of next(), on a thread, so that next() returns at once unless reading
/// takes longer than playing. Errors of the stream are thrown by next().
/// @param outer  stops the opening and the reading, too; on two threads
/// @throws exceptions of `open`
std::unique_ptr<NoteStream> read_ahead(const OpenStream& open, const Monitor& outer = {});

}  // namespace sikku::live
