// tests/art/lesson_test.cpp: drawing lessons: their steps, pages, animations and pictures.
#include "art/motion/lesson.h"
#include "art/drawing/drawing.h"
#include "art/drawing/lesson_drawing.h"
#include "art/hand/hand_line.h"
#include "art/prints.h"
#include "art/writer/draw_options.h"
#include "art/writer/make_drawing.h"
#include "engine/derivation/derivation.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace sikku::lesson_test {

const std::string snake =
    "title: Snake\naxiom: f+Xf+f+Xf\nX --> Xf-f-f+Xf+f+Xf-f-f+X\nderivation length: 2\nangle factor: 4\n"
    "ground: #8c3b2a\nstroke: 0.22 step #fffaf0\nline: spline\n";
const std::string rings =
    "title: Rings\naxiom: [F+F+F+F]ffff[F+F+F+F]ffff[F+F+F+F]\nangle factor: 4\nstroke: 0.1 step black\n";

class Lesson : public ::testing::Test {
protected:
    /// @throws SettingError
    std::map<std::string, std::string> make(const std::string& pattern, const std::string& format,
                                            OptionValues values = {}) const {
        values.push_back({"lesson", "3"});
        values.push_back({"size", "120x120mm"});
        if (format == "png" || format == "gif") values.push_back({"dpi", "60"});
        MemoryDestination memory;
        const Document document = parse("lesson.lsys", pattern);
        remarks_ = prints().plan(document, format, values)->make(memory, "lesson." + format, {}).remarks;
        return memory.outputs();
    }
    ScratchFolder folder_;
    mutable std::vector<Remark> remarks_;
};

/// The snake of 2 steps is its own image under quarter turns: its steps are equal, and 4 of them or a multiple.
TEST_F(Lesson, CutsALineIntoEqualParts) {
    const Document document = parse("snake.lsys", snake);
    DrawOptions options;
    options.lesson_step = 0;
    Diagnostics diagnostics;
    Print print;
    print.style = read_style(document.pattern(), 96, diagnostics);
    const auto drawing = make_drawing(document.grammar(), print.style, options);
    drawing->place(print);
    print.style = drawing->style();
    auto& lesson = dynamic_cast<LessonDrawing&>(*drawing);
    const std::size_t count = lesson.count(print) - 2;
    EXPECT_GE(count, 4u);
    EXPECT_EQ(count % 4, 0u);
}

TEST_F(Lesson, StretchesCoverEachLineOnce) {
    std::vector<HandLine> lines;
    for (std::uint64_t number = 0; number < 60; ++number) {
        HandLine& line = lines.emplace_back();
        line.number = number;
        line.closed = number % 2 == 0;
        line.loop = 1;
        const double length = 1.0 + 2 * static_cast<double>(number);
        for (double along = 0; along <= length; along += 0.25) {
            line.nodes.push_back({{along, static_cast<double>(number)}, along, 0.1});
        }
        line.length = line.nodes.back().along + (line.closed ? 0.25 : 0);
    }
    for (const std::size_t used : {1u, 3u, 60u}) {
        const std::vector<HandLine> some(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(used));
        const auto steps = lesson_steps(some);
        EXPECT_LE(steps.size(), most_lesson_steps);
        std::vector<std::size_t> reached(used, 0);
        for (const LessonStep& step : steps) {
            EXPECT_FALSE(step.empty());
            for (const Stretch& stretch : step) {
                EXPECT_EQ(stretch.from, reached[stretch.line]);
                EXPECT_GT(stretch.to, stretch.from);
                reached[stretch.line] = stretch.to;
            }
        }
        for (std::size_t i = 0; i < used; ++i) EXPECT_EQ(reached[i], some[i].size() - (some[i].closed ? 0 : 1));
    }
}

