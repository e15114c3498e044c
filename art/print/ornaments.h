// art/print/ornaments.h: adds dots and strand colours to the lines of a pattern.
#pragma once

#include "art/print/print.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {

/// Colour of rice flour.
constexpr std::string_view rice = "#fffaf0";
/// The colours of a kolam's lines, rice flour first.
constexpr std::string_view kolam_colours = "#fffaf0 #f2b632 #7fc8a9 #e77f67 #8fb8de #d6a2e8 #c5d86d #f7b2ad";

/// Passes on a drawing whose palette has grown: reduces colour indices to the old palette first.
class OldColours : public PathFilter {
public:
    OldColours(PathSink& sink, const Style& style) : Forwarding(sink), style_(style) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override { sink_.begin_stroke(start, old(pen)); }
    void change_pen(const Pen& pen) override { sink_.change_pen(old(pen)); }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { sink_.polygon(vertices, old(pen)); }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override { sink_.area(outline, old(pen)); }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override { sink_.disc(centre, radius, old(pen)); }
    void label(std::string_view text, glm::dvec2 centre, double height, const Pen& pen) override {
        sink_.label(text, centre, height, old(pen));
    }

protected:
    Pen old(Pen pen) const {
        pen.colour = style_.index(pen);
        return pen;
    }
    Style style_;
};

/// Records the positions of the discs of a drawing.
class NotedDiscs : public PathFilter {
public:
    NotedDiscs(PathSink& sink, const Style& style) : Forwarding(sink), style_(style) {}

    void disc(glm::dvec2 centre, double radius, const Pen& pen) override {
        if (style_.fill_colour(pen).alpha > 0) places.push_back(centre);
        sink_.disc(centre, radius, pen);
    }

    std::vector<glm::dvec2> places;  ///< positions of the visible discs

private:
    const Style& style_;
};

/// Draws the strokes of each line in the next of the given colours, which are indices into the palette. Labels are
/// not lines: they keep their colours.
class StrokeColours : public OldColours {
public:
    StrokeColours(PathSink& sink, const Style& style, std::vector<int> colours,
                  const std::vector<std::uint32_t>& line_of_stroke)
        : OldColours(sink, style), colours_(std::move(colours)), lines_(line_of_stroke) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        is_seen_ = false;
        look(pen);
        sink_.begin_stroke(start, coloured(pen));
    }
    void change_pen(const Pen& pen) override {
        look(pen);
        sink_.change_pen(coloured(pen));
    }

private:
    /// Starts a visible stroke when the pen becomes visible.
    void look(const Pen& pen) {
        const bool is_seen = style_.draws(pen);
        if (is_seen && !is_seen_) ++stroke_;
        is_seen_ = is_seen;
    }
    Pen coloured(Pen pen) const {
        pen.colour = style_.draws(pen) ? colours_[line() % colours_.size()] : style_.index(pen);
        return pen;
    }
    std::size_t line() const { return stroke_ < lines_.size() ? lines_[stroke_] : 0; }

    std::vector<int> colours_;
    const std::vector<std::uint32_t>& lines_;
    std::size_t stroke_ = SIZE_MAX;  ///< index among the visible strokes
    bool is_seen_ = false;
};

/// Least distance between two dots; 0 for fewer than two. Cost: O(n sqrt n) for dots of a grid in rows.
double least_distance(std::span<const glm::dvec2> dots);

/// Colours that distinguish the lines of a kolam on dark ground, rice flour first; grids use the same.
std::vector<Colour> kolam_palette();
}  // namespace sikku
