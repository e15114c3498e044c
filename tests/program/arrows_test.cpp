// tests/program/arrows_test.cpp: checks the includes of each room. art and music never include each other; the engine
// includes neither.
#include "art/prints.h"
#include "music/scores.h"

#include "tests/files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace sikku::arrows_test {

struct Include {
    std::string file;  ///< relative to the source folder
    std::string name;
    bool quoted = false;
};

/// Paths of the C++ files of a folder, relative to the source folder.
std::vector<std::string> sources_of(const std::string& folder) {
    const std::filesystem::path root = SIKKU_SOURCE_DIR;
    std::vector<std::string> found;
    if (!std::filesystem::exists(root / folder)) return found;
    using Iterator = std::filesystem::recursive_directory_iterator;
    for (Iterator each(root / folder); each != Iterator(); ++each) {
        const auto& entry = *each;
        // npm packages of the studio page, and replacements for libraries.
        const std::string name = entry.path().filename();
        if (name == "node_modules" || name == "include") each.disable_recursion_pending();
        const std::string extension = entry.path().extension();
        if (extension == ".h" || extension == ".cpp") found.push_back(std::filesystem::relative(entry.path(), root));
    }
    return found;
}

std::vector<Include> includes_of(const std::string& folder) {
    static const std::regex line_form(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::vector<Include> found;
    for (const std::string& file : sources_of(folder)) {
        std::ifstream stream(std::filesystem::path(SIKKU_SOURCE_DIR) / file);
        for (std::string line; std::getline(stream, line);) {
            std::smatch match;
            if (std::regex_search(line, match, line_form)) found.push_back({file, match[2], match[1] == "\""});
        }
    }
    return found;
}

/// The room of a file, which is its folder. Files directly in `art` or `music` are the public interface of the
/// library.
std::string room_of(const std::string& file) {
    return std::filesystem::path(file).parent_path().string();
}

/// A room, and the rooms and libraries that it may include from.
struct Room {
    std::string name;
    std::string rooms;      ///< rooms of the project
    std::string libraries;  ///< libraries other than the standard library, fmt, and GLM's vectors
};

/// All permitted includes. Each room includes only from rooms above it in this list, so there are no cycles.
const std::vector<Room>& rooms() {
    static const std::vector<Room> table = {
        {"engine/base", "", "boost fast_float json tbb posix toml zlib"},
        {"engine/language", "engine/base", ""},
        {"engine/derivation", "engine/base engine/language", "boost"},
        {"engine/import", "engine/base engine/language engine/derivation", ""},
        {"engine/map", "engine/base engine/language engine/derivation", ""},
        {"engine/geometry", "engine/base engine/language engine/derivation", "boost"},
        {"engine/measure", "engine/base engine/language engine/derivation engine/geometry", "boost"},
        {"engine/tiling", "engine/base engine/language engine/derivation engine/geometry", "boost"},
        {"engine", "engine/*", ""},
        {"art/style", "engine/*", ""},
        {"art/print", "engine/* art/style", ""},
        {"art/kolam", "engine/* art/style art/print", "boost"},
        {"art/hand", "engine/* art/style art/print", ""},
        {"art/vector", "engine/* art/style art/print", "zlib"},
        {"art/provenance", "engine/* art/print art/vector", "zlib"},
        {"art/raster", "engine/* art/style art/print", ""},
        {"art/plotter", "engine/* art/style art/print", ""},
        {"art/space", "engine/* art/style art/print art/raster", "posix"},
        {"art/relief", "engine/* art/style art/print art/kolam art/plotter art/space", ""},
        {"art/module", "engine/*", "posix"},
        {"art/font", "engine/* art/module", "harfbuzz fribidi fontconfig"},
        {"art/image", "engine/* art/module", "oiio lcms posix zlib"},
        {"art/decoder", "art/image", "oiio heif posix zlib"},
        {"art/drawing", "engine/* art/style art/print art/kolam art/hand art/raster art/plotter art/space art/font",
         ""},
        {"art/tiles", "engine/* art/style art/print art/plotter art/drawing", ""},
        {"art/deep", "engine/* art/style art/print art/raster art/drawing art/tiles", ""},
        {"art/writer",
         "engine/* art/style art/print art/vector art/raster art/plotter art/space art/relief art/image art/drawing "
         "art/tiles art/deep",
         ""},
        {"art/motion", "engine/* art/style art/print art/vector art/raster art/image art/drawing art/writer", ""},
        {"art/words", "engine/* art/vector", ""},
        {"art/cutting",
         "engine/* art/style art/print art/vector art/plotter art/image art/drawing art/tiles art/writer", ""},
        {"art/sheet", "engine/* art/style art/print art/vector art/raster art/font art/image art/drawing art/writer",
         ""},
        {"art/product",
         "engine engine/* art/style art/print art/raster art/plotter art/relief art/font art/image art/drawing "
         "art/writer "
         "art/motion art/sheet",
         ""},
        {"art", "engine engine/* art/*", ""},
        {"art/workbook",
         "engine engine/* art art/style art/print art/kolam art/drawing art/writer art/motion art/sheet art/product",
         ""},
        {"art/gallery", "engine engine/* art art/style art/print art/image art/sheet art/product", "json posix"},
        {"art/link", "engine/*", "json"},
        {"art/reading", "engine/* art art/kolam art/image", "json pugixml"},
        {"music/scale", "engine/*", ""},
        {"music/score", "engine/* music/scale", "posix zlib"},
        {"music/melody", "engine/* music/scale music/score", ""},
        {"music/form", "engine/* music/scale music/score music/melody", ""},
        {"music", "engine engine/* music/*", ""},
        {"music/live", "engine/* music music/score", "alsa liblo posix"},
        {"studio/editor", "engine engine/* art art/style art/product music music/scale music/melody", "json"},
        {"cli", "engine engine/* art art/* music music/* studio/editor", "cli11 json toml posix"},
        {"python",
         "engine engine/* art art/gallery art/kolam art/provenance art/reading art/workbook music music/score",
         "pybind11 posix"},
        {"studio", "engine engine/* art art/* music music/* studio/editor", "json"},
        {"studio/tests", "studio", ""},
        {"studio/wasm", "engine/* art/font art/image studio", "zlib emscripten"},
    };
    return table;
}

bool allows(const std::string& rooms, const std::string& room) {
    std::istringstream words(rooms);
    for (std::string word; words >> word;) {
        if (word == room || (word.ends_with("/*") && room.starts_with(word.substr(0, word.size() - 1)))) return true;
    }
    return false;
}

/// The library that a header in angle brackets belongs to; empty for the standard library.
std::string library_of(const std::string& name) {
    static const std::map<std::string, std::string> folders = {{"alsa", "alsa"},
                                                               {"boost", "boost"},
                                                               {"lo", "liblo"},
                                                               {"fmt", "fmt"},
                                                               {"glm", "glm"},
                                                               {"oneapi", "tbb"},
                                                               {"tbb", "tbb"},
                                                               {"OpenImageIO", "oiio"},
                                                               {"CLI", "cli11"},
                                                               {"toml++", "toml"},
                                                               {"nlohmann", "json"},
                                                               {"sys", "posix"},
                                                               {"fast_float", "fast_float"},
                                                               {"embedded", ""},
                                                               {"libheif", "heif"},
                                                               {"linux", "posix"},
                                                               {"pybind11", "pybind11"},
                                                               {"fontconfig", "fontconfig"}};
    static const std::map<std::string, std::string> files = {
        {"zlib.h", "zlib"},     {"lcms2.h", "lcms"},        {"fcntl.h", "posix"},    {"unistd.h", "posix"},
        {"dlfcn.h", "posix"},   {"pugixml.hpp", "pugixml"}, {"link.h", "posix"},     {"signal.h", "posix"},
        {"spawn.h", "posix"},   {"sched.h", "posix"},       {"poll.h", "posix"},     {"malloc.h", "posix"},
        {"termios.h", "posix"}, {"immintrin.h", ""},        {"emmintrin.h", ""},     {"lcms2_plugin.h", "lcms"},
        {"netdb.h", "posix"},   {"dirent.h", "posix"},      {"pthread.h", "posix"},  {"emscripten.h", "emscripten"},
        {"hb.h", "harfbuzz"},   {"hb-ot.h", "harfbuzz"},    {"fribidi.h", "fribidi"}};
    if (const auto file = files.find(name); file != files.end()) return file->second;
    const std::size_t slash = name.find('/');
    if (slash == std::string::npos) return name.find('.') == std::string::npos ? "" : name;
    const auto folder = folders.find(name.substr(0, slash));
    return folder == folders.end() ? name : folder->second;
}

TEST(Arrows, EachRoomSeesOnlyRoomsBelowIt) {
    std::set<std::string> known;
    for (const Room& room : rooms()) {
        known.insert(room.name);
        const auto list = includes_of(room.name);
        EXPECT_FALSE(list.empty()) << room.name;
        for (const auto& [file, name, quoted] : list) {
            if (room_of(file) != room.name) continue;  // belongs to a room in a subfolder
            if (!quoted || room_of(name) == room.name || !std::filesystem::path(name).has_parent_path()) continue;
            EXPECT_TRUE(known.contains(room_of(name))) << file << " includes " << name << ", which is above it";
            EXPECT_TRUE(allows(room.rooms, room_of(name))) << file << " includes " << name;
        }
    }
    for (const char* folder : {"engine", "art", "music", "cli", "python", "studio"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            EXPECT_TRUE(known.contains(room_of(file))) << file << " is in a room without a row in the table";
        }
    }
}

TEST(Arrows, EachRoomUsesOnlyItsLibraries) {
    for (const Room& room : rooms()) {
        for (const auto& [file, name, quoted] : includes_of(room.name)) {
            if (room_of(file) != room.name) continue;
            const std::string library = quoted ? "" : library_of(name);
            if (library.empty() || library == "fmt" || library == "glm") continue;
            EXPECT_TRUE(allows(room.libraries, library)) << file << " includes <" << name << ">";
        }
    }
}

/// Headers that are installed, by the list `public_headers(…)` of each library.
std::set<std::string> public_headers() {
    static const std::regex header(R"([\w/]+\.h)");
    std::set<std::string> found;
    for (const std::string folder : {"engine", "art", "music"}) {
        const std::string lists = contents(std::filesystem::path(SIKKU_SOURCE_DIR) / folder / "CMakeLists.txt");
        const std::size_t begin = lists.find("public_headers(");
        const std::string list = lists.substr(begin, lists.find(')', begin) - begin);
        for (std::sregex_iterator each(list.begin(), list.end(), header), end; each != end; ++each) {
            found.insert(folder + "/" + each->str());
        }
    }
    return found;
}

/// Users of the libraries install GLM, but neither fmt nor Boost.
TEST(Arrows, PublicHeadersIncludeOnlyPublicHeadersAndGlm) {
    const std::set<std::string> headers = public_headers();
    EXPECT_GT(headers.size(), 40u);
    EXPECT_LE(headers.size(), 60u);
    for (const char* folder : {"engine", "art", "music"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            if (!headers.contains(file)) continue;
            EXPECT_TRUE(!quoted || headers.contains(name)) << file << " includes " << name;
            EXPECT_TRUE(quoted || library_of(name).empty() || library_of(name) == "glm")
                << file << " includes <" << name << ">";
        }
    }
}

TEST(Arrows, OpenImageIoStaysInsideTheModuleAndTheDecoder) {
    std::set<std::string> users;
    for (const char* folder : {"engine", "art", "music", "cli", "python", "studio"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            if (name.starts_with("OpenImageIO/")) users.insert(file);
        }
    }
    EXPECT_EQ(users, (std::set<std::string>{"art/decoder/picture_reader.cpp", "art/image/image_module.cpp"}));
}

TEST(Arrows, LibrariesOfFontsStayInsideTheModule) {
    std::set<std::string> users;
    for (const char* folder : {"engine", "art", "music", "cli", "python", "studio"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            if (name.starts_with("hb") || name == "fribidi.h" || name.starts_with("fontconfig/")) users.insert(file);
        }
    }
    EXPECT_EQ(users, (std::set<std::string>{"art/font/font_search.cpp", "art/font/font_shaping.cpp",
                                            "art/font/text_runs.cpp", "art/font/text_runs.h"}));
}

/// Two types of one name in a namespace break the one-definition rule as soon as both are used in templates such as
/// std::vector: the linker keeps the functions of one for both.
TEST(Arrows, EachTypeOfANamespaceHasOneDefinition) {
    static const std::regex opened(R"(^(?:inline )?namespace\s*([\w:]*)\s*\{)");
    static const std::regex type(
        R"(^(?:template\s*<.*>\s*)?(?:struct|class|union|enum class|enum)\s+(?:\[\[\w+\]\]\s*)?)"
        R"((\w+)(?:\s+final)?\s*(?::[^:;].*)?\{)");
    std::map<std::string, std::string> places;
    std::size_t types = 0;
    for (const char* folder : {"engine", "art", "music", "cli", "python", "studio"}) {
        for (const std::string& file : sources_of(folder)) {
            std::vector<std::string> spaces;
            std::istringstream lines(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / file));
            for (std::string line; std::getline(lines, line);) {
                std::smatch match;
                if (std::regex_search(line, match, opened)) {
                    spaces.push_back(match[1].length() == 0 ? "(" + file + ")" : match[1].str());
                } else if (line.starts_with("}  // namespace") && !spaces.empty()) {
                    spaces.pop_back();
                } else if (std::regex_search(line, match, type)) {
                    std::string name;
                    for (const std::string& space : spaces) name += space + "::";
                    name += match[1];
                    const auto [place, is_new] = places.emplace(name, file);
                    EXPECT_TRUE(is_new) << name << " is defined in " << place->second << " and in " << file;
                    ++types;
                }
            }
        }
    }
    EXPECT_GT(types, 1000u);
}