TEST_F(Lesson, PdfHasAPageForEachStep) {
    NEEDS("pdfinfo");
    NEEDS("pdftoppm");
    NEEDS("qpdf");
    const std::string pdf = folder_.write("lesson.pdf", make(snake, "pdf").at("lesson.pdf"));
    EXPECT_TRUE(run_tool("qpdf --check '" + pdf + "'").ok);
    const std::string info = run_tool("pdfinfo '" + pdf + "'").text;
    const int pages = std::stoi(info.substr(info.find("Pages:") + 6));
    EXPECT_GE(pages, 6);
    ASSERT_TRUE(run_tool("pdftoppm -r 40 '" + pdf + "' '" + pdf + ".p'").ok);
    std::vector<PixelGrid> grids;
    for (int page = 1; page <= pages; ++page) {
        const std::string digits = std::to_string(page);
        grids.push_back(read_ppm(pdf + ".p-" + (pages > 9 && page < 10 ? "0" : "") + digits + ".ppm"));
    }
    const auto bright = [](const PixelGrid& grid) {
        std::size_t pixels = 0;
        for (int y = 0; y < grid.height; ++y) {
            for (int x = 0; x < grid.width; ++x) pixels += grid.at(x, y).green > 200;
        }
        return pixels;
    };
    // Dots, then one strong stretch each, then the whole.
    std::size_t together = 0;
    for (int page = 1; page + 1 < pages; ++page) {
        EXPECT_GT(bright(grids[static_cast<std::size_t>(page)]), bright(grids[0]));
        together += bright(grids[static_cast<std::size_t>(page)]) - bright(grids[0]);
    }
    const std::size_t whole = bright(grids.back()) - bright(grids[0]);
    EXPECT_GT(together, whole * 6 / 10);
    EXPECT_LT(together, whole * 14 / 10);
}

TEST_F(Lesson, SvgShowsOneStepAfterTheOther) {
    NEEDS("xmllint");
    NEEDS("rsvg-convert");
    const std::string svg = make(snake, "svg").at("lesson.svg");
    const std::string file = folder_.write("lesson.svg", svg);
    EXPECT_TRUE(run_tool("xmllint --noout '" + file + "'").ok);
    EXPECT_TRUE(run_tool("rsvg-convert '" + file + "' -o '" + file + ".png'").ok);
    const std::size_t steps = count_of(svg, "class=\"s\"");
    EXPECT_GE(steps, 5u);
    EXPECT_EQ(count_of(svg, "class=\"w\""), 1u);
    EXPECT_EQ(count_of(svg, "class=\"n\""), steps - 1);  // all but the dots
    EXPECT_TRUE(has(svg, "--step: 3s; --drawing: 2s"));
}

TEST_F(Lesson, GifAndPicturesHaveAllSteps) {
    const std::string gif = make(snake, "gif").at("lesson.gif");
    EXPECT_EQ(gif.substr(0, 4), "GIF8");
    EXPECT_GT(count_of(gif, "\x21\xF9\x04"), 20u);
    const std::string png = make(snake, "png").at("lesson.png");
    EXPECT_GT(png.size(), 2000u);
    EXPECT_EQ(make(snake, "gif").at("lesson.gif"), gif);
    EXPECT_EQ(make(snake, "png").at("lesson.png"), png);
}

TEST_F(Lesson, WithoutDotsItBeginsWithTheFirstStroke) {
    const std::string open = "title: Zigzag\naxiom: F+F-F+F-F\nangle factor: 4\n";
    const std::string svg = make(open, "svg").at("lesson.svg");
    ASSERT_EQ(remarks_.size(), 1u);
    EXPECT_EQ(count_of(svg, "class=\"s\""), count_of(svg, "class=\"n\""));
}

