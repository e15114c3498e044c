#include "art/plotter/plot.h"

#include "tests/hilbert.h"
#include "tests/plot_tools.h"

#include <map>
#include <random>
#include <set>
#include <tuple>

namespace sikku::plot_test {

using Points = std::vector<glm::dvec2>;
using reference::Line;
using reference::Recorder;

/// One turtle step is a millimetre, (0, 0) is where the plotter begins.
Print large_print() {
    Print print = plain_print();
    print.page = {1000.0, 1000.0, 0.0};
    print.placement.to_page[2] = {0.0, 1000.0};
    return print;
}

void stroke(PathSink& sink, const Points& points, const Pen& pen = {}) {
    sink.begin_stroke(points.front(), pen);
    sink.lines(std::span(points).subspan(1));
    sink.end_stroke(points.front() == points.back());
}

std::vector<Line> drawn(const PlotPlan& plan) {
    Recorder recorder;
    plan.draw(recorder);
    for (const Line& line : recorder.strokes) {
        EXPECT_TRUE(
            std::all_of(line.pens.begin(), line.pens.end(), [&](const Pen& pen) { return pen == line.pens[0]; }));
        EXPECT_TRUE(!line.closed || line.points.front() == line.points.back());
    }
    return recorder.strokes;
}

/// A number for each place, by rounding: an independent way to what the plan does with a table.
std::pair<long, long> place(glm::dvec2 point) {
    return {std::lround(point.x * 1e6), std::lround(point.y * 1e6)};
}

/// Pen and control points of every segment, the smaller end first.
using Key = std::pair<int, std::vector<std::pair<long, long>>>;
std::vector<Key> segments(const std::vector<Line>& lines) {
    std::vector<Key> keys;
    for (const Line& line : lines) {
        const std::size_t stride = (line.points.size() - 1) / line.pens.size();
        EXPECT_TRUE(stride == 1 || stride == 3) << "lines and curves in one stroke";
        for (std::size_t i = 0; i < line.pens.size(); ++i) {
            Key& key = keys.emplace_back(line.pens[i].colour, std::vector<std::pair<long, long>>());
            for (std::size_t k = 0; k <= stride; ++k) key.second.push_back(place(line.points[stride * i + k]));
            std::vector<std::pair<long, long>> back(key.second.rbegin(), key.second.rend());
            key.second = std::min(key.second, back);
        }
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

/// As many strokes as a graph needs: for each pen and component one, or half its points of odd degree.
std::size_t fewest_strokes(const std::vector<Key>& keys) {
    using Node = std::pair<int, std::pair<long, long>>;
    std::map<Node, std::size_t> degree;
    std::map<Node, Node> parent;
    const auto root = [&](Node node) {
        while (parent.try_emplace(node, node).first->second != node) node = parent[node];
        return node;
    };
    for (const auto& [pen, points] : keys) {
        const Node from{pen, points.front()};
        const Node to{pen, points.back()};
        ++degree[from];
        ++degree[to];
        parent[root(from)] = root(to);
    }
    std::map<Node, std::size_t> odd;
    for (const auto& [node, count] : degree) odd[root(node)] += count % 2;
    std::size_t sum = 0;
    for (const auto& [component, count] : odd) sum += std::max<std::size_t>(1, count / 2);
    return sum;
}

/// Everything that must hold of any plan: what was drawn is there, once; the report is true.
void expect_sound(const PlotPlan& plan, const std::vector<Line>& given, const Print& print) {
    const std::vector<Line> lines = drawn(plan);
    std::vector<Key> expected = segments(given);
    EXPECT_EQ(plan.report().segments, expected.size());
    if (plan.report().duplicates > 0) expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(plan.report().segments - plan.report().duplicates, expected.size());
    EXPECT_EQ(segments(lines), expected);
    EXPECT_EQ(plan.report().after.lifts, lines.size());
    EXPECT_EQ(plan.report().before.lifts, given.size());

    const auto length = [](const Line& line) {
        const std::size_t stride = (line.points.size() - 1) / line.pens.size();
        double sum = 0;
        for (std::size_t i = 0; i + stride < line.points.size(); i += stride) {
            Samples samples(0.01);
            samples.start(line.points[i]);
            if (stride == 1) samples.line(line.points[i + 1]);
            if (stride == 3) samples.curve(line.points[i + 1], line.points[i + 2], line.points[i + 3]);
            for (std::size_t k = 1; k < samples.points.size(); ++k) {
                sum += glm::distance(samples.points[k - 1], samples.points[k]);
            }
        }
        return sum;
    };
    double down = 0;
    double up = 0;
    std::vector<PlotTravel> travels = plan.travels();
    glm::dvec2 at = travels.empty() ? lines.front().points.front() : travels.front().from;
    std::size_t next = 0;
    int pen = -1;
    for (const Line& line : lines) {
        EXPECT_GE(line.pens[0].colour, pen) << "pen after pen";
        pen = line.pens[0].colour;
        down += length(line);
        if (line.points.front() != at) {
            EXPECT_EQ(travels.at(next).from, at);
            EXPECT_EQ(travels.at(next).to, line.points.front());
            ++next;
        }
        up += glm::distance(at, line.points.front());
        at = line.points.back();
    }
    EXPECT_EQ(next, travels.size());
    const double step = print.placement.step;
    EXPECT_NEAR(plan.report().after.drawn, down * step, 1e-4 * down * step);
    EXPECT_NEAR(plan.report().after.travelled, up * step, 1e-9 * up * step);
    EXPECT_LE(plan.report().after.travelled, plan.report().before.travelled * (1 + 1e-12));
    EXPECT_LE(plan.report().after.lifts, plan.report().before.lifts);
}

/// The segments of a square grid one by one, in random order and directions, some of them twice or three times.
std::vector<Line> grid(int columns, int rows, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Line> lines;
    const auto add = [&](glm::dvec2 from, glm::dvec2 to) {
        for (auto copies = 1 + random() % 3; copies > 0; --copies) {
            lines.push_back({random() % 2 == 0 ? Points{from, to} : Points{to, from}, {Pen{}}, false});
        }
    };
    for (int x = 0; x <= columns; ++x) {
        for (int y = 0; y <= rows; ++y) {
            if (x < columns) add({x, y}, {x + 1, y});
            if (y < rows) add({x, y}, {x, y + 1});
        }
    }
    std::shuffle(lines.begin(), lines.end(), random);
    return lines;
}

TEST(Plot, AGridTakesAsFewStrokesAsEulerAllows) {
    const Print print = large_print();
    for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 1}, {2, 2}, {5, 3}, {20, 30}}) {
        const auto given = grid(columns, rows, 3);
        const auto plan = arranged(print, [&](PathSink& sink) {
            for (const Line& line : given) stroke(sink, line.points);
        });
        expect_sound(*plan, given, print);
        const auto odd = static_cast<std::size_t>(2 * (columns - 1) + 2 * (rows - 1));
        EXPECT_EQ(plan->report().after.lifts, std::max<std::size_t>(1, odd / 2));
    }
}

