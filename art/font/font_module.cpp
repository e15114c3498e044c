// art/font/font_module.cpp: with font_search.cpp, font_shaping.cpp and text_runs.cpp, a module that font.cpp loads.
#include "art/font/font_module.h"

namespace sikku {
namespace {

constexpr FontModule font_functions{font_module_version(SIKKU_VERSION), find_font, make_font};

}  // namespace
}  // namespace sikku

extern "C" __attribute__((visibility("default"))) const sikku::FontModule* sikku_font_module() {
    return &sikku::font_functions;
}
