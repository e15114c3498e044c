#include "music/live/performer.h"

#include "music/live/voices.h"
#include "music/score/bar_lines.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sikku::live {
namespace {

/// Signals, newer versions and pauses are noticed within this time.
constexpr Nanoseconds longest_wait = second / 20;
/// Notes end after this time without clock messages.
constexpr Nanoseconds longest_silence = second;
/// Larger delays are not caught up with.
constexpr Nanoseconds most_catching_up = second / 2;
constexpr Nanoseconds tolerance = second / 200;
constexpr std::int64_t clock_ticks = ticks_per_quarter / clocks_per_quarter;
constexpr std::int64_t sixteenth = ticks_per_quarter / 4;
/// Silence is read ahead up to this time.
constexpr std::int64_t most_ahead = 64 * ticks_per_quarter;

double nanoseconds_per_tick(double tempo) {
    return 60.0 * static_cast<double>(second) / tempo / static_cast<double>(ticks_per_quarter);
}

/// Converts ticks of the performance to times by the clock of the machine.
class OwnTime {
public:
    void set_tempo(std::int64_t tick, double tempo) {
        time_ = exact_time_of(tick);
        tick_ = tick;
        pace_ = nanoseconds_per_tick(tempo);
    }
    void begin(Nanoseconds now) { time_ = static_cast<double>(now); }
    void shift(Nanoseconds by) { time_ += static_cast<double>(by); }
    Nanoseconds time_of(std::int64_t tick) const { return std::llround(exact_time_of(tick)); }

private:
    double exact_time_of(std::int64_t tick) const { return time_ + static_cast<double>(tick - tick_) * pace_; }
    std::int64_t tick_ = 0;
    double time_ = 0;
    double pace_ = nanoseconds_per_tick(120);
};

/// Converts ticks to times by the clock messages of another machine, at the distance of the last two messages.
class FollowedTime {
public:
    bool is_running() const { return is_running_ && has_clock_; }
    bool has_started() const { return is_running_; }
    Nanoseconds last() const { return last_; }

    void start(std::int64_t tick) {
        is_running_ = true;
        has_clock_ = false;
        next_ = tick;
    }
    void stop() { is_running_ = has_clock_ = false; }
    void set_position(std::int64_t tick) { next_ = tick; }
    std::int64_t position() const { return next_; }
    void set_tempo(double tempo) {
        if (!is_measured_) interval_ = nanoseconds_per_tick(tempo) * static_cast<double>(clock_ticks);
    }
    void clock(Nanoseconds time) {
        if (!is_running_) return;
        if (has_clock_ && time > last_ && time - last_ < longest_silence) {
            interval_ = static_cast<double>(time - last_);
            is_measured_ = true;
        }
        last_ = time;
        at_ = next_;
        next_ += clock_ticks;
        has_clock_ = true;
    }
    /// Nullopt for ticks after the next message.
    std::optional<Nanoseconds> time_of(std::int64_t tick) const {
        if (!is_running() || tick >= next_) return std::nullopt;
        return last_ + std::llround(static_cast<double>(tick - at_) * interval_ / static_cast<double>(clock_ticks));
    }

private:
    bool is_running_ = false;
    bool has_clock_ = false;
    bool is_measured_ = false;
    std::int64_t at_ = 0;    // tick of the last message
    std::int64_t next_ = 0;  // tick of the next message
    Nanoseconds last_ = 0;
    double interval_ = 0;
};

/// A version of the score, and its position.
class Version {
public:
    explicit Version(std::unique_ptr<NoteStream> stream)
        : stream_(std::move(stream)), voices_(stream_->head(), stream_->midi()), bars_(stream_->head()) {}

    NoteStream& stream() { return *stream_; }
    const ScoreHead& head() const { return stream_->head(); }
    Voices& voices() { return voices_; }
    const BarLines& bars() const { return bars_; }
    /// Length of a beat of the bar in which a tick lies.
    std::int64_t beat(std::int64_t tick) const { return bars_.length(tick) / bars_.meter(tick).beats; }

private:
    std::unique_ptr<NoteStream> stream_;
    Voices voices_;
    BarLines bars_;
};

class Performer {
public:
    Performer(std::unique_ptr<NoteStream> stream, Clock& clock, Port& port, const PerformOptions& options,
              const PerformHooks& hooks)
        : version_(std::make_unique<Version>(std::move(stream))),
          clock_(clock),
          port_(port),
          options_(options),
          hooks_(hooks),
          tells_places_(port.wants_places()),
          ahead_(follows() ? 0 : port.ahead()) {}

