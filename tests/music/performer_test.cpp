#include "music/live/performer.h"

#include "music/live/ahead.h"
#include "music/live/voices.h"
#include "music/scores.h"
#include "tests/checks.h"
#include "tests/midi_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sikku::live::performer_test {

constexpr Nanoseconds millisecond = second / 1000;

/// A clock that stands still unless somebody waits.
class FakeClock final : public Clock {
public:
    Nanoseconds now() override { return now_; }
    void sleep_until(Nanoseconds time) override { now_ = std::max(now_, time); }

private:
    Nanoseconds now_ = 5 * second;
};

struct Sent {
    Nanoseconds time = 0;
    Message message;
    bool operator==(const Sent&) const = default;
};

/// Keeps what it is sent, and receives what a script says.
class FakePort final : public Port {
public:
    /// @param ahead  times of messages are then those that they are sent with, less this
    explicit FakePort(Clock& clock, Nanoseconds ahead = 0) : clock_(clock), begin_(clock.now()), ahead_(ahead) {}
    std::vector<Received> script;      ///< times from the beginning
    Nanoseconds vanishes = INT64_MAX;  ///< after this time
    std::vector<Sent> sent;            ///< times from the beginning
    bool tells_places = false;
    std::vector<std::pair<Nanoseconds, std::pair<std::int64_t, int>>> places;  ///< times, bars and beats

    Nanoseconds ahead() const override { return ahead_; }
    bool wants_places() const override { return tells_places; }
    void send_place(const Place& place, Nanoseconds due) override {
        places.push_back({ahead_ > 0 ? due - begin_ - ahead_ : time(), {place.bar, place.beat}});
    }
    void send(std::span<const Message> messages, Nanoseconds due) override {
        if (time() >= vanishes) throw PortError("it has vanished");
        EXPECT_EQ(due == at_once, ahead_ == 0);
        EXPECT_LE(due, clock_.now() + ahead_) << "earlier than announced";
        const Nanoseconds at = ahead_ > 0 ? due - begin_ - ahead_ : time();
        EXPECT_TRUE(sent.empty() || sent.back().time <= at) << "times go back";
        for (const Message& message : messages) sent.push_back({at, message});
    }
    std::vector<Received> wait(Clock& clock, Nanoseconds until) override {
        if (next_ == script.size() || begin_ + script[next_].time > until) {
            clock.sleep_until(until);
            if (time() >= vanishes) throw PortError("it has vanished");
            return {};
        }
        clock.sleep_until(begin_ + script[next_].time);
        std::vector<Received> received;
        for (; next_ < script.size() && begin_ + script[next_].time <= clock.now(); ++next_) {
            received.push_back(script[next_]);
            received.back().time = clock.now();
        }
        return received;
    }
    Nanoseconds time() const { return clock_.now() - begin_; }

private:
    Clock& clock_;
    Nanoseconds begin_;
    Nanoseconds ahead_;
    std::size_t next_ = 0;
};

/// Notes in windows of a bar.
class FakeStream final : public NoteStream {
public:
    FakeStream(MidiScore score, MidiOptions midi = {}, std::int64_t span = 1920)
        : score_(std::move(score)), midi_(midi), span_(span) {}
    const ScoreHead& head() const override { return score_.head; }
    const MidiOptions& midi() const override { return midi_; }
    void set_curves(Curves curves) { curves_ = std::move(curves); }
    void seek(std::int64_t tick) override { at_ = tick; }
    bool is_ready() override { return is_ready_after_ == 0 || --is_ready_after_ == 0; }
    void be_ready_after(int questions) { is_ready_after_ = questions; }
    NoteWindow next() override {
        NoteWindow window;
        window.from = at_;
        window.end = score_.end;
        window.is_last = score_.end - at_ <= span_;
        window.to = window.is_last ? std::max(at_, score_.end) : at_ + span_;
        for (const Note& note : score_.notes) {
            if (note.onset >= window.from && (window.is_last || note.onset < window.to)) {
                window.notes.push_back(note);
                // Ends beyond the window come later.
                if (note.onset + note.duration > window.to && !window.is_last) window.notes.back().duration = 0;
            } else if (note.onset < window.from && note.onset + note.duration >= window.from &&
                       (note.onset + note.duration < window.to || window.is_last)) {
                window.ends.push_back({note.onset + note.duration, note.voice});
            }
        }
        const auto is_within = [&](std::int64_t tick) {
            return tick >= window.from && (window.is_last || tick < window.to);
        };
        for (const ControlPoint& point : curves_.controls) {
            if (is_within(point.tick)) window.controls.push_back(point);
        }
        for (const TempoPoint& point : curves_.tempo) {
            if (is_within(point.tick)) window.tempos.push_back(point);
        }
        at_ = window.is_last ? 0 : window.to;
        return window;
    }

private:
    MidiScore score_;
    MidiOptions midi_;
    Curves curves_;
    std::int64_t span_;
    std::int64_t at_ = 0;
    int is_ready_after_ = 0;
};

