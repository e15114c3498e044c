// art/print.h: everything a writer of prints needs to know beside the drawing itself.
#pragma once

#include "art/page.h"
#include "art/style.h"

#include <string>

namespace sikku {

/// A print about to be made. Writers take it by reference and must not outlive it.
struct Print {
    Page page;
    Style style;
    Placement placement;
    double dpi = 300.0;
    std::string title;            ///< of the pattern, UTF-8
    std::string pattern;          ///< the text of the pattern file, so that the print can be made again
    std::string made;             ///< what made it: `sikku 0.1.0, -n 4`
};

}  // namespace sikku
