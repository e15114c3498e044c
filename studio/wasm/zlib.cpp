#include <zlib.h>

#include <emscripten.h>

#include <cstdint>

// clang-format off
EM_JS(int, zlib_open, (bool is_deflate, int level, int window_bits, int memory_level, int strategy), {
    return Module["zlib"].open(is_deflate, level, window_bits, memory_level, strategy);
});
EM_JS(int, zlib_run, (int handle, const void* from, int from_size, void* to, int to_size, int flush, void* left), {
    const result = Module["zlib"].run(handle, HEAPU8.subarray(from, from + from_size), HEAPU8.subarray(to, to + to_size),
                                      flush);
    HEAPU32[left >> 2] = result.input;
    HEAPU32[(left >> 2) + 1] = result.output;
    return result.state;
});
EM_JS(int, zlib_reset, (int handle), { return Module["zlib"].reset(handle); });
EM_JS(void, zlib_close, (int handle), { Module["zlib"].close(handle); });
EM_JS(double, zlib_checksum, (bool is_crc, double checksum, const void* bytes, int count), {
    return Module["zlib"].checksum(is_crc, checksum, HEAPU8.subarray(bytes, bytes + count));
});
// clang-format on

namespace {

int run(z_stream* stream, int flush) {
    std::uint32_t left[2] = {};  // bytes of input and of output space left
    const int state = zlib_run(stream->handle, stream->next_in, static_cast<int>(stream->avail_in), stream->next_out,
                               static_cast<int>(stream->avail_out), flush, left);
    stream->next_in += stream->avail_in - left[0];
    stream->next_out += stream->avail_out - left[1];
    stream->avail_in = left[0];
    stream->avail_out = left[1];
    return state;
}

constexpr int default_window_bits = 15;

}  // namespace

int deflateInit2(z_stream* stream, int level, int /*method*/, int window_bits, int memory_level, int strategy) {
    stream->handle = zlib_open(true, level, window_bits, memory_level, strategy);
    return Z_OK;
}

int deflateReset(z_stream* stream) {
    return zlib_reset(stream->handle);
}

int deflate(z_stream* stream, int flush) {
    return run(stream, flush);
}

int deflateEnd(z_stream* stream) {
    zlib_close(stream->handle);
    return Z_OK;
}

int inflateInit(z_stream* stream) {
    return inflateInit2(stream, default_window_bits);
}

int inflateInit2(z_stream* stream, int window_bits) {
    stream->handle = zlib_open(false, 0, window_bits, 0, 0);
    return Z_OK;
}

int inflate(z_stream* stream, int flush) {
    return run(stream, flush);
}

int inflateEnd(z_stream* stream) {
    zlib_close(stream->handle);
    return Z_OK;
}

uLong adler32_z(uLong checksum, const Bytef* bytes, std::size_t count) {
    return static_cast<uLong>(zlib_checksum(false, static_cast<double>(checksum), bytes, static_cast<int>(count)));
}

uLong crc32(uLong checksum, const Bytef* bytes, uInt count) {
    return static_cast<uLong>(zlib_checksum(true, static_cast<double>(checksum), bytes, static_cast<int>(count)));
}
