// art/image/picture_reader.h: reads a picture through OpenImageIO. Part of the module with it.
#pragma once

#include "art/image/image_file.h"
#include "engine/base/monitor.h"

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace sikku {

/// An opened picture, with the sizes that it claims checked.
class PictureReader {
public:
    /// @throws std::runtime_error as read_picture()
    PictureReader(const std::filesystem::path& path, std::uint64_t most_pixels);
    ~PictureReader();
    PictureReader(const PictureReader&) = delete;
    PictureReader& operator=(const PictureReader&) = delete;
    DecodedPicture read(int longest_side, const Monitor& monitor);

private:
    std::string memory_name() const;
    [[noreturn]] void fail(const std::string& what);
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
    int orientation_ = 1;
    int memory_ = -1;  ///< descriptor of the file in memory
};

}  // namespace sikku
