// art/link/link.h: links that contain a pattern with its values and options. The studio makes and opens them; the
// program reads them in place of a pattern.
#pragma once

#include "engine/base/option.h"

#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sikku {

/// A pattern with everything that its prints and scores are made with.
struct SharedWork {
    std::string name;                         ///< file name of the pattern for messages: `curve.lsys`
    std::string text;                         ///< text of the pattern file
    std::string variant;                      ///< empty: none
    OptionValues settings;                    ///< keys and defines of the pattern that replace those of its text
    OptionValues draw;                        ///< options of prints
    OptionValues play;                        ///< options of scores
    std::map<std::string, std::string> page;  ///< what only the studio uses
};

/// A text that is not a link, a damaged link, or a work that does not fit into a link.
class LinkError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Size limit of links and of their contents as JSON.
constexpr std::size_t most_link_bytes = std::size_t{64} << 20;

/// The fragment of a link, without `#`: `sikku1.` and the work as JSON, compressed, in base64url. The same work gives
/// the same bytes. @throws LinkError for invalid UTF-8, an invalid name, and works over the limits
std::string link_of(const SharedWork& work);

/// The work as JSON, with all members of `Shared` in studio/page/protocol.ts. @throws LinkError for invalid UTF-8
std::string shared_json(const SharedWork& work);

/// True for texts that read_link() should read rather than a path or a name: addresses (`https:`, `http:`, `file:`)
/// and fragments that begin with `sikku`, a number and a dot.
bool is_link(std::string_view text);

/// Reads an address with a fragment, or a fragment with or without `#`. Nothing of the pattern is checked or derived.
/// Time and memory: linear, and limited for every input.
/// @throws LinkError
SharedWork read_link(std::string_view link);

}  // namespace sikku
