// engine/import/import.h: converts L-systems of cpfg and Fractint into pattern files.
#pragma once

#include "engine/base/diagnostic.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The program that a file was written for.
enum class ImportFormat { cpfg, fractint };

/// A system found in a file, and its pattern.
struct ImportedSystem {
    std::string name;     ///< in the file
    int line = 1;         ///< where it begins
    std::string pattern;  ///< text of a pattern file; empty if the system has errors
    std::vector<std::string>
        losses;         ///< features that the pattern lacks, each with its line; the pattern lists them, too
    bool draws = true;  ///< false if the pattern draws nothing at its derivation length
};

/// Maximum length of a text in bytes; longer ones are rejected.
constexpr std::size_t most_import_bytes = std::size_t{64} << 20;

/// Recognises cpfg by a line `Lsystem:`, and Fractint by entries `NAME {`. Nullopt for other texts, such as those of
/// lpfg and L-Py. Cost: linear.
std::optional<ImportFormat> import_format(std::string_view text);

/// Imports the L-system of a cpfg file: the first one, as further ones are its sub-L-systems. Obeys C preprocessor
/// directives except #include. The pattern derives the same symbols as cpfg, in doubles where cpfg uses single
/// precision, and with other random choices. Errors and losses go to `diagnostics`.
/// @param view  the view file, or null; its angle, scale and line widths are imported
/// Cost: linear in the files and in the expansion of their defines, at most 16 MB; quadratic in the productions of
/// one symbol.
/// Source: Mech, CPFG Version 4.0 User's Manual, 2005, section 5.
std::vector<ImportedSystem> import_cpfg(const SourcePointer& file, const SourcePointer& view,
                                        Diagnostics& diagnostics);

/// The view file beside a cpfg file, NAME.v; empty if there is none.
std::filesystem::path view_file_beside(const std::filesystem::path& file);

/// Imports the entries of a Fractint collection, at most 10,000, except those without a name or named `comment`. The
/// patterns draw the same as Fractint, at any order: `@` becomes a parameter of the steps, symbols that `!` exchanges
/// have counterparts, and tables distinguish the last steps where that matters. `derivation length:` is 2, as
/// Fractint proposes. Errors and losses go to `diagnostics`; an error drops only its entry. An entry may expand to 4
/// MB, all together to 16 MB plus twice the file. Cost: linear in the file for each of at most 20 different levels.
/// Source: Fractint 20.04, section "L-Systems" of its documentation, lsys.c and lsysf.c.
std::vector<ImportedSystem> import_fractint(const SourcePointer& file, Diagnostics& diagnostics);

/// Returns a file name without extension for a pattern: lower-case letters, digits and single hyphens; `system` if
/// `name` contains no letters or digits.
std::string import_file_name(std::string_view name);

/// Collects the features that an import loses, with their places.
class ImportLosses {
public:
    /// @param diagnostics  receives a warning for each
    ImportLosses(const SourcePointer& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}
    void add(std::size_t at, const std::string& what);
    /// Adds a loss in another file than the system's.
    void add(const SourcePointer& file, std::size_t at, const std::string& what);
    /// Line number of an offset. Cost: linear in the distance from the previous offset.
    int line(std::size_t at);
    /// Returns the losses so far and begins with another system.
    std::vector<std::string> take();
    const std::vector<std::string>& list() const { return list_; }

private:
    void keep(std::string text);
    SourcePointer file_;
    Diagnostics& diagnostics_;
    std::vector<std::string> list_;
    std::size_t more_ = 0;
    std::size_t last_at_ = 0;
    int last_line_ = 1;
};

/// True for a file that can be imported; otherwise reports its size, or a NUL byte. @param kind  such as `a cpfg
/// file`
bool is_importable(const SourcePointer& file, std::string_view kind, Diagnostics& diagnostics);

/// A file's name without its folders, for the `source:` of a pattern.
std::string import_base_name(std::string_view path);

/// Writes the keys `title:`, `source:` and `description:`; the last one lists the losses.
std::string import_head(std::string_view title, std::string_view source, std::string_view description,
                        const std::vector<std::string>& losses);

/// Compiles the pattern of a system and sets `draws`. If the pattern has errors, empties it and reports the first one
/// at `where`.
void compile_import(ImportedSystem& system, const Span& where, Diagnostics& diagnostics);

}  // namespace sikku
