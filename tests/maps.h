// tests/maps.h: map systems of the literature and of worked examples, a slow second way to derive maps, and random
// systems.
#pragma once

#include "engine/language/document.h"
#include "engine/map/map_step.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace sikku::maps {

/// Prusinkiewicz & Hanan 1989, figure 5.2.
inline const std::string layer = R"(map: clockwise
axiom: gca
a --> c[-~a]x[+~b]g
b --> v[-b]x[+~b]v
c --> d
d --> e[-b]x[+b]e
e --> f
f --> c[-~b]x[+~b]c
g --> h[-a]i
h --> j
i --> x[+b]k
j --> l[-b]m
k --> n[-~b]o
l --> p
m --> x[+~b]p
n --> q[+~b]x
o --> q
p --> r[-~b]s
q --> t[-b]u
r --> j
s --> x[+b]j
t --> k
u --> x[+b]k
v --> ~b
x --> x
)";

/// Prusinkiewicz & Hanan 1989, figure 5.3.
inline const std::string leaf = R"(map: clockwise
place: pressure
growth: 0.4
axiom: c~p~j
a --> d[-j]c
c --> [+~y]e
d --> d
e --> f
f --> d[-y]c
j --> d[+a]~k
k --> m[+y]d
m --> n
n --> k[-~y]d
p --> q[+~a]r
q --> r[+~j]p
r --> s
s --> t
t --> r[+u]r
u --> v
v --> w[-~y][+y]d
w --> u
y --> d[+~u]d
)";

inline const std::string worked =
    "map: clockwise\naxiom: ab~ab\na --> e\nb --> ~a[-c][-~c]b\nc --> b\ne --> a[+c][-d]e\n";

inline const std::string checkers = "map: clockwise\naxiom: A~B~AB\nA --> B[-A][+~A]B\nB --> ~A\n";

inline Document document(const std::string& text, std::int64_t steps, const std::vector<Setting>& settings = {}) {
    std::vector<Setting> all = {{"-n", "derivation length", std::to_string(steps)}};
    all.insert(all.end(), settings.begin(), settings.end());
    return parse("map.lsys", text, {"", all});
}

inline Map derive(const Document& document) {
    return derive_map(document.grammar());
}

inline std::string text_of(const Map& map, const MapSystem& system) {
    std::string text;
    print_map(map, system, [&](std::string_view piece) { text += piece; });
    return text;
}

/// A wall as a word: `~` before the label of a half-edge that is walked from head to tail.
inline std::string word_of(const Map& map, const MapSystem& system, std::span<const HalfEdge> wall) {
    std::string word;
    for (const HalfEdge half : wall) {
        if (half.is_reversed()) word += '~';
        word += system.labels[map.edges()[half.edge()].label];
    }
    return word;
}

/// The walls of the cells, in their order.
inline std::vector<std::string> words_of(const Map& map, const MapSystem& system) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < map.cells(); ++i) words.push_back(word_of(map, system, map.cell(i)));
    return words;
}

/// What is wrong with a map: half-edges that do not lie on one wall, walls that do not close, or another number of
/// cells than in the plane; empty if nothing is.
inline std::string fault_of(const Map& map) {
    if (map.vertices() + map.cells() + 1 != map.edges().size() + 2) return "Euler's formula does not hold";
    std::vector<int> times(2 * map.edges().size());
    for (std::size_t i = 0; i <= map.cells(); ++i) {
        const auto wall = map.cell(i);
        if (wall.empty()) return "a wall is empty";
        for (std::size_t k = 0; k < wall.size(); ++k) {
            ++times[2 * wall[k].edge() + (wall[k].is_reversed() ? 1 : 0)];
            if (map.end(wall[k]) != map.start(wall[(k + 1) % wall.size()])) return "a wall does not close";
        }
    }
    const bool is_complete = std::all_of(times.begin(), times.end(), [](int count) { return count == 1; });
    return is_complete ? "" : "a half-edge does not lie on one wall";
}

// --- a slow second way
// ----------------------------------------------------------------------------------------------

/// Maps as lists of lists; divides cells by the recursion that defines division.
class SlowMap {
public:
    struct Edge {
        Label label;
        std::uint32_t tail, head, born;
    };
    /// Numbers of edges from 1 upwards, negative if walked backwards.
    using Wall = std::vector<std::int64_t>;

    explicit SlowMap(const MapSystem& system) : system_(system) {
        const std::size_t size = system.axiom.size();
        Wall wall;
        for (std::uint32_t i = 0; i < size; ++i) {
            const auto next = static_cast<std::uint32_t>((i + 1) % size);
            const bool back = system.axiom[i].is_reversed;
            edges.push_back({system.axiom[i].label, back ? next : i, back ? i : next, 0});
            wall.push_back(back ? -std::int64_t{i} - 1 : std::int64_t{i} + 1);
        }
        vertices = size;
        const Wall reversed = opposite(wall);
        cells = {system.is_clockwise ? wall : reversed};
        outer = system.is_clockwise ? reversed : wall;
    }

