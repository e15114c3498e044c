#include "art/kolam/dot_grid_text.h"

#include "engine/geometry/bezier.h"
#include "engine/geometry/box.h"
#include "engine/geometry/lettering.h"
#include "engine/geometry/path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sikku {
namespace {

using LetterLine = std::vector<glm::dvec2>;

/// The strokes of a letter as lines.
class LetterLines : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override { all.push_back({start}); }
    void lines(std::span<const glm::dvec2> ends) override {
        all.back().insert(all.back().end(), ends.begin(), ends.end());
    }
    void curves(std::span<const glm::dvec2> controls) override {
        constexpr double tolerance = 0.02;  // spacings
        for (std::size_t i = 0; i + 2 < controls.size(); i += 3) {
            flatten(all.back().back(), controls[i], controls[i + 1], controls[i + 2], tolerance,
                    [this](glm::dvec2 end) { all.back().push_back(end); });
        }
    }
    void change_pen(const Pen&) override {}
    void end_stroke(bool closed) override {
        if (closed) all.back().push_back(all.back().front());
    }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}

    std::vector<LetterLine> all;
};

/// Thickness of the bars of a letter, in dots.
std::uint32_t thickness_of(std::uint32_t rows) {
    return std::max(1U, (rows + 1) / 6);
}

/// A place along an axis where a stroke turns back, ends, or runs across the axis.
struct Bar {
    double at = 0;      ///< spacings
    double length = 0;  ///< of a straight run across the axis, 0 for others
};

/// Moves the bars of letters along one axis to places of the lattice, and what lies between them in proportion.
class BarHinting {
public:
    /// @param thickness  dots across a bar
    BarHinting(std::vector<Bar> bars, std::uint32_t thickness) {
        std::sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.at < b.at; });
        const double least = thickness + 1;  // leaves a row without dots between two bars
        for (std::size_t i = 0; i < bars.size();) {
            // Bars that are near each other move together.
            double sum = 0, weight = 0;
            const double begin = bars[i].at;
            for (; i < bars.size() && bars[i].at - begin <= 0.4 * least; ++i) {
                const double one = 0.1 + bars[i].length;
                sum += one * bars[i].at;
                weight += one;
            }
            from_.push_back(sum / weight);
        }
        // From the bar next to the base line upwards, then downwards.
        const auto base = std::min_element(from_.begin(), from_.end(),
                                           [](double a, double b) { return std::abs(a) < std::abs(b); });
        const double offset = (thickness - 1) / 2.0;
        const auto snapped = [offset](double bar) { return std::floor(bar + 0.5) + offset; };
        to_.resize(from_.size());
        const auto first = static_cast<std::size_t>(base - from_.begin());
        for (std::size_t i = first; i < from_.size(); ++i) {
            to_[i] = i == first ? snapped(from_[i]) : std::max(snapped(from_[i]), to_[i - 1] + least);
        }
        for (std::size_t i = first; i-- > 0;) to_[i] = std::min(snapped(from_[i]), to_[i + 1] - least);
    }

    double operator()(double at) const {
        if (from_.empty()) return at;
        const auto above = static_cast<std::size_t>(std::upper_bound(from_.begin(), from_.end(), at) - from_.begin());
        if (above == 0) return at + to_.front() - from_.front();
        if (above == from_.size()) return at + to_.back() - from_.back();
        const double share = (at - from_[above - 1]) / (from_[above] - from_[above - 1]);
        return to_[above - 1] + share * (to_[above] - to_[above - 1]);
    }

private:
    std::vector<double> from_, to_;  // places of bars before and after, ascending
};

/// The bars along an axis, with the first and the last place of the letter.
std::vector<Bar> bars_of(const std::vector<LetterLine>& lines, glm::length_t axis) {
    std::vector<Bar> bars;
    double least = 1e300, most = -1e300;
    for (const LetterLine& line : lines) {
        double course = 0;  // sign of the last move along the axis
        for (std::size_t i = 0; i < line.size(); ++i) {
            least = std::min(least, line[i][axis]);
            most = std::max(most, line[i][axis]);
            if (i == 0) continue;
            const double move = line[i][axis] - line[i - 1][axis];
            const double across = std::abs(line[i][1 - axis] - line[i - 1][1 - axis]);
            if (std::abs(move) < 0.1 * across && across > 0.5) {
                bars.push_back({(line[i][axis] + line[i - 1][axis]) / 2, across});
            }
            if (move * course < 0) bars.push_back({line[i - 1][axis]});
            if (move != 0) course = move;
            const bool is_along = std::abs(move) > 10 * across;
            if (is_along && i == 1) bars.push_back({line[0][axis]});
            if (is_along && i + 1 == line.size()) bars.push_back({line[i][axis]});
        }
    }
    if (least <= most) bars.insert(bars.end(), {Bar{least}, Bar{most}});
    return bars;
}

/// Replaces a stroke that is smaller than a bar, such as the dot of an i, with its middle.
void shrink_dot(LetterLine& line, std::uint32_t thickness) {
    const Box box = box_of(line);
    if (box.longest() < thickness) line = {(box.low + box.high) / 2.0};
}

/// Dots of a letter: y upwards from the base line, x from its first column.
struct DottedLetter {
    std::vector<glm::ivec2> dots;
    std::int32_t width = 0;  ///< in dots
};

void add_dots(const LetterLine& line, double reach, std::vector<glm::ivec2>& dots) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::dvec2 from = line[i > 0 ? i - 1 : 0], to = line[i];
        const glm::dvec2 low = glm::ceil(glm::min(from, to) - reach), high = glm::max(from, to) + reach;
        for (auto y = static_cast<std::int32_t>(low.y); y <= high.y; ++y) {
            for (auto x = static_cast<std::int32_t>(low.x); x <= high.x; ++x) {
                if (distance_to_segment({x, y}, from, to) <= reach) dots.emplace_back(x, y);
            }
        }
    }
}