/// Two bars of quarters in 4/4 at 120 quarters a minute: a note every half second.
MidiScore quarters(int count = 8, int key = 60) {
    MidiScore score;
    score.head = midi_head();
    score.head.tempo = 120;
    for (int i = 0; i < count; ++i) score.notes.push_back(midi_note(i * 480, 480, key + i % 8));
    score.end = count * 480;
    return score;
}

std::unique_ptr<NoteStream> stream(const MidiScore& score) {
    return std::make_unique<FakeStream>(score);
}

using Stroke = std::pair<Nanoseconds, int>;  // time and key

std::vector<Stroke> strokes(const std::vector<Sent>& sent) {
    std::vector<Stroke> found;
    for (const Sent& one : sent) {
        if (one.message.kind() == 0x90) found.emplace_back(one.time, one.message.bytes[1]);
    }
    return found;
}

std::vector<Nanoseconds> times_of(const std::vector<Sent>& sent, int first_byte) {
    std::vector<Nanoseconds> found;
    for (const Sent& one : sent) {
        if (one.message.bytes[0] == first_byte) found.push_back(one.time);
    }
    return found;
}

/// Each note-on has its note-off, on its channel, and no key is struck while it sounds.
void expect_no_hanging_notes(const std::vector<Sent>& sent) {
    std::set<std::pair<int, int>> sounding;
    for (const Sent& one : sent) {
        const std::pair<int, int> key(one.message.channel(), one.message.bytes[1]);
        if (one.message.kind() == 0x90) {
            EXPECT_TRUE(sounding.insert(key).second) << "struck twice";
        }
        if (one.message.kind() == 0x80) {
            EXPECT_EQ(sounding.erase(key), 1u) << "a note ends that does not sound";
        }
    }
    EXPECT_TRUE(sounding.empty()) << "a note hangs";
}

struct Performance {
    explicit Performance(Nanoseconds ahead = 0) : port(clock, ahead) {}
    FakeClock clock;
    FakePort port;
    PerformOptions options;
    PerformHooks hooks;
    PerformReport report;

    void play(std::unique_ptr<NoteStream> music) {
        report = perform(std::move(music), clock, port, options, hooks);
        expect_no_hanging_notes(port.sent);
    }
    std::vector<Stroke> heard() const { return strokes(port.sent); }
};

TEST(Performer, NotesComeAtTheirTimes) {
    Performance one;
    one.play(stream(quarters()));
    std::vector<Stroke> expected;
    for (int i = 0; i < 8; ++i) expected.emplace_back(i * second / 2, 60 + i);
    EXPECT_EQ(one.heard(), expected);
    EXPECT_EQ(one.report.notes, 8u);
    EXPECT_EQ(one.report.late, 0u);
    EXPECT_EQ(one.port.time(), 4 * second);
    // The program of the channel comes first, and all notes off last.
    EXPECT_EQ(one.port.sent.front().message, (Message{0xC0, 73}));
    EXPECT_EQ(one.port.sent.back().message, (Message{0xB0, 123, 0}));
    EXPECT_EQ(times_of(one.port.sent, 0x80).back(), 4 * second);
}

/// A hundred thousand notes a third of a millisecond apart: no error adds up.
TEST(Performer, TimesDoNotDrift) {
    MidiScore score;
    score.head = midi_head();
    score.head.tempo = 133.7;
    for (int i = 0; i < 100'000; ++i) score.notes.push_back(midi_note(i * 7, 7, 60 + i % 2));
    score.end = 700'000;
    Performance one;
    one.play(stream(score));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 100'000u);
    for (std::size_t i = 0; i < heard.size(); i += 997) {
        const double exact = 7.0 * static_cast<double>(i) / 480 * 60 / 133.7 * 1e9;
        EXPECT_NEAR(static_cast<double>(heard[i].first), exact, 2) << i;
    }
}

TEST(Performer, RepeatsAtBarLines) {
    MidiScore score = quarters(5);  // a bar and a quarter
    Performance one;
    one.options.times = 3;
    one.play(stream(score));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 15u);
    for (int pass = 0; pass < 3; ++pass) {
        for (int i = 0; i < 5; ++i) {
            EXPECT_EQ(heard[static_cast<std::size_t>(5 * pass + i)],
                      Stroke(4 * second * pass + i * second / 2, 60 + i));
        }
    }
    EXPECT_EQ(one.report.passes, 3);
    // The last repetition ends with its last note.
    EXPECT_EQ(one.port.time(), 8 * second + 5 * second / 2);
}

TEST(Performer, PlaysUntilItIsStopped) {
    Performance one;
    one.options.times = 0;
    static FakePort* port = nullptr;
    port = &one.port;
    one.hooks.monitor = Monitor([](void*) { return port->time() >= 3600 * second + 100 * millisecond; });
    EXPECT_THROW(one.play(stream(quarters())), Stopped);
    expect_no_hanging_notes(one.port.sent);
    EXPECT_EQ(one.heard().size(), 7201u);
    EXPECT_EQ(one.port.sent.back().message, (Message{0xB0, 123, 0}));
    EXPECT_LE(one.port.time(), 3600 * second + 200 * millisecond);
}

