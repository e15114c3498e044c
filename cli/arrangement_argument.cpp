#include "cli/arrangement_argument.h"

#include "cli/command.h"
#include "engine/base/input_file.h"
#include "engine/language/arrangement_library.h"

#include <fmt/format.h>

#include <system_error>

namespace sikku {

bool is_arrangement(const std::string& name) {
    if (lower_case(name).ends_with(".toml")) return true;
    std::error_code error;
    return !std::filesystem::exists(name, error) && bundled_arrangement(name).has_value();
}

namespace {

std::filesystem::path path_of(const std::string& name) {
    std::error_code error;
    if (!std::filesystem::exists(name, error)) {
        if (const auto bundled = bundled_arrangement(name)) return *bundled;
    }
    return name;
}

NamedArrangement read_from(const std::filesystem::path& path, const std::string& name, bool reads_input) {
    std::string text;
    try {
        text = read_file(path, name, most_toml_bytes, stop_monitor());
    } catch (const std::runtime_error& problem) {
        throw UsageError(problem.what());
    }
    const std::filesystem::path folder = path.parent_path();
    const auto read = [&](const std::string& pattern) {
        if (pattern == "-" && !reads_input)
            throw UsageError(name + ": a gallery reads no pattern from standard input");
        NamedText found = read_pattern_text(pattern);
        return NamedPattern{std::move(found.name), std::move(found.text)};
    };
    return {read_arrangement(name, text, beside_first(folder, read)), folder};
}

}  // namespace

NamedArrangement read_arrangement_argument(const std::string& name) {
    return read_from(path_of(name), name, true);
}

NamedArrangement read_arrangement_file(const std::filesystem::path& path, const std::string& name) {
    return read_from(path, name, false);
}

std::vector<std::filesystem::path> files_of_arrangement(const std::string& name) {
    std::vector<std::filesystem::path> files = {path_of(name)};
    try {
        const FileValue root = read_toml(name, read_file(files.front(), name, most_toml_bytes, stop_monitor()));
        for (const auto& [key, value] : root.table) {
            if (key != "track") continue;
            for (const FileValue& track : value.list) {
                for (const auto& [inner, pattern] : track.table) {
                    if (inner != "pattern") continue;
                    std::error_code error;
                    const std::filesystem::path beside = files.front().parent_path() / pattern.text;
                    const bool is_beside = std::filesystem::exists(beside, error);
                    files.push_back(is_beside ? beside : find_pattern(pattern.text).path);
                }
            }
        }
    } catch (const std::runtime_error&) {
        // Errors are reported when the arrangement is read.
    }
    return files;
}

}  // namespace sikku
