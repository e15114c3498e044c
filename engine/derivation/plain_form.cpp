#include "engine/derivation/plain_form.h"

#include "engine/derivation/choice.h"

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_modules = 100'000;
constexpr std::size_t most_rewriting = 50'000'000;  // modules of all steps and symbols of all successors

/// Numbers modules by their letters and values, and writes productions between the numbers.
class PlainWriter {
public:
    explicit PlainWriter(const Grammar& grammar) : grammar_(grammar), written_(grammar.tables().size()) {
        parts_.tables.resize(grammar.tables().size());
    }

    std::optional<Grammar::PlainParts> write() {
        const ModuleWord& axiom = grammar_.axiom_modules();
        const double* next = axiom.arguments.data();
        for (const Symbol symbol : axiom.symbols) {
            const std::uint32_t arity = grammar_.symbols()[symbol].arity;
            parts_.axiom.push_back(number(symbol, {next, arity}));
            next += arity;
        }
        std::vector<Symbol> reached = parts_.axiom;
        std::vector<char> is_reached;
        tidy(reached, is_reached);
        for (const ScheduleRun& run : grammar_.schedule()) {
            for (std::int64_t step = 0; step < run.steps; ++step) {
                std::vector<Symbol> after =
                    rewritten(grammar_.tables()[run.table], reached, written_[run.table], parts_.tables[run.table]);
                tidy(after, is_reached);
                if (is_too_much_) return std::nullopt;
                // Nothing changes any more under this table.
                if (after == reached) break;
                reached = std::move(after);
            }
        }
        if (const Table* interpretation = grammar_.interpretation()) {
            parts_.interpretation.emplace();
            std::vector<std::int32_t> written;
            rewritten(*interpretation, reached, written, *parts_.interpretation);
        }
        if (is_too_much_) return std::nullopt;
        return std::move(parts_);
    }

private:
    struct Module {
        Symbol symbol = 0;
        std::vector<double> values;
    };

    Symbol number(Symbol symbol, std::span<const double> values) {
        std::string key(reinterpret_cast<const char*>(&symbol), sizeof(symbol));
        key.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
        const auto [found, is_new] = numbers_.try_emplace(std::move(key), static_cast<Symbol>(modules_.size()));
        if (is_new) {
            modules_.push_back({symbol, {values.begin(), values.end()}});
            const SymbolInfo& info = grammar_.symbols()[symbol];
            parts_.symbols.push_back(values.empty() ? info : with_values(info, values));
            if (modules_.size() > most_modules) is_too_much_ = true;
        }
        return found->second;
    }

    /// Sorts numbers and removes duplicates.
    void tidy(std::vector<Symbol>& numbers, std::vector<char>& is_reached) {
        work_ += numbers.size();
        is_reached.assign(modules_.size(), 0);
        for (const Symbol number : numbers) is_reached[number] = 1;
        numbers.clear();
        for (Symbol number = 0; number < is_reached.size(); ++number) {
            if (is_reached[number]) numbers.push_back(number);
        }
        work_ += is_reached.size();
        if (work_ > most_rewriting) is_too_much_ = true;
    }

    /// Applies a table to modules. New productions go to `productions`.
    /// @param written  for each number, the index of its production plus 1; -1: it stays; 0: not known yet
    std::vector<Symbol> rewritten(const Table& table, const std::vector<Symbol>& modules,
                                  std::vector<std::int32_t>& written, std::vector<Production>& productions) {
        std::vector<Symbol> after;
        for (const Symbol module : modules) {
            if (is_too_much_) break;
            if (written.size() <= module) written.resize(modules_.size(), 0);
            if (written[module] == 0) {
                auto successor = successor_of(table, module);
                written[module] = successor ? static_cast<std::int32_t>(productions.size() + 1) : -1;
                if (successor) productions.push_back({{}, {module}, {}, *std::move(successor)});
            }
            if (written[module] < 0) {
                after.push_back(module);
                continue;
            }
            const Word& word = productions[static_cast<std::size_t>(written[module]) - 1].successor;
            after.insert(after.end(), word.begin(), word.end());
        }
        return after;
    }

    std::optional<Word> successor_of(const Table& table, Symbol module) {
        const Module own = modules_[module];
        std::span<const double> formals(own.values);
        const Chance chance{};
        const Production* production = choose(
            table, table.candidates(own.symbol), chance, [](const char*) {}, formals,
            [](const Production&) { return true; });
        if (!production) return std::nullopt;
        Word word;
        auto next = production->arguments.begin();
        std::vector<double> values;
        for (const Symbol symbol : production->successor) {
            values.clear();
            for (std::uint32_t k = grammar_.symbols()[symbol].arity; k > 0; --k) {
                values.push_back((next++)->evaluate(formals, chance));
            }
            word.push_back(number(symbol, values));
        }
        work_ += word.size();
        if (work_ > most_rewriting) is_too_much_ = true;
        return word;
    }

    const Grammar& grammar_;
    Grammar::PlainParts parts_;
    std::vector<Module> modules_;  ///< by number
    std::unordered_map<std::string, Symbol> numbers_;
    std::vector<std::vector<std::int32_t>> written_;  ///< for each table
    std::size_t work_ = 0;
    bool is_too_much_ = false;
};

}  // namespace

std::optional<Grammar> plain_form(const Grammar& grammar) {
    if (grammar.is_plain()) return grammar;
    if (grammar.is_stochastic() || grammar.whole_word_steps() > 0 || grammar.map()) return std::nullopt;
    auto parts = PlainWriter(grammar).write();
    if (!parts) return std::nullopt;
    return grammar.with_parts(*std::move(parts));
}

}  // namespace sikku