/// In the last two bars the tempo falls in eight steps to 60 %, as in files.
TEST(Performer, SlowsDown) {
    MidiScore score = quarters(16);
    score.head.ritardando = 2 * 1920;
    Performance one;
    one.play(stream(score));
    const std::vector<Stroke> heard = one.heard();
    double expected = 4.0;
    for (std::size_t i = 8; i < 16; ++i) {
        EXPECT_NEAR(static_cast<double>(heard[i].first), expected * 1e9, 5) << i;
        expected += 0.5 / (1 - 0.05 * static_cast<double>(i - 7));
    }
    EXPECT_NEAR(static_cast<double>(one.port.time()), expected * 1e9, 10);
}

/// Controllers, bends and tempos of curves come at their times, in each repetition.
TEST(Performer, PlaysCurves) {
    Curves curves{.tempo = {{0, 0.5}, {960, 1}},
                  .controls = {{0, 0, 10, 20}, {240, 0, ControlPoint::bend, 1}, {960, 0, 10, 30}}};
    MidiOptions midi{.microtonal = true};
    Performance one;
    one.options.times = 2;
    auto music = std::make_unique<FakeStream>(quarters(4), midi);
    music->set_curves(curves);
    one.play(std::move(music));
    const Nanoseconds pass = 3 * second;  // two quarters of one second, two of half a second
    std::vector<Stroke> expected;
    for (const Nanoseconds begin : {Nanoseconds{0}, pass}) {
        expected.insert(expected.end(),
                        {{begin, 60}, {begin + second, 61}, {begin + 2 * second, 62}, {begin + 5 * second / 2, 63}});
    }
    EXPECT_EQ(one.heard(), expected);
    std::vector<Stroke> pans;
    for (const Sent& sent : one.port.sent) {
        if (sent.message.kind() == 0xB0 && sent.message.bytes[1] == 10) {
            pans.emplace_back(sent.time, sent.message.bytes[2]);
        }
    }
    EXPECT_EQ(pans, (std::vector<Stroke>{{0, 20}, {2 * second, 30}, {pass, 20}, {pass + 2 * second, 30}}));
    // A semitone of two up within the first note, and back with the second.
    EXPECT_EQ(times_of(one.port.sent, 0xE0),
              (std::vector<Nanoseconds>{second / 2, second, pass + second / 2, pass + second}));
}

/// A port that delivers messages in time receives the same messages, earlier.
TEST(Performer, SendsAhead) {
    MidiScore score = quarters(20);
    score.head.ritardando = 2 * 1920;
    for (const ClockMode mode : {ClockMode::none, ClockMode::send}) {
        std::vector<std::vector<Sent>> all;
        for (const Nanoseconds ahead : {Nanoseconds{0}, second / 10}) {
            Performance one(ahead);
            one.options.times = 3;
            one.options.clock = mode;
            bool is_given = false;
            one.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
                if (is_given || one.port.time() < 12 * second + ahead / 2) return nullptr;
                is_given = true;
                return stream(quarters(12, 80));
            };
            one.play(stream(score));
            EXPECT_EQ(one.report.late, 0u);
            EXPECT_EQ(one.port.time(), one.port.sent.back().time + ahead) << "it waits for the last message";
            all.push_back(one.port.sent);
        }
        EXPECT_EQ(all[0], all[1]);
    }
}

/// Later messages never overtake those sent ahead.
TEST(Performer, StopsAndPausesAfterWhatWasSentAhead) {
    Performance one(second / 10);
    one.options.times = 0;
    static FakePort* port = nullptr;
    port = &one.port;
    bool is_over = false;
    one.hooks.is_pause_wanted = [&] { return !is_over && one.port.time() > 1520 * millisecond; };
    one.hooks.pause = [&] {
        is_over = true;
        EXPECT_GE(one.port.time(), one.port.sent.back().time + second / 10);
        one.clock.sleep_until(one.clock.now() + 10 * second);
    };
    one.hooks.monitor = Monitor([](void*) { return port->time() >= 13 * second; });
    EXPECT_THROW(one.play(stream(quarters())), Stopped);
    expect_no_hanging_notes(one.port.sent);
    const std::vector<Stroke> heard = one.heard();
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(heard[i].first, static_cast<Nanoseconds>(i) * second / 2);
    EXPECT_NEAR(static_cast<double>(heard[4].first), 12e9, 0.2e9);
    EXPECT_EQ(heard[5].first - heard[4].first, second / 2);
    EXPECT_LE(one.port.time(), 13 * second + 2 * millisecond + second / 5);
}

TEST(Performer, NotesThatLastBeyondWindowsEnd) {
    MidiScore score{.head = midi_head(2),
                    .notes = {midi_note(0, 9600, 40, 1), midi_note(0, 480, 60), midi_note(9600, 480, 60)},
                    .end = 10080};
    Performance one;
    one.play(stream(score));
    std::vector<Stroke> ends;
    for (const Sent& sent : one.port.sent) {
        if (sent.message.kind() == 0x80) ends.emplace_back(sent.time, sent.message.bytes[1]);
    }
    EXPECT_EQ(ends, (std::vector<Stroke>{{second / 2, 60}, {10 * second, 40}, {10 * second + second / 2, 60}}));
}

