// art/reading/kolam_report.h: reads a kolam from any file, checks it, and writes it as a pattern and as JSON.
#pragma once

#include "art/kolam/dot_grid_symmetry.h"
#include "art/reading/kolam_file.h"
#include "art/reading/photograph.h"
#include "art/reading/read_kolam.h"
#include "engine/base/monitor.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace sikku {

/// Size of texts with kolams: tables of a hundred large ones have 30 MB.
constexpr std::size_t most_kolam_text = std::size_t{64} << 20U;

/// The kolam of a file, and the photograph if it is one.
struct FoundKolam {
    ReadKolam kolam;
    std::optional<Photograph> photograph;
};

/// Reads a kolam from a photograph, a .kolam.json, a CSV of one-stroke kolams, an SVG, gestures or a pattern.
/// @param name    of the file, for messages
/// @param budget  maximum number of derivation nodes visited, for a pattern
/// @throws NoKolam, without the name, for a photograph without one; FixError; PatternError, BudgetError, WordError,
/// Stopped; std::runtime_error, which begins with the name, if the file cannot be read, or is not a photograph, which
/// an expected grid and a region need
FoundKolam read_kolam_file(const std::filesystem::path& file, const std::string& name,
                           const KolamFileOptions& options, double budget, const Monitor& monitor);

/// Facts about a kolam that was read.
struct KolamReport {
    std::size_t lines = 0;
    std::string gaps;  ///< `12 of 20 gaps crossed`
    GridSymmetry symmetry = GridSymmetry::none;
};

/// Counts the lines, in two ways unless the second would take long, and finds the symmetry. @throws Stopped
KolamReport report_kolam(const ReadKolam& kolam, const Monitor& monitor);

/// `9 dots, 12 of 12 gaps crossed, 3 lines, symmetry D4`.
std::string kolam_summary(const ReadKolam& kolam, const KolamReport& report);

/// The pattern that draws the kolam; comments list its doubtful gaps. @param source  name of the file, for the
/// description
std::string read_kolam_pattern(const ReadKolam& kolam, const KolamReport& report, const std::string& source,
                               const Monitor& monitor);

/// One line of JSON: counts, symmetry, doubtful and repaired gaps. @param photograph  adds its findings; may be null
std::string read_kolam_json(const ReadKolam& kolam, const KolamReport& report, const Photograph* photograph);

}  // namespace sikku
