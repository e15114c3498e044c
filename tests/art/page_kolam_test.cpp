// Kolams that fill a page, and friezes: measured in SVG files and traced as rays between mirrors.
#include "art/kolam/page_kolam.h"

#include "art/kolam/dot_grid_pattern.h"
#include "art/kolam/kolam.h"
#include "art/prints.h"
#include "engine/geometry/box.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/reference.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::page_kolam_test {

constexpr double margin = 10;

// --- a second measure of drawings
// -----------------------------------------------------------------------------------

/// The numbers of a path, and a letter before each group: `M1 2c3 4 5 6 7 8z`.
class PathText {
public:
    explicit PathText(std::string text) : text_(std::move(text)) {}
    /// The next letter if there is one; otherwise the last one is repeated.
    char command() {
        skip();
        if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) command_ = text_[at_++];
        skip();
        return command_;
    }
    bool is_at_end() {
        skip();
        return at_ == text_.size();
    }
    glm::dvec2 point() {
        const double x = number();
        return {x, number()};
    }

private:
    double number() {
        char* end = nullptr;
        const double value = std::strtod(text_.c_str() + at_, &end);
        at_ = static_cast<std::size_t>(end - text_.c_str());
        return value / 1000;
    }
    void skip() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == ',')) ++at_;
    }
    std::string text_;
    std::size_t at_ = 0;
    char command_ = 0;
};

/// The box of the curves of an SVG, from 64 points of each, with the width of its lines; in millimetres.
Box ink_of(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    Box box;
    for (const auto& found : document.select_nodes("//path")) {
        const double reach = found.node().parent().attribute("stroke-width").as_double() / 2000;
        PathText path(found.node().attribute("d").value());
        glm::dvec2 at(0.0);
        while (!path.is_at_end()) {
            const char command = path.command();
            if (command == 'M') {
                at = path.point();
            } else if (command == 'c') {
                const glm::dvec2 b = at + path.point(), c = at + path.point(), d = at + path.point();
                for (int i = 0; i <= 64; ++i) {
                    const double t = i / 64.0, u = 1 - t;
                    box.add(u * u * u * at + 3 * u * u * t * b + 3 * u * t * t * c + t * t * t * d, reach);
                }
                at = d;
            } else if (command != 'z') {
                ADD_FAILURE() << "unexpected command " << command;
                return box;
            }
        }
    }
    return box;
}

/// Spaces beside and above the drawing of a pattern within its margins, in spacings.
glm::dvec2 slack_of(const PageKolam& kolam, double width, double height) {
    const Document document = parse("kolam", kolam.pattern.text);
    const std::string size = fmt::format("{}x{}mm", width, height);
    const Box ink = ink_of(draw(document, "svg", {{"size", size}}));
    EXPECT_GT(ink.low.x, margin - 0.01);
    EXPECT_GT(ink.low.y, margin - 0.01);
    return (glm::dvec2(width, height) - 2 * margin - ink.size()) / kolam.spacing;
}

PageKolam filled(const std::string& grid, double width, double height, const GridKolamOptions& options,
                 RimStyle rim = RimStyle::round) {
    KolamPatternOptions look;
    look.rim = rim;
    return make_page_kolam({*parse_fill(grid), glm::dvec2(width, height) - 2 * margin}, options, look, {});
}

