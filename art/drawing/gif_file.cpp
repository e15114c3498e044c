#include "art/drawing/gif_file.h"

#include "art/print/recipe_comments.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {
namespace {

/// Adds the recipe as a comment before the trailer of a GIF file. Source: GIF 89a, section 24.
void add_recipe(const std::filesystem::path& file, const Print& print) {
    const std::vector<std::string> pieces = recipe_comments(print.pattern, print.made);
    if (pieces.empty()) return;
    std::string comment = "\x21\xFE";
    for (const std::string& piece : pieces) {
        comment += static_cast<char>(piece.size() + 1);
        comment += piece + "\n";
    }
    comment += '\0';
    comment += ';';
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(-1, std::ios::end);
    if (stream.get() != ';') throw std::runtime_error("the animation has no trailer");
    stream.seekp(-1, std::ios::end);
    stream.write(comment.data(), static_cast<std::streamsize>(comment.size()));
    stream.close();
    if (!stream) throw std::runtime_error("the recipe cannot be added");
}

template <class Action>
void named(const std::filesystem::path& file, Action&& action) {
    try {
        action();
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("cannot write '" + file.string() + "': " + error.what());
    }
}

}  // namespace

GifFile::GifFile(const Print& print, const DrawOptions& options, Output& output, const std::filesystem::path& file)
    : print_(print), options_(options), output_(output), file_(file) {
    const PixelSize size = pixel_size(print.page, print.dpi);
    named(file_, [&] { animation_ = open_animation(output_.temporary(), size.width, size.height); });
}

void GifFile::frame(const Drawing& drawing, const Print& placed, double seconds) {
    Print print = placed;
    print.style.ground = print.style.ground.value_or(Colour{255, 255, 255, 255});
    print.style.ground->alpha = 255;
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
    named(file_, [&] { animation_->frame(pixels, seconds); });
}

void GifFile::close() {
    named(file_, [&] {
        animation_->close();
        add_recipe(output_.temporary(), print_);
    });
}

}  // namespace sikku
