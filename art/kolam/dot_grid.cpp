#include "art/kolam/dot_grid.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

// --- chance -------------------------------------------------------------------------------------------------------

/// Steele, Lea & Flood 2014 (SplitMix64).
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    /// In [0, 1).
    double fraction() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    /// 0 … bound - 1; the bias is below bound / 2^64.
    std::size_t below(std::size_t bound) { return static_cast<std::size_t>(next() % bound); }

private:
    std::uint64_t state_;
};

std::vector<std::uint32_t> shuffled(std::size_t count, SplitMix& chance) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[chance.below(i)]);
    return order;
}

// --- grids --------------------------------------------------------------------------------------------------------

[[noreturn]] void refuse_grid(std::string_view text) {
    throw std::runtime_error(fmt::format(
        "'{}': expected ROWSxCOLUMNS such as 7x7, or the dots of each row such as 1-3-5-3-1, every number 1 or more",
        printable(text, 80)));
}

[[noreturn]] void refuse_size() {
    throw std::runtime_error(
        fmt::format("a grid of more than {} dots is not made: it and its lines would take more than {} MB of memory",
                    DotGrid::most_dots, DotGrid::most_dots * 100 / 1'000'000));
}

std::vector<std::uint32_t> numbers(std::string_view text, char separator) {
    std::vector<std::uint32_t> found;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        std::uint32_t number = 0;
        const auto [rest, error] = std::from_chars(text.data() + at, text.data() + end, number);
        if (error == std::errc::result_out_of_range) refuse_size();
        if (error != std::errc() || rest != text.data() + end || number == 0) refuse_grid(text);
        found.push_back(number);
        at = end + 1;
    }
    return found;
}

/// An element of D4 as a matrix.
struct Isometry {
    int xx, xy, yx, yy;
    GridDot operator()(GridDot dot) const { return {xx * dot.x + xy * dot.y, yx * dot.x + yy * dot.y}; }
};
constexpr std::array<Isometry, 8> isometries = {{{1, 0, 0, 1},
                                                 {-1, 0, 0, -1},
                                                 {0, -1, 1, 0},
                                                 {0, 1, -1, 0},
                                                 {-1, 0, 0, 1},
                                                 {1, 0, 0, -1},
                                                 {0, 1, 1, 0},
                                                 {0, -1, -1, 0}}};
constexpr Isometry half_turn = isometries[1];
constexpr Isometry quarter_turn = isometries[2];
constexpr Isometry left_and_right = isometries[4];
constexpr Isometry top_and_bottom = isometries[5];

std::vector<Isometry> generators(GridSymmetry symmetry) {
    switch (symmetry) {
        case GridSymmetry::none:
            return {};
        case GridSymmetry::c2:
            return {half_turn};
        case GridSymmetry::c4:
            return {quarter_turn};
        case GridSymmetry::mirror_x:
            return {left_and_right};
        case GridSymmetry::mirror_y:
            return {top_and_bottom};
        case GridSymmetry::mirrors:
            return {left_and_right, top_and_bottom};
        case GridSymmetry::d4:
            return {quarter_turn, left_and_right};
    }
    return {};
}

bool keeps(const DotGrid& grid, const Isometry& isometry) {
    return std::all_of(grid.dots().begin(), grid.dots().end(),
                       [&](GridDot dot) { return grid.dot_at(isometry(dot)).has_value(); });
}

std::vector<std::uint32_t> moved_gaps(const DotGrid& grid, const Isometry& isometry) {
    std::vector<std::uint32_t> images;
    images.reserve(grid.gaps().size());
    for (const GridGap& gap : grid.gaps()) {
        const GridDot from = isometry(grid.dots()[gap.from]);
        const GridDot to = isometry(grid.dots()[gap.to]);
        const std::uint32_t side = to.x > from.x   ? right_side
                                   : to.x < from.x ? left_side
                                   : to.y > from.y ? upper_side
                                                   : lower_side;
        images.push_back(static_cast<std::uint32_t>(grid.gap(*grid.dot_at(from), side)));
    }
    return images;
}

/// Sets with the smallest member as their name.
class UnionFind {
public:
    explicit UnionFind(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0U); }
    std::uint32_t find(std::uint32_t a) {
        while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
        return a;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> parent_;
};

