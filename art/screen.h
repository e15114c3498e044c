// art/screen.h: grey in one bit a pixel: a threshold, error diffusion, or the dots of a halftone.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace sikku {

/// How greys become black and white.
struct Screen {
    enum class Kind { threshold, diffusion, halftone };
    Kind kind = Kind::threshold;
    double lines = 0.0;  ///< of a halftone, an inch; 0: a twelfth of the dpi

    bool operator==(const Screen&) const = default;
};

/// `threshold`, `diffusion`, `halftone` or `halftone,LPI` with 1 to 1000 lines an inch.
/// @throws std::runtime_error for anything else
Screen parse_screen(std::string_view text);

/// Turns a picture of greys into one of black and white, row by row from the top; the result depends on the pixels
/// alone. The share of black is that by which the grey's value falls short of white: presses, which add about a fifth
/// to the middle tones, then print the grey that is seen on screen. Black and white stay as they are.
///
/// Diffusion is that of Floyd & Steinberg 1976, from left to right and back in turn. A halftone has round dots at 45
/// degrees, of as many pixels as come nearest to the lines asked for; every grey is right over two dots.
class Screener {
public:
    /// @throws std::runtime_error if a halftone's dots are finer than 2 pixels or coarser than 1000
    Screener(const Screen& screen, int width, double dpi);

    /// The next row: 0 (black) or 255 for each grey. Both have the picture's width.
    void row(std::span<const std::uint8_t> greys, std::span<std::uint8_t> result);

private:
    void diffuse(std::span<const std::uint8_t> greys, std::span<std::uint8_t> result);

    Screen::Kind kind_;
    std::uint64_t next_row_ = 0;
    std::vector<int> errors_, next_errors_;  // in sixteenths, with a pixel beyond either end
    std::size_t side_ = 0;                   // of a tile of two dots, in pixels
    std::vector<std::uint8_t> thresholds_;   // of the tile: darker greys become black
};

}  // namespace sikku
