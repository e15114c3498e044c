#include "engine/language/edge_reader.h"

#include "engine/base/decimal.h"
#include "engine/base/keys.h"
#include "engine/base/roots_of_unity.h"
#include "engine/language/unit_vector.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t most_headings = std::int64_t{1} << 20;
constexpr double rounding = 1e-9;

/// The path of a word: its turn, and how often each step occurs in each heading.
struct Way {
    std::int64_t headings = 1;  ///< 0: degrees are used
    std::int64_t heading = 0;
    double degrees = 0;
    std::map<std::pair<std::int64_t, double>, std::int64_t> steps;  ///< by heading and length, if headings > 0
    glm::dvec2 end{0.0};
    double length = 0;  ///< of the whole path

    bool turns() const { return headings > 0 ? heading != 0 : std::fabs(std::remainder(degrees, 360.0)) > rounding; }
};

Way way_of(const Word& word, const std::vector<SymbolInfo>& symbols) {
    Way way;
    for (const Symbol symbol : word) {
        const Command& command = symbols[symbol].command;
        if (command.action != Action::turn || way.headings == 0) continue;
        const auto& exact = command.angle.exact;
        way.headings = exact && exact->denominator <= most_headings ? std::lcm(way.headings, exact->denominator) : 0;
        if (way.headings > most_headings) way.headings = 0;
    }
    for (const Symbol symbol : word) {
        const Command& command = symbols[symbol].command;
        if (command.action == Action::turn) {
            if (way.headings > 0) {
                const TurnFraction turn = *command.angle.exact;
                way.heading = (way.heading + turn.numerator * (way.headings / turn.denominator)) % way.headings;
                if (way.heading < 0) way.heading += way.headings;
            } else {
                way.degrees = std::fmod(way.degrees + command.angle.degrees, 360.0);
            }
        } else {
            way.length += std::fabs(command.value);
            if (way.headings > 0) {
                ++way.steps[{way.heading, command.value}];
            } else {
                way.end += command.value * unit_vector(way.degrees);
            }
        }
    }
    for (const auto& [step, count] : way.steps) {
        const auto& [heading, length] = step;
        const std::int64_t divisor = std::gcd(heading, way.headings);
        way.end += static_cast<double>(count) * length *
                   unit_vector(TurnFraction{heading / divisor, way.headings / divisor});
    }
    return way;
}

/// End of a path, found without rounding.
struct ExactEnd {
    bool is_real = true;  ///< straight ahead or behind
    bool is_zero = true;
};

/// Compares the end with its mirror image. Nullopt if the steps do not lie on an exact lattice.
std::optional<ExactEnd> exact_end(const Way& way) {
    const int rank = lattice_rank(way.headings);
    if (rank == 0) return std::nullopt;
    std::int64_t denominator = 1;
    for (const auto& [step, count] : way.steps) {
        const std::int64_t needed = decimal_denominator(step.second);
        denominator = needed == 0 ? 0 : std::lcm(denominator, needed);
        if (denominator == 0 || denominator > largest_denominator) return std::nullopt;
    }
    const auto powers = powers_of_root(static_cast<int>(way.headings));
    std::array<std::int64_t, most_coordinates> sum{}, difference{};
    if (!(way.length * static_cast<double>(denominator) <= 0x1p40)) return std::nullopt;
    for (const auto& [step, count] : way.steps) {
        const auto heading = static_cast<std::size_t>(step.first);
        const std::int64_t times = count * std::llround(step.second * static_cast<double>(denominator));
        for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
            sum[i] += times * powers[heading][i];
            difference[i] += times * (powers[heading][i] - powers[(powers.size() - heading) % powers.size()][i]);
        }
    }
    const auto is_zero = [](std::int64_t coordinate) { return coordinate == 0; };
    return ExactEnd{std::all_of(difference.begin(), difference.end(), is_zero),
                    std::all_of(sum.begin(), sum.end(), is_zero)};
}

std::string degrees_text(double degrees) {
    return fmt::format("{:.6g} degrees to the {}", std::fabs(degrees), degrees > 0 ? "left" : "right");
}

}  // namespace

