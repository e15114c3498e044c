#include "art/kolam/dot_grid_symmetry.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/base/union_find.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// A rotation or a mirror about the origin, as a matrix of quarters.
struct Isometry {
    std::int64_t xx, xy, yx, yy;
    bool is_mirror;
    constexpr Isometry after(const Isometry& first) const {
        return {(xx * first.xx + xy * first.yx) / 4, (xx * first.xy + xy * first.yy) / 4,
                (yx * first.xx + yy * first.yx) / 4, (yx * first.xy + yy * first.yy) / 4,
                is_mirror != first.is_mirror};
    }
};
constexpr Isometry identity = {4, 0, 0, 4, false};
constexpr Isometry half_turn = {-4, 0, 0, -4, false};
constexpr Isometry quarter_turn = {0, -4, 4, 0, false};
// In half spacings and half distances of rows, a turn by 60 degrees takes (2, 0) to (1, 2) and (1, 2) to (-1, 2).
constexpr Isometry sixth_turn = {2, -3, 4, 2, false};
constexpr Isometry third_turn = sixth_turn.after(sixth_turn);
constexpr Isometry left_and_right = {-4, 0, 0, 4, true};
constexpr Isometry top_and_bottom = {4, 0, 0, -4, true};
constexpr Isometry across_diagonal = {0, 4, 4, 0, true};

struct Group {
    std::string_view name;
    int rotations;
    std::vector<Isometry> generators;
};

const Group& group_of(GridSymmetry symmetry) {
    static const std::array<Group, 14> groups = {{{"none", 1, {}},
                                                  {"C2", 2, {half_turn}},
                                                  {"C3", 3, {third_turn}},
                                                  {"C4", 4, {quarter_turn}},
                                                  {"C6", 6, {sixth_turn}},
                                                  {"mirror-x", 1, {left_and_right}},
                                                  {"mirror-y", 1, {top_and_bottom}},
                                                  {"diagonal", 1, {across_diagonal}},
                                                  {"mirrors", 2, {left_and_right, top_and_bottom}},
                                                  {"diagonals", 2, {across_diagonal, half_turn}},
                                                  {"D3", 3, {third_turn, left_and_right}},
                                                  {"D3-y", 3, {third_turn, top_and_bottom}},
                                                  {"D4", 4, {quarter_turn, left_and_right}},
                                                  {"D6", 6, {sixth_turn, left_and_right}}}};
    return groups[static_cast<std::size_t>(symmetry)];
}

/// True if the lattice itself has the symmetry.
bool is_of_lattice(DotLattice lattice, GridSymmetry symmetry) {
    switch (symmetry) {
        case GridSymmetry::c4:
        case GridSymmetry::d4:
        case GridSymmetry::diagonal:
        case GridSymmetry::diagonals:
            return lattice == DotLattice::square;
        case GridSymmetry::c3:
        case GridSymmetry::c6:
        case GridSymmetry::d3:
        case GridSymmetry::d3_y:
        case GridSymmetry::d6:
            return lattice == DotLattice::triangular;
        default:
            return true;
    }
}

