#include "art/plotter/gcode.h"

#include "art/print/micrometres.h"
#include "art/print/recipe_comments.h"
#include "engine/base/decimal.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace sikku {
namespace {

// Of the 0.01 mm that a curve may be off (all in mm): chords between the points that stand for it are off by `chord`,
// an arc is off its chords by at most twice as much, and the points are off what is fitted to them by `fit`. The rest
// is for rounding ends and centres to 0.001 mm.
constexpr double chord = 0.0005;
constexpr double fit = 0.0065;
constexpr double largest_radius = 1000.0;    // controllers count in single precision
constexpr double largest_sweep = 4.7;        // radians; an arc's ends must not fall together
constexpr std::size_t most_points = 8192;    // that wait for what comes next
constexpr std::size_t longest_comment = 60;  // grbl takes lines of 80 bytes

glm::dvec2 rounded(glm::dvec2 point) {
    return {std::round(point.x * 1000) / 1000, std::round(point.y * 1000) / 1000};
}

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// An arc from one point to another around a centre, anticlockwise if `left`.
struct Arc {
    glm::dvec2 centre{0.0};
    bool left = false;
};

/// The circle through three points; nullopt if they lie too straight.
std::optional<Arc> arc_through(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    const glm::dvec2 to_b = b - a;
    const glm::dvec2 to_c = c - a;
    const double twice = 2 * cross(to_b, to_c);
    const glm::dvec2 offset =
        (glm::dvec2(to_c.y, -to_c.x) * glm::dot(to_b, to_b) + glm::dvec2(-to_b.y, to_b.x) * glm::dot(to_c, to_c)) /
        twice;
    // False for NaN.
    if (!(glm::length(offset) <= largest_radius)) return std::nullopt;
    return Arc{a + offset, twice > 0};
}

bool line_fits(std::span<const glm::dvec2> points) {
    const glm::dvec2 whole = points.back() - points.front();
    const double length = glm::length(whole);
    if (length == 0) return points.size() <= 2;
    double reached = 0;
    for (const glm::dvec2 point : points) {
        const glm::dvec2 way = point - points.front();
        const double along = glm::dot(way, whole) / length;
        if (std::fabs(cross(way, whole)) > fit * length || along < reached - fit) return false;
        reached = std::max(reached, along);
    }
    return reached <= length + fit;
}

std::optional<Arc> fitting_arc(std::span<const glm::dvec2> points) {
    if (points.size() < 3) return std::nullopt;
    const auto arc = arc_through(points.front(), points[points.size() / 2], points.back());
    if (!arc) return std::nullopt;
    const double radius = glm::distance(arc->centre, points.front());
    double sweep = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec2 from = points[i - 1] - arc->centre;
        const glm::dvec2 to = points[i] - arc->centre;
        const glm::dvec2 way = to - from;
        sweep += cross(from, to) / (radius * radius) * (arc->left ? 1 : -1);
        if (std::fabs(glm::length(to) - radius) > fit || glm::dot(way, way) > 16 * chord * radius ||
            (cross(from, to) > 0) != arc->left) {
            return std::nullopt;
        }
    }
    return sweep <= largest_sweep ? arc : std::nullopt;
}

/// The last of `count` points up to which fits(last) holds, searched for in doubling steps from `known`.
template <class Fits>
std::size_t longest(std::size_t known, std::size_t count, std::size_t step, const Fits& fits) {
    const auto extend = [&] {
        const bool more = known + step < count && fits(known + step);
        if (more) known += step;
        return more;
    };
    while (extend()) step *= 2;
    for (; step > 0; step /= 2) extend();
    return known;
}

void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(fmt::format("G-code: {}", what));
}

class Writer final : public PlotWriter {
public:
    Writer(const Print& print, const GcodeOptions& options, Output& file)
        : PlotWriter(print), options_(options), file_(file) {
        for (const double feed : {options.drawing_feed, options.travel_feed, options.z_feed}) {
            require(std::isfinite(feed) && feed > 0, "a feed is finite and above 0 mm/min");
        }
        require(std::isfinite(options.z_up) && std::isfinite(options.z_down), "a height is finite");
        require(std::isfinite(options.power) && options.power >= 0, "the power is finite and at least 0");
        require(std::isfinite(options.pause) && options.pause >= 0, "the pause is finite and at least 0 s");
        if (!print.title.empty()) file_.write(gcode_comment("title", print.title) + "\n");
        for (const std::string& piece : recipe_comments(print.pattern, print.made)) {
            file_.write(gcode_comment("recipe", piece) + "\n");
        }
        file_.write("G21 G90 G17\n");
        write_text(options.start);
        lift();
    }

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        here_ = start;
        if (const int next = number(pen); next != pen_) {
            const std::string colour = colour_name(print_.style.line_colour(pen));
            file_.write(gcode_comment(fmt::format("pen {}", next), colour) + "\n");
            if (pen_ != 0) file_.write(fmt::format("T{}\nM0\n", next));
            pen_ = next;
        }
        started_ = false;
    }
    void lines(std::span<const glm::dvec2> ends) override {
        start();
        follow(true);
        for (const glm::dvec2 end : ends) {
            here_ = end;
            points_ = {on_page(end)};
            line_to(points_.front());
        }
    }
    void curves(std::span<const glm::dvec2> controls) override {
        start();
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            const Bezier bezier = {on_page(here_), on_page(controls[i]), on_page(controls[i + 1]),
                                   on_page(controls[i + 2])};
            // Also enough of them for an arc of a small circle.
            const int count = std::max(4, chords(bezier, chord));
            for (int k = 1; k <= count; ++k) {
                points_.push_back(k < count ? at(bezier, static_cast<double>(k) / count) : bezier[3]);
                require_on_page(points_.back());
                if (points_.size() >= most_points) follow(false);
            }
            here_ = controls[i + 2];
        }
    }
    void end_stroke(bool) override {
        if (!started_) return;
        follow(true);
        started_ = false;
        lift();
    }
    void finish() override { write_text(options_.end); }