    PerformReport perform() {
        try {
            play();
        } catch (...) {
            give_up();
            throw;
        }
        return report_;
    }

private:
    bool follows() const { return options_.clock == ClockMode::follow; }
    bool sends_clock() const { return options_.clock == ClockMode::send; }
    /// Start, stop and continue; those who lead know them.
    bool sends_start() const { return sends_clock() || (tells_places_ && !follows()); }

    void play() {
        fill();  // the first notes are ready before the time begins
        version_->voices().prepare(messages_);
        begin_pass();
        own_.begin(clock_.now() + ahead_);
        if (follows()) tell("waiting for the clock to start");
        if (sends_start()) messages_.push_back({start_byte});
        flush();
        while (!is_done_) {
            hooks_.monitor.check();
            fill();
            const std::int64_t tick = next_tick();
            if (wait_for(tick)) play_tick(tick);
            retired_.reset();
        }
        stop();
    }

    /// Ends all notes, after the messages already sent.
    void stop() {
        version_->voices().silence(now_, messages_);
        if (sends_start()) messages_.push_back({stop_byte});
        flush();
        if (ahead_ == 0) return;
        for (const Nanoseconds end = own_.time_of(now_); clock_.now() < end;) clock_.sleep_until(end);
    }

    /// Ends all notes as well as the port allows.
    void give_up() {
        try {
            stop();
        } catch (const PortError&) {
            // The loss of the port was the cause, or is reported already.
        }
    }

    void tell(const std::string& text) const {
        if (hooks_.report) hooks_.report(text);
    }

    /// When the messages of the last tick are due, for the port.
    Nanoseconds due() const { return ahead_ > 0 ? own_.time_of(now_) : Port::at_once; }

    /// Sends the messages due with the last tick.
    void flush() {
        if (!messages_.empty()) port_.send(messages_, due());
        messages_.clear();
    }

    // --- the next events; ticks of the performance, which continue through repetitions

    void begin_pass() {
        ++report_.passes;
        reset_tempo(pass_);
    }

    void set_tempo(std::int64_t tick) {
        const double tempo = version_->head().tempo * curve_factor_ * fall_factor_;
        own_.set_tempo(tick, tempo);
        followed_.set_tempo(tempo);
    }
    void reset_tempo(std::int64_t tick) {
        curve_factor_ = fall_factor_ = 1;
        set_tempo(tick);
    }

    /// Reads windows until the next notes, or the end of the pass, are known: once they are needed, or if they are
    /// ready.
    void fill() {
        while (note_ == window_.notes.size() && !is_last_) {
            const std::int64_t left = is_window_ ? pass_ + window_.to - now_ : 0;
            if (left > most_ahead || (left > 0 && !version_->stream().is_ready())) return;
            take(version_->stream().next());
        }
    }

    void take(NoteWindow window) {
        window_ = std::move(window);
        is_window_ = true;
        note_ = 0;
        for (const NoteWindow::End& one : window_.ends) ends_.emplace(pass_ + one.tick, one.voice);
        for (const NoteWindow::Pitch& one : window_.pitches) {
            pitches_.emplace(pass_ + one.tick, std::pair(one.voice, one.key));
        }
        for (const ControlPoint& one : window_.controls) controls_.emplace(pass_ + one.tick, one);
        for (const TempoPoint& one : window_.tempos) tempos_.emplace(pass_ + one.tick, one.factor);
        is_last_ = window_.is_last;
        if (window_.end && !end_) set_end(*window_.end);
    }

    void set_end(std::int64_t end) {
        end_ = end;
        length_ = version_->bars().next_pass(end);
        falls_ = tempo_map(version_->head(), {}, end);
        fall_ = 0;
    }

    bool is_last_pass() const { return options_.times > 0 && report_.passes >= options_.times; }

