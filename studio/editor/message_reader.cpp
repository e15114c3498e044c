#include "studio/editor/message_reader.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace sikku {
namespace {

constexpr std::size_t most_header_bytes = 4096;

/// The length in a header of lines `Name: value`; nullopt if the header has none or is invalid.
std::optional<std::size_t> content_length(std::string_view header) {
    std::optional<std::size_t> length;
    while (!header.empty()) {
        std::string_view line = take_line(header);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.empty()) continue;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) return std::nullopt;
        if (lower_case(trimmed(line.substr(0, colon))) != "content-length") continue;
        const std::string_view digits = trimmed(line.substr(colon + 1));
        std::size_t number = 0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
        length = number;
    }
    return length;
}

}  // namespace

void MessageReader::add(std::string_view bytes) {
    if (at_ > 0) {
        waiting_.erase(0, at_);
        at_ = 0;
    }
    if (length_ && *length_ > most_bytes) {
        const std::size_t part = std::min(bytes.size(), *length_ - skipped_);
        skipped_ += part;
        bytes.remove_prefix(part);
    }
    waiting_ += bytes;
}

bool MessageReader::read_header() {
    const std::string_view text = std::string_view(waiting_).substr(at_);
    // Line feeds without carriage returns are accepted.
    std::size_t end = text.find("\n\r\n");
    std::size_t after = end + 3;
    if (const std::size_t bare = text.find("\n\n"); bare < end) {
        end = bare;
        after = end + 2;
    }
    if (end > most_header_bytes) {  // also if the header does not end
        is_broken_ = text.size() > most_header_bytes;
        return false;
    }
    length_ = content_length(text.substr(0, end));
    is_broken_ = !length_;
    if (is_broken_) return false;
    at_ += after;
    skipped_ = 0;
    if (*length_ > most_bytes) {
        skipped_ = std::min(waiting_.size() - at_, *length_);
        at_ += skipped_;
    }
    return true;
}

std::optional<MessageReader::Message> MessageReader::next() {
    if (is_broken_ || (!length_ && !read_header())) return std::nullopt;
    Message message;
    message.size = *length_;
    if (*length_ > most_bytes) {
        if (skipped_ < *length_) return std::nullopt;
        message.is_skipped = true;
    } else {
        if (waiting_.size() - at_ < *length_) return std::nullopt;
        message.content = waiting_.substr(at_, *length_);
        at_ += *length_;
    }
    length_.reset();
    return message;
}

std::string with_header(std::string_view message) {
    return fmt::format("Content-Length: {}\r\n\r\n{}", message.size(), message);
}

}  // namespace sikku