private:
    /// Only when something is drawn: a stroke may change its pen before.
    void start() {
        if (started_) return;
        started_ = true;
        points_ = {on_page(here_)};
        require_on_page(points_.front());
        at_ = rounded(points_.front());
        file_.write(
            fmt::format("G0 X{} Y{} F{}\n", decimal(at_.x, 3), decimal(at_.y, 3), decimal(options_.travel_feed, 3)));
        if (options_.lifts_by_z) {
            file_.write(fmt::format("G1 Z{} F{}\n", decimal(options_.z_down, 3), decimal(options_.z_feed, 3)));
        } else {
            file_.write(fmt::format("M3 S{}\n", decimal(options_.power, 3)));
            pause();
        }
        feed_ = fmt::format(" F{}", decimal(options_.drawing_feed, 3));
    }

    void lift() {
        if (options_.lifts_by_z) {
            file_.write(fmt::format("G0 Z{}\n", decimal(options_.z_up, 3)));
        } else {
            file_.write("M5\n");
            pause();
        }
    }

    void pause() {
        if (options_.pause > 0) file_.write(fmt::format("G4 P{}\n", decimal(options_.pause, 3)));
    }

    /// Lines and arcs along the points that wait; the last of them is kept if more may come.
    void follow(bool is_all) {
        const std::span<const glm::dvec2> all(points_);
        std::size_t done = 0;
        while (done + 1 < all.size()) {
            const auto rest = all.subspan(done);
            const std::size_t line =
                longest(1, rest.size(), 1, [&](std::size_t last) { return line_fits(rest.first(last + 1)); });
            // Where it is almost straight no short arc fits.
            const std::size_t last = longest(line, rest.size(), (line + 1) / 2, [&](std::size_t end) {
                return fitting_arc(rest.first(end + 1)).has_value();
            });
            if (!is_all && done > 0 && last + 1 == rest.size()) break;
            if (last > line) {
                arc_to(*fitting_arc(rest.first(last + 1)), rest[last]);
            } else {
                line_to(rest[last]);
            }
            done += last;
        }
        points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(done));
    }

    void line_to(glm::dvec2 end) {
        require_on_page(end);
        put("G1", end, "");
    }

    void arc_to(const Arc& arc, glm::dvec2 end) {
        const glm::dvec2 centre = arc.centre - at_;
        put(arc.left ? "G3" : "G2", end, fmt::format(" I{} J{}", decimal(centre.x, 3), decimal(centre.y, 3)));
    }

    void put(std::string_view command, glm::dvec2 end, std::string_view more) {
        const glm::dvec2 next = rounded(end);
        // An arc back to where it begins would be a whole circle.
        if (next == at_) return;
        at_ = next;
        file_.write(fmt::format("{} X{} Y{}{}{}\n", command, decimal(next.x, 3), decimal(next.y, 3), more, feed_));
        feed_.clear();
    }

    void write_text(const std::string& text) {
        if (text.empty()) return;
        file_.write(text);
        if (text.back() != '\n') file_.write("\n");
    }

    GcodeOptions options_;
    Output& file_;
    int pen_ = 0;
    bool started_ = false;            // the pen is down
    glm::dvec2 at_{0.0};              // where it is, as it was written
    std::vector<glm::dvec2> points_;  // of curves, from the last command's end
    std::string feed_;                // to be told with the next command
};

}  // namespace

std::string gcode_comment(std::string_view label, std::string_view text) {
    std::string comment = fmt::format("({}: ", label);
    const std::size_t most = comment.size() + longest_comment;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_inside_character = (byte & 0xc0U) == 0x80U;  // of UTF-8
        if (is_inside_character || byte < 0x20 || byte == 0x7f) continue;
        if (std::string_view("!?~%();").find(c) != std::string_view::npos) continue;
        if (comment.size() == most) break;
        comment += byte < 0x80 ? c : '_';
    }
    return comment + ")";
}

std::optional<glm::dvec2> gcode_home(const GcodeOptions& options) {
    std::optional<double> at[2];
    bool moves = false;
    const std::string& text = options.end;
    for (std::size_t i = 0; i < text.size(); ++i) {
        // Comments may contain any characters.
        if (text[i] == '(' || text[i] == ';') {
            i = text.find(text[i] == '(' ? ')' : '\n', i);
            if (i == std::string::npos) break;
            continue;
        }
        const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(text[i])));
        double value = 0;
        const std::string_view rest = std::string_view(text).substr(i + 1);
        if (letter < 'A' || letter > 'Z' || parse_number(rest, value).ec != std::errc()) continue;
        if (letter == 'G') moves = value == 0 || value == 1;
        if (moves && letter == 'X') at[0] = value;
        if (moves && letter == 'Y') at[1] = value;
    }
    if (!at[0] || !at[1]) return std::nullopt;
    return glm::dvec2(*at[0], *at[1]);
}

std::optional<GcodeOptions> gcode_profile(std::string_view name) {
    GcodeOptions options;
    options.lifts_by_z = name == "z";
    return name == "grbl" || name == "z" ? std::optional(options) : std::nullopt;
}

std::unique_ptr<PlotWriter> write_gcode(const Print& print, const GcodeOptions& options, Output& file) {
    return std::make_unique<Writer>(print, options, file);
}

}  // namespace sikku
