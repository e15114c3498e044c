#include "art/tiles/tile_decorator.h"

#include "art/plotter/plot_join.h"
#include "art/plotter/plot_layer.h"
#include "art/tiles/tile_worms.h"
#include "art/tiles/united_lines.h"
#include "engine/base/chance.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/cross.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

glm::dvec2 turned_left(glm::dvec2 vector) {
    return {-vector.y, vector.x};
}

double twice_area(std::span<const glm::dvec2> vertices) {
    double area = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        area += cross(vertices[i] - vertices[0], vertices[(i + 1) % vertices.size()] - vertices[0]);
    }
    return area;
}

/// The centroid, or the mean of the vertices of a tile without area.
glm::dvec2 middle(std::span<const glm::dvec2> vertices) {
    const double area = twice_area(vertices);
    glm::dvec2 sum(0.0);
    glm::dvec2 mean(0.0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec2 a = vertices[i] - vertices[0];
        const glm::dvec2 b = vertices[(i + 1) % vertices.size()] - vertices[0];
        sum += (a + b) * cross(a, b);
        mean += a / static_cast<double>(vertices.size());
    }
    return vertices[0] + (area != 0 ? sum / (3 * area) : mean);
}

}  // namespace

/// The curves, straight lines and dots of all tiles, by colour.
class TileDecorator::Curves {
public:
    Curves(const Style& style, double most) : style_(style), most_(most) {}

    /// A curve with given directions at its ends, both pointing forwards.
    void curve(int colour, glm::dvec2 from, glm::dvec2 out, glm::dvec2 to, glm::dvec2 in) {
        const glm::dvec2 chord = to - from;
        // The handles of a circular arc, if the ends are those of one.
        const double angle = std::fabs(std::atan2(cross(out, in), glm::dot(out, in)));
        const double quarter = std::cos(angle / 4);
        const double handle = glm::length(chord) / (3 * quarter * quarter);
        const double slack = 1e-9 * glm::length(chord);
        if (std::fabs(cross(chord, out)) <= slack && std::fabs(cross(chord, in)) <= slack &&
            glm::dot(chord, out) > 0) {
            return line(colour, from, to);
        }
        Layer& layer = layer_of(colour);
        layer.beziers.push_back({from, from + out * handle, to - in * handle, to});
        count();
    }
    void line(int colour, glm::dvec2 from, glm::dvec2 to) {
        layer_of(colour).lines.emplace_back(from, to);
        count();
    }
    void dot(int colour, glm::dvec2 at) {
        layer_of(colour).dots.push_back(at);
        count();
    }

    void draw(bool by_length, PathSink& sink, const Monitor& monitor) const {
        double size = 0;
        for (const auto& [colour, layer] : layers_) {
            for (const CubicBezier& bezier : layer.beziers) size = std::max(size, reach(bezier[0]));
            for (const auto& [from, to] : layer.lines) size = std::max({size, reach(from), reach(to)});
        }
        for (const auto& [colour, layer] : layers_) {
            draw_layer(colour, layer, std::max(1e-9 * size, 1e-300), by_length, sink, monitor);
        }
        for (const auto& [colour, layer] : layers_) {
            for (const glm::dvec2 at : layer.dots) sink.disc(at, 0, Pen{.colour = colour});
        }
    }

private:
    struct Layer {
        std::vector<CubicBezier> beziers;
        std::vector<std::pair<glm::dvec2, glm::dvec2>> lines;
        std::vector<glm::dvec2> dots;
    };

    static double reach(glm::dvec2 point) { return std::max(std::fabs(point.x), std::fabs(point.y)); }
    Layer& layer_of(int colour) { return layers_[style_.index(Pen{.colour = colour})]; }
    void count() {
        if (++count_ > most_) {
            throw BudgetError(
                fmt::format("the decoration has more than {:.0f} curves, the limit of the budget", most_));
        }
    }

