#include "art/reading/gesture_loops.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::string_view separators = " \t\r\n,";
constexpr std::size_t most_gestures = 4 * DotGrid::most_dots;

[[noreturn]] void refuse_loops(const std::string& what) {
    throw std::runtime_error("gestures: " + what);
}

/// The loops of `[["O1" "O2"] ["C1"]]`, with or without the quotes.
std::vector<GestureLoop> parse_sequence(std::string_view text) {
    std::vector<GestureLoop> loops;
    std::size_t count = 0;
    int depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '[') {
            if (++depth > 2) refuse_loops("the brackets of a loop contain brackets");
            if (depth == 2) loops.emplace_back();
        } else if (text[at] == ']') {
            if (--depth == 0) return loops;
        } else if (depth > 0 && separators.find(text[at]) == std::string_view::npos) {
            // Some collections leave the quotes out.
            const bool is_quoted = text[at] == '"';
            const std::size_t begin = at + (is_quoted ? 1 : 0);
            const std::size_t end =
                std::min(text.find_first_of(is_quoted ? "\"" : " \t\r\n,[]\"", begin), text.size());
            if (end == text.size() || end == begin || depth != 2) refuse_loops("'sequence' is damaged");
            if (++count > most_gestures) refuse_loops("too many");
            loops.back().gestures.push_back(lower_case(text.substr(begin, end - begin)));
            at = is_quoted ? end : end - 1;
        }
    }
    refuse_loops("'sequence' has no end");
}

/// The numbers of `[NAME 0 1.5 …]`.
std::vector<double> parse_history(std::string_view text, std::string_view name) {
    const std::size_t at = text.find(fmt::format("[{} ", name));
    const std::size_t end = text.find(']', at == std::string_view::npos ? text.size() : at);
    if (at == std::string_view::npos || end == std::string_view::npos)
        refuse_loops(fmt::format("'history' lacks {}", name));
    std::vector<double> numbers;
    for (const std::string_view word :
         split_words(text.substr(at + name.size() + 2, end - at - name.size() - 2), separators)) {
        double number = 0;
        if (!read_number(word, number))
            refuse_loops(fmt::format("{}: '{}' is not a number", name, printable(word, 40)));
        numbers.push_back(number);
    }
    return numbers;
}

std::int32_t half_spacings(double value, std::string_view what) {
    const double halves = std::round(2 * value);
    if (!(std::fabs(halves) < 1e6) || std::fabs(2 * value - halves) > 0.25) {
        refuse_loops(fmt::format("{} is not midway between two dots", what));
    }
    return static_cast<std::int32_t>(halves);
}

int right_heading(double heading) {
    if (!(std::fabs(heading) < 1e6)) refuse_loops("a heading is not an angle in degrees");
    const double turned = heading - 360 * std::floor(heading / 360);
    const double rounded = std::round(turned);
    return static_cast<int>(rounded) % 360;
}

/// The transcription of a study: the history has the place and heading before each gesture, after one row more.
std::vector<GestureLoop> parse_transcription(std::string_view text) {
    const auto value_after = [&](std::string_view key) {
        const std::size_t at = text.find(key);
        return at == std::string_view::npos ? std::string_view() : text.substr(at + key.size());
    };
    std::vector<GestureLoop> loops = parse_sequence(value_after("sequence:"));
    const std::string_view size_text = value_after("matrix_size:");
    const std::string_view history = value_after("history:");
    if (history.empty()) return loops;
    double size = 0;
    if (!read_number(trimmed(size_text.substr(0, size_text.find_first_of("\r\n"))), size) || !(size > 0)) {
        refuse_loops("'matrix_size' is not a number above 0");
    }
    const auto x = parse_history(history, "Oldx");
    const auto y = parse_history(history, "Oldy");
    const auto headings = parse_history(history, "Oldh");
    std::size_t row = 1;
    for (GestureLoop& loop : loops) {
        if (row >= x.size() || row >= y.size() || row >= headings.size()) refuse_loops("'history' is too short");
        loop.start = GridDot{half_spacings(x[row] / size, "a start"), half_spacings(y[row] / size, "a start")};
        loop.heading = right_heading(headings[row]);
        row += loop.gestures.size();
    }
    return loops;
}

std::vector<GestureLoop> parse_rows(std::string_view text) {
    std::vector<GestureLoop> loops;
    std::size_t count = 0;
    while (!text.empty()) {
        std::string_view row = trimmed(take_line(text));
        if (row.empty() || row == "\r") continue;
        GestureLoop loop;
        if (const std::size_t colon = row.find(':'); colon != std::string_view::npos) {
            const auto numbers = split_words(row.substr(0, colon), separators);
            std::array<double, 3> start{};
            bool is_good = numbers.size() == 3;
            for (std::size_t i = 0; i < 3 && is_good; ++i) is_good = read_number(numbers[i], start[i]);
            if (!is_good)
                refuse_loops(fmt::format("loop {}: expected X,Y,HEADING before the colon", loops.size() + 1));
            loop.start = GridDot{half_spacings(start[0], "a start"), half_spacings(start[1], "a start")};
            loop.heading = right_heading(start[2]);
            row.remove_prefix(colon + 1);
        } else if (loops.empty()) {
            loop.start = GridDot{0, 1};
        }
        for (const std::string_view word : split_words(row, separators)) {
            if (++count > most_gestures) refuse_loops("too many");
            loop.gestures.push_back(lower_case(word));
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

bool is_transcription(std::string_view text) {
    return text.starts_with("sequence:") || text.find("\nsequence:") != std::string_view::npos;
}

}  // namespace

bool is_gestures(std::string_view text) {
    text = text.substr(0, 4096);
    if (is_transcription(text)) return true;
    const std::string_view row = text.substr(0, text.find('\n'));
    const auto words = split_words(row.substr(row.find(':') + 1), separators);
    return !words.empty() && std::all_of(words.begin(), words.end(), [](std::string_view word) {
        const std::string name = lower_case(word);
        return name.size() <= 3 && name.size() >= 2 &&
               std::string_view("odtch").find(name[0]) != std::string_view::npos &&
               ((name[1] >= '1' && name[1] <= '4') || name == "op");
    });
}

std::vector<GestureLoop> read_gesture_loops(std::string_view text) {
    std::vector<GestureLoop> loops = is_transcription(text) ? parse_transcription(text) : parse_rows(text);
    if (loops.empty()) refuse_loops("there are none");
    for (std::size_t i = 0; i < loops.size(); ++i) {
        if (loops[i].gestures.empty()) refuse_loops(fmt::format("loop {} is empty", i + 1));
        if (!loops[i].start) {
            refuse_loops(fmt::format("loop {} has no start; expected X,Y,HEADING: before its gestures", i + 1));
        }
    }
    return loops;
}

}  // namespace sikku
