#include "engine/base/deflate.h"

#include <zlib.h>

#include <new>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16;

int window_bits(Deflate format) {
    return format == Deflate::raw ? -15 : 15;
}

/// Passes bytes through deflate() or inflate(), and their results to `take`. Returns the last state.
template <class Take>
int pass(z_stream& stream, std::string_view bytes, int (*step)(z_stream*, int), int flush, Take take) {
    std::string block(block_bytes, '\0');
    // zlib does not write to its input.
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    int state = Z_OK;
    while (state == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = step(&stream, flush);
        take(std::string_view(block).substr(0, block.size() - stream.avail_out));
    }
    return state;
}

}  // namespace

std::string deflated(std::string_view bytes, Deflate format) {
    constexpr int best_level = 9;
    const int memory = format == Deflate::raw ? 9 : 8;
    z_stream stream{};
    if (deflateInit2(&stream, best_level, Z_DEFLATED, window_bits(format), memory, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();
    }
    std::string packed;
    const int state = pass(stream, bytes, deflate, Z_FINISH, [&](std::string_view block) { packed += block; });
    deflateEnd(&stream);
    if (state != Z_STREAM_END) throw std::bad_alloc();
    return packed;
}

std::string inflated(std::string_view packed, Deflate format, std::size_t most) {
    struct Inflater : z_stream {
        explicit Inflater(int bits) : z_stream{} {
            if (inflateInit2(this, bits) != Z_OK) throw std::bad_alloc();
        }
        ~Inflater() { inflateEnd(this); }
        Inflater(const Inflater&) = delete;
        Inflater& operator=(const Inflater&) = delete;
    } stream(window_bits(format));
    std::string bytes;
    const int state = pass(stream, packed, inflate, Z_NO_FLUSH, [&](std::string_view block) {
        bytes += block;
        if (bytes.size() > most) throw std::length_error("the compressed text is too long");
    });
    if (state != Z_STREAM_END || stream.avail_in != 0) throw std::runtime_error("the compressed text is damaged");
    return bytes;
}

}  // namespace sikku
