// engine/language/pattern_library.h: a folder of pattern files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// One pattern file of a library.
struct LibraryPattern {
    std::string name;  ///< of the file, without folder and ending
    std::string kind;  ///< name of the folder that holds it: kolams, tilings, …
    std::filesystem::path file;
};

/// The pattern files (`*.lsys`) in a folder and its subfolders. Immutable; copies share the list.
class PatternLibrary {
public:
    /// Lists `folder`; a folder that is missing or may not be read has no patterns.
    /// @throws std::runtime_error if too many files are open
    explicit PatternLibrary(const std::filesystem::path& folder);

    /// The bundled patterns, listed once: those beside the running program, otherwise the installed ones.
    static const PatternLibrary& bundled();

    const std::filesystem::path& folder() const { return folder_; }
    /// Sorted by kind and name.
    const std::vector<LibraryPattern>& patterns() const { return *patterns_; }
    /// The pattern of that name, or null.
    const LibraryPattern* find(std::string_view name) const;
    /// The gallery file of that name in the library, posters/NAME.toml, if no file has it; otherwise `name` itself.
    std::string gallery_file(const std::string& name) const;
    /// What may have been meant by `name`, at most three: the nearest name, or those that begin with it.
    std::vector<std::string_view> similar(std::string_view name) const;
    /// The kind nearest to `name`, or empty if none is near enough to be meant.
    std::string_view nearest_kind(std::string_view name) const;
    /// The names of the gallery files in the library, sorted.
    std::vector<std::string> gallery_files() const;

private:
    std::filesystem::path folder_;
    std::shared_ptr<const std::vector<LibraryPattern>> patterns_;
};

}  // namespace sikku
