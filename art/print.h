// art/print.h: everything a writer of prints needs to know beside the drawing itself.
#pragma once

#include "art/page.h"
#include "art/style.h"
#include "engine/path.h"

#include <string>

namespace sikku {

/// A print about to be made. Writers keep it by reference and must not outlive it.
struct Print {
    Page page;
    Style style;
    Placement placement;
    double dpi = 300.0;
    std::string title;    ///< of the pattern, UTF-8
    std::string pattern;  ///< the text of the pattern file, so that the print can be made again
    std::string made;     ///< what made it: `sikku 0.1.0, -n 4`
};

/// Takes the drawing of a print and writes it into a file.
class PrintWriter : public PathSink {
public:
    /// Completes the document; to be called once, after the last stroke.
    virtual void finish() = 0;
};

}  // namespace sikku
