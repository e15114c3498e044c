// Tests that hatching keeps clear of ink: random shapes by sampling, and the fields of kolams as plotted.
#include "art/plotter/clear_hatch.h"
#include "art/writer/draw_options.h"
#include "art/writer/make_drawing.h"

#include "art/drawing/drawing.h"
#include "art/plotter/plot.h"
#include "art/plotter/shading.h"
#include "art/prints.h"
#include "art/product/draw_settings.h"
#include "engine/base/output.h"
#include "tests/plot_tools.h"
#include "tests/works.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace sikku::clear_hatch_test {

double distance_to(glm::dvec2 point, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    const double t = square > 0 ? std::clamp(glm::dot(point - a, way) / square, 0.0, 1.0) : 0.0;
    return glm::distance(point, a + t * way);
}

/// Winding number by the angles under which the edges are seen.
bool is_inside(glm::dvec2 point, const std::vector<glm::dvec2>& outline) {
    double angle = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i] - point, b = outline[(i + 1) % outline.size()] - point;
        angle += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
    }
    return std::fabs(angle) > std::numbers::pi;
}

double clearance(glm::dvec2 point, const std::vector<Obstacle>& obstacles) {
    double least = 1e300;
    for (const Obstacle& one : obstacles) {
        least = std::min(least, distance_to(point, one.from, one.to) - one.radius);
    }
    return least;
}

std::vector<Obstacle> rim(const std::vector<glm::dvec2>& outline, double radius) {
    std::vector<Obstacle> obstacles;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        obstacles.push_back({outline[i], outline[(i + 1) % outline.size()], radius});
    }
    return obstacles;
}

TEST(ClearHatch, NoPointLiesInInkAndTheRestIsCovered) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int round = 0; round < 40; ++round) {
        std::vector<glm::dvec2> outline;
        const int corners = 5 + round % 30;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners, radius = 6 + 14 * share(random);
            outline.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        std::vector<Obstacle> obstacles = rim(outline, 0.8);
        for (int i = 0; i < round % 4; ++i) {
            const glm::dvec2 at(12 * share(random) - 6, 12 * share(random) - 6);
            obstacles.push_back({at, i == 0 ? at : at + glm::dvec2(3, 1), 1 + share(random)});
        }
        const double angle = share(random) * std::numbers::pi, spacing = 0.5;
        const glm::dvec2 along(std::cos(angle), std::sin(angle));
        constexpr double tolerance = 0.01;
        const auto lines = clear_hatch_lines(outline, obstacles, along, spacing, tolerance);
        std::vector<Obstacle> ink;
        for (const auto& line : lines) {
            ASSERT_GE(line.size(), 2u);
            for (std::size_t i = 1; i < line.size(); ++i) {
                ink.push_back({line[i - 1], line[i], spacing / 2});
                for (int k = 0; k <= 20; ++k) {
                    const glm::dvec2 point = line[i - 1] + (line[i] - line[i - 1]) * (k / 20.0);
                    ASSERT_GE(clearance(point, obstacles), -tolerance - 1e-9) << round;
                    ASSERT_TRUE(is_inside(point, outline)) << round;
                }
            }
        }
        std::size_t free = 0, covered = 0;
        for (int i = 0; i < 2000; ++i) {
            const glm::dvec2 point(40 * share(random) - 20, 40 * share(random) - 20);
            // Away from ends, which are cut at right angles to the lines.
            if (!is_inside(point, outline) || clearance(point, obstacles) < spacing) continue;
            ++free;
            covered += clearance(point, ink) <= 1e-6 ? 1 : 0;
        }
        EXPECT_EQ(covered, free) << round;
    }
}

TEST(ClearHatch, AShapeWithRoundSidesIsOneZigzag) {
    // Between four circles, the field of a kolam that bends inwards everywhere.
    std::vector<glm::dvec2> outline;
    for (int side = 0; side < 4; ++side) {
        const double turn = side * std::numbers::pi / 2;
        const auto turned = [&](glm::dvec2 p) {
            return glm::dvec2(p.x * std::cos(turn) - p.y * std::sin(turn),
                              p.x * std::sin(turn) + p.y * std::cos(turn));
        };
        for (int i = 0; i < 20; ++i) {
            const double angle = -std::numbers::pi / 2 * i / 20 - std::numbers::pi / 2;
            outline.push_back(turned(glm::dvec2(10, 10) + 8.0 * glm::dvec2(std::cos(angle), std::sin(angle))));
        }
    }
    std::reverse(outline.begin(), outline.end());
    const auto lines = clear_hatch_lines(outline, rim(outline, 0.4), {1, 0}, 0.5, 0.01);
    EXPECT_EQ(lines.size(), 1u);
}

