// music/live/ports.h: the ports of ALSA's sequencer, and MIDI devices that are files.
#pragma once

#include "music/live/port.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sikku::live {

/// A port of a program or a device.
struct PortInfo {
    int client = 0;
    int number = 0;
    std::string client_name;
    std::string name;
    bool is_output = false;  ///< it receives music
    bool is_input = false;   ///< it sends messages, possibly of a clock
    std::string address() const { return std::to_string(client) + ":" + std::to_string(number); }
};

/// True if the program was built with ALSA.
bool has_alsa();

/// Lists the ports of others, by address. @throws PortError if there is no sequencer, or the program was built
/// without ALSA
std::vector<PortInfo> list_ports();

/// Finds the output with the name `name`: an address such as 20:0, the name of a port or of its client, or a part of
/// one of them, in any case, that no other port has. @throws PortError with the existing ports
const PortInfo& choose_port(std::span<const PortInfo> ports, const std::string& name);

/// Opens an output of ALSA's sequencer, whose queue in the kernel delivers messages at their times by
/// CLOCK_MONOTONIC. Its clock messages are received if `has_input`.
/// @throws PortError
std::unique_ptr<Port> open_alsa_port(const std::string& name, bool has_input);

/// Opens a character device such as /dev/snd/midiC1D0, or a named pipe that a program reads. Messages are written as
/// bytes, and clock messages are read if `has_input`. The signal SIGPIPE must be ignored.
/// @throws PortError
std::unique_ptr<Port> open_device(const std::string& path, bool has_input);

}  // namespace sikku::live
