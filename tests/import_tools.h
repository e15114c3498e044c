// tests/import_tools.h: imports systems from texts, and derives the words of their patterns.
#pragma once

#include "engine/import/import.h"

#include "tests/module_reference.h"
#include "tests/program.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::import_tools {

using reference::derived_modules;
using reference::grammar_of;

inline std::string repeated_text(std::string_view text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

inline SourcePointer source_of(const std::string& text, const std::string& name = "test.l") {
    return std::make_shared<const Source>(name, text);
}

inline std::string all_of(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics.sorted()) text += diagnostic.text() + '\n';
    return text;
}

inline std::vector<ImportedSystem> fractint(const std::string& text) {
    Diagnostics diagnostics;
    const auto systems = import_fractint(source_of(text), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << all_of(diagnostics);
    return systems;
}

inline ImportedSystem cpfg(const std::string& text, const std::string& view = "") {
    Diagnostics diagnostics;
    const auto systems =
        import_cpfg(source_of(text), view.empty() ? nullptr : source_of(view, "test.v"), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << all_of(diagnostics);
    EXPECT_EQ(systems.size(), 1U);
    return systems.front();
}

/// The word after n steps, or after those that the pattern states.
inline std::string word_of(const std::string& pattern, int n = -1, bool interpreted = false) {
    std::vector<Setting> settings;
    if (n >= 0) settings.push_back({"-n", "derivation length", std::to_string(n)});
    return derived_modules(grammar_of(pattern, settings), interpreted);
}

inline void expect_errors(const Diagnostics& diagnostics, const std::vector<reference::Expected>& expected) {
    std::vector<Diagnostic> errors;
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        if (!diagnostic.warning) errors.push_back(diagnostic);
    }
    ASSERT_EQ(errors.size(), expected.size()) << all_of(diagnostics);
    for (std::size_t i = 0; i < errors.size(); ++i) {
        EXPECT_EQ(errors[i].where, expected[i].where) << errors[i].text();
        EXPECT_TRUE(has(errors[i].message, expected[i].essence));
    }
}

}  // namespace sikku::import_tools
