#include "art/image/picture_reader.h"

#include "art/image/bare_picture.h"
#include "engine/base/input_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Largest memory for one decoded picture, and largest file.
constexpr std::uint64_t most_bytes = 800'000'000;
constexpr std::size_t most_file_bytes = 256'000'000;

/// Turns a picture as its EXIF orientation says (1 to 8). Source: Exif 2.32, tag 274.
void turn(DecodedPicture& picture, int orientation) {
    if (orientation < 2 || orientation > 8) return;
    const bool is_transposed = orientation >= 5;
    DecodedPicture turned{
        is_transposed ? picture.height : picture.width, is_transposed ? picture.width : picture.height,
        std::vector<std::uint8_t>(picture.pixels.size()), is_transposed ? picture.file_height : picture.file_width,
        is_transposed ? picture.file_width : picture.file_height};
    for (int y = 0; y < turned.height; ++y) {
        for (int x = 0; x < turned.width; ++x) {
            int from_x = is_transposed ? y : x;
            int from_y = is_transposed ? x : y;
            if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) {
                from_x = picture.width - 1 - from_x;
            }
            if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) {
                from_y = picture.height - 1 - from_y;
            }
            const auto to = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(turned.width) +
                                 static_cast<std::size_t>(x));
            const auto from = 3 * (static_cast<std::size_t>(from_y) * static_cast<std::size_t>(picture.width) +
                                   static_cast<std::size_t>(from_x));
            for (std::size_t c = 0; c < 3; ++c) turned.pixels[to + c] = picture.pixels[from + c];
        }
    }
    picture = std::move(turned);
}

/// Averages rows of pixels over squares.
class Averager {
public:
    Averager(int width, int height, int channels, int alpha, int factor)
        : width_(width), channels_(channels), alpha_(alpha), factor_(factor) {
        picture_.width = std::max(1, width / factor);
        picture_.height = std::max(1, height / factor);
        picture_.file_width = width;
        picture_.file_height = height;
        picture_.pixels.resize(3 * static_cast<std::size_t>(picture_.width) *
                               static_cast<std::size_t>(picture_.height));
        sums_.resize(3 * static_cast<std::size_t>(picture_.width));
    }
    void row(const std::uint8_t* pixels) {
        const int columns = std::min(width_, picture_.width * factor_);
        for (int x = 0; x < columns; ++x) {
            const std::uint8_t* pixel = pixels + static_cast<std::size_t>(x) * static_cast<std::size_t>(channels_);
            const auto to = 3 * static_cast<std::size_t>(x / factor_);
            const bool is_grey = channels_ < 3;
            // Colours are multiplied by alpha already.
            const std::uint32_t white = alpha_ >= 0 ? 255U - pixel[alpha_] : 0U;
            for (std::size_t c = 0; c < 3; ++c) sums_[to + c] += std::min(255U, pixel[is_grey ? 0 : c] + white);
        }
        ++rows_;
        const int in_square = std::min(factor_, picture_.file_height);
        if (rows_ % in_square != 0 || next_ >= picture_.height) return;
        const auto area = static_cast<std::uint32_t>(in_square * std::min(factor_, width_));
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            picture_.pixels[sums_.size() * static_cast<std::size_t>(next_) + i] =
                static_cast<std::uint8_t>((sums_[i] + area / 2) / area);
            sums_[i] = 0;
        }
        ++next_;
    }
    DecodedPicture take() { return std::move(picture_); }

private:
    int width_, channels_, alpha_, factor_;
    int rows_ = 0, next_ = 0;
    DecodedPicture picture_;
    std::vector<std::uint32_t> sums_;
};

}  // namespace

