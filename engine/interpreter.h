// engine/interpreter.h: the interface that turns a document into files: prints in art, scores in music.
#pragma once

#if __cplusplus < 202002L
#error "Sikku needs C++20: compile with -std=c++20"
#endif

#include "engine/base/cost.h"
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

/// A message about a finished work: a fact, such as the length drawn, or a warning.
struct Remark {
    bool is_warning = false;
    std::string text;      ///< one or several lines, without a final line feed
    std::string option{};  ///< name of the option that had no effect, if the warning is about one
};

/// Result of Work::make().
struct Made {
    std::vector<Remark> remarks;
    void fact(std::string text) { remarks.push_back({false, std::move(text)}); }
    void warn(std::string text) { remarks.push_back({true, std::move(text)}); }
    /// Warns of an option that had no effect.
    void warn_of_unused(const std::string& option, const std::string& reason) {
        remarks.push_back({true, "'" + option + "' has no effect: " + reason, option});
    }
};

/// One file that can be made from a document. Planned once, made once.
class Work {
public:
    virtual ~Work() = default;
    /// @throws exceptions that make() throws before it writes anything
    virtual Cost forecast() const = 0;
    /// Names and contents of the files besides the pattern that determine the output.
    virtual std::vector<std::pair<std::string, std::string>> read_files() const { return {}; }
    /// Writes `name`, and further outputs beside it if the format has several; each appears whole or not at all.
    /// @param threads threads for pixels; 0: the number in the options
    /// @throws SettingError, BudgetError, WordError, Stopped; std::runtime_error if an output cannot be written
    virtual Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                      int threads = 0) = 0;
};

/// One format of an interpreter: `svg`, `mid`.
struct FormatName {
    std::string_view extension;  ///< extension without the dot; also the name of the format
    std::string_view label;      ///< name in messages: `HP-GL`
    std::string_view alias{};    ///< another extension, or empty
    bool is_several = false;     ///< needs several derivation lengths, or has several files
    bool is_text = false;        ///< files are UTF-8 text
};

/// Finds the row of an extension or alias, in any case; null if there is none.
const FormatName* find_format(std::span<const FormatName> formats, std::string_view name);

/// Plans works. Stateless; there is one instance of each kind.
class Interpreter {
public:
    virtual ~Interpreter() = default;
    /// Owner of the keys that it reads.
    virtual KeyOwner owner() const = 0;
    /// Reports errors in the values of those keys.
    virtual void check_keys(const Pattern& pattern, Diagnostics& diagnostics) const = 0;
    /// Reports keys that would fail with this grammar for every output. Options may still change them.
    virtual void check_grammar(const Pattern& /*pattern*/, const Grammar& /*grammar*/,
                               Diagnostics& /*diagnostics*/) const {}
    virtual std::span<const FormatName> formats() const = 0;
    /// The table of options, in the order of help.
    virtual std::span<const OptionInfo* const> options() const = 0;
    /// Checks what can be checked without a pattern. @throws SettingError
    virtual void check(std::string_view format, const OptionValues& values) const = 0;
    /// @param format  a name from formats()
    /// @param folder  folder of files that `values` name; empty: the working directory
    /// @throws SettingError, PatternError
    virtual std::unique_ptr<Work> plan(const Document& document, std::string_view format, const OptionValues& values,
                                       const std::filesystem::path& folder = {}) const = 0;
};

/// Calls Document::compile() and checks the values of the keys that these interpreters own.
Document compile(std::string name, std::string text, const Overrides& overrides,
                 std::span<const Interpreter* const> interpreters, Diagnostics& diagnostics);

/// True if the pattern sets a key that the interpreter owns, as melodies do with `scale`.
bool sets_keys_of(const Interpreter& interpreter, const Document& document);

/// The values without those that set `keys`, which a document contains.
OptionValues without_keys(OptionValues values, const std::vector<Setting>& keys);

/// The version and the arguments that reproduce the output: `sikku 0.2.0, -n 4 --set 'angle increment=60' --size A3`.
/// Outputs store them beside the text of the pattern.
/// @param options  of the interpreter, from recipe_options() of without_keys()
std::string recipe(const Document& document, const RecipeOptions& options);

/// The reason if the productions are not applied because neither the pattern nor an option sets a derivation length.
std::string reason_of_no_steps(const Document& document);

/// Values, separated into keys and defines of the pattern and options of the interpreter.
struct Assignment {
    Document document;     ///< with the keys and defines applied
    OptionValues options;  ///< values of the interpreter's options
};

/// Separates values by name: options of the interpreter are returned; keys and defines of the pattern are applied to
/// the document. `n` and `steps` are the derivation length, as on the command line, also if the pattern has a define
/// of that name. A seed, including that of document.overrides(), is both. @throws SettingError for other names;
/// PatternError
Assignment assign(const Interpreter& interpreter, const Document& document, const OptionValues& values);

/// Plans and makes a work with a single output. Names in `values` are options of the interpreter, or keys and defines
/// of the pattern. @throws as assign(), plan() and make()
std::string make_in_memory(const Interpreter& interpreter, const Document& document, std::string_view format,
                           const OptionValues& values, const Monitor& monitor = {});

}  // namespace sikku
