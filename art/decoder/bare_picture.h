// art/decoder/bare_picture.h: strips picture files of data that their decoders do not need.
#pragma once

#include <cstdint>
#include <string>

namespace sikku {

/// A picture file without metadata, and the metadata that are needed.
struct BarePicture {
    const char* format = "";  ///< name of OpenImageIO's reader, or `heif`
    std::string bytes;
    int orientation = 1;  ///< EXIF orientation of a JPEG, 1 to 8
};

/// Removes colour profiles, EXIF, comments and other metadata from JPEG, PNG, WebP and TIFF, whose readers parse them
/// without sufficient checks, and checks the sizes that the file claims before a decoder reserves memory for them: a
/// progressive JPEG holds all its coefficients, and each further scan visits them again. BMP and HEIF are unchanged;
/// the header of BMP is checked. Cost: linear in the file.
/// @throws std::runtime_error for other files, damaged headers, more than `most_pixels`, and too many scans
BarePicture bare_picture(std::string bytes, std::uint64_t most_pixels);

/// @throws std::runtime_error for sides of 0, and for more than `most_pixels`
void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels);

}  // namespace sikku
