// tests/fuzz/grid_fuzz.cpp: arbitrary text as a grid of dots, its gaps, and a radial kolam.
#include "tests/fuzz/grid_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    sikku::try_grid(text);
    sikku::try_radial(text);
    return 0;
}
