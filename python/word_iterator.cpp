#include "python/word_iterator.h"

#include "engine/base/memory.h"
#include "engine/derivation/forecast.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <span>

namespace py = pybind11;

namespace sikku {
namespace {

constexpr std::chrono::milliseconds signal_interval{50};  // between two checks for signals

constexpr std::size_t most_modules = 4096;  // in a list

/// All iterators; guarded by the global lock of Python (GIL).
std::set<WordIterator*>& living() {
    static std::set<WordIterator*> all;
    return all;
}

py::tuple to_tuple(std::span<const double> numbers) {
    py::tuple tuple(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) tuple[i] = py::float_(numbers[i]);
    return tuple;
}

/// The limit of `sikku derive` for words that are held in memory.
DerivationOptions reading(const Grammar& grammar, bool interpreted) {
    DerivationOptions options;
    options.interpreted = interpreted;
    options.longest_word = available_memory() / (grammar.is_plain() ? 64 : 256);
    options.compared = 500'000'000;
    return options;
}

}  // namespace

WordIterator::WordIterator(const Document& document, bool interpreted)
    : grammar_(std::make_shared<const Grammar>(shorten(document.grammar()))),
      process_(::getpid()),
      type_(py::module_::import("sikku.data").attr("Module")) {
    for (const SymbolInfo& symbol : grammar_->symbols()) {
        constants_.push_back(symbol.arity > 0 ? py::none() : type_(symbol.letter, to_tuple(symbol.arguments)));
    }
    stream_ = std::make_unique<WordStream>(grammar_, reading(*grammar_, interpreted));
    living().insert(this);
}

WordIterator::~WordIterator() {
    close();
}

void WordIterator::close() {
    living().erase(this);
    // The thread of the parent does not exist in a child process.
    if (process_ != ::getpid()) {
        static_cast<void>(stream_.release());
    } else {
        stream_.reset();
    }
    symbol_ = piece_.symbols.size();
}

void WordIterator::close_all() {
    while (!living().empty()) (*living().begin())->close();
}

void WordIterator::read_piece() {
    if (!stream_) throw py::stop_iteration();
    if (process_ != ::getpid()) throw std::runtime_error("an iterator of a word cannot be used after a fork");
    symbol_ = argument_ = 0;
    piece_.symbols.clear();
    for (;;) {
        WordStream::Next next{};
        {
            const py::gil_scoped_release release;
            next = stream_->next(piece_, signal_interval);
        }
        if (next == WordStream::Next::piece) return;
        if (next == WordStream::Next::end) {
            close();
            throw py::stop_iteration();
        }
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
}

py::object WordIterator::next_module() {
    const Symbol symbol = piece_.symbols[symbol_++];
    const SymbolInfo& info = grammar_->symbols()[symbol];
    if (info.arity == 0) return constants_[symbol];
    const std::span<const double> arguments = std::span(piece_.arguments).subspan(argument_, info.arity);
    argument_ += info.arity;
    return type_(info.letter, to_tuple(arguments));
}

py::list WordIterator::next() {
    // Readers in C, such as list(), do not check for signals.
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (symbol_ >= piece_.symbols.size()) read_piece();
    const std::size_t count = std::min(most_modules, piece_.symbols.size() - symbol_);
    py::list modules(count);
    for (std::size_t i = 0; i < count; ++i) modules[i] = next_module();
    return modules;
}

}  // namespace sikku