constexpr std::uint32_t arc_index(std::uint32_t dot, std::uint32_t arc) {
    return 4 * dot + arc % 4;
}

/// One arc of each of the two lines that pass a gap.
std::pair<std::uint32_t, std::uint32_t> passing(const GridGap& gap, bool crossing) {
    const std::uint32_t first = arc_index(gap.from, gap.side);
    return {first, crossing ? arc_index(gap.from, gap.side + 3) : arc_index(gap.to, gap.side + 2)};
}

/// Which line each arc belongs to, and where on it its ends are.
struct LineLabels {
    std::vector<std::uint32_t> line;   // by arc
    std::vector<std::uint32_t> entry;  // by arc: twice its place on the line, and 1 if the line enters it at its end
    std::vector<ArcStep> starts;       // by line
};

void label_lines(const DotGrid& grid, const Crossings& crossings, LineLabels& labels, const Monitor& monitor) {
    constexpr std::uint32_t unseen = UINT32_MAX;
    labels.line.assign(4 * grid.dots().size(), unseen);
    labels.entry.resize(labels.line.size());
    labels.starts.clear();
    Pulse pulse(monitor);
    for (std::uint32_t i = 0; i < labels.line.size(); ++i) {
        if (labels.line[i] != unseen) continue;
        const ArcStep start{i / 4, i % 4, true};
        ArcStep step = start;
        std::uint32_t place = 0;
        do {
            pulse();
            const std::uint32_t arc = arc_index(step.dot, step.arc);
            labels.line[arc] = static_cast<std::uint32_t>(labels.starts.size());
            labels.entry[arc] = 2 * place++ + (step.anticlockwise ? 0 : 1);
            step = next_step(grid, crossings, step);
        } while (step != start);
        labels.starts.push_back(start);
    }
}

/// By how many the lines become more if all those gaps, at most 8, change together. Only the ends of arcs that meet
/// in them are looked at: on each line they follow each other as entries and exits, and between an entry and the
/// next exit the line stays as it is.
int lines_gained(const DotGrid& grid, const Crossings& crossings, const LineLabels& labels,
                 const std::vector<std::uint32_t>& gaps) {
    struct End {
        std::uint32_t line;
        std::uint32_t place;  // on its line: exits are odd
        std::uint32_t joint;  // ends with the same number will meet
    };
    std::array<End, 32> ends;
    std::uint32_t count = 0;
    const auto add = [&](std::uint32_t arc, std::uint32_t end, std::uint32_t joint) {
        const std::uint32_t entry = labels.entry[arc];
        ends[count++] = {labels.line[arc], (entry & ~1U) + ((entry & 1U) ^ end), joint};
    };
    std::uint32_t joints = 0;
    for (const std::uint32_t i : gaps) {
        const auto& [from, to, side] = grid.gaps()[i];
        const bool will_cross = !crossings[i];
        add(arc_index(from, side), 0, joints);
        add(arc_index(from, side + 3), 1, will_cross ? joints + 1 : joints);
        add(arc_index(to, side + 2), 0, will_cross ? joints : joints + 1);
        add(arc_index(to, side + 1), 1, joints + 1);
        joints += 2;
    }
    std::sort(ends.begin(), ends.begin() + count,
              [](const End& a, const End& b) { return std::pair(a.line, a.place) < std::pair(b.line, b.place); });
    std::array<std::uint32_t, 32> other;  // the end that is met where the stretch of line from this one ends
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
    std::array<bool, 32> seen{};
    for (std::uint32_t i = 0; i < count; ++i) {
        if (seen[i]) continue;
        ++lines;
        for (std::uint32_t at = i; !seen[at];) {
            seen[at] = true;
            at = other[at];
            seen[at] = true;
            std::uint32_t met = 0;
            while (met == at || ends[met].joint != ends[at].joint) ++met;
            at = met;
        }
    }
    return lines;
}

}  // namespace

// --- grids --------------------------------------------------------------------------------------------------------

