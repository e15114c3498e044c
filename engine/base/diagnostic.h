// engine/base/diagnostic.h: source texts, places in them, and errors and warnings at those places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sikku {

/// A place as editors count: lines and columns (code points) from 1.
struct Place {
    int line = 1;
    int column = 1;
    bool operator==(const Place&) const = default;
};

/// A named text that diagnostics point into: a file, standard input, or an option of the command line.
/// Immutable; has to outlive every Span cut from it.
class Source {
public:
    /// @param is_value  a value outside of the file: messages show `name` and no place
    Source(std::string name, std::string text, bool is_value = false);
    /// A setting that the caller gave. @param shown  for messages: its name, and perhaps its value
    Source(std::string shown, std::string text, bool is_value, std::string setting, std::string value);
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;

    const std::string& name() const { return name_; }  ///< as the user gave it: a path, "-", "--set"
    const std::string& text() const { return text_; }  ///< the bytes as they were read
    bool is_value() const { return is_value_; }
    const std::string& setting() const { return setting_; }  ///< its name; empty for other texts
    const std::string& value() const { return value_; }
    /// The text with comments, continuations and carriage returns replaced by blanks, at its full length.
    std::string_view cleaned() const { return cleaned_.empty() ? text_ : cleaned_; }
    /// Offset of a comment without end; npos if there is none.
    std::size_t open_comment() const { return open_comment_; }
    /// Cost: linear in the offset.
    Place place(std::size_t at) const;

private:
    std::string name_;
    std::string text_;
    bool is_value_;
    std::string setting_, value_;
    std::size_t open_comment_ = std::string::npos;  // before cleaned_, which is made together with it
    std::string cleaned_;                           // empty if nothing had to be blanked
};
using SourcePointer = std::shared_ptr<const Source>;

/// A piece of a source, which must live at least as long.
struct Span {
    const Source* source = nullptr;
    std::uint32_t at = 0;      ///< byte offset into the source
    std::uint32_t length = 0;  ///< bytes

    Span() = default;
    Span(const Source* in, std::size_t begin, std::size_t bytes)
        : source(in), at(static_cast<std::uint32_t>(begin)), length(static_cast<std::uint32_t>(bytes)) {}
    Span(const SourcePointer& in, std::size_t begin, std::size_t bytes) : Span(in.get(), begin, bytes) {}

    std::string_view view() const;                                                   ///< the cleaned text
    Span part(std::size_t begin, std::size_t count = std::string_view::npos) const;  ///< relative, clipped
    Span trimmed() const;                                                            ///< without blanks at both ends
    bool empty() const { return length == 0; }
};

/// One error, or warning, at one place.
struct Diagnostic {
    std::string file;
    Place where;  ///< line 0: nowhere in a file; `file` is then a setting and its value: `scale dorain`
    std::string message;
    std::string excerpt;  ///< at most 80 columns of the line, valid UTF-8, and a line with the caret
    bool warning = false;
    std::string setting{}, value{};  ///< name and value of the invalid setting that the caller gave; empty otherwise

    /// `file:line:column: message`, the excerpt and the caret below it; `scale dorain: message` for a setting.
    std::string text() const;
};

/// Result of Diagnostics::refuse(): false, or no value.
struct Refused {
    template <class Flag>
    requires std::is_same_v<Flag, bool>
    operator Flag() const { return false; }  // NOLINT(google-explicit-constructor)
    template <class Value>
    operator std::optional<Value>() const {  // NOLINT(google-explicit-constructor)
        return std::nullopt;
    }
};

/// Collects errors and warnings of a file, which are reported together. After 50 errors only their number is kept.
class Diagnostics {
public:
    void error(const Span& where, const std::string& message) { add(where, message, false); }
    void warning(const Span& where, const std::string& message) { add(where, message, true); }
    /// Adds an error, for functions that return whether they succeeded, or a value.
    Refused refuse(const Span& where, const std::string& message) {
        error(where, message);
        return {};
    }
    /// Adds a diagnostic of another collection.
    void add(const Diagnostic& diagnostic);
    const std::vector<Diagnostic>& list() const { return list_; }
    bool has_errors() const { return errors_ > 0; }
    /// True if the text is not a pattern at all, so that further checks are useless.
    bool is_unreadable() const { return unreadable_; }
    void unreadable(const Span& where, const std::string& message) {
        unreadable_ = true;
        error(where, message);
    }
    std::vector<Diagnostic> sorted() const;
    /// Throws PatternError with everything collected, sorted by place, if there is an error.
    void throw_if_errors() const;

private:
    void add(const Span& where, const std::string& message, bool warning);
    std::vector<Diagnostic> list_;
    std::size_t errors_ = 0;
    bool unreadable_ = false;
};

/// Thrown for a pattern that cannot be used, with all its diagnostics; what() is their text.
class PatternError : public std::runtime_error {
public:
    explicit PatternError(std::vector<Diagnostic> diagnostics, std::size_t errors);
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
    /// The first error if all errors are in settings that the caller gave; otherwise null.
    const Diagnostic* setting_error() const;

private:
    std::vector<Diagnostic> diagnostics_;
};

/// Returns the element of `known` nearest to `word` by edit distance; empty if none is near enough to be meant.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known);

/// Number of bytes in the first code point of `text` (not empty); 0 if it is not valid UTF-8.
std::size_t utf8_length(std::string_view text);

/// Returns `text` as one line for a message or a table: line breaks (also U+2028 and U+2029) become blanks, other
/// control characters, direction overrides and invalid UTF-8 become '?', and at most `most` bytes are kept, omitting
/// the middle.
std::string printable(std::string_view text, std::size_t most = 240);

/// The same for a text of several lines, such as a message with an excerpt: line feeds stay. All lines but the first
/// are indented, so a text in a message cannot be mistaken for another message.
std::string printable_lines(std::string_view text, std::size_t most = 240);

/// Returns `text` for one line of a pattern file, such as its title or a comment: as printable(), with single
/// blanks, and without characters that begin a block comment or continue the line.
std::string pattern_line(std::string_view text, std::size_t most = 400);

/// Reads the whole of `text` as a finite decimal number, in any locale; false if it is not one.
bool read_number(std::string_view text, double& value);

}  // namespace sikku
