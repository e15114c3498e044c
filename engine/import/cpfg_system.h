// engine/import/cpfg_system.h: an L-system as read from a cpfg file, and the stages of its import.
#pragma once

#include "engine/import/cpfg_expression.h"

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::cpfg {

/// A module of a predecessor or a context.
struct Formal {
    std::string letter;
    std::vector<std::string> names;
};

struct Rule {
    std::vector<Formal> left;
    std::vector<Formal> predecessor;
    std::vector<Formal> right;
    std::optional<Value> condition;
    std::string successor;
    std::optional<Value> weight;
    std::size_t at = 0;
    bool has_context() const { return !left.empty() || !right.empty(); }
};

/// A text that identifies the types of modules: their letters and numbers of parameters.
inline std::string type_of(const std::vector<Formal>& modules) {
    std::string key;
    for (const Formal& module : modules) key += fmt::format("{}({} ", module.letter, module.names.size());
    return key;
}

/// The letters of a system, as words and productions use them.
struct Letters {
    std::set<std::string> symbols;                          ///< symbols of words, predecessors and contexts
    std::set<std::pair<std::string, std::size_t>> modules;  ///< in derived words, with numbers of parameters
    std::set<char> called;                                  ///< letters of functions, after an '@'
    std::set<char> named;                                   ///< letters in predecessors and contexts
    std::map<char, std::string> surfaces;                   ///< letters of the pattern for surfaces
    bool sets_width = false;                                ///< true if a module sets a width
};

struct System {
    std::size_t at = std::string::npos;  ///< position of the line `Lsystem:`; npos if there is none
    std::string label;
    long long steps = 0;
    std::optional<long long> seed;
    std::set<char> listed;  ///< letters listed under `ignore:` or `consider:`
    bool has_list = false;
    bool considers = false;
    std::optional<std::string> axiom;
    std::vector<Rule> rules;
    std::vector<Rule> decomposition;  ///< applied repeatedly to the axiom and after each step
    long long decomposition_depth = 1;
    std::size_t decomposition_at = 0;
    std::vector<Rule> homomorphism;
    long long homomorphism_depth = 1;
    std::size_t homomorphism_depth_at = 0;
    Letters letters;
    std::map<std::string, std::string> defines;  ///< defines that the expressions use
};

/// The settings of a view as keys of patterns; empty if not set.
struct View {
    std::string angle;
    std::string stroke;
    std::string scale;
    double width_increment = 0;
};

/// Reads a view file. Settings without a counterpart in patterns are losses.
View read_view(const SourcePointer& file, Report& report);

/// Reads the first L-system in the text of a file. Errors and losses go to `report`.
System read_system(std::string text, const View& view, Report& report);

/// Returns the text of a pattern file; empty after an error. Reports features that are lost.
/// @param name  name of the system
std::string write_pattern(System system, const View& view, const std::string& name, const SourcePointer& file,
                          Report& report);

}  // namespace sikku::cpfg
