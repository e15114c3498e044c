// tests/art/plotter_test.cpp: plotters described by files, and plots that are parked, refilled and resumed, as a
// small machine that reads G-code sees them.
#include "art/plotter/profile.h"

#include "art/plotter/gcode.h"
#include "art/plotter/hpgl.h"
#include "engine/base/option.h"
#include "engine/base/output.h"
#include "tests/checks.h"
#include "tests/plot_tools.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <regex>
#include <sstream>

namespace sikku::plotter_test {

using Points = std::vector<glm::dvec2>;

/// What a machine does, line after line: it reads one command a line, as Marlin does.
struct Event {
    enum class Kind { draw, travel, lower, lift, wait, stop, tool } kind;
    glm::dvec2 at{0.0};  ///< where it ends
    double value = 0;    ///< speed in mm/s, height, seconds, number of the tool
    int pen = 1;
};

class Machine {
public:
    explicit Machine(const PlotterProfile& profile) : is_marlin_(profile.gcode.comment == ';') {
        by_z_ = profile.gcode.pen_up.find('Z') != std::string::npos;
    }

    std::vector<Event> run(const std::string& text) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            static const std::regex pen(R"((\(|; )pen (\d+): .*)");
            std::smatch match;
            if (std::regex_match(line, match, pen)) pen_ = std::stoi(match[2]);
            if (line.starts_with(is_marlin_ ? ";" : "(")) continue;
            EXPECT_EQ(line.find_first_of("(;"), std::string::npos) << line;
            execute(line);
        }
        return events_;
    }

private:
    void add(Event::Kind kind, double value = 0) { events_.push_back({kind, at_, value, pen_}); }

    void execute(const std::string& line) {
        if (line.starts_with("M0")) return add(Event::Kind::stop);
        std::istringstream words(line);
        std::map<char, double> values;
        int commands = 0;
        for (std::string word; words >> word;) {
            commands += word[0] == 'G' || word[0] == 'M' || word[0] == 'T' ? 1 : 0;
            EXPECT_NO_THROW(values[word[0]] = std::stod(word.substr(1))) << line;
        }
        if (is_marlin_) {
            EXPECT_EQ(commands, 1) << "Marlin reads one command a line: " << line;
            EXPECT_NE(line[0], 'T') << "another extruder";
        }
        if (values.contains('T')) add(Event::Kind::tool, values['T']);
        if (values.contains('F')) feed_ = values['F'];
        if (values.contains('M')) {
            if (values['M'] == 3) add(Event::Kind::lower, values['S']);
            if (values['M'] == 5) add(Event::Kind::lift);
            if (values['M'] == 280) add(values['S'] > 70 ? Event::Kind::lower : Event::Kind::lift, values['S']);
            return;
        }
        if (!values.contains('G')) return;
        if (values['G'] == 4) return add(Event::Kind::wait, values['P'] / (is_marlin_ ? 1000 : 1));
        if (values.contains('Z')) {
            EXPECT_TRUE(by_z_);
            return add(values['Z'] > 0.5 ? Event::Kind::lift : Event::Kind::lower, values['Z']);
        }
        if (!values.contains('X')) return;
        at_ = {values['X'], values['Y']};
        add(values['G'] == 0 ? Event::Kind::travel : Event::Kind::draw, feed_ / 60);
    }

    bool is_marlin_, by_z_;
    double feed_ = 0;
    int pen_ = 1;
    glm::dvec2 at_{0.0};
    std::vector<Event> events_;
};

/// Twenty separate lines of 20 mm in black, and ten in blue.
void draw_lines(PathSink& sink) {
    for (int i = 0; i < 30; ++i) {
        const glm::dvec2 start(10 + 25.0 * (i % 3), 5 + 1.7 * i);
        sink.begin_stroke(start, Pen{.colour = i < 20 ? 0 : 2});
        sink.lines(Points{start + glm::dvec2(20, 0)});
        sink.end_stroke(false);
    }
}

