// art/image/decoder_answer.h: the protocol between art/image/picture_process.cpp and the programs of art/decoder.
#pragma once

#include "art/image/image_file.h"
#include "art/image/image_module.h"

#include <cstdint>
#include <string_view>

namespace sikku {

/// The programs that decode pictures, one for HEIF and AVIF, one for all others: the libraries of the latter take 0.2
/// s to load.
constexpr const char* decoder_name = "sikku_decoder";
constexpr const char* heif_decoder_name = "sikku_heif_decoder";

/// Arguments of either: decoder_version(), the number of the process that starts it, the longest side, the largest
/// number of pixels. Standard input is the file.
/// The program answers on standard output with one of these bytes and its data:
enum class DecoderAnswer : char {
    ready = 'r',    ///< it is confined and begins; another answer follows
    version = 'v',  ///< it belongs to another version of the libraries
    picture =
        'p',  ///< four numbers of 4 bytes, the least first (width, height, file_width, file_height), then pixels
    refusal = 'e',  ///< a message, up to the end
    memory = 'm',   ///< the limit of memory was reached
};

/// Memory and processor time that decoding may take.
constexpr std::uint64_t most_decoder_memory = 800'000'000;
constexpr std::uint64_t most_decoder_seconds = 60;
/// Maximum bytes of a message.
constexpr std::size_t longest_refusal = 500;

/// Changes with the program's version and the protocol.
constexpr std::uint64_t decoder_version(std::string_view program) {
    return image_module_version(program) ^ 1;
}

}  // namespace sikku
