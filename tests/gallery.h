// tests/gallery.h: what the tests of `sikku gallery` share.
#pragma once

#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace sikku {

/// Every file of a folder, hidden ones too, with what it holds.
inline std::map<std::string, std::string> tree(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files[std::filesystem::relative(entry.path(), folder).string()] = contents(entry.path());
        }
    }
    return files;
}

/// Names of the files that differ, for messages.
inline std::string differences(const std::map<std::string, std::string>& one,
                               const std::map<std::string, std::string>& two) {
    std::string text;
    for (const auto& [name, held] : one) {
        const auto other = two.find(name);
        if (other == two.end() || other->second != held) text += name + "\n";
    }
    for (const auto& [name, held] : two) {
        if (!one.contains(name)) text += name + "\n";
    }
    return text;
}

inline std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Waits until `is_true`; false after a minute.
template <typename Condition>
bool await(const Condition& is_true) {
    for (int i = 0; i < 12'000; ++i) {
        if (is_true()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

/// Whether a file of this name is being written in `folder`.
inline bool has_temporary(const std::filesystem::path& folder, const std::string& name) {
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().filename().string().starts_with("." + name + ".")) return true;
    }
    return false;
}

inline const std::string square_text = "axiom: F-F-F-F\nderivation length: 2\nF --> F-F+F+FF-F-F+F\n";

inline const std::string small_gallery =
    "size = '50x50mm'\n"
    "dpi = 100\n"
    "format = ['svg', 'png']\n"
    "[[item]]\n"
    "pattern = 'square.lsys'\n"
    "n = '0:3'\n"
    "[[item]]\n"
    "pattern = ['hilbert', 'dragon']\n"
    "n = [2, 5]\n"
    "angle = '80:90:10'\n"
    "[[item]]\n"
    "pattern = 'hilbert-in-c'\n"
    "format = 'mid'\n"
    "humanise = 0.5\n"
    "seed = '1:3'\n";
constexpr std::size_t small_count = 8 + 16 + 3;

/// A folder with the small gallery in it.
class GalleryTest : public ::testing::Test {
protected:
    GalleryTest() {
        folder.write("square.lsys", square_text);
        folder.write("gallery.toml", small_gallery);
    }
    Outcome gallery(std::vector<std::string> arguments,
                    std::vector<std::pair<std::string, std::string>> environment = {}) const {
        arguments.insert(arguments.begin(), "gallery");
        return run(arguments, {.folder = folder.path(), .environment = std::move(environment)});
    }
    Outcome small(const std::string& output, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"--file", "gallery.toml", "-o", output});
        return gallery(std::move(more));
    }
    ScratchFolder folder;
};

}  // namespace sikku
