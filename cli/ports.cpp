// cli/ports.cpp: `sikku ports`: the MIDI ports that music can be sent to.
#include "music/live/ports.h"
#include "cli/command.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

void print_ports() {
    const std::vector<live::PortInfo> ports = live::list_ports();
    std::size_t widest = 0;
    for (const live::PortInfo& port : ports) widest = std::max(widest, printable(port.name).size());
    for (const live::PortInfo& port : ports) {
        fmt::print("{:<8}{:<{}}  {:<12}{}\n", port.address(), printable(port.name), widest,
                   port.is_output && port.is_input ? "to and from"
                   : port.is_output                ? "to"
                                                   : "from",
                   printable(port.client_name));
    }
    if (ports.empty()) tell("no program or device has a MIDI port: start a synthesizer first\n");
}

}  // namespace

void add_ports(CLI::App& app, bool& /*quiet*/) {
    auto* command = app.add_subcommand("ports", "List the MIDI ports for live music");
    command->footer(
        "Each line has the address of a port of ALSA's sequencer, its name, whether music can be sent to it or comes "
        "from it, and the program or device that has it.\n\n"
        "Examples:\n  sikku ports\n  sikku play hilbert --port FLUID --repeat");
    command->callback([] { print_ports(); });
}

}  // namespace sikku
