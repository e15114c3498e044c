#include "art/workbook/kolam_facts.h"

#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sikku {
namespace {

/// Distance in y above which a dot begins another row, as a share of the distance between the nearest dots.
constexpr double row_share = 0.25;

double nearest_distance(const std::vector<glm::dvec2>& dots) {
    double least = 1e300;
    for (std::size_t i = 1; i < dots.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) least = std::min(least, glm::distance(dots[i], dots[k]));
    }
    return dots.size() < 2 ? 1 : least;
}

/// True if rows grow by `step` dots up to the longest, and shrink by as many after it.
bool is_diamond(const std::vector<std::size_t>& counts, std::size_t step) {
    const auto longest = std::max_element(counts.begin(), counts.end());
    for (auto row = counts.begin(); row + 1 != counts.end(); ++row) {
        const bool grows = row < longest;
        if (grows ? row[1] != row[0] + step : row[0] != row[1] + step) return false;
    }
    return counts.front() == counts.back() && counts.size() > 1;
}

std::string symmetry_text(const KolamSymmetry& symmetry) {
    constexpr const char* turns[] = {
        "", "", "half turn", "third of a turn", "quarter turn", "fifth of a turn", "sixth of a turn"};
    const std::string mirrors =
        symmetry.mirrors == 0 ? "" : fmt::format("{}", counted(symmetry.mirrors, "mirror line"));
    if (symmetry.rotations < 2) return mirrors.empty() ? "none" : mirrors;
    const std::string turn = symmetry.rotations <= 6
                                 ? fmt::format("the same after a {}", turns[symmetry.rotations])
                                 : fmt::format("the same after 1/{} of a turn", symmetry.rotations);
    return mirrors.empty() ? turn : turn + ", and " + mirrors;
}

std::string lines_text(const KolamFacts& facts) {
    const char* const kind = facts.open_lines == 0             ? "closed line"
                             : facts.open_lines == facts.lines ? "open line"
                                                               : "line";
    const std::string lines = counted(facts.lines, kind);
    return facts.crossings == 0 ? lines + " without crossings"
                                : lines + " with " + counted(facts.crossings, "crossing");
}

/// The number of strokes, and where they begin.
std::string order_text(const KolamFacts& facts) {
    constexpr std::size_t most_named = 8;
    std::string text = counted(facts.strokes, "stroke");
    if (facts.open_lines == 0) text += ", anticlockwise";
    if (facts.lines > 1) text += ", from the centre outwards";
    if (facts.starts.empty() || facts.starts.front().row == 0) return text;
    const bool is_one = facts.starts.size() == 1;
    text += is_one ? "; it begins at" : "; they begin at";
    for (std::size_t i = 0; i < std::min(most_named, facts.starts.size()); ++i) {
        const DotNumber dot = facts.starts[i];
        text += fmt::format("{} row {} dot {}", i > 0 ? "," : "", dot.row, dot.number);
    }
    return facts.starts.size() > most_named ? text + ", …" : text;
}

}  // namespace

DotRows::DotRows(std::vector<glm::dvec2> dots) {
    const double apart = row_share * nearest_distance(dots);
    std::sort(dots.begin(), dots.end(), [](glm::dvec2 a, glm::dvec2 b) { return a.y > b.y; });
    for (const glm::dvec2 dot : dots) {
        if (rows_.empty() || rows_.back().front().y - dot.y > apart) rows_.emplace_back();
        rows_.back().push_back(dot);
    }
    for (auto& row : rows_) {
        std::sort(row.begin(), row.end(), [](glm::dvec2 a, glm::dvec2 b) { return a.x < b.x; });
    }
}

std::size_t DotRows::count() const {
    std::size_t count = 0;
    for (const auto& row : rows_) count += row.size();
    return count;
}

std::string DotRows::notation() const {
    constexpr std::size_t most_rows = 15;
    if (rows_.empty()) return "";
    std::vector<std::size_t> counts;
    for (const auto& row : rows_) counts.push_back(row.size());
    const std::size_t longest = *std::max_element(counts.begin(), counts.end());
    const bool is_even =
        std::all_of(counts.begin(), counts.end(), [&](std::size_t count) { return count == longest; });
    if (is_even && std::fabs(rows_.front().front().x - rows_.back().front().x) < 1e-3) {
        return fmt::format("{}x{}", counts.size(), longest);
    }
    if (is_diamond(counts, 2)) return fmt::format("{}-{} ner pulli", longest, counts.front());
    if (is_diamond(counts, 1)) return fmt::format("{}-{} idukku pulli", longest, counts.front());
    std::string text;
    for (std::size_t i = 0; i < std::min(most_rows, counts.size()); ++i) {
        text += fmt::format("{}{}", i > 0 ? "-" : "", counts[i]);
    }
    return counts.size() > most_rows ? text + "-…" : text;
}

DotNumber DotRows::nearest(glm::dvec2 point) const {
    DotNumber best;
    double least = 1e300;
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        for (std::size_t i = 0; i < rows_[row].size(); ++i) {
            const double distance = glm::distance(rows_[row][i], point);
            if (distance >= least) continue;
            least = distance;
            best = {row + 1, i + 1};
        }
    }
    return best;
}

double KolamFacts::difficulty() const {
    constexpr double weight = 4;
    return static_cast<double>(dots + crossings) +
           weight * static_cast<double>(strokes) / static_cast<double>(std::max<std::size_t>(lines, 1));
}

int KolamFacts::level() const {
    int level = 1;
    for (double most = 20; level < most_level && difficulty() >= most; most *= 2) ++level;
    return level;
}

std::vector<std::string> notes_of(const KolamFacts& facts) {
    std::vector<std::string> notes = {fmt::format("Level {} of {}", facts.level(), most_level)};
    if (!facts.grid.empty()) {
        notes.push_back(fmt::format("Grid: {}, {}", facts.grid, counted(facts.dots, "dot")));
    } else if (facts.dots > 0) {
        notes.push_back(fmt::format("Dots: {}", facts.dots));
    }
    notes.push_back("Lines: " + lines_text(facts));
    notes.push_back("Symmetry: " + symmetry_text(facts.symmetry));
    notes.push_back("Strokes: " + order_text(facts));
    notes.push_back(fmt::format(
        "Difficulty: {:.0f} (dots, plus crossings, plus four times the strokes for each line)", facts.difficulty()));
    return notes;
}

}  // namespace sikku