    /// The end of the pass: at a bar line if it is repeated.
    std::int64_t pass_end() const { return pass_ + (is_last_pass() ? *end_ : length_); }

    std::int64_t next_tick() const {
        std::int64_t tick = INT64_MAX;
        if (note_ < window_.notes.size()) {
            tick = pass_ + window_.notes[note_].onset;
        } else if (!is_last_) {
            tick = pass_ + window_.to;  // place where more is read
        }
        if (!ends_.empty()) tick = std::min(tick, ends_.begin()->first);
        if (!pitches_.empty()) tick = std::min(tick, pitches_.begin()->first);
        if (!controls_.empty()) tick = std::min(tick, controls_.begin()->first);
        if (!tempos_.empty()) tick = std::min(tick, tempos_.begin()->first);
        if (fall_ < falls_.size()) tick = std::min(tick, pass_ + falls_[fall_].tick);
        if (end_ && is_last_) tick = std::min(tick, pass_end());
        if (sends_clock()) tick = std::min(tick, clock_tick_);
        if (tells_places_) tick = std::min(tick, beat_tick_);
        if (next_) tick = std::min(tick, change_);
        return std::max(tick, now_);
    }

    // --- waiting

    /// Waits for a tick for a limited time. @return true if it has come
    bool wait_for(std::int64_t tick) {
        look_for_newer();
        if (next_ && change_ < tick) return false;
        pause_if_wanted();
        const Nanoseconds now = clock_.now();
        if (!follows()) {
            const Nanoseconds time = own_.time_of(tick);
            if (time - ahead_ <= now) {
                // After a suspended process or slow reading the music resumes where it stopped.
                if (now - time > most_catching_up) {
                    own_.shift(now - time);
                    report_.lost += now - time;
                } else {
                    note_lateness(tick, now - time);
                }
                return true;
            }
            port_.wait(clock_, std::min(time - ahead_, now + longest_wait));
            return false;
        }
        const auto time = followed_.time_of(tick);
        if (time && *time <= now) {
            note_lateness(tick, now - *time);
            return true;
        }
        receive(port_.wait(clock_, std::min(time.value_or(INT64_MAX), now + longest_wait)));
        if (followed_.is_running() && clock_.now() - followed_.last() > longest_silence) silence();
        return false;
    }

    void note_lateness(std::int64_t tick, Nanoseconds late) {
        if (note_ >= window_.notes.size() || pass_ + window_.notes[note_].onset != tick) return;
        report_.latest = std::max(report_.latest, late);
        if (late > tolerance) ++report_.late;
    }

    void silence() {
        if (version_->voices().sounding() == 0) return;
        version_->voices().silence(now_, messages_);
        flush();
    }

    void receive(const std::vector<Received>& received) {
        for (const Received& one : received) {
            switch (one.kind) {
                case Received::Kind::clock:
                    followed_.clock(one.time);
                    catch_up();
                    break;
                case Received::Kind::start:
                    silence();
                    if (now_ > 0 || followed_.position() > 0) restart(0);
                    followed_.start(now_);
                    break;
                case Received::Kind::resume:
                    followed_.start(std::max(followed_.position(), now_));
                    break;
                case Received::Kind::stop:
                    silence();
                    if (followed_.has_started()) tell("stopped by the clock");
                    followed_.stop();
                    break;
                case Received::Kind::position:
                    if (followed_.has_started()) break;
                    silence();
                    restart(one.position * sixteenth);
                    followed_.set_position(now_);
                    break;
            }
        }
    }

    /// Plays the notes that a clock message has made due, before the next message is read.
    void catch_up() {
        while (!is_done_) {
            fill();
            const std::int64_t tick = next_tick();
            const auto time = followed_.time_of(tick);
            if (!time || tick > followed_.position() - clock_ticks) return;
            play_tick(tick);
        }
    }

    /// Moves to a tick of the score. The tick of the performance continues.
    void restart(std::int64_t tick) {
        ends_.clear();
        pitches_.clear();
        version_->stream().seek(tick);
        pass_ = now_ - tick;
        forget_window();
        reset_tempo(now_);
        aim_at_beat(now_);
    }

