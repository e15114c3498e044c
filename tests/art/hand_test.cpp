// tests/art/hand_test.cpp: lines as a hand draws them: order, width, clearance, grain, outlines.
#include "art/hand/hand.h"
#include "art/drawing/drawing.h"
#include "art/hand/crumbs.h"
#include "art/hand/hand_line.h"
#include "art/prints.h"
#include "art/raster/raster.h"
#include "art/writer/draw.h"
#include "art/writer/make_drawing.h"
#include "engine/derivation/derivation.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace sikku::hand_test {

using Points = std::vector<glm::dvec2>;

/// Draws without fills.
void draw_lines(std::vector<HandLine>& lines, std::vector<HandDot>& dots, const HandOptions& options) {
    std::vector<HandFill> none;
    draw_by_hand(lines, dots, none, options);
}

Style thin_style(double width = 0.2) {
    Style style;
    style.stroke = {width, true};
    style.palette = {{0, 0, 0, 255}, {255, 0, 0, 255}};
    return style;
}

/// Lines that a function draws, gathered with a step of 1 mm.
std::vector<HandLine> gathered(const std::function<void(PathSink&)>& draw) {
    static const Style style = thin_style();
    HandGatherer gatherer(style, 1.0, 1e6);
    draw(gatherer);
    return std::move(gatherer.gathered);
}

void draw_circle(PathSink& sink, glm::dvec2 centre, double radius, bool clockwise) {
    const double k = 0.5522847498307936 * radius, turn = clockwise ? -1 : 1;
    sink.begin_stroke(centre + glm::dvec2(radius, 0), {});
    glm::dvec2 from(radius, 0), way(0, turn);
    for (int quarter = 0; quarter < 4; ++quarter) {
        const glm::dvec2 to = way * radius;
        const Points controls = {centre + from + k * way, centre + to + k / radius * from, centre + to};
        sink.curves(controls);
        way = -from / radius;
        from = to;
    }
    sink.end_stroke(true);
}

/// A stadium: two half circles and two long runs.
void draw_stadium(PathSink& sink) {
    const double k = 0.5522847498307936;
    sink.begin_stroke({0, 0}, {});
    sink.lines(Points{{4, 0}, {8, 0}});
    sink.curves(Points{{8 + k, 0}, {9, 1 - k}, {9, 1}, {9, 1 + k}, {8 + k, 2}, {8, 2}});
    sink.lines(Points{{4, 2}, {0, 2}});
    sink.curves(Points{{-k, 2}, {-1, 1 + k}, {-1, 1}, {-1, 1 - k}, {-k, 0}, {0, 0}});
    sink.end_stroke(true);
}

Print kolam_print(const Document& document, double side, double hand) {
    Print print;
    print.page = {side, side, side / 20};
    Diagnostics diagnostics;
    print.style = read_style(document.pattern(), 96, diagnostics);
    print.style.hand = hand;
    print.dpi = 25.4;
    return print;
}

