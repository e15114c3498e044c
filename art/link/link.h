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

/// A pattern with the values and options of its prints and scores.
struct SharedWork {
    std::string name;                         ///< file name of the pattern for messages: `curve.lsys`
    std::string text;                         ///< text of the pattern file
    std::string variant;                      ///< empty: none
    OptionValues settings;                    ///< keys and defines that replace those in the text
    OptionValues draw;                        ///< options of prints
    OptionValues play;                        ///< options of scores
    std::map<std::string, std::string> page;  ///< values that only the studio uses
};

/// Reports a text that is not a link, a damaged link, or a work that does not fit into a link.
class LinkError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Maximum size of a link, and of its contents as JSON.
constexpr std::size_t most_link_bytes = std::size_t{64} << 20;

/// Makes the fragment of a link, without `#`: `sikku1.` and the work as compressed JSON in base64url. Equal works
/// give equal bytes. @throws LinkError for invalid UTF-8, an invalid file name, and works over the limits
std::string link_of(const SharedWork& work);

/// Writes the work as JSON, with all members of `Shared` in studio/page/protocol.ts.
/// @throws LinkError for invalid UTF-8
std::string shared_json(const SharedWork& work);

/// Reads what shared_json() writes; `draw`, `play`, `page` and empty members may be missing. @throws LinkError
SharedWork read_shared_json(const std::string& json);

/// True for texts that are links rather than paths or names: addresses (`https:`, `http:`, `file:`)
/// and fragments that begin with `sikku`, a number and a dot.
bool is_link(std::string_view text);

/// Reads an address with a fragment, or a fragment with or without `#`. Neither checks nor derives the pattern.
/// Cost: time and memory are linear in the input and bounded.
/// @throws LinkError
SharedWork read_link(std::string_view link);

}  // namespace sikku
