// music/live/device_port.h: MIDI devices that are files, such as /dev/snd/midiC1D0, and named pipes.
#pragma once

#include "music/live/port.h"

#include <memory>
#include <string>

namespace sikku::live {

/// Opens a character device or a named pipe that a program reads. Messages are written as bytes, and clock messages
/// are read if `has_input`. The signal SIGPIPE has to be ignored.
/// @throws PortError
std::unique_ptr<Port> open_device(const std::string& path, bool has_input);

}  // namespace sikku::live
