// tests/checks.h: compares texts and errors.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {

#ifdef SIKKU_SANITIZED
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

/// Checks that the text contains the part. The message shows both.
inline ::testing::AssertionResult has(std::string_view text, std::string_view part) {
    const bool is_there = text.find(part) != std::string_view::npos;
    ::testing::AssertionResult result(is_there);
    return result << (is_there ? "'" : "no '") << part << "' in: " << text.substr(0, 2000);
}

/// Number of occurrences of the part in the text, without overlaps.
inline std::size_t count_of(std::string_view text, std::string_view part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

/// The message of the Error that `work` throws, or `otherwise` if it throws nothing.
template <typename Error = std::exception, typename Work>
std::string error_of(Work&& work, std::string otherwise = "") {
    try {
        std::forward<Work>(work)();
    } catch (const Error& error) {
        return error.what();
    }
    return otherwise;
}

}  // namespace sikku
