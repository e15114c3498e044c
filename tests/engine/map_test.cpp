// tests/engine/map_test.cpp: maps: their productions, their derivation, their numbering.
#include "engine/check.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/map/map_step.h"
#include "engine/measure/fold.h"
#include "tests/checks.h"
#include "tests/maps.h"
#include "tests/sha256.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

namespace sikku::map_test {

const std::vector<Setting> all = {{"--set", "divide", "all"}};

std::vector<std::string> cells_of(const std::string& text, std::int64_t steps,
                                  const std::vector<Setting>& settings = {}) {
    const Document document = maps::document(text, steps, settings);
    return maps::words_of(maps::derive(document), *document.map());
}

std::string outer_of(const std::string& text, std::int64_t steps) {
    const Document document = maps::document(text, steps);
    const Map map = maps::derive(document);
    return maps::word_of(map, *document.map(), map.outer());
}

std::string hash_of(const std::string& text, std::int64_t steps, const std::vector<Setting>& settings = {}) {
    const Document document = maps::document(text, steps, settings);
    return sha256(maps::text_of(maps::derive(document), *document.map()));
}

std::map<std::string, std::size_t> labels_of(const std::string& text, std::int64_t steps) {
    const Document document = maps::document(text, steps);
    const Map map = maps::derive(document);
    std::map<std::string, std::size_t> counts;
    for (const MapEdge& edge : map.edges()) ++counts[document.map()->labels[edge.label]];
    return counts;
}

std::map<std::size_t, std::size_t> sides_of(const std::string& text, std::int64_t steps) {
    const Map map = maps::derive(maps::document(text, steps));
    std::map<std::size_t, std::size_t> counts;
    for (std::size_t i = 0; i < map.cells(); ++i) ++counts[map.cell(i).size()];
    return counts;
}

struct Sizes {
    std::size_t cells, edges, vertices, outer;
    bool operator==(const Sizes&) const = default;
};

std::ostream& operator<<(std::ostream& stream, const Sizes& sizes) {
    return stream << sizes.cells << ' ' << sizes.edges << ' ' << sizes.vertices << ' ' << sizes.outer;
}

/// Sizes after 0, 1, 2 … steps.
std::vector<Sizes> growth_of(const std::string& text, std::int64_t steps) {
    const Document document = maps::document(text, steps);
    MapDerivation derivation(document.grammar());
    std::vector<Sizes> sizes;
    do {
        const Map& map = derivation.map();
        sizes.push_back({map.cells(), map.edges().size(), map.vertices(), map.outer().size()});
    } while (derivation.next());
    return sizes;
}

TEST(MapStep, TheHashOfTests) {
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(MapStep, CellLayerGrowsAsPrinted) {
    const std::vector<Sizes> expected = {{1, 3, 3, 3},
                                         {2, 7, 6, 6},
                                         {4, 15, 12, 10},
                                         {8, 29, 22, 15},
                                         {16, 57, 42, 23},
                                         {32, 109, 78, 33},
                                         {64, 213, 150, 49},
                                         {128, 413, 286, 69},
                                         {256, 813, 558, 101},
                                         {512, 1597, 1086, 141},
                                         {1024, 3165, 2142, 205},
                                         {2048, 6269, 4222, 285},
                                         {4096, 12477, 8382, 413}};
    EXPECT_EQ(growth_of(maps::layer, 12), expected);
}

TEST(MapStep, MossLeafGrowsAsPrinted) {
    const std::vector<Sizes> expected = {
        {1, 3, 3, 3},      {2, 6, 5, 5},       {3, 10, 8, 7},      {5, 15, 11, 9},     {8, 24, 17, 12},
        {11, 33, 23, 15},  {16, 46, 31, 18},   {23, 65, 43, 23},   {30, 85, 56, 28},   {41, 112, 72, 33},
        {56, 152, 97, 42}, {71, 192, 122, 51}, {94, 248, 155, 60}, {125, 328, 204, 77}};
    EXPECT_EQ(growth_of(maps::leaf, 13), expected);
}

/// The labels of the walls that each step adds.
std::vector<std::string> walls_of(const std::string& text, std::int64_t steps) {
    const Document document = maps::document(text, steps);
    const Map map = maps::derive(document);
    std::vector<std::string> walls;
    MapDerivation derivation(document.grammar());
    while (derivation.next()) {
        std::map<std::string, std::size_t> counts;
        const std::size_t first = derivation.origins().first_edge.back();
        const std::vector<MapEdge>& edges = derivation.map().edges();
        for (std::size_t i = first; i < edges.size(); ++i) ++counts[document.map()->labels[edges[i].label]];
        std::string line;
        for (const auto& [label, count] : counts) {
            line += (line.empty() ? "" : " ") + (count > 1 ? std::to_string(count) : "") + label;
        }
        walls.push_back(line);
    }
    return walls;
}

TEST(MapStep, WallsAreThoseOfTheText) {
    EXPECT_EQ(walls_of(maps::leaf, 13),
              (std::vector<std::string>{"a", "j", "a y", "j u y", "a u y", "j u 3y", "a 3u 3y", "j 3u 3y", "a 3u 7y",
                                        "j 7u 7y", "a 7u 7y", "j 7u 15y", "a 15u 15y"}));
    EXPECT_EQ(walls_of(maps::layer, 6), (std::vector<std::string>{"a", "a b", "a 3b", "a 7b", "a 15b", "a 31b"}));
}

TEST(MapStep, LabelsAndSidesAreThoseOfTheText) {
    EXPECT_EQ(labels_of(maps::layer, 5),
              (std::map<std::string, std::size_t>{{"a", 1}, {"b", 21}, {"c", 5}, {"d", 5},  {"e", 2}, {"f", 2},
                                                  {"g", 1}, {"h", 1},  {"i", 1}, {"j", 1},  {"k", 1}, {"l", 1},
                                                  {"m", 1}, {"n", 1},  {"o", 1}, {"p", 2},  {"q", 2}, {"r", 2},
                                                  {"s", 2}, {"t", 2},  {"u", 2}, {"v", 18}, {"x", 34}}));
    EXPECT_EQ(labels_of(maps::leaf, 10), (std::map<std::string, std::size_t>{{"c", 2},
                                                                             {"d", 84},
                                                                             {"e", 2},
                                                                             {"f", 2},
                                                                             {"j", 1},
                                                                             {"k", 2},
                                                                             {"m", 2},
                                                                             {"n", 1},
                                                                             {"p", 1},
                                                                             {"r", 15},
                                                                             {"s", 7},
                                                                             {"t", 7},
                                                                             {"u", 11},
                                                                             {"v", 4},
                                                                             {"w", 4},
                                                                             {"y", 7}}));
    EXPECT_EQ(sides_of(maps::layer, 5), (std::map<std::size_t, std::size_t>{{4, 4}, {5, 9}, {6, 9}, {7, 10}}));
    EXPECT_EQ(sides_of(maps::leaf, 10),
              (std::map<std::size_t, std::size_t>{{3, 1}, {4, 27}, {5, 20}, {6, 5}, {7, 3}}));
}

TEST(MapStep, CellsAreNumbered) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(cells_of(maps::layer, 1), (Words{"haxg", "idc~a"}));
    EXPECT_EQ(outer_of(maps::layer, 1), "~g~x~c~d~i~h");
    EXPECT_EQ(cells_of(maps::layer, 2), (Words{"jc~ai", "xgxha", "xkeb~x~c", "xed~g~b"}));
    EXPECT_EQ(cells_of(maps::layer, 3),
              (Words{"lb~x~cxk", "md~g~b", "xhaxg", "ixjc~a", "xn~bxv~x~d", "ofvb", "xfeb~x~v", "xe~i~h~v~b"}));
    EXPECT_EQ(cells_of(maps::leaf, 1), (Words{"e~r~a~d", "~qka"}));
    EXPECT_EQ(outer_of(maps::leaf, 1), "d~kqr~e");
    EXPECT_EQ(cells_of(maps::leaf, 2), (Words{"f~s~c~d~d", "~p~jc", "~rmddj"}));
    EXPECT_EQ(cells_of(maps::leaf, 3), (Words{"dy~d~d", "c~t~e~y", "~r~a~de", "~qka", "~snddd~k"}));
}

TEST(MapStep, TextsHaveTheirHashes) {
    EXPECT_EQ(hash_of(maps::layer, 5), "791aac0c2de1adeab77196f308e5ed669f1ffa5e1522322892eebc20622d9966");
    EXPECT_EQ(hash_of(maps::layer, 10), "c0f0aa0105cae1aa9814ed8b3c12457b8f2f10c790bf06cc7dbbb4d946db7e0f");
    EXPECT_EQ(hash_of(maps::leaf, 10), "98c4b479d7d2e22e0db53b91dc288c5281eb38672abc2ee54b922e13fa4e7e66");
    EXPECT_EQ(hash_of(maps::leaf, 13), "abc54ef2307dd23ae5563733343f328288f0ca36ff63c7ce7af6799a00b8e4c9");
    EXPECT_EQ(hash_of(maps::worked, 4), "2e0cb5f886782237e21d9b680fd5ec6d1b7c5609302757afe71735ef6f1f2590");
    EXPECT_EQ(hash_of(maps::worked, 4, all), "41c7c760b130b371ff6ea726ed68561c0d6e6e4c54c41ef8b9605ef55b4bb6ec");
}

TEST(MapStep, TheWorkedExample) {
    const Document document = maps::document(maps::worked, 1);
    EXPECT_EQ(maps::text_of(maps::derive(document), *document.map()),
              "edge e 0 1 0\nedge a 4 1 0\nedge b 4 2 0\nedge e 3 2 0\nedge a 5 3 0\nedge b 5 0 0\nedge c 4 5 1\n"
              "cell +0 -1 +6 +5\ncell +2 -3 -4 -6\nouter -5 +4 +3 -2 +1 -0\n");
    using Words = std::vector<std::string>;
    EXPECT_EQ(cells_of(maps::worked, 2), (Words{"ae~eb~ab", "~a~c~a~e~b", "b~ec"}));
    EXPECT_EQ(outer_of(maps::worked, 2), "~baeae~bae~e~a");
    EXPECT_EQ(cells_of(maps::worked, 3), (Words{"eae~ecb~e~ab", "~a~a~c", "~e~b~e~e~a~ba", "~a~c~ab", "b~ec"}));
    EXPECT_EQ(outer_of(maps::worked, 3), "~baeaeeae~baeae~e~a~e");
    EXPECT_EQ(cells_of(maps::worked, 4), (Words{"aeeae~ecb~e~a~e~ab", "~ab~a~c", "~e~e~b", "~e~a~ba~e~a~e~a~e~bae",
                                                "~e~b~e~ab", "~a~c~ab", "b~ec"}));
    EXPECT_EQ(outer_of(maps::worked, 4), "~baeaeeaeaeeae~baeaeeae~e~a~e~e~a");
    EXPECT_EQ(growth_of(maps::worked, 4),
              (std::vector<Sizes>{{1, 4, 4, 4}, {2, 7, 6, 6}, {3, 12, 10, 10}, {5, 21, 17, 16}, {7, 35, 29, 26}}));
    EXPECT_EQ(cells_of(maps::worked, 1, all), (Words{"e~acb", "~c~c", "b~e~ac"}));
    EXPECT_EQ(cells_of(maps::worked, 2, all), (Words{"ae~eb~ab", "~b~b", "~a~c~a~eb", "b~ec"}));
    EXPECT_EQ(cells_of(maps::worked, 3, all).size(), 7u);
    EXPECT_EQ(cells_of(maps::worked, 4, all).size(), 11u);
}

TEST(MapStep, CheckersDivideInRowsAndColumns) {
    std::vector<std::array<std::size_t, 3>> found;
    for (const Sizes& sizes : growth_of(maps::checkers, 6))
        found.push_back({sizes.cells, sizes.vertices, sizes.edges});
    EXPECT_EQ(found, (std::vector<std::array<std::size_t, 3>>{
                         {1, 4, 4}, {2, 6, 7}, {4, 9, 12}, {8, 15, 22}, {16, 25, 40}, {32, 45, 76}, {64, 81, 144}}));
}

TEST(MapStep, CornerCases) {
    struct Case {
        const char* what;
        std::string axiom, productions;
        std::int64_t steps;
        std::vector<std::string> once, all;
    };
    const std::string disjoint = "a --> f[-e]f\nb --> f[-~e]f\nc --> f[-e]f\nd --> f[-~e]f\n";
    const std::string crossing = "a --> f[-e]f\nb --> f[-g]f\nc --> f[-~e]f\nd --> f[-~g]f\n";
    const std::string one_vertex = "a --> f[-e][-g]f\nb --> f[-~g]f\nc --> f[-~e]f\n";
    const std::string on_the_left = "a --> f[+e][+g]f\nb --> f[+~g]f\nc --> f[+~e]f\n";
    const std::vector<Case> cases = {
        {"nothing matches", "abc", "a --> a[-d]a\nb --> c[-d]b\n", 3, {"aaaaaaaacccbc"}, {"aaaaaaaacccbc"}},
        {"a match outside", "abc", "a --> a[+d]a\nb --> b[+~d]b\n", 1, {"aabbc"}, {"aabbc"}},
        {"two branches of one edge", "abc", "a --> e[-d]f[-~d]e\n", 1, {"edebc", "f~d"}, {"edebc", "f~d"}},
        {"a loop as axiom", "a", "a --> b[-c]b[-~c]b\n", 1, {"bcb", "b~c"}, {"bcb", "b~c"}},
        {"around the end", "abc", "a --> [-d]a\nc --> c[-~d]\n", 1, {"abc"}, {"abc"}},
        {"at old vertices", "abcd", "a --> [-e]a\nc --> [-~e]c\n", 1, {"ecd", "ab~e"}, {"ecd", "ab~e"}},
        {"beside an edge", "abc", "a --> [-d]a\nb --> [-~d]b\n", 1, {"dbc", "a~d"}, {"dbc", "a~d"}},
        {"disjoint pairs", "abcd", disjoint, 1, {"fefffff", "ff~e"}, {"feffef", "ff~e", "ff~e"}},
        {"crossing pairs", "abcd", crossing, 1, {"fefff", "ffff~e"}, {"fefff", "ffff~e"}},
        {"order at a vertex", "abcd", one_vertex, 1, {"fefd", "ffff~e"}, {"fefd", "gff~e", "ff~g"}},
        {"order on the left", "~a~b~c~d", on_the_left, 1, {"~fg~f~f~f~d", "~f~f~g"}, {"~fg~f~f~f~d", "~f~f~g"}},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.what);
        const std::string text = "map: clockwise\naxiom: " + one.axiom + "\n" + one.productions;
        EXPECT_EQ(cells_of(text, one.steps), one.once);
        EXPECT_EQ(cells_of(text, one.steps, all), one.all);
    }
}

