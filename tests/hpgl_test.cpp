#include "art/plotter/hpgl.h"

#include "tests/plot_tools.h"

#include <charconv>

namespace sikku {
namespace {

/// What a plotter would draw; anything that the writer has no reason to write is an error.
struct Plot {
    std::vector<std::vector<glm::dvec2>> strokes;  ///< corners, in millimetres
    std::vector<int> pens;                         ///< of each stroke
    std::size_t longest = 0;                       ///< instruction
};
Plot read_hpgl(const std::string& text, const Page& page) {
    Plot plot;
    int pen = 0;
    bool down = false;
    glm::dvec2 at(0.0);
    std::size_t begin = 0;
    EXPECT_TRUE(text.starts_with("IN;"));
    EXPECT_TRUE(text.ends_with("PU;SP0;\n"));
    for (std::size_t end = text.find(';'); end != std::string::npos; end = text.find(';', begin)) {
        std::string_view instruction = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        plot.longest = std::max(plot.longest, instruction.size());
        while (instruction.starts_with('\n')) instruction.remove_prefix(1);
        const std::string_view name = instruction.substr(0, 2);
        std::vector<int> numbers;
        const char* next = instruction.data() + 2;
        const char* const last = instruction.data() + instruction.size();
        while (next < last) {
            const auto [stop, error] = std::from_chars(next, last, numbers.emplace_back());
            EXPECT_EQ(error, std::errc()) << instruction;
            if (error != std::errc()) return plot;
            EXPECT_TRUE(stop == last || *stop == ',') << instruction;
            next = stop + 1;
        }
        if (name == "SP") {
            EXPECT_FALSE(down);
            EXPECT_EQ(numbers.size(), 1u);
            pen = numbers.at(0);
        } else if (name == "PU" || name == "PD") {
            EXPECT_EQ(numbers.size() % 2, 0u);
            if (name == "PD" && !down) {
                EXPECT_NE(pen, 0);
                plot.strokes.push_back({at});
                plot.pens.push_back(pen);
            }
            down = name == "PD";
            for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
                at = glm::dvec2(numbers[i], numbers[i + 1]) * 0.025;
                EXPECT_TRUE(at.x >= 0 && at.y >= 0 && at.x <= page.width && at.y <= page.height) << instruction;
                if (down) plot.strokes.back().push_back(at);
            }
        } else {
            EXPECT_EQ(instruction, "IN");
        }
    }
    EXPECT_EQ(pen, 0) << "the pen is put away";
    return plot;
}

class Hpgl : public ::testing::Test {
protected:
    std::string text(const PlotPlan& plan, const Print& print) {
        write_print(folder_ / "plot.hpgl", print, write_hpgl, [&](PathSink& sink) { plan.draw(sink); });
        return contents(folder_ / "plot.hpgl");
    }
    void expect_faithful(const Print& print, const PlotPlan& plan) {
        const Plot plot = read_hpgl(text(plan, print), print.page);
        constexpr double spacing = 0.01;
        const auto lines = true_lines(plan, print, spacing);
        ASSERT_EQ(plot.strokes.size(), lines.size());
        for (std::size_t i = 0; i < lines.size(); ++i) {
            Samples samples(spacing);
            samples.start(plot.strokes[i][0]);
            for (const glm::dvec2 corner : std::span(plot.strokes[i]).subspan(1)) samples.line(corner);
            EXPECT_LE(hausdorff(samples.points, lines[i]), 0.0255) << i;
        }
        EXPECT_LE(plot.longest, 230u);
    }
    ScratchFolder folder_;
};

TEST_F(Hpgl, IsWhatAPlotterTakes) {
    const Print print = plain_print();
    const auto plan = arranged(print, [](PathSink& sink) {
        sink.begin_stroke({10, 10}, Pen{});
        sink.lines(std::vector<glm::dvec2>{{90, 10}, {90, 50.01}});
        sink.end_stroke(false);
        sink.begin_stroke({20, 20}, Pen{.colour = 1});
        sink.lines(std::vector<glm::dvec2>{{20, 20}});
        sink.end_stroke(true);
    });
    EXPECT_EQ(text(*plan, print),
              "IN;\nPU;SP1;\nPU400,400;\nPD3600,400,3600,2000;\nPU;SP2;\nPU800,800;\nPD800,800;\nPU;SP0;\n");
    EXPECT_EQ(text(*arranged(print, [](PathSink&) {}), print), "IN;\nPU;SP0;\n");
}

TEST_F(Hpgl, CurvesAreWithinAUnit) {
    const Print print = plain_print();
    expect_faithful(print, *arranged(print, draw_curves));
}

TEST_F(Hpgl, PensAreTheColoursOfTheStyle) {
    const Print print = plain_print();
    const auto plan = arranged(print, draw_curves);
    reference::Recorder recorder;
    plan->draw(recorder);
    std::vector<int> expected;
    for (const auto& stroke : recorder.strokes) expected.push_back(stroke.pens[0].colour + 1);
    EXPECT_TRUE(std::is_sorted(expected.begin(), expected.end()));
    EXPECT_EQ(read_hpgl(text(*plan, print), print.page).pens, expected);
}

TEST_F(Hpgl, AKolamIsReadBack) {
    const PlacedPattern kolam("kolams/snake-kolam", 3, {105, 148, 10});
    expect_faithful(kolam.print, *arranged(kolam.print, [&](PathSink& sink) { kolam.read(sink); }));
}

TEST_F(Hpgl, WhatLiesOffThePageIsRefused) {
    const Print print = plain_print();
    for (const glm::dvec2 end : {glm::dvec2(101, 30), {50, 60.1}, {-0.1, 3}, {50, -1}}) {
        const auto plan = arranged(print, [&](PathSink& sink) {
            sink.begin_stroke({10, 10}, Pen{});
            sink.lines({&end, 1});
            sink.end_stroke(false);
        });
        EXPECT_THROW(text(*plan, print), std::runtime_error);
    }
    EXPECT_EQ(folder_.names(), std::vector<std::string>{});
}

}  // namespace
}  // namespace sikku
