// music/live/no_alsa_port.cpp: replaces alsa_port.cpp if ALSA's headers are missing.
#include "music/live/ports.h"

namespace sikku::live {
namespace {

[[noreturn]] void refuse() {
    throw PortError(
        "this program was built without ALSA: install libasound2-dev and build it again, or name a MIDI device such "
        "as /dev/snd/midiC1D0");
}

}  // namespace

bool has_alsa() {
    return false;
}

std::vector<PortInfo> list_ports() {
    refuse();
}

std::unique_ptr<Port> open_alsa_port(const std::string&, bool) {
    refuse();
}

}  // namespace sikku::live