class Plotter : public ::testing::Test {
protected:
    std::string gcode(const PlotterProfile& profile, const PlotOptions& options = {}) {
        const auto plan = arranged(print_, draw_lines, options);
        GcodeOptions gcode = profile.gcode;
        gcode.rules = options.rules;
        gcode.park = options.park;
        MemoryDestination memory;
        {
            const auto output = memory.open("plot.gcode");
            const auto writer = write_gcode(print_, gcode, *output);
            std::vector<Pen> pens;
            for (const PlotPlan::PlottedPen& pen : plan->pens()) pens.push_back(pen.pen);
            writer->number_pens(pens);
            plan->draw(*writer, [&](glm::dvec2 place, const Pen& pen) { writer->dip(place, pen); });
            writer->finish();
            output->commit();
        }
        report_ = plan->report();
        return memory.outputs().at("plot.gcode");
    }
    std::vector<Event> events(const PlotterProfile& profile, const PlotOptions& options = {}) {
        return Machine(profile).run(gcode(profile, options));
    }
    static double drawn(const std::vector<Event>& events) {
        double sum = 0;
        glm::dvec2 at(0.0);
        for (const Event& event : events) {
            if (event.kind == Event::Kind::draw) sum += glm::distance(at, event.at);
            at = event.at;
        }
        return sum;
    }

    Print print_ = plain_print();
    PlotReport report_;
};

TEST_F(Plotter, BundledProfilesAreRead) {
    std::string before;
    for (const BundledProfile& known : bundled_profiles()) {
        EXPECT_LT(before, known.name);
        before = known.name;
        const auto profile = bundled_profile(known.name);
        ASSERT_TRUE(profile) << known.name;
        EXPECT_FALSE(profile->title.empty());
    }
    EXPECT_FALSE(bundled_profile("roland"));
    PlotterProfile plain;
    EXPECT_EQ(gcode(*bundled_profile("grbl")), gcode(plain)) << "grbl is what is used without a profile";
    EXPECT_EQ(bundled_profile("hp7475a")->pens, 6);
    EXPECT_TRUE(bundled_profile("hp7475a")->paper->is_hp7475a);
}

TEST_F(Plotter, EveryProfileOfGcodeDrawsTheSame) {
    for (const char* name : {"grbl", "z", "marlin", "marlin-z"}) {
        const PlotterProfile profile = bundled_profile(name).value();
        const auto list = events(profile);
        EXPECT_NEAR(drawn(list), 600, 1e-6) << name;
        const auto count = [&](Event::Kind kind) {
            return std::count_if(list.begin(), list.end(), [&](const Event& event) { return event.kind == kind; });
        };
        EXPECT_EQ(count(Event::Kind::lower), 30) << name;
        EXPECT_EQ(count(Event::Kind::stop), 1) << name;
        EXPECT_EQ(count(Event::Kind::wait) > 0, profile.gcode.pause > 0) << name;
        for (const Event& event : list) {
            if (event.kind == Event::Kind::wait) {
                EXPECT_EQ(event.value, profile.gcode.pause) << name;
            }
        }
        bool down = false;
        for (const Event& event : list) {
            if (event.kind == Event::Kind::lower || event.kind == Event::Kind::lift) {
                down = event.kind == Event::Kind::lower;
            }
            if (event.kind == Event::Kind::draw) {
                EXPECT_TRUE(down) << name;
            }
            if (event.kind == Event::Kind::travel || event.kind == Event::Kind::stop) {
                EXPECT_FALSE(down) << name;
            }
        }
    }
}

