// tests/program/signals_test.cpp: ctrl-C, SIGTERM and SIGHUP stop long work and leave no files behind.
#include "art/kolam/kolam.h"
#include "art/plotter/plot.h"
#include "engine/base/monitor.h"
#include "tests/print_tools.h"
#include "tests/program.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace sikku::signals_test {

/// Says yes when it is asked for the n-th time.
struct StopAfter {
    std::atomic<int> questions{0};
    int most;
    explicit StopAfter(int n) : most(n) {}
    Monitor monitor() {
        return Monitor(
            [](void* context) {
                auto* self = static_cast<StopAfter*>(context);
                return ++self->questions > self->most;
            },
            nullptr, this);
    }
};

TEST(Monitor, ByItselfLetsEverythingRun) {
    const Monitor monitor;
    EXPECT_FALSE(monitor.stop_requested());
    EXPECT_NO_THROW(monitor.advance(5));
    Pulse pulse(monitor);
    for (int i = 0; i < 10'000; ++i) pulse();
}

TEST(Monitor, CountsAndStops) {
    struct State {
        std::uint64_t units = 0;
        bool stops = false;
    } state;
    const Monitor monitor([](void* context) { return static_cast<State*>(context)->stops; },
                          [](void* context, std::uint64_t units) { static_cast<State*>(context)->units += units; },
                          &state);
    monitor.advance(3);
    monitor.advance(4);
    EXPECT_EQ(state.units, 7u);
    state.stops = true;
    EXPECT_THROW(monitor.check(), Stopped);
    EXPECT_THROW(monitor.advance(1), Stopped);
    std::vector<int> numbers(100'000);
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<int>(i * 7919 % numbers.size());
    EXPECT_THROW(std::sort(numbers.begin(), numbers.end(), stoppable(monitor, std::less<>())), Stopped);
}

/// Strokes across each other, which have to be joined and routed.
void draw_strokes(PathSink& sink, int count) {
    for (int i = 0; i < count; ++i) {
        sink.begin_stroke({i % 100, i / 100}, Pen{});
        const glm::dvec2 end((i * 37) % 100, i / 100 + 0.5);
        sink.lines(std::span(&end, 1));
        sink.end_stroke(false);
    }
}

TEST(Signals, APlotAsksWhereverItIs) {
    Print print = plain_print();
    const auto work = [&](StopAfter& stop) {
        PlotOptions options;
        options.monitor = stop.monitor();
        PlotPlan plan(print, options);
        draw_strokes(plan, 20'000);
        plan.arrange();
        reference::Recorder sink;
        plan.draw(sink);
    };
    StopAfter never(1 << 30);
    work(never);
    ASSERT_GT(never.questions, 100);
    for (const int questions : {0, 5, never.questions / 2, never.questions - 1}) {
        StopAfter stop(questions);
        EXPECT_THROW(work(stop), Stopped) << questions;
        EXPECT_EQ(stop.questions, questions + 1) << "it goes on after it was stopped";
    }
}

TEST(Signals, TheExaminationOfAKolamAsksWhereverItIs) {
    const Grammar grammar = reference::grammar_of(
        "angle factor: 4\naxiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nderivation length: 8\n");
    const auto work = [&](StopAfter& stop) {
        KolamOptions options{.monitor = stop.monitor()};
        examine_kolam(grammar, options);
    };
    StopAfter never(1 << 30);
    work(never);
    ASSERT_GT(never.questions, 50);
    for (const int questions : {0, 5, never.questions / 2, never.questions - 1}) {
        StopAfter stop(questions);
        EXPECT_THROW(work(stop), Stopped) << questions;
    }
}

/// The program, run by a shell that does `first`.
std::vector<std::string> in_shell(const std::string& first, std::vector<std::string> arguments) {
    std::vector<std::string> words = {"-c", first + "; exec \"$0\" \"$@\"", SIKKU_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
}

const std::vector<std::string> endless = {"derive", "koch-island", "-n", "30"};

TEST(Signals, TheStatusNamesTheSignal) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        Child child(endless, {.output = "/dev/null"});
        child.await_handler(SIGHUP);
        child.send(signal);
        const Outcome outcome = child.wait();
        EXPECT_EQ(outcome.status, 128 + signal);
        EXPECT_EQ(outcome.errors, "sikku: interrupted\n");
    }
}

TEST(Signals, IgnoredOnesStayIgnored) {
    // As nohup does, and as a shell does with jobs in the background of a script.
    Child child(in_shell("trap '' HUP INT", endless), {.output = "/dev/null", .program = "bash"});
    child.await_handler(SIGTERM);
    child.send(SIGHUP);
    child.send(SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    child.send(SIGTERM);
    EXPECT_EQ(child.wait().status, 143) << "not 129 or 130";
}

TEST(Signals, TwoOfThemLeaveNothingHoweverManyFilesAreOpen) {
    const ScratchFolder folder;
    // Sheets stay open until all are drawn: more than a hundred.
    Child child({"draw", "hilbert", "-n", "9", "--size", "3000x3000mm", "--tile", "A4", "-o", folder.file("x.svg")});
    for (int i = 0; i < 10000 && folder.names().size() < 70; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_GE(folder.names().size(), 70u);
    child.send(SIGINT);
    child.send(SIGTERM);
    const int status = child.wait().status;
    EXPECT_TRUE(status == 130 || status == 143) << status;
    EXPECT_TRUE(folder.names().empty()) << folder.names().front();
}

TEST(Signals, LongWorkEndsSoonAndLeavesNothing) {
    // Each takes many seconds, most of them in what reads no word.
    const std::vector<std::vector<std::string>> commands = {
        {"draw", "hilbert", "-n", "12", "-o", "x.gcode"},
        {"draw", "hilbert", "-n", "11", "--plotter", "-o", "x.svg"},
        {"kolam", "hilbert", "-n", "11"},
        {"kolam", "--grid", "2000x2000", "--single-line", "-o", "x.lsys"},
        {"kolam", "--grid", "999x1000", "--single-line", "-o", "x.lsys"},
        {"kolam", "--grid", "6x6", "--symmetry", "C2", "--enumerate", "-o", "x.txt"},
        {"draw", "bush-3d", "-n", "9", "-o", "x.obj"},
        {"draw", "penrose-rhombs", "-n", "12", "--relief", "1mm,2mm", "--size", "1x1m", "-o", "x.stl"},
        {"draw", "hilbert", "-n", "11", "--colour-by", "strand", "-o", "x.pdf"},
    };
    for (const auto& command : commands) {
        SCOPED_TRACE(command[0] + " " + command[1] + " " + command.back());
        const ScratchFolder folder;
        Child child(command, {.folder = folder.path()});
        child.await_handler(SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        child.send(SIGTERM);
        const auto sent = std::chrono::steady_clock::now();
        const Outcome outcome = child.wait();
        EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(sanitized ? 20 : 5));
        if (outcome.status == 0) continue;  // on a quick machine
        EXPECT_EQ(outcome.status, 143) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, "sikku: interrupted"));
        EXPECT_TRUE(folder.names().empty()) << folder.names().front();
    }
}

}  // namespace sikku::signals_test