// --- clocks
// -----------------------------------------------------------------------------------------------------------

TEST(Performer, SendsAClock) {
    Performance one;
    one.options.clock = ClockMode::send;
    one.options.times = 2;
    one.play(stream(quarters(7)));
    EXPECT_EQ(times_of(one.port.sent, start_byte), std::vector<Nanoseconds>{0});
    EXPECT_EQ(times_of(one.port.sent, stop_byte), std::vector<Nanoseconds>{one.port.time()});
    const std::vector<Nanoseconds> clocks = times_of(one.port.sent, clock_byte);
    ASSERT_EQ(clocks.size(), 15u * 24 + 1);
    for (std::size_t i = 0; i < clocks.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(clocks[i]), static_cast<double>(i) * 1e9 / 48, 1);
    }
    // The clock comes before the notes of its tick.
    const auto of = [&](int byte) {
        return std::find_if(one.port.sent.begin(), one.port.sent.end(),
                            [&](const Sent& sent) { return sent.message.bytes[0] == byte; });
    };
    EXPECT_LT(of(start_byte), of(clock_byte));
    EXPECT_LT(of(clock_byte), of(0x90));
}

TEST(Performer, APauseStopsAndContinuesTheClock) {
    Performance one;
    one.options.clock = ClockMode::send;
    bool is_over = false;
    one.hooks.is_pause_wanted = [&] { return !is_over && one.port.time() > 1200 * millisecond; };
    Nanoseconds begin = 0;
    one.hooks.pause = [&] {
        begin = one.port.time();
        one.clock.sleep_until(one.clock.now() + 10 * second);
        is_over = true;
    };
    one.play(stream(quarters()));
    ASSERT_EQ(times_of(one.port.sent, continue_byte), std::vector<Nanoseconds>{begin + 10 * second});
    EXPECT_EQ(times_of(one.port.sent, stop_byte).front(), begin);
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 8u);
    EXPECT_EQ(heard[2].first, second);
    EXPECT_EQ(heard[3].first, 10 * second + 3 * second / 2);
    EXPECT_EQ(times_of(one.port.sent, 0x80)[2], begin) << "the note that sounded ends with the pause";
    EXPECT_EQ(times_of(one.port.sent, clock_byte).size(), 4u * 48 + 1);
}

using Kind = Received::Kind;

/// Clock messages at times that `interval` makes from their number.
template <typename Interval>
Nanoseconds add_clocks(std::vector<Received>& script, Nanoseconds from, int count, Interval&& interval) {
    for (int i = 0; i < count; ++i) {
        script.push_back({from, Kind::clock, 0});
        from += interval(i);
    }
    return from;
}

/// The tempo doubles within two bars. Notes at clock messages come with them.
TEST(Performer, FollowsAChangingTempo) {
    Performance one;
    one.options.clock = ClockMode::follow;
    MidiScore score = quarters(16);
    for (Note& note : score.notes) note.duration = 240;
    for (int i = 0; i < 16; ++i) score.notes.push_back(midi_note(i * 480 + 250, 200, 72));
    std::sort(score.notes.begin(), score.notes.end(), [](const Note& a, const Note& b) { return a.onset < b.onset; });
    auto& script = one.port.script;
    script.push_back({3 * second, Kind::start, 0});
    std::vector<Nanoseconds> clocks;
    Nanoseconds time = 3 * second + 50 * millisecond;
    for (int i = 0; i <= 16 * 24; ++i) {
        script.push_back({time, Kind::clock, 0});
        clocks.push_back(time);
        time += std::llround(20e6 / (1 + i / 192.0));
    }
    one.play(stream(score));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 32u);
    for (std::size_t i = 0; i < 16; ++i) {
        EXPECT_EQ(heard[2 * i].first, clocks[24 * i]) << i;
        // 250 ticks are twelve and a half clocks: half the last interval after the twelfth.
        const Nanoseconds half = (clocks[24 * i + 12] - clocks[24 * i + 11]) / 2;
        EXPECT_NEAR(static_cast<double>(heard[2 * i + 1].first), static_cast<double>(clocks[24 * i + 12] + half), 2);
    }
}

