#include "art/plotter/gcode.h"

#include "art/plotter/profile.h"
#include "art/prints.h"
#include "tests/plot_tools.h"

#include <charconv>
#include <map>

namespace sikku::gcode_test {

constexpr double spacing = 0.004;

/// What a machine would draw. Moves with the pen up that would draw, moves with the pen down that would not, and arcs
/// whose ends are not equally far from their centre are errors.
struct Plot {
    std::vector<std::vector<glm::dvec2>> strokes;  ///< points `spacing` apart, in millimetres
    std::map<int, std::size_t> moves;              ///< of each kind: 0 to 3
    std::vector<double> feeds;                     ///< of each move that draws
    std::vector<double> arcs;                      ///< lengths
    int stops = 0;
};
Plot read_gcode(const std::string& text, const Page& page, bool by_z) {
    Plot plot;
    std::istringstream lines(text);
    std::string line;
    bool down = false;
    bool ended = false;
    double feed = 0;
    glm::dvec2 at(0.0);
    Samples samples(spacing);
    samples.start(at);
    while (std::getline(lines, line)) {
        EXPECT_FALSE(ended) << line;
        EXPECT_LE(line.size(), 79u) << "grbl takes no longer ones";
        if (line.starts_with('(')) continue;
        std::map<char, double> words;
        int motion = -1;
        for (std::size_t i = 0; i < line.size();) {
            const char letter = line[i];
            double value = 0;
            const auto [stop, error] = std::from_chars(line.data() + i + 1, line.data() + line.size(), value);
            EXPECT_EQ(error, std::errc()) << line;
            i = static_cast<std::size_t>(stop - line.data());
            EXPECT_TRUE(i == line.size() || line[i] == ' ') << line;
            while (i < line.size() && line[i] == ' ') ++i;
            if (letter == 'G' && value <= 3) motion = static_cast<int>(value);
            words[letter] = value;
        }
        const bool lowers = by_z ? words.contains('Z') && words['Z'] <= 0 : words.contains('M') && words['M'] == 3;
        const bool lifts = by_z ? words.contains('Z') && words['Z'] > 0 : words.contains('M') && words['M'] == 5;
        if (words.contains('F')) feed = words['F'];
        if (lowers) {
            EXPECT_FALSE(down);
            down = true;
            samples.start(at);
        }
        if (lifts) {
            if (down) plot.strokes.push_back(samples.points);
            down = false;
        }
        if (words.contains('M') && words['M'] == 0) ++plot.stops;
        EXPECT_FALSE(down && words.contains('M') && words['M'] <= 2);
        ended = words.contains('M') && words['M'] == 2;
        if (!words.contains('X')) continue;
        ++plot.moves[motion];
        EXPECT_EQ(down, motion != 0) << line;
        if (motion != 0) plot.feeds.push_back(feed);
        const glm::dvec2 end(words.at('X'), words.at('Y'));
        EXPECT_TRUE(end.x >= 0 && end.y >= 0 && end.x <= page.width && end.y <= page.height) << line;
        if (motion == 1) samples.line(end);
        if (motion >= 2) {
            const glm::dvec2 centre = at + glm::dvec2(words.at('I'), words.at('J'));
            EXPECT_NEAR(glm::distance(at, centre), glm::distance(end, centre), 0.004) << line;
            EXPECT_NE(end, at) << line;
            const std::size_t first = samples.points.size() - 1;
            samples.arc(centre, end, motion == 3);
            double length = 0;
            for (std::size_t k = first + 1; k < samples.points.size(); ++k) {
                length += glm::distance(samples.points[k - 1], samples.points[k]);
            }
            plot.arcs.push_back(length);
        }
        at = end;
    }
    EXPECT_TRUE(ended);
    return plot;
}

class Gcode : public ::testing::Test {
protected:
    std::string text(const PlotPlan& plan, const Print& print) {
        write_print(
            folder_ / "plot.nc", print,
            [&](const Print& is, OutputFile& file) { return write_gcode(is, options_, file); },
            [&](PathSink& sink) { plan.draw(sink); });
        std::string whole = contents(folder_ / "plot.nc");
        for (std::size_t at = 0; (at = whole.find("(recipe: ")) != std::string::npos;) {
            whole.erase(at, whole.find('\n', at) + 1 - at);
        }
        return whole;
    }
    Plot expect_faithful(const Print& print, const PlotPlan& plan) {
        Plot plot = read_gcode(text(plan, print), print.page, by_z_);
        const auto lines = true_lines(plan, print, spacing);
        EXPECT_EQ(plot.strokes.size(), lines.size());
        for (std::size_t i = 0; i < std::min(lines.size(), plot.strokes.size()); ++i) {
            EXPECT_LE(hausdorff(plot.strokes[i], lines[i]), 0.01) << i;
        }
        for (const double feed : plot.feeds) EXPECT_EQ(feed, 2400);
        return plot;
    }
    ScratchFolder folder_;
    /// Lifts along Z.
    void use_z() {
        options_ = bundled_profile("z").value().gcode;
        by_z_ = true;
    }
    GcodeOptions options_;
    bool by_z_ = false;
};

TEST_F(Gcode, IsWhatAMachineTakes) {
    Print print = plain_print();
    print.title = "Naïve (left) kolam\n";
    const auto plan = arranged(print, [](PathSink& sink) {
        sink.begin_stroke({10, 10}, Pen{});
        sink.lines(std::vector<glm::dvec2>{{90, 10}, {90, 50.0126}});
        sink.end_stroke(false);
        sink.begin_stroke({20, 20}, Pen{.colour = 2});
        sink.lines(std::vector<glm::dvec2>{{20, 30}});
        sink.end_stroke(true);
    });
    EXPECT_EQ(
        text(*plan, print),
        "(title: Na_ve left kolam)\nG21 G90 G17\nM5\nG4 P0.2\n(pen 1: black)\nG0 X10 Y10 F4800\nM3 S1000\nG4 P0.2\n"
        "G1 X90 Y10 F2400\n"
        "G1 X90 Y50.013\nM5\nG4 P0.2\n(pen 2: blue)\nT2\nM0\nG0 X20 Y30 F4800\nM3 S1000\nG4 P0.2\nG1 X20 Y20 "
        "F2400\nM5\n"
        "G4 P0.2\nG0 X0 Y0\nM2\n");
    use_z();
    options_.start = "$H";
    options_.end = "M30\n";
    print.title.clear();
    EXPECT_EQ(text(*arranged(print,
                             [](PathSink& sink) {
                                 sink.begin_stroke({10, 10}, Pen{});
                                 sink.lines(std::vector<glm::dvec2>{{20, 10}});
                                 sink.end_stroke(false);
                             }),
                   print),
              "G21 G90 G17\n$H\nG0 Z5\n(pen 1: black)\nG0 X10 Y10 F4800\nG1 Z0 F600\nG1 X20 Y10 F2400\nG0 Z5\nM30\n");
}

TEST_F(Gcode, TheEndMayReturnThePen) {
    const auto home = [&](const std::string& end) {
        options_.end = end;
        return gcode_home(options_);
    };
    EXPECT_EQ(gcode_home({}), glm::dvec2(0, 0));
    EXPECT_EQ(home("g0 x10 y-5.5\nM5\nM2"), glm::dvec2(10, -5.5));
    EXPECT_EQ(home("G0 X1\nG1 F100 Y2 X3 ; X9 Y9\n(G0 X8 Y8)"), glm::dvec2(3, 2));
    for (const char* none : {"", "M2", "G28", "G92 X0 Y0", "G0 X0", "(G0 X0 Y0", "; G0 X0 Y0"}) {
        EXPECT_FALSE(home(none)) << none;
    }
}

TEST_F(Gcode, CurvesAreWithinAHundredthOfAMillimetre) {
    const Print print = plain_print();
    EXPECT_EQ(expect_faithful(print, *arranged(print, draw_curves)).stops, 2);
    use_z();
    expect_faithful(print, *arranged(print, draw_sampler));
}

TEST_F(Gcode, ArcsCanBeLeftOutOrHaveAMinimumLength) {
    const Print print = plain_print();
    const auto plan = arranged(print, draw_curves);
    const Plot all = expect_faithful(print, *plan);
    options_.arcs = false;
    const Plot none = expect_faithful(print, *plan);
    EXPECT_FALSE(none.moves.contains(2) || none.moves.contains(3));
    EXPECT_GT(none.moves.at(1), all.moves.at(1));
    options_.arcs = true;
    options_.least_arc = 5;
    const Plot long_ones = expect_faithful(print, *plan);
    const auto arcs = [](const Plot& plot) {
        return (plot.moves.contains(2) ? plot.moves.at(2) : 0) + (plot.moves.contains(3) ? plot.moves.at(3) : 0);
    };
    EXPECT_LT(arcs(long_ones), arcs(all));
    EXPECT_GT(arcs(long_ones), 0u);
    for (const double length : all.arcs) EXPECT_GT(length, 0);
    EXPECT_LT(*std::min_element(all.arcs.begin(), all.arcs.end()), 5);
    for (const double length : long_ones.arcs) EXPECT_GE(length, 4.999);
}

TEST_F(Gcode, DiscsAreSpiralsOfArcs) {
    const Print print = plain_print();
    for (const double radius : {1.0, 10.0, 29.0}) {
        const auto plan = arranged(print, [&](PathSink& sink) { sink.disc({50, 30}, radius, Pen{}); });
        const Plot plot = expect_faithful(print, *plan);
        // A spiral from the edge inwards.
        const auto count = [&](int move) { return plot.moves.contains(move) ? plot.moves.at(move) : 0; };
        EXPECT_GE(count(2) + count(3), 2U) << radius;
        EXPECT_LE(count(1), 1U) << radius;
    }
}

TEST_F(Gcode, AKolamTakesFewerArcsThanChords) {
    const PlacedPattern kolam("kolams/snake-kolam", 3, {105, 148, 10});
    const auto plan = arranged(kolam.print, [&](PathSink& sink) { kolam.read(sink); });
    Plot plot = expect_faithful(kolam.print, *plan);
    EXPECT_EQ(plot.strokes.size(), 1u);
    RecordProperty("lines", static_cast<int>(plot.moves[1]));
    RecordProperty("arcs", static_cast<int>(plot.moves[2] + plot.moves[3]));
    EXPECT_LT(plot.moves[1] + plot.moves[2] + plot.moves[3], 340u * 4);
    EXPECT_GT(plot.moves[2] + plot.moves[3], plot.moves[1]);
}

TEST_F(Gcode, AVeryLongCurveIsFollowedInPieces) {
    Print print = plain_print();
    print.page = {2000, 2000, 10};
    print.placement.to_page[2].y = 2000;
    std::vector<glm::dvec2> controls;
    for (int i = 0; i < 3000; ++i) {
        const double angle = 0.02 * i;
        controls.push_back(glm::dvec2(1000, 1000) + 15 * angle * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    const auto plan = arranged(print, [&](PathSink& sink) {
        sink.begin_stroke({1000, 1000}, Pen{});
        sink.curves(controls);
        sink.end_stroke(false);
    });
    const std::string written = text(*plan, print);
    const Plot plot = read_gcode(written, print.page, false);
    EXPECT_EQ(plot.strokes.size(), 1u);
    EXPECT_LT(written.size(), 100'000u);
}

TEST_F(Gcode, OptionsAreChecked) {
    const Print print = plain_print();
    const auto plan = arranged(print, draw_curves);
    const auto refused = [&](auto member, double value) {
        options_ = {};
        options_.*member = value;
        EXPECT_THROW(text(*plan, print), std::runtime_error) << value;
    };
    for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        refused(&GcodeOptions::drawing_feed, bad);
        refused(&GcodeOptions::travel_feed, bad);
    }
    refused(&GcodeOptions::pause, std::nan(""));
    refused(&GcodeOptions::pause, -1);
    refused(&GcodeOptions::least_arc, -1);
    refused(&GcodeOptions::lift, std::nan(""));
    refused(&GcodeOptions::down, std::nan(""));
    options_ = {};
    options_.pen_up = "M5 {heigth}";
    EXPECT_THROW(text(*plan, print), std::runtime_error);
    options_ = {};
    const auto outside = arranged(print, [](PathSink& sink) { sink.disc({50, 30}, 33, Pen{}); });
    EXPECT_THROW(text(*outside, print), std::runtime_error);
    EXPECT_EQ(folder_.names(), std::vector<std::string>{});
}

/// The lines of a document's G-code without comments.
std::vector<std::string> commands_of(const Document& document, const OptionValues& values) {
    std::istringstream text(draw(document, "gcode", values));
    std::vector<std::string> commands;
    for (std::string line; std::getline(text, line);) {
        if (!line.starts_with('(')) commands.push_back(line);
    }
    return commands;
}

TEST_F(Gcode, RedundantMovesAreOmitted) {
    for (const char* name : {"plants/lily-of-the-valley", "kolams/snake-kolam", "tilings/penrose-rhombs"}) {
        std::string at;
        for (const std::string& line : commands_of(load(bundled(name)), {})) {
            const std::size_t x = line.find('X'), y = line.find(' ', line.find('Y'));
            if (line.starts_with("M0")) at.clear();
            if (x == std::string::npos) continue;
            const std::string place = line.substr(x, y - x);
            EXPECT_NE(place, at) << name << ": " << line;
            at = place;
        }
    }
}

TEST_F(Gcode, ALaserIsOffUnlessItMovesAndNeverWaits) {
    const Document kolam = load(bundled("kolams/snake-kolam"));
    bool is_on = false;
    std::size_t cuts = 0;
    const auto commands = commands_of(kolam, {{"profile", "grbl-laser"}, {"border", "kaavi"}, {"dots", "2mm"}});
    for (const std::string& line : commands) {
        EXPECT_FALSE(line.starts_with("G4") || line.starts_with("M3")) << line;
        EXPECT_FALSE(is_on && (line.starts_with("G0") || line.starts_with("M0"))) << line;
        if (line.starts_with("M4")) {
            EXPECT_EQ(line, "M4 S500");
        }
        is_on = line.starts_with("M4") || (is_on && !line.starts_with("M5"));
        if (line.size() > 2 && line[0] == 'G' && line[1] >= '1' && line[1] <= '3' && line[2] == ' ') {
            EXPECT_TRUE(is_on) << line;
            ++cuts;
        }
    }
    EXPECT_GT(cuts, 100u);
    EXPECT_FALSE(is_on);
    ASSERT_GE(commands.size(), 3u);
    EXPECT_EQ(commands[commands.size() - 3], "M5");
}

}  // namespace sikku::gcode_test