TEST(MapStep, RandomSystemsEqualThoseOfTheRecursion) {
    std::size_t divided = 0;
    for (std::uint32_t seed = 0; seed < 2000; ++seed) {
        const std::string text = maps::random_system(seed);
        SCOPED_TRACE(text);
        const Document document = maps::document(text, 5);
        const MapSystem& system = *document.map();
        maps::SlowMap slow(system);
        MapDerivation derivation(document.grammar());
        do {
            const Map& map = derivation.map();
            ASSERT_EQ(maps::text_of(map, system), slow.text()) << "step " << derivation.steps();
            ASSERT_EQ(maps::fault_of(map), "");
            divided += map.cells() > 1;
            const MapForecast forecast = forecast_step(map, system, 0);
            if (map.edges().size() > 2000 || !derivation.next()) break;
            EXPECT_EQ(forecast.edges, derivation.origins().first_edge.back());
            EXPECT_EQ(forecast.vertices, map.vertices());
            EXPECT_LE(static_cast<double>(map.edges().size()), forecast.edges + forecast.walls);
            slow.step(0, static_cast<std::uint32_t>(derivation.steps()));
        } while (true);
    }
    EXPECT_GT(divided, 2000u);
}

TEST(MapStep, AnticlockwiseAxiomsAreReadBackwards) {
    // The other way round, with sides exchanged, it is the same cell.
    EXPECT_EQ(cells_of("map: anticlockwise\naxiom: abc\na --> e[+d]f[+~d]e\n", 1),
              cells_of("map: clockwise\naxiom: ~c~b~a\na --> e[+d]f[+~d]e\n", 1));
    EXPECT_EQ(cells_of("map: anticlockwise\naxiom: abc\n", 0), (std::vector<std::string>{"~c~b~a"}));
}

