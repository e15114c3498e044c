#include "art/vector/svg.h"

#include "tests/checks.h"
#include "tests/print_tools.h"

#include <sys/stat.h>

#include <charconv>
#include <cmath>
#include <glm/vec3.hpp>
#include <pugixml.hpp>
#include <random>
#include <thread>

namespace sikku::svg_test {

using namespace std::string_literals;
using Points = std::vector<glm::dvec2>;

/// The points of path data, in its units; every M or m begins a new list. Closing is noted.
struct Subpath {
    Points points;
    bool closed = false;
};
std::vector<Subpath> read_path(std::string_view text) {
    std::vector<Subpath> result;
    char command = 0;
    std::size_t at = 0;
    const auto number = [&] {
        while (at < text.size() && (text[at] == ' ' || text[at] == ',')) ++at;
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
        if (error != std::errc()) throw std::runtime_error("no number at " + std::string(text.substr(at, 20)));
        at = static_cast<std::size_t>(end - text.data());
        return value;
    };
    while (at < text.size()) {
        if (std::isalpha(static_cast<unsigned char>(text[at]))) command = text[at++];
        if (command == 'z') {
            result.back().closed = true;
            continue;
        }
        const glm::dvec2 here = result.empty() ? glm::dvec2(0.0) : result.back().points.back();
        if (command == 'M' || command == 'm') {
            const double x = number();
            const double y = number();
            const bool from_start = command == 'm' && result.back().closed;
            const glm::dvec2 origin = command == 'M' ? glm::dvec2(0.0)
                                      : from_start   ? result.back().points.front()
                                                     : here;
            result.push_back({{origin + glm::dvec2(x, y)}, false});
        } else if (command == 'h') {
            result.back().points.push_back(here + glm::dvec2(number(), 0.0));
        } else if (command == 'v') {
            result.back().points.push_back(here + glm::dvec2(0.0, number()));
        } else if (command == 'l' || command == 'c') {
            for (int i = 0; i < (command == 'l' ? 1 : 3); ++i) {
                const double x = number();
                const double y = number();
                result.back().points.push_back(here + glm::dvec2(x, y));
            }
        } else {
            throw std::runtime_error("unknown command");
        }
    }
    return result;
}

class Svg : public ::testing::Test {
protected:
    template <typename Draw>
    std::filesystem::path write(const Print& print, Draw&& draw, const std::string& name = "print.svg") {
        const auto path = folder_ / name;
        write_print(path, print, write_svg, draw);
        return path;
    }

    template <typename Draw>
    pugi::xml_node parse(const Print& print, Draw&& draw) {
        const auto path = write(print, draw);
        const auto result = document_.load_file(path.c_str(), pugi::parse_default | pugi::parse_ws_pcdata_single);
        EXPECT_TRUE(result) << result.description();
        return document_.document_element();
    }

    static std::vector<pugi::xml_node> paths(const pugi::xml_node& root) {
        std::vector<pugi::xml_node> list;
        for (const auto& found : root.select_nodes("//path")) list.push_back(found.node());
        return list;
    }

    static std::vector<std::string> labels(const pugi::xml_node& root) {
        std::vector<std::string> list;
        for (const pugi::xml_node group : root.children("g")) {
            EXPECT_STREQ(group.attribute("inkscape:groupmode").value(), "layer");
            list.emplace_back(group.attribute("inkscape:label").value());
        }
        return list;
    }