Document kolam(const std::string& name, std::int64_t steps, const char* folder = "kolams") {
    return load((std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns" / folder / (name + ".lsys")).string())
        .with({{"derivation length", "derivation length", std::to_string(steps)}});
}

struct Mask {
    int width = 0, height = 0;
    std::vector<char> ink;
};

/// Ink and ground: how many connected parts of at least so many pixels each has. Ink is joined by corners.
std::pair<int, int> parts_of(const Mask& mask, int least = 1) {
    std::vector<char> seen(mask.ink.size(), 0);
    std::pair<int, int> count{0, 0};
    std::vector<int> open;
    for (int start = 0; start < static_cast<int>(mask.ink.size()); ++start) {
        if (seen[static_cast<std::size_t>(start)]) continue;
        const char kind = mask.ink[static_cast<std::size_t>(start)];
        int pixels = 0;
        open = {start};
        seen[static_cast<std::size_t>(start)] = 1;
        while (!open.empty()) {
            const int at = open.back();
            open.pop_back();
            ++pixels;
            for (int dy = -1; dy <= 1; ++dy) {
                for (int dx = -1; dx <= 1; ++dx) {
                    if (!kind && dx != 0 && dy != 0) continue;
                    const int x = at % mask.width + dx, y = at / mask.width + dy;
                    if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) continue;
                    const auto next = static_cast<std::size_t>(y * mask.width + x);
                    if (seen[next] || mask.ink[next] != kind) continue;
                    seen[next] = 1;
                    open.push_back(static_cast<int>(next));
                }
            }
        }
        if (pixels >= least) ++(kind ? count.first : count.second);
    }
    return count;
}

class Hand : public ::testing::Test {
protected:
    /// The pixels of a drawing.
    static std::vector<std::uint8_t> pixels(const Document& document, const Print& given, int threads,
                                            int* channels = nullptr) {
        DrawOptions options;
        options.format = PrintFormat::png;
        Print print = given;
        const auto drawing = make_drawing(document.grammar(), print.style, options);
        drawing->place(print);
        print.style = drawing->style();
        const auto rendering = drawing->rendering(print);
        if (channels) *channels = rendering->channels();
        std::vector<std::uint8_t> bytes;
        rendering->render(threads, [&](int, int, std::span<const std::uint8_t> rows) {
            bytes.insert(bytes.end(), rows.begin(), rows.end());
        });
        return bytes;
    }

    void draw_file(const Document& document, const Print& print, PrintFormat format, const std::string& name,
                   const std::function<void(DrawOptions&)>& change = {}) const {
        DrawOptions options;
        options.format = format;
        if (change) change(options);
        draw(document.grammar(), print, options, folder_.path() / name);
    }

    ScratchFolder folder_;
};

TEST_F(Hand, DrawsClosedLinesAnticlockwiseFromTheUpperLeft) {
    for (const bool clockwise : {false, true}) {
        auto lines = gathered([&](PathSink& sink) { draw_circle(sink, {5, 5}, 2, clockwise); });
        ASSERT_EQ(lines.size(), 1u);
        order_by_hand(lines);
        const glm::dvec2 start = lines[0].nodes[0].at, next = lines[0].nodes[3].at;
        EXPECT_NEAR(start.x, 5 - std::numbers::sqrt2, 0.15);
        EXPECT_NEAR(start.y, 5 + std::numbers::sqrt2, 0.15);
        EXPECT_LT(next.x, start.x);
        EXPECT_LT(next.y, start.y);
        EXPECT_NEAR(lines[0].length, 4 * std::numbers::pi, 0.05);
    }
}

TEST_F(Hand, DrawsOpenLinesFromTheUpperLeftEnd) {
    auto lines = gathered([](PathSink& sink) {
        sink.begin_stroke({5, 0}, {});
        sink.lines(Points{{0, 4}});
        sink.end_stroke(false);
    });
    order_by_hand(lines);
    EXPECT_EQ(lines[0].nodes.front().at, glm::dvec2(0, 4));
}

TEST_F(Hand, DrawsFromTheCentreAndImagesOneAfterTheOther) {
    const Points centres = {{8, 0}, {0, 0}, {0, 8}, {-4, 0}, {-8, 0}, {4, 0}, {0, -8}};
    auto lines = gathered([&](PathSink& sink) {
        for (const glm::dvec2 centre : centres) draw_circle(sink, centre, 1, false);
    });
    order_by_hand(lines);
    Points order;
    for (const HandLine& line : lines) order.push_back(centres[line.number]);
    // Around the centre anticlockwise from the top left.
    const Points expected = {{0, 0}, {-4, 0}, {4, 0}, {-8, 0}, {0, -8}, {8, 0}, {0, 8}};
    EXPECT_EQ(order, expected);
}

TEST_F(Hand, SwellsInTurnsAndThinsInRuns) {
    for (const double strength : {0.3, 0.6, 1.0}) {
        double turns = 0, runs = 0;
        int turning = 0, running = 0;
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            auto lines = gathered(draw_stadium);
            std::vector<HandDot> dots;
            const HandLine plain = lines[0];
            HandOptions options{strength, seed};
            draw_lines(lines, dots, options);
            for (std::size_t i = 0; i < plain.size(); ++i) {
                const double x = plain.nodes[i].at.x;
                // Without the share of the flour, which runs dry in places.
                const double half = lines[0].nodes[i].half / (1 + 0.4 * (lines[0].nodes[i].flow - 1));
                if (x < -0.5 || x > 8.5) turns += half, ++turning;
                if (x > 2 && x < 6) runs += half, ++running;
            }
        }
        turns /= 0.1 * turning;
        runs /= 0.1 * running;
        EXPECT_GT(turns, 1) << strength;
        EXPECT_LT(runs, 0.97) << strength;
        EXPECT_GT(turns / runs, 1 + 0.25 * strength);
        EXPECT_LT(turns / runs, 2);
    }
}

