#include "engine/language/surface.h"

#include "engine/base/characters.h"
#include "engine/base/input_file.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace sikku {
namespace {

constexpr double farthest = 1e9;  // coordinate

/// Divides a text into words; a ':' ends a word.
class Words {
public:
    explicit Words(const Span& text) : text_(text) {}
    /// The next word, empty at the end.
    Span next() {
        std::string_view rest = text_.view();
        const std::string_view word = take_word(rest, " \t\r\n");
        const std::size_t length = std::min(word.find(':'), word.size() - 1) + 1;  // 0 for an empty word
        const Span found = text_.part(text_.length - rest.size() - word.size(), length);
        text_ = text_.part(text_.length - rest.size() - word.size() + length);
        return found;
    }

private:
    Span text_;
};

std::optional<double> coordinate(const Span& word) {
    double value = 0;
    if (!read_number(word.view(), value) || !(std::fabs(value) <= farthest)) return std::nullopt;
    return value;
}

/// Reads a surface file line by line; stops at the first error.
class SurfaceReader {
public:
    SurfaceReader(const SourcePointer& source, Diagnostics& diagnostics)
        : source_(source), diagnostics_(diagnostics) {}

    Surface read() {
        next_line();
        if (!expect("# # # # # #", "the bounds xmin xmax ymin ymax zmin zmax")) return surface_;
        read_settings();
        while (!failed_ && !line_.empty()) read_patch();
        if (!failed_ && surface_.patches.empty()) fail(line_, "expected the name of a patch");
        if (!failed_) name_neighbours();
        return std::move(surface_);
    }

private:
    /// Advances to the next line with text; an empty one is the end.
    void next_line() {
        const std::string& text = source_->text();
        do {
            const std::size_t end = std::min(text.find('\n', at_), text.size());
            line_ = Span{source_, std::min(at_, end), end - std::min(at_, end)}.trimmed();
            at_ = end + 1;
        } while (line_.empty() && at_ < text.size());
    }

    void fail(const Span& where, const std::string& message) {
        if (!failed_) diagnostics_.error(where, message);
        failed_ = true;
    }

    /// Reads a line of that form, in which # is a number and * a word, and advances; false after an error.
    bool expect(std::string_view form, std::string_view what) {
        numbers_.clear();
        names_.clear();
        if (line_.empty()) fail(line_, fmt::format("the file ends; expected {}", what));
        Words words(line_);
        while (!failed_ && !form.empty()) {
            const std::string_view wanted = form.substr(0, form.find(' '));
            form.remove_prefix(std::min(form.size(), wanted.size() + 1));
            const Span word = words.next();
            if (wanted == "#") {
                const auto value = coordinate(word);
                if (!value) fail(word.empty() ? line_ : word, fmt::format("expected a number: {}", what));
                numbers_.push_back(value.value_or(0.0));
            } else if (wanted == "*") {
                if (word.empty()) fail(line_, fmt::format("expected a name or ~: {}", what));
                names_.push_back(word);
            } else if (word.view() != wanted) {
                fail(word.empty() ? line_ : word, fmt::format("expected '{}': {}", wanted, what));
            }
        }
        if (const Span rest = words.next(); !failed_ && !rest.empty()) {
            fail(rest, fmt::format("expected the end of the line: {}", what));
        }
        if (!failed_) next_line();
        return !failed_;
    }

    glm::dvec3 triple(std::size_t at = 0) const { return {numbers_[at], numbers_[at + 1], numbers_[at + 2]}; }

    void read_settings() {
        Span up_line = line_;
        while (!failed_) {
            const std::string_view first = Words(line_).next().view();
            if (first == "PRECISION") {
                expect("PRECISION S: # T: #", "the precision");
            } else if (first == "CONTACT") {
                if (expect("CONTACT POINT X: # Y: # Z: #", "the contact point")) surface_.contact = triple();
            } else if (first == "END") {
                if (expect("END POINT X: # Y: # Z: #", "the end point")) surface_.end = triple();
            } else if (first == "HEADING") {
                up_line = line_;
                if (expect("HEADING X: # Y: # Z: #", "the heading")) surface_.heading = triple();
            } else if (first == "UP") {
                up_line = line_;
                if (expect("UP X: # Y: # Z: #", "the up vector")) surface_.up = triple();
            } else if (first == "SIZE:") {
                const Span where = line_;
                if (expect("SIZE: #", "the size") && !(numbers_[0] > 0)) fail(where, "the size is above 0");
                if (!failed_) surface_.size = numbers_[0];
            } else {
                break;
            }
        }
        make_axes(up_line);
    }

