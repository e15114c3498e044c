// engine/base/installation.h: finds the data that is installed with the libraries.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sikku {

/// Sets the data folder, which contains the bundled patterns as `patterns`, for programs outside of the installation.
/// Call it before the first pattern is loaded; empty: unset. Programs linked by the CMake package do not need it.
void set_data_folder(const std::filesystem::path& folder);

/// Candidates for the data folder, best first: that of the environment variable SIKKU_DATA; if it is not set, that of
/// set_data_folder() and the one installed with the running program or shared library; for programs that are not part
/// of an installation the configured one, if it contains this version. Folders that state another version (in the
/// file `version`) are left out. Empty if none remains.
std::vector<std::filesystem::path> data_folders();

/// Why there are no bundled patterns: `there are no patterns in /usr/share/sikku/patterns`. For messages after the
/// search was in vain.
std::string missing_patterns();

/// The first file or folder that exists at a path relative to a data folder; otherwise the last path searched.
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