TEST_F(Hand, WaversByAShareOfALoopAndNotMore) {
    auto lines = gathered(draw_stadium);
    std::vector<HandDot> dots = {{{4, 1}, 0.1, {}}};
    const HandLine plain = lines[0];
    draw_lines(lines, dots, {1.0, 5});
    double most = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        most = std::max(most, glm::length(lines[0].nodes[i].at - plain.nodes[i].at));
    }
    EXPECT_GT(most, 0.02 * plain.loop);
    EXPECT_LT(most, 0.25 * plain.loop);
    EXPECT_LT(glm::length(dots[0].at - glm::dvec2(4, 1)), 0.25 * plain.loop);
    EXPECT_EQ(gathered(draw_stadium)[0].nodes[7].at, plain.nodes[7].at);
}

TEST_F(Hand, GoesOverItsStartByAFewWidths) {
    auto lines = gathered([](PathSink& sink) { draw_circle(sink, {0, 0}, 3, false); });
    std::vector<HandDot> dots;
    const HandOptions options{0.5, 1};
    draw_lines(lines, dots, options);
    const HandLine stroke = drawn_stroke(lines[0], options);
    EXPECT_FALSE(stroke.closed);
    const double over = stroke.length - lines[0].length;
    const double width = 2 * lines[0].nodes[0].half;
    EXPECT_GT(over, 1.5 * width);
    EXPECT_LT(over, 3 * width);
    EXPECT_LT(stroke.nodes.back().half, 0.8 * stroke.nodes.front().half);
}

/// A wave of half circles: a line of `loops` loops.
void draw_wave(PathSink& sink, int loops) {
    const double k = 0.5522847498307936;
    sink.begin_stroke({0, 0}, {});
    for (int i = 0; i < loops; ++i) {
        const double x = 2.0 * i, y = i % 2 == 0 ? 1 : -1;
        sink.curves(Points{{x, k * y}, {x + 1 - k, y}, {x + 1, y}, {x + 1 + k, y}, {x + 2, k * y}, {x + 2, 0}});
    }
    sink.end_stroke(false);
}

/// A pinch lasts 4 to 9 loops. The line is full and wide at its beginning, and narrower where it runs dry.
TEST_F(Hand, RunsDryAndStartsAgain) {
    for (const double strength : {0.4, 1.0}) {
        auto lines = gathered([](PathSink& sink) { draw_wave(sink, 200); });
        std::vector<HandDot> dots;
        draw_lines(lines, dots, {strength, 4});
        const HandLine& line = lines[0];
        std::vector<double> begins;
        double fresh = 0, dry = 0;
        std::size_t fresh_count = 0, dry_count = 0;
        for (std::size_t i = 1; i < line.size(); ++i) {
            const HandNode& node = line.nodes[i];
            if (node.fresh > 0.9 && line.nodes[i - 1].fresh < 0.5) begins.push_back(node.along);
            EXPECT_GT(node.flow, 0.2);
            EXPECT_LT(node.flow, 1.4);
            if (node.flow > 1) fresh += node.half, ++fresh_count;
            if (node.flow < 0.8) dry += node.half, ++dry_count;
        }
        ASSERT_GT(begins.size(), 20U);
        for (std::size_t k = 1; k < begins.size(); ++k) {
            EXPECT_GT(begins[k] - begins[k - 1], 3.5 * line.loop);
            EXPECT_LT(begins[k] - begins[k - 1], 9.5 * line.loop);
        }
        ASSERT_GT(dry_count, line.size() / 20);
        ASSERT_GT(fresh_count, line.size() / 50);
        EXPECT_LT(dry / static_cast<double>(dry_count), 0.92 * fresh / static_cast<double>(fresh_count));
    }
}

