#include "art/writer/swatch.h"

#include "art/raster/raster.h"
#include "art/tiles/tile_colours.h"
#include "art/tiles/torus_places.h"
#include "art/writer/make_drawing.h"
#include "engine/base/text.h"
#include "engine/derivation/derivation.h"
#include "engine/language/grammar.h"
#include "engine/tiling/polygon_place.h"
#include "engine/tiling/tile_growth.h"
#include "engine/tiling/tile_lineage.h"
#include "engine/tiling/tile_periods.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace sikku {
namespace {

// Least and approximate greatest numbers of tiles in the patches that are examined.
constexpr std::uint64_t fewest_tiles = 300, most_tiles = 8000, most_tiles_of_place = 60'000;

/// A patch of tiles, and the translations by which it repeats.
struct Patch {
    std::int64_t steps = 0;
    TilingResult result;
    TilePeriods periods;
    TilePeriods without_colours;  ///< found only if the others are fewer than two

    std::uint64_t tiles() const { return result.examination.tiles; }
};

class SwatchFinder {
public:
    SwatchFinder(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                 const ReadingLimits& limits, bool may_turn)
        : grammar_(grammar), style_(style), options_(options), limits_(limits), may_turn_(may_turn) {}

    Swatch find() {
        refuse_style();
        for (std::int64_t steps = 0; steps <= longest; steps += 1 + steps / 8) {
            if (!examine(steps)) break;
            if (patch_.tiles() < fewest_tiles) continue;
            // Tiles that do not touch cannot be compared.
            const bool is_joined = patch_.periods.compared * 4 >= patch_.tiles();
            if (patch_.periods.count < 2 || !is_joined) {
                if (patch_.tiles() > most_tiles) break;
                continue;
            }
            place();
            if (patch_.periods.radius >= needed_) {
                compare_pictures();
                return swatch_;
            }
            if (patch_.tiles() > most_tiles_of_place) {
                throw SwatchError(fmt::format("the part that repeats is {:.6g} x {:.6g} steps, which is too large",
                                              glm::length(swatch_.cell.sides[0]),
                                              glm::length(swatch_.cell.sides[1])));
            }
        }
        refuse();
    }

private:
    static constexpr std::int64_t longest = 500;

    void refuse_style() const {
        if (grammar_.map() || grammar_.is_spatial()) throw SwatchError("applies only to tilings in the plane");
        if (style_.tile_colours == TileColours::distance) {
            throw SwatchError("colours by the distance from the border do not repeat: an endless tiling has none");
        }
        if (style_.line == Line::spline) throw SwatchError("tiles have straight edges, not splines");
        if (style_.hand > 0) throw SwatchError("lines drawn by hand do not repeat; set hand to 0");
    }

