// tests/tools.h: other people's programs, for the tests that read back what was written.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace sikku {

inline bool has_program(const std::string& name) {
    return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

/// Skips the rest of a test if the program is not installed.
#define NEEDS(program) \
    if (!has_program(program)) GTEST_SKIP() << program " is not installed"

/// Standard output and error of a command, and whether it succeeded.
struct ToolOutcome {
    bool ok = false;
    std::string text;
};
inline ToolOutcome run_tool(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return {};
    ToolOutcome outcome;
    std::array<char, 4096> block{};
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), pipe)) {
        outcome.text.append(block.data(), count);
    }
    outcome.ok = ::pclose(pipe) == 0;
    return outcome;
}

}  // namespace sikku
