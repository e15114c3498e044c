#include "art/print/border.h"

#include "art/print/border_ink.h"
#include "art/print/ornaments.h"
#include "art/style/white_paper.h"
#include "engine/geometry/moved_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

// Shares of the border's depth; a loop takes two radii and the line's width.
constexpr double loop_share = 0.38;
constexpr double line_share = 0.24;
constexpr double earth_share = 0.6;  // share of the line's width
constexpr double dot_share = 0.4;    // share of the loop

/// A kind of border, and its depth relative to BorderKind::kaavi.
struct BorderRow {
    BorderKind kind;
    double depth;
    void (*draw)(std::span<const BorderSide, 4> sides, double depth, BorderInk& ink) = nullptr;
};
constexpr std::array<BorderRow, 9> border_rows = {{{BorderKind::kaavi, 1.0},
                                                   {BorderKind::padi, 1.9, draw_padi},
                                                   {BorderKind::lotus, 1.75, draw_lotus},
                                                   {BorderKind::rope, 1.35, draw_rope},
                                                   {BorderKind::diamonds, 1.5, draw_diamonds},
                                                   {BorderKind::waves, 1.5, draw_waves},
                                                   {BorderKind::marigolds, 1.6, draw_marigolds},
                                                   {BorderKind::lamps, 1.75, draw_lamps},
                                                   {BorderKind::pattern, 1.6}}};

const BorderRow& row_of(BorderKind kind) {
    return *std::find_if(border_rows.begin(), border_rows.end(), [&](const auto& row) { return row.kind == kind; });
}

double thickness(const Page& page) {
    return std::min(page.width, page.height) / 24;
}

/// A line of red earth between thin ones of rice flour, with a loop around a dot in each corner.
void draw_kaavi(const Print& print, const Window& window, double width, int colour, PathSink& sink) {
    BorderInk ink(print, colour, sink);
    const double radius = width * loop_share;
    const double line = width * line_share;
    // Page units, y down, clockwise from the top left corner; the sides lie one loop within the margin.
    const double inset = window.margin + 2 * radius + line / 2;
    const double left = window.left + inset;
    const double top = window.top + inset;
    const double right = window.left + window.width - inset;
    const double bottom = window.top + window.height - inset;
    const std::array<glm::dvec2, 4> corners = {glm::dvec2(left, top), glm::dvec2(right, top),
                                               glm::dvec2(right, bottom), glm::dvec2(left, bottom)};
    const std::array<glm::dvec2, 4> ways = {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(-1, 0), glm::dvec2(0, -1)};
    for (const bool is_earth : {false, true}) {
        // A pen plotter cannot paint over lines.
        if (print.is_plot && !is_earth) continue;
        ink.begin(corners[0] + radius * ways[0], is_earth ? line * earth_share : line, is_earth ? 1 : 0);
        for (std::size_t side = 0; side < 4; ++side) {
            const glm::dvec2 along = ways[side];
            const glm::dvec2 out = ways[(side + 3) % 4];
            const glm::dvec2 corner = corners[(side + 1) % 4];
            ink.line(corner + radius * along);
            // Three quarters around the dot, then down the next side.
            const glm::dvec2 centre = corner + radius * (along + out);
            ink.arc(centre, radius, -out, along, 3);
            ink.line(corner - radius * out);
        }
        ink.end(true);
    }
    for (std::size_t side = 0; side < 4; ++side) {
        const glm::dvec2 centre = corners[side] - radius * (ways[side] + ways[(side + 1) % 4]);
        sink.disc(ink.drawn(centre), radius * dot_share / print.placement.step, ink.pen(line * earth_share, 1));
    }
}

/// Passes on a recorded drawing in the pens of the border, whose colours are consecutive: each pen's line, then its
/// fill.
class MotifPens : public PathFilter {
public:
    /// @param step   millimetres of a step
    MotifPens(BorderInk& ink, const Style& style, double step, int first, PathSink& sink)
        : Forwarding(sink), ink_(ink), style_(style), step_(step), first_(first) {}
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, line(pen)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(line(pen)); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        sink_.polygon(vertices, fill(pen));
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override { sink_.area(outline, fill(pen)); }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha == 0) return;
        // A radius of 0 is a dot, sized by the pen.
        const double steps = radius > 0 ? radius : style_.line_width(pen, step_) / step_;
        sink_.disc(centre, steps, fill(pen));
    }

