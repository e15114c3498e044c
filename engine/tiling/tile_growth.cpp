#include "engine/tiling/tile_growth.h"

#include "engine/derivation/exact_counts.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/plain_form.h"
#include "engine/geometry/polygon_classes.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <tuple>

namespace sikku {
namespace {

constexpr std::size_t most_matrix = 400;  // symbols that lead to tiles
constexpr double accuracy = 1e-9;

/// Angles, sides and area of a polygon.
TileShape shape_of(std::span<const glm::dvec2> outline) {
    std::vector<glm::dvec2> corners;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 before = outline[i] - outline[(i + outline.size() - 1) % outline.size()];
        const glm::dvec2 after = outline[(i + 1) % outline.size()] - outline[i];
        if (std::fabs(determinant(before, after)) > accuracy) corners.push_back(outline[i]);
    }
    TileShape shape;
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) shape.area += determinant(corners[i], corners[(i + 1) % count]) / 2;
    if (shape.area < 0) {
        std::reverse(corners.begin(), corners.end());
        shape.area = -shape.area;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 before = corners[(i + count - 1) % count] - corners[i];
        const glm::dvec2 after = corners[(i + 1) % count] - corners[i];
        const double angle =
            std::atan2(determinant(after, before), scalar_product(after, before)) * 180 / std::numbers::pi;
        shape.angles.push_back(angle < 0 ? angle + 360 : angle);
        shape.sides.push_back(std::sqrt(scalar_product(after, after)));
    }
    return shape;
}

/// Classifies the polygons of a turtle.
class ShapeReader : public PolygonSink {
public:
    struct Kind {
        std::uint32_t shape = 0;
        bool is_reflected = false;
        std::optional<int> colour;
        bool operator<(const Kind& other) const {
            return std::tie(shape, is_reflected, colour) < std::tie(other.shape, other.is_reflected, other.colour);
        }
    };
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        const PolygonClass found = classes_.classify(vertices);
        if (found.shape == shapes.size()) shapes.push_back(shape_of(vertices));
        kinds.push_back({found.shape, found.is_reflected, pen.colour});
    }

    std::vector<TileShape> shapes;
    std::vector<Kind> kinds;  ///< of the polygons since it was cleared

private:
    PolygonClasses classes_;
};

/// Motion of a turtle: first by a vector, then by a turn.
struct Move {
    glm::dvec2 way{0.0};
    glm::dvec2 turn{1.0, 0.0};
};

class GrowthFinder {
public:
    /// @param has_parameters  `grammar` is the plain form of a system with parameters
    GrowthFinder(const Grammar& grammar, bool has_parameters) : grammar_(grammar), has_parameters_(has_parameters) {}

    TileGrowth find() {
        find_reachable();
        if (!read_tiles()) {
            result_.unknown = "polygons are drawn by several symbols together";
            return std::move(result_);
        }
        if (kinds_.empty()) {
            result_.unknown = "no symbol draws a tile";
            return std::move(result_);
        }
        count();
        if (grammar_.tables().size() != 1) {
            result_.no_limit = result_.no_length = "the schedule has several tables";
            return std::move(result_);
        }
        find_limits();
        find_length();
        return std::move(result_);
    }

private:
    using Kind = ShapeReader::Kind;
    using Rows = std::vector<std::map<std::size_t, double>>;

    /// Finds the symbols of words before `interpret:`.
    void find_reachable() {
        std::set<Symbol> known(grammar_.axiom().begin(), grammar_.axiom().end());
        std::vector<Symbol> left(known.begin(), known.end());
        while (!left.empty()) {
            const Symbol symbol = left.back();
            left.pop_back();
            for (const Table& table : grammar_.tables()) {
                const Word* successor = table.successor(symbol);
                if (!successor) continue;
                for (const Symbol next : *successor) {
                    if (known.insert(next).second) left.push_back(next);
                }
            }
        }
        symbols_.assign(known.begin(), known.end());
    }
    Word interpreted(Symbol symbol) const {
        const Word* successor = grammar_.interpretation() ? grammar_.interpretation()->successor(symbol) : nullptr;
        return successor ? *successor : Word{symbol};
    }