/// Maps dots about their centroid, in whole numbers.
class DotMap {
public:
    explicit DotMap(const DotGrid& grid) : grid_(grid), count_(static_cast<std::int64_t>(grid.dots().size())) {
        for (const GridDot dot : grid.dots()) {
            sum_x_ += dot.x;
            sum_y_ += dot.y;
        }
    }
    /// The image of a place of the lattice, or nullopt if it lies between the places.
    std::optional<GridDot> place(GridDot dot, const Isometry& isometry) const {
        const std::int64_t x = count_ * dot.x - sum_x_;
        const std::int64_t y = count_ * dot.y - sum_y_;
        const std::int64_t to_x = isometry.xx * x + isometry.xy * y + 4 * sum_x_;
        const std::int64_t to_y = isometry.yx * x + isometry.yy * y + 4 * sum_y_;
        if (to_x % (4 * count_) != 0 || to_y % (4 * count_) != 0) return std::nullopt;
        return GridDot{static_cast<std::int32_t>(to_x / (4 * count_)),
                       static_cast<std::int32_t>(to_y / (4 * count_))};
    }
    std::optional<std::uint32_t> image(GridDot dot, const Isometry& isometry) const {
        const auto to = place(dot, isometry);
        return to ? grid_.dot_at(*to) : std::nullopt;
    }
    bool is_kept(const Isometry& isometry) const {
        return std::all_of(grid_.dots().begin(), grid_.dots().end(),
                           [&](GridDot dot) { return image(dot, isometry).has_value(); });
    }
    /// The image of each gap.
    std::vector<std::uint32_t> gaps(const Isometry& isometry) const {
        std::vector<std::uint32_t> images;
        images.reserve(grid_.gaps().size());
        for (const GridGap& gap : grid_.gaps()) {
            const std::uint32_t from = *image(grid_.dots()[gap.from], isometry);
            images.push_back(static_cast<std::uint32_t>(grid_.gap(from, side(gap.side, isometry))));
        }
        return images;
    }
    /// The image of an arc, numbered over all dots.
    std::uint32_t arc(std::uint32_t dot, std::uint32_t arc, const Isometry& isometry) const {
        const std::uint32_t sides = grid_.sides();
        const std::uint32_t first = isometry.is_mirror ? (arc + 1) % sides : arc;
        return sides * *image(grid_.dots()[dot], isometry) + side(first, isometry);
    }
    std::uint32_t side(std::uint32_t side, const Isometry& isometry) const {
        const GridDot way = grid_.step(side);
        const GridDot to{static_cast<std::int32_t>((isometry.xx * way.x + isometry.xy * way.y) / 4),
                         static_cast<std::int32_t>((isometry.yx * way.x + isometry.yy * way.y) / 4)};
        std::uint32_t found = 0;
        while (!(grid_.step(found) == to)) ++found;
        return found;
    }
    bool has_dot_at_centre() const {
        return std::any_of(grid_.dots().begin(), grid_.dots().end(), [this](GridDot dot) { return is_centre(dot); });
    }
    /// True if the centre lies in the middle of a gap.
    bool has_gap_at_centre() const {
        return std::any_of(grid_.gaps().begin(), grid_.gaps().end(), [this](const GridGap& gap) {
            const GridDot a = grid_.dots()[gap.from];
            const GridDot b = grid_.dots()[gap.to];
            return count_ * (a.x + b.x) == 2 * sum_x_ && count_ * (a.y + b.y) == 2 * sum_y_;
        });
    }
    /// The number of meetings of a mirror's axis with the lines in all states of gaps, and whether a gap lies along
    /// it.
    struct Axis {
        std::size_t dots = 0;
        std::size_t meetings = 0;
        bool has_gap = false;
    };
    Axis axis(const Isometry& mirror) const {
        const std::uint32_t sides = grid_.sides();
        Axis axis;
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            if (image(grid_.dots()[dot], mirror) != dot) continue;
            ++axis.dots;
            for (std::uint32_t s = 0; s < sides; ++s) {
                const std::uint32_t image = side(s, mirror);
                if (image == s && grid_.gap(dot, s) >= 0) axis.has_gap = true;
                axis.meetings += image == (s + 1) % sides || (image == s && grid_.gap(dot, s) < 0);
            }
        }
        return axis;
    }

private:
    bool is_centre(GridDot dot) const { return count_ * dot.x == sum_x_ && count_ * dot.y == sum_y_; }

    const DotGrid& grid_;
    std::int64_t count_;
    std::int64_t sum_x_ = 0;
    std::int64_t sum_y_ = 0;
};

