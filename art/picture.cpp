#include "art/picture.h"

#include "art/raster.h"

#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// What the library says of a failure does not name the file.
template <class Action>
auto named(const std::filesystem::path& file, Action&& action) {
    try {
        return action();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("cannot write '" + file.string() + "': " + error.what());
    }
}

}  // namespace

Picture::Picture(const Print& print, const DrawOptions& options, int channels, OutputFile& output,
                 std::filesystem::path file)
    : file_(std::move(file)) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    ImageSpec spec;
    spec.format = image_format(options.format);
    spec.width = size.width;
    spec.height = size.height;
    spec.channels = channels;
    spec.dpi = print.dpi;
    spec.threads = options.threads;
    spec.compression = options.compression;
    spec.icc = print.press.icc;
    spec.cmyk = print.press.cmyk;
    spec.bits = print.press.bits;
    spec.title = print.title;
    spec.description = print.pattern;
    spec.software = print.made;
    image_ = named(file_, [&] { return open_image(output.temporary(), spec); });
}

void Picture::rows(int first_row, int rows, std::span<const std::uint8_t> pixels) {
    named(file_, [&] { image_->rows(first_row, rows, pixels); });
}

void Picture::close() {
    named(file_, [&] { image_->close(); });
}

}  // namespace sikku
