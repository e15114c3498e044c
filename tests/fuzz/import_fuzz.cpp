// tests/fuzz/import_fuzz.cpp: files of cpfg and Fractint: what is imported compiles.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_import({reinterpret_cast<const char*>(data), size});
    return 0;
}