/// The rotations and mirrors of the lattice, the identity first.
std::vector<Isometry> isometries(DotLattice lattice) {
    const Isometry turn = lattice == DotLattice::square ? quarter_turn : sixth_turn;
    std::vector<Isometry> all;
    for (const Isometry& first : {identity, left_and_right}) {
        Isometry at = first;
        for (int i = 0; i < (lattice == DotLattice::square ? 4 : 6); ++i, at = turn.after(at)) all.push_back(at);
    }
    return all;
}

/// The mirrors of a group.
std::vector<Isometry> mirrors_of(const Group& group) {
    std::vector<Isometry> elements = {identity};
    const auto is_same = [](const Isometry& a, const Isometry& b) {
        return a.xx == b.xx && a.xy == b.xy && a.yx == b.yx && a.yy == b.yy;
    };
    for (std::size_t i = 0; i < elements.size(); ++i) {
        for (const Isometry& generator : group.generators) {
            const Isometry product = generator.after(elements[i]);
            if (std::none_of(elements.begin(), elements.end(),
                             [&](const Isometry& known) { return is_same(known, product); })) {
                elements.push_back(product);
            }
        }
    }
    std::erase_if(elements, [](const Isometry& element) { return !element.is_mirror; });
    return elements;
}

constexpr std::array<GridSymmetry, 14> symmetry_list = {
    GridSymmetry::none,    GridSymmetry::c2,        GridSymmetry::c3,       GridSymmetry::c4,
    GridSymmetry::c6,      GridSymmetry::mirror_x,  GridSymmetry::mirror_y, GridSymmetry::diagonal,
    GridSymmetry::mirrors, GridSymmetry::diagonals, GridSymmetry::d3,       GridSymmetry::d3_y,
    GridSymmetry::d4,      GridSymmetry::d6};

std::string no_single_line(const DotGrid& grid, GridSymmetry symmetry, std::string_view reason) {
    const std::string whose = symmetry == GridSymmetry::none
                                  ? std::string()
                                  : fmt::format(" with the symmetry {}", grid_symmetry_name(symmetry));
    return fmt::format("no single line is possible on {}{}: {}", grid.name(), whose, reason);
}

}  // namespace

GridSymmetry parse_grid_symmetry(std::string_view text) {
    std::string word = lower_case(text);
    std::replace(word.begin(), word.end(), ' ', '-');
    if (word == "c1") word = "none";
    if (word == "d1") word = "mirror-x";
    if (word == "d2") word = "mirrors";
    for (const GridSymmetry symmetry : symmetry_list) {
        if (word == lower_case(grid_symmetry_name(symmetry))) return symmetry;
    }
    throw std::runtime_error(fmt::format(
        "'{}': expected none, C2 (half turn), C3, C4, C6 (third, quarter, sixth of a turn), mirror-x or D1 (left and "
        "right), mirror-y (top and bottom), diagonal, mirrors or D2 (mirror-x and mirror-y), diagonals, D3, D3-y, D4 "
        "or "
        "D6",
        printable(text, 80)));
}

int grid_symmetry_order(GridSymmetry symmetry) {
    const Group& group = group_of(symmetry);
    const bool has_mirrors = std::any_of(group.generators.begin(), group.generators.end(),
                                         [](const Isometry& isometry) { return isometry.is_mirror; });
    return group.rotations * (has_mirrors ? 2 : 1);
}

bool has_half_turn(GridSymmetry symmetry) {
    return group_of(symmetry).rotations % 2 == 0;
}

std::string_view grid_symmetry_name(GridSymmetry symmetry) {
    return group_of(symmetry).name;
}

std::span<const GridSymmetry> grid_symmetry_list() {
    return symmetry_list;
}

bool has_symmetry(const DotGrid& grid, GridSymmetry symmetry) {
    if (!is_of_lattice(grid.lattice(), symmetry)) return false;
    const DotMap map(grid);
    const auto& generators = group_of(symmetry).generators;
    return std::all_of(generators.begin(), generators.end(),
                       [&](const Isometry& isometry) { return map.is_kept(isometry); });
}

