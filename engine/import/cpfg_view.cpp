// engine/import/cpfg_view.cpp: reads the view file of cpfg.
#include "engine/base/text.h"
#include "engine/import/cpfg_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace sikku::cpfg {
namespace {

void read_setting(const SourcePointer& file, std::string_view line, std::size_t at, View& view, Report& report) {
    const std::size_t colon = line.find(':');
    if (line.front() == '#' || colon == std::string_view::npos) {
        if (line.front() == '#') report.losses().add(file, at, "preprocessor directives in a view file");
        return;
    }
    const std::string label = lower_case(line.substr(0, colon));
    const std::string_view value = without_blanks(line.substr(colon + 1));
    std::size_t end = 0;
    while (end < value.size() && !is_blank(value[end])) ++end;
    double number = 0;
    const bool is_number = read_number(value.substr(0, end), number);
    const auto bad = [&](const char* message) { report.error(file, at + colon, message); };
    if (label == "angle factor") {
        if (!is_number || number == 0) return bad("expected a number other than 0: the angle is 360/n degrees");
        const bool is_simple = number >= 1 && number <= 1e9 && number == std::floor(number);
        view.angle =
            is_simple ? fmt::format("angle factor: {}", number) : fmt::format("angle increment: 360/{}", number);
    } else if (label == "angle increment") {
        if (!is_number) return bad("expected degrees");
        view.angle = fmt::format("angle increment: {}", number);
    } else if (label == "line width increment") {
        if (!is_number) return bad("expected a number");
        view.width_increment = number;
    } else if (label == "initial line width" && is_number && number > 0 && number < 100) {
        end = skip_blanks(value, end);
        const bool in_pixels = end < value.size() && value[end] == 'p';
        view.stroke = fmt::format("stroke: {} {}", number, in_pixels ? "px" : "step");
    } else if (label == "scale factor" && is_number && number > 0 && number <= 1) {
        view.scale = fmt::format("scale factor: {}", 100 * number);
    } else {
        report.losses().add(file, at, fmt::format("'{}:' of the view", printable(label, 60)));
    }
}

}  // namespace

View read_view(const SourcePointer& file, Report& report) {
    View view;
    const std::string& text = file->text();
    bool in_comment = false;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string line;
        for (std::size_t i = at; i < end; ++i) {
            if (!in_comment && text.compare(i, 2, "/*") == 0) in_comment = true;
            if (in_comment && text.compare(i, 2, "*/") == 0) {
                in_comment = false;
                ++i;
                line += "  ";
            } else {
                line += in_comment ? ' ' : text[i];
            }
        }
        if (const std::size_t rest = line.find("//"); rest != std::string::npos) line.resize(rest);
        const std::size_t first = skip_blanks(line, 0);
        if (first < line.size()) read_setting(file, without_blanks(line), at + first, view, report);
        at = end + 1;
    }
    return view;
}

}  // namespace sikku::cpfg