TEST(Performer, WaitsStopsAndContinuesWithTheClock) {
    Performance one;
    one.options.clock = ClockMode::follow;
    auto& script = one.port.script;
    const auto even = [](int) { return second / 48; };
    add_clocks(script, 0, 48, even);  // before the start they mean nothing
    script.push_back({2 * second, Kind::start, 0});
    add_clocks(script, 2 * second + 1, 30, even);  // a quarter, and six more
    const Nanoseconds stop = 2 * second + 30 * second / 48;
    script.push_back({stop, Kind::stop, 0});
    add_clocks(script, 3 * second, 48, even);
    script.push_back({5 * second, Kind::resume, 0});
    add_clocks(script, 5 * second + 1, 400, even);
    one.play(stream(quarters()));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 8u);
    EXPECT_EQ(heard[0], Stroke(2 * second + 1, 60));
    EXPECT_NEAR(static_cast<double>(heard[1].first), 2.5e9 + 1, 30);
    // 18 clocks from the one that continues.
    EXPECT_NEAR(static_cast<double>(heard[2].first), 5e9 + 18e9 / 48, 30);
    const auto ends = times_of(one.port.sent, 0x80);
    EXPECT_EQ(ends[1], stop) << "notes end when the clock stops";
    // What it starts again is the beginning.
    Performance again;
    again.options.clock = ClockMode::follow;
    script = {};
    again.port.script.push_back({0, Kind::start, 0});
    add_clocks(again.port.script, 1, 60, even);
    again.port.script.push_back({2 * second, Kind::start, 0});
    add_clocks(again.port.script, 2 * second + 1, 300, even);
    again.play(stream(quarters()));
    const std::vector<Stroke> second_time = again.heard();
    ASSERT_EQ(second_time.size(), 11u);
    EXPECT_EQ(second_time[3], Stroke(2 * second + 1, 60));
}

TEST(Performer, GoesToTheSongPosition) {
    Performance one;
    one.options.clock = ClockMode::follow;
    auto& script = one.port.script;
    script.push_back({0, Kind::position, 16});  // the second bar
    script.push_back({1, Kind::resume, 0});
    add_clocks(script, second, 300, [](int) { return second / 48; });
    one.play(stream(quarters()));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 4u);
    EXPECT_EQ(heard[0], Stroke(second, 64));
}

TEST(Performer, ALostClockLeavesNoNoteSounding) {
    Performance one;
    one.options.clock = ClockMode::follow;
    static FakePort* port = nullptr;
    port = &one.port;
    one.hooks.monitor = Monitor([](void*) { return port->time() >= 100 * second; });
    one.port.script.push_back({0, Kind::start, 0});
    add_clocks(one.port.script, 1, 3, [](int) { return second / 48; });
    EXPECT_THROW(one.play(stream(quarters())), Stopped);
    expect_no_hanging_notes(one.port.sent);
    ASSERT_EQ(times_of(one.port.sent, 0x80).size(), 1u);
    EXPECT_LT(times_of(one.port.sent, 0x80).front(), 1200 * millisecond);
}

// --- changes
// ----------------------------------------------------------------------------------------------------------

TEST(Performer, ANewVersionBeginsAtTheNextBar) {
    Performance one;
    bool is_given = false;
    one.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
        if (is_given || one.port.time() < 2300 * millisecond) return nullptr;
        is_given = true;
        MidiScore score = quarters(16, 80);
        score.head.tempo = 240;
        score.head.parts.front().program = 5;
        return stream(score);
    };
    std::vector<std::int64_t> bars;
    one.hooks.changed = [&](std::int64_t bar) { bars.push_back(bar); };
    one.play(stream(quarters(16)));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 16u);
    // It comes in the second bar and sounds from the third on, at twice the tempo.
    for (std::size_t i = 0; i < 16; ++i) {
        const auto beat = static_cast<Nanoseconds>(i);
        EXPECT_EQ(heard[i].first, i < 8 ? beat * second / 2 : 4 * second + (beat - 8) * second / 4) << i;
        EXPECT_EQ(heard[i].second, (i < 8 ? 60 : 80) + static_cast<int>(i % 8)) << i;
    }
    EXPECT_EQ(bars, std::vector<std::int64_t>{3});
    EXPECT_EQ(times_of(one.port.sent, 0xC0), (std::vector<Nanoseconds>{0, 4 * second}));
}

/// Until it is ready the old version plays on, without a gap.
TEST(Performer, BeatsAreToldWithStartAndStop) {
    for (const Nanoseconds ahead : {Nanoseconds{0}, second / 10}) {
        Performance one(ahead);
        one.port.tells_places = true;
        one.options.times = 2;
        bool is_given = false;
        one.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
            if (is_given || one.port.time() < 500 * millisecond) return nullptr;
            is_given = true;
            MidiScore score = quarters(7, 80);
            score.head.meter = {7, 8, {}};
            return stream(score);
        };
        one.play(stream(quarters(8)));
        // A bar of 4/4; then, from the second bar on, of 7/8; then the second pass.
        std::vector<std::pair<Nanoseconds, std::pair<std::int64_t, int>>> expected;
        for (int i = 0; i < 4; ++i) expected.push_back({i * second / 2, {1, i + 1}});
        for (int i = 0; i < 7; ++i) expected.push_back({2 * second + i * second / 4, {2, i + 1}});
        for (int i = 0; i < 14; ++i) expected.push_back({15 * second / 4 + i * second / 4, {i / 7 + 1, i % 7 + 1}});
        EXPECT_EQ(one.port.places, expected);
        EXPECT_EQ(times_of(one.port.sent, start_byte), std::vector<Nanoseconds>{0});
        EXPECT_EQ(times_of(one.port.sent, stop_byte), std::vector<Nanoseconds>{29 * second / 4});
        EXPECT_TRUE(times_of(one.port.sent, clock_byte).empty());
    }
}