PictureReader::PictureReader(const std::filesystem::path& path, std::uint64_t most_pixels) {
    if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("not a regular file");
    std::string bytes = read_file(path, path.string(), most_file_bytes);
    if (bytes.size() > most_file_bytes) throw std::runtime_error("the picture is larger than 256 MB");
    BarePicture bare = bare_picture(std::move(bytes), most_pixels);
    orientation_ = bare.orientation;
    input_ = OIIO::ImageInput::create(bare.format);
    if (!input_) {
        OIIO::geterror();
        throw std::runtime_error(std::string("this OpenImageIO does not read ") + bare.format);
    }
    // Readers take a path: that of a file in memory.
    memory_ = memfd_create("picture", MFD_CLOEXEC);
    for (std::size_t at = 0; at < bare.bytes.size();) {
        const ssize_t written = memory_ < 0 ? -1 : ::write(memory_, bare.bytes.data() + at, bare.bytes.size() - at);
        if (written <= 0) throw std::runtime_error("the picture does not fit into memory");
        at += static_cast<std::size_t>(written);
    }
    if (!input_->open(memory_name(), spec_)) fail("the picture is damaged");
    if (spec_.width < 1 || spec_.height < 1 || spec_.depth > 1 || spec_.nchannels < 1 || spec_.nchannels > 5) {
        throw std::runtime_error("not a picture in colour or grey");
    }
    const auto pixels = static_cast<std::uint64_t>(spec_.width) * static_cast<std::uint64_t>(spec_.height);
    if (pixels > most_pixels || pixels * spec_.pixel_bytes(true) > most_bytes) {
        throw std::runtime_error("the picture has " + std::to_string(spec_.width) + " x " +
                                 std::to_string(spec_.height) + " pixels; at most " +
                                 std::to_string(most_pixels / 1'000'000) + " million are read");
    }
    const auto tile = static_cast<std::uint64_t>(std::max(1, spec_.tile_width)) *
                      static_cast<std::uint64_t>(std::max(1, spec_.tile_height));
    if (tile * spec_.pixel_bytes(true) > most_bytes || spec_.tile_depth > 1) {
        throw std::runtime_error("the tiles of the picture are too large");
    }
}

PictureReader::~PictureReader() {
    input_.reset();
    if (memory_ >= 0) ::close(memory_);
}

std::string PictureReader::memory_name() const {
    return "/proc/self/fd/" + std::to_string(memory_);
}

void PictureReader::fail(const std::string& what) {
    std::string message = input_->geterror();
    if (message.empty()) message = OIIO::geterror();
    // Its name means nothing to a reader of the message.
    const std::string name = memory_name();
    if (const std::size_t at = message.find(name); at != std::string::npos) message.replace(at, name.size(), "it");
    for (char& byte : message) {
        if (static_cast<unsigned char>(byte) < ' ') byte = ' ';
    }
    while (!message.empty() && message.back() == ' ') message.pop_back();
    throw std::runtime_error(message.empty() ? what : what + ": " + message);
}

DecodedPicture PictureReader::read(int longest_side, const Monitor& monitor) {
    const int longest = std::max(spec_.width, spec_.height);
    const int factor = std::max(1, (longest + longest_side - 1) / longest_side);
    Averager averager(spec_.width, spec_.height, spec_.nchannels, spec_.alpha_channel, factor);
    const auto stride = static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.nchannels);
    const bool is_tiled = spec_.tile_width > 0;
    const int band = is_tiled ? spec_.tile_height : 64;
    std::vector<std::uint8_t> pixels(stride * static_cast<std::size_t>(std::min(band, spec_.height)));
    const int begin = spec_.y;
    const int end = spec_.y + spec_.height;
    for (int y = begin; y < end; y += band) {
        monitor.check();
        const int stop = std::min(y + band, end);
        const bool is_read =
            is_tiled ? input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, y, stop, spec_.z, spec_.z + 1, 0,
                                          spec_.nchannels, OIIO::TypeDesc::UINT8, pixels.data())
                     : input_->read_scanlines(0, 0, y, stop, spec_.z, 0, spec_.nchannels, OIIO::TypeDesc::UINT8,
                                              pixels.data());
        if (!is_read) fail("the picture is damaged at row " + std::to_string(y - begin + 1));
        for (int row = y; row < stop; ++row) averager.row(pixels.data() + stride * static_cast<std::size_t>(row - y));
    }
    DecodedPicture picture = averager.take();
    turn(picture, orientation_);
    return picture;
}

}  // namespace sikku
