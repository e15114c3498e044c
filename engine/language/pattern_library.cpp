#include "engine/language/pattern_library.h"

#include "engine/base/diagnostic.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <tuple>

namespace sikku {
namespace {

/// Beside the program, in a build folder as after installation.
std::filesystem::path bundled_folder() {
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) {
        auto folder = (program.parent_path() / SIKKU_PATTERNS_RELATIVE).lexically_normal();
        if (std::filesystem::is_directory(folder, error)) return folder;
    }
    return SIKKU_PATTERNS_INSTALLED;
}

std::vector<LibraryPattern> listed(const std::filesystem::path& folder) {
    std::vector<LibraryPattern> found;
    std::error_code error;
    for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const auto& path = entry->path();
        if (path.extension() == ".lsys") {
            found.push_back({path.stem().string(), path.parent_path().filename().string(), path});
        }
    }
    if (error == std::errc::too_many_files_open) {
        throw std::runtime_error("cannot list the patterns in '" + folder.string() + "': " + error.message());
    }
    std::sort(found.begin(), found.end(), [](const LibraryPattern& a, const LibraryPattern& b) {
        return std::tie(a.kind, a.name) < std::tie(b.kind, b.name);
    });
    return found;
}

}  // namespace

PatternLibrary::PatternLibrary(const std::filesystem::path& folder)
    : folder_(folder), patterns_(std::make_shared<const std::vector<LibraryPattern>>(listed(folder))) {}

const PatternLibrary& PatternLibrary::bundled() {
    static const PatternLibrary library(bundled_folder());
    return library;
}

const LibraryPattern* PatternLibrary::find(std::string_view name) const {
    const auto found = std::find_if(patterns_->begin(), patterns_->end(),
                                    [&](const LibraryPattern& pattern) { return pattern.name == name; });
    return found == patterns_->end() ? nullptr : &*found;
}

std::string_view PatternLibrary::nearest(std::string_view name) const {
    std::vector<std::string_view> names;
    for (const LibraryPattern& pattern : *patterns_) names.push_back(pattern.name);
    return sikku::nearest(name, names);
}

std::string PatternLibrary::gallery_file(const std::string& name) const {
    std::error_code error;
    if (name.empty() || std::filesystem::exists(name, error)) return name;
    const auto known = folder_ / "posters" / (name + ".toml");
    return std::filesystem::exists(known, error) ? known.string() : name;
}

}  // namespace sikku
