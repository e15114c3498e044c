// art/decoder/decoder.h: the interface that each of the two programs that decode pictures implements:
// picture_reader.cpp or heif_reader.cpp.
#pragma once

#include "art/image/image_file.h"

#include <cstdint>
#include <string>

namespace sikku {

/// Loads all files that the library needs, and prevents it from starting threads. Call first.
void prepare_decoder();

/// Decodes the first picture of a file.
/// @throws std::runtime_error if it is damaged, is not a picture that this program reads, or has more than
/// `most_pixels`
DecodedPicture decode(std::string file, int longest_side, std::uint64_t most_pixels);

}  // namespace sikku