DotGrid::DotGrid(std::vector<std::uint32_t> rows) : rows_(std::move(rows)) {
    if (rows_.empty()) throw std::runtime_error("a grid of dots needs a row");
    std::uint64_t count = 0;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (rows_[r] == 0) throw std::runtime_error(fmt::format("row {} of the grid has no dots", r + 1));
        if (rows_[r] % 2 != rows_[0] % 2) {
            throw std::runtime_error(fmt::format(
                "row {} of the grid has {} dots and the first row {}: only if all numbers are odd, or all "
                "even, do the dots of centred rows stand above each other",
                r + 1, rows_[r], rows_[0]));
        }
        count += rows_[r];
        if (count > most_dots) refuse_size();
    }
    dots_.reserve(count);
    gap_at_.assign(count, {-1, -1, -1, -1});
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        row_begin_.push_back(static_cast<std::uint32_t>(dots_.size()));
        const auto length = static_cast<std::int32_t>(rows_[r]);
        const auto y = static_cast<std::int32_t>(rows_.size()) - 1 - 2 * static_cast<std::int32_t>(r);
        for (std::int32_t i = 0; i < length; ++i) dots_.push_back({2 * i - (length - 1), y});
    }
    gaps_.reserve(2 * count);
    const auto add = [this](std::uint32_t from, std::uint32_t to, GridSide side) {
        gap_at_[from][side] = gap_at_[to][(side + 2) % 4] = static_cast<std::int32_t>(gaps_.size());
        gaps_.push_back({from, to, side});
    };
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        const std::uint32_t begin = row_begin_[r];
        const std::uint32_t end = begin + rows_[r];
        for (std::uint32_t dot = begin; dot + 1 < end; ++dot) add(dot, dot + 1, right_side);
        for (std::uint32_t dot = begin; dot < end; ++dot) {
            if (const auto below = dot_at({dots_[dot].x, dots_[dot].y - 2})) add(dot, *below, lower_side);
        }
    }
}

std::optional<std::uint32_t> DotGrid::dot_at(GridDot place) const {
    const std::int32_t row = static_cast<std::int32_t>(rows_.size()) - 1 - place.y;
    if (row < 0 || row % 2 != 0 || row / 2 >= static_cast<std::int32_t>(rows_.size())) return std::nullopt;
    const auto r = static_cast<std::size_t>(row / 2);
    const auto length = static_cast<std::int32_t>(rows_[r]);
    const std::int32_t column = place.x + length - 1;
    if (column < 0 || column % 2 != 0 || column / 2 >= length) return std::nullopt;
    return row_begin_[r] + static_cast<std::uint32_t>(column / 2);
}

std::string DotGrid::text() const {
    if (std::all_of(rows_.begin(), rows_.end(), [this](std::uint32_t row) { return row == rows_[0]; })) {
        return fmt::format("{}x{}", rows_.size(), rows_[0]);
    }
    return fmt::format("{}", fmt::join(rows_, "-"));
}

DotGrid parse_dot_grid(std::string_view given) {
    std::string text(given);
    constexpr std::string_view times = "×";
    if (const std::size_t at = text.find(times); at != std::string::npos) {
        text.erase(at, times.size() - 1);
        text[at] = 'x';
    }
    const auto is_x = [](char byte) { return byte == 'x' || byte == 'X'; };
    const auto x = std::find_if(text.begin(), text.end(), is_x);
    if (x == text.end()) return DotGrid(numbers(text, '-'));
    const std::vector<std::uint32_t> sides = numbers(text, *x);
    if (sides.size() != 2) refuse_grid(text);
    if (std::uint64_t{sides[0]} * sides[1] > DotGrid::most_dots) refuse_size();
    return DotGrid(std::vector<std::uint32_t>(sides[0], sides[1]));
}

Crossings parse_crossings(const DotGrid& grid, std::string_view text) {
    const std::size_t count = grid.gaps().size();
    const std::string word = lower_case(text);
    if (word == "all" || word == "none") return Crossings(count, word == "all");
    Crossings crossings;
    for (const char byte : text) {
        if (byte == '0' || byte == '1') {
            crossings.push_back(byte == '1');
        } else if (std::string_view(" \t\r\n,/").find(byte) == std::string_view::npos) {
            throw std::runtime_error(
                fmt::format("'{}': expected all, none, or a 0 or 1 for each gap", printable(text, 80)));
        }
    }
    if (crossings.size() != count) {
        throw std::runtime_error(
            fmt::format("{} digits, but the grid {} has {} gaps: for each row from the top those within "
                        "it, then those "
                        "to the next row",
                        crossings.size(), printable(grid.text(), 80), count));
    }
    return crossings;
}