TEST(Plot, GridsGoStraightOn) {
    // Where nothing has to be merged, each line of the grid is a stroke.
    const Print print = large_print();
    const auto plan = arranged(print, [&](PathSink& sink) {
        for (const Line& line : grid(6, 6, 5)) {
            const glm::dvec2 a = line.points[0];
            const glm::dvec2 b = line.points[1];
            const bool border = a.x == b.x ? a.x == 0 || a.x == 6 : a.y == 0 || a.y == 6;
            if (!border) stroke(sink, line.points);
        }
    });
    const auto lines = drawn(*plan);
    EXPECT_EQ(lines.size(), 10u);
    for (const Line& line : lines) {
        EXPECT_EQ(line.points.size(), 7u);
        EXPECT_EQ(glm::distance(line.points.front(), line.points.back()), 6.0);
    }
}

TEST(Plot, RandomGraphs) {
    std::mt19937 random(17);
    const Print print = large_print();
    for (int round = 0; round < 300; ++round) {
        const int side = 2 + static_cast<int>(random() % 6);
        const int count = 1 + static_cast<int>(random() % 60);
        std::vector<Line> given;
        for (int i = 0; i < count; ++i) {
            Line line;
            Pen pen{.colour = static_cast<int>(random() % (1 + round % 2))};
            const int length = 1 + static_cast<int>(random() % 4);
            for (int k = 0; k <= length; ++k) {
                const int x = static_cast<int>(random()) % side;
                line.points.emplace_back(x, static_cast<int>(random()) % side);
                if (k > 0) line.pens.push_back(pen);
            }
            given.push_back(line);
        }
        const auto plan = arranged(print, [&](PathSink& sink) {
            for (const Line& line : given) stroke(sink, line.points, line.pens[0]);
        });
        const auto lines = drawn(*plan);
        EXPECT_EQ(segments(lines).size(), plan->report().segments - plan->report().duplicates);
        EXPECT_EQ(lines.size(), fewest_strokes(segments(lines))) << round;
        // Nothing is left out of a pen's lines if that would take more strokes than were drawn.
        std::vector<Key> expected;
        for (int colour = 0; colour < 2; ++colour) {
            std::vector<Line> of_pen;
            for (const Line& line : given) {
                if (line.pens[0].colour == colour) of_pen.push_back(line);
            }
            std::vector<Key> all = segments(of_pen);
            std::vector<Key> once = all;
            once.erase(std::unique(once.begin(), once.end()), once.end());
            const auto& kept = fewest_strokes(once) > of_pen.size() ? all : once;
            expected.insert(expected.end(), kept.begin(), kept.end());
        }
        EXPECT_EQ(segments(lines), expected);
    }
}

