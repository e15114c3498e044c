// art/picture.h: the pixels of a print on their way into a file.
#pragma once

#include "art/draw.h"
#include "art/image_file.h"
#include "art/output_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace sikku {

/// Failures are std::runtime_error and name the file.
class Picture {
public:
    Picture(const Print& print, const DrawOptions& options, int channels, OutputFile& output,
            std::filesystem::path file);
    void rows(int first_row, int rows, std::span<const std::uint8_t> pixels);
    void close();

private:
    std::filesystem::path file_;
    std::unique_ptr<ImageWriter> image_;
};

}  // namespace sikku
