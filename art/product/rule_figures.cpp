#include "art/product/rule_figures.h"

#include "art/product/highlight.h"
#include "art/writer/make_drawing.h"
#include "engine/base/characters.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/derivation/lineage.h"
#include "engine/derivation/neighbourhood.h"
#include "engine/geometry/turtle.h"
#include "engine/language/undrawn.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_figures = 24;
constexpr double node_share = 0.03, letter_share = 0.1;  // of the size of a drawing

/// A production of the file, with a word that it replaces and the successor, if they are known.
struct ShownProduction {
    std::string before, after;
    const Production* production = nullptr;
    std::optional<ModuleWord> predecessor, successor;
};

/// The text on one line, with minus signs instead of hyphens.
std::string in_one_line(std::string_view text) {
    const std::string words = fmt::format("{}", fmt::join(split_words(text, " \t\n\r"), " "));
    std::string result;
    for (const char byte : words) {
        if (byte == '-') {
            result += "−";
        } else {
            result += byte;
        }
    }
    return result;
}

/// Returns the productions of all tables, each once, without those that replace a word by itself.
std::vector<ShownProduction> productions_of(const Document& document) {
    const Pattern& pattern = document.pattern();
    const std::vector<Table>& tables = document.grammar().tables();
    std::vector<ShownProduction> list;
    std::set<std::uint32_t> shared;  // productions before the first table are in all of them
    for (std::size_t t = 0; t < tables.size(); ++t) {
        for (const Production& production : tables[t].productions()) {
            const std::size_t common = pattern.common.size();
            if (production.text < common && !shared.insert(production.text).second) continue;
            if (production.predecessor == production.successor && production.arguments.empty()) continue;
            const bool has_text = production.text < common || t < pattern.tables.size();
            ShownProduction shown;
            shown.production = &production;
            if (has_text) {
                const ProductionText& text = production.text < common
                                                 ? pattern.common[production.text]
                                                 : pattern.tables[t].productions[production.text - common];
                const std::string whole(text.whole.view());
                const std::size_t arrow = whole.find("-->");
                shown.before = in_one_line(std::string_view(whole).substr(0, arrow));
                shown.after = in_one_line(std::string_view(whole).substr(std::min(arrow, whole.size() - 3) + 3));
                if (tables.size() > 1)
                    shown.before = fmt::format(
                        "{}: {}", pattern.tables.size() > t ? pattern.tables[t].name.view() : "", shown.before);
            }
            if (shown.after.empty()) shown.after = "ε";
            list.push_back(std::move(shown));
        }
    }
    return list;
}

bool has_modules(const Grammar& grammar, const Word& word) {
    return std::any_of(word.begin(), word.end(), [&](Symbol symbol) { return grammar.symbols()[symbol].arity > 0; });
}

/// The symbols from `begin` to `end` of a word, with their parameters.
ModuleWord module_part(const Grammar& grammar, const ModuleWord& word, std::size_t begin, std::size_t end) {
    ModuleWord part;
    std::size_t argument = 0;
    for (std::size_t i = 0; i < end; ++i) {
        const std::uint32_t arity = grammar.symbols()[word.symbols[i]].arity;
        if (i >= begin) {
            part.symbols.push_back(word.symbols[i]);
            part.arguments.insert(part.arguments.end(),
                                  word.arguments.begin() + static_cast<std::ptrdiff_t>(argument),
                                  word.arguments.begin() + static_cast<std::ptrdiff_t>(argument + arity));
        }
        argument += arity;
    }
    return part;
}

/// Finds the first application of each production with parameters, in words of up to 20,000 symbols.
class ApplicationFinder {
public:
    ApplicationFinder(const Grammar& grammar, std::vector<ShownProduction>& list, double nodes,
                      const Monitor& monitor)
        : grammar_(grammar),
          most_(std::min(nodes, most_symbols)),
          monitor_(monitor),
          options_(DerivationOptions::within(nodes, [this](std::uint64_t) { monitor_.check(); })),
          work_(options_) {
        options_.longest_word = std::min(options_.longest_word, longest);
        for (ShownProduction& shown : list) {
            const Production& production = *shown.production;
            if (has_modules(grammar, production.predecessor) || has_modules(grammar, production.successor)) {
                missing_[&production] = &shown;
            } else {
                shown.predecessor = ModuleWord{production.predecessor, {}, {}};
                shown.successor = ModuleWord{production.successor, {}, {}};
            }
        }
        left_ = missing_.size();
        for (const Table& table : grammar.tables()) {
            std::vector<ShownProduction*>& row = shown_.emplace_back();
            for (const Production& production : table.productions()) row.push_back(shown_as(production));
        }
    }

