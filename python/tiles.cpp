#include "python/tiles.h"

#include "engine/tiling/tile_growth.h"
#include "engine/tiling/tile_origins.h"
#include "engine/tiling/tiling.h"
#include "engine/tiling/tiling_text.h"
#include "python/errors.h"
#include "python/interruption.h"

#include <pybind11/numpy.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace sikku {
namespace {

struct ExaminedTiles {
    std::string certificate;
    TilingPatch patch;
    std::vector<std::string> letters;  ///< of the symbols that draw the tiles; empty texts if they are not known
};

/// The symbol whose rewriting drew each tile.
std::vector<std::string> letters_of(const Document& document, const TileSet& tiles, const Monitor& monitor) {
    std::vector<std::string> letters(tiles.tiles());
    const auto origins = TileOrigins::make(document, monitor);
    if (!origins) return letters;
    Pulse pulse(monitor);
    for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
        pulse();
        const std::vector<PathStep> path = origins->path(tiles.number[tile]);
        if (!path.empty()) letters[tile] = document.grammar().symbols()[path.back().symbol].letter;
    }
    return letters;
}

template <class Number, class Get>
py::array column(std::uint32_t tiles, const Get& get) {
    py::array_t<Number> result(static_cast<py::ssize_t>(tiles));
    Number* next = result.mutable_data();
    for (std::uint32_t tile = 0; tile < tiles; ++tile) *next++ = static_cast<Number>(get(tile));
    return result;
}

py::tuple corners_of(const TilingPatch& patch) {
    const TileSet& tiles = patch.tiles;
    py::array_t<double> corners({static_cast<py::ssize_t>(tiles.corner.size()), py::ssize_t{2}});
    double* next = corners.mutable_data();
    for (const std::uint32_t point : tiles.corner) {
        const glm::dvec2 at = patch.plane.at(point);
        *next++ = at.x;
        *next++ = at.y;
    }
    const auto begin = [&](std::uint32_t tile) { return tiles.begin[tile]; };
    return py::make_tuple(corners, column<std::int64_t>(tiles.tiles() + 1, begin));
}

/// Each pair of tiles that share a piece of an edge, once.
py::array neighbours_of(const TilingPatch& patch) {
    std::vector<std::int32_t> pairs;
    for (std::uint32_t tile = 0; tile < patch.neighbours.tiles(); ++tile) {
        for (const std::uint32_t other : patch.neighbours.of(tile)) {
            if (tile < other)
                pairs.insert(pairs.end(), {static_cast<std::int32_t>(tile), static_cast<std::int32_t>(other)});
        }
    }
    const std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(pairs.size() / 2), 2};
    return py::array_t<std::int32_t>(shape, pairs.data());
}

}  // namespace

py::tuple tiles_of(const Document& document, double budget) {
    require_turtle(document, "it draws no tiles");
    const ExaminedTiles found = long_call([&](const Monitor& monitor) {
        TilingOptions how;
        how.limits.nodes = budget;
        how.monitor = monitor;
        TilingResult result = examine_tiling(document.grammar(), how);
        find_origins(document, result.examination, monitor);
        std::string certificate =
            tiling_json(document.text("title"), document.grammar().steps(), result, find_growth(document.grammar()));
        std::vector<std::string> letters = letters_of(document, result.patch.tiles, monitor);
        return ExaminedTiles{std::move(certificate), std::move(result.patch), std::move(letters)};
    });
    const TileSet& tiles = found.patch.tiles;
    const std::uint32_t count = tiles.tiles();
    const bool is_coloured = !found.patch.colours.empty();
    py::list letters;
    for (const std::string& letter : found.letters) letters.append(to_text(letter));
    return py::make_tuple(
        to_text(found.certificate), corners_of(found.patch),
        column<std::int64_t>(count, [&](std::uint32_t tile) { return tiles.number[tile]; }),
        column<std::int32_t>(count, [&](std::uint32_t tile) { return tiles.class_of(tile).shape; }),
        column<std::int32_t>(count, [&](std::uint32_t tile) { return tiles.in_class[tile]; }),
        column<std::int32_t>(count, [&](std::uint32_t tile) { return tiles.colour[tile]; }),
        column<bool>(count, [&](std::uint32_t tile) { return tiles.class_of(tile).is_reflected; }), letters,
        neighbours_of(found.patch),
        column<std::int32_t>(is_coloured ? count : 0, [&](std::uint32_t tile) { return found.patch.colours[tile]; }));
}

py::str count_tiles(const Document& document) {
    require_turtle(document, "it draws no tiles");
    return to_text(long_call([&](const Monitor&) {
        return tile_counts_json(document.text("title"), document.grammar().steps(), find_growth(document.grammar()));
    }));
}

}  // namespace sikku