    void draw_layer(int colour, const Layer& layer, double tolerance, bool by_length, PathSink& sink,
                    const Monitor& monitor) const {
        const Pen pen{.colour = colour};
        // Lines that continue each other become one.
        UnitedLines united(most_);
        for (const auto& [from, to] : layer.lines) united.add_line(from, to, pen);
        PlotNodes nodes(tolerance);
        PlotGraph graph;
        for (const UnitedLines::Line& line : united.unite(UnitedLines::Kept::all, monitor).lines) {
            graph.segments.push_back({nodes.at(line.from), nodes.at(line.to)});
        }
        for (const CubicBezier& bezier : layer.beziers) {
            const std::uint32_t from = nodes.at(bezier[0]);
            const std::uint32_t to = nodes.at(bezier[3]);
            graph.segments.push_back({from, to, nodes.at(bezier[1]), nodes.at(bezier[2])});
        }
        graph.points = std::move(nodes.points);
        const PlotStrokes strokes = join_segments(graph, monitor);
        std::vector<double> lengths;  // lengths of strokes
        for (const PlotStroke& stroke : strokes.strokes) {
            double length = 0;
            for (const PlotEnd end : strokes.ends(stroke)) length += graph.length(end);
            lengths.push_back(length);
        }
        const std::vector<double> classes = by_length ? length_classes(lengths) : std::vector<double>{};
        for (std::size_t i = 0; i < strokes.strokes.size(); ++i) {
            Pen own = pen;
            if (by_length) {
                const auto at = std::upper_bound(classes.begin(), classes.end(), lengths[i]) - classes.begin();
                own.colour = style_.index(Pen{.colour = static_cast<int>((at - 1) % 4096)});
            }
            draw_stroke(graph, strokes.ends(strokes.strokes[i]), strokes.strokes[i].closed, own, sink);
        }
    }

    /// The least length of each class of equal lengths, ascending.
    static std::vector<double> length_classes(std::vector<double> lengths) {
        std::sort(lengths.begin(), lengths.end());
        std::vector<double> classes;
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            if (i == 0 || lengths[i] > lengths[i - 1] * (1 + 1e-6)) classes.push_back(lengths[i]);
        }
        return classes;
    }

    static void draw_stroke(const PlotGraph& graph, std::span<const PlotEnd> ends, bool closed, const Pen& pen,
                            PathSink& sink) {
        sink.begin_stroke(graph.point(ends.front()), pen);
        for (const PlotEnd end : ends) {
            if (graph.segments[end / 2].is_curve()) {
                const CubicBezier bezier = graph.bezier(end);
                sink.curves(std::span(bezier).subspan(1));
            } else {
                const glm::dvec2 to = graph.point(end ^ 1U);
                sink.lines({&to, 1});
            }
        }
        sink.end_stroke(closed);
    }

    const Style& style_;
    double most_;
    double count_ = 0;
    std::map<int, Layer> layers_;
};

void TileDecorator::add(std::span<const glm::dvec2> vertices, const Pen& pen) {
    if (static_cast<double>(tiles_.vertices().size() + vertices.size()) > most_) {
        throw BudgetError(fmt::format(
            "the drawing has more than {:.0f} edges of tiles, the limit of the budget for decorating them", most_));
    }
    const int colour = style_.index(pen);
    for (const TileCurve& curve : style_.decoration.curves) {
        const double last = std::max(curve.from, curve.to);
        const bool is_meant = std::any_of(curve.tiles.begin(), curve.tiles.end(),
                                          [&](int tile) { return style_.index(Pen{.colour = tile}) == colour; });
        if (is_meant && last > static_cast<double>(vertices.size())) {
            throw std::runtime_error(
                fmt::format("'decorate' names the place {} on tiles of colour {}; tile {} has {} sides, and its "
                            "places end at {}",
                            last, colour, colours_.size() + 1, vertices.size(), vertices.size()));
        }
    }
    tiles_.add(vertices);
    colours_.push_back(colour);
}

/// The sides of each tile, anticlockwise, cut at the corners of others.
std::vector<std::vector<TileDecorator::Side>> TileDecorator::cut_sides(const Monitor& monitor) const {
    UnitedLines united(most_);
    for (std::size_t i = 0; i < colours_.size(); ++i) united.add_tile(tiles_[i]);
    std::vector<std::vector<Side>> sides(colours_.size());
    const UnitedLines::Result found = united.unite(UnitedLines::Kept::sides, monitor);
    double size = 0;
    for (const glm::dvec2 vertex : tiles_.vertices())
        size = std::max({size, std::fabs(vertex.x), std::fabs(vertex.y)});
    PlotNodes nodes(std::max(1e-9 * size, 1e-300));
    std::vector<std::map<std::uint32_t, std::pair<std::uint32_t, bool>>> next(colours_.size());
    for (const UnitedLines::Side& side : found.sides) {
        const std::uint32_t from = nodes.at(side.from);
        const std::uint32_t to = nodes.at(side.to);
        if (side.left) next[*side.left].try_emplace(from, to, side.right.has_value());
        if (side.right) next[*side.right].try_emplace(to, from, side.left.has_value());
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (next[i].empty()) continue;
        // From the tile's first vertex on, so that the sides do not depend on the order of pieces.
        const auto first = next[i].find(nodes.at(tiles_[i][0]));
        std::uint32_t at = first != next[i].end() ? first->first : next[i].begin()->first;
        while (sides[i].size() < next[i].size()) {
            const auto side = next[i].find(at);
            if (side == next[i].end()) break;
            const auto [to, is_inner] = side->second;
            sides[i].push_back({nodes.points[at], nodes.points[to], is_inner});
            at = to;
        }
    }
    return sides;
}