    /// Returns false if there are too many tiles.
    bool examine(std::int64_t steps) {
        const auto grammar = grammar_.with_steps(steps);
        if (!grammar) return true;
        TilingOptions options;
        options.limits = {limits_.budget, 2.0 * most_tiles_of_place, 0};
        options.colours = {2000, 100'000};
        options.monitor = limits_.monitor;
        try {
            Patch patch{steps, examine_tiling(*grammar, options), {}, {}};
            if (patch.tiles() > 0 && !patch.result.examination.has_border) {
                throw SwatchError(
                    fmt::format("polygons overlap at a derivation length of {}, so this is not a tiling", steps));
            }
            if (patch.tiles() == 0) return true;
            patch.periods = find_periods(patch.result.patch, kinds_of(*grammar, patch.result.patch), limits_.monitor);
            if (patch.periods.count < 2) {
                const std::vector<std::uint32_t> same(patch.tiles(), 0);
                patch.without_colours = find_periods(patch.result.patch, same, limits_.monitor);
            }
            patch_ = std::move(patch);
            return true;
        } catch (const BudgetError& error) {
            if (steps == 0) throw;
            limit_ = error.what();
            return false;
        }
    }

    /// Numbers of tiles: equal for congruent tiles that look the same.
    std::vector<std::uint32_t> kinds_of(const Grammar& grammar, const TilingPatch& patch) const {
        const TileSet& tiles = patch.tiles;
        std::vector<std::uint32_t> kinds(tiles.tiles(), 0);
        if (!style_.tile_colours) {
            std::vector<Colour> colours;
            for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
                const Colour colour = style_.fill_colour({.colour = tiles.colour[tile]});
                const auto found = std::find(colours.begin(), colours.end(), colour);
                kinds[tile] = static_cast<std::uint32_t>(found - colours.begin());
                if (found == colours.end()) colours.push_back(colour);
            }
        }
        if (!style_.decoration.is_set()) return kinds;
        // Lines on a tile depend on its colour in the pattern, and on the corner at which it begins.
        const auto drawn = tile_generations(grammar, grammar.steps(), grammar.steps(),
                                            {limits_.budget, 2.0 * most_tiles_of_place}, limits_.monitor);
        const PolygonList& polygons = drawn.front().polygons;
        for (std::uint32_t tile = 0; tile < tiles.tiles(); ++tile) {
            const glm::dvec2 begin = polygons.polygon(tiles.number[tile] - 1).front();
            std::uint32_t corner = 0;
            const auto corners = tiles.corners(tile);
            for (std::uint32_t i = 0; i < corners.size(); ++i) {
                if (glm::distance(patch.plane.at(corners[i]), begin) <
                    glm::distance(patch.plane.at(corners[corner]), begin)) {
                    corner = i;
                }
            }
            kinds[tile] =
                (kinds[tile] * 4096 + corner) * 4096 + static_cast<std::uint32_t>(tiles.colour[tile] & 4095);
        }
        return kinds;
    }

    /// Sets the place of the swatch in the patch, and the radius of the patch that it needs.
    void place() {
        swatch_ = {};
        swatch_.steps = patch_.steps;
        const glm::dmat3x2 turned = orientation(options_.placement);
        const glm::dmat2x2 turn(turned[0], turned[1]);
        const glm::dvec2 a = turn * patch_.periods.vectors[0], b = turn * patch_.periods.vectors[1];
        auto rectangle = upright_rectangle(a, b);
        const auto least = least_rectangle(a, b);
        constexpr double smaller = 1 - 1e-6;
        if (least && (!rectangle || (may_turn_ && least->area() < rectangle->area() * smaller))) {
            rectangle = least;
            swatch_.turn = -std::atan2(least->across.y, least->across.x) * 180 / std::numbers::pi;
        }
        swatch_.is_rectangle = rectangle.has_value();
        std::array<glm::dvec2, 2> sides = rectangle ? std::array{rectangle->across, rectangle->up} : std::array{a, b};
        const glm::dmat2x2 back = glm::inverse(turn);
        for (glm::dvec2& side : sides) side = back * side;
        if (style_.tile_colours == TileColours::neighbours) repeat_colours(sides);
        const TilingPatch& patch = patch_.result.patch;
        const std::uint32_t middle = patch.tiles.corner[patch.tiles.begin[patch_.periods.middle]];
        swatch_.cell = {patch.plane.at(middle) - sides[0] - sides[1], sides};
        needed_ = std::max(glm::length(sides[0] + sides[1]), glm::length(sides[0] - sides[1])) + widest_tile() +
                  pen_width();
        count_tiles();
        frame();
    }

