#include "art/kolam/dot_grid_making.h"

#include "art/kolam/interlaced_states.h"
#include "engine/base/chance.h"
#include "engine/base/union_find.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

std::vector<std::uint32_t> shuffled(std::size_t count, SplitMix& chance) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[chance.below(i)]);
    return order;
}

/// The state that joins two lines which meet in a gap of this state.
GapState changed(GapState state) {
    return state == GapState::crossed ? GapState::turned : GapState::crossed;
}

/// One arc of each of the two strands in a gap.
std::pair<std::uint32_t, std::uint32_t> strands(const DotGrid& grid, std::uint32_t gap, const GapStates& states) {
    const auto [first, second] = joints(grid, grid.gaps()[gap], states[gap]);
    return {first.first.arc, second.first.arc};
}

constexpr std::size_t most_images = 12;  // images of a gap in the largest group

/// The number of lines gained if all those gaps, at most 12, change together. Examines only the ends of arcs that
/// meet in them: along each line entries and exits alternate, and between an entry and the next exit the line does
/// not change.
int lines_gained(const DotGrid& grid, const GapStates& states, const LineLabels& labels,
                 const std::vector<std::uint32_t>& gaps) {
    struct End {
        std::uint32_t line;
        std::uint32_t place;  // on its line; odd for exits
        std::uint32_t joint;  // ends with the same number will meet
    };
    std::array<End, 4 * most_images> ends;
    std::uint32_t count = 0;
    std::uint32_t joint_count = 0;
    const auto add = [&](const ArcEnd& end) {
        const std::uint32_t entry = labels.entry[end.arc];
        ends[count++] = {labels.line[end.arc], (entry & ~1U) + ((entry & 1U) ^ end.end), joint_count};
    };
    for (const std::uint32_t i : gaps) {
        for (const ArcJoint& joint : joints(grid, grid.gaps()[i], changed(states[i]))) {
            add(joint.first);
            add(joint.second);
            ++joint_count;
        }
    }
    std::sort(ends.begin(), ends.begin() + count,
              [](const End& a, const End& b) { return std::pair(a.line, a.place) < std::pair(b.line, b.place); });
    std::array<std::uint32_t, 2 * most_images> met{};  // the sum of the two ends of each joint
    for (std::uint32_t i = 0; i < count; ++i) met[ends[i].joint] += i;
    std::array<std::uint32_t, 4 * most_images> other;  // the end where the stretch of line from this one ends
    int lines = 0;
    for (std::uint32_t begin = 0; begin < count;) {
        std::uint32_t end = begin;
        while (end < count && ends[end].line == ends[begin].line) ++end;
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t size = end - begin;
            other[i] = begin + (i - begin + (ends[i].place % 2 == 0 ? 1 : size - 1)) % size;
        }
        --lines;
        begin = end;
    }
    std::array<bool, 4 * most_images> seen{};
    for (std::uint32_t i = 0; i < count; ++i) {
        if (seen[i]) continue;
        ++lines;
        for (std::uint32_t at = i; !seen[at];) {
            seen[at] = true;
            at = other[at];
            seen[at] = true;
            at = met[ends[at].joint] - at;
        }
    }
    return lines;
}

std::vector<std::vector<std::uint32_t>> members_of(const std::vector<std::uint32_t>& orbits) {
    std::vector<std::vector<std::uint32_t>> members;
    for (std::uint32_t i = 0; i < orbits.size(); ++i) {
        if (orbits[i] == members.size()) members.emplace_back();
        members[orbits[i]].push_back(i);
    }
    return members;
}

