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

void set_input(z_stream& stream, std::string_view bytes) {
    // zlib does not write to its input.
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
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
    std::string block(block_bytes, '\0');
    set_input(stream, bytes);
    int state = Z_OK;
    while (state == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = deflate(&stream, Z_FINISH);
        packed.append(block, 0, block.size() - stream.avail_out);
    }
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
    std::string block(block_bytes, '\0');
    set_input(stream, packed);
    int state = Z_OK;
    while (state == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = inflate(&stream, Z_NO_FLUSH);
        bytes.append(block, 0, block.size() - stream.avail_out);
        if (bytes.size() > most) throw std::length_error("the compressed text is too long");
    }
    if (state != Z_STREAM_END || stream.avail_in != 0) throw std::runtime_error("the compressed text is damaged");
    return bytes;
}

}  // namespace sikku