    static bool changes_colour(const Command& command) {
        return command.action == Action::colour_set || command.action == Action::colour_step;
    }
    /// True if any word changes the colour.
    bool has_colours() const {
        return std::any_of(symbols_.begin(), symbols_.end(), [&](Symbol symbol) {
            const Word word = interpreted(symbol);
            return std::any_of(word.begin(), word.end(),
                               [&](Symbol each) { return changes_colour(grammar_.symbols()[each].command); });
        });
    }
    /// For each polygon of a word, whether the word itself sets its colour.
    std::vector<char> own_colours(const Word& word) const {
        std::vector<char> result, outer;
        char is_set = 0;
        for (const Symbol symbol : word) {
            const Action action = grammar_.symbols()[symbol].command.action;
            if (action == Action::colour_set) is_set = 1;
            if (action == Action::push) outer.push_back(is_set);
            if (action == Action::pop && !outer.empty()) {
                is_set = outer.back();
                outer.pop_back();
            }
            if (action == Action::polygon_end) result.push_back(is_set);
        }
        return result;
    }

    /// Finds the tiles that each symbol draws by itself; false if braces or brackets of one do not balance.
    bool read_tiles() {
        ShapeReader reader;
        const bool is_coloured = has_colours();
        for (const Symbol symbol : symbols_) {
            const Word word = interpreted(symbol);
            int braces = 0, tiles = 0;
            for (const Symbol each : word) {
                const Action action = grammar_.symbols()[each].command.action;
                if (action == Action::polygon_begin) ++braces;
                if (action == Action::polygon_end) ++tiles;
                if (tiles > braces) return false;
            }
            if (tiles != braces) return false;
            if (tiles == 0) continue;
            const auto written = grammar_.written_out({word, {}, {}});
            if (!written) return false;
            reader.kinds.clear();
            try {
                const auto turtle = Turtle::drawing(*written, reader, false);
                derive(*written, *turtle);
            } catch (const WordError&) {
                return false;
            }
            const std::vector<char> own = is_coloured ? own_colours(word) : std::vector<char>();
            for (std::size_t i = 0; i < reader.kinds.size(); ++i) {
                Kind& kind = reader.kinds[i];
                if (is_coloured && (own.size() != reader.kinds.size() || !own[i])) kind.colour.reset();
                ++kinds_[kind][symbol];
            }
        }
        result_.shapes = reader.shapes;
        return true;
    }

    void count() {
        const auto known = forecast(grammar_, false);
        for (const auto& [kind, symbols] : kinds_) {
            TileKindCount each{kind.shape, kind.is_reflected, kind.colour, {}, 0, {}};
            std::set<std::string> letters;
            for (const auto& [symbol, times] : symbols) {
                const std::string& letter = grammar_.symbols()[symbol].letter;
                if (letters.insert(letter).second) each.letters += (each.letters.empty() ? "" : " ") + letter;
                if (known && known->counts) each.count += (*known->counts)[symbol] * times;
            }
            result_.counts.push_back(std::move(each));
        }
        if (!known || !known->counts) result_.unknown = "the numbers have more than 10,000 digits";
    }

    /// Symbols that draw tiles or become such symbols.
    std::vector<Symbol> tile_symbols() const {
        std::set<Symbol> leads;
        for (const auto& [kind, symbols] : kinds_) {
            for (const auto& [symbol, times] : symbols) leads.insert(symbol);
        }
        for (bool grows = true; grows;) {
            grows = false;
            for (const Symbol symbol : symbols_) {
                const Word* successor = grammar_.tables().front().successor(symbol);
                if (leads.contains(symbol) || !successor) continue;
                if (std::none_of(successor->begin(), successor->end(), [&](Symbol s) { return leads.contains(s); })) {
                    continue;
                }
                leads.insert(symbol);
                grows = true;
            }
        }
        return {leads.begin(), leads.end()};
    }

