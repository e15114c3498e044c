// tests/program/live_test.cpp: `sikku play --port`, to a terminal that stands for a MIDI device.
#include "music/scores.h"
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku::live_test {

/// A pair of a device and its other end.
class Device {
public:
    Device() : end_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
        if (end_ < 0 || grantpt(end_) != 0 || unlockpt(end_) != 0) std::abort();
        path_ = ptsname(end_);
        keep_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        termios modes{};
        tcgetattr(keep_, &modes);
        cfmakeraw(&modes);
        tcsetattr(keep_, TCSANOW, &modes);
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device() {
        close(keep_);
        close(end_);
    }
    const std::string& path() const { return path_; }

    /// Reads until `is_enough`, or for so many seconds.
    template <typename Test>
    bool read_until(Test&& is_enough, double seconds = 30) {
        const auto begin = std::chrono::steady_clock::now();
        while (!is_enough(bytes_)) {
            if (std::chrono::steady_clock::now() - begin > std::chrono::duration<double>(seconds)) return false;
            pollfd polled{end_, POLLIN, 0};
            poll(&polled, 1, 50);
            std::array<char, 4096> block{};
            const ssize_t count = read(end_, block.data(), block.size());
            if (count > 0) bytes_.append(block.data(), static_cast<std::size_t>(count));
        }
        return true;
    }
    void read_rest() {
        read_until([](const std::string&) { return false; }, 0.2);
    }
    void send(std::string_view bytes) const {
        if (write(end_, bytes.data(), bytes.size()) < 0) std::abort();
    }
    const std::string& bytes() const { return bytes_; }

private:
    int end_;
    int keep_ = -1;
    std::string path_;
    std::string bytes_;
};

struct Heard {
    int begun = 0;
    int ended = 0;
    std::set<int> programs;
    std::multiset<std::pair<int, int>> sounding;
    int clocks = 0;
    std::string commands;  ///< start, continue and stop, in their order: `s`, `c`, `x`
};

/// Reads whole messages of channels and of clocks.
Heard hear(const std::string& bytes) {
    Heard heard;
    for (std::size_t i = 0; i < bytes.size();) {
        const auto at = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<int>(static_cast<unsigned char>(bytes[i + k])) : 0;
        };
        const std::pair<int, int> key(at(0) & 0x0F, at(1));
        switch (at(0) & 0xF0) {
            case 0x90:
                ++heard.begun;
                heard.sounding.insert(key);
                break;
            case 0x80:
                ++heard.ended;
                if (heard.sounding.contains(key)) heard.sounding.erase(heard.sounding.find(key));
                break;
            case 0xC0:
                heard.programs.insert(at(1));
                break;
            default:
                break;
        }
        if (at(0) == 0xF8) ++heard.clocks;
        if (at(0) == 0xFA) heard.commands += 's';
        if (at(0) == 0xFB) heard.commands += 'c';
        if (at(0) == 0xFC) heard.commands += 'x';
        i += at(0) >= 0xF0 ? 1 : (at(0) & 0xF0) == 0xC0 ? 2 : 3;
    }
    return heard;
}

auto notes_begun(int count) {
    return [count](const std::string& bytes) { return hear(bytes).begun >= count; };
}

/// A bar lasts 240 ms.
const std::string curve =
    "axiom: X\nderivation length: 3\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\ntempo: 1000\ninstrument: Flute\n";

TEST(Live, PlaysToTheEnd) {
    Device device;
    const Outcome outcome = run({"play", "-", "--port", device.path(), "--clock", "send"}, {.input = curve});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "26 notes"));
    device.read_rest();
    const Heard heard = hear(device.bytes());
    EXPECT_EQ(heard.begun, 26);
    EXPECT_EQ(heard.ended, 26);
    EXPECT_TRUE(heard.sounding.empty());
    EXPECT_EQ(heard.programs, std::set<int>{73});
    EXPECT_EQ(heard.commands, "sx");
    EXPECT_EQ(heard.clocks, 16 * 24 + 1);
}

