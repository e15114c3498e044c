// tests/fuzz/font_fuzz.cpp: fonts, with a text that needs shaping.
#include "art/font/font_module.h"

#include <cstdint>
#include <stdexcept>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        const auto font = sikku::make_font({reinterpret_cast<const char*>(data), size}, {});
        for (const auto& placed : font->shape(U"மீரா கோலம் ஸ்ரீ Qá \u05D0\u05D1 12").glyphs) font->outline(placed.glyph);
    } catch (const std::runtime_error&) {
    }
    return 0;
}