/// Circles at the corners of a square, which are images of each other, get different sizes and places.
TEST_F(Hand, ImagesOfAMotifDiffer) {
    auto lines = gathered([](PathSink& sink) {
        for (const glm::dvec2 at : {glm::dvec2(8, 8), {-8, 8}, {-8, -8}, {8, -8}}) draw_circle(sink, at, 1, false);
    });
    std::vector<HandDot> dots;
    const auto plain = lines;
    draw_lines(lines, dots, {0.5, 2});
    std::set<std::int64_t> sizes;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        sizes.insert(std::llround(1000 * lines[i].length / plain[i].length));
        EXPECT_NEAR(lines[i].length / plain[i].length, 1, 0.2);
    }
    EXPECT_EQ(sizes.size(), 4U);
    EXPECT_GT(*sizes.rbegin() - *sizes.begin(), 15);
}

TEST_F(Hand, CrumbsFallBesideTheLineAndMoreWhereAPinchBegins) {
    auto lines = gathered([](PathSink& sink) { draw_wave(sink, 400); });
    std::vector<HandDot> dots;
    const HandOptions options{0.6, 3};
    draw_lines(lines, dots, options);
    const HandLine& line = lines[0];
    const std::vector<HandCrumb> crumbs = crumbs_beside(line, 0, options);
    ASSERT_GT(crumbs.size(), 1000U);
    std::size_t near = 0, far = 0, fresh = 0;
    double fresh_length = 0;
    for (std::size_t i = 0; i < line.size(); ++i) fresh_length += line.nodes[i].fresh > 0.5 ? line.step(i) : 0;
    for (const HandCrumb& crumb : crumbs) {
        double distance = 1e9;
        const HandNode* nearest = nullptr;
        for (const HandNode& node : line.nodes) {
            const double way = glm::length(node.at - crumb.at);
            if (way < distance) distance = way, nearest = &node;
        }
        const double width = 2 * nearest->half;
        EXPECT_LT(distance - nearest->half, 2.6 * width);
        EXPECT_LT(crumb.radius, 0.15 * width);
        near += distance - nearest->half < 0.4 * width;
        far += distance - nearest->half > 0.8 * width;
        fresh += nearest->fresh > 0.5;
    }
    EXPECT_GT(near, 4 * far);
    EXPECT_GT(far, 0U);
    const double share = static_cast<double>(fresh) / static_cast<double>(crumbs.size());
    EXPECT_GT(share, 1.4 * fresh_length / line.length);
    EXPECT_EQ(crumbs_beside(line, 0, options).front().at, crumbs.front().at);
    EXPECT_LT(crumbs_beside(line, 0, {0.2, 3}).size(), crumbs.size() / 2);
}

