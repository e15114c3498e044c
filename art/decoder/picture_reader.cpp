// art/decoder/picture_reader.cpp: decodes JPEG, PNG, TIFF, WebP and BMP through OpenImageIO.
#include "art/decoder/averager.h"
#include "art/decoder/bare_picture.h"
#include "art/decoder/decoder.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Maximum memory for one decoded picture.
constexpr std::uint64_t most_bytes = 800'000'000;
/// Readers quote this name.
constexpr const char* name_in_messages = "picture";

/// An opened picture, with the sizes that it claims checked.
class PictureReader {
public:
    PictureReader(BarePicture bare, std::uint64_t most_pixels)
        : bare_(std::move(bare)), memory_(bare_.bytes.data(), bare_.bytes.size()) {
        input_ = OIIO::ImageInput::create(bare_.format);
        if (!input_ || !input_->supports("ioproxy")) {
            throw std::runtime_error(std::string("this OpenImageIO does not read ") + bare_.format);
        }
        input_->set_ioproxy(&memory_);
        if (!input_->open(name_in_messages, spec_)) fail("the picture is damaged");
        if (spec_.width < 1 || spec_.height < 1 || spec_.depth > 1 || spec_.nchannels < 1 || spec_.nchannels > 5) {
            throw std::runtime_error("not a picture in colour or grey");
        }
        check_size(static_cast<std::uint64_t>(spec_.width), static_cast<std::uint64_t>(spec_.height),
                   std::min<std::uint64_t>(most_pixels, most_bytes / spec_.pixel_bytes(true)));
        const auto tile = static_cast<std::uint64_t>(std::max(1, spec_.tile_width)) *
                          static_cast<std::uint64_t>(std::max(1, spec_.tile_height));
        if (tile * spec_.pixel_bytes(true) > most_bytes || spec_.tile_depth > 1) {
            throw std::runtime_error("the tiles of the picture are too large");
        }
    }

    DecodedPicture read(int longest_side) {
        Averager averager(spec_.width, spec_.height, {spec_.nchannels, spec_.alpha_channel}, longest_side);
        const auto stride = static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.nchannels);
        const bool is_tiled = spec_.tile_width > 0;
        const int band = is_tiled ? spec_.tile_height : 64;
        std::vector<std::uint8_t> pixels(stride * static_cast<std::size_t>(std::min(band, spec_.height)));
        const int begin = spec_.y;
        const int end = spec_.y + spec_.height;
        for (int y = begin; y < end; y += band) {
            const int stop = std::min(y + band, end);
            const bool is_read =
                is_tiled ? input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, y, stop, spec_.z, spec_.z + 1, 0,
                                              spec_.nchannels, OIIO::TypeDesc::UINT8, pixels.data())
                         : input_->read_scanlines(0, 0, y, stop, spec_.z, 0, spec_.nchannels, OIIO::TypeDesc::UINT8,
                                                  pixels.data());
            if (!is_read) fail("the picture is damaged at row " + std::to_string(y - begin + 1));
            for (int row = y; row < stop; ++row)
                averager.row(pixels.data() + stride * static_cast<std::size_t>(row - y));
        }
        return averager.take(bare_.orientation);
    }

private:
    [[noreturn]] void fail(const std::string& what) {
        std::string message = input_->geterror();
        if (message.empty()) message = OIIO::geterror();
        for (char& byte : message) {
            if (static_cast<unsigned char>(byte) < ' ') byte = ' ';
        }
        while (!message.empty() && message.back() == ' ') message.pop_back();
        throw std::runtime_error(message.empty() ? what : what + ": " + message);
    }

    BarePicture bare_;
    OIIO::Filesystem::IOMemReader memory_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
};

}  // namespace

void prepare_decoder() {
    OIIO::attribute("debug", 0);
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", 1);
    for (const char* format : {"jpeg", "png", "tiff", "webp", "bmp"}) OIIO::ImageInput::create(format);
    OIIO::geterror();
}

DecodedPicture decode(std::string file, int longest_side, std::uint64_t most_pixels) {
    return PictureReader(bare_picture(std::move(file), most_pixels), most_pixels).read(longest_side);
}

}  // namespace sikku