    void forget_window() {
        window_ = {};
        is_window_ = is_last_ = false;
        note_ = 0;
        end_.reset();
        falls_.clear();
        fall_ = 0;
        controls_.clear();
        tempos_.clear();
    }

    void pause_if_wanted() {
        if (!hooks_.is_pause_wanted || !hooks_.is_pause_wanted()) return;
        stop();
        const Nanoseconds begin = clock_.now();
        hooks_.pause();
        own_.shift(clock_.now() + ahead_ - begin);
        if (sends_start()) messages_.push_back({continue_byte});
        flush();
    }

    // --- newer versions

    void look_for_newer() {
        auto stream = hooks_.newer ? hooks_.newer() : nullptr;
        if (!stream) return;
        next_ = std::make_unique<Version>(std::move(stream));
        patience_ = 1;
        aim_at(now_ + 1);
    }

    /// Schedules the next version for the first bar line from `tick` on.
    void aim_at(std::int64_t tick) {
        const BarLines& bars = version_->bars();
        const std::int64_t line = bars.next(std::max<std::int64_t>(0, tick - pass_));
        change_ = pass_ + line;
        next_bar_ = bars.printed_number(line);
        next_->stream().seek(next_->bars().printed_onset(next_bar_));
    }

    void change_version(std::int64_t tick) {
        if (!next_->stream().is_ready()) {
            patience_ *= 2;  // bars for its preparation
            return aim_at(tick + (patience_ - 1) * version_->bars().length(tick - pass_) + 1);
        }
        NoteWindow first;
        try {
            first = next_->stream().next();
        } catch (const std::runtime_error&) {
            // The version before it continues.
            if (hooks_.refused) hooks_.refused(std::current_exception());
            retired_ = std::move(next_);
            return;
        }
        version_->voices().silence(tick, messages_);
        retired_ = std::exchange(version_, std::move(next_));
        ends_.clear();
        pitches_.clear();
        forget_window();
        pass_ = tick - version_->bars().printed_onset(next_bar_);
        version_->voices().prepare(messages_);
        reset_tempo(tick);
        aim_at_beat(tick);
        if (hooks_.changed) hooks_.changed(next_bar_);
        take(std::move(first));
        fill();
        // A shorter version may have ended already.
        if (end_ && is_last_ && pass_end() <= tick) end_pass(tick);
    }

    // --- playing

    /// Sends all events of a tick: tempo, clock, ends, beginnings.
    void play_tick(std::int64_t tick) {
        now_ = tick;
        if (sends_clock() && clock_tick_ <= tick) {
            messages_.push_back({clock_byte});
            clock_tick_ += clock_ticks;
        }
        change_tempo(tick);
        for (; !ends_.empty() && ends_.begin()->first <= tick; ends_.erase(ends_.begin())) {
            version_->voices().end(ends_.begin()->second, tick, messages_);
        }
        if (next_ && change_ <= tick) change_version(tick);
        if (end_ && is_last_ && note_ == window_.notes.size() && pass_end() <= tick) end_pass(tick);
        if (!is_done_) fill();
        change_tempo(tick);  // tempo of a window or a pass that begins here
        if (!is_done_) {
            tell_place(tick);
            play_notes(tick);
        }
        flush();
    }

    /// The next beat is the first one from `tick` on.
    void aim_at_beat(std::int64_t tick) {
        const std::int64_t beat = version_->beat(tick - pass_);
        const std::int64_t place = version_->bars().place(tick - pass_);
        beat_tick_ = tick - place + (place + beat - 1) / beat * beat;
    }

    void tell_place(std::int64_t tick) {
        if (!tells_places_ || beat_tick_ > tick) return;
        const std::int64_t place = beat_tick_ - pass_;
        const BarLines& bars = version_->bars();
        port_.send_place(
            {bars.printed_number(place), static_cast<int>(bars.place(place) / version_->beat(place)) + 1}, due());
        aim_at_beat(tick + 1);
    }

