#include "art/motion/gif_file.h"

#include "art/print/recipe_comments.h"
#include "art/raster/raster.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

template <class Action>
void named(const std::filesystem::path& file, Action&& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("cannot write '" + file.string() + "': " + error.what());
    }
}

}  // namespace

DrawOptions for_frames(DrawOptions options) {
    options.begin = nullptr;
    if (options.watch) options.watch = [watch = std::move(options.watch)](std::uint64_t) { watch(0); };
    return options;
}

GifFile::GifFile(const Print& print, const DrawOptions& options, std::size_t frames, Output& output,
                 const std::filesystem::path& file)
    : print_(print), options_(options), file_(file) {
    options.monitor.expect(static_cast<double>(frames));
    const PixelSize size = pixel_size(print.page, print.dpi);
    named(file_, [&] { animation_.emplace(output, size.width, size.height); });
}

void GifFile::frame(const Drawing& drawing, const Print& placed, double seconds) {
    Print print = placed;
    print.style.ground = print.style.ground.value_or(Colour{255, 255, 255, 255});
    print.style.ground->alpha = 255;
    print.style.floor.reset();  // 256 colours are too few
    const PixelSize size = pixel_size(print.page, print.dpi);
    const auto rendering = drawing.rendering(print);
    const auto channels = static_cast<std::size_t>(rendering->channels());
    std::vector<std::uint8_t> pixels;
    pixels.reserve(std::size_t(size.width) * std::size_t(size.height) * 3);
    rendering->render(options_.threads, [&](int, int, std::span<const std::uint8_t> rows) {
        if (options_.watch) options_.watch(0);
        for (std::size_t i = 0; i + channels <= rows.size(); i += channels) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                pixels.push_back(rows[i + (channels < 3 ? 0 : channel)]);
            }
        }
    });
    animation_->frame(pixels, seconds);
    options_.monitor.advance(1);
}

void GifFile::close() {
    std::vector<std::string> recipe = recipe_comments(print_.pattern, print_.made);
    for (std::string& piece : recipe) piece += '\n';
    animation_->comment(recipe);
    animation_->close();
}

}  // namespace sikku
