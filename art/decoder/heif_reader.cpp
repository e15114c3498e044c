// art/decoder/heif_reader.cpp: decodes HEIF and AVIF through libheif.
#include "art/decoder/averager.h"
#include "art/decoder/bare_picture.h"
#include "art/decoder/decoder.h"

#include <libheif/heif.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <stdexcept>

namespace sikku {
namespace {

/// Maximum side; the sides of AV1 and of HEVC at its highest level are smaller.
constexpr int most_side = 65'535;

template <auto release>
struct Releaser {
    template <typename Value>
    void operator()(Value* value) const {
        release(value);
    }
};
using Context = std::unique_ptr<heif_context, Releaser<heif_context_free>>;
using Handle = std::unique_ptr<heif_image_handle, Releaser<heif_image_handle_release>>;
using Image = std::unique_ptr<heif_image, Releaser<heif_image_release>>;
using Options = std::unique_ptr<heif_decoding_options, Releaser<heif_decoding_options_free>>;

void check(const heif_error& error) {
    if (error.code == heif_error_Ok) return;
    const char* const message = error.message ? error.message : "";
    if (error.code == heif_error_Memory_allocation_error && error.subcode != heif_suberror_Security_limit_exceeded) {
        throw std::bad_alloc();
    }
    throw std::runtime_error(std::string("the picture is damaged: ") + message);
}

}  // namespace

void prepare_decoder() {
    heif_init(nullptr);
}

/// The primary picture, turned and cropped as the file states. Trusts the size of the decoded picture, not the
/// size that the file states.
DecodedPicture decode(std::string file, int longest_side, std::uint64_t most_pixels) {
    const Context context(heif_context_alloc());
    if (!context) throw std::bad_alloc();
    heif_context_set_maximum_image_size_limit(context.get(), most_side);
    heif_context_set_max_decoding_threads(context.get(), 0);
    check(heif_context_read_from_memory_without_copy(context.get(), file.data(), file.size(), nullptr));
    heif_image_handle* found = nullptr;
    check(heif_context_get_primary_image_handle(context.get(), &found));
    const Handle handle(found);
    const int width = heif_image_handle_get_width(handle.get());
    const int height = heif_image_handle_get_height(handle.get());
    check_size(static_cast<std::uint64_t>(std::max(width, 0)), static_cast<std::uint64_t>(std::max(height, 0)),
               most_pixels);

    const Options options(heif_decoding_options_alloc());
    if (!options) throw std::bad_alloc();
    options->convert_hdr_to_8bit = 1;
    const bool is_transparent = heif_image_handle_has_alpha_channel(handle.get()) != 0;
    heif_image* decoded = nullptr;
    check(heif_decode_image(handle.get(), &decoded, heif_colorspace_RGB,
                            is_transparent ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB,
                            options.get()));
    const Image image(decoded);
    int stride = 0;
    const std::uint8_t* const pixels = heif_image_get_plane_readonly(image.get(), heif_channel_interleaved, &stride);
    const int channels = is_transparent ? 4 : 3;
    if (!pixels || heif_image_get_width(image.get(), heif_channel_interleaved) < width ||
        heif_image_get_height(image.get(), heif_channel_interleaved) < height || stride < channels * width) {
        throw std::runtime_error("the picture is damaged: it is smaller than the size that it states");
    }
    Averager averager(
        width, height,
        {channels, is_transparent ? 3 : -1, heif_image_handle_is_premultiplied_alpha(handle.get()) != 0},
        longest_side);
    for (int y = 0; y < height; ++y) {
        averager.row(pixels + static_cast<std::size_t>(y) * static_cast<std::size_t>(stride));
    }
    return averager.take(1);
}

}  // namespace sikku
