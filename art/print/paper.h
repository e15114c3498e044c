// art/print/paper.h: paper sizes by name.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string_view>

namespace sikku {

struct PaperSize {
    std::string_view name;  ///< in lower case, without blanks and hyphens: `a4`, `jisb4`, `letter`
    glm::dvec2 size;        ///< width and height of the upright sheet in millimetres
};

/// All sizes that have names; parse_size() reads them in any case, with blanks and hyphens.
std::span<const PaperSize> paper_sizes();

}  // namespace sikku