    ScratchFolder folder_;
    pugi::xml_document document_;
};

TEST_F(Svg, ThePageIsInMillimetres) {
    Print print = plain_print();
    print.page.width = 215.9;
    print.page.height = 8.5 * 25.4 * 1.5;
    const auto root = parse(print, [](PathSink&) {});
    EXPECT_STREQ(root.attribute("width").value(), "215.9mm");
    EXPECT_STREQ(root.attribute("height").value(), "323.85mm");
    EXPECT_STREQ(root.attribute("viewBox").value(), "0 0 215.9 323.85");
    EXPECT_EQ(labels(root), std::vector<std::string>{"ground"});
    print.style.ground.reset();
    EXPECT_FALSE(parse(print, [](PathSink&) {}).child("g"));
}

TEST_F(Svg, PositionsAreRoundedOnceAndDoNotDrift) {
    Print print = plain_print();
    Box box;
    box.add({-7.0, -3.0});
    box.add({11.0, 5.0});
    PlacementOptions options;
    options.rotate = 17.0;
    print.placement = place(box, print.page, options, 0.0, 0.4);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-3.0, 3.0);
    Points lines = {{0.0, 0.0}};
    for (int i = 0; i < 20'000; ++i) {
        // Every third keeps a coordinate, so that h and v are used as well once rotated by quarter turns.
        const glm::dvec2 last = lines.back();
        lines.emplace_back(i % 3 == 1 ? last.x : anywhere(random), i % 3 == 2 ? last.y : anywhere(random));
    }
    Points controls;
    for (int i = 0; i < 9'000; ++i) controls.emplace_back(anywhere(random), anywhere(random));
    for (const double rotate : {17.0, 90.0}) {
        options.rotate = rotate;
        print.placement = place(box, print.page, options, 0.0, 0.4);
        const auto root = parse(print, [&](PathSink& sink) {
            sink.begin_stroke(lines.front(), Pen{});
            sink.lines(std::span<const glm::dvec2>(lines).subspan(1, 7));
            sink.lines(std::span<const glm::dvec2>(lines).subspan(8));
            sink.end_stroke(false);
            sink.begin_stroke(lines.front(), Pen{});
            sink.curves(controls);
            sink.end_stroke(false);
        });
        ASSERT_EQ(paths(root).size(), 2u);
        // Where two points round to one, one is drawn.
        const auto rounded = [&](glm::dvec2 point) {
            const glm::dvec2 exact = print.placement.to_page * glm::dvec3(point, 1.0) * 1000.0;
            return glm::dvec2(std::nearbyint(exact.x), std::nearbyint(exact.y));
        };
        Points expected_lines;
        for (const glm::dvec2 point : lines) {
            if (expected_lines.empty() || rounded(point) != rounded(expected_lines.back())) {
                expected_lines.push_back(point);
            }
        }
        Points expected_curves = {lines.front()};
        expected_curves.insert(expected_curves.end(), controls.begin(), controls.end());
        for (const auto& [node, expected] :
             {std::pair{paths(root)[0], expected_lines}, std::pair{paths(root)[1], expected_curves}}) {
            const auto subpaths = read_path(node.attribute("d").value());
            ASSERT_EQ(subpaths.size(), 1u);
            ASSERT_EQ(subpaths[0].points.size(), expected.size());
            double worst = 0.0;
            for (std::size_t i = 0; i < expected.size(); ++i) {
                const glm::dvec2 exact = print.placement.to_page * glm::dvec3(expected[i], 1.0) * 1000.0;
                const glm::dvec2 error = subpaths[0].points[i] - exact;
                worst = std::max({worst, std::abs(error.x), std::abs(error.y)});
            }
            EXPECT_LE(worst, 0.5 + 1e-6);
            EXPECT_GT(worst, 0.4);
        }
    }
}

TEST_F(Svg, EveryNumberOfDigitsIsWrittenRight) {
    Print print = plain_print();
    print.placement.to_page = glm::dmat3x2(0.001, 0.0, 0.0, 0.001, 0.0, 0.0);  // steps are micrometres
    Points points;
    for (double magnitude = 1.0; magnitude < 2e9; magnitude *= 10.0) {
        for (const double factor : {1.0, 1.01, 5.0, 9.99}) {
            if (magnitude * factor > 1e9) continue;
            points.emplace_back(std::round(magnitude * factor), -std::round(magnitude * factor));
            points.emplace_back(-std::round(magnitude), std::round(magnitude / 7.0));
        }
    }
    const auto root = parse(print, [&](PathSink& sink) {
        sink.begin_stroke({0.0, 0.0}, Pen{});
        sink.lines(points);
        sink.end_stroke(false);
    });
    const auto subpaths = read_path(paths(root).at(0).attribute("d").value());
    Points drawn(subpaths.at(0).points.begin() + 1, subpaths[0].points.end());
    Points expected;
    for (const glm::dvec2 point : points) {
        if (expected.empty() ? point != glm::dvec2(0.0) : point != expected.back()) expected.push_back(point);
    }
    EXPECT_EQ(drawn, expected);
}

TEST_F(Svg, WhatIsFarOutsideIsHeldWithinAKilometre) {
    const auto root = parse(plain_print(), [](PathSink& sink) {
        sink.begin_stroke({0.0, 0.0}, Pen{});
        sink.lines(Points{{1e300, -1e300}, {5.0, 1e300}, {std::nan(""), 1.0}, {-1e15, 3.0}});
        sink.end_stroke(false);
    });
    const auto points = read_path(paths(root).at(0).attribute("d").value()).at(0).points;
    EXPECT_EQ(points, (Points{{0, 60000}, {1e9, 1e9}, {5000, -1e9}, {0, 0}, {-1e9, 57000}}));
}

TEST_F(Svg, LayersStandInOrderWhateverCameFirst) {
    const auto root = parse(plain_print(), draw_sampler);
    EXPECT_EQ(labels(root),
              (std::vector<std::string>{"ground", "fills", "1 black", "2 red", "3 blue", "discs red", "discs blue"}));
    const auto fills = root.select_nodes("g[2]/g");
    ASSERT_EQ(fills.size(), 2u);
    EXPECT_STREQ(fills[0].node().attribute("fill").value(), "#0000ff");
    EXPECT_STREQ(fills[1].node().attribute("fill").value(), "#ff0000");
    EXPECT_STREQ(fills[0].node().child("path").attribute("d").value(), "M20000 55000h20000v-20000h-20000z");
    const auto black = root.select_node("g[3]").node();
    EXPECT_STREQ(black.attribute("stroke").value(), "#000000");
    EXPECT_STREQ(black.attribute("stroke-width").value(), "2000");
    EXPECT_STREQ(black.attribute("stroke-linecap").value(), "round");
    EXPECT_STREQ(black.attribute("stroke-linejoin").value(), "round");
    EXPECT_STREQ(black.attribute("fill").value(), "none");
    EXPECT_STREQ(black.attribute("transform").value(), "scale(0.001)");
    // The stroke goes on where its red part ended; a line without length is a dot.
    EXPECT_STREQ(black.select_node("path[1]").node().attribute("d").value(), "M90000 50000v-40000");
    EXPECT_STREQ(black.select_node("path[2]").node().attribute("d").value(), "M10000 10000h0");
    EXPECT_STREQ(root.select_node("g[4]/path").node().attribute("d").value(), "M10000 50000h80000");
    EXPECT_STREQ(root.select_node("g[5]/path").node().attribute("d").value(),
                 "M60000 30000c0-15000 20000-15000 20000 0 0 15000-20000 15000-20000 0z");
    const auto dots = root.select_nodes("g/circle");
    ASSERT_EQ(dots.size(), 2u);
    EXPECT_STREQ(dots[0].node().attribute("r").value(), "2000");  // twice as wide as the line
    EXPECT_STREQ(dots[0].node().parent().attribute("fill").value(), "#ff0000");
    EXPECT_STREQ(dots[1].node().attribute("r").value(), "3000");
    EXPECT_STREQ(dots[1].node().attribute("cx").value(), "50000");
    EXPECT_STREQ(dots[1].node().attribute("cy").value(), "50000");
}

TEST_F(Svg, IndicesOfOneColourShareALayer) {
    Print print = plain_print();
    print.style.palette.push_back(print.style.palette[1]);
    const auto root = parse(print, [](PathSink& sink) {
        for (const int colour : {3, 0, 1, -1}) {
            sink.begin_stroke({1, 1}, Pen{1.0, false, colour});
            sink.lines(Points{{5, 5}});
            sink.end_stroke(false);
            sink.disc({1, 1}, 2.0, Pen{1.0, false, colour});
        }
    });
    EXPECT_EQ(labels(root), (std::vector<std::string>{"ground", "1 black", "2 red", "discs black", "discs red"}));
    EXPECT_EQ(root.select_nodes("g[3]/path").size(), 3u);
    EXPECT_EQ(root.select_nodes("g[5]/circle").size(), 3u);
}

TEST_F(Svg, APipeGetsTheSameBytes) {
    const auto expected = contents(write(plain_print(), draw_sampler));
    const auto pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = contents(pipe); });
    write(plain_print(), draw_sampler, "pipe");
    reader.join();
    EXPECT_EQ(received, expected);
    EXPECT_EQ(contents(write(plain_print(), draw_sampler, "again.svg")), expected);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(Svg, APenThatChangesInOnePlaceLeavesNoDot) {
    Pen red{.colour = 1};
    Pen wide{.width = 3.0};
    const auto root = parse(plain_print(), [&](PathSink& sink) {
        sink.begin_stroke({1, 1}, red);
        sink.change_pen(wide);
        sink.change_pen(Pen{});
        sink.lines(Points{{2, 1}});
        sink.change_pen(Pen{1.0, false, 3});  // the palette has three colours
        sink.lines(Points{{3, 1}});
        sink.change_pen(wide);
        sink.lines(Points{{3, 2}, {1, 1}});
        sink.change_pen(red);
        sink.end_stroke(true);
    });
    EXPECT_EQ(labels(root), (std::vector<std::string>{"ground", "1 black"}));
    ASSERT_EQ(paths(root).size(), 2u);
    EXPECT_STREQ(paths(root)[0].attribute("d").value(), "M1000 59000h1000 1000");
    EXPECT_FALSE(paths(root)[0].attribute("stroke-width"));
    EXPECT_STREQ(paths(root)[1].attribute("stroke-width").value(), "6000");
    EXPECT_STREQ(paths(root)[1].attribute("d").value(), "M3000 59000v-1000l-2000 1000");
}

