// tests/art/reading_test.cpp: kolams read from JSON, tables, gestures and drawings, and written back.
#include "art/analysis.h"
#include "art/kolam/dot_grid_making.h"
#include "art/reading/gesture_drawing.h"
#include "art/reading/gestures.h"
#include "art/reading/kolam_csv.h"
#include "art/reading/kolam_file.h"
#include "art/reading/kolam_json.h"
#include "art/reading/kolam_lines.h"
#include "art/reading/kolam_svg.h"
#include "art/reading/lattice.h"
#include "art/reading/svg_path.h"
#include "tests/checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace sikku::reading_test {

const std::vector<std::string>& square_grids() {
    static const std::vector<std::string> grids = {"1x1", "1x4", "4x1",           "3x3",
                                                   "4x6", "7x7", "1-3-5-7-5-3-1", "oo.oo/ooooo/.ooo./ooooo/oo.oo"};
    return grids;
}

GapStates some_states(const DotGrid& grid, std::uint32_t seed, double joined) {
    return random_states(grid, {.seed = seed, .density = 0.6, .joined = joined});
}

void expect_same(const ReadKolam& kolam, const DotGrid& grid, const GapStates& states, const std::string& what) {
    EXPECT_EQ(kolam.grid.text(), grid.text()) << what;
    ASSERT_EQ(kolam.states.size(), states.size()) << what;
    EXPECT_EQ(gap_states_text(kolam.grid, kolam.states), gap_states_text(grid, states)) << what;
    EXPECT_TRUE(kolam.doubtful().empty()) << what;
    for (const std::string& note : kolam.notes) ADD_FAILURE() << what << ": " << note;
}

// --- places of gaps -----------------------------------------------------------------------------------------------

TEST(ReadKolam, PlacesOfGapsAreTheWordsOfGapStates) {
    const DotGrid grid = parse_dot_grid("3x3");
    const std::vector<GapPlace> places = gap_places(grid);
    ASSERT_EQ(places.size(), 12U);
    EXPECT_EQ(places[0], (GapPlace{1, 1}));
    EXPECT_EQ(places[2], (GapPlace{2, 1}));
    EXPECT_EQ(places[4], (GapPlace{2, 3}));
    EXPECT_EQ(places[11], (GapPlace{5, 2}));
}

TEST(ReadKolam, FixesGapsByHand) {
    const DotGrid grid = parse_dot_grid("3x3");
    ReadKolam kolam{grid, GapStates(12), std::vector<float>(12, 0.2F)};
    fix_gaps(kolam, "2,3: cross; 5,2 : JOIN;");
    EXPECT_EQ(gap_states_text(grid, kolam.states), "00 001 00 000 02");
    EXPECT_EQ(kolam.repaired, (std::vector<std::uint32_t>{4, 11}));
    EXPECT_FALSE(kolam.is_doubtful(4));
    EXPECT_TRUE(kolam.is_doubtful(5));
    EXPECT_TRUE(has(error_of([&] { fix_gaps(kolam, "6,1: cross"); }), "numbered 1 to 5"));
    EXPECT_TRUE(has(error_of([&] { fix_gaps(kolam, "1,3: cross"); }), "row 1 has 2 gaps"));
    for (const char* text : {"", "1", "1,1", "1,1: what", "1;1: cross", "x,1: cross", "99999999999,1: cross"}) {
        EXPECT_TRUE(has(error_of([&] { fix_gaps(kolam, text); }), "expected ROW,GAP: STATE")) << text;
    }
}

