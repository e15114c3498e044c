#include "engine/measure/fold.h"
#include "engine/measure/exact_quantity.h"

#include "engine/geometry/turtle.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

namespace sikku::fold_test {

using reference::grammar_of;
using reference::Kind;
using reference::survey_of;

std::string text_of(const Quantity& quantity) {
    return quantity.digits.empty() ? std::to_string(quantity.value) : quantity.digits;
}
/// A whole quantity as the contract prints it.
std::string whole_text(const Quantity& quantity) {
    return quantity.digits.empty() ? std::to_string(std::llround(quantity.value)) : quantity.digits;
}
void expect_near(const Quantity& found, double expected, double scale, const std::string& what) {
    EXPECT_NEAR(found.value, expected, 1e-9 * std::max(1.0, scale)) << what;
}

/// The fold says what a walk says.
void expect_like_walk(const Grammar& grammar, const std::string& what) {
    std::string walk_error;
    std::string fold_error;
    Survey survey;
    std::optional<Fold> found;
    try {
        survey = survey_of(grammar);
    } catch (const WordError& error) {
        walk_error = error.what();
    }
    try {
        found = fold(grammar);
        // Braces are not folded where they do not balance: walking tells their places.
        if (!found && walk_error.find_first_of("{}") != std::string::npos) return;
        EXPECT_TRUE(found) << what;
    } catch (const WordError& error) {
        fold_error = error.what();
    }
    ASSERT_EQ(fold_error, walk_error) << what;
    if (!found || !walk_error.empty()) return;
    const double scale = std::max({std::fabs(survey.box.low.x), std::fabs(survey.box.low.y),
                                   std::fabs(survey.box.high.x), std::fabs(survey.box.high.y)});
    expect_near(found->box[0], survey.box.low.x, scale, what);
    expect_near(found->box[1], survey.box.low.y, scale, what);
    expect_near(found->box[2], survey.box.high.x, scale, what);
    expect_near(found->box[3], survey.box.high.y, scale, what);
    ASSERT_EQ(found->ink.has_value(), survey.ink.has_value()) << what;
    if (survey.ink) {
        expect_near((*found->ink)[0], survey.ink->low.x, scale, what);
        expect_near((*found->ink)[1], survey.ink->low.y, scale, what);
        expect_near((*found->ink)[2], survey.ink->high.x, scale, what);
        expect_near((*found->ink)[3], survey.ink->high.y, scale, what);
    }
    expect_near(found->end[0], survey.end.x, scale, what);
    expect_near(found->end[1], survey.end.y, scale, what);
    EXPECT_TRUE(reference::same_heading(found->heading, survey.heading))
        << what << found->heading << ' ' << survey.heading;
    EXPECT_EQ(found->closed, survey.closed) << what;
    EXPECT_EQ(found->depth, survey.depth) << what;
    // The hulls are as large as the boxes, and convex.
    for (const auto& [hull, box] :
         {std::pair{&found->box_hull, &found->box}, {&found->ink_hull, found->ink ? &*found->ink : nullptr}}) {
        ASSERT_EQ(hull->empty(), box == nullptr) << what;
        if (!box) continue;
        glm::dvec2 low = hull->front();
        glm::dvec2 high = low;
        for (std::size_t i = 0; i < hull->size(); ++i) {
            const glm::dvec2 a = (*hull)[i];
            const glm::dvec2 b = (*hull)[(i + 1) % hull->size()];
            const glm::dvec2 c = (*hull)[(i + 2) % hull->size()];
            low = {std::min(low.x, a.x), std::min(low.y, a.y)};
            high = {std::max(high.x, a.x), std::max(high.y, a.y)};
            EXPECT_GE((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), -1e-9 * scale * scale) << what;
        }
        expect_near((*box)[0], low.x, scale, what);
        expect_near((*box)[1], low.y, scale, what);
        expect_near((*box)[2], high.x, scale, what);
        expect_near((*box)[3], high.y, scale, what);
    }
}

// --- against a walk ------------------------------------------------------------------------------------------------

void expect_like_walks(const Kind& kind, const std::string& keys, unsigned begin, unsigned end) {
    for (unsigned seed = begin; seed < end; ++seed) {
        reference::System system = reference::random_system(seed, kind);
        system.keys = keys;
        if (!reference::rewrite_level_by_level(system, true, 5'000)) continue;
        expect_like_walk(grammar_of(system.text()), std::to_string(seed) + "\n" + system.text());
        if (::testing::Test::HasFailure()) return;
    }
}

TEST(Fold, EqualsAWalkForEveryAngleFactor) {
    Kind kind;
    kind.signs = {"+", "-", "+", "-", "|"};
    kind.brackets = Kind::Brackets::nested;
    for (int k = 1; k <= 34; ++k) {
        expect_like_walks(kind, "angle factor: " + std::to_string(k) + "\n", 0, 25);
    }
}

TEST(Fold, EqualsAWalkForAnyAngle) {
    Kind kind;
    kind.signs = {"+", "-", "+", "-", "|"};
    kind.brackets = Kind::Brackets::nested;
    for (const char* keys : {"angle increment: 25.7\n", "angle increment: 137.508\n",
                             "angle increment: 1.23456789012\n", "angle increment: -100/7\nturn: left\n",
                             "angle increment: 0\n", "heading: 0\n", "heading: 30\nangle factor: 8\n",
                             "heading: 12.345\nangle factor: 5\n", "heading: 1.23456789012345\nangle factor: 12\n",
                             "heading: 123456789.123456789\n", "heading: 360/7\nangle increment: 1.2345678901\n"}) {
        expect_like_walks(kind, keys, 0, 40);
    }
}

TEST(Fold, EqualsAWalkForHugeAngles) {
    Kind kind;
    kind.signs = {"+", "-", "+", "-", "|"};
    for (const char* keys : {"angle increment: 1e22\n", "heading: 1e22\n", "heading: -1e300\nangle factor: 7\n",
                             "angle increment: -1e300\nheading: 1e15\n"}) {
        expect_like_walks(kind, keys, 0, 40);
    }
}

TEST(Fold, EqualsAWalkWithParametersTablesAndInterpretations) {
    Kind kind;
    kind.letters = {"F", "f", "F(2.5)", "f(0.2)", "F(-1)", "X", "F(1/3)"};
    kind.signs = {"+", "-", "+(60)", "-(45)"};
    kind.brackets = Kind::Brackets::nested;
    kind.tables = 2;
    kind.interpreted = true;
    expect_like_walks(kind, "angle factor: 4\n", 0, 100);
    kind.letters.pop_back();  // short decimals only
    expect_like_walks(kind, "angle factor: 4\n", 100, 250);
    kind.signs = {"+", "-", "+(72)"};
    expect_like_walks(kind, "angle factor: 5\nturn: left\nheading: 0\n", 250, 400);
}

TEST(Fold, EqualsAWalkWhereOnlyTheWordBalances) {
    Kind kind;
    kind.brackets = Kind::Brackets::loose;
    for (int k : {4, 6, 7, 8}) {
        expect_like_walks(kind, "angle factor: " + std::to_string(k) + "\n", 0, 300);
    }
    expect_like_walks(kind, "angle increment: 25.7\n", 300, 500);
    kind.interpreted = true;
    kind.tables = 2;
    expect_like_walks(kind, "", 500, 800);
}

TEST(Fold, WordsThatDoNotBalanceAreToldAsTheTurtleTells) {
    Kind kind;
    kind.brackets = Kind::Brackets::anywhere;
    expect_like_walks(kind, "", 0, 500);
    for (const char* text :
         {"axiom: F]F", "axiom: F[F", "axiom: F[F[F]", "axiom: F}F", "axiom: F{F", "axiom: {F}{F{", "axiom: }{",
          "axiom: LFR\nderivation length: 3\nL --> [L\nR --> R]",
          "axiom: LFR\nderivation length: 3\nL --> [L\nR --> ]",
          "axiom: LFR\nderivation length: 3\nL --> {L\nR --> R}",
          "axiom: LFR\nderivation length: 3\nL --> {L\nR --> }",
          "axiom: LFR\nderivation length: 3\nL --> L\nR --> F}R", "axiom: ][", "axiom: [F]]F[", "axiom: F[{F]}"}) {
        expect_like_walk(grammar_of(std::string(text) + "\n"), text);
    }
    // Far beyond what could be walked: the 2^60th symbol.
    const Grammar grammar = grammar_of("axiom: XA\nderivation length: 60\nX --> XX\nA --> ]\n");
    EXPECT_TRUE(
        has(error_of<WordError>([&] { fold(grammar); }), "symbol 1152921504606846977 of the word: ']' without '['"));
}

TEST(Fold, IsAbsentWhereNeighboursAreLookedAt) {
    EXPECT_FALSE(fold(grammar_of("axiom: F\nderivation length: 2\nA < F --> FF\n")));
    EXPECT_FALSE(fold(grammar_of("axiom: F\nderivation length: 2\nFF --> F\n")));
}

TEST(Fold, IsAbsentWhereBracketsStayOpenOverThousandsOfLevels) {
    const std::string text = "axiom: LFR\nL --> [L\nR --> R]\nderivation length: ";
    EXPECT_EQ(fold(grammar_of(text + "1000\n"))->depth, 1000);
    const auto deep = fold(grammar_of(text + "100000\n"));
    EXPECT_TRUE(!deep || deep->depth == 100'000);
    EXPECT_EQ(fold(grammar_of("axiom: F\nF --> [F]\nderivation length: 100000\n"))->depth, 100'000);
}

// --- exactness far beyond 64 bits ----------------------------------------------------------------------------------

/// (a + b sqrt(root)) / 2
struct Surd {
    Integer a = 0;
    Integer b = 0;
    int root = 2;

    Surd plus(const Surd& other) const { return {a + other.a, b + other.b, root}; }
    /// Its sign, exactly.
    int sign() const {
        if (a >= 0 && b >= 0) return a == 0 && b == 0 ? 0 : 1;
        if (a <= 0 && b <= 0) return -1;
        const bool a_outweighs = a * a > b * b * root;
        return (a > 0) == a_outweighs ? 1 : -1;
    }
    bool operator<(const Surd& other) const { return Surd{a - other.a, b - other.b, root}.sign() < 0; }
    /// Rounded to a whole number, halves away from zero.
    Integer rounded() const {
        if (sign() < 0) return -Surd{-a, -b, root}.rounded();
        const Integer square = b * b * root;
        const Integer part = sqrt(square);
        Integer floor = a + part;
        if (b < 0) floor = a - part - (part * part == square ? 0 : 1);
        return (floor + 1) / 2;
    }
};

/// What the fold composes from hulls, composed instead from how far a part reaches in each of the k directions.
class Reach {
public:
    /// Without brackets; k = 4, 8 or 12, the increment 360 / k degrees times `turn`, + to the right, heading up.
    Reach(int k, int turn, const reference::System& system) : k_(k), turn_(turn), system_(system) {}

    struct Part {
        int heading = 0;             ///< turned by
        std::vector<Surd> end;       ///< along each direction, relative to where and how it began
        std::vector<Surd> farthest;  ///< of all positions, the beginning included
    };

    const Part& part(const std::string& token, std::size_t step) {
        const auto [found, fresh] = parts_.try_emplace({token, step});
        if (!fresh) return found->second;
        Part result;
        if (step == system_.schedule.size()) {
            result = nothing();
            if (token == "+") result.heading = (k_ - turn_) % k_;
            if (token == "-") result.heading = turn_;
            if (system_.forward.contains(token) || system_.move.contains(token)) {
                for (int j = 0; j < k_; ++j) {
                    result.end[static_cast<std::size_t>(j)] = cosine(j);
                    result.farthest[static_cast<std::size_t>(j)] =
                        std::max(cosine(j), zero(), [](const Surd& a, const Surd& b) { return a < b; });
                }
            }
        } else {
            const reference::Rule* rule = nullptr;
            for (const reference::Rule& one : system_.tables[system_.schedule[step]]) {
                if (one.predecessor[0] == token) rule = &one;
            }
            result = rule ? word(rule->successor, step + 1) : part(token, step + 1);
        }
        return parts_[{token, step}] = result;
    }
    Part whole() { return word(system_.axiom, 0); }

private:
    Part word(const reference::Tokens& tokens, std::size_t step) {
        Part sum = nothing();
        for (const std::string& token : tokens) {
            const Part next = part(token, step);
            for (int j = 0; j < k_; ++j) {
                const auto seen = static_cast<std::size_t>((j - sum.heading + k_) % k_);
                const auto at = static_cast<std::size_t>(j);
                const Surd reached = sum.end[at].plus(next.farthest[seen]);
                if (sum.farthest[at] < reached) sum.farthest[at] = reached;
                sum.end[at] = sum.end[at].plus(next.end[seen]);
            }
            sum.heading = (sum.heading + next.heading) % k_;
        }
        return sum;
    }
    Surd zero() const { return {0, 0, k_ == 12 ? 3 : 2}; }
    Part nothing() const {
        const auto k = static_cast<std::size_t>(k_);
        return {0, std::vector<Surd>(k, zero()), std::vector<Surd>(k, zero())};
    }
    /// Of j k-ths of a turn.
    Surd cosine(int j) const {
        const int eighths_or_twelfths = j % k_;
        Surd result = zero();
        if (k_ == 12) {
            static constexpr std::array<std::array<int, 2>, 12> table = {{{2, 0},
                                                                          {0, 1},
                                                                          {1, 0},
                                                                          {0, 0},
                                                                          {-1, 0},
                                                                          {0, -1},
                                                                          {-2, 0},
                                                                          {0, -1},
                                                                          {-1, 0},
                                                                          {0, 0},
                                                                          {1, 0},
                                                                          {0, 1}}};
            result.a = table[static_cast<std::size_t>(eighths_or_twelfths)][0];
            result.b = table[static_cast<std::size_t>(eighths_or_twelfths)][1];
        } else {
            static constexpr std::array<std::array<int, 2>, 8> table = {
                {{2, 0}, {0, 1}, {0, 0}, {0, -1}, {-2, 0}, {0, -1}, {0, 0}, {0, 1}}};
            result.a = table[static_cast<std::size_t>(eighths_or_twelfths * 8 / k_)][0];
            result.b = table[static_cast<std::size_t>(eighths_or_twelfths * 8 / k_)][1];
        }
        return result;
    }

    int k_;
    int turn_;
    const reference::System& system_;
    std::map<std::pair<std::string, std::size_t>, Part> parts_;
};

reference::Tokens letters(const std::string& word) {
    reference::Tokens tokens;
    for (const char letter : word) tokens.emplace_back(1, letter);
    return tokens;
}
reference::System plain(const std::string& axiom, const std::map<char, std::string>& productions, std::size_t n) {
    reference::System system;
    system.axiom = letters(axiom);
    system.tables.emplace_back();
    for (const auto& [letter, successor] : productions) {
        system.tables[0].push_back({{}, {std::string(1, letter)}, {}, letters(successor)});
    }
    system.schedule.assign(n, 0);
    return system;
}

void expect_like_reach(reference::System system, int k, int turn) {
    system.keys = "angle increment: " + std::to_string(360 * turn) + "/" + std::to_string(k) + "\n";
    const auto found = fold(grammar_of(system.text()));
    ASSERT_TRUE(found) << system.text();
    const Reach::Part expected = Reach(k, turn, system).whole();
    const auto k_size = static_cast<std::size_t>(k);
    // The turtle heads up: the x axis is a quarter of a turn to its right.
    const std::size_t right = k_size * 3 / 4;
    const auto check = [&](const Quantity& quantity, const Integer& whole, const Surd& exact, int sign) {
        if (quantity.digits.empty()) {
            const Surd fine{exact.a << 64, exact.b << 64, exact.root};
            const double value = sign * std::ldexp(fine.rounded().convert_to<double>(), -64);
            EXPECT_NEAR(quantity.value, value, 1e-15 * std::max(1.0, std::fabs(value))) << system.text();
            EXPECT_LT(std::fabs(quantity.value), 0x1p53);
        } else {
            EXPECT_EQ(quantity.digits, whole.str()) << system.text();
            EXPECT_NEAR(quantity.value / whole.convert_to<double>(), 1, 1e-15);
            EXPECT_GE(std::fabs(quantity.value), 0x1p53);
        }
    };
    const std::array<std::size_t, 4> toward = {(right + k_size / 2) % k_size, k_size / 2, right, 0};
    for (std::size_t i = 0; i < 4; ++i) {
        const Surd& reach = expected.farthest[toward[i]];
        const int sign = i < 2 ? -1 : 1;
        check(found->box[i], sign * reach.rounded(), reach, sign);
    }
    check(found->end[0], expected.end[right].rounded(), expected.end[right], 1);
    check(found->end[1], expected.end[0].rounded(), expected.end[0], 1);
    EXPECT_NEAR(found->heading, std::fmod(90.0 + 360.0 * expected.heading / k, 360.0), 1e-9);
    const bool closed =
        std::all_of(expected.end.begin(), expected.end.end(), [](const Surd& s) { return s.sign() == 0; });
    EXPECT_EQ(found->closed, closed) << system.text();
}

TEST(FoldExactly, HilbertCurveFillsItsSquare) {
    for (const unsigned n : {1U, 5U, 52U, 53U, 54U, 60U, 63U, 64U, 65U, 200U}) {
        const auto found = fold(grammar_of(
            "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: " + std::to_string(n) + "\n"));
        ASSERT_TRUE(found);
        const Integer side = (Integer(1) << n) - 1;
        EXPECT_EQ(whole_text(found->box[0]), Integer(-side).str()) << n;
        EXPECT_EQ(whole_text(found->box[1]), "0") << n;
        EXPECT_EQ(whole_text(found->box[2]), "0") << n;
        EXPECT_EQ(whole_text(found->box[3]), side.str()) << n;
        EXPECT_EQ(found->box[3].digits.empty(), n <= 53) << n;
        EXPECT_EQ(whole_text((*found->ink)[3]), side.str()) << n;
        EXPECT_FALSE(found->closed);
    }
}

TEST(FoldExactly, DragonEndsWhereComplexNumbersSay) {
    for (const std::size_t n : {1, 2, 7, 14, 50, 100, 105, 106, 107, 108, 300}) {
        const reference::System system = plain("Fl", {{'l', "l+rF+"}, {'r', "-Fl-r"}}, n);
        expect_like_reach(system, 4, 1);
        // l turns by a quarter to the right more each time: from step to step the end turns and grows by 1 - i, so
        // that of 2^n steps it is 2^(n/2) away.
        const auto found = fold(grammar_of(system.text()));
        const Integer x(whole_text(found->end[0]));
        const Integer y(whole_text(found->end[1]));
        EXPECT_EQ(x * x + y * y, Integer(1) << n) << n;
    }
}

TEST(FoldExactly, KochCurveIsAsWideAsItsFormula) {
    for (const unsigned n : {5U, 33U, 34U, 35U, 40U, 60U, 150U}) {
        const reference::System system = plain("F", {{'F', "F-F++F-F"}}, n);
        const auto found = fold(grammar_of("angle factor: 6\n" + system.text()));
        Integer length = 1;
        for (unsigned i = 0; i < n; ++i) length *= 3;
        EXPECT_EQ(whole_text(found->end[1]), length.str());
        EXPECT_EQ(whole_text(found->box[3]), length.str());
        EXPECT_EQ(found->end[0].value, 0);
        EXPECT_EQ(found->end[0].digits, "");
        // Its height is length / (2 sqrt 3): the rest of length^2 / 12, rounded.
        if (n > 40) {
            EXPECT_EQ(found->box[0].digits, Integer(-((sqrt(Integer(length * length / 3)) + 1) / 2)).str());
        }
        expect_like_reach(system, 12, 2);
    }
}

TEST(FoldExactly, QuarterTurnsEqualAnIndependentRecursion) {
    for (const std::size_t n : {3, 20, 30, 45, 80}) {
        expect_like_reach(plain("F+F+F+F", {{'F', "F+F-F-FF+F+F-F"}}, n), 4, 1);
        expect_like_reach(plain("F+XF+F+XF", {{'X', "XF-F+F-XF+F+XF-F+F-X"}}, n), 4, 1);
        expect_like_reach(plain("-YF", {{'X', "XFYFX+F+YFXFY-F-XFYFX"}, {'Y', "YFXFY-F-XFYFX+F+YFXFY"}}, n), 4, 1);
    }
}

TEST(FoldExactly, EighthTurnsEqualAnIndependentRecursion) {
    for (const std::size_t n : {3, 20, 40, 51, 52, 53, 60, 90, 150}) {
        expect_like_reach(plain("-X--X", {{'X', "XfX--XfX"}}, n), 8, 1);  // anklets of Krishna
        expect_like_reach(plain("F", {{'F', "+F--F+"}}, n), 8, 1);        // Levy's curve
        expect_like_reach(plain("F+F", {{'F', "F+G"}, {'G', "F-F--G"}}, n), 8, 1);
    }
}

TEST(FoldExactly, TwelfthTurnsEqualAnIndependentRecursion) {
    for (const std::size_t n : {3, 20, 40, 60, 100}) {
        expect_like_reach(plain("XF", {{'X', "X+YF++YF-FX--FXFX-YF+"}, {'Y', "-FX+YFYF++YF+FX--FX-Y"}}, n), 12, 2);
        expect_like_reach(plain("F", {{'F', "F+F---F+F"}}, n), 12, 1);
        expect_like_reach(plain("F-F", {{'F', "+F--G"}, {'G', "FF+++G"}}, n), 12, 1);
    }
}

TEST(FoldExactly, RandomSystemsEqualAnIndependentRecursion) {
    Kind kind;
    kind.empties = false;
    kind.tables = 2;
    for (unsigned seed = 0; seed < 25; ++seed) {
        for (const int k : {4, 8, 12}) {
            reference::System system = reference::random_system(seed, kind);
            reference::Dice dice(seed);
            system.schedule.clear();
            for (int i = 0; i < 70; ++i) system.schedule.push_back(dice.below(2));
            expect_like_reach(system, k, 1 + static_cast<int>(dice.below(2)));
            if (HasFailure()) return;
        }
    }
}

TEST(FoldExactly, ClosedCurvesOfAnySizeClose) {
    for (const auto& [text, closed] : {std::pair{"axiom: F+F+F+F\nF --> F+F-F-FF+F+F-F\n", true},
                                       {"axiom: F+F+F+F+F\nangle factor: 5\nF --> F+F-F\n", true},
                                       {"axiom: -X--X\nangle factor: 8\nX --> XfX--XfX\n", true},
                                       {"axiom: F+F+F\nangle factor: 3\nF --> F-F+F\n", true},
                                       {"axiom: F++F++F\nangle factor: 6\nF --> F-F++F-F\n", true},
                                       {"axiom: F+F+F+F+F+F+F\nangle factor: 7\nF --> FF+F-F\n", true},
                                       {"axiom: F+F+F\nF --> F+F-F-FF+F+F-F\n", false},
                                       {"axiom: F++F++F-f\nangle factor: 6\nF --> F-F++F-F\n", false}}) {
        for (const int n : {4, 45, 70}) {
            const auto found = fold(grammar_of(std::string(text) + "derivation length: " + std::to_string(n) + "\n"));
            ASSERT_TRUE(found) << text;
            EXPECT_EQ(found->closed, closed) << text << n;
            if (closed) {
                EXPECT_EQ(text_of(found->end[0]), text_of(Quantity()));
                EXPECT_EQ(text_of(found->end[1]), text_of(Quantity()));
            }
        }
    }
}

TEST(FoldExactly, UnitsSmallerThanAStepAreExact) {
    // Hilbert's curve with steps of 0.001: 2^n - 1 thousandths.
    const auto found = fold(grammar_of(
        "axiom: X\nX --> -YG+XGX+GY-\nY --> +XG-YGY-GX+\nderivation length: 80\ninterpret:\nG --> F(0.001)\n"));
    const Integer side = (Integer(1) << 80) - 1;
    EXPECT_EQ(found->box[3].digits, Integer((side + 500) / 1000).str());
}

TEST(Quantity, HasDigitsFrom2To53On) {
    EXPECT_EQ(quantity_of((Integer(1) << 53) - 1).digits, "");
    EXPECT_EQ(quantity_of((Integer(1) << 53) - 1).value, 0x1p53 - 1);
    EXPECT_EQ(quantity_of(Integer(1) << 53).digits, "9007199254740992");
    EXPECT_EQ(quantity_of((Integer(1) << 53) + 1).digits, "9007199254740993");
    EXPECT_EQ(quantity_of(-(Integer(1) << 53)).digits, "-9007199254740992");
    EXPECT_EQ(Quantity::of(0x1p53).digits, "9007199254740992");
    EXPECT_EQ(Quantity::of(-0x1p54).digits, "-18014398509481984");
    EXPECT_EQ(Quantity::of(0x1p53 - 1).digits, "");
    EXPECT_EQ(Quantity::of(0.5).digits, "");
}

}  // namespace sikku::fold_test
