// engine/tiling/vertex_figures.cpp: the vertices of a tiling, by the angles of the tiles around them.
#include "engine/base/threads.h"
#include "engine/tiling/tiling.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <unordered_map>

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

/// Sequences of corners around points, numbered as they occur.
struct Sequences {
    struct Hash {
        std::size_t operator()(const Corners& corners) const {
            std::uint64_t hash = 0;
            for (const auto& [angle, shape] : corners) {
                hash = (hash ^ (std::uint64_t{shape} << 32U | angle)) * 0x9e3779b97f4a7c15;
                hash ^= hash >> 32U;
            }
            return static_cast<std::size_t>(hash);
        }
    };
    std::unordered_map<Corners, std::uint32_t, Hash> numbers;
    std::vector<const Corners*> sequences;
    std::vector<std::uint64_t> counts;  ///< of points

    std::uint32_t add(const Corners& corners) {
        std::uint32_t& recent = recent_[Hash()(corners) % recent_.size()];
        if (recent >= counts.size() || *sequences[recent] != corners) recent = number_of(corners);
        ++counts[recent];
        return recent;
    }

private:
    std::uint32_t number_of(const Corners& corners) {
        const auto [found, is_new] = numbers.try_emplace(corners, static_cast<std::uint32_t>(counts.size()));
        if (is_new) {
            sequences.push_back(&found->first);
            counts.push_back(0);
        }
        return found->second;
    }

    std::array<std::uint32_t, 256> recent_{};  // numbers of sequences that were found last, by hash
};

}  // namespace

std::vector<VertexFigure> find_figures(const TilePlane& plane, const TileSet& tiles, const TilePieces& pieces,
                                       std::vector<std::uint32_t>& figure_of, const Monitor& monitor) {
    std::vector<std::uint32_t> shape_of_class;
    for (const TileClass& each : tiles.classes) shape_of_class.push_back(each.shape);
    figure_of.assign(plane.points(), no_number);
    const auto points = static_cast<std::uint32_t>(plane.points());
    constexpr std::uint32_t share = 1 << 14;
    const auto find = [&](std::uint32_t first, std::uint32_t end) {
        Sequences found;
        Pulse pulse(monitor);
        Corners corners;
        for (std::uint32_t point = first; point < end; ++point) {
            pulse();
            const auto sides = pieces.out_of(point);
            if (sides.empty()) continue;
            const bool is_inner = std::all_of(sides.begin(), sides.end(), [&](std::uint32_t side) {
                return pieces.twin[pieces.previous(side)] != no_number;
            });
            if (!is_inner) continue;
            corners.clear();
            for (const std::uint32_t side : sides) {
                corners.emplace_back(pieces.angle(side), shape_of_class[tiles.in_class[pieces.tile(side)]]);
            }
            figure_of[point] = found.add(corners);
        }
        return found;
    };
    // The figures of each sequence of each part.
    std::vector<std::vector<std::uint32_t>> figures_of_part(points / share + 1);
    std::map<Corners, std::uint32_t> numbers;  // of forms
    std::vector<VertexFigure> figures;
    std::vector<Sequences> places(4 * static_cast<std::size_t>(available_threads()));
    in_order(
        figures_of_part.size(), places.size(),
        [&](std::size_t part, std::size_t place) {
            const auto first = static_cast<std::uint32_t>(part) * share;
            places[place] = find(first, std::min(points, first + share));
        },
        [&](std::size_t part, std::size_t place) {
            const Sequences& found = places[place];
            for (std::size_t i = 0; i < found.counts.size(); ++i) {
                const Corners form = least_form(*found.sequences[i], tiles.angles);
                const auto [number, is_new] = numbers.try_emplace(form, static_cast<std::uint32_t>(figures.size()));
                if (is_new) {
                    VertexFigure& figure = figures.emplace_back();
                    for (const auto& [angle, shape] : form) {
                        figure.angles.push_back(tiles.angles[angle]);
                        figure.shapes.push_back(shape);
                    }
                }
                figures[number->second].count += found.counts[i];
                figures_of_part[part].push_back(number->second);
            }
        });
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
    for (std::uint32_t point = 0; point < points; ++point) {
        std::uint32_t& figure = figure_of[point];
        if (figure != no_number) figure = place[figures_of_part[point / share][figure]];
    }
    return sorted;
}

}  // namespace sikku
