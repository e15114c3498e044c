// tests/fuzz/surface_fuzz.cpp: surface files (.s) of any bytes.
#include "tests/fuzz/surface_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_surface({reinterpret_cast<const char*>(data), size});
    return 0;
}
