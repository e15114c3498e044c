#include "cli/live.h"

#include "cli/command.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "music/live/ahead.h"
#include "music/live/osc_port.h"
#include "music/live/performer.h"
#include "music/live/ports.h"

#include <fmt/format.h>

#include <atomic>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

constexpr auto polling = std::chrono::milliseconds(150);
constexpr std::size_t most_values = 64;  // of keys that messages change; further ones are ignored

/// Date, size and place of a file; all zero if it is missing.
using Stamp = std::tuple<std::filesystem::file_time_type::duration::rep, std::uintmax_t>;

Stamp stamp_of(const std::filesystem::path& file) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    if (error) return {};
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    return {time.time_since_epoch().count(), error ? 0 : size};
}

/// The message of an error, as the program prints it.
std::string message_of(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const PatternError& problem) {
        return pattern_message(problem);
    } catch (const SettingError& problem) {
        return option_message(problem);
    } catch (const std::exception& problem) {
        return with_dashes(problem.what());
    }
}

void report_change(const std::exception_ptr& error) {
    tell("{}\nsikku: the change has errors; the version before it plays on\n", message_of(error));
}

void add_change(live::PatternChange change, LiveChanges& changes) {
    if (change.key.empty()) {
        changes.text = std::move(change.value);
        changes.values.clear();
    } else if (changes.values.size() < most_values || changes.values.contains(change.key)) {
        changes.values[std::move(change.key)] = std::move(change.value);
    }
}

/// Looks for changes of files and by messages, on a thread, and opens the score again.
class Reloader {
public:
    explicit Reloader(const LiveScore& score) : score_(score), stamps_(stamps()), thread_([this] { watch(); }) {}
    Reloader(const Reloader&) = delete;
    Reloader& operator=(const Reloader&) = delete;
    ~Reloader() {
        {
            const std::lock_guard lock(mutex_);
            is_over_ = true;
        }
        over_.notify_one();
        thread_.join();
    }

    /// Takes the change of a message, for the next look.
    void change(live::PatternChange one) {
        const std::lock_guard lock(mutex_);
        add_change(std::move(one), wanted_);
    }

    /// Forgets the changes in the last version: it cannot be played.
    void refuse() { is_refused_ = true; }

    std::unique_ptr<NoteStream> newer() {
        if (!has_newer_) return nullptr;
        const std::lock_guard lock(mutex_);
        has_newer_ = false;
        return std::move(stream_);
    }

private:
    std::map<std::filesystem::path, Stamp> stamps() const {
        std::map<std::filesystem::path, Stamp> result;
        for (const std::filesystem::path& file : score_.files()) result[file] = stamp_of(file);
        return result;
    }

    void watch() {
        try {
            look_until_over();
        } catch (const Stopped&) {
            // Ctrl-C while an arrangement was read for the names of its files: the music ends, too.
        }
    }

    void look_until_over() {
        std::map<std::filesystem::path, Stamp> last = stamps_;
        for (;;) {
            LiveChanges wanted;
            {
                std::unique_lock lock(mutex_);
                if (over_.wait_for(lock, polling, [this] { return is_over_; })) return;
                wanted = std::exchange(wanted_, {});
            }
            auto now = stamps();
            // Editors write in several steps: waits for the last one.
            const bool is_written = now == last && now != stamps_;
            last = now;
            if (is_written) stamps_ = std::move(now);
            if (is_written || wanted.text || !wanted.values.empty()) reload(is_written, wanted);
        }
    }

    /// The latest text is heard, whether a file or a message has it.
    void reload(bool is_written, LiveChanges& wanted) {
        if (is_refused_.exchange(false)) changes_ = before_;
        LiveChanges changes = changes_;
        if (is_written) changes.text.reset();
        if (wanted.text) add_change({{}, std::move(*wanted.text)}, changes);
        for (auto& [key, value] : wanted.values) add_change({key, std::move(value)}, changes);
        try {
            auto stream = live::read_ahead([&](const Monitor& monitor) { return score_.open(changes, monitor); },
                                           stop_monitor());
            before_ = std::exchange(changes_, std::move(changes));
            const std::lock_guard lock(mutex_);
            std::swap(stream_, stream);  // one that nobody took ends after the lock
            has_newer_ = true;
        } catch (const Stopped&) {
        } catch (...) {
            report_change(std::current_exception());
        }
    }

    const LiveScore& score_;
    std::map<std::filesystem::path, Stamp> stamps_;  // of the last version read
    LiveChanges changes_;                            // in the last version without errors
    LiveChanges before_;                             // in the version before it
    LiveChanges wanted_;                             // by messages since the last look
    std::atomic<bool> is_refused_{false};
    std::mutex mutex_;
    std::condition_variable over_;
    bool is_over_ = false;
    std::atomic<bool> has_newer_{false};
    std::unique_ptr<NoteStream> stream_;
    std::thread thread_;  // declared last: it uses the others
};

