#include "art/raster/raster.h"

#include "art/image/image_file.h"
#include "art/image/image_module.h"
#include "art/raster/blend.h"
#include "art/raster/fill.h"
#include "art/raster/stroke.h"
#include "tests/hilbert.h"
#include "tests/print_tools.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <random>

namespace sikku::raster_test {

using Points = std::vector<glm::dvec2>;
using Bytes = std::vector<std::uint8_t>;

constexpr Colour black{0, 0, 0, 255}, white{255, 255, 255, 255}, red{255, 0, 0, 255}, green{0, 255, 0, 255},
    blue{0, 0, 255, 255};

/// A page on which pattern units are pixels, y down: black on white, pens in pixels.
Print pixel_print(int width, int height, double pen) {
    Print print;
    print.page = {static_cast<double>(width), static_cast<double>(height), 0.0};
    print.dpi = 25.4;
    print.style.stroke = {pen, false};
    print.style.ground = white;
    print.style.palette = {black, red, blue, green};
    return print;
}

struct Image {
    int width = 0, height = 0, channels = 0;
    Bytes bytes;

    int at(int x, int y, int channel = 0) const {
        return bytes.at((static_cast<std::size_t>(y) * width + x) * channels + channel);
    }
    Colour colour(int x, int y) const {
        const auto byte = [&](int channel) { return static_cast<std::uint8_t>(at(x, y, channel)); };
        if (channels == 1) return {byte(0), byte(0), byte(0), 255};
        return {byte(0), byte(1), byte(2), channels == 4 ? byte(3) : std::uint8_t{255}};
    }
    /// Pixels of black on a white page.
    double ink() const {
        EXPECT_EQ(channels, 1);
        return std::accumulate(bytes.begin(), bytes.end(), 0.0,
                               [](double sum, std::uint8_t byte) { return sum + (255 - byte) / 255.0; });
    }
};

Image render(const Print& print, const std::function<void(PathSink&)>& drawing, int threads = 1) {
    const std::unique_ptr<Raster> raster = make_raster(print);
    drawing(*raster);
    const PixelSize size = pixel_size(print.page, print.dpi);
    Image image{size.width, size.height, raster->channels(), {}};
    raster->render(threads, [&](int first_row, int rows, std::span<const std::uint8_t> pixels) {
        const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
        EXPECT_EQ(image.bytes.size(), row * first_row);
        EXPECT_EQ(pixels.size(), row * rows);
        image.bytes.insert(image.bytes.end(), pixels.begin(), pixels.end());
    });
    EXPECT_EQ(image.bytes.size(), static_cast<std::size_t>(image.width) * image.height * image.channels);
    return image;
}

void stroke(PathSink& sink, const Points& points, Pen pen = {}) {
    sink.begin_stroke(points[0], pen);
    sink.lines(std::span(points).subspan(1));
    sink.end_stroke(points.front() == points.back());
}

Pen coloured(int colour) {
    Pen pen{.colour = colour};
    return pen;
}

double distance_to_line(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const double square = glm::dot(b - a, b - a);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, b - a) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - a - t * (b - a));
}

/// Ink of each pixel, 0 to 255, by 16 x 16 samples in it.
std::vector<double> supersampled(int width, int height, const std::function<bool(glm::dvec2)>& inside) {
    constexpr int samples = 16;
    std::vector<double> result;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            int hits = 0;
            for (int i = 0; i < samples * samples; ++i) {
                hits += inside({x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples});
            }
            result.push_back(255.0 * hits / (samples * samples));
        }
    }
    return result;
}

/// Something of everything, over many bands.
void crowd(PathSink& sink, double width, double height, unsigned seed) {
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto point = [&] { return glm::dvec2(number(-50, width + 50), number(-50, height + 50)); };
    for (int i = 0; i < 60; ++i) {
        Pen pen = coloured(i);
        pen.width = i % 7 == 0 ? 0.2 : number(0.3, 12.0);
        sink.begin_stroke(point(), pen);
        Points near{point()};
        for (int k = 0; k < 20; ++k) near.push_back(near.back() + glm::dvec2(number(-30, 30), number(-30, 30)));
        sink.lines(near);
        sink.polygon(Points{point(), point(), point(), point()}, coloured(i + 1));
        sink.curves(Points{point(), point(), point()});
        sink.disc(point(), i % 3 == 0 ? 0.0 : number(0.1, 40), coloured(i + 2));
        sink.end_stroke(false);
    }
}

