#include "engine/language/grammar.h"

#include "engine/language/schedule.h"
#include "engine/language/word_scanner.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace sikku {

Table::Table(std::vector<Production> productions, std::size_t symbols, bool is_plain)
    : productions_(std::move(productions)) {
    context_free_ = std::all_of(productions_.begin(), productions_.end(), [](const Production& production) {
        return !production.has_context() && production.predecessor.size() == 1;
    });
    has_random_conditions_ = std::any_of(productions_.begin(), productions_.end(), [](const Production& production) {
        return production.condition && production.condition->uses_chance();
    });
    if (context_free_ && is_plain) {
        first_.assign(symbols, -1);
        for (std::size_t i = productions_.size(); i > 0; --i) {
            first_[productions_[i - 1].predecessor.front()] = static_cast<std::int32_t>(i - 1);
        }
        return;
    }
    candidate_begin_.assign(symbols + 1, 0);
    for (const Production& production : productions_) ++candidate_begin_[production.predecessor.front() + 1];
    std::partial_sum(candidate_begin_.begin(), candidate_begin_.end(), candidate_begin_.begin());
    candidate_list_.resize(productions_.size());
    std::vector<std::uint32_t> next(candidate_begin_.begin(), candidate_begin_.end() - 1);
    // Productions with context are tried before those without, else in the order of the file.
    for (const bool with_context : {true, false}) {
        for (std::uint32_t i = 0; i < productions_.size(); ++i) {
            const Production& production = productions_[i];
            if (production.has_context() != with_context) continue;
            candidate_list_[next[production.predecessor.front()]++] = i;
        }
    }
}

bool Grammar::make_schedule(std::string* problem) {
    schedule_.clear();
    if (!schedule_items_) {
        if (steps_ > 0) schedule_.push_back({0, steps_});
        return true;
    }
    auto runs = schedule_runs(*schedule_items_, steps_, problem);
    if (!runs) return false;
    schedule_ = std::move(*runs);
    return true;
}

std::vector<char> Grammar::reachable() const {
    std::vector<char> reached(symbols_.size(), 0);
    Word pending;
    const auto visit = [&](const Word& word) {
        for (const Symbol symbol : word) {
            if (!reached[symbol]) {
                reached[symbol] = 1;
                pending.push_back(symbol);
            }
        }
    };
    const auto follow = [&](const Table& table, Symbol symbol) {
        if (!table.context_free() || !is_plain()) {
            for (const std::uint32_t i : table.candidates(symbol)) visit(table.production(i).successor);
        } else if (const Word* successor = table.successor(symbol)) {
            visit(*successor);
        }
    };
    visit(axiom());
    while (!pending.empty()) {
        const Symbol symbol = pending.back();
        pending.pop_back();
        for (const Table& table : tables_) follow(table, symbol);
        if (interpretation_) follow(*interpretation_, symbol);
    }
    return reached;
}

std::optional<Grammar> Grammar::with_steps(std::int64_t steps) const {
    if (begun_ || has_fixed_steps_) return std::nullopt;
    Grammar other = *this;
    other.steps_ = steps;
    if (!other.make_schedule(nullptr)) return std::nullopt;
    return other;
}

std::int64_t Grammar::steps_done() const {
    std::int64_t left = 0;
    for (const ScheduleRun& run : schedule_) left += run.steps;
    return steps_ - left;
}

Grammar Grammar::after(std::int64_t steps, std::shared_ptr<const ModuleWord> word) && {
    begun_ = true;
    axiom_ = std::move(word);
    for (ScheduleRun& run : schedule_) {
        const std::int64_t taken = std::min(run.steps, steps);
        run.steps -= taken;
        steps -= taken;
    }
    std::erase_if(schedule_, [](const ScheduleRun& run) { return run.steps == 0; });
    return std::move(*this);
}

