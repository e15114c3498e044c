// studio/wasm/font.cpp: fonts of the web build, which has none.
#include "art/font/font.h"

#include <stdexcept>

namespace sikku {

bool is_font_file(std::string_view /*name*/) {
    return false;
}

std::shared_ptr<const Font> open_font(const std::string& /*name*/, const std::filesystem::path& /*folder*/) {
    throw std::runtime_error("fonts are not available here; use `sikku draw`");
}

}  // namespace sikku