    void make_axes(const Span& where) {
        const double length = glm::length(surface_.heading);
        if (length > 0) surface_.heading /= length;
        const glm::dvec3 up = surface_.up - surface_.heading * glm::dot(surface_.heading, surface_.up);
        const double height = glm::length(up);
        if (!(length > 0) || !(height > 1e-9 * glm::length(surface_.up))) {
            return fail(where, "heading and up point into two directions, neither of length 0");
        }
        surface_.up = up / height;
    }

    void read_patch() {
        if (surface_.patches.size() >= most_patches) {
            return fail(line_, fmt::format("a surface has at most {} patches", most_patches));
        }
        if (!expect("*", "the name of a patch")) return;
        patch_names_.push_back(names_[0]);
        Patch patch;
        if (!expect("TOP COLOR: # DIFFUSE: # BOTTOM COLOR: # DIFFUSE: #", "the colours of a patch")) return;
        patch.colour = static_cast<int>(numbers_[0]);
        std::vector<Span>& around = neighbours_.emplace_back();
        for (const char* form : {"AL: * A: * AR: *", "L: * R: *", "BL: * B: * BR: *"}) {
            if (!expect(form, "the neighbours of a patch")) return;
            around.insert(around.end(), names_.begin(), names_.end());
        }
        for (std::size_t row = 0; row < 4; ++row) {
            if (!expect("# # # # # # # # # # # #", "four points of a patch")) return;
            for (std::size_t i = 0; i < 4; ++i) patch.points[4 * row + i] = triple(3 * i);
        }
        surface_.patches.push_back(std::move(patch));
    }

    void name_neighbours() {
        std::map<std::string_view, std::size_t> known;
        for (std::size_t i = 0; i < patch_names_.size(); ++i) known.emplace(patch_names_[i].view(), i);
        for (std::size_t i = 0; i < neighbours_.size(); ++i) {
            std::set<std::size_t> around;
            for (const Span& name : neighbours_[i]) {
                if (name.view() == "~") continue;
                const auto found = known.find(name.view());
                if (found == known.end()) return fail(name, "no patch has this name");
                around.insert(found->second);
            }
            surface_.patches[i].neighbours.assign(around.begin(), around.end());
        }
    }

    SourcePointer source_;
    Diagnostics& diagnostics_;
    std::size_t at_ = 0;
    Span line_;
    bool failed_ = false;
    std::vector<double> numbers_;
    std::vector<Span> names_;
    std::vector<Span> patch_names_;
    std::vector<std::vector<Span>> neighbours_;
    Surface surface_;
};

bool is_name(std::string_view name) {
    return !name.empty() && name.size() <= 64 && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(), is_letter_or_digit);
}

struct FileEntry {
    Span name, file;
};

/// The entries of `surface: NAME = FILE, …`.
std::vector<FileEntry> file_entries(const Pattern& pattern, Diagnostics* diagnostics) {
    std::vector<FileEntry> entries;
    const Key* key = pattern.find("surface");
    if (!key) return entries;
    const std::string_view text = key->value.view();
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const Span item = key->value.part(begin, end - begin).trimmed();
        const std::size_t equals = std::min(item.view().find('='), item.view().size());
        const FileEntry entry{item.part(0, equals).trimmed(), item.part(equals + 1).trimmed()};
        if (is_name(entry.name.view()) && !entry.file.empty() && entries.size() < most_patches) {
            entries.push_back(entry);
        } else if (diagnostics) {
            diagnostics->error(item.empty() ? key->value : item, "expected NAME = FILE, such as leaf = leaf.s");
        }
        begin = end + 1;
    }
    return entries;
}