TEST(Plot, ALineThatGoesBackOverItselfStaysOne) {
    const PlacedPattern curve("curves/koch-sequence-c", -1, {210, 297, 10});
    Recorder recorder;
    curve.read(recorder);
    const auto plan = arranged(curve.print, [&](PathSink& sink) { curve.read(sink); });
    expect_sound(*plan, recorder.strokes, curve.print);
    EXPECT_EQ(drawn(*plan).size(), 1u);
}

TEST(Plot, TilingsAreDrawnOnce) {
    for (const char* name : {"tilings/hexagonal-tiling", "tilings/spiral-tiling"}) {
        const PlacedPattern tiling(name, -1, {210, 297, 10});
        {
            const auto plan = arranged(tiling.print, [&](PathSink& sink) { tiling.read(sink); });
            Recorder recorder;
            tiling.read(recorder);
            const std::vector<int> slots = tiling.print.style.line_slots();
            const auto slot = [&](const Pen& pen) {
                return slots[static_cast<std::size_t>(tiling.print.style.index(pen))];
            };
            std::set<std::tuple<int, std::pair<long, long>, std::pair<long, long>>> expected;
            std::set<std::pair<std::pair<long, long>, std::pair<long, long>>> edges;  // edges drawn with any pen
            std::uint64_t count = 0;
            const auto add = [&](const Pen& pen, glm::dvec2 a, glm::dvec2 b, bool is_outline) {
                const auto edge = std::pair(std::min(place(a), place(b)), std::max(place(a), place(b)));
                if (!edges.insert(edge).second && is_outline) return;
                ++count;
                expected.emplace(slot(pen), edge.first, edge.second);
            };
            for (const Line& line : recorder.strokes) {
                for (std::size_t i = 0; i < line.pens.size(); ++i) {
                    add(line.pens[i], line.points[i], line.points[i + 1], false);
                }
            }
            for (const auto& polygon : recorder.polygons) {
                const std::size_t size = polygon.vertices.size();
                for (std::size_t i = 0; i < size; ++i) {
                    add(polygon.pen, polygon.vertices[i], polygon.vertices[(i + 1) % size], true);
                }
            }
            EXPECT_EQ(plan->report().segments, count) << name;
            EXPECT_EQ(plan->report().segments - plan->report().duplicates, expected.size()) << name;
            EXPECT_GT(plan->report().duplicates, 0u);
            const auto lines = drawn(*plan);
            EXPECT_EQ(segments(lines).size(), expected.size());
            EXPECT_EQ(lines.size(), fewest_strokes(segments(lines)));
            // Not always less travelled: a line that is drawn again may lead to the next stroke.
            EXPECT_LT(plot_seconds(plan->report().after, {}), plot_seconds(plan->report().before, {}));
            EXPECT_LT(plan->report().after.lifts, plan->report().before.lifts);
        }
    }
}