TEST(MapStep, TablesFollowTheSchedule) {
    const std::string text =
        "map: clockwise\naxiom: aaa\ntable one:\na --> ab\ntable two:\na --> c\nb --> d\nschedule: one*(n-1) two\n";
    EXPECT_EQ(cells_of(text, 1), (std::vector<std::string>{"ccc"}));
    EXPECT_EQ(cells_of(text, 3), (std::vector<std::string>{"cddcddcdd"}));
}

TEST(MapStep, CellsOfManyBranchesAreQuick) {
    constexpr int pairs = 200'000;
    // Each branch matches the next one; or all branches of one edge wait for those of the other.
    std::string beside = "map: clockwise\ndivide: all\naxiom: ab\na --> e";
    std::string opposite = beside;
    for (int i = 0; i < pairs; ++i) beside += "[-c]e[-~c]e";
    for (int i = 0; i < pairs; ++i) opposite += "[-c]e";
    opposite += "\nb --> f";
    for (int i = 0; i < pairs; ++i) opposite += "[-~c]f";
    const Map many = maps::derive(maps::document(beside + "\n", 1));
    EXPECT_EQ(many.cells(), pairs + 1u);
    EXPECT_EQ(maps::fault_of(many), "");
    const Map two = maps::derive(maps::document(opposite + "\n", 1));
    EXPECT_EQ(two.cells(), 2u);
    EXPECT_EQ(maps::fault_of(two), "");
}

