// tests/bench/svg_bench.cpp: the vector writers at the size of a poster.
#include "art/print/print.h"
#include "art/vector/pdf.h"
#include "art/vector/svg.h"
#include "engine/base/output_file.h"
#include "tests/hilbert.h"

#include <benchmark/benchmark.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace sikku;

/// 1,048,575 segments.
const std::vector<glm::dvec2>& hilbert() {
    static const std::vector<glm::dvec2> points = hilbert_points(1024);
    return points;
}

/// Control points of 200,000 Béziers: round bends along a spiral.
const std::vector<glm::dvec2>& bends() {
    static const std::vector<glm::dvec2> points = [] {
        std::vector<glm::dvec2> list = {{0.0, 0.0}};
        for (int i = 0; i < 600'000; ++i) {
            const double angle = 0.02 * i;
            const double radius = 500.0 * std::sqrt(i / 600'000.0);
            list.emplace_back(radius * std::cos(angle) + 3.0 * std::sin(i), radius * std::sin(angle));
        }
        return list;
    }();
    return points;
}

Print print_of(const std::vector<glm::dvec2>& points) {
    Print print;
    print.style.palette = {Colour{}};
    print.style.ground = Colour{255, 255, 255, 255};
    Box box;
    for (const glm::dvec2 point : points) box.add(point);
    print.placement = place(box, print.page, {}, 0.0, 0.2);
    return print;
}

/// Blocks of 4096 points, as the turtle hands them on.
void draw(PathSink& sink, const std::vector<glm::dvec2>& points, bool curves) {
    const std::span<const glm::dvec2> all(points);
    sink.begin_stroke(all.front(), Pen{});
    for (std::size_t at = 1; at < all.size();) {
        const std::size_t count = std::min<std::size_t>(all.size() - at, curves ? 3 * 1024 : 4096);
        curves ? sink.curves(all.subspan(at, count)) : sink.lines(all.subspan(at, count));
        at += count;
    }
    sink.end_stroke(false);
}

template <typename Write>
void run(benchmark::State& state, const std::vector<glm::dvec2>& points, bool curves, Write&& write) {
    const Print print = print_of(points);
    const std::filesystem::path target =
        std::filesystem::temp_directory_path() / ("sikku_bench_" + std::to_string(::getpid()));
    std::uint64_t bytes = 0;
    for (auto _ : state) {
        OutputFile file(target);
        const auto writer = write(print, file);
        draw(*writer, points, curves);
        writer->finish();
        bytes = file.size();
        file.commit();
    }
    std::filesystem::remove(target);
    const double pieces =
        curves ? static_cast<double>(points.size() - 1) / 3 : static_cast<double>(points.size() - 1);
    state.counters["MB"] = static_cast<double>(bytes) / 1e6;
    state.counters["pieces/s"] =
        benchmark::Counter(pieces, benchmark::Counter::kIsIterationInvariantRate, benchmark::Counter::kIs1000);
}

void svg_lines(benchmark::State& state) {
    run(state, hilbert(), false, write_svg);
}
void svg_curves(benchmark::State& state) {
    run(state, bends(), true, write_svg);
}
void pdf_lines(benchmark::State& state) {
    run(state, hilbert(), false, write_pdf);
}
void pdf_curves(benchmark::State& state) {
    run(state, bends(), true, write_pdf);
}

BENCHMARK(svg_lines)->Unit(benchmark::kMillisecond);
BENCHMARK(svg_curves)->Unit(benchmark::kMillisecond);
BENCHMARK(pdf_lines)->Unit(benchmark::kMillisecond);
BENCHMARK(pdf_curves)->Unit(benchmark::kMillisecond);

}  // namespace
