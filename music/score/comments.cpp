#include "music/score/comments.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sikku {

std::string single_line(std::string_view text) {
    constexpr std::array<std::string_view, 3> marks = {"\u200E", "\u200F", "\u061C"};
    const std::string whole = printable(text, std::string::npos);
    std::string result;
    for (std::string_view rest = whole; !rest.empty();) {
        const std::size_t plain = std::min(rest.find_first_of("\xD8\xE2"), rest.size());  // where no mark begins
        result += rest.substr(0, plain);
        rest.remove_prefix(plain);
        if (rest.empty()) break;
        const auto mark = std::find_if(marks.begin(), marks.end(),
                                       [rest](std::string_view candidate) { return rest.starts_with(candidate); });
        result += mark == marks.end() ? rest.front() : ' ';
        rest.remove_prefix(mark == marks.end() ? 1 : mark->size());
    }
    return result;
}

std::string head_comments(const ScoreHead& head, std::string_view sign) {
    std::string comments;
    for (std::string_view text : {std::string_view(head.made), std::string_view(head.pattern)}) {
        while (!text.empty()) {
            std::string line(take_line(text));
            if (line.ends_with('\r')) line.pop_back();
            std::replace(line.begin(), line.end(), '\t', ' ');
            comments.append(sign).append(line.empty() ? "" : " ").append(single_line(line)).append("\n");
        }
    }
    return comments;
}

bool comments_keep(std::string_view text) {
    std::string plain(text);
    std::erase(plain, '\r');
    std::replace_if(
        plain.begin(), plain.end(), [](char byte) { return byte == '\t' || byte == '\n'; }, ' ');
    return single_line(plain) == plain;
}

}  // namespace sikku
