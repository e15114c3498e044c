// music/live/no_osc_port.cpp: replaces osc_port.cpp and osc_messages.cpp if liblo's headers are missing.
#include "music/live/osc_port.h"

namespace sikku::live {

bool has_osc() {
    return false;
}

std::unique_ptr<Port> open_osc_port(const OscAddress&, const ChangeSink&) {
    throw PortError("this program was built without liblo: install liblo-dev and build it again");
}

}  // namespace sikku::live
