// tests/fuzz/link_fuzz.cpp: links with arbitrary bytes and with arbitrary contents.
#include "tests/fuzz/link_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    sikku::try_link(bytes);
    sikku::try_contents(bytes);
    return 0;
}