    /// False if the derivation is longer than its limits, and productions are missing.
    bool find() {
        ModuleWord word = grammar_.axiom_modules();
        double visited = 0;
        std::int64_t number = 0;
        for (const ScheduleRun& run : grammar_.schedule()) {
            for (std::int64_t i = 0; i < run.steps && left_ > 0; ++i) {
                monitor_.check();
                visited += static_cast<double>(word.symbols.size()) + 1;
                if (visited > most_) return false;
                StepOrigins origins;
                ModuleWord next;
                try {
                    next = rewrite(grammar_, grammar_.tables()[run.table], word, ++number, options_, work_, origins);
                } catch (const BudgetError&) {
                    return false;
                }
                note(run.table, word, next, origins);
                word = std::move(next);
            }
        }
        return true;
    }

private:
    static constexpr double most_symbols = 20e6;  // of all words together
    static constexpr std::uint64_t longest = 20'000;

    /// Productions before the first table have a copy in each table.
    ShownProduction* shown_as(const Production& production) const {
        const auto found = missing_.find(&production);
        if (found != missing_.end()) return found->second;
        if (grammar_.tables().size() == 1) return nullptr;
        const auto copy = std::find_if(missing_.begin(), missing_.end(), [&](const auto& one) {
            return one.first->text == production.text && one.first->predecessor == production.predecessor &&
                   one.first->successor == production.successor;
        });
        return copy == missing_.end() ? nullptr : copy->second;
    }

    void note(std::size_t number, const ModuleWord& word, const ModuleWord& next, const StepOrigins& origins) {
        const Table& table = grammar_.tables()[number];
        for (std::size_t at = 0; at < origins.applied.size(); ++at) {
            if (origins.applied[at] >= table.productions().size()) continue;
            const std::size_t end = at + table.productions()[origins.applied[at]].predecessor.size();
            ShownProduction* const shown = shown_[number][origins.applied[at]];
            if (shown && !shown->predecessor) {
                const auto first = std::lower_bound(origins.parents.begin(), origins.parents.end(), at);
                const auto last = std::upper_bound(origins.parents.begin(), origins.parents.end(), at);
                shown->predecessor = module_part(grammar_, word, at, end);
                shown->successor =
                    module_part(grammar_, next, static_cast<std::size_t>(first - origins.parents.begin()),
                                static_cast<std::size_t>(last - origins.parents.begin()));
                --left_;
            }
            at = end - 1;
        }
    }

    const Grammar& grammar_;
    double most_;
    const Monitor& monitor_;
    DerivationOptions options_;
    MatchingWork work_;
    std::map<const Production*, ShownProduction*> missing_;
    std::vector<std::vector<ShownProduction*>> shown_;  ///< by table and production; null: known before
    std::size_t left_ = 0;                              ///< productions without an application
};

/// Why productions are not drawn: a few sentences, and the number of the others.
class Remarks {
public:
    void add(const ShownProduction& shown, const std::string& what, bool is_empty) {
        constexpr std::size_t most_sentences = 3;
        if (sentences_.size() < most_sentences) {
            sentences_.push_back(shortened(fmt::format("{} → {}", shown.before, shown.after)) + what);
        } else {
            ++further_;
            are_empty_ = are_empty_ && is_empty;
        }
    }
    std::vector<std::string> sentences() && {
        if (further_ > 0) {
            const bool is_one = further_ == 1;
            sentences_.push_back(fmt::format("… and {} further {} {}", further_,
                                             is_one ? "production" : "productions",
                                             are_empty_ ? (is_one ? "draws nothing" : "draw nothing")
                                                        : (is_one ? "is not drawn" : "are not drawn")));
        }
        return std::move(sentences_);
    }

private:
    static std::string shortened(const std::string& text) {
        constexpr std::size_t most = 48;  // characters
        std::size_t characters = 0;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (is_continuation(text[i])) continue;
            if (characters++ == most) return text.substr(0, i) + "…";
        }
        return text;
    }

    std::vector<std::string> sentences_;
    std::size_t further_ = 0;
    bool are_empty_ = true;  ///< all further ones draw nothing
};

/// Returns the letters that draw nothing and that productions replace.
std::vector<std::string> node_letters(const Grammar& grammar) {
    std::set<std::string> names;
    for (const Table& table : grammar.tables()) {
        for (const Production& production : table.productions()) {
            for (const Symbol symbol : production.predecessor) {
                const SymbolInfo& info = grammar.symbols()[symbol];
                const bool is_cut = grammar.cut() && symbol == *grammar.cut();
                if (info.command.action != Action::pass || is_cut) continue;
                if (std::isalpha(static_cast<unsigned char>(info.letter.front())) == 0 && info.letter.size() == 1) {
                    continue;
                }
                names.insert(info.letter);
            }
        }
    }
    return {names.begin(), names.end()};
}

