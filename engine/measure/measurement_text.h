// engine/measure/measurement_text.h: formats a measurement as text and as JSON.
#pragma once

#include "engine/measure/extent.h"

#include <string>

namespace sikku {

/// One line of JSON. Numbers beyond double precision are strings of digits. @param title  title of the pattern
std::string measurement_json(const std::string& title, const Measurement& measurement);
/// Text with one line for each quantity.
std::string measurement_text(const std::string& title, const Measurement& measurement);

}  // namespace sikku
