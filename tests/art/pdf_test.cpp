#include "art/vector/pdf.h"

#include "art/vector/svg.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <charconv>
#include <cmath>
#include <glm/vec3.hpp>
#include <map>
#include <random>
#include <sstream>

namespace sikku::pdf_test {

using namespace std::string_literals;
using Points = std::vector<glm::dvec2>;

class Pdf : public ::testing::Test {
protected:
    template <typename Draw>
    std::filesystem::path write(const Print& print, Draw&& draw, const std::string& name = "print.pdf") {
        const auto path = folder_ / name;
        write_print(path, print, write_pdf, draw);
        return path;
    }

    ScratchFolder folder_;
};

TEST_F(Pdf, IsSoundAndHasItsBoxes) {
    NEEDS("qpdf");
    NEEDS("pdfinfo");
    for (const bool empty : {false, true}) {
        Print print = plain_print();
        print.page = {210.0, 297.0, 10.0};
        if (empty) print.style.ground.reset();
        const auto path = write(print, [&](PathSink& sink) {
            if (!empty) draw_sampler(sink);
        });
        EXPECT_EQ(pdf_complaints(path), "");
        EXPECT_TRUE(contents(path).starts_with("%PDF-1.6\n"));
        const std::string boxes = run_tool("pdfinfo -box '" + path.string() + "'").text;
        for (const std::string name : {"MediaBox", "CropBox", "BleedBox", "TrimBox"}) {
            EXPECT_TRUE(has(boxes, name));
        }
        for (std::size_t at = boxes.find("Box:"); at != std::string::npos; at = boxes.find("Box:", at + 1)) {
            EXPECT_NE(boxes.find("0.00     0.00   595.28   841.89", at), std::string::npos) << boxes;
        }
    }
}

TEST_F(Pdf, SheetsBeyondTheLimitHaveALargerUnit) {
    NEEDS("qpdf");
    NEEDS("pdfinfo");
    Print print = plain_print();
    print.page = {12'000.0, 3'000.0, 10.0};
    const auto path = write(print, draw_sampler);
    EXPECT_EQ(pdf_complaints(path), "");
    const std::string text = contents(path);
    EXPECT_TRUE(has(text, "/UserUnit 3\n"));
    EXPECT_TRUE(has(text, "/MediaBox [0 0 11338.5827 2834.6457]"));
}

TEST_F(Pdf, PositionsAreWholeMicrometres) {
    NEEDS("qpdf");
    Print print = plain_print();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-20.0, 100.0);
    Points points;
    for (int i = 0; i < 30'000; ++i) points.emplace_back(anywhere(random), anywhere(random));
    const auto path = write(print, [&](PathSink& sink) {
        sink.begin_stroke(points.front(), Pen{});
        sink.lines(std::span<const glm::dvec2>(points).subspan(1, 14'999));
        sink.curves(std::span<const glm::dvec2>(points).subspan(15'000));
        sink.end_stroke(false);
    });
    EXPECT_EQ(pdf_complaints(path), "");
    const std::string text = plain_text(path);
    std::istringstream stream(text.substr(text.find(" cm 1 J 1 j")));
    Points drawn;
    std::vector<double> numbers;
    for (std::string word; stream >> word && word != "Q";) {
        double number = 0.0;
        if (std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc()) {
            numbers.push_back(number);
            continue;
        }
        // A long path is painted in pieces, each beginning where the last one ended.
        const bool goes_on = word == "m" && !drawn.empty();
        if (goes_on) {
            EXPECT_EQ(drawn.back(), (glm::dvec2(numbers.at(0), numbers.at(1))));
        } else if (word == "m" || word == "l" || word == "c") {
            for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) drawn.emplace_back(numbers[i], numbers[i + 1]);
        }
        numbers.clear();
    }
    ASSERT_EQ(drawn.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2 exact = print.placement.to_page * glm::dvec3(points[i], 1.0) * 1000.0;
        ASSERT_NEAR(drawn[i].x, exact.x, 0.5 + 1e-6) << i;
        ASSERT_NEAR(drawn[i].y, exact.y, 0.5 + 1e-6) << i;
    }
}

TEST_F(Pdf, LayersAreNamedAndInOrder) {
    NEEDS("qpdf");
    const std::string text = plain_text(write(plain_print(), draw_sampler));
    for (const std::string name : {"ground", "fills", "1 black", "2 red", "3 blue", "discs red", "discs blue"}) {
        EXPECT_TRUE(has(text, "/Name (" + name + ")")) << name;
    }
}

/// The polygons between the marks of each layer are those of its kind, and all keep their order.
TEST_F(Pdf, KindsOfTilesAreLayers) {
    NEEDS("qpdf");
    Print print = plain_print();
    print.names_tiles = true;
    print.style.fill.reset();
    const Points square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, hook = {{0, 0}, {3, 0}, {3, 1}, {0, 2}},
                 mirrored = {{0, 0}, {0, 2}, {-3, 1}, {-3, 0}};
    const auto draw = [&](PathSink& sink) {
        for (const int colour : {1, 1, 2, 1}) sink.polygon(square, Pen{1.0, false, colour});
        sink.polygon(hook, Pen{1.0, false, 1});
        sink.polygon(mirrored, Pen{1.0, false, 1});
        sink.polygon(square, Pen{1.0, false, 2});
    };
    const auto path = write(print, draw);
    EXPECT_EQ(pdf_complaints(path), "");
    const std::string text = plain_text(path);
    std::vector<std::string> groups;
    for (const std::string name : {"shape 1 red", "shape 1 blue", "shape 2 red", "shape 2 reflected red"}) {
        const std::size_t at = text.find("/Name (" + name + ")");
        ASSERT_NE(at, std::string::npos) << name;
        const std::size_t object = text.rfind(" 0 obj", at);
        groups.push_back(text.substr(text.rfind('\n', object) + 1, object - text.rfind('\n', object) - 1));
    }
    // qpdf renumbers objects but not names of resources; the properties translate.
    std::map<std::string, std::size_t> kind_of;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::size_t at = text.find(' ' + groups[i] + " 0 R", text.find("/Properties"));
        const std::size_t name = text.rfind("/G", at);
        kind_of[text.substr(name + 1, at - name - 1)] = i;
    }
    std::istringstream lines(text.substr(text.find("BDC\n", text.find(" cm 1 J 1 j") - 200)));
    std::vector<std::size_t> order;
    std::size_t kind = 99, open = 0;
    for (std::string line; std::getline(lines, line) && line != "Q";) {
        if (line.starts_with("/OC /G")) {
            kind = kind_of.at(line.substr(5, line.find(' ', 5) - 5));
            EXPECT_EQ(open++, 0U);
        } else if (line == "EMC") {
            EXPECT_EQ(open--, 1U);
        } else if (line == "f") {
            order.push_back(kind);
        }
    }
    EXPECT_EQ(open, 0U);
    EXPECT_EQ(order, (std::vector<std::size_t>{0, 0, 1, 0, 2, 3, 1}));
    // The picture is the same, and without the setting there are no such layers.
    print.names_tiles = false;
    EXPECT_FALSE(has(plain_text(write(print, draw, "plain-layers.pdf")), "/Name (shape"));
}

TEST_F(Pdf, WhatIsHiddenOfAClosedStrokeStaysHidden) {
    NEEDS("qpdf");
    Print print = plain_print();
    print.style.palette[0].alpha = 0;
    const Pen hidden;
    const Pen red{1.0, false, 1};
    const std::string three = plain_text(write(print, [&](PathSink& sink) { draw_square(sink, hidden, red); }));
    EXPECT_TRUE(has(three, "10000 10000 m\n50000 10000 l\n50000 50000 l\n10000 50000 l\nS"));
    const std::string four = plain_text(write(print, [&](PathSink& sink) { draw_square(sink, red, red); }));
    EXPECT_TRUE(has(four, "10000 50000 l\nh\nS"));
}

TEST_F(Pdf, TheSameDrawingIsTheSameBytes) {
    const std::string bytes = contents(write(plain_print(), draw_sampler));
    EXPECT_EQ(contents(write(plain_print(), draw_sampler)), bytes);
    EXPECT_FALSE(has(bytes, "Date"));
}

TEST_F(Pdf, TextsWithSpecialCharactersStayThemselves) {
    NEEDS("qpdf");
    NEEDS("pdfinfo");
    Print print = plain_print();
    for (const std::string title : {"(a) < b & c\\ )(", "கோலம் \xF0\x9F\x8C\xBC",
                                    "Schl\xC3\xBC"
                                    "ssel & \"q\""}) {
        print.title = title;
        print.made = "sikku 0.1.0, -n 4; " + title;
        const auto path = write(print, draw_sampler);
        EXPECT_EQ(pdf_complaints(path), "");
        const std::string information = run_tool("pdfinfo -enc UTF-8 '" + path.string() + "'").text;
        EXPECT_TRUE(has(information, title + "\n"));
        EXPECT_TRUE(has(information, print.made + "\n"));
        EXPECT_TRUE(has(information, "Sikku"));
    }
    print.title = "\x01\x7F broken \xC3 \xED\xA0\x80 \xF8 \0."s;
    EXPECT_EQ(pdf_complaints(write(print, draw_sampler)), "");
}

TEST_F(Pdf, OthersDrawItAsItIsMeant) {
    NEEDS("qpdf");
    NEEDS("pdftoppm");
    Print print = plain_print();
    print.style.palette[2].alpha = 128;
    const auto path = write(print, [](PathSink& sink) {
        draw_sampler(sink);
        Pen blue{.colour = 2};
        sink.begin_stroke({55, 40}, blue);
        sink.lines(Points{{85, 40}});
        sink.end_stroke(false);
    });
    EXPECT_EQ(pdf_complaints(path), "");
    const PixelGrid pixels = render_pdf(path, 254);  // 10 pixels a millimetre
    ASSERT_NEAR(pixels.width, 1000, 1);
    ASSERT_NEAR(pixels.height, 600, 1);
    const Colour white{255, 255, 255, 255};
    const Colour red{255, 0, 0, 255};
    const Colour black{0, 0, 0, 255};
    const Colour half_blue{127, 127, 255, 255};
    EXPECT_TRUE(near(pixels.at(5, 5), white));
    EXPECT_TRUE(near(pixels.at(105, 100), black)) << "a dot from a line without length";
    EXPECT_TRUE(near(pixels.at(700, 500), red)) << "a line";
    EXPECT_TRUE(near(pixels.at(700, 492), red)) << "of its width";
    EXPECT_TRUE(near(pixels.at(700, 488), white));
    EXPECT_TRUE(near(pixels.at(895, 300), black)) << "the same with another pen";
    EXPECT_TRUE(near(pixels.at(350, 400), red)) << "the later polygon is on top";
    EXPECT_TRUE(near(pixels.at(250, 400), half_blue)) << "the earlier one";
    EXPECT_TRUE(near(pixels.at(218, 100), red)) << "a dot of twice the line's width";
    EXPECT_TRUE(near(pixels.at(222, 100), white));
    for (int x = 560; x < 850; x += 3) ASSERT_TRUE(near(pixels.at(x, 200), half_blue)) << x;
}

TEST_F(Pdf, LooksLikeTheSvg) {
    NEEDS("rsvg-convert");
    NEEDS("pdftoppm");
    std::mt19937 random(4);
    std::uniform_real_distribution<double> anywhere(5.0, 55.0);
    Points points;
    for (int i = 0; i < 31; ++i) points.emplace_back(anywhere(random) * 1.6, anywhere(random));
    Print print = plain_print();
    print.style.stroke = {1.0, false};
    print.style.palette = {Colour{20, 60, 120, 200}, Colour{200, 30, 30, 255}, Colour{30, 160, 60, 100}};
    const auto draw = [&](PathSink& sink) {
        draw_sampler(sink);
        sink.polygon(std::span<const glm::dvec2>(points).first(9), Pen{1.0, false, 2});
        sink.begin_stroke(points.front(), Pen{});
        sink.curves(std::span<const glm::dvec2>(points).subspan(1));
        sink.end_stroke(false);
    };
    const auto pdf = write(print, draw);
    const auto svg = folder_ / "print.svg";
    write_print(svg, print, write_svg, draw);
    const auto from_svg = folder_ / "svg.pdf";
    ASSERT_TRUE(run_tool("rsvg-convert -f pdf -o '" + from_svg.string() + "' '" + svg.string() + "'").ok);
    const PixelGrid one = render_pdf(pdf, 150);
    const PixelGrid other = render_pdf(from_svg, 150);
    ASSERT_EQ(one.width, other.width);
    ASSERT_EQ(one.height, other.height);
    double difference = 0.0;
    double ink = 0.0;
    for (std::size_t i = 0; i < one.bytes.size(); ++i) {
        const int a = static_cast<unsigned char>(one.bytes[i]);
        difference += std::abs(a - static_cast<unsigned char>(other.bytes.at(i)));
        ink += 255 - a;
    }
    EXPECT_LT(difference, 0.02 * ink);
}

}  // namespace sikku::pdf_test
