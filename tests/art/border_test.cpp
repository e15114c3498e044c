// Borders: closed, symmetric, within their band, in whole repeats.
#include "art/print/border.h"

#include "art/kolam/dot_grid_pattern.h"
#include "art/prints.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace sikku::border_test {

/// Collects all points in millimetres, and checks that closed strokes end where they began.
class Points : public PathSink {
public:
    void begin_stroke(glm::dvec2 start, const Pen&) override {
        ++strokes;
        first_ = last_ = start;
        add(start);
    }
    void lines(std::span<const glm::dvec2> ends) override {
        for (const glm::dvec2 end : ends) add(end);
    }
    void curves(std::span<const glm::dvec2> controls) override {
        for (std::size_t i = 2; i < controls.size(); i += 3) add(controls[i]);
    }
    void change_pen(const Pen&) override {}
    void end_stroke(bool is_closed) override {
        if (!is_closed) return;
        ++closed;
        EXPECT_LT(glm::length(last_ - first_), 1e-6);
    }
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
        for (const glm::dvec2 vertex : vertices) add(vertex);
    }
    void area(std::span<const glm::dvec2> outline, const Pen&) override {
        for (std::size_t i = 0; i < outline.size(); i += 3) add(outline[i]);
    }
    void disc(glm::dvec2 centre, double, const Pen&) override {
        ++discs;
        add(centre);
    }

    std::vector<glm::dvec2> all;
    int strokes = 0, closed = 0, discs = 0;

private:
    void add(glm::dvec2 point) {
        all.push_back(point);
        last_ = point;
    }
    glm::dvec2 first_{0.0}, last_{0.0};
};

const std::vector<BorderKind> kinds = {BorderKind::kaavi,     BorderKind::padi,     BorderKind::lotus,
                                       BorderKind::rope,      BorderKind::diamonds, BorderKind::waves,
                                       BorderKind::marigolds, BorderKind::lamps};
const std::vector<Page> pages = {{210, 297, 10}, {594, 841, 20}, {300, 300, 10}, {297, 210, 0}, {500, 150, 12}};

Points drawn(BorderKind kind, const Page& page) {
    Print print;
    print.page = page;
    print.placement.to_page[1].y = -1.0;
    Points points;
    draw_border({kind}, print, {0, 0, page.width, page.height, false, page.margin}, 0, points);
    return points;
}

TEST(Borders, LieInTheirBand) {
    for (const Page& page : pages) {
        for (const BorderKind kind : kinds) {
            SCOPED_TRACE(static_cast<int>(kind));
            const double depth = border_depth({kind}, page);
            const Points points = drawn(kind, page);
            EXPECT_GT(points.all.size(), 20u);
            for (const glm::dvec2 point : points.all) {
                const glm::dvec2 at(point.x, -point.y);
                const double inset = std::min({at.x, at.y, page.width - at.x, page.height - at.y}) - page.margin;
                EXPECT_GE(inset, -1e-9);
                EXPECT_LE(inset, depth + 1e-9);
            }
            EXPECT_GT(border_room({kind}, page), depth);
        }
    }
}

TEST(Borders, WeighMoreAroundBoldLines) {
    for (const Page& page : pages) {
        const double usual = 0.25 * std::min(page.width, page.height) / 24;
        EXPECT_NEAR(border_weight(page, usual), 1, 1e-12);
        EXPECT_EQ(border_weight(page, 0.5 * usual), 1);
        EXPECT_NEAR(border_weight(page, 1.21 * usual), 1.1, 1e-12);
        EXPECT_EQ(border_weight(page, 0), 0.8);
        EXPECT_EQ(border_weight(page, 100 * usual), 1.25);
    }
    // The line of red earth in prints, by the groups of the SVG.
    const auto width_of = [](const std::string& stroke, const char* grid) {
        const DotGrid dots = parse_dot_grid(grid);
        std::string text = kolam_pattern(dots, parse_gap_states(dots, "all")).text;
        text.replace(text.find("0.16 step"), 9, stroke);
        const std::string svg = draw(parse("kolam", text), "svg", {{"border", "kaavi"}, {"size", "A3"}});
        std::smatch found;
        const std::regex group("stroke=\"#(?!fffaf0)[0-9a-f]{6}\" stroke-width=\"([0-9.]+)\"");
        return std::regex_search(svg, found, group) ? std::stod(found[1].str()) : 0.0;
    };
    const double usual = width_of("0.3mm", "5x5");
    EXPECT_GT(usual, 0);
    EXPECT_NEAR(width_of("0.3mm", "31x31"), usual, 1);
    EXPECT_NEAR(width_of("0.16 step", "3x3"), 1.25 * usual, 1);
    EXPECT_NEAR(width_of("0.16 step", "41x41"), 0.8 * usual, 1);
}

