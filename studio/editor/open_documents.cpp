#include "studio/editor/open_documents.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"
#include "studio/editor/text_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace sikku {
namespace {

/// The path in `file:///home/me/my%20pattern.lsys`; other addresses as they are.
std::string path_of(const std::string& address) {
    constexpr std::string_view scheme = "file://";
    if (!address.starts_with(scheme)) return address;
    std::string path;
    for (std::size_t at = scheme.size(); at < address.size(); ++at) {
        const auto value = [&](std::size_t place) {
            const char digit = place < address.size() ? lower_case(address.substr(place, 1))[0] : ' ';
            return is_digit(digit) ? digit - '0' : digit >= 'a' && digit <= 'f' ? digit - 'a' + 10 : -1;
        };
        if (address[at] == '%' && value(at + 1) >= 0 && value(at + 2) >= 0) {
            path += static_cast<char>(16 * value(at + 1) + value(at + 2));
            at += 2;
        } else {
            path += address[at];
        }
    }
    return path.find('\0') == std::string::npos ? path : address;
}

}  // namespace

void OpenDocuments::put(const std::string& address, const std::string& text) {
    OpenDocument& open = documents_[address];
    bytes_ -= open.text.size();
    open.name = path_of(address);
    open.size = text.size();
    open.is_changed = true;
    open.text.clear();
    if (text.size() <= most_bytes && bytes_ + text.size() <= most_bytes_together) {
        open.text = text;
        open.is_refusal_told = false;
    } else {
        open.text.shrink_to_fit();
    }
    bytes_ += open.text.size();
}

void OpenDocuments::change(const std::string& address, const Json& changes) {
    if (!changes.is_array()) throw BadRequest("'contentChanges' must be a list");
    for (const Json& each : changes) {
        std::string text = text_of(each, "text");
        if (each.contains("range")) {
            const OpenDocument& document = at(address);
            if (document.is_too_large()) throw BadRequest("the document is too large");
            const TextPositions positions(document.text);
            const auto offset = [&](const char* name) {
                return positions.offset(place_of(member(each["range"], name)));
            };
            const std::size_t begin = offset("start");
            text = with_edits(document.text, {{begin, std::max(begin, offset("end")), text}});
        }
        put(address, text);
    }
}

bool OpenDocuments::close(const std::string& address) {
    const auto found = documents_.find(address);
    if (found == documents_.end()) return false;
    bytes_ -= found->second.text.size();
    documents_.erase(found);
    return true;
}

const OpenDocument& OpenDocuments::at(const std::string& address) const {
    const auto found = documents_.find(address);
    if (found == documents_.end()) throw BadRequest("the document is not open");
    return found->second;
}

std::string too_large_text(const OpenDocument& document) {
    return fmt::format(
        "this document of {} is too large for an editor and is not read; the limits are 4 MB for a document and 64 "
        "MB "
        "for all open documents; `sikku check` reads files of up to 64 MB",
        bytes_text(static_cast<double>(document.size)));
}

}  // namespace sikku
