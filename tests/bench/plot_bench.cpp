// tests/bench/plot_bench.cpp: arranging drawings for a plotter, at the size of large ones.
#include "art/plotter/plot.h"
#include "tests/hilbert.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <random>
#include <utility>
#include <vector>

namespace {

using namespace sikku;
using Strokes = std::vector<std::vector<glm::dvec2>>;

Print print_of(double side) {
    Print print;
    print.style.palette = {Colour{}};
    Box box;
    box.add({0.0, 0.0});
    box.add({side, side});
    print.placement = place(box, print.page, {}, 0.0, 0.2);
    return print;
}

/// A line cut into single steps, in random order and directions.
Strokes pieces(const std::vector<glm::dvec2>& points) {
    std::mt19937 random(7);
    Strokes strokes;
    for (std::size_t i = 1; i < points.size(); ++i) {
        strokes.push_back({points[i - 1], points[i]});
        if (random() % 2 == 0) std::swap(strokes.back()[0], strokes.back()[1]);
    }
    std::shuffle(strokes.begin(), strokes.end(), random);
    return strokes;
}

/// Hexagons, each drawn by itself: every inner edge twice.
Strokes hexagons(int side) {
    Strokes strokes;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            // In halves and in multiples of half the root of 3, so that equal corners are equal.
            const int x = 2 * column + row % 2;
            const int y = 3 * row;
            auto& stroke = strokes.emplace_back();
            for (const auto& [right, up] : {std::pair{1, 1}, {0, 2}, {-1, 1}, {-1, -1}, {0, -2}, {1, -1}, {1, 1}}) {
                stroke.emplace_back((x + right) * std::sqrt(0.75), (y + up) * 0.5);
            }
        }
    }
    return strokes;
}

/// Short strokes anywhere, none of which meet.
Strokes grass(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> anywhere(0.0, 1000.0);
    std::uniform_real_distribution<double> near(-1.0, 1.0);
    Strokes strokes;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 at(anywhere(random), anywhere(random));
        strokes.push_back({at, at + glm::dvec2(near(random), near(random))});
    }
    return strokes;
}

/// One closed line of Béziers around the same circle, each turn in another place.
Strokes rosette(std::size_t curves) {
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i <= 3 * curves; ++i) {
        const double t = static_cast<double>(i % (3 * curves));
        const double radius = 400 + 90 * std::sin(0.0007 * t);
        points.emplace_back(500 + radius * std::cos(0.31 * t), 500 + radius * std::sin(0.31 * t));
    }
    return {points};
}

void arrange(benchmark::State& state, const Strokes& strokes, double side, bool curves = false) {
    const Print print = print_of(side);
    std::uint64_t segments = 0;
    for (auto _ : state) {
        PlotPlan plan(print);
        for (const auto& stroke : strokes) {
            const auto rest = std::span(stroke).subspan(1);
            plan.begin_stroke(stroke.front(), Pen{});
            curves ? plan.curves(rest) : plan.lines(rest);
            plan.end_stroke(stroke.front() == stroke.back());
        }
        plan.arrange();
        const PlotReport& report = plan.report();
        segments = report.segments;
        state.counters["segments"] = static_cast<double>(report.segments);
        state.counters["duplicates"] = static_cast<double>(report.duplicates);
        state.counters["lifts"] = static_cast<double>(report.after.lifts);
        state.counters["up_m_before"] = report.before.travelled / 1000;
        state.counters["up_m"] = report.after.travelled / 1000;
    }
    state.counters["segments/s"] =
        benchmark::Counter(static_cast<double>(segments), benchmark::Counter::kIsIterationInvariantRate);
}

/// 112,000 segments, and a million.
void hexagonal_tiling(benchmark::State& state) {
    const auto side = static_cast<int>(state.range(0));
    arrange(state, hexagons(side), 2.0 * side);
}
void hilbert_in_pieces(benchmark::State& state) {
    const auto side = static_cast<int>(state.range(0));
    arrange(state, pieces(hilbert_points(side)), side);
}
void strokes_that_do_not_meet(benchmark::State& state) {
    arrange(state, grass(static_cast<std::size_t>(state.range(0))), 1001.0);
}
void line_of_curves(benchmark::State& state) {
    arrange(state, rosette(static_cast<std::size_t>(state.range(0))), 1001.0, true);
}

BENCHMARK(hexagonal_tiling)->Arg(137)->Arg(408)->Unit(benchmark::kMillisecond);
BENCHMARK(hilbert_in_pieces)->Arg(256)->Arg(1024)->Unit(benchmark::kMillisecond);
BENCHMARK(strokes_that_do_not_meet)->Arg(10'000)->Arg(112'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(line_of_curves)->Arg(112'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
