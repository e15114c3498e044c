#include "art/reading/kolam_csv.h"

#include "art/reading/kolam_lines.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {
namespace {

/// The lines of a text, without their ends.
class Rows {
public:
    explicit Rows(std::string_view text) : text_(text) {
        if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
    }
    std::optional<std::string_view> next() {
        if (text_.empty()) return std::nullopt;
        ++number_;
        std::string_view row = take_line(text_);
        if (row.ends_with('\r')) row.remove_suffix(1);
        return row;
    }
    std::size_t number() const { return number_; }

private:
    std::string_view text_;
    std::size_t number_ = 0;
};

/// A cell of a row, without blanks and quotes; nullopt after the last one.
std::optional<std::string_view> cell(std::string_view row, std::size_t index) {
    for (; index > 0; --index) {
        const std::size_t comma = row.find(',');
        if (comma == std::string_view::npos) return std::nullopt;
        row.remove_prefix(comma + 1);
    }
    std::string_view found = trimmed(row.substr(0, row.find(',')));
    if (found.size() >= 2 && found.front() == '"' && found.back() == '"') found = found.substr(1, found.size() - 2);
    return found;
}

struct Columns {
    std::optional<std::size_t> x, y;
    std::size_t kolams = 0;
};
Columns find_columns(std::string_view heading, std::size_t number) {
    const std::string x = fmt::format("x-kolam {}", number);
    const std::string y = fmt::format("y-kolam {}", number);
    Columns columns;
    std::size_t index = 0;
    for (std::string_view rest = heading;; ++index) {
        const std::string name = lower_case(*cell(rest, 0));
        if (name.starts_with("x-kolam ")) ++columns.kolams;
        if (name == x) columns.x = index;
        if (name == y) columns.y = index;
        const std::size_t comma = rest.find(',');
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    return columns;
}

/// Refuses a point far from its neighbours, as in a damaged table: the grid would grow to reach it.
void check_steps(const ClosedLine& line, const std::vector<std::size_t>& rows) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < line.size(); ++i) steps.push_back(glm::distance(line[i - 1], line[i]));
    const double usual = median(steps);
    constexpr double most = 50;
    const auto found = std::find_if(steps.begin(), steps.end(), [&](double step) { return step > most * usual; });
    if (found == steps.end()) return;
    // The first point is the far one if the line keeps to its steps behind it.
    const bool is_first = found == steps.begin() && steps[1] <= most * usual;
    const auto point = static_cast<std::size_t>(found - steps.begin()) + (is_first ? 0 : 1);
    throw std::runtime_error(
        fmt::format("row {}: the point {}, {} is {:.6g} from the one {} it; most points are {:.3g} apart",
                    rows[point], line[point].x, line[point].y, *found, is_first ? "after" : "before", usual));
}

bool is_dot_like(std::int64_t doubled, std::int64_t dot) {
    return ((doubled - dot) % 4 + 4) % 4 == 0;
}

/// Places of the dots, in half units, or nullopt if the line does not keep to the grid of halves.
std::optional<std::vector<GridDot>> dots_of(const ClosedLine& line) {
    std::vector<std::pair<std::int64_t, std::int64_t>> points;  // doubled
    std::int64_t right = INT64_MIN;
    std::int64_t top = INT64_MIN;
    for (const glm::dvec2 point : line) {
        const glm::dvec2 doubled = 2.0 * point;
        if (doubled != glm::round(doubled) || std::fabs(doubled.x) > 1e7 || std::fabs(doubled.y) > 1e7) {
            return std::nullopt;
        }
        points.emplace_back(static_cast<std::int64_t>(doubled.x), static_cast<std::int64_t>(doubled.y));
        right = std::max(right, points.back().first);
        top = std::max(top, points.back().second);
    }
    // At the border every line turns back, half a unit beyond the last dot.
    const std::int64_t dot_x = right - 1;
    const std::int64_t dot_y = top - 1;
    std::vector<GridDot> dots;
    const auto add = [&](std::int64_t x, std::int64_t y) {
        dots.push_back({static_cast<std::int32_t>(x / 2), static_cast<std::int32_t>(y / 2)});
    };
    if (dot_x % 2 != 0 || dot_y % 2 != 0) return std::nullopt;
    for (const auto& [x, y] : points) {
        const bool half_x = x % 2 != 0;
        const bool half_y = y % 2 != 0;
        if (half_x && half_y) return std::nullopt;
        // The column of dots nearest to the point; none if it lies midway between two.
        const std::int64_t near_x = half_x ? (is_dot_like(x - 1, dot_x) ? x - 1 : x + 1) : x;
        const std::int64_t near_y = half_y ? (is_dot_like(y - 1, dot_y) ? y - 1 : y + 1) : y;
        const bool on_x = is_dot_like(near_x, dot_x);
        const bool on_y = is_dot_like(near_y, dot_y);
        if (on_x && on_y && (half_x || half_y)) {
            add(near_x, near_y);
        } else if (on_x && !on_y) {
            add(near_x, near_y - 2);
            add(near_x, near_y + 2);
        } else if (on_y && !on_x) {
            add(near_x - 2, near_y);
            add(near_x + 2, near_y);
        } else {
            return std::nullopt;
        }
    }
    return dots;
}

}  // namespace

