// tests/fuzz/kbm_fuzz.cpp: Scala key maps (.kbm) of any bytes.
#include "tests/fuzz/scale_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_kbm({reinterpret_cast<const char*>(data), size});
    return 0;
}