/// Every line crosses every tooth of a comb: memory would be used up although both numbers are moderate.
TEST(ClearHatch, TooManyCrossingsAreRefusedBeforeTheyAreStored) {
    std::vector<glm::dvec2> comb;
    for (int tooth = 0; tooth < 3000; ++tooth) {
        comb.emplace_back(2 * tooth, tooth % 2 == 0 ? 0 : 10000);
        comb.emplace_back(2 * tooth + 1, tooth % 2 == 0 ? 0 : 10000);
    }
    const auto error_of = [](auto hatch) -> std::string {
        try {
            hatch();
            return "no error";
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    };
    EXPECT_EQ(error_of([&] {
                  clear_hatch_lines(comb, rim(comb, 0.1), {1, 0}, 0.5, 0.01);
              }),
              "hatching meets the lines around one shape over 20 million times; use a wider spacing");
    EXPECT_EQ(error_of([&] {
                  hatch_lines(comb, {1, 0}, 0.5, 0.1);
              }),
              "hatching crosses the outline of one shape over 5 million times; use a wider spacing");
    comb.resize(10);
    EXPECT_FALSE(clear_hatch_lines(comb, rim(comb, 0.1), {1, 0}, 5, 0.01).empty());
}

TEST(ClearHatch, WaysToHolesAreNotInk) {
    // A ring: the outline goes to its hole and back along one edge.
    std::vector<glm::dvec2> outline = {{0, 0},  {20, 0},  {20, 20}, {0, 20}, {0, 10}, {6, 10},
                                       {6, 14}, {14, 14}, {14, 6},  {6, 6},  {6, 10}, {0, 10}};
    const auto lines = clear_hatch_lines(outline, {}, {0, 1}, 1.0, 0.01);
    // The line at 2.5 crosses the way and is not cut there.
    const bool is_whole = std::any_of(lines.begin(), lines.end(), [](const std::vector<glm::dvec2>& line) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            if (line[i].x == line[i - 1].x && std::fabs(line[i].x - 2.5) < 1e-9 &&
                std::fabs(line[i].y - line[i - 1].y) > 19.9) {
                return true;
            }
        }
        return false;
    });
    EXPECT_TRUE(is_whole);
}

/// The facts and warnings about a plot, a line each.
std::string draw_report(const Document& document, const OptionValues& values) {
    return remarks_of(remarks_about(prints(), document, "gcode", values));
}

/// Two loops around dots, an open line across one of them, and the dots.
constexpr const char* loops =
    "axiom: [F+F+F+F+F+F+F+F][ffffff F+F+F+F+F+F+F+F]f-f+[F]\nangle increment: 45\nline: straight\n"
    "stroke: 0.3 step #203060\nground: #ffffff\npalette: #203060 #c04040\n";

struct Drawn {
    reference::Recorder recorder;
    std::unique_ptr<Drawing> drawing;
    Print print;
};

/// The strokes for a plotter, before they are arranged.
std::unique_ptr<Drawn> drawn(const Document& document, const OptionValues& values) {
    auto result = std::make_unique<Drawn>();
    const DrawSettings settings = read_draw_settings(values);
    const Document styled = settings.keys.empty() ? document : document.with(settings.keys);
    result->print.style = read_print_style(styled, settings);
    result->print.page = settings.paper.page;
    DrawOptions options;
    static_cast<DrawingOptions&>(options) = drawing_options(settings, styled);
    static_cast<PlotSetup&>(options) = plot_setup(settings, PrintFormat::gcode);
    options.format = PrintFormat::gcode;
    result->drawing = make_drawing(styled.grammar(), result->print.style, options);
    result->drawing->place(result->print);
    result->print.style = result->drawing->style();
    result->drawing->read(result->print, result->recorder);
    return result;
}

