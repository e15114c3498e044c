#include "art/kolam/dot_grid_lines.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sikku {

GapStates parse_gap_states(const DotGrid& grid, std::string_view text) {
    const std::size_t count = grid.gaps().size();
    const std::string word = lower_case(text);
    if (word == "all" || word == "none") {
        return GapStates(count, word == "all" ? GapState::crossed : GapState::turned);
    }
    GapStates states;
    for (const char byte : text) {
        if (byte >= '0' && byte <= '2') {
            states.push_back(static_cast<GapState>(byte - '0'));
        } else if (std::string_view(" \t\r\n,/").find(byte) == std::string_view::npos) {
            throw std::runtime_error(
                fmt::format("'{}': expected all, none, or a digit for each gap: 0 turned back, 1 crossed, 2 joined",
                            printable(text, 80)));
        }
    }
    if (states.size() != count) {
        throw std::runtime_error(
            fmt::format("{} digits, but {} has {} gaps: for each row from the top those within it, then those to the "
                        "next row",
                        states.size(), grid.name(), count));
    }
    return states;
}

std::string gap_states_text(const DotGrid& grid, const GapStates& states) {
    std::string text;
    for (std::size_t i = 0; i < states.size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        // Begins a word for each row of gaps: those within a row of dots, or those between two rows.
        if (i > 0) {
            const GridGap& before = grid.gaps()[i - 1];
            const bool is_within = gap.side == 0;
            if (is_within != (before.side == 0) || grid.dots()[gap.from].y != grid.dots()[before.from].y) text += ' ';
        }
        text += static_cast<char>('0' + static_cast<int>(states[i]));
    }
    return text;
}

std::string summary_of(const GapStates& states) {
    const auto joined = std::count(states.begin(), states.end(), GapState::joined);
    std::string text = fmt::format("{} of {} crossed", std::count(states.begin(), states.end(), GapState::crossed),
                                   counted(states.size(), "gap"));
    if (joined > 0) text += fmt::format(" and {} joined", joined);
    return text;
}

// --- arcs ---------------------------------------------------------------------------------------------------------

namespace {

std::uint32_t arc_number(const DotGrid& grid, std::uint32_t dot, std::uint32_t arc) {
    return grid.sides() * dot + arc % grid.sides();
}
/// The two ends at a side: of the arc that begins there, and of the one that ends there.
std::pair<ArcEnd, ArcEnd> ends_at(const DotGrid& grid, std::uint32_t dot, std::uint32_t side) {
    return {{arc_number(grid, dot, side), 0}, {arc_number(grid, dot, side + grid.sides() - 1), 1}};
}

}  // namespace

ArcJoint turning_back(const DotGrid& grid, std::uint32_t dot, std::uint32_t side) {
    const auto [begins, ends] = ends_at(grid, dot, side);
    return {begins, ends};
}

std::array<ArcJoint, 2> joints(const DotGrid& grid, const GridGap& gap, GapState state) {
    const auto [from_left, from_right] = ends_at(grid, gap.from, gap.side);
    const auto [to_right, to_left] = ends_at(grid, gap.to, gap.side + grid.sides() / 2);
    switch (state) {
        case GapState::crossed:
            return {ArcJoint{from_left, to_right}, ArcJoint{from_right, to_left}};
        case GapState::joined:
            return {ArcJoint{from_left, to_left}, ArcJoint{from_right, to_right}};
        case GapState::turned:
            break;
    }
    return {ArcJoint{from_left, from_right}, ArcJoint{to_right, to_left}};
}

std::uint32_t entry(const DotGrid& grid, const ArcStep& step) {
    return step.anticlockwise ? step.arc : (step.arc + 1) % grid.sides();
}
std::uint32_t exit(const DotGrid& grid, const ArcStep& step) {
    return step.anticlockwise ? (step.arc + 1) % grid.sides() : step.arc;
}
std::uint32_t heading(const DotGrid& grid, const ArcStep& step) {
    // From one side's middle to the next the line runs at right angles to the way from the dot to the arc's middle.
    const std::uint32_t first = grid.lattice() == DotLattice::square ? 1 : 2;
    return (step.arc + first + (step.anticlockwise ? 0 : grid.sides() / 2)) % grid.sides();
}

ArcStep next_step(const DotGrid& grid, const GapStates& states, const ArcStep& step) {
    const std::uint32_t sides = grid.sides();
    const std::uint32_t side = exit(grid, step);
    const std::int32_t gap = grid.gap(step.dot, side);
    const GapState state = gap < 0 ? GapState::turned : states[static_cast<std::size_t>(gap)];
    if (state == GapState::turned) {
        return {step.dot, (step.arc + (step.anticlockwise ? 1 : sides - 1)) % sides, step.anticlockwise};
    }
    const GridGap& passed = grid.gaps()[static_cast<std::size_t>(gap)];
    const std::uint32_t other = passed.from == step.dot ? passed.to : passed.from;
    const std::uint32_t back = side + sides / 2;
    const bool anticlockwise = (state == GapState::crossed) != step.anticlockwise;
    return {other, (back + (anticlockwise ? 0 : sides - 1)) % sides, anticlockwise};
}

// --- lines --------------------------------------------------------------------------------------------------------

