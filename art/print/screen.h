// art/print/screen.h: converts greys to one bit per pixel by threshold, error diffusion or halftone.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// Method for turning greys into black and white.
struct Screen {
    enum class Kind { threshold, diffusion, halftone };
    Kind kind = Kind::threshold;
    double lines = 0.0;  ///< halftone lines per inch; 0: a twelfth of the dpi

    bool operator==(const Screen&) const = default;
};

/// Parses `threshold`, `diffusion`, `halftone` or `halftone,LPI` with 1 to 1000 lines per inch.
/// @throws std::runtime_error for anything else
Screen parse_screen(std::string_view text);

/// Converts a grey picture to black and white, row by row from the top; the result depends on the pixels alone. The
/// share of black is the difference between the grey value and white: presses, which add about a fifth to the middle
/// tones, then print the grey seen on screen. Black and white stay unchanged.
///
/// Diffusion follows Floyd & Steinberg 1976, alternating between left to right and right to left. A halftone has
/// round dots at 45 degrees; their spacing is the whole number of pixels nearest to the requested resolution, and
/// every grey is exact over two dots.
class Screener {
public:
    /// @throws std::runtime_error if a halftone's dots are finer than 2 pixels or coarser than 1000
    Screener(const Screen& screen, int width, double dpi);

    /// Converts the next row to 0 (black) or 255 for each grey. Both rows have the picture's width.
    void row(std::span<const std::uint8_t> greys, std::span<std::uint8_t> result);

private:
    void diffuse(std::span<const std::uint8_t> greys, std::span<std::uint8_t> result);

    Screen::Kind kind_;
    std::uint64_t next_row_ = 0;
    std::vector<int> errors_, next_errors_;  // in sixteenths, with one extra pixel at either end
    std::size_t side_ = 0;                   // side of a tile of two dots, in pixels
    std::vector<std::uint8_t> thresholds_;   // thresholds of the tile: darker greys become black
};

}  // namespace sikku