private:
    Pen line(const Pen& pen) const {
        return ink_.pen(style_.draws(pen) ? style_.line_width(pen, step_) : 0.0, first_ + 2 * style_.index(pen));
    }
    Pen fill(const Pen& pen) const { return ink_.pen(1.0, first_ + 2 * style_.index(pen) + 1); }

    BorderInk& ink_;
    const Style& style_;
    double step_;
    int first_;
};

std::vector<Colour> motif_colours(const Style& style) {
    std::vector<Colour> colours;
    for (int i = 0; i < static_cast<int>(std::max<std::size_t>(style.palette.size(), 1)); ++i) {
        colours.push_back(style.line_colour(Pen{.colour = i}));
        colours.push_back(style.fill_colour(Pen{.colour = i}));
    }
    return colours;
}

/// Records which colours of its style a recorded drawing uses, in the order of motif_colours().
class ColourCensus : public PathSink {
public:
    explicit ColourCensus(const Style& style) : style_(style), is_used_(motif_colours(style).size()) {}
    void begin_stroke(glm::dvec2, const Pen& pen) override { change_pen(pen); }
    void change_pen(const Pen& pen) override {
        if (style_.draws(pen)) is_used_[2 * place(pen)] = 1;
    }
    void lines(std::span<const glm::dvec2>) override {}
    void curves(std::span<const glm::dvec2>) override {}
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen& pen) override { fill(pen); }
    void area(std::span<const glm::dvec2>, const Pen& pen) override { fill(pen); }
    void disc(glm::dvec2, double, const Pen& pen) override { fill(pen); }
    const std::vector<char>& is_used() const { return is_used_; }

private:
    std::size_t place(const Pen& pen) const { return static_cast<std::size_t>(style_.index(pen)); }
    void fill(const Pen& pen) {
        if (style_.fill_colour(pen).alpha > 0) is_used_[2 * place(pen) + 1] = 1;
    }
    const Style& style_;
    std::vector<char> is_used_;
};

/// The colours of a motif. Lines that would vanish on the ground get `visible` instead, unless fills may lie under
/// them; fills do if nothing else of the motif is visible.
std::vector<Colour> seen_colours(const BorderMotif& motif, Colour ground, Colour visible) {
    constexpr double least = 0.2;  // in OKLab: lines are thin
    std::vector<Colour> colours = motif_colours(motif.style);
    ColourCensus census(motif.style);
    motif.path.draw(census);
    const auto is_seen = [&](std::size_t i) { return colour_distance(colours[i], ground) >= least; };
    bool shows_lines = false, shows_fills = false;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        if (census.is_used()[i]) (i % 2 == 0 ? shows_lines : shows_fills) |= is_seen(i);
    }
    if (shows_fills) return colours;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        if (!is_seen(i) && colours[i].alpha > 0 && (i % 2 == 0 || !shows_lines)) colours[i] = visible;
    }
    return colours;
}

/// Draws a motif with its box in an area of a side.
/// @param corner, along, down  the area on the page: its top left corner for the upright motif, and its sides
void draw_motif(const BorderMotif& motif, glm::dvec2 corner, glm::dvec2 along, glm::dvec2 down, int first,
                BorderInk& ink) {
    const glm::dvec2 size = motif.box.high - motif.box.low;
    const glm::dvec2 x = along / size.x, y = -1.0 * down / size.y;
    const glm::dmat3x2 to_page(x, y, corner - motif.box.low.x * x - motif.box.high.y * y);
    const glm::dmat3x2 from_page = ink.from_page();
    const glm::dmat2x2 turn(from_page[0], from_page[1]);
    const glm::dmat3x2 map(turn * to_page[0], turn * to_page[1], turn * to_page[2] + from_page[2]);
    MotifPens pens(ink, motif.style, glm::length(down) / size.y, first, ink.sink());
    MovedPath moved(pens, map);
    motif.path.draw(moved);
}

