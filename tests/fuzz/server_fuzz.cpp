// tests/fuzz/server_fuzz.cpp: the language server with arbitrary messages and texts.
#include "tests/fuzz/server_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    sikku::try_server(std::string_view(reinterpret_cast<const char*>(data), size));
    return 0;
}
