// The engine alone: derivation, turtle, fold.
#include <benchmark/benchmark.h>

#include "engine/geometry/turtle.h"
#include "engine/map/placement.h"
#include "engine/measure/extent.h"
#include "tests/maps.h"

#include <cstdlib>
#include <string>

namespace {

using namespace sikku;

Grammar grammar_of(const std::string& text, std::int64_t steps) {
    Diagnostics diagnostics;
    const Pattern pattern = parse_pattern("bench", text, diagnostics);
    auto grammar = compile_grammar(pattern, diagnostics).with_steps(steps);
    diagnostics.throw_if_errors();
    return *grammar;
}

const std::string koch = "axiom: F-F-F-F\nF --> F-F+F+FF-F-F+F\n";
const std::string hilbert = "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\n";
const std::string bush = "axiom: F\nangle factor: 16\nF --> FF-[-F+F+F]+[+F-F-F]\n";
const std::string signal =
    "axiom: F1F1F1\nignore: +-F\nangle factor: 16\n0 < 0 > 0 --> 0\n0 < 0 > 1 --> 1[+F1F1]\n0 < 1 > 0 --> 1\n"
    "0 < 1 > 1 --> 1\n1 < 0 > 0 --> 0\n1 < 0 > 1 --> 1F1\n1 < 1 > 0 --> 0\n1 < 1 > 1 --> 0\n+ --> -\n- --> +\n";

// Prusinkiewicz, Hammel, Hanan & Mech 1996, equation 11 with the values of table 1 a.
const std::string honda =
    "define r1 = .75\ndefine r2 = .77\ndefine q = .5\ndefine e = .4\ndefine min = 0\naxiom: A(100,30)\nangle factor: "
    "8\n"
    "A(s,w) : s >= min --> !(w)F(s)[+(35)/(0)A(s*r1,w*q^e)][+(-35)/(0)A(s*r2,w*(1-q)^e)]\n";
// Prusinkiewicz & Hanan 1989, figure 3.16.
const std::string specimen =
    "axiom: F\nangle factor: 14\nF --> F[+F]F[-F]F : 0.33\nF --> F[+F]F : 0.33\nF --> F[-F]F : 0.34\n";
class Counter : public SymbolSink {
public:
    void symbols(const Run& run) override { count += run.symbols.size(); }
    std::uint64_t count = 0;
};

class PointCounter : public PolygonSink {
public:
    void lines(std::span<const glm::dvec2> ends) override { count += ends.size(); }
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    std::uint64_t count = 0;
};

void derivation_of_117_million_symbols(benchmark::State& state) {
    const Grammar grammar = grammar_of(koch, 8);
    std::uint64_t symbols = 0;
    for (auto _ : state) {
        Counter counter;
        derive(grammar, counter);
        symbols += counter.count;
    }
    state.counters["symbols/s"] = benchmark::Counter(static_cast<double>(symbols), benchmark::Counter::kIsRate);
}

void context_sensitive_derivation(benchmark::State& state) {
    const Grammar grammar = grammar_of(signal, 50);
    std::uint64_t symbols = 0;
    for (auto _ : state) {
        Counter counter;
        derive(grammar, counter);
        symbols += counter.count;
    }
    state.counters["last_word"] = static_cast<double>(symbols) / static_cast<double>(state.iterations());
}

void turtle(benchmark::State& state, const std::string& text, std::int64_t steps) {
    const Grammar grammar = grammar_of(text, steps);
    std::uint64_t points = 0;
    for (auto _ : state) {
        PointCounter counter;
        const auto walking = Turtle::drawing(grammar, counter, false);
        derive(grammar, *walking);
        points += counter.count;
    }
    state.counters["segments/s"] = benchmark::Counter(static_cast<double>(points), benchmark::Counter::kIsRate);
}

void measure_hilbert(benchmark::State& state) {
    const Grammar grammar = grammar_of(hilbert, state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(measure(grammar, 1e6));
}

void modules(benchmark::State& state, const std::string& text, std::int64_t steps) {
    const Grammar grammar = grammar_of(text, steps);
    std::uint64_t symbols = 0;
    for (auto _ : state) {
        Counter counter;
        derive(grammar, counter);
        symbols += counter.count;
    }
    state.counters["modules/s"] = benchmark::Counter(static_cast<double>(symbols), benchmark::Counter::kIsRate);
}

/// One step, with contexts, of a word of ten million symbols.
void a_step_with_contexts(benchmark::State& state, bool parametric) {
    const std::int64_t size = 10'000'000;
    std::string axiom = "ignore: +-\naxiom: ";
    const std::string part = parametric ? "A(1)[+B(2)]A(3)-" : "A[+B]AA-";
    const std::int64_t symbols_of_part = parametric ? 7 : 8;
    for (std::int64_t i = 0; i < size / symbols_of_part; ++i) axiom += part;
    axiom += parametric ? "\nA(x) < A(y) : x <= y --> A(x+y)\nA(x) > [B(y)]A(z) --> A(x+y+z)\n"
                        : "\nA < A > A --> B\nB < A --> A\nA > [B] --> C\n";
    const Grammar grammar = grammar_of(axiom, 1);
    for (auto _ : state) {
        benchmark::DoNotOptimize(rewrite(grammar, grammar.tables()[0], grammar.axiom_modules(), 1));
    }
    state.counters["symbols"] = static_cast<double>(grammar.axiom().size());
}

/// The cell layer of 2^n cells.
void map_of_cells(benchmark::State& state) {
    const Grammar grammar = grammar_of(maps::layer, state.range(0));
    std::size_t edges = 0;
    for (auto _ : state) edges = derive_map(grammar).edges().size();
    state.counters["edges"] = static_cast<double>(edges);
}

void placed_cells(benchmark::State& state, const std::string& placing) {
    const Grammar grammar = grammar_of(maps::layer + "place: " + placing + "\n", state.range(0));
    for (auto _ : state) {
        PlacedMap map(grammar);
        while (map.next()) {
        }
        benchmark::DoNotOptimize(map.vertices());
    }
}

BENCHMARK(map_of_cells)->Arg(12)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(placed_cells, gravity, "gravity")->Arg(12)->Arg(14)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(placed_cells, pressure, "pressure")->Arg(10)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(modules, honda_17, honda, 17)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(modules, specimen_10, specimen, 10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(a_step_with_contexts, plain, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(a_step_with_contexts, parametric, true)->Unit(benchmark::kMillisecond);
BENCHMARK(derivation_of_117_million_symbols)->Unit(benchmark::kMillisecond);
BENCHMARK(context_sensitive_derivation)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(turtle, hilbert_10, hilbert, 10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(turtle, bush_of_rank_8, bush, 6)->Unit(benchmark::kMillisecond);
BENCHMARK(measure_hilbert)->Arg(10)->Arg(60)->Arg(500)->Unit(benchmark::kMicrosecond);

}  // namespace
