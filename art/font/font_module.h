// art/font/font_module.h: the functions that the module with HarfBuzz, FriBidi and fontconfig exports to font.cpp.
#pragma once

#include "art/font/font.h"
#include "art/module/module.h"

namespace sikku {

/// A font as fontconfig finds it.
struct FoundFont {
    std::string file;
    int index = 0;           ///< of the face in the file, and of the named instance of a variable font
    std::string variations;  ///< of a variable font, such as `wght=700`
    std::string name;        ///< family and style; empty if no font is installed
    bool is_wanted = false;  ///< false if it is only the nearest
};

/// Both sides must be built from the same sources: `version` is compared when the module is loaded.
struct FontModule {
    std::uint64_t version;
    /// @throws std::runtime_error for patterns that cannot be read, or that state more than a family, a style, a
    /// weight, a slant and a width
    FoundFont (*find)(const std::string& pattern);
    /// @param bytes  of the file; `found.name` may be empty, and is then read from the font
    /// @throws std::runtime_error if it is not a font with outlines
    std::shared_ptr<const Font> (*open)(std::string bytes, const FoundFont& found);
};
constexpr std::uint64_t font_module_version(std::string_view program) {
    return module_version(program, {sizeof(FoundFont), sizeof(ShapedText), sizeof(ShapedGlyph), sizeof(FontModule)});
}

/// Finds an installed font. See FontModule::find.
FoundFont find_font(const std::string& pattern);
/// Opens a font. See FontModule::open.
std::shared_ptr<const Font> make_font(std::string bytes, const FoundFont& found);

}  // namespace sikku