std::string crossings_text(const DotGrid& grid, const Crossings& crossings) {
    std::string text;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const GridGap& gap = grid.gaps()[i];
        // A new word for each row of gaps: another direction, or another row of the upper dot.
        if (i > 0 && (gap.side != grid.gaps()[i - 1].side ||
                      grid.dots()[gap.from].y != grid.dots()[grid.gaps()[i - 1].from].y)) {
            text += ' ';
        }
        text += crossings[i] ? '1' : '0';
    }
    return text;
}

// --- lines --------------------------------------------------------------------------------------------------------

ArcStep next_step(const DotGrid& grid, const Crossings& crossings, const ArcStep& step) {
    const std::uint32_t side = step.exit();
    const std::int32_t gap = grid.gap(step.dot, side);
    if (gap < 0 || !crossings[static_cast<std::size_t>(gap)]) {
        return {step.dot, (step.arc + (step.anticlockwise ? 1 : 3)) % 4, step.anticlockwise};
    }
    const GridGap& crossed = grid.gaps()[static_cast<std::size_t>(gap)];
    const std::uint32_t other = crossed.from == step.dot ? crossed.to : crossed.from;
    return {other, (side + (step.anticlockwise ? 1 : 2)) % 4, !step.anticlockwise};
}

std::size_t count_lines(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor) {
    return line_starts(grid, crossings, monitor).size();
}

std::vector<ArcStep> line_starts(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor) {
    LineLabels labels;
    label_lines(grid, crossings, labels, monitor);
    return labels.starts;
}

std::size_t laplacian_nullity(const DotGrid& grid, const Crossings& crossings, const Monitor& monitor) {
    const std::size_t count = grid.dots().size();
    // Number the dots along the shorter side: neighbours then have numbers that differ by at most `width`.
    std::vector<std::uint32_t> number(count);
    std::iota(number.begin(), number.end(), 0U);
    if (grid.rows().size() < *std::max_element(grid.rows().begin(), grid.rows().end())) {
        std::vector<std::uint32_t> order = number;
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return grid.dots()[a].x < grid.dots()[b].x; });
        for (std::uint32_t i = 0; i < count; ++i) number[order[i]] = i;
    }
    std::size_t width = 0;
    for (const GridGap& gap : grid.gaps()) {
        const auto [low, high] = std::minmax(number[gap.from], number[gap.to]);
        width = std::max<std::size_t>(width, high - low);
    }
    std::vector<std::uint32_t> dot_of(count);
    for (std::uint32_t i = 0; i < count; ++i) dot_of[number[i]] = i;

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
        for (std::uint32_t side = 0; side < 4; ++side) {
            const std::int32_t gap = grid.gap(dot_of[i], side);
            if (gap < 0 || !crossings[static_cast<std::size_t>(gap)]) continue;
            const GridGap& crossed = grid.gaps()[static_cast<std::size_t>(gap)];
            flip(number[crossed.from]);
            flip(number[crossed.to]);
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

// --- symmetry -----------------------------------------------------------------------------------------------------

namespace {
constexpr std::array<std::pair<GridSymmetry, std::string_view>, 7> symmetry_names = {
    {{GridSymmetry::none, "none"},
     {GridSymmetry::c2, "C2"},
     {GridSymmetry::c4, "C4"},
     {GridSymmetry::mirror_x, "mirror-x"},
     {GridSymmetry::mirror_y, "mirror-y"},
     {GridSymmetry::mirrors, "mirrors"},
     {GridSymmetry::d4, "D4"}}};
}  // namespace

GridSymmetry parse_grid_symmetry(std::string_view text) {
    std::string word = lower_case(text);
    std::replace(word.begin(), word.end(), ' ', '-');
    for (const auto& [symmetry, name] : symmetry_names) {
        if (word == lower_case(name)) return symmetry;
    }
    throw std::runtime_error(
        fmt::format("'{}': expected none, C2 (half turn), C4 (quarter turn), mirror-x (left and right), "
                    "mirror-y (top and bottom), mirrors (both) or D4 (all)",
                    printable(text, 80)));
}

std::string_view grid_symmetry_name(GridSymmetry symmetry) {
    return symmetry_names[static_cast<std::size_t>(symmetry)].second;
}

bool has_symmetry(const DotGrid& grid, GridSymmetry symmetry) {
    const auto list = generators(symmetry);
    return std::all_of(list.begin(), list.end(), [&](const Isometry& isometry) { return keeps(grid, isometry); });
}

void require_symmetry(const DotGrid& grid, GridSymmetry symmetry) {
    if (has_symmetry(grid, symmetry)) return;
    throw std::runtime_error(fmt::format("the grid {} itself does not have the symmetry {}",
                                         printable(grid.text(), 80), grid_symmetry_name(symmetry)));
}

std::vector<std::vector<std::uint32_t>> grid_symmetries(const DotGrid& grid) {
    std::vector<std::vector<std::uint32_t>> found;
    for (const Isometry& isometry : isometries) {
        if (keeps(grid, isometry)) found.push_back(moved_gaps(grid, isometry));
    }
    return found;
}

std::vector<std::uint32_t> gap_orbits(const DotGrid& grid, GridSymmetry symmetry) {
    require_symmetry(grid, symmetry);
    UnionFind sets(grid.gaps().size());
    for (const Isometry& isometry : generators(symmetry)) {
        const std::vector<std::uint32_t> images = moved_gaps(grid, isometry);
        for (std::uint32_t i = 0; i < images.size(); ++i) sets.unite(i, images[i]);
    }
    std::vector<std::uint32_t> orbits(grid.gaps().size());
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < orbits.size(); ++i) {
        const std::uint32_t first = sets.find(i);
        orbits[i] = first == i ? count++ : orbits[first];
    }
    return orbits;
}

