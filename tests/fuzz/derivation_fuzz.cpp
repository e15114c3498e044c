// tests/fuzz/derivation_fuzz.cpp: derivation, turtle and fold of whatever compiles; they must agree.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_derivation({reinterpret_cast<const char*>(data), size});
    return 0;
}
