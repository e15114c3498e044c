// art/writer/press_inks.h: loads the inks of a press for PDF/X.
#pragma once

#include "art/print/format.h"
#include "art/print/press.h"

namespace sikku {

/// Sets `inks` of a press with a CMYK profile, if the format is PDF. Loads the module for pictures.
/// @throws std::runtime_error, which names the file, if it is not the CMYK profile of an output device
void load_inks(Press& press, PrintFormat format);

}  // namespace sikku
