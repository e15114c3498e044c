// art/module/module.h: finds and loads the modules that are installed beside the data folders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Candidates for the folder of modules and decoders, best first: they lie beside the data folders.
std::vector<std::filesystem::path> module_folders();

/// A number that changes with the program's version and with the sizes of the structures that the program shares with
/// a module (FNV-1a).
constexpr std::uint64_t module_version(std::string_view program, std::initializer_list<std::size_t> sizes) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 0x100000001b3; };
    for (const char byte : program) add(static_cast<unsigned char>(byte));
    for (const std::size_t size : sizes) add(size);
    return hash;
}

/// Loads the module `name`.so that comes with the running program, else the installed one, and calls its only symbol,
/// `name`_module, a function without parameters and with C linkage. It returns a structure that begins with the
/// version of the module. The module is never unloaded.
/// @param needed  beginning of the message if it cannot be loaded: what needs it, and what to install
/// @throws std::runtime_error if it cannot be loaded or has another version
const void* load_module(const std::string& name, std::uint64_t version, const std::string& needed);

}  // namespace sikku
