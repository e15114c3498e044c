// art/motion/gif_file.h: writes drawings as the pictures of an animated GIF.
#pragma once

#include "art/drawing/drawing.h"
#include "art/image/gif_writer.h"
#include "art/writer/draw_options.h"
#include "engine/base/output.h"

#include <filesystem>
#include <optional>

namespace sikku {

/// The options for drawings of frames: reading them reports no progress, only activity.
DrawOptions for_frames(DrawOptions options);

/// Writes frames into an animated GIF. Failures to write throw std::runtime_error and name the file.
class GifFile {
public:
    /// All arguments are kept by reference. Page, resolution and texts are those of `print`.
    /// @param frames  number of frames, each of which is reported to the monitor of the options
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