TEST(Plot, AKolamStaysItsLine) {
    for (const auto& [name, closed] : {std::pair{"kolams/snake-kolam", true}, {"kolams/anklets-of-krishna", true}}) {
        const PlacedPattern kolam(name, -1, {210, 297, 10});
        Recorder recorder;
        kolam.read(recorder);
        const auto plan = arranged(kolam.print, [&](PathSink& sink) { kolam.read(sink); });
        const auto lines = drawn(*plan);
        ASSERT_EQ(recorder.strokes.size(), 1u);
        ASSERT_EQ(lines.size(), 1u) << name;
        EXPECT_EQ(lines[0].closed, closed);
        expect_sound(*plan, recorder.strokes, kolam.print);
        // The same curves in the same cyclic order, perhaps the other way round.
        Points expected(recorder.strokes[0].points.begin() + 1, recorder.strokes[0].points.end());
        Points found(lines[0].points.begin() + 1, lines[0].points.end());
        ASSERT_EQ(found.size(), expected.size());
        const auto same = [&] {
            for (std::size_t shift = 0; shift < expected.size(); shift += 3) {
                std::size_t i = 0;
                while (i < found.size() && glm::distance(found[i], expected[(i + shift) % found.size()]) < 1e-9) ++i;
                if (i == found.size()) return true;
            }
            return false;
        };
        bool is_same = same();
        if (!is_same) {
            std::reverse(expected.begin(), expected.end());
            std::rotate(expected.begin(), expected.begin() + 1, expected.end());
            is_same = same();
        }
        EXPECT_TRUE(is_same) << name;
    }
}

TEST(Plot, CurvesAreLedIntoEachOtherOnlyWhereTheyStaySmooth) {
    const Print print = large_print();
    // Two circles of four quarters each that cross at right angles in two of their points.
    const double k = 0.5522847498;
    const auto circle = [&](PathSink& sink, glm::dvec2 centre, bool shuffled) {
        Points around = {{1, 0},   {1, k},   {k, 1},  {0, 1},  {-k, 1}, {-1, k}, {-1, 0},
                         {-1, -k}, {-k, -1}, {0, -1}, {k, -1}, {1, -k}, {1, 0}};
        for (glm::dvec2& point : around) point = 10.0 * point + centre;
        for (const std::size_t quarter : {3U, 1U, 2U, 0U}) {
            const std::size_t at = shuffled ? 3 * quarter : 0;
            sink.begin_stroke(around[at], Pen{});
            sink.curves(std::span(around).subspan(at + 1, shuffled ? 3 : 12));
            sink.end_stroke(!shuffled);
            if (!shuffled) break;
        }
    };
    for (const bool shuffled : {false, true}) {
        const auto crossing = arranged(print, [&](PathSink& sink) {
            circle(sink, {20, 20}, shuffled);
            circle(sink, {30, 30}, shuffled);
        });
        EXPECT_EQ(drawn(*crossing).size(), 2u);
        // They touch: one can go on smoothly into the other.
        const auto touching = arranged(print, [&](PathSink& sink) {
            circle(sink, {20, 20}, shuffled);
            circle(sink, {40, 20}, shuffled);
        });
        EXPECT_EQ(drawn(*touching).size(), 1u);
        EXPECT_TRUE(drawn(*touching)[0].closed);
        EXPECT_EQ(drawn(*touching)[0].pens.size(), 8u);
    }
    // As squares they are led into each other.
    const auto squares = arranged(print, [&](PathSink& sink) {
        stroke(sink, {{20, 20}, {30, 20}, {30, 30}, {20, 30}, {20, 20}});
        stroke(sink, {{30, 30}, {40, 30}, {40, 40}, {30, 40}, {30, 30}});
    });
    EXPECT_EQ(drawn(*squares).size(), 1u);
}