/// Changes each orbit of gaps whose gaps, one after the other, all join different lines: that removes as many lines
/// as the orbit has gaps, and does not require following lines again.
void join_orbits(const DotGrid& grid, const std::vector<std::vector<std::uint32_t>>& orbits, SplitMix& chance,
                 GapStates& states, LineLabels& labels, const Monitor& monitor) {
    label_lines(grid, states, labels, monitor);
    UnionFind lines(labels.starts.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
    Pulse pulse(monitor);
    for (const std::uint32_t orbit : shuffled(orbits.size(), chance)) {
        pulse();
        joined.clear();
        const auto line = [&](std::uint32_t arc) {
            std::uint32_t found = lines.find(labels.line[arc]);
            for (const auto& [from, to] : joined) found = found == from ? to : found;
            return found;
        };
        const bool all_join = std::all_of(orbits[orbit].begin(), orbits[orbit].end(), [&](std::uint32_t i) {
            const auto [first, second] = strands(grid, i, states);
            joined.emplace_back(line(first), line(second));
            return joined.back().first != joined.back().second;
        });
        if (!all_join) continue;
        for (const auto& [from, to] : joined) lines.join(from, to);
        for (const std::uint32_t i : orbits[orbit]) states[i] = changed(states[i]);
    }
}

/// Changes orbits of gaps one at a time to reduce the number of lines.
class OrbitJoiner {
public:
    /// @param labels  of these states
    /// @param steps  remaining number of steps along lines; steps made are subtracted
    OrbitJoiner(const DotGrid& grid, const std::vector<std::vector<std::uint32_t>>& orbits, SplitMix& chance,
                GapStates& states, LineLabels& labels, std::uint64_t& steps, const Monitor& monitor)
        : grid_(grid),
          orbits_(orbits),
          chance_(chance),
          states_(states),
          labels_(labels),
          steps_(steps),
          monitor_(monitor),
          pulse_(monitor) {}

    /// Changes orbits as long as that reduces the number of lines.
    void improve() {
        for (bool improved = true; improved && is_open();) {
            improved = false;
            for (const std::uint32_t orbit : shuffled(orbits_.size(), chance_)) {
                pulse_();
                if (steps_ == 0 || lines_gained(grid_, states_, labels_, orbits_[orbit]) >= 0) continue;
                change(orbit);
                improved = true;
            }
        }
    }
    /// Changes a random orbit and improves, that many times, unless it leads to more lines: where there are few lines
    /// and long ones, as in frames, no single orbit may reduce their number.
    void try_others(int count) {
        for (int i = 0; i < count && is_open(); ++i) {
            const GapStates before = states_;
            const std::size_t lines = labels_.starts.size();
            change(static_cast<std::uint32_t>(chance_.below(orbits_.size())));
            improve();
            if (labels_.starts.size() <= lines) continue;
            states_ = before;
            label_lines(grid_, states_, labels_, monitor_);
        }
    }

private:
    bool is_open() const { return steps_ > 0 && labels_.starts.size() > 1; }
    void change(std::uint32_t orbit) {
        for (const std::uint32_t i : orbits_[orbit]) states_[i] = changed(states_[i]);
        label_lines(grid_, states_, labels_, monitor_);
        steps_ -= std::min<std::uint64_t>(steps_, labels_.line.size());
    }

    const DotGrid& grid_;
    const std::vector<std::vector<std::uint32_t>>& orbits_;
    SplitMix& chance_;
    GapStates& states_;
    LineLabels& labels_;
    std::uint64_t& steps_;
    const Monitor& monitor_;
    Pulse pulse_;
};

/// Crosses the orbits of gaps that connect pieces of the drawing, in random order.
void connect(const DotGrid& grid, const std::vector<std::uint32_t>& orbits, SplitMix& chance, GapStates& states) {
    UnionFind pieces(grid.dots().size());
    const auto connects = [&](std::uint32_t i) {
        return pieces.find(grid.gaps()[i].from) != pieces.find(grid.gaps()[i].to);
    };
    const auto join = [&](std::uint32_t i) { pieces.join(grid.gaps()[i].from, grid.gaps()[i].to); };
    for (std::uint32_t i = 0; i < states.size(); ++i) {
        if (states[i] != GapState::turned) join(i);
    }
    const std::vector<std::vector<std::uint32_t>> members = members_of(orbits);
    for (const std::uint32_t orbit : shuffled(members.size(), chance)) {
        if (std::none_of(members[orbit].begin(), members[orbit].end(), connects)) continue;
        for (const std::uint32_t i : members[orbit]) {
            states[i] = GapState::crossed;
            join(i);
        }
    }
}

/// Crosses all gaps of the orbits that have a crossed one: where triangles are cut off at the ends of rows, their
/// gaps are not.
void repeat_crossings(const std::vector<std::uint32_t>& orbits, GapStates& states) {
    std::vector<char> is_crossed(orbits.size());
    for (std::size_t i = 0; i < orbits.size(); ++i) {
        if (states[i] == GapState::crossed) is_crossed[orbits[i]] = 1;
    }
    for (std::size_t i = 0; i < orbits.size(); ++i) {
        if (is_crossed[orbits[i]] != 0) states[i] = GapState::crossed;
    }
}

bool ends_row(const DotGrid& grid, std::uint32_t dot) {
    return grid.gap(dot, 0) < 0 || grid.gap(dot, grid.sides() / 2) < 0;
}

/// The number of lines that pass no dot at the end of a row.
std::size_t count_inner_lines(const DotGrid& grid, const LineLabels& labels) {
    std::vector<char> reaches(labels.starts.size());
    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
        if (!ends_row(grid, dot)) continue;
        for (std::uint32_t arc = 0; arc < grid.sides(); ++arc) reaches[labels.line[grid.sides() * dot + arc]] = 1;
    }
    return static_cast<std::size_t>(std::count(reaches.begin(), reaches.end(), 0));
}