TEST(PageKolam, FillsThirtyPages) {
    for (std::uint64_t page = 0; page < 30; ++page) {
        const double width = 150.0 + static_cast<double>(page * 137 % 900);
        const double height = 120.0 + static_cast<double>(page * 211 % 700);
        const std::uint64_t count = 3 + page % 6;
        const std::string side = width >= height ? fmt::format("{}xfill", count) : fmt::format("fillx{}", count);
        for (const auto& [grid, is_single] :
             {std::pair(side, false), {side, true}, {side + " idukku", false}, {side + " idukku", true}}) {
            SCOPED_TRACE(fmt::format("{} on {} x {} mm, single line: {}", grid, width, height, is_single));
            const PageKolam kolam = filled(grid, width, height, {.seed = page, .single_line = is_single});
            const glm::dvec2 slack = slack_of(kolam, width, height);
            EXPECT_LE(slack.x, 0.501);
            EXPECT_LE(slack.y, 0.501);
            EXPECT_NEAR(std::min(slack.x, slack.y), 0, 0.001);
            EXPECT_NEAR(std::max(slack.x, slack.y), kolam.slack, 0.02);
            EXPECT_TRUE(!is_single || kolam.kolam.lines == 1);
        }
    }
}

TEST(PageKolam, GrowsBothSidesByTheSpacing) {
    for (const char* grid : {"fill", "fill idukku"}) {
        for (const auto& [width, height] : {std::pair(420.0, 297.0), {297.0, 420.0}, {1200.0, 400.0}}) {
            const glm::dvec2 room = glm::dvec2(width, height) - 2 * margin;
            const PageKolam kolam = make_page_kolam({*parse_fill(grid), room, 30.0}, {.seed = 4}, {}, {});
            EXPECT_NEAR(kolam.spacing, 30, 2.5) << grid;
            const glm::dvec2 slack = slack_of(kolam, width, height);
            EXPECT_LE(std::max(slack.x, slack.y), 0.501) << grid << ' ' << width;
        }
    }
}

TEST(PageKolam, ChoosesTheNearestGridThatPermitsASymmetry) {
    // 4x12 is nearer, but has neither a dot nor a gap in its middle.
    const PageKolam kolam = filled("4xfill", 1200, 400, {.symmetry = GridSymmetry::c2, .single_line = true});
    EXPECT_EQ(kolam.grid.text(), "4x13");
    EXPECT_EQ(kolam.kolam.lines, 1u);
    EXPECT_TRUE(is_symmetric(kolam.grid, kolam.kolam.states, GridSymmetry::c2));
    EXPECT_TRUE(has(kolam.skipped, "no single line is possible on 4x12 with the symmetry C2")) << kolam.skipped;
    EXPECT_TRUE(has(error_of([] { filled("4xfill", 1200, 400, {.symmetry = GridSymmetry::c4}); }),
                    "no grid fills 1180 x 380 mm: 4x12 itself does not have the symmetry C4"));
    EXPECT_TRUE(has(error_of([] { filled("9xfill", 100, 3000, {}); }), "expected a number for the shorter side"));
}

TEST(PageKolam, RimsAndPeriodsFillPages) {
    for (const RimStyle rim : {RimStyle::petal, RimStyle::horn}) {
        const PageKolam kolam = filled("7xfill", 1200, 400, {.seed = 2, .period = 5, .single_line = true}, rim);
        const glm::dvec2 slack = slack_of(kolam, 1200, 400);
        EXPECT_LE(std::max(slack.x, slack.y), 0.501);
        EXPECT_EQ(kolam.kolam.lines, 1u);
    }
}

TEST(PageKolam, ReadsNotations) {
    const auto check = [](const char* text, DotRectangle expected) { EXPECT_EQ(parse_fill(text), expected) << text; };
    check("7xfill", {DotLattice::square, 7, 0});
    check("Fill x 7", {DotLattice::square, 0, 7});
    check("fill", {DotLattice::square, 0, 0});
    check("7×fill idukku pulli", {DotLattice::triangular, 7, 0});
    check("fill interlaced", {DotLattice::triangular, 0, 0});
    for (const char* text : {"7x7", "15-8 idukku", "text:FILL", "oo/oo"}) EXPECT_FALSE(parse_fill(text)) << text;
    for (const char* text :
         {"fillxfill", "7x7fill", "xfill", "0xfill", "fill-3", "7 to fill", "99999999999999fill"}) {
        EXPECT_TRUE(has(error_of([&] { parse_fill(text); }), "expected fill, ROWSxfill or fillxCOLUMNS")) << text;
    }
    EXPECT_TRUE(has(error_of([] { parse_dot_grid("7xfill"); }), "this grid needs a page to fill"));
    const PageFill tiny{{DotLattice::square, 0, 0}, {800, 1100}, 0.01};
    EXPECT_TRUE(has(error_of([&] { make_page_kolam(tiny, {}, {}, {}); }), "more than 4000000 dots"));
}

