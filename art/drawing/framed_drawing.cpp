#include "art/drawing/framed_drawing.h"

#include "art/print/border_ink.h"
#include "art/print/ornaments.h"
#include "engine/geometry/lettering.h"
#include "engine/geometry/moved_path.h"

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

constexpr double letter_stem = 0.085;
constexpr double foot_share = 2.6;  // share of the height of letters, above their baseline

/// Height of capitals in millimetres.
double letters_of(const Page& page) {
    return std::clamp(std::min(page.width, page.height) * 0.0125, 1.2, 14.0);
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
    : DerivedDrawing(std::move(inner), options, reading), border_(std::move(border)) {
    style_.stroked = true;
    if (border_) {
        border_colour_ = static_cast<int>(style_.palette.size());
        for (const Colour colour : border_colours(*border_, style_.ground)) style_.palette.push_back(colour);
    }
    if (!has_text(options_)) return;
    constexpr double least = 0.25;  // in OKLab
    const Colour ground = style_.ground && style_.ground->alpha > 0 ? *style_.ground : Colour{255, 255, 255, 255};
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

double FramedDrawing::border_space(const Page& page) const {
    Page framed = page;
    framed.height -= foot_space(page);
    return border_ ? border_room(border_on(framed), framed) : 0;
}

double FramedDrawing::foot_space(const Page& page) const {
    return has_text(options_) ? foot_share * letters_of(page) : 0;
}

/// The part of a window that copies may fill.
Window FramedDrawing::inside(const Window& window) const {
    if (!options_.repeat || !options_.repeat->fills) return window;
    const double foot = foot_space({window.width, window.height, window.margin});
    const Page framed{window.width, window.height - foot, window.margin};
    const double room = window.margin + (border_ ? border_depth(border_on(framed), framed) : 0);
    return {.left = window.left + room,
            .top = window.top + room,
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
        framed.height -= foot_space({window.width, window.height, window.margin});
        const Border border = border_on({framed.width, framed.height, framed.margin});
        draw_border(border, print, framed, border_colour_, sink);
    }
    if (has_text(options_)) read_text(print, window, sink);
}

/// The title stands on the left, the edition on the right.
void FramedDrawing::read_text(const Print& print, const Window& window, PathSink& sink) const {
    const double height = letters_of({window.width, window.height, window.margin});
    const double left = window.left + window.margin, width = window.width - 2 * window.margin;
    const double line = window.top + window.height - window.margin - letter_stem * height / 2;
    const BorderInk ink(print, text_colour_, sink);
    const Pen pen = ink.pen(letter_stem * height, 0);
    const auto write = [&](const std::string& text, double at) {
        glm::dmat3x2 map = ink.from_page();
        map[2] += glm::dmat2x2(map[0], map[1]) * glm::dvec2(at, line);
        map[1] = -1.0 * map[1];
        MovedPath moved(sink, map);
        write_text(text, {0.0, 0.0}, height, pen, moved);
    };
    const std::string edition = shortened(options_.edition, height, width);
    const double taken = edition.empty() ? 0 : text_width(edition, height);
    if (!edition.empty()) write(edition, left + width - taken);
    const double room = width - taken - (edition.empty() ? 0 : 2 * height);
    if (options_.title_line && room > 4 * height) write(shortened(*options_.title_line, height, room), left);
}

}  // namespace sikku
