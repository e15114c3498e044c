// engine/language/document.h: a pattern that was read, checked and compiled: what every interpreter starts from.
#pragma once

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

/// Values that replace those of the file: first a variant of the file, then the settings in their order.
struct Overrides {
    std::string variant;  ///< empty: none
    std::vector<Setting> settings;
};

/// A pattern with everything that reading it produced. Immutable; copies share one content.
class Document {
public:
    /// Reads and compiles the text of a pattern file. Errors and warnings of the language go to `diagnostics`; with
    /// errors the document is of no use but for its source. The values of keys that an interpreter owns (`stroke:`,
    /// `tempo:`) are checked by that interpreter.
    /// @param name  what messages call the text: a path, "-"
    static Document compile(std::string name, std::string text, const Overrides& overrides, Diagnostics& diagnostics);

    const Source& source() const { return *content_->pattern.source; }
    /// Keys, defines and productions as the text states them, overrides applied.
    const Pattern& pattern() const { return content_->pattern; }
    const Grammar& grammar() const { return *content_->grammar; }
    const std::shared_ptr<const Grammar>& shared_grammar() const { return content_->grammar; }
    /// What was overridden when the document was made.
    const Overrides& overrides() const { return content_->overrides; }
    /// Whether a setting replaced the value of that key. @param key  folded
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

/// Compiles the text of a pattern. @throws PatternError with every error and its place
Document parse(std::string name, std::string text, const Overrides& overrides = {});

/// The file of a pattern, and what messages call it.
struct PatternFile {
    std::string name;
    std::filesystem::path path;
};

/// Neither a file nor a pattern of the library has that name.
class NotFound : public std::runtime_error {
public:
    NotFound(const std::string& message, bool has_suggestion)
        : std::runtime_error(message), has_suggestion_(has_suggestion) {}
    /// Does the message say what may have been meant?
    bool has_suggestion() const { return has_suggestion_; }

private:
    bool has_suggestion_;
};

/// Finds a pattern: a file by its path, or a pattern of the library by its name. What holds a `/` or ends in .lsys is
/// a path, and need not exist. @throws NotFound, which names the nearest pattern
PatternFile find_pattern(const std::string& pattern, const PatternLibrary& library = PatternLibrary::bundled());

/// Reads the text of a pattern file: at most one byte more than a pattern may have, which compiling then refuses.
/// Waits for the writer of a named pipe. @throws std::runtime_error that names the file and the cause; Stopped
std::string read_pattern(const PatternFile& file, const Monitor& monitor = {});
/// The same from an open stream. @param name  for messages
std::string read_pattern(std::FILE* stream, const std::string& name, const Monitor& monitor = {});

/// Finds, reads and compiles a pattern. @throws NotFound; PatternError with every error and its place;
/// std::runtime_error if the file cannot be read
Document load(const std::string& pattern, const Overrides& overrides = {},
              const PatternLibrary& library = PatternLibrary::bundled());

}  // namespace sikku