TEST(PageKolam, RectanglesAreRecognised) {
    for (const char* text : {"1x1", "7x22", "1x9", "9x1", "7x22 idukku", "2x2 idukku"}) {
        const auto rectangle = rectangle_of(parse_dot_grid(text));
        ASSERT_TRUE(rectangle) << text;
        EXPECT_EQ(dot_grid(*rectangle).text(), parse_dot_grid(text).text());
    }
    for (const char* text : {"1-3-5-3-1", "7-4 idukku", ".o./ooo/.o.", "2,1,2,3"}) {
        EXPECT_FALSE(rectangle_of(parse_dot_grid(text))) << text;
    }
}

// --- friezes
// --------------------------------------------------------------------------------------------------------

/// The lines of a kolam on straight dots as rays that bounce off mirrors, on a grid in which dots have odd places:
/// a gap turned back is a mirror across it, a joined one a mirror along it. Reads the digits of gaps only.
std::size_t traced_lines(int rows, int columns, const std::string& digits) {
    std::istringstream words(digits);
    std::vector<std::string> text(std::istream_iterator<std::string>(words), {});
    const auto state = [&](int x, int y) -> char {
        if (x == 0 || y == 0 || x == 2 * columns || y == 2 * rows) return '0';
        return text[static_cast<std::size_t>(y - 1)][static_cast<std::size_t>((x - 1) / 2)];
    };
    std::set<std::array<int, 4>> seen;  // place and way
    std::size_t loops = 0;
    for (int y = 0; y <= 2 * rows; ++y) {
        for (int x = 1 - y % 2; x <= 2 * columns; x += 2) {
            for (const auto& [dx, dy] : {std::pair(1, 1), {1, -1}, {-1, 1}, {-1, -1}}) {
                std::array<int, 4> at{x, y, dx, dy};
                const auto is_inside = [&] {
                    const int to_x = at[0] + at[2], to_y = at[1] + at[3];
                    return to_x >= 0 && to_y >= 0 && to_x <= 2 * columns && to_y <= 2 * rows;
                };
                if (!is_inside() || seen.contains(at)) continue;
                ++loops;
                while (seen.insert(at).second) {
                    at[0] += at[2];
                    at[1] += at[3];
                    const bool is_beside = at[0] % 2 == 0;  // a gap between dots beside each other
                    const char gap = state(at[0], at[1]);
                    if (gap == '0') at[is_beside ? 2 : 3] *= -1;
                    if (gap == '2') at[is_beside ? 3 : 2] *= -1;
                }
            }
        }
    }
    return loops / 2;  // each in both directions
}

TEST(Frieze, TheTracerCountsKnownLines) {
    const auto lines = [](const char* text, const char* gaps) {
        const DotGrid grid = parse_dot_grid(text);
        return traced_lines(static_cast<int>(grid.rows().size()), static_cast<int>(grid.rows()[0]),
                            gap_states_text(grid, parse_gap_states(grid, gaps)));
    };
    EXPECT_EQ(lines("4x6", "all"), 2u);  // the greatest common divisor
    EXPECT_EQ(lines("3x41", "all"), 1u);
    EXPECT_EQ(lines("3x4", "none"), 12u);
    EXPECT_EQ(lines("2x2", "2 2 2 2"), 2u);  // around all dots, and within
}

