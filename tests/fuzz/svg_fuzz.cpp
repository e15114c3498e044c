// tests/fuzz/svg_fuzz.cpp: SVG of other programs, with copies and style sheets.
#include "tests/fuzz/svg_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    sikku::try_svg(bytes);
    sikku::try_copies(bytes);
    return 0;
}
