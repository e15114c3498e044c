// engine/language/module_types.h: finds the modules whose parameters are variable.
#pragma once

#include "engine/language/word_scanner.h"

#include <string>
#include <string_view>
#include <unordered_set>

namespace sikku {

/// Types of modules (a letter with a number of parameters) with variable parameters: a predecessor or a context names
/// them, or a word computes them. Parameters of other modules are part of their symbol.
class ModuleTypes {
public:
    ModuleTypes(const Pattern& pattern, const SymbolNames& names);

    bool empty() const { return types_.empty(); }
    bool contains(std::string_view letter, std::size_t parameters) const;

private:
    std::unordered_set<std::string> types_;
};

}  // namespace sikku