bool is_kolam_csv(std::string_view text) {
    const auto heading = Rows(text).next();
    return heading && lower_case(heading->substr(0, 4096)).find("x-kolam ") != std::string::npos;
}

ReadKolam read_kolam_csv(std::string_view text, std::size_t number, const Monitor& monitor) {
    Rows rows(text);
    const auto heading = rows.next();
    const Columns columns = find_columns(heading.value_or(""), number);
    if (columns.kolams == 0) {
        throw std::runtime_error("not a table of kolams: the first row has no columns 'x-kolam 1' and 'y-kolam 1'");
    }
    if (!columns.x || !columns.y) {
        throw std::runtime_error(
            fmt::format("the table has {}, but not number {}", counted(columns.kolams, "kolam"), number));
    }
    ClosedLine line;
    std::vector<std::size_t> numbers;  // numbers of the rows of its points
    Pulse pulse(monitor);
    bool has_ended = false;
    while (const auto row = rows.next()) {
        pulse();
        if (trimmed(*row).empty()) continue;
        const auto x = cell(*row, *columns.x);
        const auto y = cell(*row, *columns.y);
        if (!x || !y) throw std::runtime_error(fmt::format("row {}: too few cells", rows.number()));
        const auto is_empty = [](std::string_view word) { return word.empty() || lower_case(word) == "nan"; };
        if (is_empty(*x) && is_empty(*y)) {
            has_ended = true;
            continue;
        }
        glm::dvec2 point;
        if (!read_number(*x, point.x) || !read_number(*y, point.y) || !(std::fabs(point.x) < 1e9) ||
            !(std::fabs(point.y) < 1e9)) {
            throw std::runtime_error(fmt::format("row {}: expected two numbers below 1e9, not '{}' and '{}'",
                                                 rows.number(), printable(*x, 40), printable(*y, 40)));
        }
        if (has_ended)
            throw std::runtime_error(fmt::format("row {}: the line continues after empty cells", rows.number()));
        line.push_back(point);
        numbers.push_back(rows.number());
    }
    if (line.size() < 4) throw std::runtime_error(fmt::format("kolam {} has no line", number));
    check_steps(line, numbers);
    bool is_closed = line.front() == line.back();
    if (is_closed) line.pop_back();
    const auto dots = dots_of(line);
    ReadKolam kolam = [&] {
        if (!dots) return kolam_of_lines({line}, {}, false, std::nullopt, monitor);
        return read_gaps(place_grid(DotLattice::square, *dots), {line}, monitor);
    }();
    if (!is_closed) kolam.notes.emplace_back("the line is open; its end was joined to its beginning");
    if (columns.kolams > 1) {
        kolam.notes.push_back(fmt::format("kolam {} of {} in the table", number, columns.kolams));
    }
    kolam.title = fmt::format("Kolam {}", number);
    return kolam;
}

std::string kolam_csv_file(const DotGrid& grid, const GapStates& states, const Monitor& monitor) {
    if (grid.lattice() != DotLattice::square) {
        throw std::runtime_error(
            "the CSV of one-stroke kolams can contain only straight grids; this one is interlaced");
    }
    const auto lines = lines_of_kolam(grid, states, 0.5, monitor);
    if (lines.size() != 1) {
        throw std::runtime_error(fmt::format(
            "the CSV of one-stroke kolams can contain only single lines; this kolam has {}", lines.size()));
    }
    std::string text = "x-kolam 1,y-kolam 1\n";
    for (std::size_t i = 0; i <= lines[0].size(); ++i) {
        const glm::dvec2 point = lines[0][i % lines[0].size()];
        text += fmt::format("{:.1f},{:.1f}\n", point.x + 0.0, point.y + 0.0);
    }
    return text;
}

}  // namespace sikku