/// A bar of 4/4, one of 3/4 at half the tempo, and one of 4/4; repeated, and changed in the second bar.
TEST(Performer, SectionsHaveTheirTempoAndMeter) {
    MidiScore score = quarters(11);
    score.head.changes = {{1920, {60, "", {3, 4}}}, {3360, {120, "", {4, 4}}}};
    Performance one;
    one.port.tells_places = true;
    one.options.times = 2;
    one.play(stream(score));
    std::vector<std::pair<Nanoseconds, std::pair<std::int64_t, int>>> expected;
    for (Nanoseconds pass = 0; pass <= 7 * second; pass += 7 * second) {
        for (int i = 0; i < 4; ++i) expected.push_back({pass + i * second / 2, {1, i + 1}});
        for (int i = 0; i < 3; ++i) expected.push_back({pass + 2 * second + i * second, {2, i + 1}});
        for (int i = 0; i < 4; ++i) expected.push_back({pass + 5 * second + i * second / 2, {3, i + 1}});
    }
    EXPECT_EQ(one.port.places, expected);
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), expected.size());
    for (std::size_t i = 0; i < heard.size(); ++i) EXPECT_EQ(heard[i].first, expected[i].first) << i;

    // Another version begins at the bar line after the bar of 3/4.
    Performance other;
    bool is_given = false;
    other.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
        if (is_given || other.port.time() < 3 * second) return nullptr;
        is_given = true;
        return stream(quarters(16, 80));
    };
    other.play(stream(score));
    const std::vector<Stroke> changed = other.heard();
    ASSERT_EQ(changed.size(), 15u);
    // It continues with its third bar.
    EXPECT_EQ(changed[7], Stroke(5 * second, 80));
}

/// Compares clocks with their exact times, and measures the memory of the program.
class CountingPort final : public Port {
public:
    explicit CountingPort(Clock& clock) : clock_(clock), begin_(clock.now()) {}
    Nanoseconds ahead() const override { return 0; }
    void send(std::span<const Message> messages, Nanoseconds) override {
        const Nanoseconds time = clock_.now() - begin_;
        for (const Message& message : messages) {
            if (message.kind() == 0x90) ++sounding;
            if (message.kind() == 0x90) ++notes;
            if (message.kind() == 0x80) --sounding;
            if (message.bytes[0] != clock_byte) continue;
            // 24 a quarter at 96 quarters a minute.
            const double exact = static_cast<double>(clocks++) * 60e9 / 96 / 24;
            worst = std::max(worst, std::fabs(static_cast<double>(time) - exact));
            if (time < hour) memory_at_first = used_memory();
            memory = used_memory();
        }
    }
    std::vector<Received> wait(Clock& clock, Nanoseconds until) override {
        clock.sleep_until(until);
        return {};
    }
    static constexpr Nanoseconds hour = 3600 * second;
    int sounding = 0;
    std::int64_t notes = 0, clocks = 0;
    double worst = 0;
    std::int64_t memory_at_first = 0, memory = 0;

private:
    /// Resident pages.
    static std::int64_t used_memory() {
        static std::int64_t count = 0, last = 0;
        if (count++ % 10'000 != 0) return last;
        std::ifstream file("/proc/self/statm");
        std::int64_t all = 0;
        file >> all >> last;
        return last;
    }
    Clock& clock_;
    Nanoseconds begin_;
};

/// Eight hours of a curve of 40 generations: each clock in time, and no growth of memory.
TEST(Performer, PlaysEightHoursOnTimeInConstantMemory) {
    const Document document = parse(
        "h.lsys", "axiom: X\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\nheading: 0\nderivation length: 40\ntempo: 96\n");
    FakeClock clock;
    CountingPort port(clock);
    PerformOptions options;
    options.clock = ClockMode::send;
    // Eight hours are 46,080 quarters.
    perform(stream_notes({&document, 1}, {{"bars", "11520"}}, {}), clock, port, options, {});
    EXPECT_NEAR(static_cast<double>(clock.now()) / 1e9 - 5, 8 * 3600, 1e-3);
    EXPECT_EQ(port.sounding, 0);
    EXPECT_GT(port.notes, 50'000);
    EXPECT_EQ(port.clocks, 46'080 * 24 + 1);
    EXPECT_LT(port.worst, 5);
    // Sanitizers keep freed memory for a while.
    constexpr std::int64_t page = 4096, most_growth = sanitized ? 256 << 20 : 1 << 20;
    EXPECT_LT((port.memory - port.memory_at_first) * page, most_growth);
}

TEST(Performer, ANewVersionThatIsNotReadyWaits) {
    Performance one;
    bool is_given = false;
    one.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
        if (std::exchange(is_given, true)) return nullptr;
        auto slow = std::make_unique<FakeStream>(quarters(32, 80));
        slow->be_ready_after(3);
        return slow;
    };
    std::vector<std::int64_t> bars;
    one.hooks.changed = [&](std::int64_t bar) { bars.push_back(bar); };
    one.play(stream(quarters(32)));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 32u);
    for (std::size_t i = 0; i < 32; ++i) EXPECT_EQ(heard[i].first, static_cast<Nanoseconds>(i) * second / 2);
    ASSERT_EQ(bars.size(), 1u);
    EXPECT_GT(bars.front(), 2);
}

TEST(Performer, AShorterVersionBeginsAgain) {
    Performance one;
    one.options.times = 2;
    bool is_given = false;
    one.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
        if (is_given || one.port.time() < 5 * second) return nullptr;
        is_given = true;
        return stream(quarters(4, 80));
    };
    one.play(stream(quarters(16)));
    const std::vector<Stroke> heard = one.heard();
    ASSERT_EQ(heard.size(), 16u);
    EXPECT_EQ(heard[12], Stroke(6 * second, 80)) << "from the beginning, at the fourth bar";
    EXPECT_EQ(one.port.time(), 8 * second);
}