/// Crumbs stay on the near half of the gap to a neighbour.
TEST_F(Hand, CrumbsKeepToTheirSideOfTheGap) {
    auto lines = gathered([](PathSink& sink) {
        for (const double y : {0.0, 0.5}) {
            sink.begin_stroke({0, y}, {});
            sink.lines(Points{{300, y}});
            sink.end_stroke(false);
        }
    });
    std::vector<HandDot> dots;
    const HandOptions options{1.0, 3};
    draw_lines(lines, dots, options);
    std::size_t count = 0;
    for (std::size_t of = 0; of < 2; ++of) {
        for (const HandCrumb& crumb : crumbs_beside(lines[of], 0, options)) {
            const auto distance_to = [&](const HandLine& line) {
                double distance = 1e9;
                for (const HandNode& node : line.nodes) {
                    distance = std::min(distance, glm::length(node.at - crumb.at) - node.half);
                }
                return distance;
            };
            EXPECT_GT(distance_to(lines[1 - of]), crumb.radius);
            ++count;
        }
    }
    EXPECT_GT(count, 500U);
}

TEST_F(Hand, FillsFollowTheirLines) {
    static const Style style = thin_style(0.12);
    HandGatherer gatherer(style, 1.0, 1e6);
    const double k = 0.5522847498307936 * 2;
    const Points outline = {{2, 0},   {2, k},   {k, 2},  {0, 2},  {-k, 2}, {-2, k}, {-2, 0},
                            {-2, -k}, {-k, -2}, {0, -2}, {k, -2}, {2, -k}, {2, 0}};
    gatherer.area(outline, {});
    draw_circle(gatherer, {0, 0}, 2, false);
    draw_circle(gatherer, {5, 0}, 1, false);
    std::vector<HandDot> dots = {{{0, 2}, 0.1, {}}};
    auto lines = gatherer.gathered;
    auto fills = gatherer.fills;
    draw_by_hand(lines, dots, fills, {1.0, 8});
    const auto distance_to_line = [&](glm::dvec2 at) {
        double distance = 1e9;
        for (std::size_t i = 0; i < lines[0].size(); ++i) {
            const glm::dvec2 from = lines[0].nodes[i].at, way = lines[0].nodes[lines[0].next(i)].at - from;
            const double t = std::clamp(glm::dot(at - from, way) / glm::dot(way, way), 0.0, 1.0);
            distance = std::min(distance, glm::length(from + t * way - at));
        }
        return distance;
    };
    ASSERT_EQ(fills.size(), 1U);
    const Points& moved = fills[0].outline;
    ASSERT_GT(moved.size(), outline.size());
    ASSERT_EQ(moved.size() % 3, 1U);
    double most = 0;
    for (std::size_t i = 0; i < moved.size(); i += 3) {
        EXPECT_LT(distance_to_line(moved[i]), 0.05) << i;
        most = std::max(most, std::fabs(glm::length(moved[i]) - 2));
    }
    EXPECT_GT(most, 0.1);
    // A dot on a line stays there.
    EXPECT_LT(distance_to_line(dots[0].at), 0.05);
}

/// Winding number of a closed polygon around a point.
int winding(const Points& polygon, glm::dvec2 point) {
    int turns = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - point, b = polygon[(i + 1) % polygon.size()] - point;
        if ((a.y <= 0) == (b.y <= 0)) continue;
        const double cross = a.x * b.y - a.y * b.x;
        if (b.y > a.y && cross > 0) ++turns;
        if (b.y < a.y && cross < 0) --turns;
    }
    return turns;
}

TEST_F(Hand, OutlinesHoldTheirMiddle) {
    const Style style = thin_style(0.45);
    HandGatherer gatherer(style, 1.0, 1e6);
    // Corners, a hairpin narrower than the pen, a loop that crosses itself.
    gatherer.begin_stroke({0, 0}, {});
    gatherer.lines(Points{{3, 0}, {3, 0.2}, {0, 0.3}, {1.5, 3}, {3, 1}});
    gatherer.curves(Points{{4, -1}, {6, 2}, {2, 2}});
    gatherer.end_stroke(false);
    draw_stadium(gatherer);
    std::vector<HandDot> dots;
    for (const double strength : {0.2, 1.0}) {
        auto lines = gatherer.gathered;
        const HandOptions options{strength, 3};
        draw_lines(lines, dots, options);
        for (const HandLine& line : lines) {
            const HandLine stroke = drawn_stroke(line, options);
            const Points outline = hand_outline(stroke, 0, stroke.size() - 1);
            ASSERT_EQ(outline.size() % 3, 1u);
            Points polygon = {outline[0]};
            for (std::size_t i = 1; i + 2 < outline.size(); i += 3) {
                flatten(polygon.back(), outline[i], outline[i + 1], outline[i + 2], 1e-3,
                        [&](glm::dvec2 end) { polygon.push_back(end); });
            }
            for (const HandNode& point : flattened(stroke, 1e-3)) {
                EXPECT_NE(winding(polygon, point.at + glm::dvec2(1e-5, 1.3e-5)), 0)
                    << point.at.x << ' ' << point.at.y;
            }
        }
    }
}

