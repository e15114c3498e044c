// music/live/osc_port.h: live music as messages of Open Sound Control (OSC) over UDP.
#pragma once

#include "music/live/port.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sikku::live {

/// A host, by name or address, and a UDP port.
struct UdpAddress {
    std::string host;
    std::string port;  ///< 1 to 65535
};

/// Where OSC messages are sent, and where they are expected.
struct OscAddress {
    std::string text;  ///< for messages
    UdpAddress to;
    std::optional<UdpAddress> listen;
};

/// True for texts that begin with `osc://`.
bool is_osc_address(const std::string& text);

/// Reads `osc://HOST:PORT`, perhaps with `,listen=PORT` or `,listen=HOST:PORT`; without that host, only this machine
/// is heard, at 127.0.0.1. IPv6 addresses are written in brackets. Names are looked up when the port is opened.
/// @throws PortError whose message does not contain the address
OscAddress read_osc_address(const std::string& text);

/// A change of the first pattern that a message asks for.
struct PatternChange {
    std::string key;    ///< empty: `value` is the text of a whole pattern
    std::string value;  ///< from the network: anything, up to 64 kB
};
using ChangeSink = std::function<void(PatternChange change)>;

/// True if the program was built with liblo.
bool has_osc();

/// Opens a port that sends messages in bundles with time tags, and receives clock messages and changes if the address
/// says where it listens. It does not matter whether a program receives them. @param change  called by wait()
/// @throws PortError for unknown hosts, if it cannot listen there, or if the program was built without liblo
std::unique_ptr<Port> open_osc_port(const OscAddress& address, const ChangeSink& change);

}  // namespace sikku::live
