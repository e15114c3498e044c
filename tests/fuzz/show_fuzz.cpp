// tests/fuzz/show_fuzz.cpp: reading patterns back from files of every format.
#include "tests/fuzz/file_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_show({reinterpret_cast<const char*>(data), size});
    return 0;
}
