// cli/studio_page.h: the page of the studio with patterns in it.
#pragma once

#include "art/link/link.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {

/// A file that is not a page of the studio.
class PageError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Returns the page with these patterns instead of those in it. The page opens them in this order. Its list has the
/// members of `pattern` in `Shared` of studio/page/protocol.ts, and `draw` and `play` where a link has options.
/// @throws PageError if the page has no place for them; LinkError for invalid UTF-8
std::string page_with(const std::string& page, const std::vector<SharedWork>& patterns);

/// The address of a file: `file:///…`. @param path  absolute
std::string file_address(const std::string& path);

}  // namespace sikku
