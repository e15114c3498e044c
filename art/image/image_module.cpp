// art/image/image_module.cpp: writes pictures with OpenImageIO. With icc.cpp it is a module of its own, loaded by
// image_file.cpp.
#include "art/image/image_module.h"

#include "art/image/icc.h"
#include "art/image/profiles.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// A file that records its first failure: some format writers ignore the results of writes, and a full disk must not
/// pass for success.
class CheckedFile final : public OIIO::Filesystem::IOProxy {
public:
    explicit CheckedFile(const std::filesystem::path& path)
        : IOProxy(path.string(), Write),
          descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
        if (descriptor_ < 0) throw failure(errno);
        buffer_.reserve(buffer_size);
    }
    ~CheckedFile() override {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    CheckedFile(const CheckedFile&) = delete;
    CheckedFile& operator=(const CheckedFile&) = delete;

    const char* proxytype() const override { return "sikku"; }

    std::size_t write(const void* data, std::size_t size) override {
        const std::scoped_lock lock(mutex_);
        const std::size_t written = append(static_cast<const char*>(data), size, m_pos);
        m_pos += static_cast<std::int64_t>(written);
        return written;
    }
    std::size_t pwrite(const void* data, std::size_t size, std::int64_t offset) override {
        const std::scoped_lock lock(mutex_);
        return append(static_cast<const char*>(data), size, offset);
    }
    std::size_t read(void* data, std::size_t size) override {
        const std::size_t got = pread(data, size, m_pos);
        m_pos += static_cast<std::int64_t>(got);
        return got;
    }
    std::size_t pread(void* data, std::size_t size, std::int64_t offset) override {
        const std::scoped_lock lock(mutex_);
        flush_buffer();
        const ::ssize_t got = ::pread(descriptor_, data, size, offset);
        return got < 0 ? 0 : static_cast<std::size_t>(got);
    }
    std::size_t size() const override { return static_cast<std::size_t>(end_); }

    /// Throws if anything was not written.
    void finish() {
        const std::scoped_lock lock(mutex_);
        flush_buffer();
        if (::close(std::exchange(descriptor_, -1)) != 0 && error_ == 0) error_ = errno;
        if (error_ != 0) throw failure(error_);
    }
    void check() {
        const std::scoped_lock lock(mutex_);
        if (error_ != 0) throw failure(error_);
    }

private:
    static constexpr std::size_t buffer_size = std::size_t{1} << 18;

    static std::runtime_error failure(int error) {
        return std::runtime_error(std::generic_category().message(error));
    }

    // Neighbouring small writes become one.
    std::size_t append(const char* data, std::size_t size, std::int64_t offset) {
        if (offset != buffer_at_ + static_cast<std::int64_t>(buffer_.size()) || buffer_.size() + size > buffer_size) {
            flush_buffer();
            buffer_at_ = offset;
        }
        if (size > buffer_size) {
            put(data, size, offset);
            buffer_at_ = offset + static_cast<std::int64_t>(size);
        } else {
            buffer_.insert(buffer_.end(), data, data + size);
        }
        end_ = std::max(end_, offset + static_cast<std::int64_t>(size));
        return error_ == 0 ? size : 0;
    }
    void flush_buffer() {
        put(buffer_.data(), buffer_.size(), buffer_at_);
        buffer_at_ += static_cast<std::int64_t>(buffer_.size());
        buffer_.clear();
    }
    void put(const char* data, std::size_t size, std::int64_t offset) {
        while (size > 0 && error_ == 0) {
            const ::ssize_t written = ::pwrite(descriptor_, data, size, offset);
            if (written < 0) {
                if (errno != EINTR) error_ = errno;
                continue;
            }
            data += written;
            size -= static_cast<std::size_t>(written);
            offset += written;
        }
    }

    int descriptor_;
    int error_ = 0;
    std::vector<char> buffer_;
    std::int64_t buffer_at_ = 0, end_ = 0;
    std::mutex mutex_;
};

/// A stream into a CheckedFile, for libjpeg by way of OpenImageIO, which serves other proxies from memory, with the
/// whole file at the end. Failures are kept for CheckedFile::finish(), as libjpeg would end the program.
class CheckedStream {
public:
    explicit CheckedStream(CheckedFile& file)
        : stream_(::fopencookie(&file, "w", {nullptr, write, nullptr, nullptr}), &std::fclose) {
        if (!stream_) throw std::runtime_error("no memory for a stream");
        proxy_.emplace(stream_.get(), OIIO::Filesystem::IOProxy::Write);
    }
    OIIO::Filesystem::IOProxy* proxy() { return &*proxy_; }

private:
    static ::ssize_t write(void* file, const char* data, std::size_t size) {
        static_cast<CheckedFile*>(file)->write(data, size);
        return static_cast<::ssize_t>(size);
    }

    std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
    std::optional<OIIO::Filesystem::IOFile> proxy_;
};

