#include "art/kolam/faces.h"

#include "engine/base/union_find.h"

#include <numeric>

namespace sikku::kolam_plane {

Faces::Faces(const PlanarGraph& graph, std::span<const char> closed_times, const KolamOptions& options)
    : graph_(graph) {
    Pulse pulse(options.monitor);
    const std::vector<double> areas = find_cycles(pulse);
    breathe(options);
    const std::vector<std::uint32_t> lowest = find_components(areas, pulse);

    // From below, so that the face around a component is known before the component.
    std::vector<std::uint32_t> order(lowest.size());
    std::iota(order.begin(), order.end(), 0u);
    sort(options, order, [&](std::uint32_t a, std::uint32_t b) { return is_lower(lowest[a], lowest[b]); });
    container_.assign(lowest.size(), none);
    odd_.assign(begins_.size(), 0);
    has_holes_.assign(begins_.size(), 0);
    std::vector<char> reached(begins_.size(), 0);
    std::vector<std::uint32_t> front;
    for (const std::uint32_t component : order) {
        pulse();
        if (lowest.size() > 1) container_[component] = at(graph_.places[lowest[component]]);
        const std::uint32_t container = container_[component];
        if (container != none) has_holes_[container] = 1;
        odd_[outer_[component]] = container == none ? 0 : odd_[container];
        reached[outer_[component]] = 1;
        front = {outer_[component]};
        while (!front.empty()) {
            const std::uint32_t first = begins_[front.back()];
            const char odd = odd_[front.back()];
            front.pop_back();
            std::uint32_t half = first;
            do {
                pulse();
                const std::uint32_t beyond = cycle_[half ^ 1];
                if (!reached[beyond]) {
                    reached[beyond] = 1;
                    odd_[beyond] = static_cast<char>(odd ^ closed_times[half / 2]);
                    front.push_back(beyond);
                }
                half = graph_.next(half);
            } while (half != first);
        }
    }
    breathe(options);
}

/// Finds the cycles and returns the area of each, negative for clockwise cycles.
std::vector<double> Faces::find_cycles(Pulse& pulse) {
    cycle_.assign(2 * graph_.edges.size(), none);
    std::vector<double> areas;
    for (std::uint32_t first = 0; first < cycle_.size(); ++first) {
        if (cycle_[first] != none) continue;
        const auto number = static_cast<std::uint32_t>(begins_.size());
        begins_.push_back(first);
        const glm::dvec2 origin = graph_.places[graph_.tail(first)];
        double twice = 0;
        std::uint32_t half = first;
        do {
            pulse();
            cycle_[half] = number;
            twice +=
                determinant(graph_.places[graph_.tail(half)] - origin, graph_.places[graph_.head(half)] - origin);
            half = graph_.next(half);
        } while (half != first);
        areas.push_back(twice / 2);
    }
    return areas;
}

bool Faces::is_lower(std::uint32_t a, std::uint32_t b) const {
    return std::pair(graph_.places[a].y, graph_.places[a].x) < std::pair(graph_.places[b].y, graph_.places[b].x);
}

/// Finds the components and their outer cycles, and returns the lowest vertex of each component.
std::vector<std::uint32_t> Faces::find_components(std::span<const double> areas, Pulse& pulse) {
    UnionFind components(graph_.places.size());
    for (const auto& [a, b] : graph_.edges) components.join(a, b);
    component_.resize(graph_.places.size());
    std::vector<std::uint32_t> lowest;  // vertex of each component
    std::vector<std::uint32_t> number(graph_.places.size(), none);
    for (std::uint32_t vertex = 0; vertex < graph_.places.size(); ++vertex) {
        pulse();
        const std::uint32_t root = components.find(vertex);
        if (number[root] == none) {
            number[root] = static_cast<std::uint32_t>(lowest.size());
            lowest.push_back(vertex);
        }
        component_[vertex] = number[root];
        std::uint32_t& low = lowest[number[root]];
        if (is_lower(vertex, low)) low = vertex;
    }
    outer_.assign(lowest.size(), none);
    for (std::uint32_t cycle = 0; cycle < begins_.size(); ++cycle) {
        std::uint32_t& outer = outer_[component_[graph_.tail(begins_[cycle])]];
        if (outer == none || areas[cycle] < areas[outer]) outer = cycle;
    }
    return lowest;
}

std::uint32_t Faces::at(glm::dvec2 point) const {
    const auto& entries = graph_.grid->entries();
    const std::uint64_t column = graph_.grid->column(point.x);
    std::uint32_t found = none;
    double found_y = 0;
    double found_slope = 0;
    for (std::size_t i = graph_.grid->end_of(column, graph_.grid->row(point.y)); i > 0; --i) {
        const std::uint64_t key = entries[i - 1].key;
        if (key >> 32 != column) break;
        if (found != none && (key & 0xffffffff) < graph_.grid->row(found_y)) break;
        const auto halves = graph_.pieces(entries[i - 1].item);
        const Segment& segment = graph_.segments[entries[i - 1].item];
        const bool rightward = graph_.node_places[segment.from].x < graph_.node_places[segment.to].x;
        const auto piece = std::partition_point(halves.begin(), halves.end(), [&](std::uint32_t half) {
            return rightward ? graph_.places[graph_.head(half)].x <= point.x
                             : graph_.places[graph_.head(half)].x > point.x;
        });
        if (piece == halves.end()) continue;
        const std::uint32_t half = rightward ? *piece : *piece ^ 1;
        const glm::dvec2 a = graph_.places[graph_.tail(half)];
        const glm::dvec2 b = graph_.places[graph_.head(half)];
        if (!(a.x <= point.x && point.x < b.x)) continue;
        const double slope = (b.y - a.y) / (b.x - a.x);
        const double y = a.y + (point.x - a.x) * slope;
        if (!(y < point.y - graph_.rounding)) continue;
        const bool is_same = found != none && std::fabs(y - found_y) <= graph_.rounding;
        if (found == none || (is_same ? slope > found_slope : y > found_y)) {
            found = half;
            found_y = y;
            found_slope = slope;
        }
    }
    if (found == none) return none;
    const std::uint32_t cycle = cycle_[found];
    const std::uint32_t component = component_[graph_.tail(found)];
    return cycle == outer_[component] ? container_[component] : cycle;
}

}  // namespace sikku::kolam_plane
