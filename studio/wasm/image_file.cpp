// studio/wasm/image_file.cpp: writes PNG in the web build, without OpenImageIO.
// Source: ISO/IEC 15948 (PNG), sections 5, 9 and 11.
#include "art/image/image_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 18;

[[noreturn]] void refuse() {
    throw std::runtime_error("the studio writes pictures only as PNG; `sikku draw` writes the other formats");
}

void append_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
}

class PngWriter : public ImageWriter {
public:
    PngWriter(const std::filesystem::path& path, const ImageSpec& spec)
        : file_(std::fopen(path.c_str(), "wb"), &std::fclose),
          stride_(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.channels)),
          channels_(static_cast<std::size_t>(spec.channels)),
          packed_(buffer_bytes, '\0') {
        if (!file_) throw std::runtime_error("no file can be opened");
        write("\x89PNG\r\n\x1A\n");
        std::string header;
        append_number(header, static_cast<std::uint32_t>(spec.width));
        append_number(header, static_cast<std::uint32_t>(spec.height));
        constexpr std::array<char, 5> colour_types = {0, 0, 0, 2, 6};
        header += {8, colour_types[channels_], 0, 0, 0};
        chunk("IHDR", header);
        chunk("sRGB", std::string(1, '\0'));
        std::string density;
        const auto per_metre = static_cast<std::uint32_t>(std::lround(spec.dpi / 0.0254));
        append_number(density, per_metre);
        append_number(density, per_metre);
        chunk("pHYs", density + '\1');
        text("Title", spec.title);
        text("Description", spec.description);
        text("Software", spec.software);
        deflateInit2(&stream_, spec.compression, Z_DEFLATED, 15, 8, Z_DEFAULT_STRATEGY);
        filtered_.resize(stride_ + 1);
    }
    ~PngWriter() override { deflateEnd(&stream_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    void rows(int /*first_row*/, int rows, std::span<const std::uint8_t> pixels) override {
        for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
            // Without filters, as OpenImageIO writes: drawings repeat pixels, and filters make them a quarter larger.
            const auto line = pixels.subspan(row * stride_, stride_);
            std::copy(line.begin(), line.end(), filtered_.begin() + 1);
            pack(filtered_, Z_NO_FLUSH);
        }
    }

    void close() override {
        pack({}, Z_FINISH);
        chunk("IEND", {});
        if (std::fclose(file_.release()) != 0) throw std::runtime_error("the file cannot be written");
    }

private:
    void write(std::string_view bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) {
            throw std::runtime_error("the file cannot be written");
        }
    }

    void chunk(std::string_view type, std::string_view content) {
        std::string length;
        append_number(length, static_cast<std::uint32_t>(content.size()));
        const std::string body = std::string(type) + std::string(content);
        std::string sum;
        append_number(sum, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                                            static_cast<uInt>(body.size()))));
        write(length + body + sum);
    }

    /// An iTXt chunk: uncompressed text in UTF-8.
    void text(const std::string& keyword, const std::string& value) {
        if (!value.empty()) chunk("iTXt", keyword + std::string(5, '\0') + value);
    }

    void pack(std::span<const std::uint8_t> bytes, int flush) {
        stream_.next_in = bytes.data();
        stream_.avail_in = static_cast<uInt>(bytes.size());
        do {
            stream_.next_out = reinterpret_cast<Bytef*>(packed_.data());
            stream_.avail_out = static_cast<uInt>(packed_.size());
            deflate(&stream_, flush);
            const std::size_t size = packed_.size() - stream_.avail_out;
            if (size > 0) chunk("IDAT", std::string_view(packed_).substr(0, size));
        } while (stream_.avail_out == 0);
    }

    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    std::size_t stride_, channels_;
    z_stream stream_{};
    std::string packed_;
    std::vector<std::uint8_t> filtered_;  ///< a row after the number of its filter, 0
};

}  // namespace

void prepare_images(int /*threads*/) {}

std::unique_ptr<ImageWriter> open_image(const std::filesystem::path& path, const ImageSpec& spec) {
    if (spec.format != "png" || spec.bits != 8 || !spec.cmyk.empty()) refuse();
    return std::make_unique<PngWriter>(path, spec);
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
    throw std::runtime_error("the studio reads no photographs; `sikku kolam --read` does");
}

}  // namespace sikku
