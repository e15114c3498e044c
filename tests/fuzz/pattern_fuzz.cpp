// tests/fuzz/pattern_fuzz.cpp: parser and compiler on any bytes.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_pattern({reinterpret_cast<const char*>(data), size});
    return 0;
}