void label_lines(const DotGrid& grid, const GapStates& states, LineLabels& labels, const Monitor& monitor) {
    constexpr std::uint32_t unseen = UINT32_MAX;
    const std::uint32_t sides = grid.sides();
    labels.line.assign(sides * grid.dots().size(), unseen);
    labels.entry.resize(labels.line.size());
    labels.starts.clear();
    Pulse pulse(monitor);
    for (std::uint32_t i = 0; i < labels.line.size(); ++i) {
        if (labels.line[i] != unseen) continue;
        const ArcStep start{i / sides, i % sides, true};
        ArcStep step = start;
        std::uint32_t place = 0;
        do {
            pulse();
            const std::uint32_t arc = sides * step.dot + step.arc;
            labels.line[arc] = static_cast<std::uint32_t>(labels.starts.size());
            labels.entry[arc] = 2 * place++ + (step.anticlockwise ? 0 : 1);
            step = next_step(grid, states, step);
        } while (step != start);
        labels.starts.push_back(start);
    }
}

std::vector<ArcStep> line_starts(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    LineLabels labels;
    label_lines(grid, states, labels, monitor);
    return labels.starts;
}

std::size_t count_lines(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    return line_starts(grid, states, monitor).size();
}

// --- the second count ---------------------------------------------------------------------------------------------

namespace {

/// A graph as a list of edges.
struct EdgeList {
    std::size_t vertices = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
};

/// Numbers dots along the shorter side of the grid: neighbours then have numbers that differ little.
std::vector<std::uint32_t> dots_along_shorter_side(const DotGrid& grid) {
    std::vector<std::uint32_t> order(grid.dots().size());
    std::iota(order.begin(), order.end(), 0U);
    const std::vector<std::uint32_t> rows = grid.rows();
    if (rows.size() < *std::max_element(rows.begin(), rows.end())) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return grid.dots()[a].x < grid.dots()[b].x; });
    }
    return order;
}

/// The loops that remain when crossings turn back, as vertices, and the crossings as edges.
EdgeList crossing_graph(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    GapStates turned = states;
    std::replace(turned.begin(), turned.end(), GapState::crossed, GapState::turned);
    LineLabels loops;
    label_lines(grid, turned, loops, monitor);
    EdgeList graph{loops.starts.size(), {}};
    std::vector<std::uint32_t> number(graph.vertices, UINT32_MAX);
    std::uint32_t next = 0;
    for (const std::uint32_t dot : dots_along_shorter_side(grid)) {
        for (std::uint32_t arc = 0; arc < grid.sides(); ++arc) {
            std::uint32_t& numbered = number[loops.line[grid.sides() * dot + arc]];
            if (numbered == UINT32_MAX) numbered = next++;
        }
    }
    for (std::size_t i = 0; i < states.size(); ++i) {
        if (states[i] != GapState::crossed) continue;
        const auto [at_from, at_to] = joints(grid, grid.gaps()[i], GapState::turned);
        graph.edges.emplace_back(number[loops.line[at_from.first.arc]], number[loops.line[at_to.first.arc]]);
    }
    return graph;
}

}  // namespace

std::size_t laplacian_nullity(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    const EdgeList graph = crossing_graph(grid, states, monitor);
    const std::size_t count = graph.vertices;
    std::size_t width = 0;
    std::vector<std::vector<std::uint32_t>> neighbours(count);
    for (const auto& [a, b] : graph.edges) {
        if (a == b) continue;  // a loop adds nothing to the Laplacian
        width = std::max<std::size_t>(width, std::max(a, b) - std::min(a, b));
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    }
    // Gaussian elimination within the band: row i of the Laplacian, reduced or not, only has entries in the columns
    // i - width … i + width.
    struct Row {
        std::size_t first_word = 0;
        std::vector<std::uint64_t> words;
    };
    std::vector<Row> pivots(count);  // by their first column; freed when no later row can need them
    std::size_t rank = 0;
    for (std::size_t i = 0; i < count; ++i) {
        monitor.check();
        const std::size_t low = i - std::min(i, width);
        const std::size_t high = std::min(i + width, count - 1);
        Row row{low / 64, std::vector<std::uint64_t>(high / 64 - low / 64 + 1)};
        const auto flip = [&row](std::size_t column) {
            row.words[column / 64 - row.first_word] ^= std::uint64_t{1} << (column % 64);
        };
        for (const std::uint32_t neighbour : neighbours[i]) {
            flip(i);
            flip(neighbour);
        }
        for (std::size_t word = 0; word < row.words.size();) {
            if (row.words[word] == 0) {
                ++word;
                continue;
            }
            const std::size_t first = row.first_word + word;
            const std::size_t column = 64 * first + static_cast<std::size_t>(std::countr_zero(row.words[word]));
            Row& pivot = pivots[column];
            if (pivot.words.empty()) {
                pivot = std::move(row);
                ++rank;
                break;
            }
            const std::size_t skipped = first - pivot.first_word;
            for (std::size_t k = skipped; k < pivot.words.size(); ++k) {
                row.words[word + k - skipped] ^= pivot.words[k];
            }
        }
        if (i >= width) pivots[i - width] = Row();
    }
    return count - rank;
}

}  // namespace sikku
