#include "music/live/ports.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku::live {
namespace {

std::string listed(std::span<const PortInfo> ports) {
    std::string text;
    for (const PortInfo& port : ports) {
        if (!port.is_output) continue;
        text += fmt::format("{}'{}' ({})", text.empty() ? "" : ", ", printable(port.name), port.address());
    }
    return text;
}

/// Rates the match of a name with a port: 3 its address, 2 a whole name, 1 a part of one, 0 none.
int likeness(const PortInfo& port, const std::string& name) {
    if (port.address() == name) return 3;
    const std::string wanted = lower_case(name);
    const std::string own = lower_case(port.name);
    const std::string client = lower_case(port.client_name);
    if (own == wanted || client == wanted || client + ":" + own == wanted) return 2;
    return own.find(wanted) != std::string::npos || client.find(wanted) != std::string::npos ? 1 : 0;
}

}  // namespace

const PortInfo& choose_port(std::span<const PortInfo> ports, const std::string& name) {
    std::vector<PortInfo> found;
    const PortInfo* best = nullptr;
    int most = 1;
    for (const PortInfo& port : ports) {
        const int like = port.is_output ? likeness(port, name) : 0;
        if (like < most) continue;
        if (like > most || !best) found.clear();
        most = like;
        if (!best || found.empty()) best = &port;
        found.push_back(port);
    }
    if (!best) {
        const std::string known = listed(ports);
        throw PortError(fmt::format(
            "unknown port '{}'; {}", printable(name),
            known.empty() ? "no program or device has one: start a synthesizer first" : "there are: " + known));
    }
    // The first port of a client, if the client is named.
    const bool is_one_client =
        std::all_of(found.begin(), found.end(), [&](const PortInfo& port) { return port.client == best->client; });
    if (found.size() > 1 && !(most == 2 && is_one_client)) {
        throw PortError(fmt::format("several ports are like '{}': {}", printable(name), listed(found)));
    }
    return *best;
}

}  // namespace sikku::live
