// tests/files.h: what every test that touches files shares.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace sikku {

/// A folder that is gone after the test.
class ScratchFolder {
public:
    ScratchFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "sikku_test_XXXXXX").string();
        if (!::mkdtemp(pattern.data())) throw std::runtime_error("mkdtemp");
        path_ = pattern;
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    /// The path of a file in it, for a command line.
    std::string file(const std::string& name) const { return (path_ / name).string(); }
    /// Makes a file in it and returns its path.
    std::string write(const std::string& name, std::string_view text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
        return file(name);
    }
    /// Names of what is in it, hidden files too.
    std::vector<std::string> names() const {
        std::vector<std::string> list;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) {
            list.push_back(entry.path().filename().string());
        }
        return list;
    }

private:
    std::filesystem::path path_;
};

inline std::string contents(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// The file of a bundled pattern, such as tilings/chair.
inline std::string bundled(const std::string& name) {
    return std::string(SIKKU_SOURCE_DIR) + "/patterns/" + name + ".lsys";
}

/// The pattern files below a folder of the source, sorted.
inline std::vector<std::filesystem::path> pattern_files(const std::string& folder) {
    std::vector<std::filesystem::path> list;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / folder)) {
        if (entry.path().extension() == ".lsys") list.push_back(entry.path());
    }
    std::sort(list.begin(), list.end());
    return list;
}

}  // namespace sikku
