#include "engine/language/pattern_library.h"

#include "engine/language/arrangement_library.h"

#include "engine/base/diagnostic.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <tuple>

namespace sikku {
namespace {

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

/// Names of the TOML files in a folder of a library, sorted. @param library  empty: there is none
std::vector<std::string> toml_names(const std::filesystem::path& library, const char* kind) {
    std::vector<std::string> names;
    if (library.empty()) return names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(library / kind, error)) {
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

std::vector<std::string> bundled_arrangements() {
    return toml_names(installed_file("patterns"), "arrangements");
}

std::optional<std::filesystem::path> bundled_arrangement(std::string_view name) {
    const std::vector<std::string> names = bundled_arrangements();
    if (std::find(names.begin(), names.end(), name) == names.end()) return std::nullopt;
    return installed_file("patterns") / "arrangements" / (std::string(name) + ".toml");
}

PatternLibrary::PatternLibrary(const std::filesystem::path& folder)
    : folder_(folder), patterns_(std::make_shared<const std::vector<LibraryPattern>>(listed(folder))) {}

const PatternLibrary& PatternLibrary::bundled() {
    static const PatternLibrary library(installed_file("patterns"));
    return library;
}

const LibraryPattern* PatternLibrary::find(std::string_view name) const {
    const auto found = std::find_if(patterns_->begin(), patterns_->end(),
                                    [&](const LibraryPattern& pattern) { return pattern.name == name; });
    return found == patterns_->end() ? nullptr : &*found;
}

std::vector<std::string_view> PatternLibrary::similar(std::string_view name) const {
    constexpr std::size_t most = 3;
    std::vector<std::string_view> names, longer;
    for (const LibraryPattern& pattern : *patterns_) {
        names.push_back(pattern.name);
        if (name.size() > 1 && names.back().starts_with(name) && longer.size() < most) longer.push_back(pattern.name);
    }
    if (!longer.empty()) return longer;
    const std::string_view near = sikku::nearest(name, names);
    return near.empty() ? longer : std::vector{near};
}

std::string_view PatternLibrary::nearest_kind(std::string_view name) const {
    std::vector<std::string_view> kinds;
    for (const LibraryPattern& pattern : *patterns_) kinds.push_back(pattern.kind);
    return sikku::nearest(name, kinds);
}

std::vector<std::string> PatternLibrary::gallery_files() const {
    return toml_names(folder_, "posters");
}

std::string PatternLibrary::gallery_file(const std::string& name) const {
    std::error_code error;
    if (name.empty() || folder_.empty() || std::filesystem::exists(name, error)) return name;
    const auto known = folder_ / "posters" / (name + ".toml");
    return std::filesystem::exists(known, error) ? known.string() : name;
}

}  // namespace sikku
