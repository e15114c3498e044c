#include "art/drawing/framed_drawing.h"

#include "art/print/border_ink.h"
#include "art/print/ornaments.h"
#include "art/style/white_paper.h"
#include "engine/base/option.h"
#include "engine/geometry/moved_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double letter_stem = 0.085;
constexpr double foot_share = 2.6;   // space for letters of the usual size, as part of their height
constexpr double large_share = 1.8;  // the same for what a title is higher than them
constexpr double most_of_page = 0.4;
constexpr double thickest = 0.25;  // of strokes, as part of the height of capitals
constexpr double least_title = 4;  // room for a title, as part of its height
constexpr double edition_gap = 2;  // between title and edition, as part of the height of the edition

/// Usual height of capitals in millimetres.
double letters_of(const Page& page) {
    return std::clamp(std::min(page.width, page.height) * 0.0125, 1.2, 14.0);
}

/// Height of the space for letters of a height.
double space_of(double height, const Page& page) {
    const double usual = std::min(height, letters_of(page));
    return foot_share * usual + large_share * (height - usual);
}

Page page_of(const Window& window) {
    return {window.width, window.height, window.margin};
}

bool has_text(const DrawingOptions& options) {
    return options.title_line || !options.edition.empty();
}

/// Omits lines, for drawings without a pen whose frame has one.
class WithoutLines : public PathFilter {
public:
    using Forwarding::Forwarding;
    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, bare(pen)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(bare(pen)); }

private:
    static Pen bare(Pen pen) {
        pen.width = 0;
        pen.width_set = true;
        return pen;
    }
};

}  // namespace

bool has_frame(const Style& style, const DrawingOptions& options) {
    return style.border || has_text(options);
}

FramedDrawing::FramedDrawing(std::unique_ptr<Drawing> inner, std::optional<Border> border,
                             const DrawingOptions& options, const Reading& reading)
    : DerivedDrawing(std::move(inner), options, reading), letters_(options.font), border_(std::move(border)) {
    style_.stroked = true;
    if (border_) {
        border_colour_ = static_cast<int>(style_.palette.size());
        for (const Colour colour : border_colours(*border_, style_.ground)) style_.palette.push_back(colour);
    }
    if (!has_text(options_)) return;
    const std::string title = options_.title_line.value_or("");
    ascent_ = letters_.ascent(title, 1);
    depth_ = std::max(letters_.depth(title, 1), letters_.depth(options_.edition, 1));
    constexpr double least = 0.25;  // in OKLab
    const Colour ground = ground_or_white(style_.ground);
    Colour ink = style_.line_colour({});
    if (ink.alpha < 255 || colour_distance(ink, ground) < least) {
        ink = lightness(ground) < 0.6 ? Colour{255, 255, 255, 255} : Colour{0, 0, 0, 255};
    }
    text_colour_ = static_cast<int>(style_.palette.size());
    style_.palette.push_back(ink);
}

const DrawnExtent& FramedDrawing::seen() {
    const DrawnExtent& seen = inner_->seen();
    const Box& box = options_.frame ? options_.frame->box : seen.box;
    if (!box.empty()) size_ = box.size();
    return seen;
}

/// The border in the weight that suits the lines, if these are as wide as the drawing is large. Copies that fill the
/// page cannot determine it, because the border determines their size.
Border FramedDrawing::border_on(const Page& page) const {
    Border border = *border_;
    const double line = drawn_.pen_width({});
    const bool is_filled = options_.repeat && options_.repeat->fills;
    if (!drawn_.stroke.in_steps || is_filled || !(line > 0 && size_.x > 0 && size_.y > 0)) return border;
    border.weight = border_weight(page, line * options_.placement.step.value_or(step_within_border(page, size_)));
    return border;
}

double FramedDrawing::title_height(const Page& page) const {
    return options_.title_line ? options_.title_look.size.value_or(letters_of(page)) : 0;
}

/// Width of the single strokes of the title. @throws SettingError if letters of this height cannot have it
double FramedDrawing::title_stem(const Page& page) const {
    const double height = title_height(page);
    const double stem = options_.title_look.stem.value_or(options_.title_look.weight * height);
    if (stem > thickest * height) {
        refuse_option("title-weight", fmt::format("{:.3g}mm", stem),
                      fmt::format("expected at most a fourth of the height of capitals, which is {:.3g} mm", height));
    }
    return stem;
}

/// Raises the lines below the drawing if they are deeper than the margin. Single strokes of the usual size are not.
double FramedDrawing::foot_lift(const Page& page) const {
    const bool has_title = options_.title_line && !options_.title_look.is_above;
    if (!letters_.are_filled() && !(has_title && options_.title_look.size)) return 0;
    const double height =
        std::max(has_title ? title_height(page) : 0, options_.edition.empty() ? 0 : letters_of(page));
    return std::max(0.0, depth_ * height - page.margin);
}

/// Lowers the line above the drawing likewise.
double FramedDrawing::head_drop(const Page& page) const {
    return std::max(0.0, (ascent_ - 1) * title_height(page) - page.margin);
}

TextSpace FramedDrawing::text_space(const Page& page) const {
    TextSpace space;
    if (!has_text(options_)) return space;
    if (options_.title_look.stem) title_stem(page);
    const bool is_above = options_.title_look.is_above;
    const double title = title_height(page);
    if (options_.title_line && is_above) space.above = head_drop(page) + space_of(title, page);
    const double below = std::max(is_above ? 0 : title, options_.edition.empty() ? 0 : letters_of(page));
    if (below > 0) space.below = foot_lift(page) + space_of(below, page);
    if (options_.title_look.size && space.total() > most_of_page * (page.height - 2 * page.margin)) {
        refuse_option(
            "title-size", fmt::format("{:g}mm", title),
            fmt::format("too high for a page or cell of {:.4g} x {:.4g} mm; expected less", page.width, page.height));
    }
    return space;
}