TEST(ClearHatch, FieldsOfPlotsLeaveLinesAndDotsFree) {
    const Document snake = load(bundled("kolams/snake-kolam")).with({Setting{"-n", "derivation length", "2"}});
    const Document open = parse("loops.lsys", loops);
    for (const Document& document : {snake, open}) {
        for (const char* pen : {"0.4mm", "0.9mm", ""}) {
            for (const char* weave : {"none", "yes"}) {
                OptionValues values = {
                    {"fields", "kind"}, {"dots", "3mm"}, {"hatch", "0.9mm,30"}, {"size", "150x150mm"}};
                if (*pen) values.push_back({"pen-width", pen});
                if (&document == &snake) values.push_back({"weave", weave});
                SCOPED_TRACE(std::string(pen) + weave);
                const auto plot = drawn(document, values);
                const double step = plot->print.placement.step;
                const double nib = *pen ? std::stod(pen) : 0.9;
                std::vector<int> hatched = plot->drawing->hatched_colours();
                std::vector<Obstacle> ink;
                std::vector<std::vector<glm::dvec2>> hatching;
                bool has_lines = false;
                for (const reference::Line& line : plot->recorder.strokes) {
                    const Pen& first = line.pens.front();
                    const double width = plot->print.style.line_width(first, step);
                    if (std::find(hatched.begin(), hatched.end(), first.colour) != hatched.end()) {
                        EXPECT_FALSE(has_lines) << "fields come first";
                        EXPECT_LE(width, nib + 1e-9) << "one pen wide";
                        hatching.push_back(line.points);
                        continue;
                    }
                    has_lines = true;
                    Samples samples(0.02 / step);
                    samples.start(line.points[0]);
                    if (line.points.size() == line.pens.size() + 1) {
                        for (std::size_t i = 1; i < line.points.size(); ++i) samples.line(line.points[i]);
                    } else {
                        for (std::size_t i = 1; i + 2 < line.points.size(); i += 3) {
                            samples.curve(line.points[i], line.points[i + 1], line.points[i + 2]);
                        }
                    }
                    for (const glm::dvec2 at : samples.points)
                        ink.push_back({at, at, std::max(width, nib) / 2 / step});
                }
                ASSERT_FALSE(hatching.empty());
                for (const auto& disc : plot->recorder.discs) ink.push_back({disc.centre, disc.centre, disc.radius});
                double least = 1e300;
                for (const auto& line : hatching) {
                    for (std::size_t i = 1; i < line.size(); ++i) {
                        for (int k = 0; k <= 8; ++k) {
                            const glm::dvec2 at = line[i - 1] + (line[i] - line[i - 1]) * (k / 8.0);
                            least = std::min(least, clearance(at, ink) * step - nib / 2);
                        }
                    }
                }
                // Flattening and sampling.
                EXPECT_GT(least, -0.04);
            }
        }
    }
}

TEST(ClearHatch, HatchingIsAsLongWhateverTheWidthOfThePen) {
    const Document kolam = load(bundled("kolams/snake-kolam")).with({Setting{"-n", "derivation length", "2"}});
    const auto length = [&](const char* pen, const char* hatch) {
        OptionValues values = {{"size", "A5"}, {"fields", "chessboard"}, {"pen-width", pen}};
        if (*hatch) values.push_back({"hatch", hatch});
        const std::string report = draw_report(kolam, values);
        return std::stod(report.substr(report.find("plot:   ") + 8));
    };
    for (const char* pen : {"0.2mm", "0.4mm", "0.8mm"}) {
        const double hatching = length(pen, "0.8mm") - length(pen, "");
        EXPECT_NEAR(hatching / (length("0.4mm", "0.8mm") - length("0.4mm", "")), 1, 0.15) << pen;
    }
}

TEST(ClearHatch, PensDrawInTheOrderOfFieldsLinesAndDots) {
    const Document kolam = load(bundled("kolams/snake-kolam")).with({Setting{"-n", "derivation length", "2"}});
    const std::string svg = draw(kolam, "svg",
                                 {{"plotter", "true"},
                                  {"fields", "chessboard"},
                                  {"powders", "#c8324a #305090"},
                                  {"dots", "2mm #123456"},
                                  {"hatch", "1mm"},
                                  {"stroke", "0.2 step #fffaf0"}});
    std::vector<std::string> labels;
    for (std::size_t at = 0; (at = svg.find("inkscape:label=\"", at)) != std::string::npos; at += 16) {
        labels.push_back(svg.substr(at + 16, svg.find('"', at + 16) - at - 16));
    }
    ASSERT_EQ(labels.size(), 3u);
    EXPECT_TRUE(labels[0] == "1 #c8324a" || labels[0] == "1 #305090") << labels[0];
    EXPECT_EQ(labels[1], "2 floralwhite");
    EXPECT_EQ(labels[2], "3 #123456");
    EXPECT_FALSE(has(svg, "<rect")) << "the ground is not drawn";
    EXPECT_TRUE(has(svg, "style=\"background:"));
}

}  // namespace sikku::clear_hatch_test