TEST_F(Svg, WhatIsHiddenOfAClosedStrokeStaysHidden) {
    Print print = plain_print();
    print.style.palette[0].alpha = 0;
    const Pen hidden;
    const Pen red{1.0, false, 1};
    auto root = parse(print, [&](PathSink& sink) { draw_square(sink, hidden, red); });
    ASSERT_EQ(paths(root).size(), 1u);
    EXPECT_STREQ(paths(root)[0].attribute("d").value(), "M10000 10000h40000v40000h-40000");
    root = parse(print, [&](PathSink& sink) { draw_square(sink, red, hidden); });
    ASSERT_EQ(paths(root).size(), 1u);
    EXPECT_STREQ(paths(root)[0].attribute("d").value(), "M10000 50000v-40000");
    root = parse(print, [&](PathSink& sink) { draw_square(sink, red, red); });
    ASSERT_EQ(paths(root).size(), 1u);
    EXPECT_STREQ(paths(root)[0].attribute("d").value(), "M10000 50000v-40000h40000v40000h-40000z");
}

TEST_F(Svg, FewStrokesArePathsOfTheirOwnAndManyShortOnesShare) {
    const auto draw = [](int strokes) {
        return [strokes](PathSink& sink) {
            for (int i = 0; i < strokes; ++i) {
                Pen pen{.width = i % 1000 == 999 ? 2.0 : 1.0};
                const double x = i % 97;
                sink.begin_stroke({x, 1}, pen);
                sink.lines(Points{{x + 1, 2}, {x, 1.5}});
                if (i % 2 == 0) sink.lines(Points{{x, 1}});
                sink.end_stroke(i % 2 == 0);
            }
        };
    };
    EXPECT_EQ(paths(parse(plain_print(), draw(200))).size(), 200u);
    const auto root = parse(plain_print(), draw(20'000));
    EXPECT_LT(paths(root).size(), 500u);
    int strokes = 0;
    for (const auto& node : paths(root)) {
        for (const Subpath& subpath : read_path(node.attribute("d").value())) {
            // The order is kept, so the stroke's number tells what it has to be.
            const double x = 1000.0 * (strokes % 97);
            Points expected = {{x, 59000}, {x + 1000, 58000}, {x, 58500}};
            if (strokes % 2 == 0) expected.emplace_back(x, 59000);
            ASSERT_EQ(subpath.points, expected) << strokes;
            ASSERT_EQ(subpath.closed, strokes % 2 == 0);
            ASSERT_EQ(node.attribute("stroke-width").as_int(2000), strokes % 1000 == 999 ? 4000 : 2000);
            ++strokes;
        }
    }
    EXPECT_EQ(strokes, 20'000);
}

TEST_F(Svg, LongPathsAreCutBelowFourMegabytes) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> anywhere(0.0, 100.0);
    Points points = {{50.0, 50.0}};
    for (int i = 0; i < 1'000'000; ++i) points.emplace_back(anywhere(random), anywhere(random) * 0.6);
    Print print = plain_print();
    const auto root = parse(print, [&](PathSink& sink) {
        sink.begin_stroke(points.front(), Pen{});
        sink.lines(std::span<const glm::dvec2>(points).subspan(1));
        sink.end_stroke(false);
    });
    EXPECT_GE(paths(root).size(), 3u);
    Points drawn;
    for (const auto& node : paths(root)) {
        const std::string_view text = node.attribute("d").value();
        EXPECT_LT(text.size(), 4'000'000u);
        const auto subpaths = read_path(text);
        ASSERT_EQ(subpaths.size(), 1u);
        if (!drawn.empty()) {
            ASSERT_EQ(subpaths[0].points.front(), drawn.back());
            drawn.pop_back();
        }
        drawn.insert(drawn.end(), subpaths[0].points.begin(), subpaths[0].points.end());
    }
    ASSERT_EQ(drawn.size(), points.size());
    const glm::dvec2 last = print.placement.to_page * glm::dvec3(points.back(), 1.0) * 1000.0;
    EXPECT_NEAR(drawn.back().x, last.x, 0.5001);
    EXPECT_NEAR(drawn.back().y, last.y, 0.5001);
    if (!has_program("xmllint")) GTEST_SKIP() << "no xmllint on this machine";
    EXPECT_TRUE(run_tool("xmllint --noout '" + (folder_ / "print.svg").string() + "'").ok);
}

TEST_F(Svg, AlphaOfLinesIsTheLayersAndOfFillsTheirOwn) {
    Print print = plain_print();
    print.style.palette = {Colour{0, 0, 0, 128}, Colour{255, 0, 0, 0}};
    print.style.fill = Colour{0, 255, 0, 51};
    print.style.ground = Colour{1, 2, 3, 204};
    Pen unseen{.colour = 1};
    const auto root = parse(print, [&](PathSink& sink) {
        sink.polygon(Points{{1, 1}, {2, 1}, {2, 2}}, Pen{});
        sink.polygon(Points{{1, 1}, {2, 1}, {2, 2}}, unseen);
        for (const Pen& pen : {Pen{}, unseen}) {
            sink.begin_stroke({1, 1}, pen);
            sink.lines(Points{{5, 5}});
            sink.end_stroke(false);
        }
    });
    EXPECT_EQ(labels(root), (std::vector<std::string>{"ground", "fills", "1 black"}));
    EXPECT_STREQ(root.select_node("g[1]/rect").node().attribute("fill-opacity").value(), "0.8");
    EXPECT_STREQ(root.select_node("g[2]/g").node().attribute("fill-opacity").value(), "0.2");
    EXPECT_STREQ(root.select_node("g[3]").node().attribute("opacity").value(), "0.502");
}

TEST_F(Svg, WithoutAStrokeOnlyFillsAreDrawn) {
    Print print = plain_print();
    print.style.stroked = false;
    EXPECT_EQ(labels(parse(print, draw_sampler)),
              (std::vector<std::string>{"ground", "fills", "discs red", "discs blue"}));
}

const std::string awkward = "a < b & c > d \"q\" 'r' ]]> &amp; --> கோலம் \xF0\x9F\x8C\xBC";

TEST_F(Svg, TextsWithSpecialCharactersStayThemselves) {
    Print print = plain_print();
    print.title = awkward;
    print.made = "sikku 0.1.0 " + awkward;
    print.pattern = "\xEF\xBB\xBF  title: " + awkward + "\r\naxiom: F<F>F\r\r\n\n\t  ";
    const auto root = parse(print, draw_sampler);
    EXPECT_EQ(root.child("title").child_value(), awkward);
    const auto path = folder_ / "print.svg";
    const auto provenance = provenance_of(path);
    ASSERT_TRUE(provenance);
    EXPECT_EQ(provenance->pattern, print.pattern);
    EXPECT_EQ(provenance->made, print.made);
    if (!has_program("xmllint")) GTEST_SKIP() << "no xmllint on this machine";
    const ToolOutcome outcome = run_tool("xmllint --noout '" + path.string() + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
}

TEST_F(Svg, TextsThatXmlCannotHoldAreStillGivenBack) {
    Print print = plain_print();
    print.title = "bell \a nul \0 half \xC3 no character \xEF\xBF\xBE surrogate \xED\xA0\x80."s;
    print.pattern = "axiom: F // \x01\x1F \xFF\xEF\xBF\xBF\n" + std::string(70'000, 'F');
    const auto root = parse(print, draw_sampler);
    EXPECT_TRUE(has(std::string_view(root.child("title").child_value()), "bell \xEF\xBF\xBD nul \xEF\xBF\xBD half"));
    const auto provenance = provenance_of(folder_ / "print.svg");
    ASSERT_TRUE(provenance);
    EXPECT_EQ(provenance->pattern, print.pattern);
    print.pattern.clear();
    write(print, draw_sampler);
    EXPECT_FALSE(provenance_of(folder_ / "print.svg")) << "a print without a pattern";
    if (!has_program("xmllint")) GTEST_SKIP() << "no xmllint on this machine";
    const ToolOutcome outcome = run_tool("xmllint --noout '" + (folder_ / "print.svg").string() + "'");
    EXPECT_TRUE(outcome.ok) << outcome.text;
}

TEST_F(Svg, OtherFilesHaveNoProvenance) {
    const auto save = [&](const std::string& text) {
        std::ofstream(folder_ / "other", std::ios::binary) << text;
        return folder_ / "other";
    };
    EXPECT_FALSE(provenance_of(folder_ / "missing"));
    EXPECT_FALSE(provenance_of(folder_.path()));
    EXPECT_FALSE(provenance_of(save("")));
    EXPECT_FALSE(provenance_of(save("\x89PNG\r\n\x1A\n\0\0"s)));
    EXPECT_FALSE(provenance_of(save("<svg><desc>x</desc><metadata></metadata></svg>")));
    EXPECT_FALSE(provenance_of(save("urn:sikku:print <<<</desc> & </metadata>")));
    const std::string whole = contents(write(plain_print(), draw_sampler));
    for (std::size_t length = 0; length < whole.find("</metadata>"); length += 7) {
        EXPECT_FALSE(provenance_of(save(whole.substr(0, length)))) << length;
    }
    EXPECT_TRUE(provenance_of(save(whole.substr(0, whole.find("</metadata>") + 11))));
}

TEST_F(Svg, OthersDrawItAsItIsMeant) {
    if (!has_program("rsvg-convert") || !has_program("pdftoppm")) {
        GTEST_SKIP() << "no rsvg-convert or no pdftoppm on this machine";
    }
    Print print = plain_print();
    print.style.palette[2].alpha = 128;
    const auto path = write(print, [](PathSink& sink) {
        draw_sampler(sink);
        // Crosses itself and another line of its colour: no darker there.
        Pen blue{.colour = 2};
        sink.begin_stroke({55, 40}, blue);
        sink.lines(Points{{85, 40}});
        sink.end_stroke(false);
    });
    const auto pdf = folder_ / "print.pdf";
    const ToolOutcome outcome = run_tool("rsvg-convert -f pdf -o '" + pdf.string() + "' '" + path.string() + "'");
    ASSERT_TRUE(outcome.ok) << outcome.text;
    const PixelGrid pixels = render_pdf(pdf, 254);  // 10 pixels a millimetre
    ASSERT_NEAR(pixels.width, 1000, 1);
    ASSERT_NEAR(pixels.height, 600, 1);
    const Colour red{255, 0, 0, 255};
    const Colour black{0, 0, 0, 255};
    const Colour half_blue{127, 127, 255, 255};
    EXPECT_TRUE(near(pixels.at(5, 5), {255, 255, 255, 255}));
    EXPECT_TRUE(near(pixels.at(105, 100), black)) << "a dot from a line without length";
    EXPECT_TRUE(near(pixels.at(700, 500), red)) << "a line";
    EXPECT_TRUE(near(pixels.at(895, 300), black)) << "the same with another pen";
    EXPECT_TRUE(near(pixels.at(350, 400), red)) << "the later polygon is on top";
    EXPECT_TRUE(near(pixels.at(250, 400), half_blue)) << "the earlier one";
    EXPECT_TRUE(near(pixels.at(200, 100), red)) << "a dot";
    EXPECT_TRUE(near(pixels.at(218, 100), red)) << "of twice the line's width";
    EXPECT_TRUE(near(pixels.at(222, 100), {255, 255, 255, 255}));
    EXPECT_TRUE(near(pixels.at(570, 200), half_blue));
    for (int x = 560; x < 850; x += 3) ASSERT_TRUE(near(pixels.at(x, 200), half_blue)) << x;
}

}  // namespace sikku::svg_test
