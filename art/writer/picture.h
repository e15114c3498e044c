// art/writer/picture.h: writes the pixels of a print into picture files.
#pragma once

#include "art/image/image_file.h"
#include "art/print/screen.h"
#include "art/raster/raster.h"
#include "art/writer/draw_options.h"
#include "engine/base/output.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace sikku {

/// PNG compression unless it is requested: grain compresses slowly, and hardly better at higher levels.
int usual_compression(const Style& style);

/// Writes one picture file. Failures throw std::runtime_error and name the file.
class Picture {
public:
    Picture(const Print& print, const DrawOptions& options, int channels, Output& output, std::filesystem::path file);
    void rows(int first_row, int rows, std::span<const std::uint8_t> pixels);
    void close();
    /// True if no pixel can be distinguished from the ground; false on a floor. Call after the last row.
    bool is_blank() const { return !has_ink_; }

private:
    void look(std::span<const std::uint8_t> pixels);
    std::span<const std::uint8_t> screened(int rows, std::span<const std::uint8_t> pixels);

    std::filesystem::path file_;
    std::size_t channels_;
    std::size_t width_;
    Colour ground_;
    bool has_ink_ = false;
    std::optional<Screener> screener_;
    std::vector<std::uint8_t> greys_, screened_;
    std::unique_ptr<ImageWriter> image_;
};

/// Renders a whole picture into `output`. @return true if nothing of the drawing is visible
bool write_picture(Rendering& rendering, const Print& print, const DrawOptions& options, Output& output,
                   const std::filesystem::path& file);

}  // namespace sikku