std::int64_t times_of(const LiveOptions& options) {
    if (options.repeat_option->count() == 0) return 1;
    if (options.repeat.empty() || options.repeat.front().empty()) return 0;
    std::int64_t times = 0;
    const std::string& text = options.repeat.front();
    std::from_chars(text.data(), text.data() + text.size(), times);
    return times;
}

std::unique_ptr<live::Port> open_port(const std::string& name, bool has_input, const live::ChangeSink& change) {
    if (live::is_osc_address(name)) return live::open_osc_port(live::read_osc_address(name), change);
    std::error_code error;
    const bool is_pipe = std::filesystem::is_fifo(name, error);
    if (is_pipe || name.find('/') != std::string::npos) return live::open_device(name, has_input);
    return live::open_alsa_port(name, has_input);
}

std::string summary(const live::PerformReport& report) {
    std::string text = counted(report.notes, "note");
    if (report.passes > 1) text += fmt::format(", played {} times", report.passes);
    if (report.late > 0) {
        text += fmt::format("; {} more than 5 ms late, the latest {:.0f} ms", counted(report.late, "note"),
                            static_cast<double>(report.latest) / 1e6);
    }
    return text;
}

/// For CLI::Option::check(): the error, or an empty text.
std::string check_port(const std::string& text) {
    if (text.empty()) return "expected a name, an address or a device";
    try {
        if (live::is_osc_address(text)) live::read_osc_address(text);
    } catch (const live::PortError& error) {
        return error.what();
    }
    return {};
}

}  // namespace

void add_live_options(CLI::App& command, LiveOptions& options) {
    const OptionGroup group{command, "Live"};
    group
        .add("--port", options.port, "PORT",
             "play now, to this MIDI port: a name or address from `sikku ports`, or a device or pipe such as "
             "/dev/snd/midiC1D0; or as OSC messages to osc://HOST:PORT, perhaps with ,listen=PORT to hear messages; "
             "changes of the pattern files are heard from the next bar on")
        ->check(check_port);
    options.repeat_option =
        group.add("--repeat", options.repeat, "[TIMES]", "with --port: number of repetitions (until ctrl-C)")
            ->expected(0, 1)
            ->allow_extra_args(false)
            ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
            ->check([](const std::string& text) { return text.empty() ? "" : whole_number(1, 1'000'000'000)(text); });
    group
        .add("--clock", options.clock, "send|follow",
             "with --port: send a MIDI clock, or follow one, with its start, stop and tempo")
        ->check(one_of({"send", "follow"}));
}

bool is_live(const LiveOptions& options, const std::string& output) {
    if (!options.port.empty()) {
        if (!output.empty()) throw UsageError("-o and --port cannot be combined: one writes a file, one plays now");
        if (options.clock == "follow" && live::is_osc_address(options.port) &&
            !live::read_osc_address(options.port).listen) {
            throw UsageError("--clock follow needs a port to listen on: --port " + options.port + ",listen=9001");
        }
        return true;
    }
    if (options.repeat_option->count() > 0)
        throw UsageError("--repeat needs --port; --loop repeats a part in a file");
    if (!options.clock.empty()) throw UsageError("--clock needs --port");
    return false;
}

void play_live(const LiveOptions& options, const LiveScore& score, bool quiet) {
    ignore_closed_pipes();
    live::PerformOptions perform;
    perform.times = times_of(options);
    perform.clock = options.clock == "send"     ? live::ClockMode::send
                    : options.clock == "follow" ? live::ClockMode::follow
                                                : live::ClockMode::none;
    auto stream = live::read_ahead([&](const Monitor& monitor) { return score.open({}, monitor); }, stop_monitor());
    Reloader reloader(score);
    const auto port = open_port(options.port, perform.clock == live::ClockMode::follow,
                                [&](live::PatternChange change) { reloader.change(std::move(change)); });
    live::MonotonicClock clock;
    live::PerformHooks hooks;
    hooks.monitor = stop_monitor();
    hooks.newer = [&] { return reloader.newer(); };
    hooks.changed = [&](std::int64_t bar) { tell_unless(quiet, "changed from bar {} on\n", bar); };
    hooks.refused = [&](const std::exception_ptr& error) {
        reloader.refuse();
        report_change(error);
    };
    hooks.report = [&](const std::string& text) { tell_unless(quiet, "{}\n", text); };
    hooks.is_pause_wanted = pause_wanted;
    hooks.pause = pause_now;
    catch_pause();
    live::prefer_this_thread();
    tell_unless(quiet, "playing to {}; ctrl-C stops\n", printable(options.port));
    try {
        const live::PerformReport report = live::perform(std::move(stream), clock, *port, perform, hooks);
        tell_unless(quiet, "{}\n", summary(report));
    } catch (const Stopped&) {
        throw Interrupted("stopped");
    }
}

}  // namespace sikku