DottedLetter dotted(std::string_view letter, std::uint32_t rows) {
    const std::uint32_t thickness = thickness_of(rows);
    LetterLines strokes;
    write_text(letter, glm::dvec2(0.0), static_cast<double>(rows - thickness), Pen{}, strokes);
    for (LetterLine& line : strokes.all) shrink_dot(line, thickness);
    const BarHinting across(bars_of(strokes.all, 0), thickness), up(bars_of(strokes.all, 1), thickness);
    DottedLetter made;
    const double dot_reach = thickness / 2.0 + 0.2;
    const double reach = std::max(0.7, thickness / 2.0 - 0.1);  // connects the dots of diagonals, too
    for (LetterLine& line : strokes.all) {
        for (glm::dvec2& point : line) point = {across(point.x), up(point.y)};
        add_dots(line, line.size() == 1 ? dot_reach : reach, made.dots);
    }
    if (made.dots.empty()) return made;
    const auto is_left = [](glm::ivec2 a, glm::ivec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::sort(made.dots.begin(), made.dots.end(), is_left);
    made.dots.erase(std::unique(made.dots.begin(), made.dots.end()), made.dots.end());
    const std::int32_t first = made.dots.front().x;
    for (glm::ivec2& dot : made.dots) dot.x -= first;
    made.width = made.dots.back().x + 1;
    return made;
}

/// Sets letters side by side.
class DotSetter {
public:
    explicit DotSetter(std::uint32_t rows)
        : rows_(rows), gap_(static_cast<std::int32_t>(std::max(2U, thickness_of(rows)))) {}

    /// Adds a line of text below those before.
    void add_line(std::string_view text) {
        std::vector<glm::ivec2> line;
        std::int32_t end = 0;  // column after the last letter
        for (const std::string_view letter : letters_of(text)) {
            if (end > static_cast<std::int32_t>(DotGrid::most_dots)) {
                throw std::runtime_error("a line of the text is too long");
            }
            const DottedLetter& dotted = letter_of(letter);
            if (dotted.dots.empty()) {
                end += gap_;
                continue;
            }
            const std::int32_t begin = line.empty() ? 0 : end + gap_;
            if (dots_.size() + line.size() + dotted.dots.size() > DotGrid::most_dots) refuse_size();
            for (const glm::ivec2 dot : dotted.dots) line.emplace_back(dot.x + begin, dot.y);
            end = begin + dotted.width;
        }
        if (!line.empty()) place(line, end);
    }

    DotGrid grid() {
        if (dots_.empty()) throw std::runtime_error("the text has no letters");
        const auto [lowest, highest] =
            std::minmax_element(dots_.begin(), dots_.end(), [](glm::ivec2 a, glm::ivec2 b) { return a.y < b.y; });
        const std::int32_t top = highest->y;
        const auto [left, right] =
            std::minmax_element(dots_.begin(), dots_.end(), [](glm::ivec2 a, glm::ivec2 b) { return a.x < b.x; });
        const std::uint64_t places = (std::uint64_t{1} + static_cast<std::uint32_t>(right->x - left->x)) *
                                     (std::uint64_t{1} + static_cast<std::uint32_t>(top - lowest->y));
        if (places > 16 * DotGrid::most_dots) throw std::runtime_error("the letters of the text lie too far apart");
        std::vector<std::vector<std::int32_t>> columns(static_cast<std::size_t>(top - lowest->y) + 1);
        for (const glm::ivec2 dot : dots_) columns[static_cast<std::size_t>(top - dot.y)].push_back(2 * dot.x);
        for (std::vector<std::int32_t>& row : columns) std::sort(row.begin(), row.end());
        return DotGrid(DotLattice::square, columns);
    }

private:
    const DottedLetter& letter_of(std::string_view letter) {
        const auto found = letters_.find(letter);
        return found != letters_.end() ? found->second
                                       : letters_.emplace(letter, dotted(letter, rows_)).first->second;
    }
    [[noreturn]] static void refuse_size() {
        throw std::runtime_error(fmt::format("the text has more than {} dots", DotGrid::most_dots));
    }
    /// Centres a line about column 0 below the lines before.
    void place(const std::vector<glm::ivec2>& line, std::int32_t width) {
        const auto [lowest, highest] =
            std::minmax_element(line.begin(), line.end(), [](glm::ivec2 a, glm::ivec2 b) { return a.y < b.y; });
        const glm::ivec2 move(-width / 2, dots_.empty() ? 0 : bottom_ - gap_ - 1 - highest->y);
        for (const glm::ivec2 dot : line) dots_.push_back(dot + move);
        bottom_ = lowest->y + move.y;
    }

    std::uint32_t rows_;
    std::int32_t gap_;  ///< empty columns between letters, and rows between lines
    std::int32_t bottom_ = 0;
    std::map<std::string_view, DottedLetter> letters_;
    std::vector<glm::ivec2> dots_;
};

}  // namespace

DotGrid text_grid(std::string_view utf8, std::uint32_t rows) {
    if (utf8.size() > DotGrid::most_dots) throw std::runtime_error("the text is too long");
    const std::string missing = missing_letters({std::string(utf8)});
    if (!missing.empty()) throw std::runtime_error(fmt::format("the lettering font lacks {}", missing));
    DotSetter setter(std::clamp(rows, fewest_letter_rows, most_letter_rows));
    for (std::size_t at = 0; at <= utf8.size();) {
        const std::size_t end = std::min(utf8.find_first_of("/\n", at), utf8.size());
        setter.add_line(utf8.substr(at, end - at));
        at = end + 1;
    }
    return setter.grid();
}

}  // namespace sikku
