// art/drawing/gif_file.h: writes drawings as the pictures of an animated GIF.
#pragma once

#include "art/drawing/drawing.h"
#include "art/image/image_file.h"
#include "engine/base/output.h"

#include <filesystem>
#include <memory>

namespace sikku {

/// Failures to write are std::runtime_error and name the file.
class GifFile {
public:
    /// All are kept by reference. Page, resolution and texts are those of `print`.
    GifFile(const Print& print, const DrawOptions& options, Output& output, const std::filesystem::path& file);
    /// Adds a placed drawing, on white if its ground is not opaque, with its display time.
    void frame(const Drawing& drawing, const Print& placed, double seconds);
    /// Completes the file, with the recipe of the print.
    void close();

private:
    const Print& print_;
    const DrawOptions& options_;
    Output& output_;
    const std::filesystem::path& file_;
    std::unique_ptr<AnimationWriter> animation_;
};

}  // namespace sikku