    void step(std::uint32_t table, std::uint32_t number) {
        number_ = number;
        std::vector<Edge> before;
        std::swap(before, edges);
        std::vector<Items> right(before.size());
        std::vector<Items> left(before.size());
        for (std::size_t e = 0; e < before.size(); ++e) {
            const MapProduction& rule = system_.production(table, before[e].label);
            std::vector<std::uint32_t> stops = {before[e].tail};
            for (std::size_t i = 1; i < rule.parts.size(); ++i)
                stops.push_back(static_cast<std::uint32_t>(vertices++));
            stops.push_back(before[e].head);
            for (std::size_t i = 0; i < stops.size(); ++i) {
                for (const MapBranch& branch : rule.right) {
                    if (branch.position == i) right[e].push_back(item(branch, stops[i]));
                }
                if (i + 1 == stops.size()) break;
                const bool back = rule.parts[i].is_reversed;
                edges.push_back(
                    {rule.parts[i].label, stops[back ? i + 1 : i], stops[back ? i : i + 1], before[e].born});
                const auto edge = static_cast<std::int64_t>(edges.size());
                right[e].push_back({back ? -edge : edge, 0, 0, false});
            }
            const auto first = static_cast<std::int64_t>(edges.size() - rule.parts.size()) + 1;
            for (std::size_t i = stops.size(); i > 0; --i) {
                for (const MapBranch& branch : rule.left) {
                    if (branch.position == i - 1) left[e].push_back(item(branch, stops[i - 1]));
                }
                if (i == 1) break;
                const std::int64_t edge = first + static_cast<std::int64_t>(i) - 2;
                left[e].push_back({rule.parts[i - 2].is_reversed ? edge : -edge, 0, 0, false});
            }
        }
        const auto along = [&](const Wall& wall) {
            Items items;
            for (const std::int64_t half : wall) {
                const auto& more =
                    half > 0 ? right[static_cast<std::size_t>(half - 1)] : left[static_cast<std::size_t>(-half - 1)];
                items.insert(items.end(), more.begin(), more.end());
            }
            return items;
        };
        std::vector<Wall> old;
        std::swap(old, cells);
        for (const Wall& wall : old) divide(along(wall), true);
        outer = half_edges(along(outer));
    }

    std::string text() const {
        std::string result;
        for (const Edge& edge : edges) {
            result += "edge " + system_.labels[edge.label];
            for (const std::uint32_t value : {edge.tail, edge.head, edge.born}) result += ' ' + std::to_string(value);
            result += '\n';
        }
        const auto line = [&](const std::string& name, const Wall& wall) {
            result += name;
            for (const std::int64_t half : wall) {
                result += (half < 0 ? " -" : " +") + std::to_string((half < 0 ? -half : half) - 1);
            }
            result += '\n';
        };
        for (const Wall& wall : cells) line("cell", wall);
        line("outer", outer);
        return result;
    }

    std::vector<Edge> edges;
    std::vector<Wall> cells;
    Wall outer;
    std::size_t vertices = 0;

private:
    /// A half-edge, or a branch if that is 0.
    struct Item {
        std::int64_t half_edge;
        std::uint32_t vertex;
        Label label;
        bool is_towards;
    };
    using Items = std::vector<Item>;

    static Item item(const MapBranch& branch, std::uint32_t vertex) {
        return {0, vertex, branch.label, branch.is_towards};
    }
    static Wall opposite(const Wall& wall) {
        Wall result;
        for (std::size_t i = wall.size(); i > 0; --i) result.push_back(-wall[i - 1]);
        return result;
    }
    static Wall half_edges(const Items& items) {
        Wall wall;
        for (const Item& one : items) {
            if (one.half_edge != 0) wall.push_back(one.half_edge);
        }
        return wall;
    }

    void divide(const Items& items, bool may_divide) {
        const std::size_t whole = half_edges(items).size();
        for (std::size_t i = 0; i < items.size() && may_divide; ++i) {
            std::size_t between = 0;
            for (std::size_t j = i + 1; j < items.size() && items[i].half_edge == 0; ++j) {
                if (items[j].half_edge != 0) {
                    ++between;
                    continue;
                }
                if (items[j].label != items[i].label || items[j].is_towards == items[i].is_towards) continue;
                if (between == 0 || between == whole) continue;
                const Item& tail = items[items[i].is_towards ? j : i];
                const Item& head = items[items[i].is_towards ? i : j];
                edges.push_back({items[i].label, tail.vertex, head.vertex, number_});
                const auto edge = static_cast<std::int64_t>(edges.size());
                const std::int64_t wall = items[i].is_towards ? -edge : edge;
                const auto at = [&](std::size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(k); };
                Items one(items.begin(), at(i));
                one.push_back({wall, 0, 0, false});
                one.insert(one.end(), at(j + 1), items.end());
                Items two(at(i + 1), at(j));
                two.push_back({-wall, 0, 0, false});
                divide(one, system_.divides_all);
                divide(two, system_.divides_all);
                return;
            }
        }
        cells.push_back(half_edges(items));
    }

    const MapSystem& system_;
    std::uint32_t number_ = 0;
};

// --- random systems
// -------------------------------------------------------------------------------------------------

/// A random system with a few labels, as the text of a pattern.
inline std::string random_system(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
    const std::string labels = std::string("abcdef").substr(0, 2 + below(5));
    const auto label = [&] {
        return std::string(below(3) == 0 ? "~" : "") + labels[below(std::uint32_t(labels.size()))];
    };
    std::string text = "map: ";
    text += below(2) == 0 ? "clockwise" : "anticlockwise";
    text += below(2) == 0 ? "\ndivide: all\naxiom: " : "\naxiom: ";
    for (std::uint32_t i = 1 + below(6); i > 0; --i) text += label();
    text += '\n';
    for (const char name : labels) {
        if (below(5) == 0) continue;
        text += std::string(1, name) + " --> ";
        const auto branches = [&] {
            while (below(3) == 0) text += std::string("[") + (below(2) == 0 ? "+" : "-") + label() + "]";
        };
        branches();
        for (std::uint32_t i = 1 + below(3); i > 0; --i) {
            text += label();
            branches();
        }
        text += '\n';
    }
    return text;
}

}  // namespace sikku::maps
