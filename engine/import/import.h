// engine/import/import.h: converts L-systems of cpfg and Fractint into pattern files.
#pragma once

#include "engine/base/diagnostic.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The program that a file was written for.
enum class ImportFormat { cpfg, fractint };

/// A system that was found in a file, and the pattern made of it.
struct ImportedSystem {
    std::string name;     ///< in the file
    int line = 1;         ///< where it begins
    std::string pattern;  ///< text of a pattern file; empty if the system has mistakes
    std::vector<std::string>
        losses;         ///< features that the pattern lacks, each with its line; the pattern lists them, too
    bool draws = true;  ///< false if the pattern draws nothing at its derivation length
};

/// Maximum length of a text in bytes; longer ones are rejected.
constexpr std::size_t most_import_bytes = std::size_t{64} << 20;

/// Recognises cpfg by a line `Lsystem:`, and Fractint by entries `NAME {`. Nullopt for other texts, such as those of
/// lpfg and L-Py. Cost: linear.
std::optional<ImportFormat> import_format(std::string_view text);

/// The system of a cpfg file; of several in one file the first, as the others are its sub-L-systems. A C
/// preprocessor's lines are obeyed; #include is not. Derives to what cpfg derives, symbol by symbol, in doubles where
/// cpfg keeps single precision, and with choices by chance of its own.
/// @param view  the view file, or null: of its settings the angle, the scale and the width of lines are taken
/// Mistakes and losses go to `diagnostics`. Cost: linear in the files and in what their defines expand to, at most
/// 16 MB; quadratic in the productions of one symbol.
/// Source: Mech, CPFG Version 4.0 User's Manual, 2005, section 5.
std::vector<ImportedSystem> import_cpfg(const SourcePointer& file, const SourcePointer& view,
                                        Diagnostics& diagnostics);

/// The entries of a Fractint collection, at most 10,000; those called `comment` or nothing are none. The pattern
/// draws what Fractint draws, of any order: `@` becomes a parameter of the steps, what `!` exchanges has symbols of
/// its own, and tables tell the last steps apart where that matters. `derivation length:` is 2, as Fractint proposes.
/// Errors and losses go to `diagnostics`; an error drops only its entry. An entry may expand to 4 MB, all together to
/// 16 MB plus twice the file. Cost: linear in the file for each of at most 20 different levels.
/// Source: Fractint 20.04, section "L-Systems" of its documentation, lsys.c and lsysf.c.
std::vector<ImportedSystem> import_fractint(const SourcePointer& file, Diagnostics& diagnostics);

/// A name for the file of a pattern, without ending: lower case, digits and single hyphens; `system` if nothing of
/// `name` can stay.
std::string import_file_name(std::string_view name);

/// Helps those that write pattern files: what is lost on the way, told with its place.
class ImportLosses {
public:
    /// @param diagnostics  gets a warning for each
    ImportLosses(const SourcePointer& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}
    void add(std::size_t at, const std::string& what);
    /// Adds a diagnostic for another file than the system's.
    void add(const SourcePointer& file, std::size_t at, const std::string& what);
    /// Line of a place of the file. Cost: the way from the place asked for before.
    int line(std::size_t at);
    /// Begins with another system.
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

/// A file's name without its folders, for the `source:` of a pattern.
std::string import_base_name(std::string_view path);

/// The keys `title:`, `source:` and `description:`, losses told in the last.
std::string import_head(std::string_view title, std::string_view source, std::string_view description,
                        const std::vector<std::string>& losses);

/// Compiles the pattern of a system and sets `draws`. After an error the pattern is empty, and its first error is an
/// error at that place.
void compile_import(ImportedSystem& system, const Span& where, Diagnostics& diagnostics);

}  // namespace sikku
