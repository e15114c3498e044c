// engine/language/document.h: patterns that were read, checked and compiled, ready for interpreters.
#pragma once

#if __cplusplus < 202002L
#error "Sikku needs C++20: compile with -std=c++20"
#endif

#include "engine/base/monitor.h"
#include "engine/language/grammar.h"
#include "engine/language/pattern.h"
#include "engine/language/pattern_library.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Values that replace those of the file: first those of a variant, then the settings in their order.
struct Overrides {
    std::string variant;  ///< empty: none
    std::vector<Setting> settings;
};

/// A pattern with its compiled grammar and warnings. Immutable; copies share their contents.
class Document {
public:
    /// Reads and compiles the text of a pattern file. Errors and warnings of the language go to `diagnostics`; after
    /// errors only the source of the document may be used. Interpreters check the values of their keys (`stroke:`,
    /// `tempo:`).
    /// @param name  name of the text in messages: a path, "-"
    static Document compile(std::string name, std::string text, const Overrides& overrides, Diagnostics& diagnostics);

    const Source& source() const { return *content_->pattern.source; }
    /// Keys, defines and productions as the text states them, overrides applied.
    const Pattern& pattern() const { return content_->pattern; }
    const Grammar& grammar() const { return *content_->grammar; }
    const std::shared_ptr<const Grammar>& shared_grammar() const { return content_->grammar; }
    /// The map system, or null if the pattern derives words.
    const MapSystem* map() const { return grammar().map(); }
    /// The overrides that the document was made with.
    const Overrides& overrides() const { return content_->overrides; }
    /// True if a setting replaced the value of that key. @param key  folded
    bool has_override(std::string_view key) const;
    /// Warnings of the language, sorted by place.
    const std::vector<Diagnostic>& warnings() const { return content_->warnings; }
    /// The value of a free-text key (`title`, `source`, `description`), or empty.
    std::string text(std::string_view key) const { return content_->pattern.text(key); }

    /// The same document with further settings, applied after its own. The grammar is compiled again only if a
    /// setting concerns it. @throws PatternError with every error
    Document with(const std::vector<Setting>& settings) const;

private:
    struct Content {
        Pattern pattern;
        std::shared_ptr<const Grammar> grammar;
        Overrides overrides;
        std::vector<Diagnostic> warnings;
    };
    explicit Document(std::shared_ptr<const Content> content) : content_(std::move(content)) {}
    std::shared_ptr<const Content> content_;
};

/// Refuses maps where a turtle is needed. @param consequence  completes the message `a map has no turtle, so …`
/// @throws PatternError at the key `map` if the pattern is a map
void require_turtle(const Document& document, std::string_view consequence);

/// Compiles the text of a pattern. @throws PatternError with every error and its place
Document parse(std::string name, std::string text, const Overrides& overrides = {});

/// The file of a pattern, and its name in messages.
struct PatternFile {
    std::string name;
    std::filesystem::path path;
};

/// Thrown if neither a file nor a pattern of the library has a given name.
class NotFound : public std::runtime_error {
public:
    NotFound(const std::string& message, bool has_suggestion)
        : std::runtime_error(message), has_suggestion_(has_suggestion) {}
    /// True if the message suggests a similar name.
    bool has_suggestion() const { return has_suggestion_; }

private:
    bool has_suggestion_;
};

/// Finds a pattern: a file by its path, or a pattern of the library by its name. A text that contains a `/` or ends
/// in .lsys is a path, and is returned even if the file does not exist. @throws NotFound, which suggests the nearest
/// pattern
PatternFile find_pattern(const std::string& pattern, const PatternLibrary& library = PatternLibrary::bundled());

/// Reads the text of a pattern file: at most one byte more than the limit for patterns, which compiling then rejects.
/// Waits for the writer of a named pipe. @throws std::runtime_error that names the file and the cause; Stopped
std::string read_pattern(const PatternFile& file, const Monitor& monitor = {});
/// Reads the text from an open stream. @param name  for messages
std::string read_pattern(std::FILE* stream, const std::string& name, const Monitor& monitor = {});

/// Finds, reads and compiles a pattern. @throws NotFound; PatternError with every error and its place;
/// std::runtime_error if the file cannot be read
Document load(const std::string& pattern, const Overrides& overrides = {},
              const PatternLibrary& library = PatternLibrary::bundled());

}  // namespace sikku
