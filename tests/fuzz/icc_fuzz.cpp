// tests/fuzz/icc_fuzz.cpp: ICC profiles of inks.
#include "art/image/icc.h"
#include "tests/fuzz/file_targets.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const sikku::MemoryFile file({reinterpret_cast<const char*>(data), size});
    try {
        const sikku::InkTransform inks(file.path());
        constexpr std::array<std::uint8_t, 12> pixels = {0, 0, 0, 255, 255, 255, 0, 128, 255, 0, 128, 255};
        std::array<std::uint8_t, 16> converted{};
        inks.convert(pixels, converted);
    } catch (const std::runtime_error&) {
    }
    return 0;
}