void draw_pattern(const Border& border, std::span<const BorderSide, 4> sides, double depth, BorderInk& ink) {
    const BorderMotif& repeat = *border.repeat;
    const glm::dvec2 size = repeat.box.high - repeat.box.low;
    const double across = sides[0].length - 2 * depth, down = sides[1].length - 2 * depth;
    const BorderRepeats repeats = border_repeats(across, down, size.x * depth / size.y);
    const int corner_colours = static_cast<int>(motif_colours(repeat.style).size());
    for (std::size_t i = 0; i < 4; ++i) {
        const BorderSide& side = sides[i];
        const int count = i % 2 == 0 ? repeats.across : repeats.down;
        const double length = (side.length - 2 * depth) / count;
        for (int k = 0; k < count; ++k) {
            draw_motif(repeat, side.at({depth + k * length, 0}), length * side.along, depth * side.inwards, 0, ink);
        }
        if (border.corner) {
            draw_motif(*border.corner, side.corner, depth * side.along, depth * side.inwards, corner_colours, ink);
            continue;
        }
        const glm::dvec2 centre = side.at({depth / 2, depth / 2});
        const double radius = depth * 0.3;
        const double width = repeat.style.draws({}) ? repeat.style.line_width({}, depth / size.y) : depth / 12;
        ink.begin(centre + radius * side.along, width, 0);
        ink.arc(centre, radius, side.along, side.inwards, 4);
        ink.end(true);
        ink.disc(centre, depth * 0.1, 0);
    }
}

}  // namespace

double step_within_border(const Page& page, glm::dvec2 size) {
    constexpr double filled = 0.85;  // share of the page
    return filled * std::min(page.width / size.x, page.height / size.y);
}

double border_weight(const Page& page, double line) {
    constexpr double fine = 0.1, bold = 0.25;  // widths of lines relative to the thickness
    constexpr double least = 0.8, most = 1.25;
    const double width = line / thickness(page);
    const double usual = std::clamp(width, fine, bold);
    return std::clamp(std::sqrt(width / usual), least, most);
}

double border_depth(const Border& border, const Page& page) {
    return row_of(border.kind).depth * thickness(page) * border.weight;
}

double border_room(const Border& border, const Page& page) {
    return border_depth(border, page) + (border.kind == BorderKind::kaavi ? 0.6 : 0.8) * thickness(page);
}

std::vector<Colour> border_colours(const Border& border, const std::optional<Colour>& ground) {
    constexpr double least = 0.14;  // in OKLab
    const Colour white = kolam_palette().front();
    const Colour under = ground_or_white(ground);
    const Colour pale_earth{0xe0, 0x7a, 0x50, 255};
    const bool is_light = lightness(under) > 0.6;
    if (border.kind == BorderKind::pattern) {
        std::vector<Colour> colours = seen_colours(*border.repeat, under, is_light ? deep_earth : white);
        if (!border.corner) return colours;
        for (const Colour colour : seen_colours(*border.corner, under, is_light ? deep_earth : white)) {
            colours.push_back(colour);
        }
        return colours;
    }
    if (is_light) return {deep_earth, kaavi};
    return {white, colour_distance(kaavi, under) >= least ? kaavi : pale_earth};
}

BorderRepeats border_repeats(double across, double down, double length) {
    const auto count = [](double side, double each) { return std::max(1.0, std::round(side / each)); };
    constexpr double most_repeats = 10'000;
    if (!(across < most_repeats * length && down < most_repeats * length)) {
        throw std::runtime_error(
            fmt::format("the pattern of the border is too thin: a side would repeat it more than "
                        "{} times",
                        most_repeats));
    }
    const double usual = count(across, length);
    BorderRepeats best;
    double least = 1e300;
    for (double n = std::max(1.0, std::floor(usual * 0.88)); n <= std::ceil(usual * 1.12); ++n) {
        const double m = count(down, across / n);
        const double stretch = std::fabs(std::log(across / n / length)) + std::fabs(std::log(down / m / length));
        const double score = std::fabs(std::log((down / m) / (across / n))) + 0.05 * stretch;
        if (score < least) {
            least = score;
            best = {static_cast<int>(n), static_cast<int>(m)};
        }
    }
    return best;
}

void draw_border(const Border& border, const Print& print, const Window& window, int colour, PathSink& sink) {
    const double depth = border_depth(border, {window.width, window.height, window.margin});
    if (border.kind == BorderKind::kaavi) return draw_kaavi(print, window, depth, colour, sink);
    const auto sides = border_sides(window);
    // A cell may be too small for any frame.
    if (std::min(sides[0].length, sides[1].length) < 3 * depth) return;
    BorderInk ink(print, colour, sink);
    if (border.kind == BorderKind::pattern) return draw_pattern(border, sides, depth, ink);
    row_of(border.kind).draw(sides, depth, ink);
}

}  // namespace sikku
