// art/image/png_writer.h: writes PNG without OpenImageIO: the same bytes on every machine and in the studio.
#pragma once

#include "art/image/image_file.h"

#include <filesystem>
#include <memory>

namespace sikku {

/// Opens a PNG for writing. Blocks of a million bytes are compressed on the threads of the caller's arena; the bytes
/// do not depend on their number. Memory: some MB for each thread. Source: ISO/IEC 15948 (PNG), sections 5, 9 and 11.
/// @throws std::runtime_error if the file cannot be opened, or for options that PNG does not support
std::unique_ptr<ImageWriter> open_png(const std::filesystem::path& path, const ImageSpec& spec);

}  // namespace sikku
