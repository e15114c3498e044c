#include "cli/process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace sikku {

std::string output_of(const std::string& command) {
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) throw std::runtime_error(fmt::format("cannot start: {}", command));
    std::string text;
    std::array<char, 512> block{};
    for (std::size_t got = 0; (got = std::fread(block.data(), 1, block.size(), pipe)) > 0;)
        text.append(block.data(), got);
    if (::pclose(pipe) != 0) throw std::runtime_error(fmt::format("this failed: {}", command));
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

bool is_in_path(const std::string& program) {
    const char* path = std::getenv("PATH");
    std::string folders = path ? path : "";
    for (std::size_t at = 0; at <= folders.size();) {
        const std::size_t colon = std::min(folders.find(':', at), folders.size());
        const std::string file = folders.substr(at, colon - at) + "/" + program;
        if (::access(file.c_str(), X_OK) == 0) return true;
        at = colon + 1;
    }
    return false;
}

}  // namespace sikku