/// Returns the pattern with labels for its nodes.
Document with_letters(const Document& document) {
    std::vector<Setting> settings;
    for (const std::string& letter : node_letters(document.grammar())) {
        settings.emplace_back("rule", "label " + letter, letter);
    }
    if (settings.empty()) return document;
    try {
        return document.with(settings);
    } catch (const PatternError&) {
        return document;  // the letters already have labels
    }
}

/// Builds words of commands with exact places, which no production reads.
class CommandWord {
public:
    explicit CommandWord(const Grammar& grammar) { parts_.symbols = grammar.symbols(); }

    void add(Symbol symbol) { parts_.axiom.push_back(symbol); }
    void add(Action action, double value = 0) {
        SymbolInfo info;
        info.command.action = action;
        info.command.value = value;
        add(std::move(info));
    }
    void turn(double degrees) {
        if (degrees == 0) return;
        SymbolInfo info;
        info.command.action = Action::turn;
        info.command.angle = angle_of_degrees(degrees);
        add(std::move(info));
    }
    /// Moves by a vector; `heading` is that of the turtle in degrees, and changes.
    void move(glm::dvec2 by, double& heading, bool is_vertex) {
        const double length = glm::length(by);
        if (length == 0) return;
        const double direction = std::atan2(by.y, by.x) * 180 / std::numbers::pi;
        turn(std::remainder(direction - heading, 360));
        heading = direction;
        SymbolInfo info;
        info.command.action = Action::move;
        info.command.value = length;
        info.command.is_vertex = is_vertex;
        add(std::move(info));
    }
    void dot(glm::dvec2 at, double heading, double radius, int colour) {
        add(Action::push);
        move(at, heading, false);
        add(Action::colour_set, colour);
        add(Action::disc, radius);
        add(Action::pop);
    }
    void rectangle(const Box& box, double heading, int colour) {
        add(Action::push);
        add(Action::colour_set, colour);
        move(box.low, heading, false);
        add(Action::polygon_begin);
        const glm::dvec2 size = box.high - box.low;
        move({size.x, 0}, heading, true);
        move({0, size.y}, heading, true);
        move({-size.x, 0}, heading, true);
        move({0, -size.y}, heading, true);
        add(Action::polygon_end);
        add(Action::pop);
    }
    std::vector<SymbolInfo>& symbols() { return parts_.symbols; }
    std::shared_ptr<const Grammar> grammar(const Grammar& model) && {
        return std::make_shared<const Grammar>(model.with_parts(std::move(parts_)));
    }

private:
    void add(SymbolInfo info) {
        parts_.axiom.push_back(static_cast<Symbol>(parts_.symbols.size()));
        parts_.symbols.push_back(std::move(info));
    }
    Grammar::PlainParts parts_;
};

class FigureMaker {
public:
    FigureMaker(const Document& document, const Style& given, double nodes, const Monitor& monitor)
        : document_(with_letters(document)), grammar_(document_.grammar()), nodes_(nodes), monitor_(monitor) {
        for (const std::string& letter : node_letters(document.grammar())) nodes_letters_.insert(letter);
        style_ = plain(given);
    }

    RuleFigures make() {
        RuleFigures result;
        std::vector<ShownProduction> list = productions_of(document_);
        const bool is_whole = ApplicationFinder(grammar_, list, nodes_, monitor_).find();
        const std::string unused =
            is_whole ? fmt::format(" is not drawn: no step up to n = {} applies it", grammar_.steps())
                     : " is not drawn: an application was not found within the budget";
        Remarks remarks;
        std::size_t left_out = 0;
        for (const ShownProduction& shown : list) {
            if (!shown.predecessor) {
                remarks.add(shown, unused, false);
                continue;
            }
            try {
                auto figure = figure_of(shown);
                if (!figure) {
                    remarks.add(shown, " draws nothing", true);
                } else if (result.figures.size() == most_figures) {
                    ++left_out;
                } else {
                    result.figures.push_back(std::move(*figure));
                }
            } catch (const WordError& error) {
                remarks.add(shown, fmt::format(" is not drawn alone: {}", error.what()), false);
            }
        }
        result.sentences = std::move(remarks).sentences();
        if (left_out > 0) {
            result.sentences.push_back(
                fmt::format("productions after the first {} are left out: {}", most_figures, left_out));
        }
        result.style = style_;
        return result;
    }

private:
    Style plain(const Style& given) {
        // A line of two millimetres on a page of A4, on which the drawing would fill the margins.
        constexpr double least_line = 2;
        Style style = given;
        moves_draw_ = given.moves_draw();
        if (!style.stroke.in_steps && style.stroke.value > 0 && style.stroke.value < least_line) {
            style.stroke.unit *= least_line / style.stroke.value;
            style.stroke.value = least_line;
        }
        style.line = Line::straight;
        style.hand = 0;
        style.fields.reset();
        style.weave.reset();
        style.parallel = {};
        style.dots.reset();
        style.border.reset();
        style.floor.reset();
        style.tile_colours.reset();
        style.tile_edges = TileEdges::each;
        style.decoration = {};
        letter_colour_ = static_cast<int>(style.palette.size());
        const Colour ink = lit_colours(given.ground).front();
        style.palette.push_back(ink);
        style.palette.push_back(tint(ink, given.ground, 0.16));
        return style;
    }

