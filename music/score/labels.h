// music/score/labels.h: the names of parts before their staves.
#pragma once

#include "music/score/notation.h"

#include <span>

namespace sikku {

/// Sets name and abbreviation of parts: those of their instruments, or their own names. Parts with the same name are
/// numbered.
void set_labels(std::span<NotatedPart> parts);

}  // namespace sikku
