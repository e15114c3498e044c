// art/gallery/patterns.h: finds patterns by name, file, folder or wildcards, and reads each once.
#pragma once

#include "engine/base/monitor.h"
#include "engine/language/document.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The text of a pattern and its name in messages.
struct PatternText {
    std::string name;
    std::string text;
};

/// A pattern of a gallery, read once.
struct GalleryPattern {
    std::string name;                         ///< without folder and ending
    std::string kind;                         ///< the folder it lies in
    std::string path;                         ///< to read it, and to find what lies beside it
    std::string shown;                        ///< as a manifest names it
    std::shared_ptr<const PatternText> text;  ///< null if it cannot be read
    std::string problem;                      ///< then: why
};

/// True if the whole of `name` matches `form`, in which `*` stands for any bytes, `?` for one, `[a-z]` and `[!a-z]`
/// for one byte in or not in a set, and `\` quotes the next byte. Time: at most the product of both lengths.
bool fits_wildcards(std::string_view form, std::string_view name);

/// Finds patterns and reads each once. Searches at most a million folder entries and reads at most 1 GB.
class PatternShelf {
public:
    using Pointer = std::shared_ptr<const GalleryPattern>;
    using List = std::shared_ptr<const std::vector<Pointer>>;

    /// @param bundled_only  do not search files
    explicit PatternShelf(bool bundled_only, Monitor monitor = {}) : bundled_only_(bundled_only), monitor_(monitor) {}

    /// @throws GalleryError if none is found, or there are too many entries to search; Stopped
    List find(const std::string& word, const std::filesystem::path& folder, const std::string& place);
    /// All bundled patterns that draw something.
    List all();

private:
    std::vector<Pointer> find_files(const std::string& word, const std::filesystem::path& folder,
                                    const std::string& place, bool& is_folder);
    static const std::vector<LibraryPattern>& known() { return PatternLibrary::bundled().patterns(); }
    Pointer of_known(const LibraryPattern& known) { return read(known.file, known.name, known.name + ".lsys"); }
    Pointer of_file(const std::filesystem::path& file) { return read(file, file.string(), file.string()); }
    Pointer read(const std::filesystem::path& file, const std::string& shown, const std::string& called);

    bool bundled_only_;
    Monitor monitor_;
    std::map<std::string, Pointer> read_;
    std::map<std::pair<std::filesystem::path, std::string>, List> found_;
    std::size_t bytes_ = 0;    // of all texts
    std::size_t entries_ = 0;  // folder entries searched so far
};

}  // namespace sikku
