// tests/bench/raster_bench.cpp: our pixels against Cairo's, one thread each unless the name says otherwise. Ours
// includes collecting the drawing; Cairo's fills one surface of the whole canvas that is made before.
#include "art/raster/raster.h"
#include "tests/hilbert.h"

#include <benchmark/benchmark.h>
#include <cairo/cairo.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace sikku;

/// A print whose pattern units are pixels, y down.
Print canvas(int width, int height, double pen, Colour ink, Colour ground) {
    Print print;
    print.page = {static_cast<double>(width), static_cast<double>(height), 0.0};
    print.dpi = 25.4;
    print.style.stroke.value = pen;
    print.style.ground = ground;
    print.style.palette = {ink};
    return print;
}

constexpr Colour black{0, 0, 0, 255}, white{255, 255, 255, 255}, rice{0xff, 0xfd, 0xf5, 255},
    earth{0x8c, 0x3a, 0x22, 255};

/// 1,048,575 segments on a canvas of 8192 pixels.
const std::vector<glm::dvec2>& hilbert() {
    static const std::vector<glm::dvec2> points = hilbert_points(1024, 8.0, 4.0);
    return points;
}

/// Loops that hang together smoothly, on a canvas of 8192 pixels: first point, then three controls a curve.
std::vector<glm::dvec2> bezier_points(int curves, double reach) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> turn(-1.5, 1.5);
    std::vector<glm::dvec2> points{{4096, 4096}};
    double heading = 0;
    for (int i = 0; i < curves; ++i) {
        const auto step = [&](double length) {
            glm::dvec2 next = points.back() + length * glm::dvec2(std::cos(heading), std::sin(heading));
            if (next.x < 50 || next.y < 50 || next.x > 8142 || next.y > 8142) {
                heading = std::atan2(4096 - points.back().y, 4096 - points.back().x);
                next = points.back() + length * glm::dvec2(std::cos(heading), std::sin(heading));
            }
            points.push_back(next);
        };
        step(reach / 3);
        heading += turn(random);
        step(reach / 3);
        heading += turn(random);
        step(reach / 3);
    }
    return points;
}

void draw_ours(const Print& print, const std::vector<glm::dvec2>& points, bool curves, int threads) {
    const std::unique_ptr<Raster> raster = make_raster(print);
    constexpr std::size_t block = 4095;  // as the turtle hands them over
    raster->begin_stroke(points[0], Pen{});
    for (std::size_t at = 1; at < points.size(); at += block) {
        const std::span<const glm::dvec2> part(points.data() + at, std::min(block, points.size() - at));
        if (curves) {
            raster->curves(part);
        } else {
            raster->lines(part);
        }
    }
    raster->end_stroke(false);
    raster->render(threads,
                   [](int, int, std::span<const std::uint8_t> pixels) { benchmark::DoNotOptimize(pixels.data()); });
}

struct CairoSurface {
    CairoSurface(cairo_format_t format, int size) : surface(cairo_image_surface_create(format, size, size)) {}
    ~CairoSurface() { cairo_surface_destroy(surface); }
    cairo_surface_t* surface;
};

/// Strokes every `chunk` segments (0: one path).
void draw_cairo(cairo_surface_t* surface, const std::vector<glm::dvec2>& points, bool curves, double pen, int chunk,
                bool round) {
    cairo_t* cairo = cairo_create(surface);
    cairo_set_operator(cairo, CAIRO_OPERATOR_CLEAR);
    cairo_paint(cairo);
    cairo_set_operator(cairo, CAIRO_OPERATOR_OVER);
    cairo_set_source_rgba(cairo, 1, 1, 1, 1);
    cairo_set_line_width(cairo, pen);
    if (round) {
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    }
    cairo_move_to(cairo, points[0].x, points[0].y);
    int count = 0;
    const std::size_t stride = curves ? 3 : 1;
    for (std::size_t i = 1; i + stride <= points.size(); i += stride) {
        if (curves) {
            cairo_curve_to(cairo, points[i].x, points[i].y, points[i + 1].x, points[i + 1].y, points[i + 2].x,
                           points[i + 2].y);
        } else {
            cairo_line_to(cairo, points[i].x, points[i].y);
        }
        if (++count == chunk) {
            const glm::dvec2 end = points[i + stride - 1];
            cairo_stroke(cairo);
            cairo_move_to(cairo, end.x, end.y);
            count = 0;
        }
    }
    cairo_stroke(cairo);
    cairo_surface_flush(surface);
    cairo_destroy(cairo);
}

void rate(benchmark::State& state, std::size_t segments) {
    state.counters["segments"] =
        benchmark::Counter(static_cast<double>(segments), benchmark::Counter::kIsIterationInvariantRate);
}

// Arguments: pen in pixels, threads, channels.
void hilbert_ours(benchmark::State& state) {
    const bool colour = state.range(2) == 3;
    const Print print =
        canvas(8192, 8192, static_cast<double>(state.range(0)), colour ? rice : black, colour ? earth : white);
    const auto& points = hilbert();
    for (auto _ : state) draw_ours(print, points, false, static_cast<int>(state.range(1)));
    rate(state, points.size() - 1);
}
BENCHMARK(hilbert_ours)
    ->Args({2, 1, 1})
    ->Args({2, 2, 1})
    ->Args({2, 1, 3})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Arguments: segments a stroke (0: all), round caps and joins, 8 or 32 bits a pixel. With round ones the picture is
