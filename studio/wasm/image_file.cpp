// studio/wasm/image_file.cpp: picture files of the web build, which has no OpenImageIO.
#include "art/image/image_file.h"

#include "art/image/png_writer.h"

#include <stdexcept>

namespace sikku {
namespace {

[[noreturn]] void refuse() {
    throw std::runtime_error(
        "only PNG pictures can be made here; use `sikku draw` for other formats and for prints in CMYK");
}

}  // namespace

void prepare_images(int /*threads*/) {}

std::unique_ptr<ImageWriter> open_image(const std::filesystem::path& path, const ImageSpec& spec) {
    if (spec.format != "png") refuse();
    return open_png(path, spec);
}

std::unique_ptr<InkProfile> open_inks(const std::filesystem::path& /*file*/) {
    refuse();
}

void check_cmyk_profile(const std::filesystem::path& /*file*/) {
    refuse();
}

bool is_picture(std::string_view /*first_bytes*/) {
    return false;
}

DecodedPicture read_picture(const std::filesystem::path& /*path*/, int /*longest_side*/,
                            std::uint64_t /*most_pixels*/, const Monitor& /*monitor*/) {
    throw std::runtime_error("photographs cannot be read here; use `sikku kolam --read`");
}

}  // namespace sikku
