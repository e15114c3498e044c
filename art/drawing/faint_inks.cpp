#include "art/drawing/faint_inks.h"

#include "art/style/contrast.h"

#include <algorithm>
#include <cstddef>
#include <set>

namespace sikku {
namespace {

constexpr std::size_t most_points = 10'000'000;

/// Thrown when nothing more can be found.
struct Found {};

class ContentsSink : public PathSink {
public:
    explicit ContentsSink(const Style& style) : style_(style) {}

    void begin_stroke(glm::dvec2, const Pen& pen) override { change_pen(pen); }
    void change_pen(const Pen& pen) override {
        if (style_.draws(pen)) lines_.insert(style_.index(pen));
    }
    void lines(std::span<const glm::dvec2> ends) override { count(ends.size()); }
    void curves(std::span<const glm::dvec2> controls) override { count(controls.size()); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        contents_.has_polygons = true;
        fill(vertices.size(), pen);
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        contents_.has_areas = true;
        fill(outline.size(), pen);
    }
    void disc(glm::dvec2, double, const Pen& pen) override {
        contents_.has_discs = true;
        fill(1, pen);
    }
    Contents contents() const {
        Contents result = contents_;
        result.lines.assign(lines_.begin(), lines_.end());
        result.fills.assign(fills_.begin(), fills_.end());
        return result;
    }

private:
    void fill(std::size_t points, const Pen& pen) {
        fills_.insert(style_.index(pen));
        count(points);
    }
    void count(std::size_t points) {
        points_ += points;
        if (points_ > most_points) throw Found();
    }

    const Style& style_;
    Contents contents_;
    std::set<int> lines_, fills_;
    std::size_t points_ = 0;
};

class FaintSink : public PathSink {
public:
    explicit FaintSink(const Print& print) : print_(print), ground_(*print.style.ground) {
        const int count = std::max(static_cast<int>(print.style.palette.size()), 1);
        for (int i = 0; i < count && !has_suspects_; ++i) {
            const Pen pen{.colour = i};
            has_suspects_ = is_faint(print.style.line_colour(pen), ground_) ||
                            is_faint(print.style.fill_colour(pen), ground_);
        }
    }
    bool has_suspects() const { return has_suspects_; }
    /// Lines in the colour of the ground are seen as joints between visible fills, and pale fills by their outlines.
    /// Fields of powders are meant to be seen.
    std::vector<FaintInk> found() const {
        std::vector<FaintInk> result;
        for (const FaintInk& ink : inks_) {
            const bool is_between = ink.kind == FaintInk::Kind::lines && has_visible_fills_;
            const bool is_outlined =
                ink.kind == FaintInk::Kind::areas && has_visible_lines_ && print_.style.powders.empty();
            if (!is_between && !is_outlined) result.push_back(ink);
        }
        return result;
    }

    void begin_stroke(glm::dvec2, const Pen& pen) override { pen_ = pen; }
    void change_pen(const Pen& pen) override { pen_ = pen; }
    void lines(std::span<const glm::dvec2> ends) override { line(ends.size()); }
    void curves(std::span<const glm::dvec2> controls) override { line(controls.size()); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        count(vertices.size());
        note(FaintInk::Kind::areas, print_.style.fill_colour(pen));
        has_visible_lines_ |= print_.style.stroked && !is_faint(print_.style.line_colour(pen), ground_);
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        count(outline.size());
        note(FaintInk::Kind::areas, print_.style.fill_colour(pen));
    }
    void disc(glm::dvec2, double, const Pen& pen) override {
        count(1);
        note(FaintInk::Kind::discs, print_.style.fill_colour(pen));
    }

private:
    void line(std::size_t points) {
        count(points);
        if (print_.style.draws(pen_)) note(FaintInk::Kind::lines, print_.style.line_colour(pen_));
    }
    void count(std::size_t points) {
        points_ += points;
        if (points_ > most_points) throw Found();
    }
    void note(FaintInk::Kind kind, Colour colour) {
        if (!is_faint(colour, ground_)) {
            if (colour.alpha == 0) return;
            has_visible_lines_ |= kind == FaintInk::Kind::lines;
            has_visible_fills_ |= kind == FaintInk::Kind::areas;
            return;
        }
        const bool is_known = std::any_of(inks_.begin(), inks_.end(),
                                          [&](const FaintInk& ink) { return ink.kind == kind && ink.ink == colour; });
        if (!is_known) inks_.push_back({kind, colour, ground_});
    }

    const Print& print_;
    Colour ground_;
    Pen pen_;
    std::vector<FaintInk> inks_;
    bool has_suspects_ = false;
    bool has_visible_lines_ = false;
    bool has_visible_fills_ = false;
    std::size_t points_ = 0;
};

}  // namespace

bool is_faint(Colour ink, Colour ground) {
    constexpr double least_difference = 15;
    return ink.alpha > 0 && colour_difference(laid_over(ink, ground), ground) < least_difference;
}

std::vector<FaintInk> faint_inks(const Drawing& drawing, const Print& print) {
    if (!print.style.ground || print.style.ground->alpha < 255) return {};
    FaintSink sink(print);
    if (!sink.has_suspects()) return {};
    try {
        drawing.read(print, sink);
    } catch (const Found&) {
    }
    return sink.found();
}

Contents contents_of(const Drawing& drawing, const Print& print) {
    ContentsSink sink(print.style);
    try {
        drawing.read(print, sink);
    } catch (const Found&) {
    }
    return sink.contents();
}

}  // namespace sikku