TEST(ReadKolam, SymmetryDecidesDoubtfulGapsOnlyIfTheCertainOnesHaveIt) {
    const DotGrid grid = parse_dot_grid("5x5");
    const GapStates symmetric = random_states(grid, {.seed = 3, .density = 0.5, .symmetry = GridSymmetry::c4});
    ReadKolam kolam{grid, symmetric, std::vector<float>(symmetric.size(), 1.0F)};
    const std::uint32_t wrong = 7;
    kolam.states[wrong] = symmetric[wrong] == GapState::crossed ? GapState::turned : GapState::crossed;
    kolam.certainty[wrong] = 0.1F;
    EXPECT_EQ(repair_by_symmetry(kolam), 1U);
    EXPECT_EQ(kolam.states, symmetric);
    EXPECT_EQ(kolam.repaired, std::vector<std::uint32_t>{wrong});
    EXPECT_EQ(kolam.notes.size(), 1U);
    EXPECT_TRUE(kolam.is_doubtful(wrong)) << "a repair stays visible";

    // One certain gap against the symmetry, and nothing is repaired.
    ReadKolam other{grid, symmetric, std::vector<float>(symmetric.size(), 1.0F)};
    for (const std::uint32_t gap : {0U, 1U, 2U}) {
        other.states[gap] = symmetric[gap] == GapState::crossed ? GapState::turned : GapState::crossed;
    }
    other.states[wrong] = kolam.states[wrong] == GapState::crossed ? GapState::turned : GapState::crossed;
    other.certainty[wrong] = 0.1F;
    EXPECT_EQ(repair_by_symmetry(other), 0U);
}

// --- lattices -----------------------------------------------------------------------------------------------------

TEST(Lattice, FitsDotsInPerspectiveAmongOthers) {
    for (const char* name : {"7x7", "4x9", "9-5 idukku", "1-3-5-7-5-3-1"}) {
        const DotGrid grid = parse_dot_grid(name);
        const Homography view =
            *Homography::fit(std::vector<glm::dvec2>{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}},
                             std::vector<glm::dvec2>{{100, 820}, {930, 900}, {790, 160}, {180, 100}});
        std::mt19937 random(5);
        const auto uniform = [&](double low, double high) {
            return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
        };
        std::vector<glm::dvec2> points;
        for (const GridDot dot : grid.dots()) {
            points.push_back(view(lattice_point(grid.lattice(), dot)) + glm::dvec2(uniform(-2, 2), uniform(-2, 2)));
        }
        for (int i = 0; i < 12; ++i) points.emplace_back(uniform(0, 1000), uniform(0, 1000));
        const auto fit = fit_lattice(points, true);
        ASSERT_TRUE(fit) << name;
        EXPECT_EQ(fit->lattice, grid.lattice()) << name;
        // All dots have places that differ as those of the grid do.
        for (std::size_t i = 0; i < grid.dots().size(); ++i) {
            ASSERT_TRUE(fit->places[i]) << name << ", dot " << i;
            EXPECT_EQ(fit->places[i]->x - fit->places[0]->x, grid.dots()[i].x - grid.dots()[0].x) << name;
            EXPECT_EQ(fit->places[i]->y - fit->places[0]->y, grid.dots()[i].y - grid.dots()[0].y) << name;
        }
        const auto back = fit->map.inverse();
        ASSERT_TRUE(back);
        EXPECT_LT(glm::distance((*back)(fit->map({2, 3})), glm::dvec2(2, 3)), 1e-9);
    }
}

TEST(Lattice, FindsNoneInTooFewPoints) {
    EXPECT_FALSE(fit_lattice({}, true));
    EXPECT_FALSE(fit_lattice({{1, 1}}, true));
    EXPECT_FALSE(fit_lattice({{1, 1}, {1, 1}, {1, 1}}, true));
}

// --- lines --------------------------------------------------------------------------------------------------------

TEST(KolamLines, ComeBackFromTheLinesOfAnyKolam) {
    std::vector<std::string> grids = square_grids();
    grids.insert(grids.end(), {"7-4 idukku", "5x5 idukku"});
    for (const std::string& name : grids) {
        const DotGrid grid = parse_dot_grid(name);
        for (std::uint32_t seed = 0; seed < 6; ++seed) {
            const GapStates states = some_states(grid, seed, 0.4);
            for (const double apart : {0.0, 0.3}) {
                auto lines = lines_of_kolam(grid, states, apart);
                // As a drawing: turned, sheared, larger; y points down.
                const auto draw = [&](glm::dvec2 p) {
                    p.y *= grid.lattice() == DotLattice::square ? 1 : std::sqrt(3.0) / 2;
                    return glm::dvec2(40 * p.x + 3 * p.y + 500, 4 * p.x - 38 * p.y + 400);
                };
                std::vector<glm::dvec2> dots;
                for (const GridDot dot : grid.dots()) dots.push_back(draw({dot.x, dot.y}));
                for (ClosedLine& line : lines) {
                    for (glm::dvec2& point : line) point = draw(point);
                }
                const std::string what = fmt::format("{}, seed {}, {}", name, seed, apart);
                if (dots.size() > 4) {
                    expect_same(kolam_of_lines(lines, dots, true, grid.lattice()), grid, states, what);
                }
            }
        }
    }
}