TEST(Raster, StrokesAgreeWithSupersampling) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(8, 40);
    for (const double pen : {1.0, 1.5, 2.0, 3.3, 8.0, 14.0}) {
        // Over the pixels that the outline crosses, and over those of them that are not at the ends.
        double sum = 0, sum_of_sides = 0, worst = 0;
        int count = 0, count_of_sides = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::dvec2 a{place(random), place(random)}, b{place(random), place(random)};
            const Image image = render(pixel_print(48, 48, pen), [&](PathSink& sink) { stroke(sink, {a, b}); });
            const auto truth =
                supersampled(48, 48, [&](glm::dvec2 p) { return distance_to_line(p, a, b) <= pen / 2; });
            for (std::size_t pixel = 0; pixel < truth.size(); ++pixel) {
                const double ink = 255 - image.bytes[pixel];
                if ((truth[pixel] == 0 || truth[pixel] == 255) && ink == truth[pixel]) continue;
                const double error = std::fabs(ink - truth[pixel]);
                worst = std::max(worst, error);
                sum += error;
                ++count;
                const glm::dvec2 centre{static_cast<double>(pixel % 48) + 0.5, static_cast<double>(pixel / 48) + 0.5};
                const double along = glm::dot(centre - a, glm::normalize(b - a));
                if (along < 1 || along > glm::length(b - a) - 1) continue;
                sum_of_sides += error;
                ++count_of_sides;
            }
        }
        EXPECT_LE(sum / count, 3) << pen;
        EXPECT_LE(sum_of_sides / count_of_sides, 1.3) << pen;
        EXPECT_LE(worst, pen < 2 ? 50 : 30) << pen;
    }
}

TEST(Raster, AStrokeOfManyShortWideLinesIsTheirUnion) {
    // Wide pens leave pixels to neighbouring segments: no bend may lose any.
    std::mt19937 random(2);
    for (int i = 0; i < 12; ++i) {
        Points points{{40, 40}};
        double heading = 0;
        std::uniform_real_distribution<double> bend(i % 2 ? -3.1 : -0.5, i % 2 ? 3.1 : 0.5), length(0.3, 12);
        for (int k = 0; k < 12; ++k) {
            heading += bend(random);
            points.push_back(points.back() + length(random) * glm::dvec2(std::cos(heading), std::sin(heading)));
        }
        const double pen = 6.0 + 2 * i;
        const Image image = render(pixel_print(80, 80, pen), [&](PathSink& sink) { stroke(sink, points); });
        for (int y = 0; y < 80; ++y) {
            for (int x = 0; x < 80; ++x) {
                double distance = 1e9;
                for (std::size_t k = 1; k < points.size(); ++k) {
                    distance = std::min(distance, distance_to_line({x + 0.5, y + 0.5}, points[k - 1], points[k]));
                }
                const double expected = 255 * std::clamp(pen / 2 + 0.5 - distance, 0.0, 1.0);
                // A slanting edge departs from this by up to 11.
                ASSERT_NEAR(255 - image.at(x, y), expected, 14) << i << ": " << x << ' ' << y;
            }
        }
    }
}

TEST(Raster, TheInkOfAHilbertCurveIsItsArea) {
    const int side = 128;
    for (const double offset : {4.0, 4.3}) {
        const Points points = hilbert_points(side, 8, offset);
        int turns = 0;
        for (std::size_t i = 2; i < points.size(); ++i) {
            turns += points[i] - points[i - 1] != points[i - 1] - points[i - 2];
        }
        // Bars of 8 x 2; a bend has a unit square twice and a quarter of a disc more; the ends are half discs.
        const double exact = 16.0 * (side * side - 1) + turns * (std::numbers::pi / 4 - 1) + std::numbers::pi;
        const Image image = render(pixel_print(1024, 1024, 2), [&](PathSink& sink) { stroke(sink, points); });
        EXPECT_NEAR(image.ink() / exact, 1, offset == 4.0 ? 0.001 : 0.006);
    }
}

