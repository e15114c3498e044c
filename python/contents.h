// python/contents.h: the contents of patterns and files for Python: keys, productions, systems of other programs,
// patterns in prints and scores.
#pragma once

#include "art/provenance/provenance.h"
#include "engine/language/document.h"

#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Keys and values of the settings that a document was made with, in their order.
std::vector<std::pair<std::string, std::string>> settings_of(const Document& document);
/// Dictionaries of texts, in the order of the file, settings applied.
pybind11::dict key_values_of(const Document& document);
pybind11::dict defines_of(const Document& document);
/// For the name of each variant, a dictionary of its keys and defines.
pybind11::dict variants_of(const Document& document);
/// A list of sikku.Production.
pybind11::list productions_of(const Document& document);

/// Imports the systems of a cpfg file or a Fractint collection. Returns (systems, diagnostics), a system as (name,
/// line, text of the pattern, losses, whether it draws).
/// @param view  path of a view file of cpfg; absent: that beside the file, if there is one
/// @throws NotFound, std::runtime_error for other files
pybind11::tuple import_systems(const std::string& path, const std::optional<std::string>& view);

/// The pattern in a print or a score, and how that was made; nullopt for other files.
/// @throws std::runtime_error if the file has such a format but contains no pattern, or is damaged
std::optional<Provenance> stored_pattern(const std::filesystem::path& file);
/// The same as a tuple of texts, or None.
pybind11::object provenance_of(const std::string& path);

/// Refuses texts that were written for other programs. @throws std::runtime_error, naming what reads them
void refuse_foreign(const std::string& name, const std::string& text);

}  // namespace sikku