Page FramedDrawing::without_text(const Page& page) const {
    return {page.width, page.height - text_space(page).total(), page.margin};
}

double FramedDrawing::border_space(const Page& page) const {
    const Page framed = without_text(page);
    return border_ ? border_room(border_on(framed), framed) : 0;
}

/// The part of a window that copies may fill.
Window FramedDrawing::inside(const Window& window) const {
    if (!options_.repeat || !options_.repeat->fills) return window;
    const Page framed = without_text(page_of(window));
    const double room = window.margin + (border_ ? border_depth(border_on(framed), framed) : 0);
    return {.left = window.left + room,
            .top = window.top + text_space(page_of(window)).above + room,
            .width = window.width - 2 * room,
            .height = framed.height - 2 * room,
            .clips = true};
}

void FramedDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    OldColours old(sink, drawn_);
    if (drawn_.stroked) {
        inner_->read(print, inside(window), old);
    } else {
        WithoutLines bare(old);
        inner_->read(print, inside(window), bare);
    }
    if (border_) {
        Window framed = window;
        const Page page = without_text(page_of(window));
        framed.top += text_space(page_of(window)).above;
        framed.height = page.height;
        draw_border(border_on(page), print, framed, border_colour_, sink);
    }
    if (has_text(options_)) read_text(print, window, sink);
}

/// Width for the edition: beside a title what that leaves, at least half of the line with the space between them. A
/// title in the centre leaves half of the rest.
double FramedDrawing::edition_room(double width, const Page& page) const {
    const TitleLook& look = options_.title_look;
    if (!options_.title_line || look.is_above) return width;
    const double height = title_height(page);
    const double title = std::max(letters_.width(*options_.title_line, height), least_title * height);
    const double room = std::max(width / 2, width - title) / (look.side == TitleLook::Side::centre ? 2 : 1);
    return std::max(0.0, room - edition_gap * letters_of(page));
}

FramedDrawing::Line FramedDrawing::edition_line(double width, const Page& page) const {
    const double height = letters_of(page);
    Line line{letters_.shortened(options_.edition, height, width), {}, height, letter_stem * height};
    line.is_cut = line.text != options_.edition;
    line.width = letters_.width(line.text, height);
    return line;
}

/// Leaves the text empty where it does not fit.
FramedDrawing::Line FramedDrawing::title_line(double room, const Page& page) const {
    const double height = title_height(page);
    Line line{"", {}, height, title_stem(page)};
    if (room > least_title * height) line.text = letters_.shortened(*options_.title_line, height, room);
    line.is_title = true;
    line.is_cut = line.text != *options_.title_line;
    line.width = letters_.width(line.text, height);
    return line;
}

/// Lays out the texts of a page: the edition stands below on the right, or on the left beside a title on the right.
std::vector<FramedDrawing::Line> FramedDrawing::lines_of(const Window& window) const {
    constexpr auto centre = TitleLook::Side::centre, right = TitleLook::Side::right;
    const Page page = page_of(window);
    const TitleLook& look = options_.title_look;
    const double left = window.left + window.margin, width = window.width - 2 * window.margin;
    const auto place = [&](Line& line, TitleLook::Side side) {
        const double free = width - line.width;
        line.at.x = side == right ? left + width - line.width : side == centre ? left + free / 2 : left;
    };
    std::vector<Line> lines;
    double taken = 0;
    if (!options_.edition.empty()) {
        lines.push_back(edition_line(edition_room(width, page), page));
        const bool is_beside = options_.title_line && !look.is_above;
        place(lines.back(), is_beside && look.side == right ? TitleLook::Side::left : right);
        if (is_beside) taken = lines.back().width + edition_gap * lines.back().height;
    }
    if (options_.title_line) {
        lines.push_back(title_line(width - (look.side == centre ? 2 : 1) * taken, page));
        place(lines.back(), look.side);
    }
    double stem = 0;
    for (const Line& line : lines) stem = std::max(stem, letters_.are_filled() ? 0 : line.stem);
    const double foot = window.top + window.height - window.margin - foot_lift(page) - stem / 2;
    for (Line& line : lines) line.at.y = foot;
    if (options_.title_line && look.is_above) {
        lines.back().at.y = window.top + window.margin + head_drop(page) + lines.back().height;
    }
    return lines;
}

void FramedDrawing::read_text(const Print& print, const Window& window, PathSink& sink) const {
    const BorderInk ink(print, text_colour_, sink);
    for (const Line& line : lines_of(window)) {
        if (line.is_cut) (line.is_title ? cuts_title_ : cuts_edition_) = true;
        glm::dmat3x2 map = ink.from_page();
        map[2] += glm::dmat2x2(map[0], map[1]) * line.at;
        map[1] = -1.0 * map[1];
        MovedPath moved(sink, map);
        letters_.write(line.text, {0.0, 0.0}, line.height, ink.pen(line.stem, 0), moved);
    }
}

void FramedDrawing::report(DrawingReport& report) const {
    DerivedDrawing::report(report);
    report.cuts_title = cuts_title_;
    report.cuts_edition = cuts_edition_;
}

}  // namespace sikku
