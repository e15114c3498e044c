#include "music/score/text_writer.h"

#include <string_view>

namespace sikku {

void put_number(std::string& text, double value, int places) {
    const std::size_t begin = text.size();
    fmt::format_to(std::back_inserter(text), "{:.{}f}", value, places);
    if (text.find('.', begin) != std::string::npos) {
        while (text.back() == '0') text.pop_back();
        if (text.back() == '.') text.pop_back();
    }
    if (std::string_view(text).substr(begin) == "-0") text.erase(begin, 1);
}

std::string number(double value, int places) {
    std::string text;
    put_number(text, value, places);
    return text;
}

}  // namespace sikku
