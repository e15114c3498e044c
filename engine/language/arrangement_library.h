// engine/language/arrangement_library.h: finds the bundled arrangements.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Names of the bundled arrangements, sorted.
std::vector<std::string> bundled_arrangements();

/// The file of a bundled arrangement; nullopt if none has that name.
std::optional<std::filesystem::path> bundled_arrangement(std::string_view name);

}  // namespace sikku
