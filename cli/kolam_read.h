// cli/kolam_read.h: `sikku kolam --read`, and a pattern's kolam in other formats.
#pragma once

#include "art/kolam/dot_grid_lines.h"
#include "cli/command.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// Heading of these options in help.
inline constexpr const char* read_heading = "Kolams from drawings, tables, gestures and photographs";

/// The options as they were given.
struct KolamReadOptions {
    std::string file;
    std::size_t number = 1;
    std::string lattice;
    std::string grid;  ///< the dots that the kolam of a photograph has; `@FILE` reads them from a file
    std::vector<std::string> corners;
    std::string crop;
    std::vector<std::string> fixes;
    std::string overlay;
    bool no_repair = false;
    bool as_json = false;
    std::string output;  ///< empty: the pattern, on standard output
    double budget = 200e6;
};

/// Adds `--read` and the options that depend on it; the command adds `-o` and `--json`.
void add_kolam_read_options(CLI::App& command, KolamReadOptions& options);

/// The text of a kolam in the format of `output`, unless that is a pattern file.
std::optional<std::string> text_for(const std::string& output, const DotGrid& grid, const GapStates& states);

/// True for the name of a pattern file: `.lsys`, or no extension.
bool is_pattern_file(const std::string& output);
/// Checks that a kolam can be written in the format of that extension. @throws UsageError
void check_kolam_output(const std::string& output);

/// Reads a kolam, writes it, and reports grid, lines and doubtful gaps.
/// @throws UsageError; std::runtime_error if no kolam is found, or a file cannot be written
void kolam_read(const KolamReadOptions& options, bool quiet);

/// Writes the kolam that a pattern draws in the format of `output`. @throws as kolam_read()
void kolam_convert(const Document& document, const std::string& output, double budget, bool quiet);

}  // namespace sikku
