// music/score/mxl.h: packs MusicXML into its compressed form.
#pragma once

#include "engine/base/output.h"

#include <string_view>

namespace sikku {

/// Writes a ZIP archive with the container file and `score.musicxml`, deflated. The pattern and the recipe of the
/// score come first, uncompressed, so that they can be read without unpacking. The bytes are the same each time
/// (entries are dated 1980-01-01).
/// @throws std::runtime_error for a score of more than 2 GB; exceptions of `out`
void write_mxl(std::string_view musicxml, Output& out);

}  // namespace sikku
