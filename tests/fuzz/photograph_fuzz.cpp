// tests/fuzz/photograph_fuzz.cpp: picture files that are parsed, and pixels in which kolams are read.
#include "tests/fuzz/picture_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_picture({reinterpret_cast<const char*>(data), size});
    return 0;
}
