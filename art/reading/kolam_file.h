// art/reading/kolam_file.h: reads a kolam from a file of any format, and writes it back.
#pragma once

#include "art/reading/gesture_drawing.h"
#include "art/reading/photograph.h"
#include "art/reading/read_kolam.h"
#include "engine/language/document.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

struct KolamFileOptions {
    std::size_t number = 1;  ///< number of the kolam in a table
    std::optional<DotLattice> lattice =
        {};                            ///< lattice of drawings and photographs; absent: the one that fits better
    bool repair = true;                ///< repair doubtful gaps of photographs by symmetry
    std::optional<DotGrid> grid = {};  ///< the dots that the kolam of a photograph has
    std::optional<PictureRegion> region = {};  ///< the part of a photograph that is read
    std::vector<std::string> fixes = {};       ///< changes by hand, as in fix_gaps()
};

/// Reads a text in the format that it resembles: `.kolam.json`, CSV of one-stroke kolams, SVG, or gestures.
/// @return nullopt if it does not resemble any of them
/// @throws std::runtime_error if it is damaged, or not a kolam
std::optional<ReadKolam> read_kolam_text(const std::string& text, const KolamFileOptions& options = {},
                                         const Monitor& monitor = {});

/// Reads gestures that a grid of gaps cannot represent, because lines meet in the middle of four dots.
/// @return nullopt for all other texts @throws std::runtime_error if the gestures are damaged
std::optional<GestureDrawing> read_gesture_drawing(const std::string& text);

/// Reads the kolam that a pattern draws, from its lines. The grid and the gaps that the program writes into patterns
/// are used where the lines agree with them; otherwise the dots are placed as tradition does.
/// @throws PatternError, BudgetError, WordError, Stopped; std::runtime_error if no lattice of dots fits
ReadKolam read_kolam_document(const Document& document, double budget, const Monitor& monitor = {});

/// Writes a kolam in the format of an extension: `json`, `csv`, `yaml` or `yml` (gestures).
/// @return nullopt for other extensions
/// @throws std::runtime_error if the format cannot represent it
std::optional<std::string> kolam_file_text(std::string_view extension, const DotGrid& grid, const GapStates& states,
                                           const Monitor& monitor = {});

}  // namespace sikku
