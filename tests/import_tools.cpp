#include "tests/import_tools.h"

namespace sikku::import_tools {

std::string repeated_text(std::string_view text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

SourcePointer source_of(const std::string& text, const std::string& name) {
    return std::make_shared<const Source>(name, text);
}

std::string all_of(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics.sorted()) text += diagnostic.text() + '\n';
    return text;
}

std::vector<ImportedSystem> systems_of(const std::string& text) {
    Diagnostics diagnostics;
    const auto systems = import_fractint(source_of(text), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << all_of(diagnostics);
    return systems;
}

ImportedSystem cpfg(const std::string& text, const std::string& view) {
    Diagnostics diagnostics;
    const auto systems =
        import_cpfg(source_of(text), view.empty() ? nullptr : source_of(view, "test.v"), diagnostics);
    EXPECT_FALSE(diagnostics.has_errors()) << all_of(diagnostics);
    EXPECT_EQ(systems.size(), 1U);
    return systems.front();
}

std::string word_of(const std::string& pattern, int n, bool interpreted) {
    std::vector<Setting> settings;
    if (n >= 0) settings.push_back({"-n", "derivation length", std::to_string(n)});
    return derived_modules(grammar_of(pattern, settings), interpreted);
}

void expect_errors(const Diagnostics& diagnostics, const std::vector<reference::Expected>& expected) {
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