// --- failures
// ---------------------------------------------------------------------------------------------------------

TEST(Performer, APortThatVanishesIsAnError) {
    Performance one;
    one.options.times = 0;
    one.port.vanishes = 1700 * millisecond;
    EXPECT_THROW(one.play(stream(quarters())), PortError);
    EXPECT_EQ(one.heard().size(), 4u);
    EXPECT_LE(one.port.time(), 1800 * millisecond);
}

class FailingStream final : public NoteStream {
public:
    explicit FailingStream(MidiScore score) : score_(std::move(score)) {}
    const ScoreHead& head() const override { return score_.head; }
    const MidiOptions& midi() const override { return midi_; }
    void seek(std::int64_t) override {}
    NoteWindow next() override {
        if (calls_++ > 0) throw ScoreError("out of range");
        NoteWindow window;
        window.to = 1920;
        window.notes = {midi_note(0, 0, 60), midi_note(960, 480, 62)};
        return window;
    }

private:
    MidiScore score_;
    MidiOptions midi_;
    int calls_ = 0;
};

TEST(Performer, AnErrorOfTheMusicLeavesNoNoteSounding) {
    for (const bool is_ahead : {false, true}) {
        Performance one;
        const auto open = [](const Monitor&) { return std::make_unique<FailingStream>(quarters()); };
        EXPECT_THROW(one.play(is_ahead ? read_ahead(open) : open({})), ScoreError);
        expect_no_hanging_notes(one.port.sent);
    }
}

/// A change that cannot be played: that before it plays on.
TEST(Performer, ANewVersionWithErrorsIsRefused) {
    class BadStream final : public NoteStream {
    public:
        const ScoreHead& head() const override { return score_.head; }
        const MidiOptions& midi() const override { return midi_; }
        void seek(std::int64_t) override {}
        NoteWindow next() override { throw ScoreError("no notes"); }

    private:
        MidiScore score_ = quarters();
        MidiOptions midi_;
    };
    Performance one;
    bool is_given = false;
    one.hooks.newer = [&]() -> std::unique_ptr<NoteStream> {
        return std::exchange(is_given, true) ? nullptr : std::make_unique<BadStream>();
    };
    int refused = 0;
    one.hooks.refused = [&](const std::exception_ptr& error) {
        ++refused;
        EXPECT_THROW(std::rethrow_exception(error), ScoreError);
    };
    one.play(stream(quarters()));
    EXPECT_EQ(refused, 1);
    Performance plain;
    plain.play(stream(quarters()));
    EXPECT_EQ(one.port.sent, plain.port.sent);
}

TEST(Performer, ReadsAheadOnAThread) {
    Performance plain;
    plain.options.times = 5;
    plain.play(stream(quarters(29)));
    Performance ahead;
    ahead.options.times = 5;
    ahead.play(read_ahead([](const Monitor&) { return stream(quarters(29)); }));
    EXPECT_EQ(ahead.port.sent, plain.port.sent);
    // A stream that nobody waits for is given up.
    read_ahead([](const Monitor&) { return stream(quarters(29)); })->seek(1920);
}

// --- channels
// ---------------------------------------------------------------------------------------------------------