TEST_F(Hand, IsTheSameOnEveryThreadAndForEverySeedAnother) {
    const Document snake = kolam("snake-kolam", 2);
    const Print print = kolam_print(snake, 500, 0.5);
    const auto one = pixels(snake, print, 1);
    EXPECT_EQ(pixels(snake, print, 1), one);
    EXPECT_EQ(pixels(snake, print, 3), one);
    EXPECT_NE(pixels(snake.with({{"seed", "seed", "9"}}), print, 1), one);
    Print plain = print;
    plain.style.hand = 0;
    EXPECT_NE(pixels(snake, plain, 1), one);
}

TEST_F(Hand, BandsAreRowsOfTheWhole) {
    const Document snake = kolam("snake-kolam", 2);
    Print print = kolam_print(snake, 500, 0.5);
    DrawOptions options;
    options.format = PrintFormat::png;
    const auto drawing = make_drawing(snake.grammar(), print.style, options);
    drawing->place(print);
    print.style = drawing->style();
    const auto rendering = drawing->rendering(print);
    std::vector<std::uint8_t> whole, part;
    rendering->render(2, [&](int, int, std::span<const std::uint8_t> rows) {
        whole.insert(whole.end(), rows.begin(), rows.end());
    });
    rendering->render_rows(128, 384, rendering->channels(), [&](int, int, std::span<const std::uint8_t> rows) {
        part.insert(part.end(), rows.begin(), rows.end());
    });
    const std::size_t row = whole.size() / 500;
    EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + static_cast<std::ptrdiff_t>(128 * row)));
}

/// Areas are strewn with powder, too: within a filled square there are grains of several shades, and the ground
/// hardly shows.
TEST_F(Hand, AreasShowGrains) {
    const auto shades = [&](double hand) {
        const Document square = parse("square.lsys", fmt::format("hand: {}\nstroke: 0.1 step white\nground: black\n"
                                                                 "palette: white\naxiom: {{F+F+F+F}}\n",
                                                                 hand));
        const Print print = kolam_print(square, 300, hand);
        const std::vector<std::uint8_t> all = pixels(square, print, 2);
        const std::size_t channels = all.size() / (300 * 300);
        std::set<int> found;
        double sum = 0;
        for (std::size_t y = 100; y < 200; ++y) {
            for (std::size_t x = 100; x < 200; ++x) {
                const int shade = all[(300 * y + x) * channels];
                found.insert(shade);
                sum += shade;
            }
        }
        return std::pair(found.size(), sum / (100 * 100));
    };
    EXPECT_EQ(shades(0), std::pair(std::size_t{1}, 255.0));
    const auto [count, mean] = shades(0.5);
    EXPECT_GT(count, 8U);
    EXPECT_GT(mean, 170);
    EXPECT_LT(mean, 230);
}

