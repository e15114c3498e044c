// studio/wasm/include/zlib.h: the parts of zlib that the libraries use, implemented by pako, a port of zlib to
// JavaScript that writes the same bytes: see studio/npm/zlib.ts.
#pragma once

#include <cstddef>

extern "C" {

using Bytef = unsigned char;
using uInt = unsigned int;
using uLong = unsigned long;

struct z_stream {
    const Bytef* next_in;
    uInt avail_in;
    Bytef* next_out;
    uInt avail_out;
    int handle;  ///< number of the stream in JavaScript
};

enum { Z_NO_FLUSH = 0, Z_FULL_FLUSH = 3, Z_FINISH = 4 };
enum { Z_OK = 0, Z_STREAM_END = 1, Z_STREAM_ERROR = -2 };
enum { Z_DEFLATED = 8, Z_DEFAULT_STRATEGY = 0 };

int deflateInit2(z_stream* stream, int level, int method, int window_bits, int memory_level, int strategy);
int deflateReset(z_stream* stream);
int deflate(z_stream* stream, int flush);
int deflateEnd(z_stream* stream);
int inflateInit(z_stream* stream);
int inflateInit2(z_stream* stream, int window_bits);
int inflate(z_stream* stream, int flush);
int inflateEnd(z_stream* stream);
uLong adler32_z(uLong checksum, const Bytef* bytes, std::size_t count);
uLong crc32(uLong checksum, const Bytef* bytes, uInt count);

}  // extern "C"
