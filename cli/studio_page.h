// cli/studio_page.h: puts patterns into the studio page.
#pragma once

#include "art/link/link.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

/// Reports a file that is not a studio page.
class PageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Returns the page with its patterns replaced by these, which it opens in this order. Each has the members of
/// `pattern` in `Shared` of studio/page/protocol.ts, and `draw` and `play` if a link has options.
/// @throws PageError if the page has no element for patterns; LinkError for invalid UTF-8
std::string page_with(const std::string& page, const std::vector<SharedWork>& patterns);

/// Returns the address of a file: `file:///…`. @param path  an absolute path
std::string file_address(const std::string& path);

}  // namespace sikku
