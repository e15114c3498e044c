#include "art/plotter/gcode.h"

#include "art/plotter/arc_writer.h"
#include "art/print/micrometres.h"
#include "art/print/recipe_comments.h"
#include "engine/base/decimal.h"
#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double farthest = 10'000;          // millimetres from the origin to a place
constexpr std::size_t longest_comment = 60;  // grbl takes lines of 80 bytes

glm::dvec2 to_micrometres(glm::dvec2 point) {
    return {std::round(point.x * 1000) / 1000, std::round(point.y * 1000) / 1000};
}

void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(fmt::format("G-code: {}", what));
}

/// Calls `visit(letter, value, word)` for each letter that a number follows, outside comments. Numbers beyond the
/// range of doubles are infinite.
template <class Visit>
void for_each_word(std::string_view lines, const Visit& visit) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        // Comments may contain any characters.
        if (lines[i] == '(' || lines[i] == ';') {
            i = lines.find(lines[i] == '(' ? ')' : '\n', i);
            if (i == std::string_view::npos) return;
            continue;
        }
        const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(lines[i])));
        double value = std::numeric_limits<double>::infinity();
        const std::string_view rest = lines.substr(i + 1);
        if (letter < 'A' || letter > 'Z') continue;
        const auto [end, error] = parse_number(rest, value);
        if (error == std::errc::invalid_argument) continue;
        visit(letter, value, lines.substr(i, 1 + static_cast<std::size_t>(end - rest.data())));
    }
}

class GcodeWriter final : public ArcWriter {
public:
    GcodeWriter(const Print& print, const GcodeOptions& options, Output& file)
        : ArcWriter(print, file, options.arcs, options.least_arc), options_(options) {
        for (const double feed : {options.drawing_feed, options.travel_feed}) {
            require(std::isfinite(feed) && feed > 0, "feeds must be finite and above 0 mm/min");
        }
        require(std::isfinite(options.lift) && std::isfinite(options.down), "heights must be finite");
        require(std::isfinite(options.pause) && options.pause >= 0, "the pause must be finite and at least 0 s");
        require(std::isfinite(options.least_arc) && options.least_arc >= 0,
                "the minimum length of an arc must be finite and at least 0 mm");
        for (const std::string* command : {&options.pen_up, &options.pen_down, &options.pen_change, &options.dwell}) {
            fill(*command);
        }
        if (!print.title.empty()) write_comment("title", print.title);
        for (const std::string& piece : recipe_comments(print.pattern, print.made)) write_comment("recipe", piece);
        write_text(options.setup);
        write_text(options.start);
        lift();
    }

    void end_stroke(bool) override {
        if (!started_) return;
        finish_curve();
        started_ = false;
        lift();
    }
    void dip(glm::dvec2 place, const Pen& pen) override {
        take_pen(pen);
        travel(place);
        lower();
        lift();
    }
    void finish() override { write_text(options_.end); }

private:
    void put_down(glm::dvec2 from) override {
        require_on_page(from);
        begin_curve(from);
        travel(from);
        lower();
        feed_ = fmt::format(" F{}", decimal(settings_.speed ? 60 * *settings_.speed : options_.drawing_feed, 3));
    }
    void curve_point(glm::dvec2 point) override {
        require_on_page(point);
        ArcWriter::curve_point(point);
    }

    /// Moves the raised pen, unless it is there already.
    void travel(glm::dvec2 place) {
        if (is_placed_ && at_ == to_micrometres(place)) return;
        at_ = to_micrometres(place);
        is_placed_ = true;
        file_.write(
            fmt::format("G0 X{} Y{} F{}\n", decimal(at_.x, 3), decimal(at_.y, 3), decimal(options_.travel_feed, 3)));
    }

    /// Stops the machine for the pen of that number, unless it is the first, which is in place.
    using PlotWriter::take_pen;
    void take_pen(int next, Colour colour) override {
        colour_ = colour;
        write_comment(fmt::format("pen {}", next), colour_name(colour));
        if (pen_ != 0 && options_.park) travel(*options_.park);
        const bool is_first = pen_ == 0;
        pen_ = next;
        settings_ = pen_settings(options_.rules, next, colour);
        if (!is_first) {
            write_text(fill(options_.pen_change));
            is_placed_ = false;  // the user may move a paused machine
        }
        // A brush may have to be lifted higher than the pen before it.
        if (settings_.lift.value_or(options_.lift) != lifted_to_) lift();
    }

    void lower() {
        write_text(fill(options_.pen_down));
        pause();
    }
    void lift() {
        lifted_to_ = settings_.lift.value_or(options_.lift);
        write_text(fill(options_.pen_up));
        pause();
    }
    void pause() {
        if (settings_.pause.value_or(options_.pause) > 0) write_text(fill(options_.dwell));
    }

