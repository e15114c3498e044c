#include "engine/base/memory.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <utility>

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

std::optional<double> parse_bytes(std::string_view text) {
    static constexpr std::array<std::pair<std::string_view, double>, 13> units = {{{"", 1.0},
                                                                                   {"k", 0x1p10},
                                                                                   {"kib", 0x1p10},
                                                                                   {"m", 0x1p20},
                                                                                   {"mib", 0x1p20},
                                                                                   {"g", 0x1p30},
                                                                                   {"gib", 0x1p30},
                                                                                   {"t", 0x1p40},
                                                                                   {"tib", 0x1p40},
                                                                                   {"kb", 1e3},
                                                                                   {"mb", 1e6},
                                                                                   {"gb", 1e9},
                                                                                   {"tb", 1e12}}};
    const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
    const std::string unit = lower_case(text.substr(digits));
    const auto row = std::find_if(units.begin(), units.end(), [&](const auto& each) { return each.first == unit; });
    double value = 0;
    if (!read_number(text.substr(0, digits), value) || row == units.end() || value <= 0) return std::nullopt;
    return value * row->second;
}

}  // namespace sikku
