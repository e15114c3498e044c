// tests/fuzz/reading_fuzz.cpp: arbitrary text as a kolam of the formats that are read.
#include "tests/fuzz/reading_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_reading({reinterpret_cast<const char*>(data), size});
    return 0;
}
