// tests/reference.h: slow and obvious second ways to what the engine computes, for tests to compare with: random
// systems, words rewritten as lists of strings, a turtle that takes a sine for each step.
#pragma once

#include "engine/geometry/turtle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku::reference {

// --- reading patterns ----------------------------------------------------------------------------------------------

/// Everything that is wrong with a pattern, warnings too; `line` and `stroke` are keys of some interpreter.
std::vector<Diagnostic> diagnostics_of(const std::string& text, const std::vector<Setting>& settings = {},
                                       std::string_view variant = {});

/// Throws PatternError if anything is wrong.
Grammar grammar_of(const std::string& text, const std::vector<Setting>& settings = {}, std::string_view variant = {});

struct Expected {
    Place where;
    std::string essence;  ///< a part of the message
};

/// The pattern has just these mistakes, in this order.
void expect_mistakes(const std::string& text, const std::vector<Expected>& expected,
                     const std::vector<Setting>& settings = {}, std::string_view variant = {});

::testing::AssertionResult is_utf8(std::string_view text);

std::size_t code_points(std::string_view text);

// --- what the engine derives ---------------------------------------------------------------------------------------

class Collector : public SymbolSink {
public:
    void symbols(const Run& run) override {
        EXPECT_FALSE(finished);
        EXPECT_FALSE(run.symbols.empty());
        if (run.block >= 0) {  // a number always means the same symbols
            const auto [known, fresh] = blocks.try_emplace(run.block, run.symbols.begin(), run.symbols.end());
            if (!fresh) {
                EXPECT_TRUE(
                    std::equal(known->second.begin(), known->second.end(), run.symbols.begin(), run.symbols.end()));
            }
        }
        longest = std::max(longest, run.symbols.size());
        word.insert(word.end(), run.symbols.begin(), run.symbols.end());
    }
    void finish() override { finished = true; }

    Word word;
    std::map<std::int32_t, Word> blocks;
    std::size_t longest = 0;
    bool finished = false;
};

Word derived(const Grammar& grammar, const DerivationOptions& options = {});
std::string derived_text(const Grammar& grammar, bool interpreted = false);
std::string derived_text(const std::string& text, bool interpreted = false);

/// What a turtle finds that walks the word, `interpret:` applied.
Survey survey_of(const Grammar& grammar);

// --- systems as plain data -----------------------------------------------------------------------------------------

using Tokens = std::vector<std::string>;  ///< a symbol with its parameters is one token

struct Rule {
    Tokens left, predecessor, right, successor;
};

struct System {
    Tokens axiom;
    std::vector<std::vector<Rule>> tables;  ///< at least one
    std::vector<std::size_t> schedule;      ///< the table of each step
    std::vector<Rule> interpretation;
    std::set<std::string> ignored;
    std::string keys;  ///< further lines of the file

    // What the turtle has to know; `keys` says the same.
    long double increment = 90;
    long double heading = 90;
    bool plus_turns_left = false;
    std::set<std::string> forward = {"F"};
    std::set<std::string> move = {"f"};

    std::string text() const;
};

std::string joined(const Tokens& word);

/// The system of a grammar, symbol by symbol; turtle settings are not filled in.
System system_of(const Grammar& grammar);

// --- rewriting level by level --------------------------------------------------------------------------------------

/// Contexts as the pfg program matches them: it walks the word and counts levels of brackets.
/// Source: Prusinkiewicz & Hanan 1989, appendix A, generate.c.
bool left_context_matches(const Tokens& context, const Tokens& word, std::size_t at,
                          const std::set<std::string>& ignored);

bool right_context_matches(const Tokens& context, const Tokens& word, std::size_t at,
                           const std::set<std::string>& ignored);

Tokens rewritten(const std::vector<Rule>& rules, const std::set<std::string>& ignored, const Tokens& word);