TEST_F(Plotter, ErrorsOfAProfileHaveTheirPlaces) {
    const auto errors = [](const std::string& text) -> std::string {
        return error_of<PatternError>([&] { parse_profile("my.plotter", text); });
    };
    const std::string all = errors(
        "// mine\nlanguage: G-code\npen up M5\npen upp: M5\nspeed: fast\npen down: M3 S{power}\npaper: A4\nlift:\n"
        "down: 3\ndown: 4\npen: 2 sped=3\n");
    for (const char* part : {"my.plotter:3:1: expected a key and its value",
                             "my.plotter:4:1: unknown key 'pen upp' of a plotter; did you "
                             "mean 'pen up'?",
                             "my.plotter:5:8: expected a speed", "my.plotter:6:15: unknown placeholder {power}",
                             "my.plotter:7:1: 'paper' does not apply to a plotter that reads G-code",
                             "my.plotter:8:1: the value of 'lift'", "my.plotter:10:1: 'down' is set twice",
                             "my.plotter:11:6: unknown setting 'sped' of a pen; did you mean"}) {
        EXPECT_TRUE(has(all, part)) << part << "\n" << all;
    }
    EXPECT_TRUE(has(errors("speed: 3\n"), "1:1: the language of the plotter is missing"));
    EXPECT_TRUE(has(errors("language: logo\n"), "expected G-code, HP-GL or SVG"));
    EXPECT_EQ(errors("language: g-code\npen up: G0 Z{lift}\npen up: G4 P0.1\npen: 1 speed=3\npen: red down=2\n"), "");
    const ScratchFolder folder;
    EXPECT_THROW(read_profile(folder / "none.plotter"), std::runtime_error);
    EXPECT_THROW(read_profile(folder.write("large.plotter", std::string(70'000, ' '))), std::runtime_error);
    EXPECT_EQ(read_profile(folder.write("mine.plotter", "language: HP-GL\npark: 1cm,-20\n")).park,
              glm::dvec2(10, -20));
}

/// Opening a pipe waits for its writer, for ever.
TEST_F(Plotter, PipesAreNotProfiles) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
    EXPECT_THROW(read_profile(folder / "pipe"), std::runtime_error);
}

TEST_F(Plotter, DamagedProfilesAreErrorsAndNothingElse) {
    std::mt19937 random(5);
    for (const BundledProfile& known : bundled_profiles()) {
        for (int round = 0; round < 300; ++round) {
            std::string text(known.text);
            for (auto changes = 1 + random() % 4; changes > 0; --changes) {
                const std::size_t at = random() % text.size();
                switch (random() % 3) {
                    case 0:
                        text[at] = static_cast<char>(random() % 256);
                        break;
                    case 1:
                        text.erase(at, 1 + random() % 5);
                        break;
                    default:
                        text.insert(at, text.substr(random() % text.size(), 1 + random() % 9));
                        break;
                }
            }
            try {
                const PlotterProfile profile = parse_profile("damaged", text);
                EXPECT_TRUE(std::isfinite(profile.speeds.drawing) && profile.speeds.drawing > 0);
            } catch (const PatternError& error) {
                EXPECT_FALSE(error.diagnostics().empty());
            }
        }
    }
}

TEST_F(Plotter, PensHaveTheirOwnSpeedHeightsAndPauses) {
    const PlotterProfile profile = bundled_profile("z").value();
    PlotOptions options;
    options.rules = {parse_pen_rule("2 speed=10mm/s lift=8mm down=-0.3 pause=0.25s", 96),
                     parse_pen_rule("black speed=30", 96)};
    const auto list = events(profile, options);
    for (const Event& event : list) {
        if (event.kind == Event::Kind::draw) {
            EXPECT_EQ(event.value, event.pen == 2 ? 10 : 30);
        }
        if (event.kind == Event::Kind::lower) {
            EXPECT_EQ(event.value, event.pen == 2 ? -0.3 : 0);
        }
        if (event.kind == Event::Kind::wait) {
            EXPECT_EQ(event.value, 0.25);
        }
        if (event.kind == Event::Kind::wait) {
            EXPECT_EQ(event.pen, 2) << "only this pen pauses";
        }
    }
    // A pen that is lifted higher is raised before it travels.
    const auto stop =
        std::find_if(list.begin(), list.end(), [](const Event& event) { return event.kind == Event::Kind::stop; });
    ASSERT_NE(stop, list.end());
    const auto raised = std::find_if(stop, list.end(), [](const Event& event) { return event.value == 8; });
    const auto travel =
        std::find_if(stop, list.end(), [](const Event& event) { return event.kind == Event::Kind::travel; });
    EXPECT_LT(raised - stop, travel - stop);
    // 400 mm at 30 mm/s, 200 mm at 10 mm/s, and 10 lifts with 2 pauses.
    const PlotSpeeds speeds{40, 1e6, 0};
    EXPECT_NEAR(plot_seconds(report_.after, report_.pens, speeds), 400.0 / 30 + 200.0 / 10 + 10 * 0.5, 0.01);
}

/// A drawing in the best order already is as long before as after: both dip the brush.
TEST_F(Plotter, RefillsCountBeforeAsAfter) {
    const auto draw = [](PathSink& sink) {
        for (const double y : {10.0, 20.0, 30.0}) {
            sink.begin_stroke({0, y}, {});
            sink.lines(Points{{20, y}});
            sink.end_stroke(false);
        }
    };
    for (const double length : {20.0, 40.0, 1000.0}) {
        PlotOptions options;
        options.refill = Refill{length, {5, 1}};
        const auto plan = arranged(print_, draw, options);
        const PlotReport& report = plan->report();
        EXPECT_EQ(report.before.lifts, report.after.lifts) << length;
        EXPECT_GE(report.before.travelled, report.after.travelled - 1e-9) << length;
        ASSERT_EQ(report.pens_before.size(), 1u);
        EXPECT_EQ(report.pens_before[0].lifts, report.before.lifts);
    }
}

TEST_F(Plotter, RulesOfPensAreRead) {
    const PenRule rule = parse_pen_rule(" #0000ff  speed=5  refill=2m@1cm,-3mm ", 96);
    EXPECT_EQ(rule.colour, (Colour{0, 0, 255, 255}));
    EXPECT_EQ(rule.settings.refill, (Refill{2000, {10, -3}}));
    for (const char* wrong :
         {"", "2", "0 speed=3", "300 speed=3", "1.5 speed=3", "ochre speed=3", "2 speed", "2 speed=", "2 speed=0",
          "2 pause=2h", "2 lift=high", "2 refill=5m", "2 refill=1mm@0,0", "2 refill=5m@0", "2 refill=5m@1e9,0"}) {
        EXPECT_THROW(parse_pen_rule(wrong, 96), std::runtime_error) << wrong;
    }
    const std::vector<PenRule> rules = {parse_pen_rule("2 speed=3 pause=1", 96), parse_pen_rule("blue speed=4", 96)};
    const Colour blue{0, 0, 255, 255};
    EXPECT_EQ(pen_settings(rules, 2, blue).speed, 4.0);
    EXPECT_EQ(pen_settings(rules, 2, blue).pause, 1.0);
    EXPECT_EQ(pen_settings(rules, 1, Colour{}), PenSettings{});
}

TEST_F(Plotter, PensAreChangedAtTheParkingPlace) {
    PlotOptions options;
    options.park = glm::dvec2(-5, 70);
    for (const char* name : {"grbl", "marlin"}) {
        int stops = 0;
        for (const Event& event : events(bundled_profile(name).value(), options)) {
            if (event.kind != Event::Kind::stop) continue;
            ++stops;
            EXPECT_EQ(event.at, glm::dvec2(-5, 70));
        }
        EXPECT_EQ(stops, 1);
    }
    const double with = report_.after.travelled;
    events(bundled_profile("grbl").value());
    EXPECT_GT(with, report_.after.travelled) << "the way there and back counts";
}

TEST_F(Plotter, APenIsRefilledBeforeItRunsDry) {
    const PlotterProfile profile = bundled_profile("grbl").value();
    PlotOptions options;
    for (const double length : {15.0, 70.0, 150.0, 5000.0}) {
        options.refill = Refill{length, {-10, 20}};
        const auto list = events(profile, options);
        EXPECT_NEAR(drawn(list), 600, 1e-4) << "everything is drawn";
        std::map<int, double> used;  // since the last dip, by pen
        std::map<int, int> dips;
        glm::dvec2 at(0.0);
        int pieces = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const Event& event = list[i];
            if (event.kind == Event::Kind::lower) {
                const bool is_dip = event.at == glm::dvec2(-10, 20);
                pieces += is_dip ? 0 : 1;
                if (is_dip) {
                    used[event.pen] = 0;
                    ++dips[event.pen];
                } else {
                    EXPECT_TRUE(used.contains(event.pen)) << "a pen is dipped first";
                }
            }
            if (event.kind == Event::Kind::draw) {
                used[event.pen] += glm::distance(at, event.at);
                EXPECT_LE(used[event.pen], length + 1e-6);
            }
            at = event.at;
        }
        // A filling suffices for so many of the lines of 20 mm.
        const int lines = static_cast<int>(length / 20);
        if (lines > 0) {
            EXPECT_EQ(dips[1], (20 + lines - 1) / lines);
            EXPECT_EQ(dips[2], (10 + lines - 1) / lines);
            EXPECT_EQ(pieces, 30) << "no line is interrupted";
        } else {
            EXPECT_EQ(pieces, 60) << "lines of 20 mm take two fillings for 15 mm";
        }
        EXPECT_EQ(report_.after.lifts, static_cast<std::uint64_t>(pieces + dips[1] + dips[2]));
    }
    options.refill = Refill{5000, {-10, 20}};
    options.rules = {parse_pen_rule("2 refill=5m@0,0", 96)};
    std::map<int, glm::dvec2> inks;
    for (const Event& event : events(profile, options)) {
        if (event.kind == Event::Kind::lower) inks.try_emplace(event.pen, event.at);
    }
    EXPECT_EQ(inks[1], glm::dvec2(-10, 20));
    EXPECT_EQ(inks[2], glm::dvec2(0, 0)) << "each pen has its own ink";
}

TEST_F(Plotter, APlotResumes) {
    const PlotterProfile profile = bundled_profile("grbl").value();
    const auto whole = events(profile);
    for (const double length : {1.0, 19.0, 250.0, 410.0, 599.0}) {
        PlotOptions options;
        options.resume = length;
        const auto rest = events(profile, options);
        const double left = drawn(rest);
        EXPECT_GE(left, 600 - length - 1e-6) << "nothing is missing";
        EXPECT_LE(left, 600 - length + 20 + 1e-6) << "one line at most is drawn again";
        EXPECT_NEAR(report_.after.drawn, left, 1e-4);
        // What is drawn is the end of the whole plot, with the same pens.
        auto a = whole.rbegin();
        for (auto b = rest.rbegin(); b != rest.rend() && b->kind != Event::Kind::travel; ++a, ++b) {
            EXPECT_EQ(a->at, b->at);
            EXPECT_EQ(a->pen, b->pen);
        }
    }
    PlotOptions options;
    options.resume = 600.5;
    try {
        events(profile, options);
        ADD_FAILURE() << "is accepted";
    } catch (const SettingError& error) {
        EXPECT_EQ(error.option(), "resume");
        EXPECT_EQ(error.message(), "the whole plot draws only 0.60 m");
    }
}

TEST_F(Plotter, HpglParksDipsAndSetsSpeeds) {
    PlotOptions options;
    options.park = glm::dvec2(0, 50);
    options.refill = Refill{5000, {5, 1}};
    options.rules = {parse_pen_rule("2 speed=105mm/s", 96)};
    const auto plan = arranged(print_, draw_lines, options);
    MemoryDestination memory;
    const auto output = memory.open("plot.hpgl");
    HpglOptions hpgl;
    hpgl.park = options.park;
    hpgl.rules = options.rules;
    const auto writer = write_hpgl(print_, hpgl, *output);
    plan->draw(*writer, [&](glm::dvec2 place, const Pen& pen) { writer->dip(place, pen); });
    writer->finish();
    output->commit();
    const std::string text = memory.outputs().at("plot.hpgl");
    EXPECT_TRUE(text.starts_with("IN;\nPU;SP1;\nVS4;\nPU200,40;PD;PU;\nPU")) << text.substr(0, 80);
    EXPECT_TRUE(has(text, "PU;PU0,2000;SP2;\nVS10.5;\nPU200,40;PD;PU;\n"));
}

TEST_F(Plotter, LayersAreNamedForAxiDraw) {
    const Colour navy{0, 0, 128, 255};
    const LayerCodes codes = bundled_profile("axidraw").value().layers;
    EXPECT_EQ(layer_name(2, navy, {}, {}), "2 navy");
    EXPECT_EQ(layer_name(1, navy, {}, codes), "1 navy");
    EXPECT_EQ(layer_name(2, navy, {}, codes), "!2 navy");
    EXPECT_EQ(layer_name(2, navy, {.speed = 80.32, .down = 40, .pause = 0.5}, codes), "!2+S40+H40+D500 navy");
    EXPECT_EQ(layer_name(3, navy, {.speed = 1e6, .down = 400}, {.full_speed = 200, .pauses = false}),
              "3+S110+H100 navy");
}

/// Strokes that are already in a good order, in a bad one, repeated, crossing, of lines and of curves.
void draw_at_random(PathSink& sink, std::mt19937& random) {
    std::uniform_real_distribution<double> place(0, 90);
    const auto whole = [&](unsigned most) { return static_cast<int>(random() % most); };
    const bool on_grid = random() % 2 == 0;
    const auto point = [&] {
        return on_grid ? glm::dvec2(10 * whole(6), 10 * whole(6)) : glm::dvec2(place(random), place(random) * 0.6);
    };
    for (int stroke = 1 + whole(40); stroke > 0; --stroke) {
        sink.begin_stroke(point(), Pen{.colour = whole(3)});
        for (int piece = 1 + whole(5); piece > 0; --piece) {
            if (random() % 3 == 0) {
                sink.curves(Points{point(), point(), point()});
            } else {
                sink.lines(Points{point()});
            }
        }
        sink.end_stroke(false);
    }
}

TEST_F(Plotter, ArrangingNeverMakesAPlotWorse) {
    std::mt19937 random(20);
    const std::array<PlotSpeeds, 4> machines = {{{40, 80, 0.3}, {40, 80, 0.0}, {300, 5, 0.01}, {10, 1000, 5}}};
    int improved = 0;
    for (int round = 0; round < 400; ++round) {
        const auto seed = static_cast<unsigned>(random());
        PlotOptions options;
        options.speeds = machines[static_cast<std::size_t>(round) % machines.size()];
        if (round % 3 == 0) options.home = glm::dvec2(0, 0);
        if (round % 5 == 0) options.park = glm::dvec2(-20, 30);
        const auto plan = arranged(
            print_,
            [&](PathSink& sink) {
                std::mt19937 same(seed);
                draw_at_random(sink, same);
            },
            options);
        const PlotReport& report = plan->report();
        EXPECT_LE(report.after.lifts, report.before.lifts) << round;
        EXPECT_LE(report.after.drawn, report.before.drawn * (1 + 1e-6)) << round;
        const double before = plot_seconds(report.before, options.speeds);
        const double after = plot_seconds(report.after, options.speeds);
        EXPECT_LE(after, before * (1 + 1e-6)) << round;
        improved += after < 0.9 * before ? 1 : 0;
    }
    EXPECT_GT(improved, 100) << "it is not merely left as it was";
}

}  // namespace sikku::plotter_test
