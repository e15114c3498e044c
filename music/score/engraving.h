// music/score/engraving.h: prints scores as PDF with the program LilyPond.
#pragma once

#include "music/score/score.h"

#include <filesystem>
#include <functional>
#include <string_view>

namespace sikku {

/// Runs the program `lilypond` found in PATH on a file for it and writes the print as `output`, which is replaced.
/// Works in a folder of its own below that of temporary files, which is removed. `watch` is called about twenty times
/// a second; an exception ends the work. Cost: one or two seconds, and one for each ten pages.
/// The file contains the pattern and the recipe, like PDF files of prints. The same LilyPond and Ghostscript give the
/// same bytes each time.
/// @param shown  name of the output in messages, where `output` is a temporary file
/// @throws std::runtime_error if lilypond is missing (with a package to install) or fails (with its messages), or
/// if a file cannot be read or written
void engrave(std::string_view lilypond, const ScoreHead& head, const std::filesystem::path& output,
             const std::filesystem::path& shown, const std::function<void()>& watch);

}  // namespace sikku
