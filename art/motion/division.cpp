#include "art/motion/division.h"

#include "art/drawing/drawing.h"
#include "art/drawing/extent_sink.h"
#include "art/writer/make_drawing.h"
#include "engine/geometry/moved_path.h"
#include "engine/tiling/polygon_place.h"
#include "engine/tiling/tile_family.h"
#include "engine/tiling/tile_growth.h"

#include <fmt/format.h>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

/// Movements of a region by more than this share of its size would be visible as jumps.
constexpr double most_deviation = 0.2;
/// Parts that nearly fill their parents also count as cut out of them.
constexpr double cut_share = 0.9;
/// Share of the way to the middle of their family that parts move closer.
constexpr double closer = 0.06;
constexpr double rounding = 1e-6;

/// Collects the colours of the polygons of a picture, and finds out which lines are outlines of polygons.
class PictureReader : public PathSink {
public:
    PictureReader(const Style& style, const PolygonList& tiles) : style_(style) {
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const auto corners = tiles.polygon(i);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                edges_.insert(edge(corners[k], corners[(k + 1) % corners.size()]));
            }
        }
    }
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        at_ = start;
        take(pen);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) {
            if (is_drawn_ && edges_.contains(edge(at_, end))) {
                if (!outline) outline = pen_;
            } else if (is_drawn_) {
                has_more_lines = true;
            }
            at_ = end;
        }
    }
    void curves(std::span<const glm::dvec2> controls) override {
        has_more_lines = has_more_lines || is_drawn_;
        at_ = controls.back();
    }
    void change_pen(const Pen& pen) override { take(pen); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2>, const Pen& pen) override { colours.push_back(style_.fill_colour(pen)); }
    void area(std::span<const glm::dvec2>, const Pen&) override { has_more_lines = true; }
    void disc(glm::dvec2, double, const Pen&) override { has_more_lines = true; }

    std::vector<Colour> colours;
    std::optional<Pen> outline;
    bool has_more_lines = false;

private:
    using Edge = std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>;
    /// A segment without its direction, to a millionth of a step.
    static Edge edge(glm::dvec2 a, glm::dvec2 b) {
        const auto whole = [](double value) { return std::llround(value * 1e6); };
        const std::pair from(whole(a.x), whole(a.y)), to(whole(b.x), whole(b.y));
        const auto& [low, high] = std::minmax(from, to);
        return {low.first, low.second, high.first, high.second};
    }
    void take(const Pen& pen) {
        pen_ = pen;
        is_drawn_ = style_.draws(pen);
    }

    const Style& style_;
    std::set<Edge> edges_;
    Pen pen_;
    glm::dvec2 at_{0.0};
    bool is_drawn_ = false;
};

/// The options without the surroundings of a drawing and the settings of its page.
DrawingOptions alone(DrawingOptions options) {
    options.window.reset();
    options.frame.reset();
    options.may_be_empty = true;
    options.title_line.reset();
    options.edition.clear();
    options.border_repeat.reset();
    options.border_corner.reset();
    return options;
}

class DivisionMaker {
public:
    DivisionMaker(const Grammar& grammar, const Style& style, const DrawingOptions& options, const Reading& reading)
        : grammar_(grammar), given_(style), options_(alone(options)), reading_(reading), window_(options.window) {
        reading_.begin = nullptr;
        given_.border.reset();
    }

    Division make(std::int64_t first, std::int64_t last, double most_tiles) {
        try {
            generations_ = tile_generations(grammar_, first, last, {reading_.budget, most_tiles}, reading_.monitor);
        } catch (const LineageError& error) {
            throw DivisionError(error.what());
        }
        const auto has_tiles = [](const TileGeneration& generation) { return !generation.symbol.empty(); };
        generations_.erase(generations_.begin(), std::find_if(generations_.begin(), generations_.end(), has_tiles));
        if (generations_.empty()) {
            throw DivisionError("this drawing has no tiles, which are polygons between { and }");
        }
        if (generations_.size() < 2) {
            throw DivisionError(fmt::format("tiles divide between generations; expected a derivation length above {}",
                                            generations_[0].steps));
        }
        divisions_ = tile_divisions(generations_, factor(), reading_.monitor);
        require_division();
        for (std::size_t i = 0; i < generations_.size(); ++i) add_stage(i);
        place_stages();
        find_extent();
        return std::move(division_);
    }

private:
    std::optional<glm::dvec2> factor() const {
        const TileGrowth growth = find_growth(grammar_);
        if (!growth.length) return std::nullopt;
        const double angle = growth.turn * std::numbers::pi / 180;
        return *growth.length * glm::dvec2(std::cos(angle), std::sin(angle));
    }

