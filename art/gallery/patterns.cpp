#include "art/gallery/patterns.h"

#include "engine/base/text.h"
#include "engine/language/arrangement_library.h"

#include "art/gallery/values.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <set>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_entries = 1'000'000;
constexpr std::size_t most_total_bytes = std::size_t{1} << 30;
constexpr std::size_t longest_word = 4096;

bool has_wildcards(std::string_view word) {
    return word.find_first_of("*?[") != std::string_view::npos;
}

/// Position after the set `[…]` that begins at `at`; npos if it does not end. `fits` is set to whether the set
/// contains the byte.
std::size_t read_set(std::string_view form, std::size_t at, char byte, bool& fits) {
    const bool is_not = at + 1 < form.size() && (form[at + 1] == '!' || form[at + 1] == '^');
    std::size_t i = at + (is_not ? 2 : 1);
    const std::size_t first = i;
    bool is_listed = false;
    for (; i < form.size() && (form[i] != ']' || i == first); ++i) {
        if (form[i] == '\\' && i + 1 < form.size()) ++i;
        const auto low = static_cast<unsigned char>(form[i]);
        auto high = low;
        if (i + 2 < form.size() && form[i + 1] == '-' && form[i + 2] != ']') {
            i += 2;
            if (form[i] == '\\' && i + 1 < form.size()) ++i;
            high = static_cast<unsigned char>(form[i]);
        }
        const auto value = static_cast<unsigned char>(byte);
        is_listed = is_listed || (low <= value && value <= high);
    }
    if (i >= form.size()) return std::string_view::npos;
    fits = is_listed != is_not;
    return i + 1;
}

/// Position after the element for one byte at `at` if that byte matches; npos otherwise.
std::size_t fit_one(std::string_view form, std::size_t at, char byte) {
    if (form[at] == '?') return at + 1;
    if (form[at] == '[') {
        bool fits = false;
        const std::size_t end = read_set(form, at, byte, fits);
        if (end != std::string_view::npos) return fits ? end : std::string_view::npos;
    }
    if (form[at] == '\\' && at + 1 < form.size()) ++at;
    return form[at] == byte ? at + 1 : std::string_view::npos;
}

/// Follows a path with wildcards from folder to folder. Folders reachable in several ways are entered once, so
/// `*/../*/..` costs no more than `*`.
class Walk {
public:
    Walk(std::size_t& entries, const std::string& place, const Monitor& monitor)
        : entries_(entries), place_(place), monitor_(monitor) {}

    /// Files that end in `.lsys`, or in `.toml` if the last part does, sorted.
    std::vector<std::filesystem::path> find(const std::filesystem::path& folder, const std::string& word) {
        const std::filesystem::path form = word;
        std::vector<std::filesystem::path> reached = {form.is_absolute() ? "/" : folder};
        const auto parts = form.relative_path();
        for (auto part = parts.begin(); part != parts.end(); ++part) {
            const bool is_last = std::next(part) == parts.end();
            reached = step(reached, part->string(), is_last);
        }
        std::sort(reached.begin(), reached.end(),
                  [](const auto& a, const auto& b) { return a.native() < b.native(); });
        return reached;
    }

    /// Files that end in `.lsys` in the folder and below it, sorted. Links to folders are not followed.
    std::vector<std::filesystem::path> below(const std::filesystem::path& folder) {
        std::vector<std::filesystem::path> files;
        std::error_code error;
        for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            count();
            std::error_code unknown;
            if (entry->path().extension() == ".lsys" && entry->is_regular_file(unknown))
                files.push_back(entry->path());
        }
        if (error) fail(place_, fmt::format("{}: {}", folder.string(), error.message()));
        std::sort(files.begin(), files.end());
        return files;
    }

private:
    void count() {
        if (++entries_ % 256 == 0) monitor_.check();
        if (entries_ > most_entries) {
            fail(place_, fmt::format("too many files and folders to search: at most {}", most_entries));
        }
    }

    std::vector<std::filesystem::path> step(const std::vector<std::filesystem::path>& folders,
                                            const std::string& part, bool is_last) {
        std::vector<std::filesystem::path> reached;
        std::set<std::pair<dev_t, ino_t>> seen;
        const auto add = [&](const std::filesystem::path& path) {
            count();
            struct stat status {};
            if (is_last && path.extension() != (part.ends_with(".toml") ? ".toml" : ".lsys")) return;
            if (::stat(path.c_str(), &status) != 0) return;
            // A named pipe would wait for its writer.
            if (is_last ? !S_ISREG(status.st_mode) : !S_ISDIR(status.st_mode)) return;
            if (is_last || seen.emplace(status.st_dev, status.st_ino).second) reached.push_back(path);
        };
        for (const auto& folder : folders) {
            if (!has_wildcards(part)) {
                add(folder / without_escapes(part));
                continue;
            }
            std::vector<std::filesystem::path> names;
            std::error_code error;
            const std::filesystem::path here = folder.empty() ? "." : folder;
            for (std::filesystem::directory_iterator entry(here, error), end; !error && entry != end;
                 entry.increment(error)) {
                count();
                const std::string name = entry->path().filename().string();
                const bool is_hidden = name.starts_with('.') && !part.starts_with('.');
                if (!is_hidden && fits_wildcards(part, name)) names.push_back(folder / name);
            }
            std::sort(names.begin(), names.end());
            for (const auto& name : names) add(name);
        }
        return reached;
    }

    static std::string without_escapes(const std::string& part) {
        std::string text;
        for (std::size_t i = 0; i < part.size(); ++i) {
            if (part[i] == '\\' && i + 1 < part.size()) ++i;
            text += part[i];
        }
        return text;
    }

    std::size_t& entries_;
    const std::string& place_;
    const Monitor& monitor_;
};