std::optional<Grammar> Grammar::with_marks(std::int64_t order, const std::vector<char>& sounding) const {
    if (!is_plain() || whole_word_steps() > 0 || begun_) return std::nullopt;
    Grammar other = *this;
    if (order > steps_) return other;
    std::vector<char> draws(symbols_.size(), 0);
    for (Symbol symbol = 0; symbol < draws.size(); ++symbol) {
        const bool sounds = symbol < sounding.size() && sounding[symbol] != 0;
        draws[symbol] = sounds || symbols_[symbol].command.action == Action::draw ? 1 : 0;
    }
    const auto spread = [&](const Table& table) {
        bool is_new = false;
        for (const Production& production : table.productions()) {
            char& own = draws[production.predecessor.front()];
            const bool leads = std::any_of(production.successor.begin(), production.successor.end(),
                                           [&](Symbol symbol) { return draws[symbol] != 0; });
            if (own != 0 || !leads) continue;
            own = 1;
            is_new = true;
        }
        return is_new;
    };
    for (bool goes_on = true; goes_on;) {
        goes_on = interpretation_ && spread(*interpretation_);
        for (const Table& table : tables_) goes_on = spread(table) || goes_on;
    }
    // The schedule is cut where `order` steps are left.
    std::int64_t before = steps_ - order;
    std::vector<ScheduleRun> schedule;
    std::uint32_t next = 0;
    bool is_placed = false;
    const auto marking = static_cast<std::uint32_t>(tables_.size());
    for (const ScheduleRun& run : schedule_) {
        const std::int64_t first = std::min(run.steps, before);
        if (first > 0) schedule.push_back({run.table, first});
        before -= first;
        if (!is_placed && before == 0 && (first < run.steps || &run == &schedule_.back())) {
            next = run.table;
            schedule.push_back({marking, 1});
            is_placed = true;
        }
        if (first < run.steps) schedule.push_back({run.table, run.steps - first});
    }
    const auto mark = static_cast<Symbol>(symbols_.size());
    std::vector<Production> productions;
    for (Symbol symbol = 0; symbol < mark; ++symbol) {
        const Word* successor = tables_[next].successor(symbol);
        const bool is_rewritten = successor && *successor != Word{symbol};
        if (is_rewritten && draws[symbol] != 0) productions.push_back({{}, {symbol}, {}, {symbol, mark}});
    }
    SymbolInfo info;
    info.letter_index = static_cast<std::uint32_t>(letters_.size());
    info.command.action = Action::mark;
    other.letters_.emplace_back();
    other.symbols_.push_back(info);
    other.ignored_.push_back(1);
    other.tables_.emplace_back(std::move(productions), other.symbols_.size(), true);
    other.schedule_ = std::move(schedule);
    other.schedule_items_ = nullptr;
    other.steps_ = steps_ + 1;
    other.mark_ = mark;
    return other;
}

Grammar Grammar::with_map(const std::vector<Symbol>& map) const {
    Grammar other = *this;
    std::vector<Production> productions;
    for (Symbol symbol = 0; symbol < map.size(); ++symbol) {
        productions.push_back({{}, {symbol}, {}, map[symbol] < symbols_.size() ? Word{map[symbol]} : Word{}});
    }
    other.tables_ = {Table(std::move(productions), map.size(), true)};
    other.schedule_items_ = nullptr;
    other.steps_ = 1;
    other.schedule_ = {{0, 1}};
    return other;
}

std::optional<Grammar> Grammar::written_out(const ModuleWord& word) const {
    Grammar other = *this;
    other.tables_.assign(1, Table());
    other.interpretation_.reset();
    other.schedule_.clear();
    other.schedule_items_ = nullptr;
    other.begun_ = true;
    other.is_parametric_ = other.is_stochastic_ = false;
    other.cut_.reset();
    ModuleWord written;
    std::unordered_map<std::string, Symbol> known;  // by symbol and the bytes of its arguments
    std::string key;
    const double* next = word.arguments.data();
    for (const Symbol symbol : word.symbols) {
        const SymbolInfo& info = symbols_[symbol];
        const std::span<const double> arguments(next, info.arity);
        next += info.arity;
        if (arguments.empty()) {
            written.symbols.push_back(symbol);
            continue;
        }
        key.assign(reinterpret_cast<const char*>(&symbol), sizeof(symbol));
        key.append(reinterpret_cast<const char*>(arguments.data()), arguments.size_bytes());
        const auto [found, fresh] = known.try_emplace(key, static_cast<Symbol>(other.symbols_.size()));
        written.symbols.push_back(found->second);
        if (!fresh) continue;
        if (other.symbols_.size() >= most_symbols) return std::nullopt;
        other.symbols_.push_back(with_values(info, arguments));
        other.ignored_.push_back(ignored_[symbol]);
    }
    other.axiom_ = std::make_shared<const ModuleWord>(std::move(written));
    return other;
}

SymbolInfo with_values(const SymbolInfo& symbol, std::span<const double> values) {
    SymbolInfo own = symbol;
    own.arguments.assign(values.begin(), values.end());
    own.arity = 0;
    Command& command = own.command;
    if (command.takes_argument) {
        command.value *= values.front();
        command.takes_argument = false;
        if (command.is_turn()) {
            command.angle = angle_of_degrees(command.value);
            command.value = 0;
        }
    }
    return own;
}

Grammar Grammar::with_parts(PlainParts parts) const {
    Grammar other = *this;
    const std::size_t symbols = parts.symbols.size();
    other.symbols_ = std::move(parts.symbols);
    other.axiom_ = std::make_shared<const ModuleWord>(ModuleWord{std::move(parts.axiom), {}, {}});
    other.tables_.clear();
    for (std::vector<Production>& table : parts.tables) other.tables_.emplace_back(std::move(table), symbols, true);
    other.interpretation_.reset();
    if (parts.interpretation) other.interpretation_.emplace(std::move(*parts.interpretation), symbols, true);
    other.is_parametric_ = other.is_stochastic_ = false;
    other.has_fixed_steps_ = true;
    other.ignored_.assign(symbols, 0);
    return other;
}

bool Grammar::has_labels() const {
    return !labels_->empty() && leads_to([](Action action) { return action == Action::label; });
}

std::int64_t Grammar::whole_word_steps() const {
    if (cut_) return steps_ - steps_done();
    std::int64_t last = 0, before = 0;
    for (const ScheduleRun& run : schedule_) {
        before += run.steps;
        if (!tables_[run.table].context_free()) last = before;
    }
    return last;
}

}  // namespace sikku
