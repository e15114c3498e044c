#include "art/plotter/hpgl.h"

#include "art/prints.h"
#include "engine/base/output.h"
#include "tests/plot_tools.h"
#include "tests/works.h"

#include <charconv>
#include <cstdio>
#include <sstream>

namespace sikku::hpgl_test {

/// What a plotter would draw; anything that the writer has no reason to write is an error.
struct Plot {
    std::vector<std::vector<glm::dvec2>> strokes;  ///< corners, in millimetres
    std::vector<int> pens;                         ///< of each stroke
    std::size_t longest = 0;                       ///< instruction
};
/// @param page  page in the plotter's orientation: wider than high
Plot read_hpgl(const std::string& text, const Page& page) {
    Plot plot;
    int pen = 0;
    bool down = false;
    glm::dvec2 at(0.0);
    std::size_t begin = 0;
    EXPECT_TRUE(text.starts_with("IN;"));
    EXPECT_TRUE(text.ends_with("PU;SP0;\n") || text.find("PU;SP0;\nCO\"") != std::string::npos);
    for (std::size_t end = text.find(';'); end != std::string::npos; end = text.find(';', begin)) {
        std::string_view instruction = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        plot.longest = std::max(plot.longest, instruction.size());
        while (instruction.starts_with('\n')) instruction.remove_prefix(1);
        const std::string_view name = instruction.substr(0, 2);
        if (name == "CO") continue;  // the recipe
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

Page lying(Page page) {
    if (page.height > page.width) std::swap(page.width, page.height);
    return page;
}

class Hpgl : public ::testing::Test {
protected:
    std::string text(const PlotPlan& plan, const Print& print) {
        write_print(
            folder_ / "plot.hpgl", print,
            [&](const Print& is, OutputFile& file) { return write_hpgl(is, options_, file); },
            [&](PathSink& sink) { plan.draw(sink); });
        const std::string whole = contents(folder_ / "plot.hpgl");
        // Omits the recipe at the end.
        return whole.substr(0, std::min(whole.size(), whole.find("CO\"")));
    }
    void expect_faithful(const Print& print, const PlotPlan& plan) {
        Plot plot = read_hpgl(text(plan, print), lying(print.page));
        if (print.page.height > print.page.width) {
            // Turned back: the top of the page is at the left of the plotter.
            for (auto& stroke : plot.strokes) {
                for (glm::dvec2& at : stroke) at = {at.y, print.page.height - at.x};
            }
        }
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
    HpglOptions options_;
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

/// A line from the bottom left corner of a page, to the right and up.
std::unique_ptr<PlotPlan> corner(const Print& print) {
    return arranged(print, [&](PathSink& sink) {
        const glm::dvec2 low(20, 20 + (297 - print.page.height));
        sink.begin_stroke(low, Pen{});
        sink.lines(std::vector<glm::dvec2>{low + glm::dvec2(100, 0), low + glm::dvec2(100, 50)});
        sink.end_stroke(false);
    });
}
/// A step is a millimetre long; (0, 0) is 297 mm below the top of the page.
Print sheet_print(const Page& page) {
    Print print = plain_print();
    print.page = page;
    print.placement.to_page[2] = {0.0, 297.0};
    return print;
}

TEST_F(Hpgl, UprightPagesAreTurnedOntoTheLongSide) {
    const Print upright = sheet_print({210, 297, 15});
    const Print lying = sheet_print({297, 210, 15});
    const auto expect_points = [&](const Print& print, const std::string& expected) {
        EXPECT_EQ(text(*corner(print), print), "IN;\nPU;SP1;\n" + expected + "PU;SP0;\n");
    };
    // In plotter units from the corner of the page: 20 mm are 800.
    expect_points(lying, "PU800,800;\nPD4800,800,4800,2800;\n");
    // The bottom of the page is at the right: x = 297 - y, y = x.
    expect_points(upright, "PU11080,800;\nPD11080,4800,9080,4800;\n");
    EXPECT_EQ(hpgl_origin(lying.page, options_), glm::dvec2(0, 0));
    EXPECT_EQ(hpgl_origin(upright.page, options_), glm::dvec2(0, 297));
    EXPECT_TRUE(has(describe_hpgl(upright.page, options_), "turned by 90 degrees anticlockwise"));
    EXPECT_FALSE(has(describe_hpgl(lying.page, options_), "turned"));
    // In an HP 7475A the middle of A4 is at (5603, 4121): 297 x 210 mm are 11880 x 8400.
    options_.paper = parse_hpgl_paper("A4", 96);
    expect_points(lying, "PU463,721;\nPD4463,721,4463,2721;\n");
    expect_points(upright, "PU10743,721;\nPD10743,4721,8743,4721;\n");
    const glm::dvec2 origin = hpgl_origin(lying.page, options_);
    EXPECT_NEAR(origin.x, 297 / 2.0 - 5603 * 0.025, 1e-9);
    EXPECT_NEAR(origin.y, 210 / 2.0 - 4121 * 0.025, 1e-9);
    // The page is centred within the limits of another plotter.
    options_.paper = parse_hpgl_paper("400x300mm", 96);
    expect_points(lying, "PU2860,2600;\nPD6860,2600,6860,4600;\n");
    options_.paper = parse_hpgl_paper("400x300mm,centre", 96);
    expect_points(lying, "PU-5140,-3400;\nPD-1140,-3400,-1140,-1400;\n");
    options_.paper = parse_hpgl_paper("A1,centre", 96);
    expect_points(lying, "PU-5140,-3400;\nPD-1140,-3400,-1140,-1400;\n");
    for (const char* wrong : {"", "A11", "A4,left", "0x5mm", ",centre", "400x300mm,centre,"}) {
        EXPECT_FALSE(parse_hpgl_paper(wrong, 96)) << wrong;
    }
}

TEST_F(Hpgl, WhatThePlotterDoesNotReachIsRefused) {
    const Print print = sheet_print({297, 210, 0});
    options_.paper = parse_hpgl_paper("a4", 96);
    const auto refusal = [&](const Print& page, glm::dvec2 end) -> std::string {
        const auto plan = arranged(page, [&](PathSink& sink) {
            sink.begin_stroke({100, 100}, Pen{});
            sink.lines(std::vector<glm::dvec2>{end});
            sink.end_stroke(false);
        });
        try {
            text(*plan, page);
            return "is accepted";
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    };
    EXPECT_EQ(refusal(print, {100, 285}),
              "the drawing exceeds the 276 x 193 mm that the plotter reaches on a4 (HP 7475A); a margin of 15.0mm "
              "keeps it inside");
    EXPECT_EQ(folder_.names(), std::vector<std::string>{});
    EXPECT_EQ(
        refusal(sheet_print({841, 1189, 0}), {700, 1000}),
        "the drawing exceeds the 276 x 193 mm that the plotter reaches on a4 (HP 7475A); choose a smaller page");
}

TEST_F(Hpgl, APlaceBesideThePageIsNamedIfThePlotterDoesNotReachIt) {
    const Print print = sheet_print({297, 210, 20});
    options_.paper = parse_hpgl_paper("a4", 96);
    MemoryDestination memory;
    const auto output = memory.open("plot.hpgl");
    const auto writer = write_hpgl(print, options_, *output);
    EXPECT_NO_THROW(writer->dip({10, 10}, Pen{}));
    EXPECT_EQ(error_of<std::runtime_error>([&] {
                  writer->dip({-20, 40}, Pen{});
              }),
              "the place for refilling (-20,40) is out of the plotter's reach on a4 (HP 7475A); expected x "
              "from 8.4 to 284.4 mm and y from 2.0 to 195.0 mm");
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

/// The HP-GL plot of a document and its report.
std::pair<std::string, std::string> plotted(const Document& document, const OptionValues& values) {
    const MadeWork made = made_work(prints(), document, "hpgl", values);
    return {made.bytes(), made.remarks};
}

TEST_F(Hpgl, TheUnitIsThatOfTheMachine) {
    const Document line = parse("line.lsys", "axiom: F\nheading: 0\n");
    const auto units = [&](const OptionValues& values) {
        const std::string text = plotted(line, values).first;
        int from = 0, to = 0, y = 0;
        EXPECT_EQ(std::sscanf(text.c_str() + text.find("PU", text.find("SP1")), "PU%d,%d;\nPD%d,", &from, &y, &to),
                  3);
        return to - from;
    };
    const OptionValues common = {{"step", "100mm"}, {"hpgl-paper", "A4"}, {"landscape", "true"}};
    EXPECT_EQ(units(common), 4000);
    OptionValues profile = common;
    profile.push_back({"profile", "hp7475a"});
    // 1,021 units to the inch.
    EXPECT_NEAR(units(profile), 100 / 25.4 * 1021, 1.5);
}

TEST_F(Hpgl, AProfileWidensTheMarginThatItNeeds) {
    const Document kolam = load(bundled("kolams/snake-kolam"));
    for (const char* size : {"A4", "A3", "letter", "tabloid"}) {
        SCOPED_TRACE(size);
        const auto [text, report] = plotted(kolam, {{"profile", "hp7475a"}, {"size", size}});
        EXPECT_TRUE(has(report, "the margin is 1"));
        EXPECT_THROW(plotted(kolam, {{"profile", "hp7475a"}, {"size", size}, {"margin", "5mm"}}), std::runtime_error);
    }
    // A margin that suffices stays.
    const auto [text, report] = plotted(kolam, {{"profile", "hp7475a"}, {"margin", "30mm"}});
    EXPECT_FALSE(has(report, "the margin is"));
    const ScratchFolder folder;
    const std::string own = folder.write("own.plotter", "title: small\nlanguage: HP-GL\npaper: 260x180mm\n");
    EXPECT_TRUE(has(plotted(kolam, {{"profile", own}}).second, "the margin is 18.5 mm"));
    EXPECT_FALSE(has(plotted(kolam, {}).second, "the margin is"));
}

TEST_F(Hpgl, RedundantMovesAreOmitted) {
    for (const char* name : {"plants/lily-of-the-valley", "kolams/snake-kolam", "tilings/penrose-rhombs"}) {
        const std::string text = plotted(load(bundled(name)), {{"tile-edges", "each"}}).first;
        std::string at;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("SP") || line.starts_with("PU;SP")) at.clear();
            if (line.starts_with("PU") && line.size() > 3 && !line.starts_with("PU;")) {
                EXPECT_NE(line.substr(2), at) << name;
            }
            if (!line.starts_with("PD")) continue;
            // The last place of the instruction.
            const std::size_t comma = line.rfind(',', line.rfind(',') - 1);
            at = comma == std::string::npos ? line.substr(2) : line.substr(comma + 1);
        }
    }
}

}  // namespace sikku::hpgl_test
