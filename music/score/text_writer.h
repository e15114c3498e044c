// music/score/text_writer.h: writes scores that are texts.
#pragma once

#include "engine/base/output.h"

#include <fmt/format.h>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

namespace sikku {

/// Formats text into an output, in blocks.
class TextWriter {
public:
    explicit TextWriter(Output& out) : out_(out) {}

    template <typename... Arguments>
    void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        constexpr std::size_t block_bytes = std::size_t{1} << 16;
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        if (text_.size() > block_bytes) flush();
    }
    /// Writes the remaining text. Call last.
    void flush() {
        out_.write({text_.data(), text_.size()});
        text_.clear();
    }

private:
    Output& out_;
    fmt::memory_buffer text_;
};

/// Formats a number with at most `places` decimals, without trailing zeros or -0.
inline std::string number(double value, int places = 3) {
    std::string text = fmt::format("{:.{}f}", value, places);
    if (text.find('.') != std::string::npos) text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

}  // namespace sikku