/// Libraries name options as 'size'; the program writes `--size`. Recipes in files are command lines, and
/// styles have properties that look like options.
TEST(Arrows, LibrariesDoNotNameOptionsOfTheCommandLine) {
    static const std::regex named(R"(--([a-z]+(?:-[a-z]+)*)(:|\s*\{)?)");
    std::set<std::string, std::less<>> options = {"file", "set", "variant", "seed"};
    for (const Interpreter* interpreter : {&prints(), &scores()}) {
        for (const OptionInfo* option : interpreter->options()) options.emplace(option->name);
    }
    for (const char* folder : {"engine", "art", "music"}) {
        for (const std::string& file : sources_of(folder)) {
            std::istringstream lines(contents(std::filesystem::path(SIKKU_SOURCE_DIR) / file));
            for (std::string line; std::getline(lines, line);) {
                line = line.substr(0, line.find("//"));
                for (std::sregex_iterator each(line.begin(), line.end(), named), end; each != end; ++each) {
                    const std::string before = line.substr(0, static_cast<std::size_t>(each->position()));
                    const bool is_style = (*each)[2].matched || before.ends_with("var(");
                    const bool is_recipe = before.ends_with("\" ") || before.ends_with("== \"");
                    if (is_style || is_recipe || std::count(line.begin(), line.end(), '"') < 2) continue;
                    EXPECT_FALSE(options.contains((*each)[1].str())) << file << ": " << line;
                }
            }
        }
    }
}

TEST(Arrows, QuotedNamesStartAtTheSourceFolder) {
    for (const char* folder : {"engine", "art", "music", "cli", "python", "studio", "tests"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            if (!quoted) continue;
            EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(SIKKU_SOURCE_DIR) / name))
                << file << " includes " << name;
        }
    }
}

}  // namespace sikku::arrows_test