TEST(Live, CtrlCEndsAllNotes) {
    Device device;
    Child child({"play", "hilbert", "-n", "40", "--port", device.path(), "--tempo", "300", "--repeat"});
    ASSERT_TRUE(device.read_until(notes_begun(5)));
    child.send(SIGINT);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_TRUE(has(outcome.errors, "sikku: stopped"));
    device.read_rest();
    EXPECT_TRUE(hear(device.bytes()).sounding.empty());
    EXPECT_LT(outcome.peak, sanitized ? 2'000'000 : 200'000) << "kilobytes";
}

TEST(Live, ChangesOfTheFileAreHeard) {
    Device device;
    const ScratchFolder folder;
    const std::string file = folder.write("x.lsys", curve);
    Child child({"play", file, "--port", device.path(), "--repeat"});
    ASSERT_TRUE(device.read_until(notes_begun(10)));
    // An error: the old version plays on.
    folder.write("x.lsys", curve + "scale: dorain\n");
    std::this_thread::sleep_for(std::chrono::seconds(1));
    const int before = hear(device.bytes()).begun;
    ASSERT_TRUE(device.read_until(notes_begun(before + 20)));
    EXPECT_EQ(hear(device.bytes()).programs, std::set<int>{73});
    // And one without notes.
    folder.write("x.lsys", "axiom: F\n");
    std::this_thread::sleep_for(std::chrono::seconds(1));
    ASSERT_TRUE(device.read_until(notes_begun(hear(device.bytes()).begun + 20)));
    std::string other = curve;
    other.replace(other.find("Flute"), 5, "Oboe");
    folder.write("x.lsys", other + "scale: dorian\n");
    ASSERT_TRUE(device.read_until([](const std::string& bytes) {
        return hear(bytes).programs == std::set<int>{68, 73};
    }));
    const int changed = hear(device.bytes()).begun;
    ASSERT_TRUE(device.read_until(notes_begun(changed + 5)));
    child.send(SIGTERM);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 143);
    EXPECT_TRUE(has(outcome.errors, "unknown scale 'dorain'"));
    EXPECT_TRUE(has(outcome.errors, "the version before it plays on"));
    EXPECT_TRUE(has(outcome.errors, "the melody contains no notes"));
    EXPECT_TRUE(has(outcome.errors, "changed from bar"));
    device.read_rest();
    const Heard heard = hear(device.bytes());
    EXPECT_TRUE(heard.sounding.empty());
    EXPECT_EQ(heard.begun, heard.ended);
}

TEST(Live, ChangesOfAPatternInAnArrangementAreHeard) {
    Device device;
    const ScratchFolder folder;
    folder.write("x.lsys", curve);
    const std::string file = folder.write("x.toml",
                                          "[[track]]\npattern = \"x.lsys\"\n\n[[track]]\npattern = "
                                          "\"hilbert\"\nn = 3\ninstrument = \"Cello\"\nstart = 1\n");
    Child child({"play", file, "--port", device.path(), "--repeat"});
    ASSERT_TRUE(device.read_until(notes_begun(10)));
    EXPECT_EQ(hear(device.bytes()).programs, (std::set<int>{42, 73}));
    folder.write("x.lsys", curve + "scale: dorian\nrange: clamp C4-C5\ntonic: C6\nunit: 1/4\n");
    std::string other = curve;
    other.replace(other.find("Flute"), 5, "Oboe");
    folder.write("x.lsys", other);
    EXPECT_TRUE(device.read_until([](const std::string& bytes) {
        return hear(bytes).programs == std::set<int>{42, 68, 73};
    }));
    child.send(SIGINT);
    EXPECT_EQ(child.wait().status, 130);
    device.read_rest();
    EXPECT_TRUE(hear(device.bytes()).sounding.empty());
}

TEST(Live, CtrlZPauses) {
    Device device;
    Child child({"play", "hilbert", "--port", device.path(), "--tempo", "300", "--clock", "send"});
    ASSERT_TRUE(device.read_until(notes_begun(5)));
    child.send(SIGTSTP);
    ASSERT_TRUE(device.read_until([](const std::string& bytes) { return hear(bytes).commands == "sx"; }));
    device.read_rest();
    const Heard paused = hear(device.bytes());
    EXPECT_TRUE(paused.sounding.empty());
    device.read_rest();
    EXPECT_EQ(hear(device.bytes()).begun, paused.begun);
    child.send(SIGCONT);
    ASSERT_TRUE(device.read_until(notes_begun(paused.begun + 5)));
    child.send(SIGINT);
    EXPECT_EQ(child.wait().status, 130);
    device.read_rest();
    EXPECT_EQ(hear(device.bytes()).commands, "sxcx");
    EXPECT_TRUE(hear(device.bytes()).sounding.empty());
}