    void find_limits() {
        const std::vector<Symbol> tiles = tile_symbols();
        if (tiles.size() > most_matrix) {
            result_.no_limit = fmt::format("more than {} symbols lead to tiles", most_matrix);
            return;
        }
        std::map<Symbol, std::size_t> index;
        for (std::size_t i = 0; i < tiles.size(); ++i) index[tiles[i]] = i;
        // Successors of symbols.
        Rows rows(tiles.size());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            const Word* successor = grammar_.tables().front().successor(tiles[i]);
            if (!successor) {
                rows[i][i] = 1;
                continue;
            }
            for (const Symbol symbol : *successor) {
                const auto found = index.find(symbol);
                if (found != index.end()) ++rows[i][found->second];
            }
        }
        std::vector<double> counts = counts_in_axiom(index), next;
        // The matrix plus 1 has the same eigenvectors, and one eigenvalue of largest size.
        double factor = 0;
        bool converges = false;
        for (int round = 0; round < 20'000 && !converges; ++round) {
            next = counts;
            double before = 0, after = 0;
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                before += counts[i];
                for (const auto& [j, times] : rows[i]) next[j] += counts[i] * times;
            }
            for (const double each : next) after += each;
            if (!(after > 0)) break;
            double change = 0;
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                next[i] /= after;
                change = std::max(change, std::fabs(next[i] - counts[i] / before));
            }
            converges = change < 1e-15 && std::fabs(after / before - factor) < 1e-14 * factor;
            factor = after / before;
            counts.swap(next);
        }
        if (!converges || factor - 1 < 1 + accuracy) {
            result_.no_limit = "the number of tiles does not grow by a factor";
            return;
        }
        result_.tiles = factor - 1;
        result_.period = period_of(rows);
        find_shares(rows, index, counts);
    }

    std::vector<double> counts_in_axiom(const std::map<Symbol, std::size_t>& index) const {
        std::vector<double> counts(index.size(), 0);
        for (const Symbol symbol : grammar_.axiom()) {
            const auto found = index.find(symbol);
            if (found != index.end()) ++counts[found->second];
        }
        return counts;
    }

    /// Groups of kinds whose shares are computed: shapes, reflected tiles of a shape, colours, and each kind.
    struct Groups {
        std::vector<std::vector<std::size_t>> of_kind;  ///< groups of each of kinds_
        std::size_t count = 0;
    };
    Groups groups() const {
        Groups result;
        const std::size_t shapes = result_.shapes.size();
        std::map<int, std::size_t> colours;
        for (const auto& [kind, symbols] : kinds_) {
            if (kind.colour) colours.try_emplace(*kind.colour, 0);
        }
        std::size_t next = 2 * shapes;
        for (auto& [colour, group] : colours) group = next++;
        for (const auto& [kind, symbols] : kinds_) {
            std::vector<std::size_t> own = {kind.shape, next++};
            if (kind.is_reflected) own.push_back(shapes + kind.shape);
            if (kind.colour) own.push_back(colours[*kind.colour]);
            result.of_kind.push_back(std::move(own));
        }
        result.count = next;
        return result;
    }
    /// The shares of groups among all tiles. @param sum  receives the number of tiles
    std::vector<double> shares(const Groups& groups, const std::map<Symbol, std::size_t>& index,
                               const std::vector<double>& counts, double& sum) const {
        std::vector<double> result(groups.count, 0);
        sum = 0;
        std::size_t number = 0;
        for (const auto& [kind, symbols] : kinds_) {
            double own = 0;
            for (const auto& [symbol, times] : symbols) own += counts[index.at(symbol)] * times;
            for (const std::size_t group : groups.of_kind[number]) result[group] += own;
            ++number;
            sum += own;
        }
        for (double& share : result) share /= sum;
        return result;
    }

    /// The eigenvector gives limits only where the numbers of successive steps tend to it: shares may alternate for
    /// ever. @param counts  the eigenvector
    void find_shares(const Rows& rows, const std::map<Symbol, std::size_t>& index,
                     const std::vector<double>& counts) {
        constexpr int longest = 5000, enough = 60;
        const Groups all = groups();
        double tiles = 0, tiles_before = 0;
        const std::vector<double> limit = shares(all, index, counts, tiles);
        std::vector<int> steady(all.count + 1,
                                0);  // steps for which each share, and the factor, was that of the limit
        std::vector<double> now = counts_in_axiom(index), next;
        for (int step = 0; step < longest; ++step) {
            const auto count = [&](std::size_t group, bool is_near) {
                steady[group] = is_near ? steady[group] + 1 : 0;
            };
            const double size = std::accumulate(now.begin(), now.end(), 0.0);
            if (!(size > 0)) return;
            for (double& value : now) value /= size;
            const std::vector<double> here = shares(all, index, now, tiles);
            for (std::size_t i = 0; i < all.count; ++i) count(i, std::fabs(here[i] - limit[i]) < accuracy);
            count(all.count, std::fabs(size * tiles - *result_.tiles * tiles_before) < accuracy * size * tiles);
            tiles_before = tiles;
            if (*std::min_element(steady.begin(), steady.end()) >= enough) break;
            next.assign(rows.size(), 0);
            for (std::size_t i = 0; i < rows.size(); ++i) {
                for (const auto& [j, times] : rows[i]) next[j] += now[i] * times;
            }
            now.swap(next);
        }
        take_shares(all, limit, steady, enough);
    }
    void take_shares(const Groups& all, const std::vector<double>& limit, const std::vector<int>& steady,
                     int enough) {
        const std::size_t shapes = result_.shapes.size();
        const auto settles = [&](std::size_t begin, std::size_t end) {
            const auto part = std::span(steady).subspan(begin, end - begin);
            return std::all_of(part.begin(), part.end(), [&](int steps) { return steps >= enough; });
        };
        const auto part = [&](std::size_t begin, std::size_t end) {
            const auto shares = std::span(limit).subspan(begin, end - begin);
            return std::vector<double>(shares.begin(), shares.end());
        };
        result_.is_average = steady[all.count] < enough;
        if (settles(0, shapes)) result_.frequencies = part(0, shapes);
        if (settles(shapes, 2 * shapes)) result_.reflected = part(shapes, 2 * shapes);
        const std::size_t kinds = all.count - kinds_.size();
        std::set<int> colours;
        bool is_known = settles(2 * shapes, kinds);
        std::size_t number = 0;
        for (const auto& [kind, symbols] : kinds_) {
            if (steady[kinds + number] >= enough) result_.counts[number].share = limit[kinds + number];
            is_known = is_known && kind.colour.has_value();
            if (kind.colour) colours.insert(*kind.colour);
            ++number;
        }
        std::size_t group = 2 * shapes;
        for (const int colour : colours) {
            if (is_known) result_.colours.emplace_back(colour, limit[group++]);
        }
    }

    /// Numbers of steps on the shortest paths from the first symbol to the others; empty if one is not reached.
    static std::vector<std::size_t> steps_from_first(const Rows& rows) {
        constexpr std::size_t unknown = ~std::size_t{0};
        std::vector<std::size_t> steps(rows.size(), unknown), reached = {0};
        steps[0] = 0;
        for (std::size_t next = 0; next < reached.size(); ++next) {
            for (const auto& [to, times] : rows[reached[next]]) {
                if (steps[to] != unknown) continue;
                steps[to] = steps[reached[next]] + 1;
                reached.push_back(to);
            }
        }
        if (reached.size() < rows.size()) steps.clear();
        return steps;
    }

    /// Greatest common divisor of the lengths of the cycles of an irreducible matrix (Denardo 1977); else 0.
    static std::size_t period_of(const Rows& rows) {
        if (rows.empty()) return 0;
        Rows back(rows.size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (const auto& [to, times] : rows[i]) back[to][i] = times;
        }
        const std::vector<std::size_t> steps = steps_from_first(rows);
        if (steps.empty() || steps_from_first(back).empty()) return 0;
        std::size_t period = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            for (const auto& [to, times] : rows[i]) {
                const std::size_t longer = steps[i] + 1;
                period = std::gcd(period, longer > steps[to] ? longer - steps[to] : steps[to] - longer);
            }
        }
        return period;
    }

    /// The symbols that others follow in their branch, at some step, so that their moves and turns move these. What
    /// follows a symbol also follows the last symbol of its successor.
    std::vector<char> followed() const {
        std::vector<char> result(grammar_.symbols().size());
        const auto note = [&](const Word& word, bool is_last_followed) {
            bool changes = false;
            for (std::size_t i = 0; i < word.size(); ++i) {
                const bool is_followed = i + 1 < word.size()
                                             ? grammar_.symbols()[word[i + 1]].command.action != Action::pop
                                             : is_last_followed;
                changes |= is_followed && result[word[i]] == 0;
                result[word[i]] |= is_followed ? 1 : 0;
            }
            return changes;
        };
        note(grammar_.axiom(), false);
        for (bool changes = true; changes;) {
            changes = false;
            for (const Symbol each : symbols_) {
                const Word* successor = grammar_.tables().front().successor(each);
                if (successor) changes |= note(*successor, result[each] != 0);
            }
        }
        return result;
    }

    /// The move of a word of symbols of the finished word, branches left out.
    Move move_of(const Word& word, bool interprets) const {
        Move result;
        int depth = 0;
        for (const Symbol symbol : word) {
            const Command& command = grammar_.symbols()[symbol].command;
            if (command.action == Action::push) ++depth;
            if (command.action == Action::pop) --depth;
            if (depth > 0 || command.action == Action::pop) continue;
            Move step;
            if (interprets) {
                step = move_of(interpreted(symbol), false);
            } else if (command.is_step()) {
                step.way = {command.value, 0};
            } else if (command.action == Action::turn) {
                step.turn =
                    command.angle.exact ? unit_vector(*command.angle.exact) : unit_vector(command.angle.degrees);
            }
            result.way += complex_product(result.turn, step.way);
            result.turn = complex_product(result.turn, step.turn);
        }
        return result;
    }

    void find_length() {
        std::optional<glm::dvec2> factor;
        const std::vector<char> is_followed = followed();
        for (const Symbol symbol : symbols_) {
            const Move own = move_of({symbol}, true);
            const double square = scalar_product(own.way, own.way);
            const Word* successor = grammar_.tables().front().successor(symbol);
            if (square < accuracy && (!successor || is_followed[symbol] == 0)) continue;
            // Modules with the values of the last step have no productions in the plain form.
            if (!successor && has_parameters_ && !grammar_.symbols()[symbol].arguments.empty()) continue;
            const Move next = successor ? move_of(*successor, true) : own;
            const bool is_turned = glm::distance(next.turn, own.turn) > accuracy;
            const bool begins_to_move = square < accuracy && scalar_product(next.way, next.way) > accuracy;
            const glm::dvec2 ratio =
                square < accuracy ? glm::dvec2(0.0) : complex_product(next.way, {own.way.x, -own.way.y}) / square;
            if (is_turned || begins_to_move ||
                (square >= accuracy && factor && glm::distance(ratio, *factor) > accuracy)) {
                result_.no_length = "the moves are not multiplied by one number";
                return;
            }
            if (square < accuracy) continue;
            factor = ratio;
        }
        if (!factor) {
            result_.no_length = "there are no moves";
            return;
        }
        const double square = scalar_product(*factor, *factor);
        if (result_.tiles && std::fabs(square - *result_.tiles) > 1e-6 * square) {
            result_.no_length = "the square of the moves' factor is not that of the number of tiles";
            return;
        }
        result_.length = std::sqrt(square);
        result_.turn = std::atan2(factor->y, factor->x) * 180 / std::numbers::pi;
    }

    const Grammar& grammar_;
    bool has_parameters_;
    TileGrowth result_;
    std::vector<Symbol> symbols_;                            // reachable, sorted
    std::map<Kind, std::map<Symbol, std::uint32_t>> kinds_;  // how many of them each symbol draws
};