bool is_symmetric(const DotGrid& grid, const Crossings& crossings, GridSymmetry symmetry) {
    if (!has_symmetry(grid, symmetry)) return false;
    for (const Isometry& isometry : generators(symmetry)) {
        const std::vector<std::uint32_t> images = moved_gaps(grid, isometry);
        for (std::size_t i = 0; i < images.size(); ++i) {
            if (crossings[i] != crossings[images[i]]) return false;
        }
    }
    return true;
}

std::optional<std::string> single_line_obstacle(const DotGrid& grid, GridSymmetry symmetry) {
    const bool centre_is_dot = grid.dot_at({0, 0}).has_value();
    // The middle of a gap lies between two dots, a step of half a spacing from both.
    const bool centre_is_gap = (grid.dot_at({1, 0}) && grid.dot_at({-1, 0})) ||  //
                               (grid.dot_at({0, 1}) && grid.dot_at({0, -1}));
    const bool has_quarter_turn = symmetry == GridSymmetry::c4 || symmetry == GridSymmetry::d4;
    const bool has_half_turn = symmetry == GridSymmetry::c2 || symmetry == GridSymmetry::mirrors;
    if (has_quarter_turn && !centre_is_dot) {
        return fmt::format(
            "no single line on {} has the symmetry {}: a line that a quarter turn leaves as it is has a dot in its "
            "middle, so the grid has to have one there, as 7x7 does",
            printable(grid.text(), 80), grid_symmetry_name(symmetry));
    }
    if (has_half_turn && !centre_is_dot && !centre_is_gap) {
        return fmt::format(
            "no single line on {} has the symmetry {}: a line that a half turn leaves as it is has a dot or a "
            "crossing in its middle, so the grid has to have a dot or a gap there, as 7x7 and 6x7 do",
            printable(grid.text(), 80), grid_symmetry_name(symmetry));
    }
    if (symmetry == GridSymmetry::d4) {
        const auto on_diagonal =
            std::count_if(grid.dots().begin(), grid.dots().end(), [](GridDot dot) { return dot.x == dot.y; });
        if (on_diagonal > 1) {
            return fmt::format(
                "no single line on {} has the symmetry D4: a line meets an axis of its symmetry twice, and here it "
                "meets each diagonal {} times; C4 is the most a single line can have",
                printable(grid.text(), 80), 2 * on_diagonal);
        }
    }
    return std::nullopt;
}

// --- making them --------------------------------------------------------------------------------------------------

