// art/gallery/values.h: the values of gallery files (TOML) and manifests (JSON lines), with their places.
#pragma once

#include "engine/base/toml_file.h"

#include <string>

namespace sikku {

using GalleryValue = FileValue;
/// An error in a gallery file, a manifest or a request; what() begins with the place if there is one.
using GalleryError = FileError;

/// Reads a line of a manifest.
/// @param place  file and line
/// @throws GalleryError if it is not a JSON object
GalleryValue read_manifest_line(const std::string& place, const std::string& line);

}  // namespace sikku