/// Changes orbits of gaps as long as that lets more lines reach the ends of rows. Returns true if all do.
bool reach_ends(const DotGrid& grid, const std::vector<std::vector<std::uint32_t>>& orbits, SplitMix& chance,
                GapStates& states, std::uint64_t& steps, const Monitor& monitor) {
    LineLabels labels;
    const auto change = [&](const std::vector<std::uint32_t>& gaps) {
        for (const std::uint32_t i : gaps) states[i] = changed(states[i]);
        label_lines(grid, states, labels, monitor);
        steps -= std::min<std::uint64_t>(steps, labels.line.size());
        return count_inner_lines(grid, labels);
    };
    std::size_t inner = change({});
    for (bool is_better = true; is_better && inner > 0;) {
        is_better = false;
        for (const std::uint32_t orbit : shuffled(orbits.size(), chance)) {
            if (inner == 0 || steps == 0) break;
            const std::size_t left = change(orbits[orbit]);
            if (left >= inner) {
                change(orbits[orbit]);
                continue;
            }
            inner = left;
            is_better = true;
        }
    }
    return inner == 0;
}

/// The orbits of gaps at dots that end rows.
std::vector<std::vector<std::uint32_t>> end_orbits(const DotGrid& grid, GridSymmetry symmetry) {
    std::vector<std::vector<std::uint32_t>> members = members_of(gap_orbits(grid, symmetry));
    const auto is_end = [&](std::uint32_t i) {
        return ends_row(grid, grid.gaps()[i].from) || ends_row(grid, grid.gaps()[i].to);
    };
    std::erase_if(members, [&](const auto& orbit) { return std::none_of(orbit.begin(), orbit.end(), is_end); });
    return members;
}

}  // namespace

GapStates random_states(const DotGrid& grid, const RandomKolam& kolam) {
    for (const double share : {kolam.density, kolam.joined}) {
        if (!(share >= 0 && share <= 1)) {
            throw std::runtime_error("the shares of crossed and joined gaps must be between 0 and 1");
        }
    }
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, kolam.symmetry, kolam.period);
    const bool is_interlaced =
        kolam.composed && grid.lattice() == DotLattice::triangular && grid.dots().size() <= most_composed_dots;
    GapStates states =
        is_interlaced ? interlaced_states(grid, kolam.symmetry, kolam.seed, kolam.period) : GapStates(orbits.size());
    if (is_interlaced && kolam.period > 0) repeat_crossings(orbits, states);
    SplitMix chance(kolam.seed);
    std::vector<GapState> drawn;
    for (std::size_t i = 0; i < orbits.size(); ++i) {
        if (orbits[i] == drawn.size()) {
            const bool is_crossed =
                is_interlaced ? states[i] == GapState::crossed : chance.fraction() < kolam.density;
            const bool is_joined = !is_crossed && kolam.joined > 0 && chance.fraction() < kolam.joined;
            drawn.push_back(is_crossed ? GapState::crossed : is_joined ? GapState::joined : GapState::turned);
        }
        states[i] = drawn[orbits[i]];
    }
    if (kolam.composed && !is_interlaced) connect(grid, orbits, chance, states);
    return states;
}