TEST_F(Lesson, NumbersAreUprightInAMirror) {
    // Equal signs, so equal letters: the paths of numbers are the same but for where they begin.
    const std::string plain = make(rings, "svg").at("lesson.svg");
    const std::string mirrored = make(rings, "svg", {{"mirror", "true"}}).at("lesson.svg");
    EXPECT_NE(plain, mirrored);
    const auto captions = [](const std::string& svg) {
        // The relative part of each path in the layer of signs.
        std::multiset<std::string> paths;
        for (std::size_t at = 0; (at = svg.find(" d=\"M", at)) != std::string::npos; ++at) {
            const std::size_t end = svg.find('"', at + 4);
            const std::size_t relative = svg.find_first_of("lchv", at + 4);
            if (relative < end && end - relative < 400) paths.insert(svg.substr(relative, end - relative));
        }
        return paths;
    };
    const auto a = captions(plain), b = captions(mirrored);
    std::vector<std::string> common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    EXPECT_GT(common.size(), 0u);
}

TEST_F(Lesson, ByHandItIsTheSameLine) {
    const std::string svg = make(snake + "hand: 0.5\n", "svg").at("lesson.svg");
    EXPECT_GT(count_of(svg, "class=\"n\""), 3u);
    EXPECT_NE(svg, make(snake, "svg").at("lesson.svg"));
}

TEST_F(Lesson, RefusesDrawingsThatAreTooLarge) {
    const auto error_of = [&](const std::string& pattern, OptionValues values) -> std::string {
        return sikku::error_of<BudgetError>([&] { make(pattern, "pdf", std::move(values)); });
    };
    EXPECT_TRUE(has(error_of(rings, {{"repeat", "p1:40x40"}}), "a lesson has at most 1000 lines"));
    EXPECT_TRUE(has(error_of("axiom: F\nF --> F+F--F+F\nangle factor: 6\nderivation length: 8\n", {}),
                    "the lines of this lesson take more than 100000 points"));
    EXPECT_EQ(error_of(rings, {{"repeat", "p1:3x3"}}), "");
}

TEST_F(Lesson, PlansItsStrokesOnce) {
    LessonMemo memo;
    int made = 0;
    const auto make_plan = [&] {
        ++made;
        return LessonPlan{};
    };
    const auto plan = memo.plan(2, 0.4, make_plan);
    EXPECT_EQ(memo.plan(2, 0.4, make_plan), plan);
    EXPECT_EQ(made, 1);
    EXPECT_NE(memo.plan(3, 0.4, make_plan), plan);
    EXPECT_EQ(made, 2);
}

/// A picture has ten strokes at most, besides the dots and the whole; those of a page are the same for all formats.
TEST_F(Lesson, JoinsStepsForPictures) {
    std::vector<HandLine> lines(60);
    for (HandLine& line : lines) {
        line.nodes = {{{0, 0}, 0, 0.1}, {{1, 0}, 1, 0.1}};
        line.length = 1;
    }
    EXPECT_EQ(lesson_steps(lines).size(), most_lesson_steps);
    EXPECT_EQ(lesson_steps(lines, most_lesson_cells).size(), most_lesson_cells);
}

TEST_F(Lesson, FieldsComeWithTheWhole) {
    const std::string svg = make(rings, "svg", {{"fields", "kind"}, {"powders", "#123456"}}).at("lesson.svg");
    EXPECT_GT(svg.find("fill=\"#123456\""), svg.rfind("class=\"s\""));
    EXPECT_TRUE(has(svg, "fill=\"#123456\""));
}

TEST_F(Lesson, RefusesWhatHasNoSteps) {
    EXPECT_THROW(make(snake, "hpgl"), SettingError);
    EXPECT_THROW(make(snake, "svg", {{"plotter", "true"}}), SettingError);
    EXPECT_THROW(make(snake, "pdf", {{"tile", "A4"}}), SettingError);
    EXPECT_THROW(make(snake, "gif", {{"generations", "0:2"}}), SettingError);
    EXPECT_THROW(make(snake, "svg", {{"border", "kaavi"}}), SettingError);
    EXPECT_THROW(make("axiom: F&F\n", "svg"), SettingError);
    EXPECT_THROW(make(snake, "glb"), SettingError);
}

}  // namespace sikku::lesson_test
