// cli/kolam_grid.h: `sikku kolam --grid`: kolams made on a grid of dots, and all single lines of a small one.
#pragma once

#include "cli/command.h"

#include <cstdint>
#include <optional>
#include <string>

namespace sikku {

/// Heading of these options in help.
inline constexpr const char* grid_heading = "Kolams on a grid of dots";

/// The options as they were given.
struct KolamGridOptions {
    std::string grid;
    std::string radial;  ///< arms and dots of a radial kolam, instead of a grid
    std::string order;   ///< order in which its lines visit the dots of an arm
    std::uint64_t seed = 0;
    std::optional<std::string> symmetry;   ///< absent: the seed chooses
    std::optional<double> density;         ///< share of crossed gaps; absent: the seed chooses
    double joined = 0.0;                   ///< share of joined gaps among the others
    std::optional<std::string> crossings;  ///< instead of chance; `@FILE` reads them from a file
    std::uint32_t period = 0;              ///< columns after which the gaps repeat; 0: they do not
    bool single_line = false;
    int attempts = 1000;                                            ///< for a single line with a symmetry
    std::string size = {}, margin = {}, spacing = {}, border = {};  ///< of the page that the grid fills
    bool landscape = false;
    bool colours = false;
    bool dots = false;
    bool centred = false;  ///< dots in closed fields between four dots
    std::string rim = "round";
    bool enumerate = false;
    std::size_t limit = 100;  ///< maximum number of kolams that an enumeration lists
    int threads = 0;          ///< threads of an enumeration
    bool as_json = false;     ///< report it as JSON, on standard output
    std::string output;       ///< empty: standard output

    bool is_fill() const;  ///< a page determines the grid @throws UsageError
};

/// Adds `--grid` and the options that depend on it; the command adds `-o`, `--json` and `-j`.
void add_kolam_grid_options(CLI::App& command, KolamGridOptions& options);

/// Writes the pattern of a radial kolam. @throws as kolam_grid()
void kolam_radial(const KolamGridOptions& options, bool quiet);

/// Writes the pattern of a kolam, or lists the kolams of an enumeration.
/// @throws UsageError, and std::runtime_error if no single line was found or the file cannot be written
void kolam_grid(const KolamGridOptions& options, bool quiet);

}  // namespace sikku