/// Without dots: where the lines run around an odd number of times.
TEST(KolamLines, PlacesDotsAsTraditionDoes) {
    for (const char* name : {"3x3", "7x7", "1-3-5-7-5-3-1", "oo.oo/ooooo/.ooo./ooooo/oo.oo", "7-4 idukku"}) {
        const DotGrid grid = parse_dot_grid(name);
        for (std::uint32_t seed = 0; seed < 3; ++seed) {
            const GapStates states = some_states(grid, seed, 0.0);
            auto lines = lines_of_kolam(grid, states, 0.2);
            for (ClosedLine& line : lines) {
                for (glm::dvec2& point : line) {
                    point.y *= grid.lattice() == DotLattice::square ? 1 : std::sqrt(3.0) / 2;
                }
            }
            expect_same(kolam_of_lines(lines, {}, false), grid, states, name);
        }
    }
}

TEST(KolamLines, MissingStrandsAreDoubtful) {
    const DotGrid grid = parse_dot_grid("3x3");
    const GapStates states = parse_gap_states(grid, "none");
    auto lines = lines_of_kolam(grid, states, 0.3);
    lines.erase(lines.begin() + 4);  // the ring around the middle
    std::vector<glm::dvec2> dots;
    for (const GridDot dot : grid.dots()) dots.emplace_back(dot.x, dot.y);
    const ReadKolam kolam = kolam_of_lines(lines, dots, false);
    EXPECT_EQ(kolam.doubtful().size(), 4U);
    ASSERT_EQ(kolam.notes.size(), 1U);
    EXPECT_EQ(kolam.notes[0], "1 of 9 dots is not encircled once by the lines");
}

// --- .kolam.json --------------------------------------------------------------------------------------------------

TEST(KolamJson, ComesBackByteForByte) {
    for (const std::string& name : square_grids()) {
        const DotGrid grid = parse_dot_grid(name);
        const GapStates states = some_states(grid, 1, 0.3);
        const std::string text = kolam_json_file(grid, states);
        const ReadKolam kolam = read_kolam_json(text);
        expect_same(kolam, grid, states, name);
        EXPECT_EQ(kolam_json_file(kolam.grid, kolam.states), text);
    }
    EXPECT_TRUE(has(error_of([] { kolam_json_file(parse_dot_grid("7-4 idukku"), GapStates(90)); }), "interlaced"));
}

TEST(KolamJson, SaysWhatIsWrong) {
    const auto design = [](const std::string& members) {
        return R"({"format":"kolam","version":1,"design":{)" + members + "}}";
    };
    const std::string good = R"("rows":1,"cols":3,"mask":["111"],"h":["xp"],"v":[])";
    EXPECT_EQ(gap_states_text(read_kolam_json(design(good)).grid, read_kolam_json(design(good)).states), "10");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"{", "byte"},
        {"[]", "the list is empty"},
        {"{}", "'format' is missing"},
        {R"({"format":"rangoli"})", "'format' is not \"kolam\""},
        {R"({"format":"kolam","version":2})", "'version' is not 1"},
        {R"({"format":"kolam","version":1,"design":[]})", "'rows' is missing"},
        {design(R"("rows":1e9,"cols":1)"), "'rows' is not a whole number"},
        {design(R"("rows":4000000,"cols":4000000)"), "more than 4000000 dots"},
        {design(R"("rows":1,"cols":3,"mask":["11"],"h":["xp"],"v":[])"), "2 letters instead of 3"},
        {design(R"("rows":1,"cols":3,"mask":["112"],"h":["xp"],"v":[])"), "'mask', row 1, letter 3: '2'"},
        {design(R"("rows":1,"cols":3,"mask":["111"],"h":["x."],"v":[])"), "'.' between two dots"},
        {design(R"("rows":1,"cols":3,"mask":["110"],"h":["xp"],"v":[])"), "2 gaps have a state, but 1 lie"},
        {design(R"("rows":1,"cols":3,"mask":["000"],"h":[".."],"v":[])"), "the mask has no dots"},
        {design(R"("rows":1,"cols":3,"mask":[1],"h":[".."],"v":[])"), "not a text"},
        {design(R"("rows":1,"cols":3,"mask":["111"],"h":"xp","v":[])"), "'h' is not a list of 1 texts"}};
    for (const auto& [text, message] : cases) {
        EXPECT_TRUE(has(error_of([&] { read_kolam_json(text); }), message))
            << text << "\n"
            << error_of([&] { read_kolam_json(text); });
    }
}

