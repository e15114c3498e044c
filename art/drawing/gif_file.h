// art/drawing/gif_file.h: writes drawings as the pictures of an animated GIF.
#pragma once

#include "art/drawing/drawing.h"
#include "art/image/gif_writer.h"
#include "engine/base/output.h"

#include <filesystem>
#include <optional>

namespace sikku {

/// The options for drawings of frames: reading them reports no progress, only activity.
DrawOptions for_frames(DrawOptions options);

/// Failures to write are std::runtime_error and name the file.
class GifFile {
public:
    /// All are kept by reference. Page, resolution and texts are those of `print`.
    /// @param frames  their number, for the monitor of the options, to which each is reported
    GifFile(const Print& print, const DrawOptions& options, std::size_t frames, Output& output,
            const std::filesystem::path& file);
    /// Adds a placed drawing, on white if its ground is not opaque, with its display time.
    void frame(const Drawing& drawing, const Print& placed, double seconds);
    /// Completes the file, with the recipe of the print.
    void close();

private:
    const Print& print_;
    const DrawOptions& options_;
    const std::filesystem::path& file_;
    std::optional<GifWriter> animation_;
};

}  // namespace sikku
