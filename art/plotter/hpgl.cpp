#include "art/plotter/hpgl.h"

#include "art/print/micrometres.h"
#include "art/print/recipe_comments.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace sikku {
namespace {

/// Rounding moves a point by up to 0.71 units: this much is left for chords.
constexpr double chord_units = 0.28;
/// Plotters store an instruction in a small memory.
constexpr std::size_t longest_instruction = 200;

using Units = glm::ivec2;

/// A paper size of the HP 7475A, in plotter units.
struct Sheet {
    std::string_view name;
    glm::dvec2 limits, first, second;  ///< the largest coordinates; the scaling points
};
const std::array<Sheet, 4> sheets = {{{"a4", {11040, 7721}, {603, 521}, {10603, 7721}},
                                      {"a3", {16158, 11040}, {170, 602}, {15370, 10602}},
                                      {"letter", {10365, 7962}, {250, 596}, {10250, 7796}},
                                      {"tabloid", {16640, 10365}, {522, 259}, {15722, 10259}}}};

bool is_turned(const Page& page) {
    return page.height > page.width;
}

/// Converts a point of the page, y up, into plotter coordinates.
glm::dvec2 on_plotter(glm::dvec2 point, const Page& page, const HpglOptions& options) {
    const glm::dvec2 size(page.width, page.height);
    const glm::dvec2 at = is_turned(page) ? glm::dvec2(size.y - point.y, point.x) : point;
    if (!options.paper) return at;
    const glm::dvec2 half = 0.5 * (is_turned(page) ? glm::dvec2(size.y, size.x) : size);
    return at + options.paper->centre - half;
}

/// The inverse of on_plotter(). `options` has a paper.
glm::dvec2 on_page_at(glm::dvec2 point, const Page& page, const HpglOptions& options) {
    const glm::dvec2 size(page.width, page.height);
    const glm::dvec2 at = point - options.paper->centre + 0.5 * (is_turned(page) ? glm::dvec2(size.y, size.x) : size);
    return is_turned(page) ? glm::dvec2(at.y, size.y - at.x) : at;
}

class HpglWriter final : public PlotWriter {
public:
    HpglWriter(const Print& print, const HpglOptions& options, Output& file)
        : PlotWriter(print, file, chord_units * options.unit, 1), options_(options) {
        has_speeds_ = std::any_of(options.rules.begin(), options.rules.end(),
                                  [](const PenRule& rule) { return rule.settings.speed.has_value(); });
        file_.write("IN;\n");
    }

    void lines(std::span<const glm::dvec2> ends) override {
        start();
        for (const glm::dvec2 end : ends) to(on_page(here_ = end));
    }
    void dip(glm::dvec2 place, const Pen& pen) override {
        take_pen(pen);
        file_.write(fmt::format("{}PD;PU;\n", move("refilling", place)));
        at_.reset();
    }
    void end_stroke(bool) override {
        if (!started_) return;
        if (!moved_) put(*at_);  // a dot
        end_instruction();
        started_ = false;
    }
    /// The recipe comes last: plotters before HP-GL/2 reject comments, and report the error only after the plot.
    void finish() override {
        file_.write("PU;SP0;\n");
        for (const std::string& piece : recipe_comments(print_.pattern, print_.made)) {
            file_.write("CO\"" + piece + "\";\n");
        }
    }

private:
    using PlotWriter::take_pen;
    void take_pen(int next, Colour colour) override {
        const bool parks = options_.park && pen_ != 0;
        file_.write(fmt::format("{}SP{};\n", parks ? "PU;" + move("parking", *options_.park) : "PU;", next));
        pen_ = next;
        at_.reset();  // the plotter went to the stalls
        if (!has_speeds_) return;
        const double speed = pen_settings(options_.rules, next, colour).speed.value_or(options_.speed);
        file_.write(fmt::format("VS{};\n", decimal(speed / 10, 2)));
    }

    /// Moves the lifted pen to a place that may lie off the page. @param purpose  `parking` or `refilling`
    std::string move(std::string_view purpose, glm::dvec2 place) const {
        const glm::dvec2 on = on_plotter(place, print_.page, options_);
        if (!is_in_reach(on)) {
            const HpglPaper& paper = *options_.paper;
            const glm::dvec2 one = on_page_at(paper.low, print_.page, options_);
            const glm::dvec2 two = on_page_at(paper.high, print_.page, options_);
            const glm::dvec2 low = glm::min(one, two), high = glm::max(one, two);
            throw std::runtime_error(
                fmt::format("the place for {} ({:g},{:g}) is out of the plotter's reach{}; expected x from {:.1f} to "
                            "{:.1f} mm and y from {:.1f} to {:.1f} mm",
                            purpose, place.x, place.y, sheet_name(), low.x, high.x, low.y, high.y));
        }
        const Units at = to_units(on);
        return fmt::format("PU{},{};", at.x, at.y);
    }

    void put_down(glm::dvec2 millimetres) override {
        moved_ = false;
        const Units from = rounded(millimetres);
        file_.write(at_ == from ? "PU;\n" : fmt::format("PU{},{};\n", from.x, from.y));
        at_ = from;
    }
    void curve_point(glm::dvec2 point) override { to(point); }

    Units rounded(glm::dvec2 millimetres) const {
        require_on_page(millimetres);
        const glm::dvec2 at = on_plotter(millimetres, print_.page, options_);
        if (!is_in_reach(at)) refuse_drawing();
        return to_units(at);
    }

    Units to_units(glm::dvec2 at) const { return {to_whole(at.x / options_.unit), to_whole(at.y / options_.unit)}; }