TEST(Plot, PointsThatAddUpDifferentlyAreOne) {
    // An angle that no lattice fits: the turtle comes back beside where it was, by rounding.
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern(
        "test", "axiom: A\nderivation length: 7\nangle increment: 52.34\nA --> FFF++A--FFF\n", diagnostics);
    const Grammar grammar = compile_grammar(pattern, diagnostics);
    diagnostics.throw_if_errors();
    Print print = large_print();
    WordDrawing drawing(grammar, print.style, {}, {});
    drawing.place(print);
    Recorder recorder;
    drawing.read(print, recorder);
    const double length = 1.7;
    const auto plan = arranged(print, [&](PathSink& sink) {
        drawing.read(print, sink);
        for (Line line : recorder.strokes) {
            for (glm::dvec2& point : line.points) point = (point * length + 0.1) / length - 0.1 / length;
            std::reverse(line.points.begin(), line.points.end());
            stroke(sink, line.points);
        }
    });
    EXPECT_EQ(plan->report().duplicates * 2, plan->report().segments);
    // A billionth is little: what is a millionth apart are two lines.
    const auto two = arranged(print, [](PathSink& sink) {
        stroke(sink, {{0, 0}, {10, 0}});
        stroke(sink, {{0, 1e-5}, {10, 1e-5}});
        stroke(sink, {{10, -1e-9}, {1e-9, -0.0}});
    });
    EXPECT_EQ(two->report().duplicates, 1u);
    EXPECT_EQ(two->report().after.lifts, 2u);
}

TEST(Plot, PensAreThoseOfTheStyle) {
    Print print = large_print();
    print.style.palette.push_back(print.style.palette[0]);  // index 3 looks like 0
    print.style.palette.push_back(Colour{9, 9, 9, 0});      // 4 is not seen
    const auto plan = arranged(print, [](PathSink& sink) {
        sink.begin_stroke({5, 5}, Pen{.colour = 2});
        sink.lines(Points{{5, 15}});
        sink.change_pen(Pen{.width = 0.5, .colour = 3});
        sink.lines(Points{{15, 15}});
        sink.change_pen(Pen{.colour = 4});
        sink.lines(Points{{25, 15}});
        sink.change_pen(Pen{.colour = 5});
        sink.lines(Points{{35, 15}});
        sink.change_pen(Pen{.width = 2, .colour = -4});  // 1
        sink.lines(Points{{35, 25}});
        sink.end_stroke(false);
        sink.polygon(Points{{1, 1}, {2, 1}, {2, 2}}, Pen{.colour = 1});
        sink.polygon(Points{{1, 1}, {2, 1}, {2, 2}}, Pen{.colour = 4});
    });
    std::map<int, std::size_t> strokes;
    for (const Line& line : drawn(*plan)) ++strokes[line.pens[0].colour];
    EXPECT_EQ(strokes, (std::map<int, std::size_t>{{0, 2}, {1, 2}, {2, 1}}));
    EXPECT_EQ(plan->report().before.lifts, 5u);
}