/// a + b √d for whole numbers or halves, or empty.
std::string quadratic_form(double value) {
    if (std::fabs(value - (1 + std::sqrt(5.0)) / 2) < accuracy) return "τ";
    if (std::fabs(value - std::round(value)) < accuracy * value) return fmt::format("{:.0f}", value);
    // A root of x^2 - p x + q.
    for (int p = 0; p <= 40; ++p) {
        const double q = value * (p - value);
        if (std::fabs(q) > 400 || std::fabs(q - std::round(q)) > 1e-8 * (1 + value)) continue;
        auto under = static_cast<std::int64_t>(p * p - 4 * std::llround(q));
        if (under <= 0 || value < p / 2.0) continue;
        std::int64_t outside = 1;
        for (std::int64_t root = 2; root * root <= under; ++root) {
            while (under % (root * root) == 0) {
                under /= root * root;
                outside *= root;
            }
        }
        if (p % 2 == 0 && outside % 2 == 0) {
            const std::string root =
                (outside == 2 ? "√" : fmt::format("{} √", outside / 2)) + fmt::format("{}", under);
            return p == 0 ? root : fmt::format("{} + {}", p / 2, root);
        }
        return fmt::format("({} + {}√{}) / 2", p, outside == 1 ? "" : fmt::format("{} ", outside), under);
    }
    return {};
}

}  // namespace

std::string closed_form(double value) {
    if (std::string form = quadratic_form(value); !form.empty()) return form;
    const std::string square = quadratic_form(value * value);
    if (square.empty()) return {};
    return square.find(' ') == std::string::npos ? "√" + square : fmt::format("√({})", square);
}

TileGrowth find_growth(const Grammar& grammar) {
    const auto plain = plain_form(grammar);
    if (plain && plain->whole_word_steps() == 0) return GrowthFinder(*plain, !grammar.is_plain()).find();
    TileGrowth growth;
    growth.unknown = "productions with contexts or random choices, or with parameters of too many values";
    return growth;
}

}  // namespace sikku
