// tests/bench/view_bench.cpp: drawings of any order as what is seen of them, against drawings read in full: of the
// order whose step is nearest the largest part that is replaced. 2048 x 2048 pixels, the same rasteriser, one thread.
#include "art/deep/view.h"
#include "art/raster/raster.h"
#include "engine/geometry/turtle.h"
#include "engine/measure/fold.h"
#include "tests/reference.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace {

using namespace sikku;

constexpr int side = 2048;
constexpr double pixel = 25.4 / 300;

struct System {
    const char* text;
    int order;
};
constexpr System hilbert{"axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 60\n", 60};
constexpr System hilbert_half{"axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 30\n", 30};
constexpr System dragon{"axiom: FX\nX --> X+YF+\nY --> -FX-Y\nderivation length: 60\n", 60};
constexpr System koch{"axiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\nderivation length: 25\n", 25};
constexpr System plant{"axiom: F\nangle increment: 25.7\nF --> F[+F]F[-F]F\nderivation length: 30\n", 30};

Print print_of(const Grammar& grammar, double pen) {
    Print print;
    print.page = {side * pixel, side * pixel, 0};
    print.style.palette = {Colour{0, 0, 0, 255}};
    print.style.ground = Colour{255, 255, 255, 255};
    print.style.stroke = pen > 0 ? StrokeWidth{pen * pixel, false} : StrokeWidth{-pen, true};
    const auto folded = fold(grammar);
    Box box;
    for (const glm::dvec2 corner : folded.value().ink_hull) box.add(corner);
    print.placement = place(box, print.page, {}, pen < 0 ? -pen / 2 : 0, pen > 0 ? pen * pixel / 2 : 0);
    return print;
}

Sight sight_of(const Print& print) {
    const double step = print.placement.step / pixel;
    const double width = print.style.line_width({}, print.placement.step) / pixel;
    Sight sight;
    sight.box.add({-1e30, -1e30});
    sight.box.add({1e30, 1e30});
    (width < 1 ? sight.blot : sight.chord) = (width < 1 ? 0.5 : width / 4) / step;
    sight.least = width < 1 ? 1e-5 / width / step : width / 256 / step;
    return sight;
}

void render(Raster& raster) {
    raster.render(1, [](int, int, std::span<const std::uint8_t> rows) { benchmark::DoNotOptimize(rows.data()); });
}

/// @param pen  pixels, or below 0 a part of a step
void seen(benchmark::State& state, const System& system, double pen) {
    const Grammar grammar = reference::grammar_of(system.text);
    for (auto _ : state) {
        const Print print = print_of(grammar, pen);
        const auto raster = make_raster(print);
        raster->expect({});
        const auto view = View::make(grammar, std::nullopt);
        const ViewReport report = view->read(sight_of(print), *raster, 1e10, {});
        render(*raster);
        state.counters["replaced"] = static_cast<double>(report.chords + report.blots);
    }
}

void read_in_full(benchmark::State& state, const System& system, double pen) {
    const Grammar grammar = reference::grammar_of(system.text);
    const Print large = print_of(grammar, pen);
    const Sight sight = sight_of(large);
    const auto parts = Parts<double>::make(grammar);
    double longest = 0;
    for (const DrawnPart<double>& part : parts->all()) {
        const auto extent = static_cast<double>(part.extent);
        if (extent <= std::max(sight.blot, sight.chord)) longest = std::max(longest, extent);
    }
    longest *= large.placement.step;
    int best = 0;
    double least = 1e300;
    for (int order = 1; order < 27; ++order) {
        const Print print = print_of(*grammar.with_steps(order), pen);
        const double off = std::fabs(std::log(print.placement.step / longest));
        if (off < least) {
            least = off;
            best = order;
        }
    }
    const Grammar smaller = *grammar.with_steps(best);
    for (auto _ : state) {
        const Print print = print_of(smaller, pen);
        const auto raster = make_raster(print);
        const auto turtle = Turtle::drawing(smaller, *raster, false);
        derive(smaller, *turtle, {.interpreted = true});
        render(*raster);
    }
    state.counters["order"] = best;
}

#define BOTH(name, system, pen)                                                \
    BENCHMARK_CAPTURE(seen, name, system, pen)->Unit(benchmark::kMillisecond); \
    BENCHMARK_CAPTURE(read_in_full, name, system, pen)->Unit(benchmark::kMillisecond)

BOTH(hilbert_60_relative_pen, hilbert, -0.3);
BOTH(hilbert_30_relative_pen, hilbert_half, -0.3);
BOTH(hilbert_60_two_pixels, hilbert, 2.0);
BOTH(dragon_60_relative_pen, dragon, -0.3);
BOTH(dragon_60_two_pixels, dragon, 2.0);
BOTH(koch_island_25_relative_pen, koch, -0.3);
BOTH(koch_island_25_two_pixels, koch, 2.0);
BOTH(plant_30_relative_pen, plant, -0.3);
BOTH(plant_30_two_pixels, plant, 2.0);

/// A window of 2^11 steps a side somewhere in the middle of order 60.
void window_of_hilbert_60(benchmark::State& state) {
    class Counter : public WithoutStrokes<BlotSink> {
    public:
        void lines(std::span<const glm::dvec2> ends) override { count += ends.size(); }
        void polygon(std::span<const glm::dvec2>, const Pen&) override {}
        void disc(glm::dvec2, double, const Pen&) override {}
        std::size_t prepare(const Blot&, const Pen&) override { return 0; }
        void blot(std::size_t, glm::dvec2) override {}
        std::size_t count = 0;
    };
    const Grammar grammar = reference::grammar_of(hilbert.text);
    const auto width = static_cast<double>(state.range(0));
    const auto window = parse_window("-768614336404564650,384307168202282325,0,1152921504606846975");
    for (auto _ : state) {
        const auto view = View::make(grammar, window);
        Sight sight;
        sight.box.add({0, 0});
        sight.box.add({width, width});
        Counter counter;
        view->read(sight, counter, 1e10, {});
        state.counters["edges"] = static_cast<double>(counter.count);
    }
}
BENCHMARK(window_of_hilbert_60)->Arg(1 << 7)->Arg(1 << 11)->Unit(benchmark::kMillisecond);

}  // namespace
