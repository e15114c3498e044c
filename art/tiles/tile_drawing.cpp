#include "art/tiles/tile_drawing.h"

#include "art/print/ornaments.h"
#include "art/tiles/tile_colours.h"
#include "art/tiles/tile_decorator.h"
#include "art/tiles/tile_worms.h"
#include "engine/geometry/polygon_classes.h"
#include "engine/tiling/polygon_place.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sikku {

/// Collects the straight lines and the polygons of a drawing.
class TileGatherer : public PathSink {
public:
    /// @param middles  receives the middles of the polygons, unless it is null
    TileGatherer(UnitedLines& united, const Style& style, std::vector<glm::dvec2>* middles)
        : united_(united),
          style_(style),
          middles_(middles),
          keeps_outlines_(style.tile_colours == TileColours::worms) {}

    /// The outlines of all polygons, if colours need them.
    const TileOutlines& outlines() const { return outlines_; }
    /// For each polygon the number of marks before it.
    const std::vector<std::uint32_t>& parts() const { return parts_; }

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at_ = start;
        take(pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            if (draws_) united_.add_line(at_, end, pen_);
            at_ = end;
        }
    }
    void curves(std::span<const glm::dvec2> controls) override { at_ = controls.back(); }
    void change_pen(const Pen& pen) override { take(pen); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
        united_.add_tile(vertices);
        if (middles_) middles_->push_back(mass_of(vertices).centre);
        parts_.push_back(part_);
        if (keeps_outlines_) outlines_.add(vertices);
    }
    void area(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}
    void mark() override { ++part_; }

private:
    void take(const Pen& pen) {
        pen_ = pen;
        pen_.colour = style_.index(pen);
        draws_ = style_.draws(pen);
    }

    UnitedLines& united_;
    const Style& style_;
    std::vector<glm::dvec2>* middles_;
    bool keeps_outlines_;
    TileOutlines outlines_;
    std::vector<std::uint32_t> parts_;
    std::uint32_t part_ = 0;
    Pen pen_;
    glm::dvec2 at_{0.0};
    bool draws_ = false;
};