// --- tables -------------------------------------------------------------------------------------------------------

/// The public data set of one-stroke kolams has tables of 725, 1685 and 23765 rows, for diamonds of 19, 29 and 109
/// dots: each arc of a dot has a point, and the first one is repeated.
TEST(KolamCsv, HasAsManyRowsAsThePublishedTables) {
    for (const auto& [across, points] : {std::pair(19U, 725), std::pair(29U, 1685)}) {
        std::vector<std::uint32_t> rows;
        for (std::uint32_t r = 1; r <= across; r += 2) rows.push_back(r);
        for (std::uint32_t r = across - 2; r + 2 >= 3; r -= 2) rows.push_back(r);
        const DotGrid grid(rows);
        const auto found = find_single_line(grid, {.seed = 1}, 10);
        ASSERT_TRUE(found);
        const std::string text = kolam_csv_file(grid, found->states);
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), points + 1);
        expect_same(read_kolam_csv(text, 1), grid, found->states, fmt::format("{}", across));
    }
}

/// The beginning of the first kolam of the table of 19, as its documentation quotes it: a line that crosses at
/// (1, 0) and (2, 1), turns around the dot (2, 2) and crosses at (2, 1) again.
TEST(KolamCsv, ReadsTheKolamsOfATable) {
    const std::string table =
        "x-kolam 1,y-kolam 1,x-kolam 2,y-kolam 2\r\n"
        "1.0,0.0,0.5,0.0\r\n1.5,0.5,,\r\n";
    EXPECT_TRUE(is_kolam_csv(table));
    // Two dots, one above the other, in a figure of eight; beside it a ring around one dot.
    const std::string eight =
        "\"x-kolam 1\",\"y-kolam 1\",x-kolam 2,y-kolam 2\n"
        "0.0,1.0,0.5,0.0\n0.5,2.0,0.0,0.5\n0.0,2.5,-0.5,0.0\n-0.5,2.0,0.0,-0.5\n0.0,1.0,0.5,0.0\n"
        "0.5,0.0,,\n0.0,-0.5,,\n-0.5,0.0,NaN,NaN\n0.0,1.0,,\n";
    const ReadKolam first = read_kolam_csv(eight, 1);
    EXPECT_EQ(first.grid.text(), "2x1");
    EXPECT_EQ(first.states, GapStates{GapState::crossed});
    EXPECT_EQ(first.notes, std::vector<std::string>{"kolam 1 of 2 in the table"});
    const ReadKolam second = read_kolam_csv(eight, 2);
    EXPECT_EQ(second.grid.text(), "1x1");
    EXPECT_TRUE(has(error_of([&] { read_kolam_csv(eight, 3); }), "has 2 kolams, but not number 3"));
    EXPECT_TRUE(has(error_of([&] { read_kolam_csv("a,b\n1,2\n", 1); }), "no columns 'x-kolam 1'"));
    EXPECT_TRUE(has(error_of([&] { read_kolam_csv("x-kolam 1,y-kolam 1\n1,2\n1\n", 1); }), "row 3: too few"));
    EXPECT_TRUE(has(error_of([&] { read_kolam_csv("x-kolam 1,y-kolam 1\n1,two\n", 1); }), "row 2: expected two"));
    EXPECT_TRUE(has(error_of([&] { read_kolam_csv("x-kolam 1,y-kolam 1\n1,2\n,\n1,2\n", 1); }), "row 4"));
    EXPECT_TRUE(has(error_of([&] { read_kolam_csv("x-kolam 1,y-kolam 1\n1,2\n", 1); }), "has no line"));
}