EdgeReader::EdgeReader(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics)
    : reader_(reader), diagnostics_(diagnostics) {
    const std::string_view before = find_language_key("edge L")->before_symbol();
    for (const Key& key : pattern.keys) {
        const auto named = reader.symbol_of(key, before);
        if (!named) continue;
        const auto [symbol, name] = *named;
        if (key.value.empty()) {
            diagnostics.error(key.name_at, "the edge is empty: expected a word such as -f++f-");
            continue;
        }
        std::vector<Expression> arguments;
        auto word = reader.word(key.value, WordPlace::axiom_or_successor, &arguments);
        if (!word) continue;
        if (!arguments.empty()) {
            diagnostics.error(key.value,
                              "the parameters in the word of an edge must be constants: productions give "
                              "this symbol variable parameters");
            continue;
        }
        if (word->size() > most_edge_symbols) {
            diagnostics.error(
                key.value,
                fmt::format("the word of an edge has at most 1,000,000 symbols; this one has {}", word->size()));
            continue;
        }
        lines_.push_back({symbol, name, key.value, std::move(*word)});
    }
}

void EdgeReader::add_to(CommandSettings& settings) const {
    for (const Line& line : lines_) {
        const SymbolInfo& symbol = reader_.symbols()[line.symbol];
        const Action action = command_of(symbol, settings).action;
        if (action == Action::pass) {
            settings.forward.insert(symbol.letter);
        } else if (action != Action::draw && action != Action::move) {
            diagnostics_.error(
                line.name,
                fmt::format("'{}' is already a command of the turtle; expected another symbol", symbol.letter));
        }
    }
}

/// True if the word contains only moves and turns; otherwise reports an error.
bool EdgeReader::check(const Line& line, const std::vector<SymbolInfo>& symbols) const {
    for (const Symbol symbol : line.word) {
        const SymbolInfo& info = symbols[symbol];
        const Action action = info.command.action;
        std::string problem;
        const auto has_letter = [&](const Line& other) { return symbols[other.symbol].letter == info.letter; };
        if (std::any_of(lines_.begin(), lines_.end(), has_letter)) {
            problem = "is an edge itself";
        } else if (action == Action::draw) {
            problem = "draws";
        } else if (action != Action::move && action != Action::turn) {
            problem = "neither moves nor turns";
        } else if (!std::isfinite(info.command.value) || !std::isfinite(info.command.angle.degrees)) {
            problem = "has a parameter that is not finite";
        } else {
            continue;
        }
        return diagnostics_.refuse(line.value, fmt::format("'{}' {}; the word of an edge consists of moves and turns",
                                                           symbol_text(info), problem));
    }
    return true;
}

std::optional<EdgeLength> EdgeReader::measure(const Line& line, const std::vector<SymbolInfo>& symbols) const {
    const Way way = way_of(line.word, symbols);
    if (way.turns()) {
        const double degrees = way.headings > 0
                                   ? 360.0 * static_cast<double>(way.heading) / static_cast<double>(way.headings)
                                   : way.degrees;
        return diagnostics_.refuse(
            line.value, fmt::format("the word ends at another heading, turned by {}; expected that of its start",
                                    degrees_text(std::remainder(degrees, 360.0))));
    }
    const auto exact = exact_end(way);
    const double slack = rounding * way.length;
    if (exact ? exact->is_zero : std::hypot(way.end.x, way.end.y) <= slack) {
        return diagnostics_.refuse(line.value, "the word ends where it starts: an edge needs a length");
    }
    if (exact ? !exact->is_real : std::fabs(way.end.y) > slack) {
        return diagnostics_.refuse(
            line.value, fmt::format("the word ends {} of its start; expected a place straight ahead",
                                    degrees_text(std::atan2(way.end.y, way.end.x) * 180 / std::numbers::pi)));
    }
    EdgeLength edge{symbols[line.symbol].letter, way.end.x, {}};
    if (!exact) {
        diagnostics_.warning(line.value,
                             "no exact lattice has these angles and lengths: the edge is drawn in doubles");
        return edge;
    }
    for (const auto& [step, count] : way.steps) {
        const std::int64_t divisor = std::gcd(step.first, way.headings);
        edge.parts.push_back({{step.first / divisor, way.headings / divisor}, step.second, count});
    }
    return edge;
}

std::vector<EdgeLength> EdgeReader::measure(std::vector<SymbolInfo>& symbols) const {
    std::vector<EdgeLength> edges;
    for (const Line& line : lines_) {
        if (!check(line, symbols)) continue;
        if (auto edge = measure(line, symbols)) edges.push_back(std::move(*edge));
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (SymbolInfo& symbol : symbols) {
            if (symbol.letter != edges[i].letter) continue;
            symbol.command.value *= edges[i].length;
            symbol.command.edge = static_cast<std::uint32_t>(i + 1);
        }
    }
    return edges;
}

}  // namespace sikku