    /// Multiplies the sides so that few colours suffice for neighbours to differ.
    void repeat_colours(std::array<glm::dvec2, 2>& sides) {
        constexpr int most = 4;
        const TilingPatch& patch = patch_.result.patch;
        const std::vector<glm::dvec2> middles = middles_of_tiles();
        std::vector<UnitedLines::Pair> pairs;
        for (std::uint32_t tile = 0; tile < patch.tiles.tiles(); ++tile) {
            for (const std::uint32_t other : patch.neighbours.of(tile)) {
                if (tile < other) pairs.emplace_back(tile, other);
            }
        }
        const auto enough = static_cast<std::uint32_t>(patch_.result.examination.most_colours);
        std::uint32_t fewest = no_number;
        std::array<int, 2> best = {1, 1};
        for (int size = 1; size <= most * most && fewest > enough; ++size) {
            for (int across = 1; across <= most; ++across) {
                const int up = size / across;
                if (size % across != 0 || up > most) continue;
                const std::array<glm::dvec2, 2> larger = {static_cast<double>(across) * sides[0],
                                                          static_cast<double>(up) * sides[1]};
                const auto colours = colours_of_repeated(middles, pairs, larger);
                if (!colours) continue;
                const std::uint32_t count = *std::max_element(colours->begin(), colours->end()) + 1;
                if (count >= fewest) continue;
                fewest = count;
                best = {across, up};
            }
        }
        if (fewest == no_number)
            throw SwatchError("neighbours cannot all differ in colour, even in several copies of the smallest part");
        sides = {static_cast<double>(best[0]) * sides[0], static_cast<double>(best[1]) * sides[1]};
        swatch_.has_tile_period = true;
    }

    std::vector<glm::dvec2> middles_of_tiles() const {
        const TilingPatch& patch = patch_.result.patch;
        std::vector<glm::dvec2> middles, corners;
        for (std::uint32_t tile = 0; tile < patch.tiles.tiles(); ++tile) {
            corners.clear();
            for (const std::uint32_t corner : patch.tiles.corners(tile)) corners.push_back(patch.plane.at(corner));
            middles.push_back(mass_of(corners).centre);
        }
        return middles;
    }

    double widest_tile() const {
        double widest = 0;
        for (const TileClass& each : patch_.result.patch.tiles.classes) {
            double around = 0;
            for (const std::uint32_t side : each.vectors)
                around += glm::length(patch_.result.patch.plane.vector_at(side));
            widest = std::max(widest, around / 2);
        }
        return widest;
    }
    /// Space for the pen in steps; a generous estimate if it is in millimetres.
    double pen_width() const { return style_.stroke.in_steps ? 2 * style_.stroke.value : 1.0; }

    void count_tiles() {
        TorusPlaces places(swatch_.cell.sides);
        for (const glm::dvec2 middle : middles_of_tiles()) places.number(middle);
        swatch_.tiles = places.count();
    }

    PlacementOptions turned_placement() const {
        PlacementOptions placement = options_.placement;
        placement.rotate += swatch_.turn;
        return placement;
    }

    void frame() {
        const glm::dmat3x2 turned = orientation(turned_placement());
        const auto& [corner, sides] = swatch_.cell;
        for (const glm::dvec2 at : {corner, corner + sides[0], corner + sides[1], corner + sides[0] + sides[1]}) {
            swatch_.frame.add(turned * glm::dvec3(at, 1));
        }
    }

    /// Pixels of the place, moved by a displacement in steps.
    std::vector<std::uint8_t> picture(glm::dvec2 way) const {
        constexpr double side = 240;  // pixels
        Swatch moved = swatch_;
        moved.cell.corner += way;
        const glm::dvec2 turned = orientation(turned_placement()) * glm::dvec3(way, 0);
        moved.frame.low += turned;
        moved.frame.high += turned;
        DrawingOptions drawn = options_;
        drawn.placement = turned_placement();
        drawn.placement.step.reset();
        drawn.window = moved.window();
        drawn.frame = DrawnExtent{moved.frame};
        drawn.may_be_empty = true;
        if (swatch_.has_tile_period) drawn.tile_period = swatch_.cell.sides;
        Print print;
        print.style = style_;
        print.style.border.reset();
        print.style.floor.reset();
        const glm::dvec2 size = moved.frame.high - moved.frame.low;
        print.page = {size.x / std::max(size.x, size.y) * side, size.y / std::max(size.x, size.y) * side, 0};
        print.dpi = 25.4;
        std::vector<std::uint8_t> pixels;
        Reading reading(limits_);
        reading.is_vector = false;
        const auto drawing = make_drawing(*grammar_.with_steps(swatch_.steps), print.style, drawn, reading);
        drawing->place(print);
        print.style = drawing->style();
        const Print shown = as_picture(print);
        drawing->rendering(shown)->render(1, [&](int, int, std::span<const std::uint8_t> rows) {
            pixels.insert(pixels.end(), rows.begin(), rows.end());
        });
        return pixels;
    }