TEST(Raster, HairlinesKeepTheirInk) {
    // Upright, flat, slanting and curved, far below a pixel; crossings add up.
    for (const double pen : {0.05, 0.3, 0.7, 0.99}) {
        const Image lines = render(pixel_print(200, 200, pen), [&](PathSink& sink) {
            stroke(sink, {{20.3, 20.7}, {180.3, 20.7}, {180.3, 180.7}, {30.3, 60.7}});
        });
        const double length = 160 + 160 + std::hypot(150, 120);
        EXPECT_NEAR(lines.ink() / (length * pen), 1, pen < 0.1 ? 0.06 : 0.015) << pen;
        const Image curve = render(pixel_print(200, 200, pen), [&](PathSink& sink) {
            constexpr double k = 0.5522847498;
            sink.begin_stroke({180, 100}, Pen{});
            sink.curves(Points{{180, 100 + 80 * k},
                               {100 + 80 * k, 180},
                               {100, 180},
                               {100 - 80 * k, 180},
                               {20, 100 + 80 * k},
                               {20, 100}});
            sink.end_stroke(false);
        });
        EXPECT_NEAR(curve.ink() / (80 * std::numbers::pi * pen), 1, pen < 0.1 ? 0.06 : 0.015) << pen;
    }
    // A curve much finer than the pixels becomes an even grey.
    const Image grey =
        render(pixel_print(64, 64, 0.05), [&](PathSink& sink) { stroke(sink, hilbert_points(512, 0.125, 0.0625)); });
    for (int y = 8; y < 56; ++y) {
        for (int x = 8; x < 56; ++x) ASSERT_NEAR(255 - grey.at(x, y), 255 * 0.05 / 0.125, 6);
    }
}

TEST(Raster, ALineOfOnePixelIsAsDarkOnBothSidesOfTheChange) {
    const auto ink = [](double pen) {
        return render(pixel_print(100, 60, pen),
                      [](PathSink& sink) {
                          stroke(sink, {{10.2, 10.4}, {90.7, 49.1}});
                      })
            .ink();
    };
    EXPECT_NEAR(ink(0.999), ink(1.001), 1.5);
}

TEST(Raster, DotsAndDiscs) {
    const auto area = [](const std::function<void(PathSink&)>& drawing, double pen) {
        return render(pixel_print(60, 60, pen), drawing).ink();
    };
    const auto dot = [](PathSink& sink) { stroke(sink, {{30.2, 30.4}, {30.2, 30.4}}); };
    EXPECT_NEAR(area(dot, 6), 9 * std::numbers::pi, 0.1);
    EXPECT_NEAR(area(dot, 1.2), 0.36 * std::numbers::pi, 0.1);
    EXPECT_NEAR(area(dot, 0.5), std::numbers::pi / 16, 0.01);
    EXPECT_NEAR(area([](PathSink& sink) { sink.disc({30, 30}, 0, Pen{}); }, 5), 25 * std::numbers::pi, 0.3);
    EXPECT_NEAR(area([](PathSink& sink) { sink.disc({30.1, 30.7}, 20, Pen{}); }, 5), 400 * std::numbers::pi, 0.5);
    // In the middle of a stroke and after nothing but a move of no length: no dot of the pen.
    EXPECT_EQ(area([](PathSink& sink) { stroke(sink, {{-40, -40}, {-40, -40}}); }, 5), 0);
    // A huge disc of which the page sees a straight edge.
    const Image edge = render(pixel_print(40, 300, 1), [](PathSink& sink) {
        sink.disc({20 - 1e4, 150}, 1e4, Pen{});
    });
    EXPECT_NEAR(edge.ink(), 20 * 300 - 112.5, 2);  // the arc is 1.1 pixels high
    EXPECT_EQ(edge.at(17, 150), 0);
    EXPECT_EQ(edge.at(22, 150), 255);
}