std::optional<Patch> inline_patch(const PatchText& text, Diagnostics& diagnostics) {
    constexpr std::string_view blanks = " \t\r\n,";
    std::vector<double> numbers;
    for (const Span& row : text.rows) {
        std::string_view rest = row.view();
        for (auto word = take_word(rest, blanks); !word.empty(); word = take_word(rest, blanks)) {
            const Span where = row.part(row.length - rest.size() - word.size(), word.size());
            const auto value = coordinate(where);
            if (!value) return diagnostics.refuse(where, "expected a coordinate, a number up to 10^9");
            numbers.push_back(*value);
        }
    }
    if (numbers.size() != 48) {
        return diagnostics.refuse(
            text.name,
            fmt::format("a patch has 16 points of three coordinates, 48 numbers; here are {}", numbers.size()));
    }
    Patch patch;
    for (std::size_t i = 0; i < 16; ++i) patch.points[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return patch;
}

/// @param room  bytes that surface files may still have
Surface load_surface(const Pattern& pattern, const FileEntry& entry, std::uint64_t& room, Diagnostics& diagnostics) {
    const std::string name(entry.file.view());
    if (!lower_case(name).ends_with(".s")) {
        diagnostics.error(entry.file, "expected a surface file, whose name ends in .s");
        return {};
    }
    try {
        std::error_code error;
        const std::filesystem::path folder = std::filesystem::path(pattern.source->name()).parent_path();
        std::filesystem::path path = folder / name;
        if (!std::filesystem::exists(path, error)) path = name;
        if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
            throw std::runtime_error("this is not a regular file");
        }
        const InputFile file(path);
        if (file.size() > room) throw std::runtime_error("the surface files of a pattern have at most 4 MB in all");
        room -= file.size();
        Diagnostics own;
        const SourcePointer source = read_source(name, file.read(0, file.size()), own);
        Surface surface = own.has_errors() ? Surface() : read_surface(source, own);
        for (const Diagnostic& diagnostic : own.list()) diagnostics.add(diagnostic);
        surface.source = source;
        return surface;
    } catch (const std::runtime_error& error) {
        diagnostics.error(entry.file, fmt::format("'{}' cannot be read: {}", printable(name), error.what()));
    }
    return {};
}

}  // namespace

Surface read_surface(const SourcePointer& source, Diagnostics& diagnostics) {
    return SurfaceReader(source, diagnostics).read();
}

std::vector<std::shared_ptr<const Surface>> read_surfaces(const Pattern& pattern, Diagnostics& diagnostics) {
    std::map<std::string, Surface> surfaces;
    std::uint64_t room = most_surface_bytes;
    std::size_t patches = pattern.patches.size();
    for (const FileEntry& entry : file_entries(pattern, &diagnostics)) {
        const auto [found, fresh] = surfaces.try_emplace(std::string(entry.name.view()));
        if (fresh) {
            found->second = load_surface(pattern, entry, room, diagnostics);
            const std::size_t before = patches;
            patches += found->second.patches.size();
            if (before <= most_patches && patches > most_patches) {
                diagnostics.error(entry.file, fmt::format("a pattern has at most {} patches in all", most_patches));
            }
        } else {
            diagnostics.error(entry.name, fmt::format("there are two surfaces '{}'", entry.name.view()));
        }
    }
    for (const PatchText& text : pattern.patches) {
        if (!is_name(text.name.view())) {
            diagnostics.error(text.name, "a name is letters and digits, beginning with a letter");
            continue;
        }
        Surface& surface = surfaces[std::string(text.name.view())];
        if (surface.source) {
            diagnostics.error(text.name, fmt::format("there are two surfaces '{}'", text.name.view()));
        } else if (auto patch = inline_patch(text, diagnostics)) {
            surface.is_smooth = true;
            surface.patches.push_back(std::move(*patch));
        }
    }
    std::vector<std::shared_ptr<const Surface>> result;
    for (auto& [name, surface] : surfaces) {
        surface.name = name;
        result.push_back(std::make_shared<const Surface>(std::move(surface)));
    }
    return result;
}

std::vector<std::string> surface_names(const Pattern& pattern) {
    std::set<std::string> names;
    for (const FileEntry& entry : file_entries(pattern, nullptr)) names.emplace(entry.name.view());
    for (const PatchText& text : pattern.patches) {
        if (is_name(text.name.view())) names.emplace(text.name.view());
    }
    return {names.begin(), names.end()};
}

}  // namespace sikku
