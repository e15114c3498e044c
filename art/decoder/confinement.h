// art/decoder/confinement.h: takes from a process what a decoder of untrusted bytes does not need.
#pragma once

#include <cstdint>

namespace sikku {

struct ConfinementLimits {
    std::uint64_t memory = 0;   ///< bytes of address space, beyond those used when confine() is called
    std::uint64_t seconds = 0;  ///< of processor time
};

/// Confines the process for good: limits its memory and processor time; no files can be opened, no bytes be written
/// to files, no programs or processes started, no sockets made, no other process be seen or signalled, no privileges
/// be gained; it leaves no memory dump and ends with the thread that started it. Only standard input, output and
/// error stay open. Where the kernel has no filters for system calls (seccomp), the limits hold, and files can be
/// read.
/// @param parent  process that started this one; if it ended already, so does this one
/// @throws std::runtime_error if the system refuses a limit
void confine(const ConfinementLimits& limits, int parent);

}  // namespace sikku
