// engine/language/module_types.h: which modules of a pattern state their parameters for themselves.
#pragma once

#include "engine/language/word_scanner.h"

#include <string>
#include <string_view>
#include <unordered_set>

namespace sikku {

/// Types of modules, a letter with a number of parameters, that state their parameters for themselves: those that a
/// predecessor or a context names the parameters of, and those that a word computes them for.
class ModuleTypes {
public:
    ModuleTypes(const Pattern& pattern, const SymbolNames& names);

    bool empty() const { return types_.empty(); }
    bool contains(std::string_view letter, std::size_t parameters) const;

private:
    std::unordered_set<std::string> types_;
};

}  // namespace sikku