    Grammar written(const ModuleWord& word) const {
        const Table* interpretation = grammar_.interpretation();
        const auto out =
            grammar_.written_out(interpretation ? rewrite(grammar_, *interpretation, word, 1, {}, nullptr) : word);
        if (!out) throw WordError("it has too many different modules");
        if (!moves_draw_) return *out;
        // The points of splines, as a straight line.
        Grammar::PlainParts parts{out->symbols(), out->axiom(), {}, std::nullopt};
        for (SymbolInfo& info : parts.symbols) {
            if (info.command.action == Action::move) info.command.action = Action::draw;
        }
        return out->with_parts(std::move(parts));
    }

    static bool has(const Grammar& grammar, bool (*holds)(Action)) {
        return std::any_of(grammar.axiom().begin(), grammar.axiom().end(),
                           [&](Symbol symbol) { return holds(grammar.symbols()[symbol].command.action); });
    }
    bool is_node(const SymbolInfo& info) const {
        return info.command.action == Action::label && nodes_letters_.contains(info.letter);
    }

    std::optional<RuleFigure> figure_of(const ShownProduction& shown) {
        const Grammar before = written(*shown.predecessor), after = written(*shown.successor);
        constexpr auto draws = [](Action action) { return is_ink(action) && action != Action::label; };
        constexpr auto steps = [](Action action) { return action == Action::draw || action == Action::move; };
        const bool shows_before = has(before, draws), shows_after = has(after, draws);
        const bool has_nodes = std::any_of(after.axiom().begin(), after.axiom().end(),
                                           [&](Symbol symbol) { return is_node(after.symbols()[symbol]); });
        if (!shows_before && !shows_after && !(has_nodes && has(after, steps))) return std::nullopt;
        RuleFigure figure{shown.before, shown.after, nullptr, nullptr};
        if (grammar_.is_spatial()) {
            const double seen = spatial_size(after), size = seen > 0 ? seen : 1.0;
            figure.predecessor = decorated(before, size, nullptr, 1, 0);
            figure.successor = decorated(after, size, nullptr, 1, 0);
            return figure;
        }
        const Survey from = surveyed(before), to = surveyed(after);
        const Box box{to.box.low, to.box.high};
        const double size = std::max(box.longest(), 1.0);
        const bool is_tile =
            before.axiom().size() == 1 && is_node(before.symbols()[before.axiom().front()]) && box.longest() > 0;
        if (is_tile) {
            Box tile = box;
            tile.add(box.low, 0.08 * size);
            tile.add(box.high, 0.08 * size);
            figure.predecessor = tile_of(before, size, tile, to);
            figure.successor = decorated(after, size, &tile, 1, 0);
            return figure;
        }
        // Tiles grow as steps do. If no production replaces steps, they are cells, which keep their size.
        const bool are_tiles = from.polygons > 0 && to.polygons > 0;
        glm::dvec2 growth = are_tiles ? growth_of_steps() : quotient(to.end, from.end);
        figure.is_cell = are_tiles && glm::length(growth) == 0;
        if (!shows_before || glm::length(growth) == 0) growth = {1, 0};
        const double scale = glm::length(growth);
        const double turn = std::atan2(growth.y, growth.x) * 180 / std::numbers::pi;
        figure.predecessor = decorated(before, size, nullptr, scale, turn);
        figure.successor = decorated(after, size, nullptr, 1, 0);
        return figure;
    }

