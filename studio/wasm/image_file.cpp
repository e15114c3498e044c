// studio/wasm/image_file.cpp: writes PNG in the web build, which has no OpenImageIO.
// Source: ISO/IEC 15948 (PNG), sections 5, 9 and 11.
#include "art/image/image_file.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
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
        deflateInit2(&stream_, spec.compression, Z_DEFLATED, 15, 8, Z_FILTERED);
        previous_.resize(stride_);
        filtered_.resize(stride_ + 1);
        best_.resize(stride_ + 1);
    }
    ~PngWriter() override { deflateEnd(&stream_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    void rows(int /*first_row*/, int rows, std::span<const std::uint8_t> pixels) override {
        for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
            const auto line = pixels.subspan(row * stride_, stride_);
            filter(line);
            pack(best_, Z_NO_FLUSH);
            previous_.assign(line.begin(), line.end());
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

    /// Chooses the filter whose differences have the smallest sum: none, left or up. Drawings have large even areas.
    void filter(std::span<const std::uint8_t> line) {
        std::uint64_t least = ~std::uint64_t{0};
        for (std::uint8_t type = 0; type < 3; ++type) {
            filtered_[0] = type;
            std::uint64_t sum = 0;
            for (std::size_t i = 0; i < stride_; ++i) {
                const int left = i >= channels_ ? line[i - channels_] : 0;
                const int other = type == 0 ? 0 : type == 1 ? left : previous_[i];
                filtered_[i + 1] = static_cast<std::uint8_t>(line[i] - other);
                sum += static_cast<std::uint64_t>(std::abs(static_cast<std::int8_t>(filtered_[i + 1])));
            }
            if (sum >= least) continue;
            least = sum;
            std::swap(best_, filtered_);
        }
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
    std::vector<std::uint8_t> previous_, filtered_, best_;
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