TEST(Live, FollowsTheClockOfTheDevice) {
    Device device;
    Child child({"play", "-", "--port", device.path(), "--clock", "follow"}, {.input = curve});
    Outcome outcome;
    std::thread waiter([&] { outcome = child.wait(); });
    ASSERT_TRUE(device.read_until([](const std::string& bytes) { return !hear(bytes).programs.empty(); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(hear(device.bytes()).begun, 0) << "before the clock starts";
    device.send("\xFA");
    // Sixteen quarters.
    for (int i = 0; i <= 16 * 24; ++i) {
        device.send("\xF8");
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    waiter.join();
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    device.read_rest();
    const Heard heard = hear(device.bytes());
    EXPECT_EQ(heard.begun, 26);
    EXPECT_TRUE(heard.sounding.empty());
}

TEST(Live, APipeThatCloses) {
    const ScratchFolder folder;
    const std::string pipe = folder.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    const Outcome nobody = run({"play", "hilbert", "--port", pipe});
    EXPECT_EQ(nobody.status, 1);
    EXPECT_TRUE(has(nobody.errors, "no program reads this pipe"));
    // A name alone may be that of a pipe.
    Surroundings inside{.folder = std::filesystem::path(pipe).parent_path()};
    EXPECT_TRUE(has(run({"play", "hilbert", "--port", "pipe"}, inside).errors, "no program reads this pipe"));
    const int end = open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    Child child({"play", "hilbert", "--port", pipe, "--repeat"});
    std::array<char, 64> block{};
    while (read(end, block.data(), block.size()) <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    close(end);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "the port has vanished"));
}

TEST(Live, WrongCommandLines) {
    const ScratchFolder folder;
    const std::string file = folder.write("x", "");
    const std::vector<std::tuple<std::vector<std::string>, int, std::string>> all = {
        {{"--port", "x", "-o", "x.mid"}, 2, "-o and --port cannot be combined"},
        {{"--repeat"}, 2, "--repeat needs --port"},
        {{"--clock", "send"}, 2, "--clock needs --port"},
        {{"--clock", "lead", "--port", "x"}, 2, "send"},
        {{"--repeat", "0", "--port", "x"}, 2, "--repeat"},
        {{"--port", ""}, 2, "expected a name, an address or a device"},
        {{"--port", "/dev/null", "-n", "40", "--velocity", "by level"}, 1, "(n = 40) is above the budget"},
        {{"--port", file}, 1, "neither a MIDI device nor a pipe; -o writes files"},
        {{"--port", "/nowhere/x"}, 1, "cannot open: No such file or directory"},
        {{"--port", "/dev/null", "--clock", "follow"}, 1, "no clock can be read from it"},
        {{"--port", "/dev/null", "--tuning", "equal"}, 2, "expected bend, mts or mpe"},
        {{"--port", "/dev/null", "--scale", "dorain"}, 2, "unknown scale"},
    };
    for (const auto& [arguments, status, message] : all) {
        std::vector<std::string> whole = {"play", "hilbert"};
        whole.insert(whole.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run(whole);
        EXPECT_EQ(outcome.status, status) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, message));
    }
}

#ifdef SIKKU_FAKE_SEQUENCER
/// The output of fake_sequencer.cpp.
struct SequencerHeard : Heard {
    std::vector<std::int64_t> times;  ///< of note-ons, in microseconds
};

SequencerHeard heard_by_sequencer(const std::string& text) {
    SequencerHeard heard;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string kind;
        std::string at;
        int channel = 0;
        int key = 0;
        std::int64_t time = 0;
        words >> kind >> channel >> key >> at >> time;
        if (kind == "clock") ++heard.clocks;
        if (kind == "on") {
            ++heard.begun;
            heard.sounding.insert({channel, key});
            heard.times.push_back(time);
        }
        if (kind == "off") {
            ++heard.ended;
            const auto found = heard.sounding.find({channel, key});
            if (found != heard.sounding.end()) heard.sounding.erase(found);
        }
    }
    return heard;
}
#endif

/// With a sequencer that prints what it is sent: see fake_sequencer.cpp.
TEST(Live, PlaysToTheSequencer) {
#ifndef SIKKU_FAKE_SEQUENCER
    GTEST_SKIP() << "built without ALSA, or with sanitizers";
#else
    const auto played = [](const std::vector<std::string>& arguments, const std::string& exit = "",
                           const std::string& queues = "1") {
        return run(arguments, {.input = curve,
                               .environment = {{"LD_PRELOAD", SIKKU_FAKE_SEQUENCER},
                                               {"SIKKU_FAKE_EXIT", exit},
                                               {"SIKKU_FAKE_QUEUES", queues}}});
    };
    EXPECT_EQ(played({"ports"}).output,
              "14:0    Midi Through Port-0  to and from Midi Through\n"
              "128:0   Synth input port     to          FLUID Synth (1)\n");
    const Outcome outcome = played({"play", "-", "--port", "fluid"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "connect 3 to 128:0\nconnect 3 from 0:1\n"));
    EXPECT_TRUE(has(outcome.errors, "program 0 73 at "));
    EXPECT_FALSE(has(outcome.errors, "wrong"));
    // The kernel delivers the notes: their times are exact, whatever the machine is doing.
    const SequencerHeard heard = heard_by_sequencer(outcome.errors);
    EXPECT_EQ(heard.begun, 26);
    EXPECT_EQ(heard.ended, 26);
    EXPECT_TRUE(heard.sounding.empty());
    const NoteList list = list_notes(std::vector{parse("x.lsys", curve)}, {}, {});
    ASSERT_EQ(heard.times.size(), list.notes.size());
    for (std::size_t i = 0; i < list.notes.size(); ++i) {
        const double microseconds = static_cast<double>(list.notes[i].onset) * 60e6 / (1000.0 * ticks_per_quarter);
        EXPECT_NEAR(static_cast<double>(heard.times[i] - heard.times[0]), microseconds, 1000) << i;
    }
    // A clock, too.
    const Outcome clocks = played({"play", "-", "--port", "fluid", "--clock", "send", "--bars", "2"});
    EXPECT_FALSE(has(clocks.errors, "wrong"));
    EXPECT_EQ(heard_by_sequencer(clocks.errors).clocks, 2 * 96 + 1);
    // Without a queue notes are sent when they are due.
    const Outcome direct = played({"play", "-", "--port", "fluid"}, "", "0");
    EXPECT_TRUE(has(direct.errors, "program 0 73 now\non 0 60 now\n"));
    EXPECT_FALSE(has(direct.errors, "wrong"));
    EXPECT_EQ(heard_by_sequencer(direct.errors).begun, 26);
    EXPECT_TRUE(
        has(played({"play", "-", "--port", "14:0", "--scale", "7-edo", "--tuning", "mts"}).errors, "sysex 0 12 at "));
    EXPECT_TRUE(has(played({"play", "-", "--port", "14:0", "--scale", "7-edo", "--tuning", "mpe"}).errors, "bend "));
    const Outcome gone = played({"play", "-", "--port", "fluid", "--repeat"}, "60");
    EXPECT_EQ(gone.status, 1);
    EXPECT_TRUE(has(gone.errors, "sikku: port 'fluid': it has vanished"));
    EXPECT_TRUE(has(played({"play", "-", "--port", "keys"}).errors,
                    "unknown port 'keys'; there are: 'Midi Through Port-0' (14:0), 'Synth input port' (128:0)"));
#endif
}

/// Without a sequencer both say so.
TEST(Live, NeedsASequencer) {
    if (std::filesystem::exists("/dev/snd/seq")) GTEST_SKIP() << "this machine has ALSA's sequencer";
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"ports"}, {"play", "hilbert", "--port", "FLUID"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(has(outcome.errors, "ALSA"));
        EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
    }
}

}  // namespace sikku::live_test
