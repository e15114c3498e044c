// art/image_module.h: what the module with OpenImageIO exports to image_file.cpp.
#pragma once

#include "art/image_file.h"

namespace sikku {

/// Both sides must be built from the same sources: `version` is compared when the module is loaded.
struct ImageModule {
    int version;
    std::unique_ptr<ImageWriter> (*open)(const std::filesystem::path& path, const ImageSpec& spec);
    std::optional<ImageText> (*read_text)(const std::filesystem::path& path);
};
constexpr int image_module_version = 1;
/// The one symbol, of type `const ImageModule* ()`, without C++ name.
constexpr const char* image_module_symbol = "sikku_image_module";

}  // namespace sikku
