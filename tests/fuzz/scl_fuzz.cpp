// tests/fuzz/scl_fuzz.cpp: Scala scales (.scl) of any bytes.
#include "tests/fuzz/scale_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_scl({reinterpret_cast<const char*>(data), size});
    return 0;
}
