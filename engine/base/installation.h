// engine/base/installation.h: finds the data that is installed with the libraries.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sikku {

/// Sets the data folder, which contains the bundled patterns as `patterns`, for programs outside of the installation.
/// Call it before the first pattern is loaded; empty: unset. Programs linked by the CMake package do not need it.
void set_data_folder(const std::filesystem::path& folder);

/// Candidates for the data folder, best first. If the environment variable SIKKU_DATA is set, it is the only
/// candidate. Otherwise: the folder of set_data_folder(), the folder installed with the running program or shared
/// library and, for a program outside of an installation, the configured folder if it states this version. Folders
/// that state another version (in the file `version`) are left out, so the list may be empty.
std::vector<std::filesystem::path> data_folders();

/// Which data folder was left out because it states another version; empty if none was.
std::string refused_data();

/// Explains why no bundled patterns were found: `/usr/share/sikku/patterns contains no patterns`. For errors.
std::string missing_patterns();

/// The first file or folder that exists at a path relative to a data folder; otherwise the last path searched, which
/// is empty if all data folders are left out.
std::filesystem::path installed_file(const std::filesystem::path& relative);

// CMake's package defines SIKKU_DATA_FOLDER for programs that link the libraries, and pkg-config SIKKU_DATA_PATH,
// without the quotation marks that would not survive in `c++ $(pkg-config --cflags sikku)`.
#ifdef SIKKU_DATA_PATH
#pragma push_macro("linux")
#pragma push_macro("unix")
#undef linux
#undef unix
#define SIKKU_QUOTED(path) #path
#define SIKKU_QUOTED_VALUE(path) SIKKU_QUOTED(path)
inline const bool has_data_folder = (set_data_folder(SIKKU_QUOTED_VALUE(SIKKU_DATA_PATH)), true);
#undef SIKKU_QUOTED_VALUE
#undef SIKKU_QUOTED
#pragma pop_macro("unix")
#pragma pop_macro("linux")
#elif defined SIKKU_DATA_FOLDER
inline const bool has_data_folder = (set_data_folder(SIKKU_DATA_FOLDER), true);
#endif

}  // namespace sikku
