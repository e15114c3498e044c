// engine/tiling/vertex_figures.cpp: the vertices of a tiling, by the angles of the tiles around them.
#include "engine/tiling/tiling.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace sikku {
namespace {

/// Angles with their shapes, anticlockwise.
using Corners = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The least of all rotations of the sequence and its mirror image, by degrees, then by shapes.
Corners least_form(const Corners& corners, const std::vector<double>& angles) {
    const auto less = [&](const Corners::value_type& a, const Corners::value_type& b) {
        return a.first != b.first ? angles[a.first] < angles[b.first] : a.second < b.second;
    };
    Corners least = corners, form = corners;
    for (int reflection = 0; reflection < 2; ++reflection) {
        for (std::size_t i = 0; i < form.size(); ++i) {
            std::rotate(form.begin(), form.begin() + 1, form.end());
            if (std::lexicographical_compare(form.begin(), form.end(), least.begin(), least.end(), less))
                least = form;
        }
        std::reverse(form.begin(), form.end());
    }
    return least;
}

}  // namespace

std::vector<VertexFigure> find_figures(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                                       std::vector<std::uint32_t>& figure_of, const Monitor& monitor) {
    Pulse pulse(monitor);
    std::map<Corners, std::uint32_t> numbers;  // of forms
    std::map<Corners, std::uint32_t> known;    // of sequences as they occur
    std::vector<VertexFigure> figures;
    figure_of.assign(plane.points(), no_number);
    Corners corners;
    for (std::uint32_t point = 0; point < plane.points(); ++point) {
        pulse();
        const auto sides = pieces.out_of(point);
        if (sides.empty()) continue;
        const bool is_inner = std::all_of(sides.begin(), sides.end(), [&](std::uint32_t side) {
            return pieces.twin[pieces.previous(side)] != no_number;
        });
        if (!is_inner) continue;
        corners.clear();
        for (const std::uint32_t side : sides) {
            corners.emplace_back(pieces.angle[side], tiles.class_of(pieces.tile[side]).shape);
        }
        auto found = known.find(corners);
        if (found == known.end()) {
            const Corners form = least_form(corners, tiles.angles);
            const auto [number, is_new] = numbers.try_emplace(form, static_cast<std::uint32_t>(figures.size()));
            if (is_new) {
                VertexFigure& figure = figures.emplace_back();
                for (const auto& [angle, shape] : form) {
                    figure.angles.push_back(tiles.angles[angle]);
                    figure.shapes.push_back(shape);
                }
            }
            found = known.emplace(corners, number->second).first;
        }
        ++figures[found->second].count;
        figure_of[point] = found->second;
    }
    std::vector<std::uint32_t> order(figures.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return figures[a].count > figures[b].count; });
    std::vector<std::uint32_t> place(order.size());
    std::vector<VertexFigure> sorted;
    for (const std::uint32_t number : order) {
        place[number] = static_cast<std::uint32_t>(sorted.size());
        sorted.push_back(std::move(figures[number]));
    }
    for (std::uint32_t& figure : figure_of) {
        if (figure != no_number) figure = place[figure];
    }
    return sorted;
}

}  // namespace sikku
