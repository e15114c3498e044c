// tests/fuzz/picture_targets.h: fuzz target for photographs: parses picture files, and reads kolams from small
// pictures.
#pragma once

#include "art/decoder/averager.h"
#include "art/decoder/bare_picture.h"
#include "art/reading/photograph.h"
#include "tests/fuzz/file_targets.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sikku {

/// Strips a file: the result has the same format, and can be stripped again.
inline void try_bare_picture(std::string_view bytes) {
    constexpr std::uint64_t most_pixels = 1'000'000;
    BarePicture bare;
    try {
        bare = bare_picture(std::string(bytes), most_pixels);
    } catch (const std::runtime_error& error) {
        must_be_plain(error.what(), "an error");
        return;
    }
    must(bare.orientation >= 1 && bare.orientation <= 8, "an orientation that does not exist");
    // A palette that names too few colours is completed.
    must(bare.bytes.size() <= bytes.size() + 1000, "a bare picture is longer than its file");
    // The tags of a TIFF may lie over each other.
    if (bare.format == std::string_view("tiff")) return;
    const BarePicture again = bare_picture(bare.bytes, most_pixels);
    must(again.format == std::string_view(bare.format), "a bare picture is of another format");
    must(again.bytes == bare.bytes, "a bare picture is not bare");
}

/// Reads a kolam from grey pixels. `bytes`: the width, from 1, then rows of pixels, each of which is drawn three
/// times as large.
inline void try_photograph(std::string_view bytes) {
    constexpr std::size_t scale = 3;
    if (bytes.size() < 2) return;
    const std::size_t columns = 1 + static_cast<unsigned char>(bytes[0]);
    const std::string_view pixels = bytes.substr(1);
    const std::size_t rows = pixels.size() / columns;
    if (rows == 0) return;
    const int width = static_cast<int>(scale * columns);
    const int height = static_cast<int>(scale * rows);
    const auto decode = [&](int longest_side) {
        Averager averager(width, height, {1, -1}, longest_side);
        std::string row(static_cast<std::size_t>(width), '\0');
        for (std::size_t y = 0; y < scale * rows; ++y) {
            for (std::size_t x = 0; x < row.size(); ++x) row[x] = pixels[y / scale * columns + x / scale];
            averager.row(reinterpret_cast<const std::uint8_t*>(row.data()));
        }
        return averager.take(1 + static_cast<int>(pixels.size() % 8));
    };
    try {
        const Photograph photograph = read_photograph(PictureDecoder(decode));
        const ReadKolam& kolam = photograph.kolam;
        must(kolam.states.size() == kolam.grid.gaps().size(), "a gap has no state");
        must(kolam.certainty.size() == kolam.states.size(), "a gap has no certainty");
        for (const std::string& note : kolam.notes) must_be_plain(note, "a note");
    } catch (const std::runtime_error& error) {
        must_be_plain(error.what(), "an error");
    }
}

/// Files that begin with `P` are pixels of try_photograph(); no format of pictures begins so.
inline void try_picture(std::string_view bytes) {
    if (bytes.starts_with('P')) return try_photograph(bytes.substr(1));
    try_bare_picture(bytes);
}

}  // namespace sikku