// ours; without, Cairo takes a path of its own for lines along rows and columns, and leaves notches between strokes.
void hilbert_cairo(benchmark::State& state) {
    const CairoSurface target(state.range(2) == 8 ? CAIRO_FORMAT_A8 : CAIRO_FORMAT_RGB24, 8192);
    const auto& points = hilbert();
    for (auto _ : state) {
        draw_cairo(target.surface, points, false, 2, static_cast<int>(state.range(0)), state.range(1) != 0);
    }
    rate(state, points.size() - 1);
}
BENCHMARK(hilbert_cairo)
    ->Args({0, 1, 8})
    ->Args({30, 1, 8})
    ->Args({100, 1, 8})
    ->Args({300, 1, 8})
    ->Args({30, 0, 8})
    ->Args({100, 0, 8})
    ->Args({300, 0, 8})
    ->Args({100, 0, 32})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// Arguments: curves, length of each in pixels, pen in pixels.
void beziers_ours(benchmark::State& state) {
    const auto points = bezier_points(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)));
    const Print print = canvas(8192, 8192, static_cast<double>(state.range(2)), black, white);
    for (auto _ : state) draw_ours(print, points, true, 1);
    rate(state, points.size() / 3);
}
void beziers_cairo(benchmark::State& state) {
    const auto points = bezier_points(static_cast<int>(state.range(0)), static_cast<double>(state.range(1)));
    const CairoSurface target(CAIRO_FORMAT_A8, 8192);
    for (auto _ : state) {
        draw_cairo(target.surface, points, true, static_cast<double>(state.range(2)),
                   static_cast<int>(state.range(3)), true);
    }
    rate(state, points.size() / 3);
}
BENCHMARK(beziers_ours)
    ->Args({200'000, 40, 2})
    ->Args({4'000, 300, 2})
    ->Args({4'000, 300, 8})
    ->Args({4'000, 300, 35})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(beziers_cairo)
    ->Args({200'000, 40, 2, 30})
    ->Args({200'000, 40, 2, 100})
    ->Args({4'000, 300, 2, 10})
    ->Args({4'000, 300, 2, 100})
    ->Args({4'000, 300, 8, 10})
    ->Args({4'000, 300, 8, 100})
    ->Args({4'000, 300, 35, 10})
    ->Args({4'000, 300, 35, 100})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// A0 at 300 dpi: loops around 40 x 57 dots and the dots, rice white on earth red. Arguments: threads.
void poster_ours(benchmark::State& state) {
    const int width = 9933, height = 14043, spacing = 240;
    const Print print = canvas(width, height, 24, rice, earth);
    for (auto _ : state) {
        const std::unique_ptr<Raster> raster = make_raster(print);
        for (int y = spacing; y < height - spacing; y += spacing) {
            for (int x = spacing; x < width - spacing; x += spacing) {
                const double radius = spacing * 0.7, control = radius * 4 / 3 * (std::numbers::sqrt2 - 1);
                const auto at = [&](double dx, double dy) { return glm::dvec2(x + dx, y + dy); };
                const glm::dvec2 loop[] = {at(radius, control),   at(control, radius),   at(0, radius),
                                           at(-control, radius),  at(-radius, control),  at(-radius, 0),
                                           at(-radius, -control), at(-control, -radius), at(0, -radius),
                                           at(control, -radius),  at(radius, -control),  at(radius, 0)};
                raster->begin_stroke(at(radius, 0), Pen{});
                raster->curves(loop);
                raster->end_stroke(true);
                raster->disc(at(0, 0), 20, Pen{});
            }
        }
        raster->render(static_cast<int>(state.range(0)), [](int, int, std::span<const std::uint8_t> pixels) {
            benchmark::DoNotOptimize(pixels.data());
        });
    }
}
BENCHMARK(poster_ours)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

/// 400,000 tiles of two colours that share their edges.
void tiles_ours(benchmark::State& state) {
    Print print = canvas(8192, 8192, 1, rice, earth);
    print.style.palette = {rice, Colour{40, 80, 120, 255}};
    for (auto _ : state) {
        const std::unique_ptr<Raster> raster = make_raster(print);
        for (int i = 0; i < 632; ++i) {
            for (int j = 0; j < 632; ++j) {
                const auto corner = [&](int a, int b) { return glm::dvec2(a * 12.9 + b * 0.1, b * 12.9 - a * 0.1); };
                const glm::dvec2 tile[] = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
                raster->polygon(tile, Pen{.colour = (i + j) % 2});
            }
        }
        raster->render(
            1, [](int, int, std::span<const std::uint8_t> pixels) { benchmark::DoNotOptimize(pixels.data()); });
    }
    rate(state, 632 * 632);
}
BENCHMARK(tiles_ours)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