namespace {

/// True if the colours of tiles depend on other tiles.
bool depends_on_others(TileColours colours) {
    return colours == TileColours::distance || colours == TileColours::neighbours ||
           colours == TileColours::generation || colours == TileColours::worms;
}

/// Numbers for the parts of a drawing so that parts with neighbouring tiles differ.
std::vector<std::uint32_t> colours_of_parts(const std::vector<std::uint32_t>& parts,
                                            std::span<const UnitedLines::Pair> neighbours) {
    if (parts.empty()) return {};
    std::vector<UnitedLines::Pair> pairs;
    for (const auto& [a, b] : neighbours) {
        if (parts[a] != parts[b]) pairs.emplace_back(std::min(parts[a], parts[b]), std::max(parts[a], parts[b]));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    const std::vector<std::uint32_t> colours =
        colours_of_neighbours(*std::max_element(parts.begin(), parts.end()) + 1, pairs);
    std::vector<std::uint32_t> result;
    result.reserve(parts.size());
    for (const std::uint32_t part : parts) result.push_back(colours[part]);
    return result;
}

/// Classifies polygons.
class ClassSink : public PolygonSink {
public:
    explicit ClassSink(PolygonClasses& classes) : classes_(classes) {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override { classes_.classify(vertices); }
    void area(std::span<const glm::dvec2>, const Pen&) override {}

private:
    PolygonClasses& classes_;
};

}  // namespace

/// Passes on polygons in the colours of their numbers, without straight lines if edges are drawn afterwards.
class TilePainter : public PathFilter {
public:
    /// @param numbers  numbers of the polygons in order; null: by their classes
    TilePainter(PathSink& sink, const Style& drawn, std::size_t first, std::size_t colours,
                const std::vector<std::uint32_t>* numbers, const Drawing& drawing)
        : Forwarding(sink), drawn_(drawn), first_(first), colours_(colours), numbers_(numbers) {
        ClassSink samples(classes_);
        drawing.read_samples(samples);
    }

    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        if (!drawn_.tile_colours) return sink_.polygon(vertices, pen);
        if (*drawn_.tile_colours == TileColours::blank) return;
        const std::uint32_t number = numbers_ ? (*numbers_)[next_++] : class_of(vertices);
        differs_ = differs_ || (first_number_ && *first_number_ != number);
        is_several_ = is_several_ || first_number_.has_value();
        if (!first_number_) first_number_ = number;
        sink_.polygon(vertices, Pen{.colour = static_cast<int>(first_ + number % colours_)});
    }
    /// True if several tiles were coloured.
    bool is_several() const { return is_several_; }
    /// True if their numbers differ.
    bool differs() const { return differs_; }
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        if (draws_lines()) sink_.begin_stroke(start, pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        if (draws_lines()) sink_.lines(ends);
    }
    void change_pen(const Pen& pen) override {
        if (draws_lines()) sink_.change_pen(pen);
    }
    void end_stroke(bool closed) override {
        if (draws_lines()) sink_.end_stroke(closed);
    }

private:
    bool draws_lines() const { return drawn_.tile_edges == TileEdges::each; }

    std::uint32_t class_of(std::span<const glm::dvec2> vertices) {
        const PolygonClass found = classes_.classify(vertices);
        return *drawn_.tile_colours == TileColours::shape  ? found.shape
               : *drawn_.tile_colours == TileColours::hand ? found.hand
                                                           : found.direction;
    }

    const Style& drawn_;
    std::size_t first_;  ///< index of the first colour
    std::size_t colours_;
    const std::vector<std::uint32_t>* numbers_;
    std::size_t next_ = 0;
    std::optional<std::uint32_t> first_number_;
    bool is_several_ = false, differs_ = false;
    PolygonClasses classes_;
};

namespace {

/// Collects the polygons of a drawing for its decoration.
class DecorationGatherer : public PolygonSink {
public:
    explicit DecorationGatherer(TileDecorator& decorator) : decorator_(decorator) {}

    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { decorator_.add(vertices, pen); }
    void area(std::span<const glm::dvec2>, const Pen&) override {}

private:
    TileDecorator& decorator_;
};

class NoPolygons : public PathFilter {
public:
    using Forwarding::Forwarding;
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
};

}  // namespace

bool has_tile_work(const Style& style) {
    return style.tile_colours || style.tile_edges != TileEdges::each || style.decoration.is_set();
}

TileDrawing::TileDrawing(std::unique_ptr<Drawing> drawing, std::uint64_t seed, const DrawingOptions& options,
                         const Reading& reading)
    : DerivedDrawing(std::move(drawing), options, reading), seed_(seed) {
    if (style_.line == Line::spline) {
        throw std::runtime_error(
            "'tile colours', 'tile edges' and 'decorate' need straight lines; this drawing has splines");
    }
    if (reading.has_cut_layers && drawn_.stroked && drawn_.tile_edges == TileEdges::once) add_layers();
    if (!style_.tile_colours || *style_.tile_colours == TileColours::blank) return;
    std::vector<Colour> others;
    if (drawn_.stroked) others.push_back(drawn_.line_colour({}));
    if (drawn_.ground) others.push_back(*drawn_.ground);
    const std::vector<Colour> powders = fill_powders(style_, others);
    colours_ = powders.size();
    first_colour_ = style_.palette.size();
    style_.palette.insert(style_.palette.end(), powders.begin(), powders.end());
}

/// Cutters work layer by layer and distinguish layers by colour, too.
void TileDrawing::add_layers() {
    layers_ = static_cast<int>(style_.palette.size());
    constexpr Colour blue{0, 0, 255, 255};
    constexpr Colour red{255, 0, 0, 255};
    for (Colour colour : {blue, red}) {
        // Equal colours share a layer.
        while (std::find(style_.palette.begin(), style_.palette.end(), colour) != style_.palette.end())
            ++colour.green;
        style_.palette.push_back(colour);
    }
    style_.cut_layers = {{*layers_, "INNER"}, {*layers_ + 1, "BORDER"}};
}

void TileDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    OldColours old(sink, drawn_);
    const bool needs_all = drawn_.tile_colours && depends_on_others(*drawn_.tile_colours);
    const bool unites = drawn_.tile_edges != TileEdges::each;
    if (!unites && !needs_all) {
        TilePainter painter(sink, drawn_, first_colour_, colours_, nullptr, *inner_);
        OldColours inner(painter, drawn_);
        inner_->read(print, window, inner);
        note(painter);
        return decorate(print, window, old);
    }
    UnitedLines united(reading_.budget / nodes_of_tile_edge);
    std::vector<glm::dvec2> middles;
    TileGatherer gatherer(united, drawn_, options_.tile_period ? &middles : nullptr);
    inner_->read(print, window, gatherer);
    const bool cuts = unites && options_.kerf > 0;
    const auto kept = cuts                                     ? UnitedLines::Kept::cuts
                      : layers_                                ? UnitedLines::Kept::apart
                      : drawn_.tile_edges == TileEdges::once   ? UnitedLines::Kept::all
                      : drawn_.tile_edges == TileEdges::border ? UnitedLines::Kept::border
                                                               : UnitedLines::Kept::none;
    UnitedLines::Result found = united.unite(kept, reading_.monitor);
    if (cuts) {
        if (drawn_.tile_edges == TileEdges::border) {
            std::erase_if(found.lines, [](const UnitedLines::Line& line) { return line.is_inner; });
        }
        found.lines = with_wider_border(found.lines, options_.kerf / 2 / print.placement.step);
    }
    const std::vector<std::uint32_t> chosen =
        needs_all ? numbers(gatherer, united, found, middles) : std::vector<std::uint32_t>{};
    TilePainter painter(sink, drawn_, first_colour_, colours_, needs_all ? &chosen : nullptr, *inner_);
    OldColours inner(painter, drawn_);
    // A pen that does not hatch draws only the outlines of polygons, which are among the lines.
    NoPolygons bare(inner);
    const std::optional<PlotPen>& plot = reading_.pen;
    const bool fills = !plot || !unites || plot->hatch || plot->leaves_tiles;
    inner_->read(print, window, fills ? static_cast<PathSink&>(inner) : bare);
    note(painter);
    if (layers_) {
        std::vector<UnitedLines::Line> lines = found.lines;
        for (UnitedLines::Line& line : lines) line.pen.colour = *layers_ + (line.is_inner ? 0 : 1);
        draw_lines(lines, sink, reading_.monitor);
    } else if (unites) {
        draw_lines(found.lines, old, reading_.monitor);
    }
    decorate(print, window, old);
}