TEST(MapStep, LimitsAreCheckedBeforeAStep) {
    const Document document = maps::document(maps::layer, 60);
    try {
        derive_map(document.grammar(), {20'000, 1e12});
        FAIL();
    } catch (const BudgetError& error) {
        EXPECT_STREQ(
            error.what(),
            "the map of step 12 (of n = 60) could have 12477 edges, 25167 with those of the steps before it, "
            "and the budget is 20000; the largest derivation length that fits is 11");
    }
    EXPECT_THROW(derive_map(document.grammar(), {1e18, 1e6}), BudgetError);
    EXPECT_THROW(derive_map(maps::document(maps::layer, 1'000'001).grammar()), BudgetError);
    EXPECT_THROW(derive_map(document.grammar(), {}, Monitor([](void*) { return true; })), Stopped);
}

TEST(MapStep, DerivationsThatMustExceedALargeBudgetAreRefusedEarly) {
    const Document document = maps::document(maps::layer, 60);
    std::uint64_t edges = 0;
    const Monitor monitor(
        nullptr, [](void* sum, std::uint64_t made) { *static_cast<std::uint64_t*>(sum) += made; }, &edges);
    EXPECT_THROW(derive_map(document.grammar(), {200e6, 1e12}, monitor), BudgetError);
    EXPECT_LT(edges, 1'000'000u);
    // A map that fits is derived: the bound counts edges that will exist.
    edges = 0;
    const Document shorter = maps::document(maps::layer, 16);
    EXPECT_NO_THROW(derive_map(shorter.grammar(), {}, monitor));
    EXPECT_NO_THROW(derive_map(shorter.grammar(), {std::max(8e6, 4.0 * static_cast<double>(edges)), 1e12}));
}

TEST(MapForecast, HasNoWordHoweverLongTheDerivation) {
    const std::int64_t n = std::numeric_limits<std::int64_t>::max() - 1;
    const Document document = maps::document(maps::layer, n);
    EXPECT_FALSE(estimate(document.grammar(), true));
    EXPECT_FALSE(forecast(document.grammar(), false));
    EXPECT_FALSE(fold(document.grammar()));
    EXPECT_NO_THROW(require_affordable(document.grammar(), true, 10));
    const std::string text = maps::layer + fmt::format("\nderivation length: {}\n", n);
    for (const Diagnostic& found : check_pattern("map", text, {}, {})) ADD_FAILURE() << found.text();
}

// --- the language
// ---------------------------------------------------------------------------------------------------

/// The first error of a pattern, with its place.
std::string error_of(const std::string& text) {
    Diagnostics diagnostics;
    Document::compile("m", text, {}, diagnostics);
    if (!diagnostics.has_errors()) return "";
    const Diagnostic error = diagnostics.sorted().front();
    return std::to_string(error.where.line) + ":" + std::to_string(error.where.column) + ": " + error.message;
}

TEST(MapLanguage, ErrorsHaveTheirPlaces) {
    const auto axiom = [](const std::string& word) { return error_of("map: clockwise\naxiom: " + word + "\n"); };
    EXPECT_EQ(axiom("abc"), "");
    EXPECT_EQ(axiom(""), "2:1: the axiom is empty: expected the labels of a cell's wall");
    EXPECT_EQ(axiom("a[-b]c"),
              "2:9: the axiom of a map consists of labels, with '~' before those directed against the walk");
    EXPECT_EQ(axiom("ab~"), "2:11: expected a label after '~'");
    EXPECT_EQ(axiom("a\u223cb"), "2:9: '\u223c' is not a label: write '~'");
    EXPECT_EQ(axiom("a\u02dcb"), "2:9: '\u02dc' is not a label: write '~'");
    EXPECT_EQ(axiom("a(1)b"), "2:9: labels of a map have no parameters");
    EXPECT_EQ(axiom("a%b"), "2:9: a map has no branches to cut: '%' is not a label");
    EXPECT_EQ(error_of("map: clockwise\na --> b\n"), "1:1: there is no 'axiom:'");

    const auto production = [](const std::string& line) {
        return error_of("map: clockwise\naxiom: abc\n" + line + "\n");
    };
    EXPECT_EQ(production("a --> ~b[+~c][-d]~e"), "");
    EXPECT_EQ(production("ab --> c"), "3:2: a production of a map replaces one label");
    EXPECT_EQ(production("~a --> c"), "3:1: the predecessor is not a label: expected one label");
    EXPECT_EQ(production("b < a --> c"), "3:1: productions of a map have no contexts");
    EXPECT_EQ(production("a > b --> c"), "3:5: productions of a map have no contexts");
    EXPECT_EQ(production("a : 1 > 0 --> c"), "3:5: productions of a map have no conditions");
    EXPECT_EQ(production("a --> c : 0.5"), "3:11: productions of a map have no weights");
    EXPECT_EQ(production("a(x) --> c"), "3:2: labels of a map have no parameters");
    EXPECT_EQ(production("a -->"), "3:1: edges never vanish: expected a label outside of brackets");
    EXPECT_EQ(production("a --> *"), "3:7: edges never vanish: expected a label outside of brackets");
    EXPECT_EQ(production("a --> [-b]"), "3:7: edges never vanish: expected a label outside of brackets");
    EXPECT_EQ(production("a --> b[]c"), "3:8: this branch is empty: expected a sign and a label");
    EXPECT_EQ(production("a --> b[-]c"), "3:10: expected the label of the branch");
    EXPECT_EQ(production("a --> b[c]d"), "3:9: a branch begins with '+' (left of the edge) or '-' (right of it)");
    EXPECT_EQ(production("a --> b[~-c]d"), "3:9: a branch begins with '+' (left of the edge) or '-' (right of it)");
    EXPECT_EQ(production("a --> b[-cd]e"), "3:11: a branch has one label: expected ']'");
    EXPECT_EQ(production("a --> b[-c[-d]]e"), "3:11: branches of a map do not nest");
    EXPECT_EQ(production("a --> b[-c"), "3:8: this '[' is not closed");
    EXPECT_EQ(production("a --> b["), "3:8: this '[' is not closed");
    EXPECT_EQ(production("a --> b]"), "3:8: ']' without '['");
    EXPECT_EQ(production("a --> b+c"), "3:8: '+' and '-' stand only at the beginning of a branch: '[+a]'");
    EXPECT_EQ(production("a --> b~[-c]d"), "3:9: expected a label after '~'");
    EXPECT_EQ(production("a --> b[-~]d"), "3:11: expected a label after '~'");
    EXPECT_EQ(production("a --> b~"), "3:9: expected a label after '~'");
    EXPECT_EQ(production("a --> b~~c"), "3:9: expected a label after '~'");
    EXPECT_EQ(production("a --> b\na --> c"), "4:1: 'a' has a production already; expected one for each label");
    EXPECT_EQ(production("a --> b\ntable t:\na --> c"),
              "5:1: 'a' has a production already; expected one for each label");
    EXPECT_EQ(production("interpret:\na --> b"), "4:1: a map has no word that 'interpret:' could change");
}

TEST(MapLanguage, KeysAreChecked) {
    const auto key = [](const std::string& line) { return error_of("map: clockwise\naxiom: abc\n" + line + "\n"); };
    EXPECT_EQ(error_of("map: left\naxiom: abc\n"), "1:6: expected 'clockwise' or 'anticlockwise'");
    EXPECT_EQ(error_of("map:\naxiom: abc\n"), "1:1: expected 'clockwise' or 'anticlockwise'");
    EXPECT_EQ(key("divide: twice"), "3:9: expected 'once' or 'all'");
    EXPECT_EQ(key("place: round"), "3:8: expected 'straight' or 'gravity' or 'pressure'");
    EXPECT_EQ(key("outline: square"), "3:10: expected 'polygon' or 'circle'");
    EXPECT_EQ(key("growth: 1.5"), "3:9: expected a number from 0 to 1");
    EXPECT_EQ(key("stretch: 0"), "3:10: expected a number above 0, from 0.001 to 1000");
    EXPECT_EQ(key("heading: 0"), "3:1: 'heading:' does not apply to a map, which has no turtle");
    EXPECT_EQ(key("tempo: 90"), "3:1: 'tempo:' does not apply to a map, which has no turtle");
    EXPECT_EQ(error_of("axiom: F\ndivide: all\n"),
              "2:1: 'divide:' applies only to maps: expected the key 'map: clockwise' beside it");
    EXPECT_EQ(key("seed: 3"), "");
    EXPECT_EQ(key("symbols: ab cd\nab --> cd[-ab]cd"), "");
}

TEST(MapLanguage, SettingsAreRead) {
    const Document document = parse("m",
                                    "map: anticlockwise\ndivide: all\nplace: gravity\noutline: circle\n"
                                    "growth: 0.25\nstretch: 2\naxiom: ab ab~c\nsymbols: ab\n");
    const MapSystem& system = *document.map();
    EXPECT_FALSE(system.is_clockwise);
    EXPECT_TRUE(system.divides_all);
    EXPECT_EQ(system.placing, Placing::gravity);
    EXPECT_EQ(system.outline, MapOutline::circle);
    EXPECT_EQ(system.growth, 0.25);
    EXPECT_EQ(system.stretch, 2);
    EXPECT_EQ(system.labels, (std::vector<std::string>{"ab", "c"}));
    EXPECT_EQ(parse("m", "axiom: F\n").map(), nullptr);
    EXPECT_EQ(document.with({{"set", "divide", "once"}}).map()->divides_all, false);
}

}  // namespace sikku::map_test