    /// All other parts of the drawing have to repeat, too.
    void compare_pictures() const {
        constexpr int same = 24;              // levels
        constexpr double differing = 0.0001;  // share of all values
        const std::vector<std::uint8_t> here = picture(glm::dvec2(0.0));
        for (const glm::dvec2 way : swatch_.cell.sides) {
            const std::vector<std::uint8_t> there = picture(way);
            std::size_t count = here.size() == there.size() ? 0 : here.size();
            for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i) {
                if (std::abs(int{here[i]} - int{there[i]}) > same) ++count;
            }
            if (static_cast<double>(count) > differing * static_cast<double>(here.size())) {
                throw SwatchError("the tiles repeat, but the lines or colours on them do not");
            }
        }
    }

    [[noreturn]] void refuse() const {
        if (patch_.tiles() == 0)
            throw SwatchError("this drawing has no tiles, which are closed polygons between { and }");
        if (patch_.tiles() < fewest_tiles) {
            throw SwatchError(fmt::format("found no period in {}, up to a derivation length of {}{}",
                                          counted(patch_.tiles(), "tile"), patch_.steps,
                                          limit_.empty() ? "" : "; longer ones: " + limit_));
        }
        if (patch_.without_colours.count == 2) {
            throw SwatchError(
                "the tiles repeat, but their colours do not; 'tile colours' by shape or neighbours repeat");
        }
        if (patch_.result.examination.neighbours == 0 ||
            (patch_.periods.count > 0 && patch_.periods.compared * 4 < patch_.tiles())) {
            throw SwatchError("the tiles do not touch along their edges, so this is not a tiling");
        }
        const std::string searched = fmt::format("among translations of up to {:.3g} steps of {}",
                                                 patch_.periods.reach, counted(patch_.tiles(), "tile"));
        if (patch_.periods.count == 1) {
            throw SwatchError(fmt::format("found periods in one direction only, {}", searched));
        }
        throw SwatchError(fmt::format("found no period {}{}", searched, irrational_shares()));
    }

    /// A tiling with two periods has rational shares of its shapes. The limit is recognised by nine digits.
    std::string irrational_shares() const {
        const TileGrowth growth = find_growth(grammar_);
        for (const double share : growth.frequencies) {
            const std::string form = closed_form(share / growth.frequencies.front());
            if (form.find("√") != std::string::npos || form == "τ") {
                return fmt::format("; its shapes tend to the ratio {}, which is irrational", form);
            }
        }
        return "";
    }

    const Grammar& grammar_;
    const Style& style_;
    const DrawingOptions& options_;
    const ReadingLimits& limits_;
    bool may_turn_;
    Patch patch_{0, TilingResult{{}, {TilePlane(1.0), {}, {}, {}, TileNeighbours(0, {}), {}, {}}}, {}, {}};
    std::string limit_;  // why no longer derivation was examined
    Swatch swatch_;
    double needed_ = 0;
};

}  // namespace

ViewWindow Swatch::window() const {
    Box box;
    for (const glm::dvec2 at : {cell.corner, cell.corner + cell.sides[0], cell.corner + cell.sides[1],
                                cell.corner + cell.sides[0] + cell.sides[1]}) {
        box.add(at);
    }
    return {box.low.x, box.low.y, box.high.x, box.high.y};
}

Swatch find_swatch(const Grammar& grammar, const Style& style, const DrawingOptions& options,
                   const ReadingLimits& limits, bool may_turn) {
    return SwatchFinder(grammar, style, options, limits, may_turn).find();
}

}  // namespace sikku