void TileDrawing::note(const TilePainter& painter) const {
    if (painter.is_several()) has_tiles_ = true;
    if (painter.differs()) differs_ = true;
}

void TileDrawing::report(DrawingReport& report) const {
    inner_->report(report);
    report.tiles_are_alike = has_tiles_ && !differs_;
    const bool wants_worms = drawn_.tile_colours == TileColours::worms || drawn_.decoration.worms;
    report.lacks_worms = wants_worms && !has_worms_;
}

void TileDrawing::decorate(const Print& print, const Window& window, PathSink& sink) const {
    if (!drawn_.decoration.is_set()) return;
    TileDecorator decorator(drawn_, seed_, reading_.budget / nodes_of_tile_edge);
    DecorationGatherer gatherer(decorator);
    inner_->read(print, window, gatherer);
    if (decorator.draw(sink, reading_.monitor)) has_worms_ = true;
}

std::vector<std::uint32_t> TileDrawing::numbers(const TileGatherer& gatherer, const UnitedLines& united,
                                                const UnitedLines::Result& found,
                                                const std::vector<glm::dvec2>& middles) const {
    switch (*drawn_.tile_colours) {
        case TileColours::distance:
            return distances_from_border(united.tiles(), found.neighbours, found.border);
        case TileColours::generation:
            return colours_of_parts(gatherer.parts(), found.neighbours);
        case TileColours::worms: {
            const std::vector<WormLink> worms = find_worms(gatherer.outlines(), reading_.monitor);
            if (!worms.empty()) has_worms_ = true;
            return ranks_of_worms(united.tiles(), worms);
        }
        default:
            break;
    }
    if (options_.tile_period) {
        if (auto numbers = colours_of_repeated(middles, found.neighbours, *options_.tile_period)) return *numbers;
    }
    return colours_of_neighbours(united.tiles(), found.neighbours);
}

}  // namespace sikku
