// Every pattern that comes along states in a comment what it measures: `// expect: symbols 3803, drawn 2048, ...`.
#include "engine/language/document.h"
#include "engine/map/map_step.h"
#include "engine/measure/extent.h"
#include "tests/files.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace sikku::facts_test {

/// The words after each name of the `// expect:` line.
std::map<std::string, std::vector<std::string>> expectations(const std::string& text) {
    std::map<std::string, std::vector<std::string>> result;
    constexpr std::string_view mark = "// expect:";
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) return result;
    std::istringstream line(text.substr(at + mark.size(), text.find('\n', at) - at - mark.size()));
    for (std::string item; std::getline(line, item, ',');) {
        std::istringstream words(item);
        std::string name;
        words >> name;
        for (std::string word; words >> word;) result[name].push_back(word);
    }
    return result;
}

double number(const std::string& text) {
    double value = std::nan("");
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

class Facts : public ::testing::TestWithParam<std::filesystem::path> {};

struct Told {
    double symbols, drawn, moves;
    std::vector<double> box;  ///< four numbers, six in space
    bool closed;
};

/// What a walk through the interpreted word tells, without the number of symbols.
Told walked(const Grammar& grammar) {
    if (!grammar.is_spatial()) {
        const Survey survey = reference::survey_of(grammar);
        return {0,
                static_cast<double>(survey.drawn),
                static_cast<double>(survey.moves),
                {survey.box.low.x, survey.box.low.y, survey.box.high.x, survey.box.high.y},
                survey.closed};
    }
    const auto turtle = SpaceTurtle::make(grammar);
    derive(grammar, *turtle, {.interpreted = true});
    const SpaceSurvey& survey = turtle->survey();
    const auto& [low, high] = survey.box;
    return {0,
            static_cast<double>(survey.drawn),
            static_cast<double>(survey.moves),
            {low.x, low.y, low.z, high.x, high.y, high.z},
            survey.closed};
}

void expect_told(const std::map<std::string, std::vector<std::string>>& expected, const Told& found,
                 const std::string& road) {
    for (const auto& [name, words] : expected) {
        if (name == "symbols") {
            EXPECT_EQ(found.symbols, number(words.at(0))) << road;
        } else if (name == "drawn") {
            EXPECT_EQ(found.drawn, number(words.at(0))) << road;
        } else if (name == "moves") {
            EXPECT_EQ(found.moves, number(words.at(0))) << road;
        } else if (name == "box") {
            ASSERT_EQ(words.size(), found.box.size());
            for (std::size_t i = 0; i < words.size(); ++i) {
                const double value = number(words[i]);  // printed to six digits
                EXPECT_NEAR(found.box[i], value, std::max(5.1e-6 * std::fabs(value), 1e-9)) << road << ' ' << i;
            }
        } else if (name == "closed") {
            EXPECT_EQ(found.closed, words.at(0) == "yes") << road;
        } else {
            ADD_FAILURE() << "no such expectation: " << name;
        }
    }
}

/// Of a map, the numbers of its parts.
void expect_map(const std::map<std::string, std::vector<std::string>>& expected, const Grammar& grammar) {
    const Map map = derive_map(grammar);
    const std::map<std::string, std::size_t> found = {{"cells", map.cells()},
                                                      {"edges", map.edges().size()},
                                                      {"vertices", map.vertices()},
                                                      {"outer", map.outer().size()}};
    ASSERT_EQ(expected.size(), found.size());
    for (const auto& [name, words] : expected) {
        ASSERT_TRUE(found.contains(name)) << "no such expectation: " << name;
        EXPECT_EQ(static_cast<double>(found.at(name)), number(words.at(0))) << name;
    }
}

TEST_P(Facts, AreWhatEveryRoadMeasures) {
    const std::string text = contents(GetParam());
    const auto expected = expectations(text);
    if (const Document document = parse(GetParam().string(), text); document.map()) {
        EXPECT_NE(document.text("title"), "");
        EXPECT_NE(document.text("source"), "");
        return expect_map(expected, document.grammar());
    }
    ASSERT_TRUE(expected.contains("symbols") && expected.contains("drawn") && expected.contains("moves"))
        << "the pattern lacks its `// expect:` line";
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern(GetParam().filename(), text, diagnostics);
    const Grammar grammar = compile_grammar(pattern, diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.sorted()) ADD_FAILURE() << diagnostic.text();
    EXPECT_NE(pattern.text("title"), "");
    EXPECT_NE(pattern.text("source"), "");
    ASSERT_FALSE(diagnostics.has_errors());

    const Measurement measured = measure(grammar, 2e8);
    Told told{measured.symbols.value, measured.drawn.value, measured.moves.value, {}, false};
    if (grammar.is_spatial()) {
        ASSERT_TRUE(measured.space);
        const auto& [low, high] = measured.space->box;
        told.box = {low.x, low.y, low.z, high.x, high.y, high.z};
        told.closed = measured.space->closed;
    } else {
        ASSERT_TRUE(measured.geometry);
        EXPECT_EQ(measured.derived, !grammar.is_plain() || grammar.whole_word_steps() > 0);
        for (const Quantity& side : measured.geometry->box) told.box.push_back(side.value);
        told.closed = measured.geometry->closed;
        const Survey survey = reference::survey_of(grammar);
        EXPECT_TRUE(reference::same_heading(survey.heading, measured.geometry->heading));
        EXPECT_EQ(survey.depth, measured.geometry->depth);
    }
    expect_told(expected, told, "measured");

    reference::ModuleCollector plain(grammar);
    derive(grammar, plain);
    told = walked(grammar);
    told.symbols = static_cast<double>(plain.word.symbols.size());
    expect_told(expected, told, "walked");

    // The slow way, symbol by symbol.
    if (grammar.is_plain() && !grammar.cut()) {
        const reference::System system = reference::system_of(grammar);
        const auto word = reference::rewrite_level_by_level(system, false, 1'000'000);
        ASSERT_TRUE(word);
        EXPECT_EQ(reference::tokens_of(grammar, plain.word.symbols), *word);
    } else {
        reference::ModuleSystem system = reference::module_system_of(pattern);
        for (const ScheduleRun& run : grammar.schedule()) {
            system.schedule.insert(system.schedule.end(), static_cast<std::size_t>(run.steps), run.table);
        }
        const auto word = reference::ModuleReference(system).word(false, 1'000'000);
        ASSERT_TRUE(word);
        std::string text_of_word = to_text(grammar, plain.word);
        std::erase(text_of_word, ' ');
        EXPECT_EQ(text_of_word, reference::text_of(*word));
    }
}

std::string name_of(const ::testing::TestParamInfo<std::filesystem::path>& info) {
    std::string name = info.param.stem().string();
    for (char& letter : name) {
        if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
    }
    return name;
}
INSTANTIATE_TEST_SUITE_P(Patterns, Facts, ::testing::ValuesIn(pattern_files("patterns")), name_of);

TEST(PatternFiles, EveryKindOfPatternComesAlong) {
    std::map<std::string, int> kinds;
    for (const auto& file : pattern_files("patterns")) ++kinds[file.parent_path().filename()];
    for (const char* kind : {"kolams", "tilings", "curves", "plants", "words"}) EXPECT_GT(kinds[kind], 0) << kind;
}

}  // namespace sikku::facts_test