void require_symmetry(const DotGrid& grid, GridSymmetry symmetry) {
    if (has_symmetry(grid, symmetry)) return;
    std::string reason;
    if (!is_of_lattice(grid.lattice(), symmetry)) {
        reason = grid.lattice() == DotLattice::square ? "; straight grids have C2, C4, mirrors and D4"
                                                      : "; interlaced grids have C2, C3, C6, mirrors, D3 and D6";
    }
    throw std::runtime_error(
        fmt::format("{} itself does not have the symmetry {}{}", grid.name(), grid_symmetry_name(symmetry), reason));
}

std::vector<std::vector<std::uint32_t>> grid_symmetries(const DotGrid& grid) {
    const DotMap map(grid);
    std::vector<std::vector<std::uint32_t>> found;
    for (const Isometry& isometry : isometries(grid.lattice())) {
        if (map.is_kept(isometry)) found.push_back(map.gaps(isometry));
    }
    return found;
}

std::vector<std::vector<std::uint32_t>> arc_symmetries(const DotGrid& grid) {
    const DotMap map(grid);
    std::vector<std::vector<std::uint32_t>> found;
    for (const Isometry& isometry : isometries(grid.lattice())) {
        if (!map.is_kept(isometry)) continue;
        std::vector<std::uint32_t>& images = found.emplace_back();
        images.reserve(grid.sides() * grid.dots().size());
        for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
            for (std::uint32_t arc = 0; arc < grid.sides(); ++arc) images.push_back(map.arc(dot, arc, isometry));
        }
    }
    return found;
}

std::vector<std::uint32_t> gap_orbits(const DotGrid& grid, GridSymmetry symmetry, std::uint32_t period) {
    require_symmetry(grid, symmetry);
    const DotMap map(grid);
    UnionFind sets(grid.gaps().size());
    for (const Isometry& isometry : group_of(symmetry).generators) {
        const std::vector<std::uint32_t> images = map.gaps(isometry);
        for (std::uint32_t i = 0; i < images.size(); ++i) sets.join(i, images[i]);
    }
    for (std::uint32_t i = 0; i < grid.gaps().size() && period > 0; ++i) {
        const GridGap& gap = grid.gaps()[i];
        const auto next = grid.dot_at(grid.dots()[gap.from] + GridDot{2 * static_cast<std::int32_t>(period), 0});
        const std::int32_t image = next ? grid.gap(*next, gap.side) : -1;
        if (image >= 0) sets.join(i, static_cast<std::uint32_t>(image));
    }
    return sets.set_numbers();
}

std::vector<std::uint32_t> dot_orbits(const DotGrid& grid, GridSymmetry symmetry) {
    require_symmetry(grid, symmetry);
    const DotMap map(grid);
    UnionFind sets(grid.dots().size());
    for (const Isometry& isometry : group_of(symmetry).generators) {
        for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
            sets.join(dot, *map.image(grid.dots()[dot], isometry));
        }
    }
    return sets.set_numbers();
}

std::vector<GridDot> place_images(const DotGrid& grid, GridDot place, GridSymmetry symmetry) {
    require_symmetry(grid, symmetry);
    const DotMap map(grid);
    std::vector<GridDot> images = {place};
    for (std::size_t i = 0; i < images.size(); ++i) {
        for (const Isometry& isometry : group_of(symmetry).generators) {
            const auto to = map.place(images[i], isometry);
            if (to && std::find(images.begin(), images.end(), *to) == images.end()) images.push_back(*to);
        }
    }
    return images;
}

bool is_symmetric(const DotGrid& grid, const GapStates& states, GridSymmetry symmetry) {
    if (!has_symmetry(grid, symmetry)) return false;
    const DotMap map(grid);
    for (const Isometry& isometry : group_of(symmetry).generators) {
        const std::vector<std::uint32_t> images = map.gaps(isometry);
        for (std::size_t i = 0; i < images.size(); ++i) {
            if (states[i] != states[images[i]]) return false;
        }
    }
    return true;
}

