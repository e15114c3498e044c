// python/collections.h: arrangements of several patterns as one piece, and galleries of many files.
#pragma once

#include "music/arrangement.h"
#include "python/values.h"

#include <pybind11/pybind11.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

/// An arrangement, and the folder of the files that it names.
struct LoadedArrangement {
    Arrangement arrangement;
    std::filesystem::path folder;
};

/// Reads an arrangement. @param name  path of a TOML file, or name of a bundled arrangement; with `text`, its name in
/// messages @param folder  of files that it names; absent: that of the file @throws NotFound, FileError, PatternError
LoadedArrangement load_arrangement(const std::string& name, const std::optional<std::string>& text,
                                   const std::optional<std::string>& folder);

/// Returns (contents by name, remarks), as make() for patterns does.
pybind11::tuple make_piece(const LoadedArrangement& piece, const std::string& format, const TextPairs& values,
                           const pybind11::object& progress);
/// Writes a score and returns the remarks.
pybind11::list write_piece(const LoadedArrangement& piece, const std::string& format, const TextPairs& values,
                           const std::string& path, const pybind11::object& progress);
pybind11::tuple notes_of_piece(const LoadedArrangement& piece, const TextPairs& values);

/// Arguments of make_gallery().
struct GalleryCall {
    std::vector<std::string> patterns;
    std::string file, folder, poster, contact;
    std::map<std::string, std::string> keys;
    bool force = false, keep_going = false;
    double memory = 0;  ///< bytes; 0: half of what is available
    int threads = 0;
};

/// Makes a gallery. Returns (finished files as (name, bytes, whether this call made it, warnings), failures as (name,
/// message), other warnings, troubles). @throws GalleryError, std::runtime_error
pybind11::tuple make_gallery(const GalleryCall& call, const pybind11::object& progress);

}  // namespace sikku
