// cli/version.h: what `sikku --version` prints.
#pragma once

namespace sikku {

/// The version, and the commit of the build if it is known: `sikku 0.2.0 (0123456789ab)`, `(0123456789ab, with
/// changes)`. packaging/commit.cmake writes its definition.
const char* version_text();

}  // namespace sikku