/// Nullopt if a word on the way has more symbols than `most`.
std::optional<Tokens> rewrite_level_by_level(const System& system, bool interpreted = false,
                                             std::size_t most = 200'000);

Tokens tokens_of(const Grammar& grammar, const Word& word);

// --- random systems ------------------------------------------------------------------------------------------------

/// The same throws on every machine.
class Dice {
public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    std::size_t below(std::size_t end) { return engine_() % end; }
    bool once_in(std::size_t times) { return below(times) == 0; }
    template <class Container>
    const auto& one_of(const Container& container) {
        return container[below(container.size())];
    }

private:
    std::mt19937 engine_;
};

struct Kind {
    enum class Brackets {
        none,
        nested,   ///< each successor balances
        loose,    ///< `<` and `>`-like symbols L and R open and close; the word may balance or not
        anywhere  ///< as chance will have it
    };
    Tokens letters = {"F", "f", "A", "B"};
    Tokens signs = {"+", "-"};
    std::size_t longest = 4;  ///< successor
    bool empties = true;
    bool contexts = false;
    bool subwords = false;
    bool interpreted = false;
    std::size_t tables = 1;
    std::size_t most_steps = 6;
    Brackets brackets = Brackets::none;
    std::size_t longest_context = 2;  ///< symbols on each side
};

Tokens random_word(Dice& dice, const Kind& kind, std::size_t length, int net = 0);

System random_system(unsigned seed, const Kind& kind);

// --- paths ---------------------------------------------------------------------------------------------------------

struct Line {
    std::vector<glm::dvec2> points;  ///< corners, or, of Béziers, all control points
    std::vector<Pen> pens;           ///< of each segment
    bool closed = false;
};
struct Disc {
    glm::dvec2 centre{0.0};
    double radius = 0.0;
    Pen pen;
};
struct Polygon {
    std::vector<glm::dvec2> vertices;
    Pen pen;
};

/// Writes down what it is told, and checks that it is told it in order.
class Recorder : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        EXPECT_FALSE(down_);
        down_ = true;
        pen_ = pen;
        strokes.push_back({{start}, {}, false});
    }
    void lines(std::span<const glm::dvec2> ends) override { add(ends, 1); }
    void curves(std::span<const glm::dvec2> controls) override { add(controls, 3); }
    void change_pen(const Pen& pen) override {
        EXPECT_TRUE(down_);
        EXPECT_FALSE(pen == pen_);
        pen_ = pen;
    }
    void end_stroke(bool closed) override {
        EXPECT_TRUE(down_);
        EXPECT_FALSE(strokes.back().pens.empty());
        down_ = false;
        strokes.back().closed = closed;
    }
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        EXPECT_GE(vertices.size(), 3u);
        polygons.push_back({{vertices.begin(), vertices.end()}, pen});
    }
    void disc(glm::dvec2 centre, double radius, const Pen& pen) override { discs.push_back({centre, radius, pen}); }

    std::vector<Line> strokes;
    std::vector<Polygon> polygons;
    std::vector<Disc> discs;

private:
    void add(std::span<const glm::dvec2> points, std::size_t each) {
        EXPECT_TRUE(down_);
        EXPECT_EQ(points.size() % each, 0u);
        strokes.back().points.insert(strokes.back().points.end(), points.begin(), points.end());
        strokes.back().pens.insert(strokes.back().pens.end(), points.size() / each, pen_);
    }
    bool down_ = false;
    Pen pen_;
};

// --- the naive turtle ----------------------------------------------------------------------------------------------

struct Walk {
    std::uint64_t drawn = 0;
    std::uint64_t moves = 0;
    long double length = 0;
    std::array<long double, 4> box{};  ///< xmin ymin xmax ymax
    std::optional<std::array<long double, 4>> ink;
    long double x = 0, y = 0, heading = 90;
    bool closed = true;
    std::int64_t depth = 0;
    std::size_t fault = 0;  ///< position, from 1, of a symbol that does not balance; 0: none
    std::vector<Line> strokes;
    std::vector<Polygon> polygons;
    std::vector<Disc> discs;
};

Walk walk(const System& system, const Tokens& word, bool moves_draw = false);

/// Are two directions in degrees the same?
bool same_heading(double a, double b);

}  // namespace sikku::reference
