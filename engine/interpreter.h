// engine/interpreter.h: what turns a document into files: prints in art, scores in music.
#pragma once

#include "engine/base/keys.h"
#include "engine/base/monitor.h"
#include "engine/base/option.h"
#include "engine/base/output.h"
#include "engine/language/document.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// What a caller should know of a finished work: a fact (how much was drawn), or a warning (what may surprise).
struct Remark {
    bool is_warning = false;
    std::string text;  ///< one line or several, without a line feed at the end
};

/// What came of Work::make().
struct Made {
    std::vector<Remark> remarks;
    void fact(std::string text) { remarks.push_back({false, std::move(text)}); }
    void warn(std::string text) { remarks.push_back({true, std::move(text)}); }
};

/// Estimate of what a work costs.
struct Cost {
    double seconds = 0;
    double bytes = 0;   ///< of the outputs
    double memory = 0;  ///< bytes at the same time
    double band = 0;    ///< bytes more for each thread that works on pixels
};

/// One file that can be made from a document. Planned once, made once.
class Work {
public:
    virtual ~Work() = default;
    /// @throws what make() would throw before it writes anything
    virtual Cost forecast() const = 0;
    /// The names and contents of files, other than the pattern, that decide what the output holds.
    virtual std::vector<std::pair<std::string, std::string>> read_files() const { return {}; }
    /// Writes `name`, and outputs beside it where the format has several; each appears whole or not at all.
    /// @param threads  for pixels; 0: as the options say
    /// @throws SettingError, BudgetError, WordError, Stopped; std::runtime_error if an output cannot be written
    virtual Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                      int threads = 0) = 0;
};

/// One format of an interpreter: `svg`, `mid`.
struct FormatName {
    std::string_view extension;  ///< without the dot; also what the format is called
    std::string_view label;      ///< `HP-GL`
    std::string_view alias{};    ///< another extension, or empty
    bool is_several = false;     ///< needs several derivation lengths, or has several files
};

/// The row of that extension or alias (any case), or null.
const FormatName* find_format(std::span<const FormatName> formats, std::string_view name);

/// Makes works. Stateless; there is one of each kind.
class Interpreter {
public:
    virtual ~Interpreter() = default;
    /// Whose keys of the language it reads.
    virtual KeyOwner owner() const = 0;
    /// Reports errors in the values of these keys.
    virtual void check_keys(const Pattern& pattern, Diagnostics& diagnostics) const = 0;
    virtual std::span<const FormatName> formats() const = 0;
    /// The table of options, in the order of help.
    virtual std::span<const OptionInfo* const> options() const = 0;
    /// Checks what can be checked without a pattern. @throws SettingError
    virtual void check(std::string_view format, const OptionValues& values) const = 0;
    /// @param format  a name from formats()
    /// @param folder  of files that `values` name; empty: the working directory
    /// @throws SettingError, PatternError
    virtual std::unique_ptr<Work> plan(const Document& document, std::string_view format, const OptionValues& values,
                                       const std::filesystem::path& folder = {}) const = 0;
};

/// Document::compile(), and the values of the keys that these interpreters own are checked.
Document compile(std::string name, std::string text, const Overrides& overrides,
                 std::span<const Interpreter* const> interpreters, Diagnostics& diagnostics);

/// How the program makes the same: `sikku 0.1.0, -n 4 --window … --set '…'`, which outputs keep beside the text of
/// the pattern.
/// @param before, after  options of the interpreter, each with a leading blank
std::string recipe(const Document& document, const Grammar& grammar, const std::string& before,
                   const std::string& after = {});

/// Plans and makes a work whose output is a single one. Names in `values` that are no options of the interpreter are
/// keys or defines of the pattern. @throws as plan() and make(); SettingError for other names
std::string make_in_memory(const Interpreter& interpreter, const Document& document, std::string_view format,
                           const OptionValues& values);

}  // namespace sikku