/// The grid would grow to reach such a point.
TEST(KolamCsv, RefusesAPointThatIsFarFromTheOthers) {
    const DotGrid grid = parse_dot_grid("4x5");  // a single line
    const std::string text = kolam_csv_file(grid, parse_gap_states(grid, "all"));
    EXPECT_EQ(read_kolam_csv(text, 1).grid.text(), "4x5");
    for (const std::size_t row : {2U, 7U}) {
        std::size_t at = 0;
        for (std::size_t i = 1; i < row; ++i) at = text.find('\n', at) + 1;
        EXPECT_TRUE(has(error_of<std::runtime_error>(
                            [&] { read_kolam_csv(text.substr(0, at) + "2000000.5,3\n" + text.substr(at), 1); }),
                        fmt::format("row {}: the point 2000000.5, 3 is", row)));
    }
}

TEST(KolamCsv, ComesBackByteForByte) {
    for (const std::string& name : square_grids()) {
        const DotGrid grid = parse_dot_grid(name);
        const auto found = find_single_line(grid, {.seed = 2, .joined = 0.3}, 50);
        ASSERT_TRUE(found) << name;
        const std::string text = kolam_csv_file(grid, found->states);
        const ReadKolam kolam = read_kolam_csv(text, 1);
        expect_same(kolam, grid, found->states, name);
        EXPECT_EQ(kolam_csv_file(kolam.grid, kolam.states), text) << name;
    }
    const DotGrid grid = parse_dot_grid("3x3");
    EXPECT_TRUE(has(error_of([&] { kolam_csv_file(grid, parse_gap_states(grid, "none")); }), "has 9"));
}

TEST(KolamJson, ListsAreReadByNumber) {
    const auto file = [](const char* states) {
        return kolam_json_file(parse_dot_grid("2x2"), parse_gap_states(parse_dot_grid("2x2"), states));
    };
    const std::string list = "[" + file("1 11 1") + ", " + file("0 10 1") + "]";
    const auto second = read_kolam_text(list, {.number = 2});
    ASSERT_TRUE(second);
    EXPECT_EQ(gap_states_text(second->grid, second->states), "0 10 1");
    EXPECT_EQ(second->notes, (std::vector<std::string>{"kolam 2 of 2 in the list"}));
    EXPECT_TRUE(read_kolam_text("[" + file("1 11 1") + "]")->notes.empty());
    EXPECT_TRUE(has(error_of([&] { read_kolam_text(list, {.number = 3}); }), "no kolam 3; the file contains 2"));
    EXPECT_TRUE(has(error_of([] { read_kolam_text("[]"); }), "the list is empty"));
    EXPECT_TRUE(has(error_of([] { read_kolam_text("[{}, 3]", {.number = 2}); }), "kolam 2 of the list"));
}

// --- gestures -----------------------------------------------------------------------------------------------------

/// `[O1 O3 O4 O1] x 4`, the example of Waring (2012) for orthogonal gestures, draws one loop.
TEST(Gestures, ReadsTheExampleOfWaring) {
    const ReadKolam kolam = read_gestures("O1 O3 O4 O1 O1 O3 O4 O1 O1 O3 O4 O1 O1 O3 O4 O1\n");
    EXPECT_EQ(count_lines(kolam.grid, kolam.states), 1U);
    EXPECT_TRUE(kolam.doubtful().empty());
    // Each quarter of a dot is drawn once.
    EXPECT_EQ(4 * kolam.grid.dots().size(), 4 * (1U + 3 + 4 + 1));
}