/// Half a turn of the page changes nothing.
TEST(Borders, LookTheSameUpsideDown) {
    for (const Page& page : pages) {
        for (const BorderKind kind : kinds) {
            SCOPED_TRACE(static_cast<int>(kind));
            const Points points = drawn(kind, page);
            for (const glm::dvec2 point : points.all) {
                const glm::dvec2 turned(page.width - point.x, -page.height - point.y);
                const bool is_there = std::any_of(points.all.begin(), points.all.end(), [&](glm::dvec2 other) {
                    return glm::length(other - turned) < 1e-3 * page.width;
                });
                EXPECT_TRUE(is_there) << point.x << " " << point.y;
            }
        }
    }
}

TEST(Borders, RepeatsAreWholeAndNearlyAlike) {
    for (double across = 100; across < 1000; across += 37) {
        for (double down = across; down < 2 * across; down += 41) {
            for (const double length : {6.0, 10.0}) {
                const BorderRepeats repeats = border_repeats(across, down, length);
                const double x = across / repeats.across, y = down / repeats.down;
                EXPECT_NEAR(x / y, 1, 0.03) << across << " " << down;
                EXPECT_NEAR(x / length, 1, 0.16);
            }
        }
    }
    EXPECT_EQ(border_repeats(1, 1, 100).across, 1);
}

/// Each strand of a rope passes over the other as often as under it, and there is a dot in every loop.
TEST(Borders, RopesAlternate) {
    const Points rope = drawn(BorderKind::rope, {210, 297, 10});
    EXPECT_EQ(rope.strokes, rope.discs);
    EXPECT_EQ(rope.strokes % 4, 0);
    EXPECT_EQ(rope.closed, 0);
}

TEST(Borders, OfPatternFilesAreRepeatsOfTheirDrawing) {
    const ScratchFolder folder;
    std::ofstream(folder.file("tooth.lsys")) << "axiom: +F--F\nangle increment: 45\nstroke: 0.1 step navy\n";
    std::ofstream(folder.file("corner.lsys")) << "axiom: F+F+F+F\nangle increment: 90\nstroke: 0.1 step red\n";
    const auto made = [&](const std::string& key) {
        const Document document = parse(folder.file("a.lsys"), "axiom: F\n" + key);
        MemoryDestination memory;
        prints().plan(document, "svg", {{"size", "100x150mm"}}, folder.path())->make(memory, "a.svg", {});
        return std::string(memory.outputs().at("a.svg"));
    };
    // Lines that the ground would hide get a colour that is seen.
    EXPECT_TRUE(has(made("border: tooth.lsys\n"), "#000080"));
    EXPECT_FALSE(has(made("border: tooth.lsys\nground: navy\nstroke: white\n"), "stroke=\"#000080\""));
    const std::string plain = made("");
    const std::string teeth = made("border: tooth.lsys\n");
    const std::string both = made("border: tooth.lsys, corner.lsys\n");
    EXPECT_GT(count_of(teeth, "<path"), count_of(plain, "<path") + 20);
    EXPECT_EQ(count_of(teeth, "<circle"), 4u);  // of corners without a pattern
    EXPECT_EQ(count_of(both, "<circle"), 0u);
    EXPECT_TRUE(has(both, "#ff0000"));
    EXPECT_FALSE(has(teeth, "#ff0000"));
    for (const char* bad : {"border: none.lsys\n", "border: no-such-pattern\n", "border: a b, c, d\n", "border:\n"}) {
        EXPECT_ANY_THROW(made(bad)) << bad;
    }
    EXPECT_FALSE(has(made("border: none\n"), "#b3452c"));
    EXPECT_EQ(count_of(made("border: none\n"), "<path"), count_of(plain, "<path"));
}

}  // namespace sikku::border_test
