#include "art/writer/picture.h"

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// Error messages of the library do not name the file.
template <class Action>
auto named(const std::filesystem::path& file, Action&& action) {
    try {
        return action();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("cannot write '" + file.string() + "': " + error.what());
    }
}

}  // namespace

int usual_compression(const Style& style) {
    return style.floor ? 3 : style.hand > 0 ? 4 : 6;
}

Picture::Picture(const Print& print, const DrawOptions& options, int channels, Output& output,
                 std::filesystem::path file)
    : file_(std::move(file)),
      channels_(static_cast<std::size_t>(channels)),
      ground_(print.style.ground.value_or(Colour{255, 255, 255, 0})),
      has_ink_(print.style.shown_floor().has_value()) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    ImageSpec spec;
    spec.format = info(options.format).extension;
    width_ = static_cast<std::size_t>(size.width);
    spec.width = size.width;
    spec.height = size.height;
    spec.channels = channels;
    spec.dpi = print.dpi;
    spec.threads = options.threads;
    spec.compression = options.compression.value_or(6);
    spec.icc = print.press.icc;
    spec.cmyk = print.press.cmyk;
    spec.bits = print.press.bits;
    if (print.press.screen.kind != Screen::Kind::threshold) {
        screener_ = named(file_, [&] { return Screener(print.press.screen, size.width, print.dpi); });
        spec.channels = 1;
    }
    spec.title = print.title;
    spec.description = print.pattern;
    spec.software = print.made;
    image_ = named(file_, [&] { return open_image(output.temporary(), spec); });
}

/// Less than 3 % of the way from white to black is not visible.
void Picture::look(std::span<const std::uint8_t> pixels) {
    constexpr int least = 8;
    const std::array<int, 4> ground = {ground_.red, ground_.green, ground_.blue, ground_.alpha};
    for (std::size_t i = 0; i + channels_ <= pixels.size() && !has_ink_; i += channels_) {
        // Transparent pixels have no colour.
        const bool is_clear = channels_ == 4 && pixels[i + 3] < least;
        for (std::size_t channel = is_clear ? 3 : 0; channel < channels_; ++channel) {
            has_ink_ = has_ink_ || std::abs(pixels[i + channel] - ground[channel]) >= least;
        }
    }
}

/// One channel of black and white; transparent pixels lie on white.
std::span<const std::uint8_t> Picture::screened(int rows, std::span<const std::uint8_t> pixels) {
    const auto count = static_cast<std::size_t>(rows) * width_;
    greys_.resize(count);
    screened_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* pixel = &pixels[i * channels_];
        // Rec. 709 weights of sRGB values, in which coverage is mixed.
        const unsigned grey =
            channels_ == 1 ? pixel[0] : (2126U * pixel[0] + 7152U * pixel[1] + 722U * pixel[2] + 5000U) / 10000U;
        const unsigned alpha = channels_ == 4 ? pixel[3] : 255U;
        greys_[i] = static_cast<std::uint8_t>((grey * alpha + 255U * (255U - alpha) + 127U) / 255U);
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
        screener_->row(std::span(greys_).subspan(row * width_, width_),
                       std::span(screened_).subspan(row * width_, width_));
    }
    return screened_;
}

void Picture::rows(int first_row, int rows, std::span<const std::uint8_t> pixels) {
    if (!has_ink_) look(pixels);
    if (screener_) pixels = screened(rows, pixels);
    named(file_, [&] { image_->rows(first_row, rows, pixels); });
}

void Picture::close() {
    named(file_, [&] { image_->close(); });
}

bool write_picture(Rendering& rendering, const Print& print, const DrawOptions& options, Output& output,
                   const std::filesystem::path& file) {
    Picture picture(print, options, rendering.channels(), output, file);
    const auto watch = [&] {
        if (options.watch) options.watch(0);
    };
    rendering.watch(watch);
    rendering.render(options.threads, [&](int first_row, int rows, std::span<const std::uint8_t> pixels) {
        watch();
        picture.rows(first_row, rows, pixels);
    });
    picture.close();
    return picture.is_blank();
}

}  // namespace sikku