/// @param place  of the name in a file; empty: it was an argument. @throws NotFound, GalleryError
[[noreturn]] void not_found(const std::string& place, const std::string& message) {
    if (place.empty()) throw NotFound(message, true);
    fail(place, message);
}

}  // namespace

bool fits_wildcards(std::string_view form, std::string_view name) {
    constexpr std::size_t none = std::string_view::npos;
    std::size_t at = 0;
    std::size_t i = 0;
    // The last star and the bytes it matches: earlier stars need not be retried.
    std::size_t star = none;
    std::size_t star_end = 0;
    while (i < name.size()) {
        if (at < form.size() && form[at] == '*') {
            star = at++;
            star_end = i;
            continue;
        }
        const std::size_t next = at < form.size() ? fit_one(form, at, name[i]) : none;
        if (next != none) {
            at = next;
            ++i;
        } else if (star != none) {
            at = star + 1;
            i = ++star_end;
        } else {
            return false;
        }
    }
    while (at < form.size() && form[at] == '*') ++at;
    return at == form.size();
}

std::vector<PatternShelf::Pointer> PatternShelf::find_files(const std::string& word,
                                                            const std::filesystem::path& folder,
                                                            const std::string& place, bool& is_folder) {
    std::vector<Pointer> found;
    if (bundled_only_) return found;
    const std::filesystem::path path = folder / word;
    std::error_code error;
    is_folder = std::filesystem::is_directory(path, error);
    if (is_folder) {
        for (const auto& file : Walk(entries_, place, monitor_).below(path)) found.push_back(of_file(file));
    } else if (std::filesystem::exists(path, error)) {
        found.push_back(of_file(path));
    } else if (has_wildcards(word)) {
        for (const auto& file : Walk(entries_, place, monitor_).find(folder, word)) found.push_back(of_file(file));
    }
    return found;
}

PatternShelf::List PatternShelf::find(const std::string& word, const std::filesystem::path& folder,
                                      const std::string& place) {
    List& list = found_[{folder, word}];
    if (list) return list;
    monitor_.check();
    if (word == "-") fail(place, "a gallery reads no pattern from standard input");
    if (word.size() > longest_word) fail(place, fmt::format("no pattern matches '{}'", printable(word, 80)));
    bool is_folder = false;
    std::vector<Pointer> found = find_files(word, folder, place, is_folder);
    if (found.empty()) {
        // The folder of a gallery may have the name of a kind.
        for (const LibraryPattern& pattern : known()) {
            const std::string full = pattern.kind + "/" + pattern.name;
            const bool is_full = word.find('/') != std::string::npos;
            if (pattern.kind == word || fits_wildcards(word, is_full ? full : pattern.name)) {
                found.push_back(of_known(pattern));
            }
        }
    }
    if (found.empty()) find_bundled_pieces(word, found);
    if (!found.empty()) {
        list = std::make_shared<const std::vector<Pointer>>(std::move(found));
        return list;
    }
    if (is_folder) fail(place, fmt::format("{}: this folder contains no patterns", (folder / word).string()));
    if (known().empty()) {
        not_found(place, fmt::format("no file is named '{}', and {}", printable(word, 80), missing_patterns()));
    }
    if (has_wildcards(word)) fail(place, fmt::format("no pattern matches '{}'", printable(word, 80)));
    // The word may also resemble a kind of patterns: `kolams`.
    const std::string_view kind = PatternLibrary::bundled().nearest_kind(word);
    const auto similar = kind.empty() ? PatternLibrary::bundled().similar(word) : std::vector{kind};
    not_found(place, fmt::format("no file or pattern named '{}'{}", printable(word, 80), did_you_mean(similar)));
}

void PatternShelf::find_bundled_pieces(const std::string& word, std::vector<Pointer>& found) {
    if (!pieces_.interpreter) return;
    constexpr std::string_view folder = "arrangements";
    for (const std::string& name : bundled_arrangements()) {
        if (word != folder && word != name && word != fmt::format("{}/{}", folder, name)) continue;
        found.push_back(read(*bundled_arrangement(name), name, name + ".toml"));
    }
}

bool PatternShelf::is_piece(const std::filesystem::path& file) const {
    return pieces_.interpreter && lower_case(file.extension().string()) == ".toml";
}

PatternShelf::List PatternShelf::all() {
    std::vector<Pointer> found;
    for (const LibraryPattern& pattern : known()) {
        if (pattern.kind != "words") found.push_back(of_known(pattern));
    }
    if (found.empty()) throw GalleryError(missing_patterns());
    return std::make_shared<const std::vector<Pointer>>(std::move(found));
}

PatternShelf::Pointer PatternShelf::read(const std::filesystem::path& file, const std::string& shown,
                                         const std::string& called) {
    Pointer& known = read_[file.string()];
    if (known) return known;
    monitor_.check();
    GalleryPattern pattern;
    pattern.name = file.stem().string();
    pattern.kind = file.parent_path().filename().string();
    pattern.path = file.string();
    pattern.shown = shown;
    pattern.is_piece = is_piece(file);
    try {
        if (pattern.is_piece) {
            pattern.piece = std::make_shared<const GalleryPiece>(pieces_.read(file, called));
            pattern.text = std::make_shared<PatternText>(PatternText{called, pattern.piece->text});
        } else {
            pattern.text =
                std::make_shared<PatternText>(PatternText{called, read_pattern({file.string(), file}, monitor_)});
        }
        bytes_ += pattern.text->text.size();
    } catch (const std::runtime_error& error) {
        pattern.problem = error.what();
    }
    if (bytes_ > most_total_bytes) throw GalleryError("the patterns of this gallery exceed 1 GB in total");
    known = std::make_shared<const GalleryPattern>(std::move(pattern));
    return known;
}

}  // namespace sikku