Crossings random_crossings(const DotGrid& grid, const RandomKolam& kolam) {
    if (!(kolam.density >= 0 && kolam.density <= 1)) {
        throw std::runtime_error("the density of crossings is between 0 and 1");
    }
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, kolam.symmetry);
    SplitMix chance(kolam.seed);
    Crossings drawn;
    Crossings crossings(orbits.size());
    for (std::size_t i = 0; i < orbits.size(); ++i) {
        if (orbits[i] == drawn.size()) drawn.push_back(chance.fraction() < kolam.density);
        crossings[i] = drawn[orbits[i]];
    }
    return crossings;
}

std::size_t make_single_line(const DotGrid& grid, Crossings& crossings, std::uint64_t seed, const Monitor& monitor) {
    LineLabels labels;
    label_lines(grid, crossings, labels, monitor);
    const std::vector<std::uint32_t>& label = labels.line;
    UnionFind lines(labels.starts.size());
    SplitMix chance(seed);
    std::size_t changed = 0;
    // Once around is enough: afterwards the two lines of every gap are one, and the gaps connect all dots.
    Pulse pulse(monitor);
    for (const std::uint32_t i : shuffled(crossings.size(), chance)) {
        pulse();
        const auto [first, second] = passing(grid.gaps()[i], crossings[i]);
        if (lines.find(label[first]) == lines.find(label[second])) continue;
        lines.unite(label[first], label[second]);
        crossings[i] = !crossings[i];
        ++changed;
    }
    return changed;
}

namespace {

/// Changes each orbit of gaps whose gaps, one after the other, all join different lines: that leaves as many lines
/// fewer as the orbit has gaps, and needs no line to be followed again.
void join_orbits(const DotGrid& grid, const std::vector<std::vector<std::uint32_t>>& orbits, SplitMix& chance,
                 Crossings& crossings, LineLabels& labels, const Monitor& monitor) {
    label_lines(grid, crossings, labels, monitor);
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
            const auto [first, second] = passing(grid.gaps()[i], crossings[i]);
            joined.emplace_back(line(first), line(second));
            return joined.back().first != joined.back().second;
        });
        if (!all_join) continue;
        for (const auto& [from, to] : joined) lines.unite(from, to);
        for (const std::uint32_t i : orbits[orbit]) crossings[i] = !crossings[i];
    }
}

}  // namespace

std::optional<SingleLine> find_single_line(const DotGrid& grid, const RandomKolam& kolam, int attempts,
                                           const Monitor& monitor) {
    if (kolam.symmetry == GridSymmetry::none) {
        SingleLine found{random_crossings(grid, kolam), 0, 1};
        found.changed = make_single_line(grid, found.crossings, kolam.seed, monitor);
        return found;
    }
    const std::vector<std::uint32_t> orbits = gap_orbits(grid, kolam.symmetry);
    std::vector<std::vector<std::uint32_t>> members;
    for (std::uint32_t i = 0; i < orbits.size(); ++i) {
        if (orbits[i] == members.size()) members.emplace_back();
        members[orbits[i]].push_back(i);
    }
    std::uint64_t steps_left = 3'000'000'000;
    LineLabels labels;
    RandomKolam attempted = kolam;
    SplitMix seeds(kolam.seed);
    Pulse pulse(monitor);
    for (int attempt = 1; attempt <= attempts; ++attempt, attempted.seed = seeds.next()) {
        monitor.check();
        const Crossings begun = random_crossings(grid, attempted);
        SingleLine found{begun, 0, attempt};
        SplitMix chance(attempted.seed);
        join_orbits(grid, members, chance, found.crossings, labels, monitor);
        label_lines(grid, found.crossings, labels, monitor);
        for (bool improved = true; improved && labels.starts.size() > 1;) {
            improved = false;
            for (const std::uint32_t orbit : shuffled(members.size(), chance)) {
                pulse();
                if (lines_gained(grid, found.crossings, labels, members[orbit]) >= 0) continue;
                for (const std::uint32_t i : members[orbit]) found.crossings[i] = !found.crossings[i];
                label_lines(grid, found.crossings, labels, monitor);
                steps_left -= std::min<std::uint64_t>(steps_left, labels.line.size());
                improved = true;
            }
        }
        if (labels.starts.size() == 1) {
            for (std::size_t i = 0; i < begun.size(); ++i) found.changed += begun[i] != found.crossings[i];
            return found;
        }
        steps_left -= std::min<std::uint64_t>(steps_left, 4 * labels.line.size());
        if (steps_left == 0) break;
    }
    return std::nullopt;
}

}  // namespace sikku