    /// Replaces the placeholders of commands.
    std::string fill(const std::string& commands) const {
        const double pause = settings_.pause.value_or(options_.pause);
        std::string text;
        for (std::size_t at = 0; at < commands.size();) {
            const std::size_t open = std::min(commands.find('{', at), commands.size());
            text.append(commands, at, open - at);
            if (open == commands.size()) break;
            const std::size_t close = std::min(commands.find('}', open), commands.size());
            const std::string_view name = std::string_view(commands).substr(open + 1, close - open - 1);
            if (name == "lift") {
                text += decimal(settings_.lift.value_or(options_.lift), 3);
            } else if (name == "down") {
                text += decimal(settings_.down.value_or(options_.down), 3);
            } else if (name == "pen") {
                text += std::to_string(pen_);
            } else if (name == "colour") {
                text += colour_name(colour_);
            } else if (name == "seconds") {
                text += decimal(pause, 3);
            } else if (name == "milliseconds") {
                text += std::to_string(std::lround(1000 * pause));
            } else {
                throw std::runtime_error(fmt::format("G-code: unknown placeholder {{{}}}", printable(name, 40)));
            }
            at = close + 1;
        }
        return text;
    }

    void write_comment(std::string_view label, std::string_view text) {
        file_.write(gcode_comment(label, text, options_.comment) + "\n");
    }

    void line_to(glm::dvec2 end) override {
        require_on_page(end);
        put("G1", end, "");
    }

    void arc_to(const PlotArc& arc, glm::dvec2 end) override {
        const glm::dvec2 centre = arc.centre - at_;
        put(arc.is_left ? "G3" : "G2", end, fmt::format(" I{} J{}", decimal(centre.x, 3), decimal(centre.y, 3)));
    }

    void put(std::string_view command, glm::dvec2 end, std::string_view more) {
        const glm::dvec2 next = to_micrometres(end);
        // An arc back to where it begins would be a whole circle.
        if (next == at_) return;
        at_ = next;
        file_.write(fmt::format("{} X{} Y{}{}{}\n", command, decimal(next.x, 3), decimal(next.y, 3), more, feed_));
        feed_.clear();
    }

    /// Writes commands of the machine, which may move it.
    void write_text(const std::string& text) {
        if (text.empty()) return;
        for_each_word(text, [&](char letter, double, std::string_view) {
            if (letter == 'X' || letter == 'Y') is_placed_ = false;
        });
        file_.write(text);
        if (text.back() != '\n') file_.write("\n");
    }

    GcodeOptions options_;
    Colour colour_;
    PenSettings settings_;    // settings of the current pen
    double lifted_to_ = 0;    // height of the raised pen
    glm::dvec2 at_{0.0};      // where it is, as it was written
    bool is_placed_ = false;  // its position as written
    std::string feed_;        // to be sent with the next command
};

}  // namespace

std::string gcode_comment(std::string_view label, std::string_view text, char mark) {
    std::string comment = fmt::format("{}{}: ", mark == ';' ? "; " : "(", label);
    const std::size_t most = comment.size() + longest_comment;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_inside_character = (byte & 0xc0U) == 0x80U;  // within a character of UTF-8
        if (is_inside_character || byte < 0x20 || byte == 0x7f) continue;
        if (std::string_view("!?~%();").find(c) != std::string_view::npos) continue;
        if (comment.size() == most) break;
        comment += byte < 0x80 ? c : '_';
    }
    return mark == ';' ? comment : comment + ")";
}

std::string_view unreachable_word(std::string_view lines) {
    std::string_view found;
    for_each_word(lines, [&](char letter, double value, std::string_view word) {
        const bool is_axis = letter == 'X' || letter == 'Y' || letter == 'Z';
        if (found.empty() && is_axis && !(std::fabs(value) <= farthest)) found = word;
    });
    return found;
}

std::optional<glm::dvec2> gcode_home(const GcodeOptions& options) {
    require(unreachable_word(options.end).empty(), "the last place of the pen must be within 10 m");
    std::optional<double> at[2];
    bool moves = false;
    for_each_word(options.end, [&](char letter, double value, std::string_view) {
        if (letter == 'G') moves = value == 0 || value == 1;
        if (moves && letter == 'X') at[0] = value;
        if (moves && letter == 'Y') at[1] = value;
    });
    if (!at[0] || !at[1]) return std::nullopt;
    return glm::dvec2(*at[0], *at[1]);
}

std::unique_ptr<PlotWriter> write_gcode(const Print& print, const GcodeOptions& options, Output& file) {
    return std::make_unique<GcodeWriter>(print, options, file);
}

}  // namespace sikku