/// Expects digits to repeat, but for some at the ends of each word.
/// @param of_rows, between  digits of a period and of an end, in the words within rows and between them
void expect_repeats(const std::string& digits, std::pair<std::size_t, std::size_t> of_rows,
                    std::pair<std::size_t, std::size_t> between) {
    std::istringstream words(digits);
    std::string word;
    for (bool is_row = true; words >> word; is_row = !is_row) {
        const auto [period, end] = is_row ? of_rows : between;
        for (std::size_t i = end; i + period + end < word.size(); ++i) EXPECT_EQ(word[i], word[i + period]) << digits;
    }
}

TEST(Frieze, CopiesJoinToOneLine) {
    for (const auto& [rows, columns, period] :
         {std::tuple(1, 20, 3), {2, 17, 4}, {3, 41, 4}, {3, 40, 4}, {4, 40, 5}, {5, 31, 6}, {6, 30, 3}, {7, 60, 8}}) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            const DotGrid grid = parse_dot_grid(fmt::format("{}x{}", rows, columns));
            SCOPED_TRACE(fmt::format("{}, period {}, seed {}", grid.text(), period, seed));
            const GridKolamOptions options{.seed = seed,
                                           .joined = seed % 3 == 2 ? 0.3 : 0.0,
                                           .period = static_cast<std::uint32_t>(period),
                                           .single_line = true};
            const GridKolam made = make_grid_kolam(grid, options, {});
            const std::string digits = gap_states_text(grid, made.states);
            EXPECT_EQ(traced_lines(rows, columns, digits), 1u);
            const auto each = static_cast<std::size_t>(period);
            expect_repeats(digits, {each, 1}, {each, 1});
            const std::string text = kolam_pattern(grid, made.states).text;
            const KolamExamination examined = examine_kolam(reference::grammar_of(text), {.spline = true});
            EXPECT_EQ(examined.lines, 1u);
            EXPECT_TRUE(examined.is_kolam());
            EXPECT_EQ(examined.dots.size(), grid.dots().size());
        }
    }
}

TEST(Frieze, InterlacedCopiesJoin) {
    for (const auto& [rows, columns, period] : {std::tuple(2, 20, 3), {3, 25, 4}, {5, 41, 4}, {6, 30, 5}}) {
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            const DotGrid grid = parse_dot_grid(fmt::format("{}x{} idukku", rows, columns));
            SCOPED_TRACE(fmt::format("{}, period {}, seed {}", grid.text(), period, seed));
            const auto each = static_cast<std::uint32_t>(period);
            const GridKolam made = make_grid_kolam(grid, {.seed = seed, .period = each, .single_line = true}, {});
            EXPECT_EQ(laplacian_nullity(grid, made.states), 1u);
            expect_repeats(gap_states_text(grid, made.states), {each, 1}, {2 * each, 2});
        }
    }
}

TEST(Frieze, RepeatsWithoutException) {
    const DotGrid grid = parse_dot_grid("4x30");
    const GridKolam made = make_grid_kolam(grid, {.seed = 3, .period = 7}, {});
    expect_repeats(gap_states_text(grid, made.states), {7, 0}, {7, 0});
}

TEST(Frieze, SaysWhatIsImpossible) {
    const auto refusal = [](const char* grid, const GridKolamOptions& options) {
        return error_of([&] { make_grid_kolam(parse_dot_grid(grid), options, {}); });
    };
    EXPECT_TRUE(has(refusal("4x40", {.symmetry = GridSymmetry::c2, .period = 5, .single_line = true}),
                    "the grid needs a dot or a gap there, as in 7x7 and 6x7; possible on 4x39 and 4x41"));
    EXPECT_TRUE(has(refusal("6x6", {.symmetry = GridSymmetry::c4, .single_line = true}), "possible on 5x5 and 7x7"));
    EXPECT_TRUE(has(refusal("3x9", {.period = 9}), "nothing repeats; expected fewer than 9"));
}

}  // namespace sikku::page_kolam_test
