#include "engine/base/memory.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace sikku {

std::uint64_t available_memory() {
    std::ifstream file("/proc/meminfo");
    std::string key;
    std::uint64_t kilobytes = 0;
    std::string unit;
    while (file >> key >> kilobytes >> unit) {
        if (key == "MemAvailable:") return kilobytes * 1024;
    }
    return std::uint64_t{1} << 32;
}

void use_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
    constexpr std::size_t large = std::size_t{1} << 21;
    if (bytes < 2 * large) return;
    // Whole large pages within the memory.
    if (!std::align(large, large, begin, bytes)) return;
    madvise(begin, bytes / large * large, MADV_HUGEPAGE);
#endif
}

std::optional<double> parse_bytes(std::string_view text) {
    struct Unit {
        std::string_view prefix;
        double binary, decimal;
    };
    constexpr std::array<Unit, 4> units = {
        {{"k", 0x1p10, 1e3}, {"m", 0x1p20, 1e6}, {"g", 0x1p30, 1e9}, {"t", 0x1p40, 1e12}}};
    const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
    const std::string unit = lower_case(text.substr(digits));
    double value = 0;
    if (!read_number(text.substr(0, digits), value) || value <= 0) return std::nullopt;
    if (unit.empty()) return value;
    for (const auto& [prefix, binary, decimal] : units) {
        if (!unit.starts_with(prefix)) continue;
        const std::string_view rest = std::string_view(unit).substr(1);
        if (rest == "b") return value * decimal;
        if (rest.empty() || rest == "ib") return value * binary;
    }
    return std::nullopt;
}

}  // namespace sikku
