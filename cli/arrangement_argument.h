// cli/arrangement_argument.h: arrangements as arguments: files and names.
#pragma once

#include "music/arrangement.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// An arrangement and the folder of the files that it names.
struct NamedArrangement {
    Arrangement arrangement;
    std::filesystem::path folder;
};

/// True for TOML files and names of bundled arrangements.
bool is_arrangement(const std::string& name);

/// Reads an arrangement, with patterns beside it or bundled. @throws FileError, PatternError, UsageError
NamedArrangement read_arrangement_argument(const std::string& name);

/// Reads an arrangement for a gallery, from a file that is called `name` in messages. Standard input is refused.
/// @throws FileError, PatternError, UsageError
NamedArrangement read_arrangement_file(const std::filesystem::path& path, const std::string& name);

/// The file of an arrangement, and those of its patterns that are files, as far as they can be read.
std::vector<std::filesystem::path> files_of_arrangement(const std::string& name);

}  // namespace sikku
