// engine/language/pattern_library.h: lists a folder of pattern files.
#pragma once

#include "engine/base/installation.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// One pattern file of a library.
struct LibraryPattern {
    std::string name;  ///< name of the file without folder and extension
    std::string kind;  ///< name of its folder: kolams, tilings, …
    std::filesystem::path file;
};

/// The pattern files (`*.lsys`) in a folder and its subfolders. Immutable; copies share the list.
class PatternLibrary {
public:
    /// Lists `folder`; a missing or unreadable folder gives no patterns.
    /// @throws std::runtime_error if too many files are open
    explicit PatternLibrary(const std::filesystem::path& folder);

    /// The bundled patterns, listed on first use: those beside the running program, otherwise the installed ones.
    static const PatternLibrary& bundled();

    const std::filesystem::path& folder() const { return folder_; }
    /// Sorted by kind and name.
    const std::vector<LibraryPattern>& patterns() const& { return *patterns_; }
    /// For temporary libraries, as in a loop over their patterns: returns a copy.
    std::vector<LibraryPattern> patterns() && { return *patterns_; }
    /// The pattern of that name, or null.
    const LibraryPattern* find(std::string_view name) const;
    /// The path of the bundled gallery file posters/NAME.toml, or `name` itself if a file has that name.
    std::string gallery_file(const std::string& name) const;
    /// Names to suggest instead of `name`: up to three that begin with it, otherwise the nearest one.
    std::vector<std::string_view> similar(std::string_view name) const;
    /// The kind nearest to `name`; empty if none is near enough to be meant.
    std::string_view nearest_kind(std::string_view name) const;
    /// The names of the gallery files in the library, sorted.
    std::vector<std::string> gallery_files() const;

private:
    std::filesystem::path folder_;
    std::shared_ptr<const std::vector<LibraryPattern>> patterns_;
};

}  // namespace sikku