    void require_division() const {
        bool divides = false;
        for (std::size_t i = 0; i < divisions_.size(); ++i) {
            std::vector<int> parts(generations_[i].symbol.size(), 0);
            for (const std::uint32_t parent : divisions_[i].parent) {
                divides = divides || (parent != no_number && ++parts[parent] > 1);
            }
        }
        if (!divides) {
            throw DivisionError(
                "the tiles of this pattern do not divide: each generation adds tiles to those before");
        }
        if (divisions_.back().deviation > most_deviation) {
            throw DivisionError(fmt::format(
                "no scale keeps the generations of this pattern in one place: their tiles deviate by {:.0f} % of "
                "its size",
                100 * divisions_.back().deviation));
        }
    }

    void add_stage(std::size_t i) {
        reading_.monitor.check();
        DivisionStage& stage = division_.stages.emplace_back();
        TileGeneration& generation = generations_[i];
        stage.steps = generation.steps;
        stage.tiles = std::move(generation.polygons);
        const auto grammar = grammar_.with_steps(stage.steps);
        const auto drawing = make_drawing(*grammar, given_, options_, reading_);
        drawing->seen();
        Print print;
        print.style = drawing->style();
        drawing->read(print, stage.picture);
        division_.style = print.style;
        PictureReader reader(division_.style, stage.tiles);
        stage.picture.draw(reader);
        const bool is_blank = given_.tile_colours == TileColours::blank;
        if (is_blank) reader.colours.assign(stage.tiles.size(), Colour{0, 0, 0, 0});
        if (reader.colours.size() != stage.tiles.size()) {
            throw DivisionError("only polygons between { and } divide; this drawing has others");
        }
        stage.colours = std::move(reader.colours);
        const TileEdges edges = given_.tile_edges;
        // Edges drawn once are parts of the outlines, and need not be whole sides.
        if (edges == TileEdges::once && given_.stroked && !is_blank) {
            stage.outline = reader.outline.value_or(Pen{});
        } else if (edges == TileEdges::each && !is_blank) {
            stage.outline = reader.outline;
        }
        stage.has_more_lines = reader.has_more_lines || (reader.outline && !stage.outline);
        if (i > 0) add_parts(stage, division_.stages[i - 1].colours, divisions_[i - 1]);
    }

    static void add_parts(DivisionStage& stage, const std::vector<Colour>& parents, const TileDivision& division) {
        stage.kind = division.share >= cut_share     ? DivisionKind::cut
                     : division.deviation < rounding ? DivisionKind::across
                                                     : DivisionKind::spread;
        const double start = division_tracks(stage.kind).size.front().value;
        for (std::size_t i = 0; i < stage.tiles.size(); ++i) {
            DivisionStage::Part part;
            part.middle = inner_middle(stage.tiles.polygon(i));
            const glm::dvec2 apart = part.middle - division.family_middle[i];
            part.way = stage.kind == DivisionKind::cut ? -closer * apart
                                                       : division.parent_middle[i] + start * apart - part.middle;
            const std::uint32_t parent = division.parent[i];
            part.from = stage.colours[i];
            if (parent != no_number) {
                part.from = parents[parent];
            } else {
                part.from.alpha = 0;
            }
            stage.parts.push_back(part);
        }
    }

    /// From the last stage back to the first.
    void place_stages() {
        for (std::size_t i = division_.stages.size() - 1; i-- > 0;) {
            const glm::dmat3x2& map = divisions_[i].map;
            const DivisionStage& next = division_.stages[i + 1];
            const glm::dmat2x2 turn(next.place[0], next.place[1]);
            division_.stages[i].place = {turn * map[0], turn * map[1], turn * map[2] + next.place[2]};
            division_.stages[i].scale =
                next.scale * std::sqrt(std::fabs(glm::determinant(glm::dmat2x2(map[0], map[1]))));
        }
    }

    void find_extent() {
        division_.scale = options_.placement.scale * grammar_.scale_percent() / 100;
        const glm::dmat3x2 turned = orientation(options_.placement);
        DrawnExtent& seen = division_.seen;
        for (const DivisionStage& stage : division_.stages) {
            ExtentSink extent(division_.style, turned);
            MovedPath moved(extent, stage.place);
            stage.picture.draw(moved);
            seen.box.add(extent.box.low);
            seen.box.add(extent.box.high);
            seen.widest =
                std::max(seen.widest, extent.widest * (division_.style.stroke.in_steps ? stage.scale : 1.0));
        }
        if (!window_) return;
        const double around = seen.widest;
        seen = window_extent(*window_, turned);
        seen.around = around;
    }

    const Grammar& grammar_;
    Style given_;
    DrawingOptions options_;
    Reading reading_;
    std::optional<ViewWindow> window_;
    std::vector<TileGeneration> generations_;
    std::vector<TileDivision> divisions_;
    Division division_;
};

}  // namespace

Division make_division(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                       const Reading& reading, std::int64_t first, std::int64_t last, double most_tiles) {
    return DivisionMaker(grammar, style, options, reading).make(first, last, most_tiles);
}

}  // namespace sikku