/// Grain lies in the drawing, not in the pixels: a part of the page that begins elsewhere shows the same.
TEST_F(Hand, GrainMovesWithTheDrawing) {
    const Document snake = kolam("snake-kolam", 2);
    Print print = kolam_print(snake, 500, 0.5);
    DrawOptions options;
    options.format = PrintFormat::png;
    const auto drawing = make_drawing(snake.grammar(), print.style, options);
    drawing->place(print);
    print.style = drawing->style();
    Print part = print;
    part.page = {200, 300, 0};
    part.placement.to_page[2] -= glm::dvec2(100, 150);
    const auto all = [](Rendering& rendering) {
        std::vector<std::uint8_t> bytes;
        rendering.render(1, [&](int, int, std::span<const std::uint8_t> rows) {
            bytes.insert(bytes.end(), rows.begin(), rows.end());
        });
        return bytes;
    };
    const auto whole = all(*drawing->rendering(print)), cut = all(*drawing->rendering(part));
    ASSERT_EQ(cut.size(), 200u * 300 * 3);
    std::size_t far = 0;
    for (std::size_t y = 0; y < 300; ++y) {
        for (std::size_t x = 0; x < 3 * 200; ++x) {
            const int a = cut[y * 600 + x], b = whole[(y + 150) * 1500 + 300 + x];
            far += std::abs(a - b) > 12;
        }
    }
    EXPECT_LT(far, cut.size() / 1000);
}

/// The certificate: as many parts of ink and of ground as the plain drawing has, in vectors as another program draws
/// them, and in pictures without their grain.
TEST_F(Hand, KeepsTheTopologyOfKolams) {
    NEEDS("pdftoppm");
    const std::vector<std::pair<std::string, std::int64_t>> kolams = {{"snake-kolam", 2},
                                                                      {"anklets-of-krishna", 3},
                                                                      {"kooja-kolam", 0},
                                                                      {"bag-of-candies", 2},
                                                                      {"scissors", 1},
                                                                      {"kolam-9-to-1-085zkcfp", 0},
                                                                      {"kolam-11-6-idukku-d30xsr9p", 0}};
    for (const auto& [name, steps] : kolams) {
        SCOPED_TRACE(name);
        Document document = kolam(name, steps, name.starts_with("kolam-") ? "kolam-library" : "kolams");
        const Colour black{0, 0, 0, 255}, white{255, 255, 255, 255};
        std::pair<int, int> plain;
        for (const double strength : {0.0, 0.5, 1.0}) {
            SCOPED_TRACE(strength);
            Print print = kolam_print(document, 400, strength);
            print.style.ground = white;
            print.style.stroke_colour = black;
            print.style.dots.reset();
            draw_file(document, print, PrintFormat::pdf, "kolam.pdf");
            const PixelGrid page = render_pdf(folder_.path() / "kolam.pdf", 60);
            Mask mask{page.width, page.height, {}};
            for (int y = 0; y < page.height; ++y) {
                for (int x = 0; x < page.width; ++x) mask.ink.push_back(page.at(x, y).red < 128);
            }
            const auto parts = parts_of(mask);
            if (strength == 0) {
                plain = parts;
                EXPECT_GT(plain.second, 1);
                continue;
            }
            EXPECT_EQ(parts, plain);
            if (name.find("idukku") != std::string::npos) continue;  // lines thinner than two of these pixels
            Print picture = print;
            picture.dpi = 25.4 * 4;
            int channels = 0;
            const auto bytes = pixels(document, picture, 0, &channels);
            ASSERT_EQ(channels, 1);
            Mask coarse{400, 400, {}};
            for (std::size_t y = 0; y < 400; ++y) {
                for (std::size_t x = 0; x < 400; ++x) {
                    int sum = 0;
                    for (std::size_t k = 0; k < 16; ++k) sum += bytes[(4 * y + k / 4) * 1600 + 4 * x + k % 4];
                    coarse.ink.push_back(sum < 16 * 128);
                }
            }
            // Grains and gaps between them are smaller.
            EXPECT_EQ(parts_of(coarse, 20), plain);
        }
    }
}