/// 8-bit sRGB as linear light, IEC 61966-2-1.
std::array<float, 256> linear_light() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double value = static_cast<double>(i) / 255;
        table[i] = static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return table;
}

// Maximum side: libjpeg ends the program for more.
constexpr int most_jpeg_pixels = 65'500;
// A segment has 65,533 bytes; the numbers beside the texts have 200.
constexpr std::size_t most_jpeg_texts = 65'300;

class FileWriter final : public ImageWriter {
public:
    FileWriter(const std::filesystem::path& path, const ImageSpec& spec);
    void rows(int first_row, int rows, std::span<const std::uint8_t> pixels) override {
        const std::size_t channels = static_cast<std::size_t>(spec_.channels);
        if (spec_.format == "exr") {
            // Linear light, with associated alpha.
            static const std::array<float, 256> linear = linear_light();
            linear_.resize(pixels.size());
            for (std::size_t i = 0; i < pixels.size(); i += channels) {
                const float alpha = channels == 4 ? static_cast<float>(pixels[i + 3]) / 255 : 1;
                for (std::size_t channel = 0; channel < std::min<std::size_t>(channels, 3); ++channel) {
                    linear_[i + channel] = linear[pixels[i + channel]] * alpha;
                }
                if (channels == 4) linear_[i + 3] = alpha;
            }
            write(first_row, rows, OIIO::TypeDesc::FLOAT, linear_.data());
            return;
        }
        if (spec_.bits == 1) {
            const auto on_white = on_paper(pixels);
            converted_.resize(static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(rows));
            if (channels == 1) {
                std::transform(on_white.begin(), on_white.end(), converted_.begin(),
                               [](std::uint8_t grey) { return static_cast<std::uint8_t>(grey < 128 ? 0 : 255); });
            } else {
                // Rec. 709 weights of sRGB values, in which coverage is mixed.
                for (std::size_t i = 0; i < converted_.size(); ++i) {
                    const std::uint8_t* colour = &on_white[3 * i];
                    const int luminance = 2126 * colour[0] + 7152 * colour[1] + 722 * colour[2];
                    converted_[i] = luminance < 128 * 10000 ? 0 : 255;
                }
            }
            write(first_row, rows, OIIO::TypeDesc::UINT8, converted_.data());
            return;
        }
        if (inks_) {
            auto on_white = on_paper(pixels);
            if (channels == 1) {
                flattened_.resize(3 * on_white.size());
                for (std::size_t i = 0; i < on_white.size(); ++i) std::fill_n(&flattened_[3 * i], 3, on_white[i]);
                on_white = flattened_;
            }
            converted_.resize(on_white.size() / 3 * 4);
            inks_->convert(on_white, converted_);
            write(first_row, rows, OIIO::TypeDesc::UINT8, converted_.data());
            return;
        }
        write(first_row, rows, OIIO::TypeDesc::UINT8, (spec_.format == "jpg" ? on_paper(pixels) : pixels).data());
    }
    void close() override {
        if (!output_->close()) fail();
        output_.reset();
        stream_.reset();
        file_.finish();
    }

private:
    [[noreturn]] void fail() {
        std::string message = output_->geterror();
        // The original cause, if known, is more informative than the error of the library.
        file_.check();
        while (!message.empty() && message.back() == '\n') message.pop_back();
        throw std::runtime_error(message.empty() ? "the picture could not be written" : message);
    }
    /// 3 channels, or 1 if there was 1; transparent parts lie on white paper.
    std::span<const std::uint8_t> on_paper(std::span<const std::uint8_t> pixels) {
        if (spec_.channels != 4) return pixels;
        flattened_.clear();
        for (std::size_t i = 0; i < pixels.size(); i += 4) {
            const unsigned alpha = pixels[i + 3];
            for (std::size_t channel = 0; channel < 3; ++channel) {
                flattened_.push_back(
                    static_cast<std::uint8_t>((pixels[i + channel] * alpha + 255 * (255 - alpha) + 127) / 255));
            }
        }
        return flattened_;
    }
    void write(int first_row, int rows, const OIIO::TypeDesc& type, const void* pixels) {
        if (!output_->write_scanlines(first_row, first_row + rows, 0, type, pixels)) fail();
        file_.check();
    }

    ImageSpec spec_;
    CheckedFile file_;
    std::optional<CheckedStream> stream_;
    std::unique_ptr<OIIO::ImageOutput> output_;
    std::optional<InkTransform> inks_;
    std::vector<std::uint8_t> flattened_, converted_;
    std::vector<float> linear_;
};

/// Sets the number of threads of the whole library. It never shrinks, as other pictures may be open. Not thread-safe.
void set_threads(int threads) {
    static int most = 0;
    // TIFF compresses its strips in parallel only if the pool is larger than this.
    threads = std::max(threads, 3);
    if (threads <= most) return;
    most = threads;
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads);
}