/// Places and headings that a study recorded before each gesture, from a gap to the middle of four dots and back.
TEST(Gestures, MeetInTheMiddleOfFourDots) {
    const std::string loop = "2.5,7.5,180: D4L T2R O1 O2 O1 O3 T4 D4R D1 D1 T3R O1 T1\n";
    EXPECT_TRUE(meets_between_four(loop));
    const GestureDrawing drawing = draw_gestures(loop);
    ASSERT_EQ(drawing.lines.size(), 1U);
    std::vector<std::pair<int, int>> points;
    for (const GridDot at : drawing.lines[0]) points.emplace_back(at.x, at.y);
    // In half spacings, as recorded: 2,8.5 2.5,9 3.5,9 4,8.5 3.5,8 3.5,8.5 2.5,8.5 1.5,8.5 1.5,9 2,8.5
    std::size_t next = 0;
    for (const auto& place : std::vector<std::pair<int, int>>{{5, 15},
                                                              {5, 15},
                                                              {4, 17},
                                                              {5, 18},
                                                              {7, 18},
                                                              {8, 17},
                                                              {7, 16},
                                                              {7, 17},
                                                              {7, 17},
                                                              {5, 17},
                                                              {3, 17},
                                                              {3, 18},
                                                              {4, 17}}) {
        next = static_cast<std::size_t>(
            std::find(points.begin() + static_cast<std::ptrdiff_t>(next), points.end(), place) - points.begin());
        ASSERT_LT(next, points.size()) << place.first << ' ' << place.second;
        ++next;
    }
    const Document pattern = parse("x.lsys", gesture_pattern(drawing, "title: one\n"));
    const DrawnLines drawn = drawn_lines(pattern, 1e6, {});
    const auto& strokes = std::get<Polylines<glm::dvec2>>(drawn);
    ASSERT_EQ(strokes.begins.size(), 2U);
    EXPECT_EQ(strokes.points.front(), strokes.points.back()) << "closed exactly";
}

TEST(Gestures, FourPetalsAreOneClosedLine) {
    // The first loop of the first kolam that the study shares, without quotes.
    const std::string text =
        "matrix_size: 21\nsequence: \n [[D4L D4L D4L D4L]]\nhistory: [[h] [Oldx 0 31.5 31.5 31.5 31.5] "
        "[Oldy 10.5 73.5 73.5 73.5 73.5] [Oldh 90 0 90 180 270]]\n";
    const GestureDrawing drawing = draw_gestures(text);
    EXPECT_EQ(drawing.dots.size(), 4U);
    EXPECT_EQ(drawing.lines[0].size(), 20U);
    EXPECT_EQ(std::count(drawing.lines[0].begin(), drawing.lines[0].end(), GridDot{3, 7}), 4);
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"0.5,0.5,0: D4", "needs a side"},
        {"0.5,0.5,45: D4L", "has the heading 45 here"},
        {"0.5,0.5,0: O2", "starts between two dots"},
        {"0.5,0,45: D1", "starts in the middle of four dots"},
        {"0.5,0.5,0: D1", "does not close"},
        {"0.5,0.5,0: D1 C1", "must be the only gesture"},
        {"1,1,0: T1L", "on a dot"}};
    for (const auto& [gestures, message] : cases) {
        EXPECT_TRUE(has(error_of([&] { draw_gestures(gestures); }), message))
            << gestures << "\n"
            << error_of([&] { draw_gestures(gestures); });
    }
}

/// A loop of a transcription that the study of 2021 shares: the third of its second kolam.
TEST(Gestures, ReadsTheTranscriptionOfAStudy) {
    const std::string text =
        "matrix_size: 11\npulli: 9\nloops: 1\nktype: \"O_____\"\nsequence: '\n [[\"O4\" \"O1\" \"O4\" \"O2\" \"O4\" "
        "\"O1\"]]'\n\nhistory: \"[[history-array] [Oldx 0 55 55.000139617026214 60.5001396170262 60.54813617145605 "
        "49.5482757884823 49.500279234052456] [Oldy 5.5 82.5 82.54799655442984 77.04799655442982 77.04785693740358 "
        "76.99986038297374 76.99999999999997] [Oldh 90 45 135 135 225 315 45] [Oldpos Ov Ov Ov Oh Oh Oh Oh]]\"\n";
    const ReadKolam kolam = read_gestures(text);
    EXPECT_EQ(kolam.grid.text(), "1,3");
    EXPECT_EQ(gap_states_text(kolam.grid, kolam.states), "1 11");
    EXPECT_EQ(count_lines(kolam.grid, kolam.states), 1U);
}

