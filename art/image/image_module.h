// art/image/image_module.h: the functions that the module with OpenImageIO exports to image_file.cpp.
#pragma once

#include "art/image/image_file.h"

#include <string_view>

namespace sikku {

/// Both sides must be built from the same sources: `version` is compared when the module is loaded.
struct ImageModule {
    std::uint64_t version;
    std::unique_ptr<ImageWriter> (*open)(const std::filesystem::path& path, const ImageSpec& spec);
    void (*check_cmyk_profile)(const std::filesystem::path& file);
    std::unique_ptr<InkProfile> (*open_inks)(const std::filesystem::path& file);
};
/// A number that changes with the program's version and with the sizes of the structures that both sides share
/// (FNV-1a).
constexpr std::uint64_t image_module_version(std::string_view program) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3; };
    for (const char byte : program) add(static_cast<unsigned char>(byte));
    for (const std::size_t size : {sizeof(ImageSpec), sizeof(DecodedPicture), sizeof(ImageModule)}) add(size);
    return hash;
}
/// The only symbol, of type `const ImageModule* ()`, with C linkage.
constexpr const char* image_module_symbol = "sikku_image_module";

}  // namespace sikku