TEST(Raster, PolygonsCoverTheirExactArea) {
    const Image box = render(pixel_print(30, 20, 1), [](PathSink& sink) {
        sink.polygon(Points{{10.25, 5.5}, {20.5, 5.5}, {20.5, 9.75}, {10.25, 9.75}}, Pen{});
    });
    EXPECT_EQ(255 - box.at(10, 5), std::lround(255 * 0.75 * 0.5));
    EXPECT_EQ(255 - box.at(20, 9), std::lround(255 * 0.5 * 0.75));
    EXPECT_EQ(255 - box.at(15, 5), std::lround(255 * 0.5));
    EXPECT_EQ(255 - box.at(15, 7), 255);
    EXPECT_EQ(255 - box.at(21, 7), 0);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> x(0, 300), y(0, 500);
    for (int i = 0; i < 30; ++i) {
        const glm::dvec2 a{x(random), y(random)}, b{x(random), y(random)}, c{x(random), y(random)};
        const double exact = 0.5 * std::fabs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
        const Image image = render(pixel_print(300, 500, 1), [&](PathSink& sink) {
            sink.polygon(Points{a, b, c}, Pen{});
        });
        EXPECT_NEAR(image.ink(), exact, 1.5);
    }
}

TEST(Raster, PolygonsAreCutAtThePage) {
    const Image all = render(pixel_print(50, 300, 1), [](PathSink& sink) {
        sink.polygon(Points{{-1e6, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {-1e6, 1e6}}, Pen{});
    });
    EXPECT_EQ(all.ink(), 50 * 300);
    const Image half = render(pixel_print(50, 300, 1), [](PathSink& sink) {
        sink.polygon(Points{{-1e5, -1e5}, {1e5, 1e5}, {-1e5, 1e5}}, Pen{});
    });
    EXPECT_NEAR(half.ink(), 50 * 300 - 50 * 50 / 2, 2);
    const Image none = render(pixel_print(50, 300, 1), [](PathSink& sink) {
        sink.polygon(Points{{60, -10}, {90, 150}, {60, 400}}, Pen{});
        sink.polygon(Points{{-60, -10}, {-90, 150}, {-60, 400}}, Pen{});
        sink.polygon(Points{{0, NAN}, {10, 10}, {INFINITY, 3}}, Pen{});
    });
    EXPECT_EQ(none.ink(), 0);
}

TEST(Raster, WindingIsNonZero) {
    // A square within a square, the same way round and the other.
    for (const bool same : {true, false}) {
        const Image image = render(pixel_print(50, 50, 1), [&](PathSink& sink) {
            Points points{{5, 5}, {45, 5}, {45, 45}, {5, 45}, {5, 5}, {15, 15}};
            if (same) {
                points.insert(points.end(), {{35, 15}, {35, 35}, {15, 35}, {15, 15}});
            } else {
                points.insert(points.end(), {{15, 35}, {35, 35}, {35, 15}, {15, 15}});
            }
            sink.polygon(points, Pen{});
        });
        EXPECT_NEAR(image.ink(), same ? 1600 : 1200, 0.2);
        EXPECT_EQ(image.at(25, 25), same ? 0 : 255);
    }
    Points star;
    for (int i = 0; i < 5; ++i)
        star.push_back(
            {25 + 22 * std::sin(i * 4 * std::numbers::pi / 5), 25 - 22 * std::cos(i * 4 * std::numbers::pi / 5)});
    const Image image = render(pixel_print(50, 50, 1), [&](PathSink& sink) { sink.polygon(star, Pen{}); });
    EXPECT_EQ(image.at(25, 25), 0);
    EXPECT_EQ(image.at(25, 10), 0);
    EXPECT_EQ(image.at(8, 40), 255);
}

TEST(Raster, TilesHaveNoSeams) {
    // Red and blue tiles on green, at every angle: where tiles meet, no green.
    for (const bool grounded : {true, false}) {
        for (const double angle : {0.0, 0.1, 0.7854, 1.3}) {
            Print print = pixel_print(200, 200, 1);
            print.style.ground = grounded ? std::optional(green) : std::nullopt;
            const glm::dvec2 u{9.3 * std::cos(angle), 9.3 * std::sin(angle)}, v{-u.y, u.x};
            const Image image = render(print, [&](PathSink& sink) {
                for (int i = -20; i < 20; ++i) {
                    for (int j = -20; j < 20; ++j) {
                        const glm::dvec2 at = glm::dvec2(100, 100) + double(i) * u + double(j) * v;
                        sink.polygon(Points{at, at + u, at + u + v}, coloured(i % 2 ? 1 : 2));
                        sink.polygon(Points{at, at + u + v, at + v}, coloured(i % 2 ? 2 : 1));
                    }
                }
            });
            for (int y = 70; y < 130; ++y) {
                for (int x = 70; x < 130; ++x) {
                    const Colour colour = image.colour(x, y);
                    ASSERT_LE(colour.green, 6) << angle;
                    ASSERT_NEAR(colour.red + colour.blue, 255, 8) << angle;
                    ASSERT_GE(colour.alpha, 250);
                }
            }
        }
    }
}

TEST(Raster, PolygonsLieBelowEachOtherInOrderAndBelowStrokesAndDiscs) {
    Print print = pixel_print(60, 60, 6);
    const Image image = render(print, [](PathSink& sink) {
        sink.disc({50, 10}, 5, coloured(2));
        stroke(sink, {{5, 10}, {55, 10}}, coloured(1));
        stroke(sink, {{30, 2}, {30, 58}}, coloured(0));
        sink.polygon(Points{{0, 0}, {60, 0}, {60, 40}, {0, 40}}, coloured(3));
        sink.polygon(Points{{0, 20}, {60, 20}, {60, 60}, {0, 60}}, coloured(2));
    });
    EXPECT_EQ(image.colour(10, 15), green);
    EXPECT_EQ(image.colour(10, 30), blue);
    EXPECT_EQ(image.colour(10, 10), red);
    EXPECT_EQ(image.colour(30, 50), black);
    EXPECT_EQ(image.colour(30, 10), red);  // the later colour of the palette, whatever came first
    EXPECT_EQ(image.colour(50, 10), blue);
}

TEST(Raster, ATranslucentColourIsLaidOnOnce) {
    Print print = pixel_print(60, 60, 8);
    print.style.palette = {Colour{0, 0, 0, 128}};
    const Image image = render(print, [](PathSink& sink) {
        stroke(sink, {{5, 30}, {55, 30}});
        stroke(sink, {{30, 5}, {30, 55}, {30, 5}});
        Pen wide{.width = 1.5};
        stroke(sink, {{5, 5}, {55, 55}}, wide);
        sink.disc({10, 50}, 5, Pen{});
        sink.disc({12, 50}, 5, Pen{});
    });
    EXPECT_EQ(image.at(30, 30), 127);
    EXPECT_EQ(image.at(10, 30), 127);
    EXPECT_EQ(image.at(11, 50), 127);
    EXPECT_EQ(*std::min_element(image.bytes.begin(), image.bytes.end()), 127);
}

TEST(Raster, ChannelsAreAsFewAsTheColoursUsedAllow) {
    Print print = pixel_print(20, 20, 2);
    const auto channels = [&](const std::function<void(PathSink&)>& drawing) {
        return render(print, drawing).channels;
    };
    const auto line = [](int colour) {
        return [colour](PathSink& sink) { stroke(sink, {{2, 2}, {18, 18}}, coloured(colour)); };
    };
    EXPECT_EQ(channels([](PathSink&) {}), 1);
    EXPECT_EQ(channels(line(0)), 1);
    EXPECT_EQ(channels(line(1)), 3);
    EXPECT_EQ(channels([](PathSink& sink) { sink.disc({5, 5}, 2, coloured(1)); }), 3);
    EXPECT_EQ(channels([](PathSink& sink) { sink.polygon(Points{{1, 1}, {9, 1}, {5, 5}}, coloured(1)); }), 3);
    print.style.ground = green;
    EXPECT_EQ(channels(line(0)), 3);
    print.style.ground = std::nullopt;
    EXPECT_EQ(channels(line(0)), 4);
    print.style.ground = Colour{255, 255, 255, 100};
    EXPECT_EQ(channels(line(0)), 4);
}

TEST(Raster, WithoutGroundAlphaIsStraight) {
    Print print = pixel_print(60, 60, 3);
    print.style.ground = std::nullopt;
    const Image image = render(print, [](PathSink& sink) {
        stroke(sink, {{5, 7.2}, {55, 31.9}}, coloured(1));
        sink.polygon(Points{{5.5, 40.5}, {20, 40.5}, {20, 50}, {5.5, 50}}, coloured(2));
    });
    bool partial = false;
    for (int y = 0; y < 35; ++y) {
        for (int x = 0; x < 60; ++x) {
            const Colour colour = image.colour(x, y);
            if (colour.alpha == 0) continue;
            partial = partial || colour.alpha < 255;
            ASSERT_TRUE(near(colour, red, 0));
        }
    }
    EXPECT_TRUE(partial);
    EXPECT_EQ(image.colour(0, 0).alpha, 0);
    EXPECT_EQ(image.colour(10, 45), blue);
    EXPECT_EQ(image.colour(10, 40), (Colour{0, 0, 255, 128}));
}

TEST(Raster, StrokeNoneLeavesFillsOnly) {
    Print print = pixel_print(40, 40, 4);
    print.style.stroked = false;
    const Image image = render(print, [](PathSink& sink) {
        stroke(sink, {{2, 5}, {38, 5}});
        sink.polygon(Points{{10, 10}, {20, 10}, {20, 20}, {10, 20}}, Pen{});
    });
    EXPECT_EQ(image.ink(), 100);
}

TEST(Raster, LinesFarOutsideLeaveThePageAlone) {
    const Image image = render(pixel_print(100, 400, 2), [](PathSink& sink) {
        stroke(sink, {{-1e9, 200}, {1e9, 200}, {1e9, 1e9}, {1e9, 100}, {-1e9, 100}});
        stroke(sink, {{50, -1e11}, {50, 1e11}});
        stroke(sink, {{NAN, 3}, {20, 20}});
        stroke(sink, {{-50, -50}, {-10, 1e8}});
    });
    // Two rows and one column of 2 pixels.
    EXPECT_NEAR(image.ink(), 2 * 100 * 2 + 2 * 400 - 2 * 4, 3);
}

TEST(Raster, AChangeOfPenGoesOnFromWhereTheLineIs) {
    const Image image = render(pixel_print(60, 20, 2), [](PathSink& sink) {
        Pen wide{.width = 5};
        sink.begin_stroke({5, 10}, Pen{});
        sink.lines(Points{{30, 10}});
        sink.change_pen(wide);
        sink.lines(Points{{50, 10}});
        sink.end_stroke(false);
    });
    EXPECT_EQ(image.at(15, 13), 255);
    EXPECT_EQ(image.at(40, 13), 0);
    EXPECT_NEAR(image.ink(), 25 * 2 + 20 * 10 + std::numbers::pi * 25 - 5 * 2 + std::numbers::pi / 2, 1);
}

TEST(Raster, WhatIsHiddenOfAClosedStrokeStaysHidden) {
    Print print = pixel_print(60, 60, 2);
    print.style.palette[0].alpha = 0;
    const Image image = render(print, [](PathSink& sink) { draw_square(sink, Pen{}, coloured(1)); });
    EXPECT_EQ(image.colour(10, 30), white);
    EXPECT_EQ(image.colour(50, 30), red);
    EXPECT_EQ(image.colour(30, 50), red);
    EXPECT_EQ(image.colour(30, 10), red);
}

TEST(Raster, CurvesAreAsTheyShouldBe) {
    const glm::dvec2 a{20, 300}, b{60, -200}, c{400, 700}, d{480, 100};
    const Image image = render(pixel_print(500, 500, 4), [&](PathSink& sink) {
        sink.begin_stroke(a, Pen{});
        sink.curves(Points{b, c, d});
        sink.end_stroke(false);
    });
    // Against a thousand chords, with the radius of the flattening's tolerance.
    Points chords;
    for (int i = 0; i <= 1000; ++i) {
        const double t = i / 1000.0, s = 1 - t;
        chords.push_back(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
    }
    const Image fine = render(pixel_print(500, 500, 4), [&](PathSink& sink) { stroke(sink, chords); });
    int worst = 0;
    for (std::size_t i = 0; i < image.bytes.size(); ++i)
        worst = std::max(worst, std::abs(image.bytes[i] - fine.bytes[i]));
    EXPECT_LE(worst, 255 * 0.06);
}

TEST(Raster, TheBytesDoNotDependOnTheThreads) {
    for (const bool grounded : {true, false}) {
        Print print = pixel_print(333, 1100, 1);
        if (!grounded) print.style.ground = std::nullopt;
        const auto drawing = [](PathSink& sink) { crowd(sink, 333, 1100, 4); };
        const Image one = render(print, drawing, 1);
        EXPECT_GT(std::count_if(one.bytes.begin(), one.bytes.end(), [](auto byte) { return byte != 255; }), 10'000);
        for (const int threads : {2, 5, 0}) EXPECT_EQ(render(print, drawing, threads).bytes, one.bytes) << threads;
    }
}

TEST(Raster, TheSameDrawingTwiceFromOneRaster) {
    const Print print = pixel_print(333, 700, 1);
    const std::unique_ptr<Raster> raster = make_raster(print);
    crowd(*raster, 333, 700, 5);
    std::array<Bytes, 2> bytes;
    for (Bytes& target : bytes) {
        raster->render(2, [&](int, int, std::span<const std::uint8_t> pixels) {
            target.insert(target.end(), pixels.begin(), pixels.end());
        });
    }
    EXPECT_EQ(bytes[0], bytes[1]);
}

TEST(Raster, AFailureOfTheSinkComesBack) {
    const Print print = pixel_print(100, 1500, 1);
    for (const int threads : {1, 3}) {
        const std::unique_ptr<Raster> raster = make_raster(print);
        int calls = 0;
        const auto sink = [&](int, int, std::span<const std::uint8_t>) {
            if (++calls == 3) throw std::runtime_error("disk full");
        };
        EXPECT_THROW(raster->render(threads, sink), std::runtime_error);
        EXPECT_EQ(calls, 3);
    }
}

TEST(Raster, WidePages) {
    // The last pixels of 60,000 are as exact as the first.
    const auto part = [](double x) {
        const Image image = render(pixel_print(60'000, 40, 2), [&](PathSink& sink) {
            stroke(sink, {{x + 3.3, 5.2}, {x + 20.1, 33.9}});
            sink.polygon(Points{{x + 30.3, 5.2}, {x + 45.1, 13.9}, {x + 31.7, 30.2}}, Pen{});
        });
        Bytes bytes;
        for (int y = 0; y < 40; ++y) {
            const auto row = image.bytes.begin() + y * 60'000 + static_cast<int>(x);
            bytes.insert(bytes.end(), row, row + 50);
        }
        return bytes;
    };
    EXPECT_EQ(part(0), part(59'950));
    EXPECT_THROW(make_raster(pixel_print(600'000, 10, 1)), std::runtime_error);
}

TEST(Raster, PixelSizeIsRounded) {
    const PixelSize a4 = pixel_size({210, 297, 0}, 300);
    EXPECT_EQ(a4.width, 2480);
    EXPECT_EQ(a4.height, 3508);
    EXPECT_EQ(pixel_size({0.01, 0.01, 0}, 10).width, 1);
}

TEST(Stroke, EveryKernelGivesTheSameBytes) {
    constexpr int width = 307, rows = 96;
    std::vector<Simd> others;
    if (best_simd() != Simd::scalar) others.push_back(Simd::sse2);
    if (best_simd() == Simd::avx2) others.push_back(Simd::avx2);
    for (unsigned seed = 0; seed < 60; ++seed) {
        const auto drawn = [&](Simd simd) {
            Bytes bytes((width + mask_padding) * (rows + 1));
            Stroker stroker({bytes.data(), width + mask_padding, width, rows}, 64, simd);
            std::mt19937 random(seed);
            const auto number = [&](int low, int high) {
                return std::uniform_int_distribution<int>(low, high)(random);
            };
            for (int i = 0; i < 30; ++i) {
                stroker.pen(seed % 3 == 0 ? 0.5f + 0.001f * static_cast<float>(number(0, 2000))
                                          : 0.1f * static_cast<float>(number(5, 400)));
                SubPoint at{number(-20'000, 340'000), number(60'000, 170'000)};
                stroker.move(at);
                for (int k = 0; k < 12; ++k) {
                    const int reach = number(0, 1) ? 4'000 : 200'000;
                    at = {at.x + number(-reach, reach), at.y + number(0, 3) ? number(-reach, reach) + 100'000 : at.y};
                    stroker.line(at);
                }
            }
            stroker.finish();
            Bytes visible;
            for (int row = 0; row < rows; ++row) {
                const auto line = bytes.begin() + row * (width + mask_padding);
                visible.insert(visible.end(), line, line + width);
            }
            return visible;
        };
        const Bytes reference = drawn(Simd::scalar);
        for (const Simd simd : others) ASSERT_EQ(drawn(simd), reference) << seed << ' ' << static_cast<int>(simd);
    }
}

TEST(Blend, EveryKernelGivesTheSameBytes) {
    constexpr int width = 301, rows = 7;
    std::mt19937 random(6);
    for (const int channels : {1, 3, 4}) {
        for (const int alpha : {255, 254, 128, 1}) {
            Bytes coverage((width + mask_padding) * (rows + 1));
            for (auto& byte : coverage) byte = random() % 3 ? static_cast<std::uint8_t>(random()) : 0;
            const auto blended = [&](Simd simd) {
                Bytes bytes = coverage;
                Mask mask{bytes.data(), width + mask_padding, width, rows};
                Canvas canvas(width, rows, channels, simd);
                canvas.clear({200, 100, 7, 255}, rows);
                canvas.blend(mask, {3, 250, 99, static_cast<std::uint8_t>(alpha)});
                EXPECT_TRUE(std::all_of(bytes.begin(), bytes.begin() + (width + mask_padding) * rows,
                                        [](auto byte) { return byte == 0; }));
                return Bytes(canvas.pixels().begin(), canvas.pixels().end());
            };
            EXPECT_EQ(blended(best_simd()), blended(Simd::scalar)) << channels << ' ' << alpha;
        }
    }
}

TEST(Fill, AnEdgeOnTheBorderStaysInside) {
    AreaFill fill(16, 4);
    const auto box = [&](double left, double top, double right, double bottom) {
        fill.edge(left, top, left, bottom);
        fill.edge(left, bottom, right, bottom);
        fill.edge(right, bottom, right, top);
        fill.edge(right, top, left, top);
    };
    for (int round = 0; round < 2; ++round) {  // nothing may stay from the first time
        box(-3, -2, 16, 9);
        double area = 0;
        fill.sweep([&](int row, int first, int end, int coverage) {
            EXPECT_GE(row, 0);
            EXPECT_LT(row, 4);
            EXPECT_LE(end, 16);
            EXPECT_LT(first, end);
            area += (end - first) * coverage / 255.0;
        });
        EXPECT_EQ(area, 64);
    }
}

TEST(Raster, AWatcherMayStopItWithinABand) {
    struct Stop : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    const Print print = pixel_print(64, 64, 2.0);
    const auto raster = make_raster(print);
    raster->begin_stroke({1, 1}, {});
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec2 end{i % 2 == 0 ? 60.0 : 1.0, 1.0 + i % 50};
        raster->lines({&end, 1});
    }
    raster->end_stroke(false);
    int calls = 0;
    raster->watch([&] {
        if (++calls == 5) throw Stop("stop");
    });
    EXPECT_THROW(raster->render(1, [](int, int, std::span<const std::uint8_t>) { FAIL() << "no band is whole"; }),
                 Stop);
}

}  // namespace sikku::raster_test
