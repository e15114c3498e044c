// music/score/child_process.h: files of the programs that render scores.
#pragma once

#include "engine/base/child_process.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sikku::child {

/// Reports that a program is missing. @param what  what it makes: `sound` @param advice  continues "install it": `:
/// apt install lilypond`
/// @throws std::runtime_error always
[[noreturn]] void fail_without(std::string_view what, std::string_view program, std::string_view advice);

/// @throws std::runtime_error that names the file, the attempted action and the cause
[[noreturn]] void fail(const std::filesystem::path& file, std::string_view doing, int error);

void write_all(int descriptor, const char* bytes, std::size_t count, const std::filesystem::path& name);

/// Reads as many bytes as there are, at most `count`.
std::size_t read_at(int descriptor, char* bytes, std::size_t count, std::uint64_t position,
                    const std::filesystem::path& name);

/// Creates a file without a name in the folder of `output`, or in that of temporary files if the former does not
/// support one (such as that of a device). The file vanishes with its last descriptor.
Descriptor nameless_file(const std::filesystem::path& output);

bool is_readable_file(const std::filesystem::path& path);

/// The program of that name in PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// The last lines that a program printed.
std::string last_words(int messages, std::string_view program);

}  // namespace sikku::child