    void change_tempo(std::int64_t tick) {
        const bool is_due = (!tempos_.empty() && tempos_.begin()->first <= tick) ||
                            (fall_ < falls_.size() && pass_ + falls_[fall_].tick <= tick);
        if (!is_due) return;
        for (; !tempos_.empty() && tempos_.begin()->first <= tick; tempos_.erase(tempos_.begin())) {
            curve_factor_ = tempos_.begin()->second;
        }
        for (; fall_ < falls_.size() && pass_ + falls_[fall_].tick <= tick; ++fall_) {
            fall_factor_ = falls_[fall_].factor;
        }
        set_tempo(tick);
    }

    /// Controllers come before the notes of their tick, and bends after.
    void play_notes(std::int64_t tick) {
        std::vector<ControlPoint> bends;
        for (; !controls_.empty() && controls_.begin()->first <= tick; controls_.erase(controls_.begin())) {
            const ControlPoint& point = controls_.begin()->second;
            if (point.number == ControlPoint::bend) {
                bends.push_back(point);
            } else {
                version_->voices().control(point, messages_);
            }
        }
        begin_notes(tick);
        for (const ControlPoint& point : bends) version_->voices().control(point, messages_);
        for (; !pitches_.empty() && pitches_.begin()->first <= tick; pitches_.erase(pitches_.begin())) {
            const auto [voice, key] = pitches_.begin()->second;
            version_->voices().slide(voice, key, tick, messages_);
        }
    }

    void begin_notes(std::int64_t tick) {
        for (;; ++note_) {
            fill();
            if (note_ >= window_.notes.size() || pass_ + window_.notes[note_].onset > tick) return;
            const Note& note = window_.notes[note_];
            version_->voices().begin(note, tick, messages_);
            // The end of a note that this one replaces is not the end of this one.
            std::erase_if(ends_, [&](const auto& one) { return one.second == note.voice; });
            if (note.duration > 0) ends_.emplace(pass_ + note.onset + note.duration, note.voice);
            ++report_.notes;
        }
    }

    void end_pass(std::int64_t tick) {
        if (is_last_pass()) {
            is_done_ = true;
            return;
        }
        pass_ = tick;
        forget_window();
        begin_pass();
        aim_at_beat(tick);
        fill();
    }

    std::unique_ptr<Version> version_;
    std::unique_ptr<Version> next_;     // replaces the current one at change_
    std::unique_ptr<Version> retired_;  // its thread ends after the notes of the change are sent
    std::int64_t change_ = 0;
    std::int64_t next_bar_ = 0;  // number of the bar there, as printed
    std::int64_t patience_ = 1;
    Clock& clock_;
    Port& port_;
    PerformOptions options_;
    const PerformHooks& hooks_;
    bool tells_places_;
    Nanoseconds ahead_;  // time that messages wait in the port
    PerformReport report_;
    OwnTime own_;
    FollowedTime followed_;
    std::vector<Message> messages_;
    bool is_done_ = false;
    std::int64_t now_ = 0;         // the last tick that was played
    std::int64_t pass_ = 0;        // tick at which the score begins, or would have begun
    std::int64_t clock_tick_ = 0;  // tick of the next clock message to send
    std::int64_t beat_tick_ = 0;   // tick of the next beat
    NoteWindow window_;
    bool is_window_ = false;
    bool is_last_ = false;  // no window of this pass follows
    std::size_t note_ = 0;  // the next note of the window
    std::optional<std::int64_t> end_;
    std::int64_t length_ = 0;        // length of the score in whole bars, in ticks
    std::vector<TempoPoint> falls_;  // changes of tempo at the end of the score
    std::size_t fall_ = 0;
    double fall_factor_ = 1;
    std::multimap<std::int64_t, double> tempos_;  // factors of the tempo along the curve
    double curve_factor_ = 1;
    std::multimap<std::int64_t, ControlPoint> controls_;
    std::multimap<std::int64_t, int> ends_;                        // of sounding notes: tick and voice
    std::multimap<std::int64_t, std::pair<int, double>> pitches_;  // slides of sounding notes: tick, voice and key
};

}  // namespace

PerformReport perform(std::unique_ptr<NoteStream> stream, Clock& clock, Port& port, const PerformOptions& options,
                      const PerformHooks& hooks) {
    return Performer(std::move(stream), clock, port, options, hooks).perform();
}

}  // namespace sikku::live
