// engine/tiling/tile_origins.h: where in the derivation the polygons of a word come from.
#pragma once

#include "engine/base/monitor.h"
#include "engine/derivation/origins.h"
#include "engine/language/document.h"
#include "engine/tiling/tiling.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Traces polygons between `{` and `}` back to the axiom.
class TileOrigins {
public:
    /// Null if symbols cannot be traced: see OriginTracer. `document` must outlive it. Cost: the word is walked once;
    /// 8 bytes for each polygon. @throws Stopped
    static std::unique_ptr<TileOrigins> make(const Document& document, const Monitor& monitor);

    /// The symbols that were rewritten on the way from the axiom to a polygon; empty if it is not known.
    /// @param number  of the polygon in drawing order, from 1
    std::vector<PathStep> path(std::uint32_t number) const;
    /// `A 1, B 3`: the symbols of path(), each with its place in the word that contains it. Long paths are cut.
    std::string path_text(std::uint32_t number) const;
    /// The `}` in the pattern that drew a polygon, and path_text(); nullopt if it is not known.
    std::optional<TileOrigin> origin(std::uint32_t number) const;

private:
    explicit TileOrigins(const Document& document) : document_(document), tracer_(document) {}

    const Document& document_;
    OriginTracer tracer_;
    std::vector<std::uint64_t> positions_;  ///< position in the word of the `}` of each polygon; 0: none
};

/// Adds the origins of tiles to the first violations, if they are known. Cost: as TileOrigins::make().
/// @throws Stopped
void find_origins(const Document& document, TilingExamination& examination, const Monitor& monitor);

}  // namespace sikku
