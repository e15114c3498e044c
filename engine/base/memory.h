// engine/base/memory.h: the memory of the machine, and sizes in the notation of users.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace sikku {

/// Bytes of memory available without swapping; 4 GB if the system does not report it.
std::uint64_t available_memory();

/// Parses a size in bytes: `1G`, `512M`, `2GiB`, `500MB`, any case; k, M, G and T are powers of 1024. Nullopt for
/// anything else, and for 0.
std::optional<double> parse_bytes(std::string_view text);

}  // namespace sikku
