// cli/piece_options.h: the options of `sikku tiling` for cutting the pieces of a tiling.
#pragma once

#include "cli/command.h"
#include "cli/options.h"
#include "engine/tiling/tiling.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sikku {

struct PieceOptions {
    bool lists = false;
    std::string templates;  ///< seam allowance of templates; empty: none
    std::string sheet;      ///< size of cutting sheets; empty: none
    std::string step = "10mm";
    std::string seam = "0mm";
    std::string kerf = "0mm";
    std::string gap = "0mm";
    std::string margin = "10mm";
    bool grain = false;
    bool labels = true;
    std::string output;
    TableOptions print;  ///< options of plotters and pictures

    bool draws() const { return !templates.empty() || !sheet.empty(); }
    bool any() const { return lists || draws(); }
};

/// The source of the pieces.
struct PieceSource {
    std::string title;
    std::optional<std::int64_t> n;  ///< derivation length, if there is one
    std::string pattern;            ///< text of the pattern file
    std::function<std::string(std::int32_t)> colour_name;
};

void add_piece_options(CLI::App& command, PieceOptions& options);

/// Checks the options as far as possible before anything is derived. @throws UsageError, SettingError
void check_piece_options(const CLI::App& command, const PieceOptions& options);

/// Prints the list of pieces, or draws their templates or cutting sheets.
/// @throws UsageError, SettingError; std::runtime_error
void cut_pieces(const PieceOptions& options, const PieceSource& source, const TilingResult& result, bool as_json,
                const Monitor& monitor, bool quiet);

/// Colours tiles by `tile colours:` of a pattern, and returns names of the colours.
/// @throws as a print of the pattern
std::function<std::string(std::int32_t)> colour_as_drawn(const Document& document, TilingResult& result,
                                                         double budget, const Monitor& monitor);

}  // namespace sikku