std::vector<GridSymmetry> usual_symmetries(const DotGrid& grid, bool single_line) {
    std::vector<GridSymmetry> found;
    const bool is_possible = !single_line || grid.groups() == 1;
    for (const GridSymmetry symmetry :
         {GridSymmetry::d6, GridSymmetry::d4, GridSymmetry::c6, GridSymmetry::d3, GridSymmetry::d3_y,
          GridSymmetry::c4, GridSymmetry::mirrors, GridSymmetry::diagonals, GridSymmetry::c3, GridSymmetry::c2,
          GridSymmetry::mirror_x, GridSymmetry::mirror_y, GridSymmetry::diagonal}) {
        if (!is_possible || !has_symmetry(grid, symmetry)) continue;
        if (!single_line || !symmetry_obstacle(grid, symmetry)) found.push_back(symmetry);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](GridSymmetry a, GridSymmetry b) { return grid_symmetry_order(a) > grid_symmetry_order(b); });
    found.push_back(GridSymmetry::none);
    return found;
}

std::size_t make_single_line(const DotGrid& grid, GapStates& states, std::uint64_t seed, const Monitor& monitor) {
    LineLabels labels;
    label_lines(grid, states, labels, monitor);
    UnionFind lines(labels.starts.size());
    SplitMix chance(seed);
    std::size_t count = 0;
    // One pass is enough: afterwards the two lines of every gap are one, and the gaps connect all dots.
    Pulse pulse(monitor);
    for (const std::uint32_t i : shuffled(states.size(), chance)) {
        pulse();
        const auto [first, second] = strands(grid, i, states);
        if (lines.find(labels.line[first]) == lines.find(labels.line[second])) continue;
        lines.join(labels.line[first], labels.line[second]);
        states[i] = changed(states[i]);
        ++count;
    }
    return count;
}

std::optional<SingleLine> find_single_line(const DotGrid& grid, const RandomKolam& kolam, int attempts,
                                           const Monitor& monitor, std::uint64_t* steps_left) {
    if (grid.groups() > 1) return std::nullopt;
    if (kolam.symmetry == GridSymmetry::none && kolam.period == 0) {
        SingleLine found{random_states(grid, kolam), 0, 1};
        found.changed = make_single_line(grid, found.states, kolam.seed, monitor);
        return found;
    }
    std::uint64_t own_steps = 3'000'000'000;
    std::uint64_t& steps = steps_left ? *steps_left : own_steps;
    if (steps == 0) return std::nullopt;
    const std::vector<std::vector<std::uint32_t>> repeated =
        members_of(gap_orbits(grid, kolam.symmetry, kolam.period));
    const std::vector<std::vector<std::uint32_t>> members =
        kolam.period > 0 ? end_orbits(grid, kolam.symmetry) : repeated;
    const bool tries_others = is_framed(grid) && kolam.period == 0;
    LineLabels labels;
    RandomKolam attempted = kolam;
    SplitMix seeds(kolam.seed);
    for (int attempt = 1; attempt <= attempts && steps > 0; ++attempt, attempted.seed = seeds.next()) {
        monitor.check();
        // Compositions take long; where they do not help, independent gaps may.
        attempted.composed = kolam.composed && (grid.lattice() == DotLattice::square || attempt <= 20);
        const GapStates begun = random_states(grid, attempted);
        SingleLine found{begun, 0, attempt};
        SplitMix chance(attempted.seed);
        if (kolam.period > 0 && !reach_ends(grid, repeated, chance, found.states, steps, monitor)) continue;
        join_orbits(grid, members, chance, found.states, labels, monitor);
        label_lines(grid, found.states, labels, monitor);
        OrbitJoiner joiner(grid, members, chance, found.states, labels, steps, monitor);
        joiner.improve();
        if (attempted.composed && tries_others) joiner.try_others(20);
        if (labels.starts.size() == 1) {
            for (std::size_t i = 0; i < begun.size(); ++i) found.changed += begun[i] != found.states[i];
            return found;
        }
        // Every gap was examined several times.
        steps -= std::min<std::uint64_t>(steps, 16 * labels.line.size());
    }
    return std::nullopt;
}

}  // namespace sikku