/// Draws the curves that the pattern defines for tiles of a colour.
void TileDecorator::draw_own(Curves& curves) const {
    for (std::size_t i = 0; i < colours_.size(); ++i) {
        const std::span<const glm::dvec2> corners = tiles_[i];
        const double inwards = twice_area(corners) < 0 ? -1 : 1;
        const auto place = [&](double at) {
            const auto side = std::min(static_cast<std::size_t>(at), corners.size() - 1);
            const glm::dvec2 from = corners[side];
            const glm::dvec2 along = corners[(side + 1) % corners.size()] - from;
            // The direction into the tile; at a corner, the one at a right angle to the side which begins there.
            const glm::dvec2 into = turned_left(along) * (inwards / std::max(glm::length(along), 1e-300));
            return std::pair(from + along * (at - static_cast<double>(side)), into);
        };
        for (const TileCurve& curve : style_.decoration.curves) {
            const bool is_meant = std::any_of(curve.tiles.begin(), curve.tiles.end(), [&](int tile) {
                return style_.index(Pen{.colour = tile}) == colours_[i];
            });
            if (!is_meant) continue;
            if (curve.kind == TileCurve::Kind::dot) {
                curves.dot(curve.colour, middle(corners));
                continue;
            }
            const auto [from, out] = place(curve.from);
            const auto [to, back] = place(curve.to);
            if (curve.kind == TileCurve::Kind::arc) {
                curves.curve(curve.colour, from, out, to, -back);
            } else {
                curves.line(curve.colour, from, to);
            }
        }
    }
}

bool TileDecorator::draw(PathSink& sink, const Monitor& monitor) const {
    const TileDecoration& decoration = style_.decoration;
    bool has_worms = false;
    Curves curves(style_, most_);
    Pulse pulse(monitor);
    draw_own(curves);
    if (decoration.kolam || decoration.truchet) {
        const std::vector<std::vector<Side>> all = cut_sides(monitor);
        for (std::size_t i = 0; i < all.size(); ++i) {
            pulse();
            const std::vector<Side>& sides = all[i];
            const std::size_t count = sides.size();
            if (count < 2) continue;
            const auto half = [&](std::size_t side) {
                return (sides[side % count].from + sides[side % count].to) / 2.0;
            };
            const auto along = [&](std::size_t side) {
                return glm::normalize(sides[side % count].to - sides[side % count].from);
            };
            if (decoration.kolam) {
                for (std::size_t side = 0; side < count; ++side) {
                    const glm::dvec2 out =
                        along(side) + turned_left(along(side)) * (sides[side].is_inner ? 1.0 : 0.0);
                    const std::size_t after = (side + 1) % count;
                    const glm::dvec2 in =
                        along(after) - turned_left(along(after)) * (sides[after].is_inner ? 1.0 : 0.0);
                    curves.curve(0, half(side), glm::normalize(out), half(after), glm::normalize(in));
                }
            }
            if (decoration.truchet) {
                const Chance chance{axiom_place(seed_, i), 0};
                const std::size_t ways = count % 2 == 0 ? 2 : count;
                const auto first =
                    std::min(static_cast<std::size_t>(chance.uniform(0) * static_cast<double>(ways)), ways - 1);
                for (std::size_t pair = 0; pair + 1 < count; pair += 2) {
                    const std::size_t a = first + pair;
                    curves.curve(0, half(a), turned_left(along(a)), half(a + 1), -turned_left(along(a + 1)));
                }
                // A line of an odd number ends in the middle.
                if (count % 2 == 1) {
                    const std::size_t left = first + count - 1;
                    curves.line(0, half(left), middle(tiles_[i]));
                    curves.dot(0, middle(tiles_[i]));
                }
            }
        }
    }
    if (decoration.worms) {
        for (const WormLink& link : find_worms(tiles_, monitor)) {
            curves.line(0, link.from, link.to);
            has_worms = true;
        }
    }
    if (decoration.dots) {
        for (std::size_t i = 0; i < colours_.size(); ++i) curves.dot(0, middle(tiles_[i]));
    }
    curves.draw(decoration.strands, sink, monitor);
    return has_worms;
}

}  // namespace sikku