GapStates canonical_states(const DotGrid& grid, const GapStates& states) {
    GapStates least = states;
    for (const auto& images : grid_symmetries(grid)) {
        GapStates image(states.size());
        for (std::size_t i = 0; i < images.size(); ++i) image[images[i]] = states[i];
        least = std::min(least, image);
    }
    return least;
}

std::vector<std::uint32_t> line_orbits(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    LineLabels labels;
    label_lines(grid, states, labels, monitor);
    const DotMap map(grid);
    UnionFind classes(labels.starts.size());
    for (const Isometry& isometry : isometries(grid.lattice())) {
        if (!map.is_kept(isometry)) continue;
        const std::vector<std::uint32_t> images = map.gaps(isometry);
        bool is_kept = true;
        for (std::size_t i = 0; i < images.size() && is_kept; ++i) is_kept = states[i] == states[images[i]];
        if (!is_kept) continue;
        for (std::uint32_t line = 0; line < labels.starts.size(); ++line) {
            const ArcStep& start = labels.starts[line];
            classes.join(line, labels.line[map.arc(start.dot, start.arc, isometry)]);
        }
    }
    return classes.set_numbers();
}

std::string kolam_code(const DotGrid& grid, const GapStates& states) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto add = [&hash](char byte) { hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U; };
    for (const char byte : grid.text()) add(byte);
    for (const GapState state : canonical_states(grid, states)) add(static_cast<char>(state));
    constexpr std::string_view letters = "0123456789abcdefghjkmnpqrstvwxyz";  // Crockford's
    std::string code;
    for (int i = 0; i < 8; ++i, hash >>= 5U) code += letters[hash & 31U];
    return code;
}

std::optional<std::string> single_line_obstacle(const DotGrid& grid, GridSymmetry symmetry, bool joined) {
    if (const std::size_t groups = grid.groups(); groups > 1) {
        return no_single_line(grid, symmetry,
                              fmt::format("its dots fall into {} groups that no gap connects", groups));
    }
    return symmetry_obstacle(grid, symmetry, joined);
}

std::optional<std::string> symmetry_obstacle(const DotGrid& grid, GridSymmetry symmetry, bool joined) {
    const auto because = [&](std::string_view reason) { return no_single_line(grid, symmetry, reason); };
    if (symmetry == GridSymmetry::none) return std::nullopt;
    const Group& group = group_of(symmetry);
    const DotMap map(grid);
    if (group.rotations > 2 && group.rotations % 2 == 0 && !map.has_dot_at_centre()) {
        return because(
            fmt::format("a line that {} maps onto itself has a dot in its middle, so the grid needs a dot "
                        "there, as in {}",
                        group.rotations == 4 ? "a quarter turn" : "a sixth of a turn",
                        group.rotations == 4 ? "7x7" : "7-4 idukku"));
    }
    if (group.rotations == 2 && !map.has_dot_at_centre() && !map.has_gap_at_centre()) {
        return because(
            "a line that a half turn maps onto itself has a dot or a crossing in its middle, so the grid needs "
            "a dot or a gap there, as in 7x7 and 6x7");
    }
    for (const Isometry& mirror : mirrors_of(group)) {
        const DotMap::Axis axis = map.axis(mirror);
        if (axis.meetings > 2) {
            const int rotations = group.rotations;
            return because(fmt::format(
                "a line meets each axis of its symmetry twice, but here it would meet one {} times, at its {}{}",
                axis.meetings, counted(axis.dots, "dot"),
                rotations == 4   ? "; C4 is the most a single line can have"
                : rotations == 6 ? "; C6 is the most a single line can have"
                : rotations == 3 ? "; C3 is possible, or D3 with other axes"
                                 : ""));
        }
        if (axis.meetings == 0 && group.rotations > 2 && !axis.has_gap && !joined) {
            return because("a line meets each axis of such a symmetry twice, but here an axis has no dots");
        }
    }
    return std::nullopt;
}

}  // namespace sikku
