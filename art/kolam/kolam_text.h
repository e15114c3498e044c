// art/kolam/kolam_text.h: formats the examination of a kolam as text and as JSON.
#pragma once

#include "art/kolam/kolam.h"

#include <cstdint>
#include <string>

namespace sikku {

/// One line of JSON, with positions in turtle steps rounded to a millionth. @param n  derivation length
std::string kolam_json(const std::string& title, std::int64_t n, const KolamExamination& examination);
/// Text with one line for each finding.
std::string kolam_text(const std::string& title, std::int64_t n, const KolamExamination& examination);

}  // namespace sikku
