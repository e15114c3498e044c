// art/decoder/confinement.h: removes all rights from a process that a decoder of untrusted bytes does not need.
#pragma once

#include <cstdint>

namespace sikku {

struct ConfinementLimits {
    std::uint64_t memory = 0;   ///< bytes of address space, beyond those used when confine() is called
    std::uint64_t seconds = 0;  ///< processor time
};

/// Confines the process permanently. It limits memory and processor time, and prevents the process from opening or
/// writing files, starting programs or processes, opening sockets, observing or signalling other processes, and
/// gaining privileges. The process leaves no memory dump and ends with the thread that started it. Only standard
/// input, output and error stay open. If the kernel does not support system call filters (seccomp), only the limits
/// apply, and files can be read.
/// @param parent  process that started this one; if it ended already, so does this one
/// @throws std::runtime_error if the system refuses a limit
void confine(const ConfinementLimits& limits, int parent);

}  // namespace sikku