TEST(Performer, SoundsAsTheFileDoes) {
    std::mt19937 chance(3);
    for (int round = 0; round < 30; ++round) {
        const int voices = 1 + round % 12;
        MidiScore score = random_midi_score(chance, voices, 200, round % 2 == 1);
        score.head.tempo = 60'000;
        std::sort(score.notes.begin(), score.notes.end(), [](const Note& a, const Note& b) {
            return std::tie(a.onset, a.voice) < std::tie(b.onset, b.voice);
        });
        for (const Tuning tuning : {Tuning::bend, Tuning::mts, Tuning::mpe}) {
            MidiOptions midi{.format = 0, .microtonal = round % 2 == 1, .tuning = tuning};
            Performance one;
            one.play(std::make_unique<FakeStream>(score, midi, 200'000));
            std::map<std::tuple<std::int64_t, int, int>, int> found;
            const double pace = 60e9 / score.head.tempo / 480;
            for (const Sent& sent : one.port.sent) {
                if (sent.message.kind() == 0x90) {
                    ++found[{std::llround(static_cast<double>(sent.time) / pace), sent.message.bytes[1],
                             sent.message.bytes[2]}];
                }
            }
            std::map<std::tuple<std::int64_t, int, int>, int> expected;
            const MidiFile file = read_midi(make_midi(score, midi));
            for (const MidiNote& note : file.notes) ++expected[{note.onset, note.key, note.velocity}];
            EXPECT_EQ(found, expected);
            // What tunes the notes is the same, too, message by message, except where a channel was chosen.
            if (tuning == Tuning::mpe) continue;
            std::map<int, std::vector<std::string>> sent_tunings;
            std::map<int, std::vector<std::string>> file_tunings;
            for (const Sent& sent : one.port.sent) {
                const std::string bytes(sent.message.span().begin(), sent.message.span().end());
                if (sent.message.kind() == 0xE0) sent_tunings[sent.message.channel()].push_back(bytes.substr(1));
                if (sent.message.kind() == 0xF0) sent_tunings[16].push_back(bytes.substr(1));
            }
            for (const MidiEvent& event : file.events) {
                if ((event.status & 0xF0) == 0xE0) file_tunings[event.status & 0x0F].push_back(event.data);
                if (event.status == 0xF0) file_tunings[16].push_back(event.data);
            }
            for (auto& [channel, list] : sent_tunings) {
                const auto& known = file_tunings[channel];
                ASSERT_GE(list.size(), known.size());
                ASSERT_LE(list.size(), known.size() + 1) << "one bend back to the centre";
                list.resize(known.size());
                EXPECT_EQ(list, known);
            }
        }
    }
}

/// Of voices that share a channel unisons sound once.
TEST(Performer, UnisonsOnOneChannelAreStruckOnce) {
    MidiScore score{.head = midi_head(20),
                    .notes = {midi_note(0, 480, 60, 0), midi_note(0, 960, 60, 19), midi_note(240, 240, 60, 7)},
                    .end = 960};
    MidiOptions midi{.share_channels = true};
    Performance one;
    one.play(std::make_unique<FakeStream>(score, midi));
    EXPECT_EQ(one.heard(), (std::vector<Stroke>{{0, 60}, {second / 4, 60}}));
    EXPECT_EQ(times_of(one.port.sent, 0x80), (std::vector<Nanoseconds>{second / 4, second}));
}

/// Voices of drums take no channels from the others.
TEST(Performer, ChannelsDoNotDependOnDrums) {
    ScoreHead head;
    for (const bool is_drums : {false, true, false}) {
        Part& part = head.parts.emplace_back();
        part.is_drums = is_drums;
        part.voices = is_drums ? 14 : 1;
        part.program = static_cast<int>(head.parts.size());
    }
    Voices voices(head, {});
    std::vector<Message> messages;
    voices.prepare(messages);
    std::map<int, std::vector<int>> programs;
    for (const Message& message : messages) {
        if (message.kind() == 0xC0) programs[message.channel()].push_back(message.bytes[1]);
    }
    EXPECT_EQ(programs[0], std::vector<int>{1});
    EXPECT_EQ(programs[1], std::vector<int>{3});
}

TEST(Performer, ReadsTheClockAmongOtherBytes) {
    ClockReader reader;
    std::vector<Received> received;
    const std::vector<std::uint8_t> bytes = {0x90, 60,   100,  0xF8, 0xF2, 0x10, 0xF8, 0x01, 0xFA,
                                             0xF0, 0x7E, 0xF7, 0xFC, 0xFE, 0xFB, 0xF2, 0x90, 0x01};
    reader.read(std::span(bytes).first(6), 1, received);
    reader.read(std::span(bytes).subspan(6), 2, received);
    std::vector<Kind> kinds;
    kinds.reserve(received.size());
    for (const Received& one : received) kinds.push_back(one.kind);
    EXPECT_EQ(kinds,
              (std::vector<Kind>{Kind::clock, Kind::clock, Kind::position, Kind::start, Kind::stop, Kind::resume}));
    EXPECT_EQ(received[2].position, 0x90);
}

/// A real clock. What is printed is the measurement.
TEST(Performer, IsInTimeByARealClock) {
    MonotonicClock clock;
    FakePort port(clock);
    MidiScore score = quarters(200);
    score.head.tempo = 6000;  // a note every 10 ms
    const PerformReport report = perform(stream(score), clock, port, {}, {});
    expect_no_hanging_notes(port.sent);
    std::vector<double> late;
    const std::vector<Stroke> heard = strokes(port.sent);
    ASSERT_EQ(heard.size(), 200u);
    for (std::size_t i = 0; i < heard.size(); ++i) {
        late.push_back(static_cast<double>(heard[i].first - heard[0].first) / 1e6 - 10.0 * static_cast<double>(i));
    }
    std::sort(late.begin(), late.end());
    std::printf("late by: median %.3f ms, 99%% %.3f ms, most %.3f ms\n", late[100], late[197], late[199]);
    EXPECT_GT(late[0], -50);
    EXPECT_LT(late[100], 50) << "the median, also on a loaded machine";
    EXPECT_EQ(report.notes, 200u);
}

}  // namespace sikku::live::performer_test