TEST(Gestures, ComeBackByteForByte) {
    for (const std::string& name : square_grids()) {
        const DotGrid grid = parse_dot_grid(name);
        for (std::uint32_t seed = 0; seed < 5; ++seed) {
            const GapStates states = some_states(grid, seed, 0);
            const std::string text = gestures_file(grid, states);
            const ReadKolam kolam = read_gestures(text);
            expect_same(kolam, grid, states, name);
            EXPECT_EQ(gestures_file(kolam.grid, kolam.states), text) << name;
        }
    }
}

TEST(Gestures, SayWhatTheyCannotDescribe) {
    const DotGrid grid = parse_dot_grid("3x3");
    GapStates states = parse_gap_states(grid, "all");
    states[4] = states[7] = GapState::joined;
    EXPECT_TRUE(has(error_of([&] { gestures_file(grid, states); }), "row 2, gap 3 (2 in all)"));
    EXPECT_TRUE(has(error_of([] { gestures_file(parse_dot_grid("7-4 idukku"), GapStates(90)); }), "interlaced"));
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"O4 D4L", "loop 1, gesture 2: 'd4l' passes through the middle of four dots"},
        {"O1 O9", "loop 1, gesture 2: 'o9' is unknown"},
        {"C2", "decoration"},
        {"O1 O1", "loop 1 does not close"},
        {"O4 C1", "C1 must be the only gesture"},
        {"C1\nC1", "loop 2 has no start"},
        {"0,0.5,90: C1", "heading 90"},
        {"0,0,45: C1", "does not start midway"},
        {"0.3,0.5,45: C1", "not midway"},
        {"x,0.5,45: C1", "expected X,Y,HEADING"},
        {"\n\n", "there are none"},
        {"sequence: '[[\"O4\"]", "has no end"},
        {"sequence: '[[[\"O4\"]]]'", "brackets"},
        {"sequence: '[[\"O4\"]]'\nhistory: \"[Oldx 0 1]\"", "matrix_size"},
        {"matrix_size: 2\nsequence: '[[\"O4\"]]'\nhistory: \"[Oldx 0 1]\"", "lacks Oldy"}};
    for (const auto& [text, message] : cases) {
        EXPECT_TRUE(has(error_of([&] { read_gestures(text); }), message)) << text << "\n"
                                                                          << error_of([&] { read_gestures(text); });
    }
}

// --- SVG ----------------------------------------------------------------------------------------------------------

TEST(SvgPath, FlattensEveryCommand) {
    const auto ends = [](const char* data) {
        const auto paths = flatten_path(data, 1000);
        EXPECT_EQ(paths.size(), 1U) << data;
        return paths.at(0).points.back();
    };
    EXPECT_EQ(ends("M1 2L3,4"), glm::dvec2(3, 4));
    EXPECT_EQ(ends("m1-2-.5.25"), glm::dvec2(0.5, -1.75));
    EXPECT_EQ(ends("M0 0h5v6H2V3"), glm::dvec2(2, 3));
    EXPECT_EQ(ends("M0 0c1 0 2 1 2 2s1 2 2 2"), glm::dvec2(4, 4));
    EXPECT_EQ(ends("M0 0q1 0 2 2t3 1e0"), glm::dvec2(5, 3));
    EXPECT_EQ(ends("M0 0a1 1 0 0 1 2 0"), glm::dvec2(2, 0));
    // A half circle bulges by its radius, to the side that the flag says.
    const auto arc = flatten_path("M0 0a1 1 0 01 2 0", 1000).at(0).points;
    const auto lowest = std::min_element(arc.begin(), arc.end(), [](auto a, auto b) { return a.y < b.y; });
    EXPECT_NEAR(lowest->y, -1, 1e-9);
    const auto two = flatten_path("M0 0 1 0 1 1zm5 5h1v1z", 1000);
    ASSERT_EQ(two.size(), 2U);
    EXPECT_TRUE(two[0].is_closed && two[1].is_closed);
    EXPECT_EQ(two[1].points[0], glm::dvec2(5, 5));
    for (const char* bad : {"L1 2", "M", "M1", "M1 2X", "M0 0c1 2 3", "M0 0a1 1 0 2 1 2 0", "M1e999 0", "M--1 0"}) {
        EXPECT_TRUE(has(error_of([&] { flatten_path(bad, 1000); }), "damaged path data")) << bad;
    }
    EXPECT_TRUE(has(error_of([] { flatten_path("M0 0h1h1h1h1", 3); }), "more than 3 points"));
}