TEST(Plot, ADotIsACircleThatThePenFills) {
    const Print print = large_print();  // the pen is 2 mm wide
    const auto plan = arranged(print, [](PathSink& sink) {
        sink.disc({30, 30}, 0.0, Pen{});
        sink.disc({60, 30}, 0.5, Pen{.colour = 1});
    });
    const auto lines = drawn(*plan);
    ASSERT_EQ(lines.size(), 2u);
    for (const auto& [line, centre, radius] :
         {std::tuple{lines[0], glm::dvec2(30, 30), 1.0}, {lines[1], glm::dvec2(60, 30), 0.125}}) {
        EXPECT_TRUE(line.closed);
        Samples samples(0.01);
        samples.start(line.points[0]);
        for (std::size_t i = 1; i + 2 < line.points.size(); i += 3) {
            samples.curve(line.points[i], line.points[i + 1], line.points[i + 2]);
        }
        for (const glm::dvec2 point : samples.points) {
            ASSERT_NEAR(glm::distance(point, centre), radius, 1e-5 * radius);
        }
    }
    EXPECT_NEAR(plan->report().after.drawn, 2 * std::numbers::pi * 1.125, 1e-3);
}

TEST(Plot, StrokesOfManyKindsAreSoundAndTheSameEachTime) {
    const Print print = plain_print();
    std::mt19937 random(23);
    std::uniform_real_distribution<double> x(0, 100);
    std::uniform_real_distribution<double> y(0, 60);
    std::vector<Line> given;
    for (int i = 0; i < 400; ++i) {
        const glm::dvec2 at(x(random), y(random));
        Line line{{at}, {}, false};
        const bool is_curve = i % 3 == 0;
        const bool is_loop = i % 5 == 0;
        for (int k = 0; k < 6; ++k) line.points.push_back(at + glm::dvec2(x(random), y(random)) * 0.02);
        if (is_loop) line.points.back() = at;
        line.pens.resize(is_curve ? 2 : 6);
        for (Pen& pen : line.pens) pen.colour = i % 2;
        given.push_back(line);
    }
    const auto draw_all = [&](PathSink& sink) {
        for (const Line& line : given) {
            sink.begin_stroke(line.points[0], line.pens[0]);
            const auto rest = std::span(line.points).subspan(1);
            line.pens.size() == 2 ? sink.curves(rest) : sink.lines(rest);
            sink.end_stroke(false);
        }
    };
    const auto plan = arranged(print, draw_all);
    expect_sound(*plan, given, print);
    EXPECT_EQ(plan->report().after.lifts, 400u);
    EXPECT_LT(plan->report().after.travelled, 0.15 * plan->report().before.travelled);
    const auto first = drawn(*plan);
    const auto second = drawn(*arranged(print, draw_all));
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].points, second[i].points);
}

TEST(Plot, AnOrderThatIsGoodIsKept) {
    // Nearest neighbours would go astray: each next one is a bit farther, to the other side.
    const Print print = large_print();
    const auto plan = arranged(print, [](PathSink& sink) {
        for (int i = 0; i < 40; ++i) stroke(sink, {{10.0 * i, 100}, {10.0 * i + 9, 100}});
    });
    EXPECT_NEAR(plan->report().before.travelled, 100 + 39, 1e-9);
    EXPECT_NEAR(plan->report().after.travelled, 100 + 39, 1e-9);
}

TEST(Plot, LongStrokesAreSplit) {
    const Print print = large_print();
    const Points points = hilbert_points(16);
    const auto draw_it = [&](PathSink& sink) { stroke(sink, points); };
    for (const double split : {0.5, 1.0, 10.0, 10.5, 254.0, 255.0, 1000.0}) {
        PlotOptions options;
        options.split = split;
        const auto plan = arranged(print, draw_it, options);
        const auto lines = drawn(*plan);
        const double each = std::max(1.0, std::floor(split));
        EXPECT_EQ(lines.size(), static_cast<std::size_t>(std::ceil(255 / each))) << split;
        Points joined = {lines[0].points[0]};
        for (const Line& line : lines) {
            EXPECT_EQ(line.points.front(), joined.back());
            EXPECT_LE(line.pens.size(), each);
            joined.insert(joined.end(), line.points.begin() + 1, line.points.end());
        }
        EXPECT_EQ(joined.size(), points.size());
        EXPECT_EQ(plan->report().after.lifts, lines.size());
        EXPECT_LE(plan->travels().size(), 1u);
    }
    for (const double split : {-1.0, std::nan("")}) {
        PlotOptions options;
        options.split = split;
        EXPECT_THROW(PlotPlan(print, options), std::runtime_error) << split;
    }
}