    /// The similarity that takes `from` to `to`, as a complex number; 0 if one of them is 0.
    static glm::dvec2 quotient(glm::dvec2 to, glm::dvec2 from) {
        const double square = glm::dot(from, from);
        if (square < 1e-18 || glm::dot(to, to) < 1e-18) return {0, 0};
        return glm::dvec2(glm::dot(to, from), to.y * from.x - to.x * from.y) / square;
    }
    /// Factor by which the first production that replaces a turtle step enlarges it; 0 if no production does.
    glm::dvec2 growth_of_steps() const {
        for (const Table& table : grammar_.tables()) {
            for (const Production& production : table.productions()) {
                const Word& word = production.predecessor;
                if (word.size() != 1 || !grammar_.symbols()[word.front()].command.is_step()) continue;
                if (has_modules(grammar_, word) || has_modules(grammar_, production.successor)) continue;
                const glm::dvec2 growth = quotient(surveyed(written({production.successor, {}, {}})).end,
                                                   surveyed(written({word, {}, {}})).end);
                if (glm::length(growth) > 0) return growth;
            }
        }
        return {0, 0};
    }

    Survey surveyed(const Grammar& grammar) const {
        const auto turtle = Turtle::surveying(grammar);
        derive(grammar, *turtle);
        return turtle->survey();
    }
    double spatial_size(const Grammar& grammar) const {
        Reading reading;
        reading.monitor = monitor_;
        DrawingOptions options;
        options.may_be_empty = true;
        const Box box = make_drawing(grammar, style_, options, reading)->seen().box;
        return box.empty() ? 0 : box.longest();
    }

    double heading() const { return grammar_.heading().degrees; }

    /// Returns the word with dots and names for its nodes, scaled and turned.
    std::shared_ptr<const Grammar> decorated(const Grammar& word, double size, const Box* tile, double scale,
                                             double turn) const {
        CommandWord built(word);
        if (tile) built.rectangle(*tile, heading(), letter_colour_ + 1);
        for (SymbolInfo& info : built.symbols()) {
            if (!info.command.is_step() || scale == 1) continue;
            info.command.value *= scale;
            info.command.edge = 0;
        }
        built.turn(turn);
        for (const Symbol symbol : word.axiom()) {
            if (!is_node(word.symbols()[symbol])) {
                built.add(symbol);
                continue;
            }
            built.add(Action::push);
            built.add(Action::colour_set, letter_colour_);
            built.add(Action::disc, node_share * size);
            built.turn(135);  // away from lines that are straight or turn at right angles
            built.add(Action::move, 1.4 * letter_share * size);
            built.add(Action::width_set, letter_width(size));
            built.add(symbol);
            built.add(Action::pop);
        }
        return std::move(built).grammar(*lettered(size));
    }

    /// A node as a tile: its name in the middle, a dot where its drawing begins and a ring where it ends.
    std::shared_ptr<const Grammar> tile_of(const Grammar& word, double size, const Box& tile,
                                           const Survey& to) const {
        CommandWord built(word);
        built.rectangle(tile, heading(), letter_colour_ + 1);
        built.dot({0, 0}, heading(), node_share * size, letter_colour_);
        built.dot(to.end, heading(), node_share * size, letter_colour_);
        built.dot(to.end, heading(), 0.6 * node_share * size, letter_colour_ + 1);
        built.add(Action::colour_set, letter_colour_);
        double direction = heading();
        built.move((tile.low + tile.high) / 2.0, direction, false);
        built.add(Action::width_set, 2 * letter_width(size));
        built.add(word.axiom().front());
        return std::move(built).grammar(*lettered(2 * size));
    }

    /// Width of the strokes of letters, in the unit of widths in words.
    double letter_width(double size) const {
        constexpr double of_page = 190;  // millimetres that a drawing fills on A4
        const double share = 0.011;
        if (!style_.stroke.in_steps) return share * of_page / style_.stroke.unit;
        // Wide lines are made narrower, and letters with them.
        return std::max(1.4 * share * size, 0.25 * style_.stroke.value) / style_.stroke.unit;
    }

    /// The settings of the pattern, with letters in proportion to a size.
    std::shared_ptr<const Grammar> lettered(double size) const {
        const Document document = document_.with(
            {Setting("rule", "lettering", fmt::format("{:.6f}", std::clamp(letter_share * size, 1e-6, 1e6)))});
        return std::make_shared<const Grammar>(*document.grammar().written_out({}));
    }

    Document document_;
    const Grammar& grammar_;
    std::set<std::string> nodes_letters_;
    double nodes_;
    const Monitor& monitor_;
    Style style_;
    int letter_colour_ = 0;
    bool moves_draw_ = false;
};

}  // namespace

RuleFigures rule_figures(const Document& document, const Style& style, double nodes, const Monitor& monitor) {
    require_word(document.grammar());
    return FigureMaker(document, style, nodes, monitor).make();
}

}  // namespace sikku