TEST_F(Hand, OutlinesAreValidAndCompact) {
    NEEDS("xmllint");
    NEEDS("rsvg-convert");
    const Document snake = kolam("snake-kolam", 3);
    Print print = kolam_print(snake, 200, 0.5);
    draw_file(snake, print, PrintFormat::svg, "hand.svg");
    const std::string file = folder_.file("hand.svg");
    EXPECT_TRUE(run_tool("xmllint --noout '" + file + "'").ok);
    EXPECT_TRUE(run_tool("rsvg-convert '" + file + "' -o '" + file + ".png'").ok);
    const std::string svg = contents(file);
    EXPECT_FALSE(has(svg, "stroke="));
    // No crumbs.
    EXPECT_FALSE(has(svg, "<circle"));
    print.style.hand = 0;
    draw_file(snake, print, PrintFormat::svg, "plain.svg");
    EXPECT_LT(svg.size(), 12 * contents(folder_.file("plain.svg")).size());
}

TEST_F(Hand, PensDrawTheMiddleOfTheLines) {
    const Document snake = kolam("snake-kolam", 2);
    Print print = kolam_print(snake, 200, 0.5);
    draw_file(snake, print, PrintFormat::svg, "plot.svg", [](DrawOptions& options) { options.plot.emplace(); });
    const std::string svg = contents(folder_.file("plot.svg"));
    EXPECT_TRUE(has(svg, "stroke-width="));
    std::size_t paths = 0;
    for (std::size_t at = 0; (at = svg.find("<path", at)) != std::string::npos; ++at) ++paths;
    EXPECT_EQ(paths, 1u);
}

TEST_F(Hand, AppearsPieceByPieceInAnAnimation) {
    NEEDS("xmllint");
    const Document snake = kolam("snake-kolam", 1);
    Print print = kolam_print(snake, 200, 0.5);
    print.animation = 5;
    draw_file(snake, print, PrintFormat::svg, "hand.svg");
    EXPECT_TRUE(run_tool("xmllint --noout '" + folder_.file("hand.svg") + "'").ok);
    const std::string svg = contents(folder_.file("hand.svg"));
    double last = -1;
    int pieces = 0;
    for (std::size_t at = 0; (at = svg.find("--b:", at)) != std::string::npos; ++at) {
        const double begin = std::stod(svg.substr(at + 4, 20));
        EXPECT_GT(begin, last);
        last = begin;
        ++pieces;
    }
    EXPECT_GT(pieces, 20);
    EXPECT_TRUE(has(svg, "@keyframes fall"));
}

/// How a line thinner than 0.02 mm wavers cannot be seen, so that it takes no more points.
TEST_F(Hand, SamplesThinLinesNoFinerThanCanBeSeen) {
    const auto points_of = [](double width) {
        const Style style = thin_style(width);
        HandGatherer gatherer(style, 1.0, 1e6);
        draw_circle(gatherer, {0, 0}, 50, false);
        std::size_t points = 0;
        for (const HandLine& line : gatherer.gathered) points += line.size();
        return points;
    };
    EXPECT_GT(points_of(0.02), points_of(2.0));
    EXPECT_EQ(points_of(1e-9), points_of(0.02));
    EXPECT_LT(points_of(1e-9), 10'000u);
}

/// Places far from the others do not share a cell of the grid that finds neighbours.
TEST_F(Hand, IsQuickForStepsOfVeryDifferentLength) {
    const Document far = parse("far.lsys", "axiom: F(1e9)F(1)\nhand: 1\nstroke: 1e-9 step black\n");
    const auto begin = std::chrono::steady_clock::now();
    draw(far, "svg");
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Hand, RefusesWhatItCannotKeep) {
    static const Style style = thin_style();
    HandGatherer gatherer(style, 1.0, 100);
    gatherer.begin_stroke({0, 0}, {});
    EXPECT_THROW(
        {
            for (int i = 1; i < 200; ++i) gatherer.lines(Points{{static_cast<double>(i), 0}});
        },
        BudgetError);
    const Document solid = parse("solid.lsys", "axiom: F&F\nhand: 0.5\n");
    DrawOptions options;
    EXPECT_THROW(make_drawing(solid.grammar(), kolam_print(solid, 100, 0.5).style, options), std::runtime_error);
}

}  // namespace sikku::hand_test