TEST(Plot, ManyLinesMeetInOnePoint) {
    const Print print = large_print();
    for (const int rays : {3, 64, 65, 4001, 100'000}) {
        const auto plan = arranged(print, [&](PathSink& sink) {
            for (int i = 0; i < rays; ++i) {
                const double angle = 2 * std::numbers::pi * i / rays;
                stroke(sink,
                       {{500, 500}, glm::dvec2(500, 500) + 400.0 * glm::dvec2(std::cos(angle), std::sin(angle))});
            }
        });
        EXPECT_EQ(plan->report().after.lifts, static_cast<std::uint64_t>((rays + 1) / 2));
    }
    // Petals: closed lines that all touch in one point.
    const auto flower = arranged(print, [&](PathSink& sink) {
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec2 way(std::cos(0.00628 * i), std::sin(0.00628 * i));
            stroke(sink, {{500, 500}, 500.0 + 400.0 * way, 500.0 + 300.0 * way, {500, 500}});
        }
    });
    EXPECT_EQ(flower->report().after.lifts, 1u);
}

TEST(Plot, TimeIsCountedFromSpeeds) {
    const PlotTally tally{1000.0, 500.0, 20};
    EXPECT_DOUBLE_EQ(plot_seconds(tally, {50.0, 100.0, 0.25}), 20 + 5 + 5);
    EXPECT_DOUBLE_EQ(plot_seconds(tally, {50.0, 100.0, 0.0}), 25);
    EXPECT_DOUBLE_EQ(plot_seconds(PlotTally{}, {}), 0);
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(plot_seconds(tally, {bad, 100.0, 0.25}), std::runtime_error) << bad;
        EXPECT_THROW(plot_seconds(tally, {50.0, bad, 0.25}), std::runtime_error) << bad;
        if (bad == 0) continue;
        EXPECT_THROW(plot_seconds(tally, {50.0, 100.0, bad}), std::runtime_error) << bad;
    }
}

TEST(Plot, LimitsAndNothing) {
    Print print = large_print();
    const auto empty = arranged(print, [](PathSink&) {});
    EXPECT_TRUE(drawn(*empty).empty());
    EXPECT_TRUE(empty->travels().empty());
    EXPECT_EQ(empty->report().after, PlotTally{});
    const auto unseen = arranged(print, [](PathSink& sink) {
        stroke(sink, {{1, 1}, {2, 2}}, Pen{.width = 0});
        sink.disc({3, 3}, 0, Pen{.width = 0});
    });
    EXPECT_TRUE(drawn(*unseen).empty());
    const auto dots = arranged(print, [](PathSink& sink) {
        stroke(sink, {{0, 0}, {0, 0}});
        stroke(sink, {{7, 7}, {7, 7}, {7, 7}});
        stroke(sink, {{7, 7}, {8, 7}});
    });
    EXPECT_EQ(drawn(*dots).size(), 2u);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e305}) {
        EXPECT_THROW(arranged(print, [&](PathSink& sink) { stroke(sink, {{0, 0}, {1, bad}}); }), std::runtime_error);
    }
    const auto far = arranged(print, [](PathSink& sink) {
        stroke(sink, {{0, 0}, {1e299, -1e299}});
        stroke(sink, {{1e-299, 0}, {1e299, 1e299}});
    });
    EXPECT_EQ(far->report().after.lifts, 1u);
    const auto tiny = arranged(print, [](PathSink& sink) { stroke(sink, {{1e-300, 0}, {2e-300, 0}}); });
    EXPECT_EQ(tiny->report().after.lifts, 1u);
}

}  // namespace sikku::plot_test