    bool is_in_reach(glm::dvec2 at) const {
        if (!options_.paper) return true;
        const HpglPaper& paper = *options_.paper;
        constexpr double reach_slack = 1e-6;
        return at.x >= paper.low.x - reach_slack && at.y >= paper.low.y - reach_slack &&
               at.x <= paper.high.x + reach_slack && at.y <= paper.high.y + reach_slack;
    }

    std::string sheet_name() const {
        return options_.paper->is_hp7475a ? fmt::format(" on {} (HP 7475A)", options_.paper->name) : "";
    }

    [[noreturn]] void refuse_drawing() const {
        const HpglPaper& paper = *options_.paper;
        const glm::dvec2 reach = paper.high - paper.low;
        const double margin = hpgl_margin(paper, print_.page);
        const bool has_room = 2 * margin < std::min(print_.page.width, print_.page.height);
        throw std::runtime_error(
            fmt::format("the drawing exceeds the {:.0f} x {:.0f} mm that the plotter reaches{}; {}", reach.x, reach.y,
                        sheet_name(),
                        has_room ? fmt::format("a margin of {:.1f}mm keeps it inside", margin)
                                 : std::string("choose a smaller page")));
    }

    void to(glm::dvec2 millimetres) {
        const Units next = rounded(millimetres);
        if (next == at_) return;
        at_ = next;
        moved_ = true;
        put(next);
    }

    void put(Units point) {
        fmt::format_to(std::back_inserter(instruction_), "{}{},{}", instruction_.empty() ? "PD" : ",", point.x,
                       point.y);
        if (instruction_.size() > longest_instruction) end_instruction();
    }

    void end_instruction() {
        if (instruction_.empty()) return;
        file_.write(instruction_ + ";\n");
        instruction_.clear();
    }

    const HpglOptions& options_;
    bool has_speeds_ = false;
    bool moved_ = false;       // the lowered pen has drawn something
    std::optional<Units> at_;  // position of the pen, if known
    std::string instruction_;
};

}  // namespace

std::optional<HpglPaper> parse_hpgl_paper(std::string_view text, double dpi) {
    HpglPaper paper;
    const std::size_t comma = text.find(',');
    const bool is_centred = comma != std::string_view::npos;
    if (is_centred && text.substr(comma) != ",centre" && text.substr(comma) != ",center") return std::nullopt;
    paper.name = text.substr(0, comma);
    const auto size = parse_size(paper.name, dpi);
    if (!size || !(size->x >= 1 && size->y >= 1 && size->x <= 1e5 && size->y <= 1e5)) return std::nullopt;
    for (const Sheet& sheet : sheets) {
        if (is_centred || lower_case(paper.name) != sheet.name) continue;
        paper.high = sheet.limits * hpgl_unit;
        paper.centre = 0.5 * (sheet.first + sheet.second) * hpgl_unit;
        paper.is_hp7475a = true;
        return paper;
    }
    paper.high = {std::max(size->x, size->y), std::min(size->x, size->y)};
    if (is_centred) {
        paper.high *= 0.5;
        paper.low = -paper.high;
    } else {
        paper.centre = 0.5 * paper.high;
    }
    return paper;
}

HpglPaper paper_for(const HpglPaper& paper, const Page& page) {
    if (!paper.is_hp7475a) return paper;
    for (const char* name : {"A4", "A3", "letter", "tabloid"}) {
        const auto size = parse_size(name, 96);
        constexpr double slack = 0.1;  // millimetres
        const auto same = [](double a, double b) { return std::fabs(a - b) < slack; };
        if (size && same(std::max(page.width, page.height), std::max(size->x, size->y)) &&
            same(std::min(page.width, page.height), std::min(size->x, size->y))) {
            return parse_hpgl_paper(name, 96).value_or(paper);
        }
    }
    return paper;
}

HpglPaper with_unit(const HpglPaper& paper, double unit) {
    HpglPaper result = paper;
    if (!paper.is_hp7475a) return result;
    for (glm::dvec2* place : {&result.low, &result.high, &result.centre}) *place *= unit / hpgl_unit;
    return result;
}

double hpgl_margin(const HpglPaper& paper, const Page& page) {
    // The centred area that fits in both orientations: equally far from the middle of the sheet on both sides.
    const glm::dvec2 free = glm::min(paper.high - paper.centre, paper.centre - paper.low);
    const glm::dvec2 half = 0.5 * glm::dvec2(std::max(page.width, page.height), std::min(page.width, page.height));
    const double margin = std::max({half.x - free.x, half.y - free.y, 0.0});
    return std::ceil(10 * margin - 1e-6) / 10;
}

glm::dvec2 hpgl_origin(const Page& page, const HpglOptions& options) {
    const glm::dvec2 corner = on_plotter({0.0, 0.0}, page, options);  // corner of the page
    return is_turned(page) ? glm::dvec2(-corner.y, corner.x) : -corner;
}

std::string describe_hpgl(const Page& page, const HpglOptions& options) {
    std::string origin = "the bottom left corner of the page";
    if (is_turned(page)) origin = "the top left corner of the page";
    if (options.paper) {
        const HpglPaper& paper = *options.paper;
        origin = paper.is_hp7475a               ? fmt::format("that of an HP 7475A with a sheet of {}", paper.name)
                 : paper.low == glm::dvec2(0.0) ? "the bottom left corner of the plotter's limits"
                                                : "the middle of the plotter's limits";
    }
    return fmt::format("the origin is {}, the x axis runs along the long side{}", origin,
                       is_turned(page) ? "; the page is turned by 90 degrees anticlockwise" : "");
}

std::unique_ptr<PlotWriter> write_hpgl(const Print& print, const HpglOptions& options, Output& file) {
    return std::make_unique<HpglWriter>(print, options, file);
}

}  // namespace sikku