TEST(KolamSvg, ReadsPathsAndDotsThroughTransforms) {
    const std::string text =
        "<svg xmlns='http://www.w3.org/2000/svg'><title>Eight</title><g transform='rotate(10) scale(3,-3)' "
        "style='fill: none; stroke:black'><path d='M0 1C.5 1.5.5 2.5 0 2.5S-.5 1.5 0 1S.5-.5 0-.5S-.5.5 0 1z'/>"
        "</g><g transform='rotate(10) scale(3,-3)'><circle cx='0' cy='0' r='.1'/><circle cx='0' cy='2' r='.1'/></g>"
        "<defs><path d='broken'/></defs></svg>";
    const ReadKolam kolam = read_kolam_svg(text);
    EXPECT_EQ(kolam.grid.text(), "2x1");
    EXPECT_EQ(kolam.states, GapStates{GapState::crossed});
    EXPECT_EQ(kolam.title, "Eight");
    EXPECT_TRUE(kolam.doubtful().empty());
}

TEST(KolamSvg, SaysWhatIsWrong) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"<svg", "damaged XML"},
        {"<svg/>", "no paths"},
        {"<svg><path d='M0 0 L1 1 L5 0' stroke='red' fill='none'/></svg>", "1 open line"},
        {"<svg><path d='M0 0 X'/></svg>", "damaged path data"},
        {"<svg><g transform='spin(3)'><path d='M0 0h1v1z'/></g></svg>", "unknown transform"},
        {"<svg><circle cx='1y2'/></svg>", "not a number"}};
    for (const auto& [text, message] : cases) {
        EXPECT_TRUE(has(error_of([&] { read_kolam_svg(text); }), message)) << text << "\n"
                                                                           << error_of([&] { read_kolam_svg(text); });
    }
    std::string deep;
    for (int i = 0; i < 1000; ++i) deep += "<g>";
    EXPECT_TRUE(has(error_of([&] { read_kolam_svg("<svg>" + deep); }), "damaged XML"));
    for (int i = 0; i < 1000; ++i) deep += "</g>";
    EXPECT_TRUE(has(error_of([&] { read_kolam_svg("<svg>" + deep + "</svg>"); }), "nested too deeply"));
}

TEST(KolamFile, KnowsTextsByTheirContent) {
    const DotGrid grid = parse_dot_grid("3x3");
    const GapStates states = parse_gap_states(grid, "11 111 01 111 11");
    for (const char* extension : {"json", "yaml"}) {
        const auto text = kolam_file_text(extension, grid, states);
        ASSERT_TRUE(text);
        const auto kolam = read_kolam_text(*text);
        ASSERT_TRUE(kolam) << extension;
        expect_same(*kolam, grid, states, extension);
    }
    EXPECT_FALSE(kolam_file_text("lsys", grid, states));
    EXPECT_FALSE(read_kolam_text("axiom: F\n"));
    EXPECT_TRUE(has(error_of([] { read_kolam_text(" \n"); }), "empty"));
    EXPECT_TRUE(has(error_of([] { read_kolam_text("<html/>"); }), "not an SVG"));
}

}  // namespace sikku::reading_test