FileWriter::FileWriter(const std::filesystem::path& path, const ImageSpec& spec) : spec_(spec), file_(path) {
    const bool tiff = spec.format == "tif", jpeg = spec.format == "jpg", exr = spec.format == "exr";
    if (!tiff && !jpeg && !exr) throw std::runtime_error("unknown picture format: " + spec.format);
    if (jpeg && std::max(spec.width, spec.height) > most_jpeg_pixels) {
        throw std::runtime_error("a JPEG has at most " + std::to_string(most_jpeg_pixels) + " pixels per side");
    }
    if (!tiff && (!spec.cmyk.empty() || spec.bits != 8)) {
        throw std::runtime_error("only TIFF supports CMYK and one bit per channel");
    }
    if (spec.bits != 8 && (spec.bits != 1 || !spec.cmyk.empty())) {
        throw std::runtime_error("expected 8 bits per channel, or 1 without CMYK");
    }
    const bool bitmap = spec.bits == 1;
    if (!spec.cmyk.empty()) inks_.emplace(spec.cmyk);
    // Debian's OpenImageIO would print warnings about attributes.
    OIIO::attribute("debug", 0);
    set_threads(spec.threads);
    output_ = OIIO::ImageOutput::create(tiff ? "tiff" : jpeg ? "jpeg" : "openexr");
    if (!output_) throw std::runtime_error(OIIO::geterror());
    if (jpeg) stream_.emplace(file_);
    if (!output_->supports("ioproxy") || !output_->set_ioproxy(jpeg ? stream_->proxy() : &file_)) {
        throw std::runtime_error("this OpenImageIO cannot write " + spec.format + " through a proxy");
    }

    const int channels = bitmap ? 1 : inks_ ? 4 : jpeg && spec.channels == 4 ? 3 : spec.channels;
    OIIO::ImageSpec image(spec.width, spec.height, channels, exr ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT8);
    if (bitmap) image.attribute("oiio:BitsPerSample", 1);
    if (inks_) {
        image.channelnames = {"C", "M", "Y", "K"};
        image.alpha_channel = -1;
        image.attribute("tiff:ColorSpace", "CMYK");
    }
    if (!exr && !bitmap && spec.icc) {
        const std::string_view usual = channels < 3 ? grey_profile() : srgb_profile();
        const std::vector<std::uint8_t> profile =
            inks_ ? inks_->profile() : std::vector<std::uint8_t>(usual.begin(), usual.end());
        image.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                        profile.data());
    }
    // Not in TIFF, where it becomes an EXIF directory, which this libtiff then puts in the place of the image's.
    if (!tiff) image.attribute("oiio:ColorSpace", exr ? "Linear" : "sRGB");
    if (channels == 4 && !exr && !inks_) image.attribute("oiio:UnassociatedAlpha", 1);
    image.attribute("XResolution", static_cast<float>(spec.dpi));
    image.attribute("YResolution", static_cast<float>(spec.dpi));
    image.attribute("ResolutionUnit", "in");
    // OpenImageIO adds the time of day to TIFF and EXR if it is missing; one that is not a text counts, and is not
    // written.
    if (tiff || exr) image.attribute("DateTime", 0);
    image.attribute("compression", jpeg ? "jpeg:95" : "zip");
    const auto text = [&](const char* name, const std::string& value) {
        if (!value.empty() && keeps_text(spec.format, value)) image.attribute(name, value);
    };
    text("ImageDescription", spec.description);
    // libjpeg ends the program if the two do not fit into one segment.
    if (!jpeg || spec.description.size() + spec.software.size() <= most_jpeg_texts) text("Software", spec.software);
    if (tiff) text("DocumentName", spec.title);
    if (!output_->open(path.string(), image)) fail();
}

/// The library cannot be initialised, or its threads be set, by two threads at once.
std::mutex opening;

std::unique_ptr<ImageWriter> open(const std::filesystem::path& path, const ImageSpec& spec) {
    const std::scoped_lock lock(opening);
    return std::make_unique<FileWriter>(path, spec);
}

void check_cmyk_profile(const std::filesystem::path& file) {
    const InkTransform transform(file);
}

class Inks final : public InkProfile {
public:
    explicit Inks(const std::filesystem::path& file) : transform_(file) {
        if (transform_.is_of_output()) return;
        throw std::runtime_error("the ICC profile '" + file.string() + "': it is not that of an output device");
    }
    const std::vector<std::uint8_t>& bytes() const override { return transform_.profile(); }
    std::string name() const override { return transform_.name().empty() ? "CMYK" : transform_.name(); }
    std::array<double, 4> convert(std::array<std::uint8_t, 3> colour) const override {
        return transform_.convert(colour);
    }

private:
    InkTransform transform_;
};

std::unique_ptr<InkProfile> open_inks(const std::filesystem::path& file) {
    return std::make_unique<Inks>(file);
}

constexpr ImageModule functions{image_module_version(SIKKU_VERSION), open, check_cmyk_profile, open_inks};

}  // namespace
}  // namespace sikku

extern "C" __attribute__((visibility("default"))) const sikku::ImageModule* sikku_image_module() {
    return &sikku::functions;
}
