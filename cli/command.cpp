#include "cli/command.h"

#include "art/prints.h"
#include "cli/link_argument.h"
#include "cli/mistakes.h"
#include "cli/options.h"
#include "engine/base/diagnostic.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "engine/language/arrangement_library.h"
#include "engine/language/foreign_text.h"
#include "music/score/midi_texts.h"
#include "music/scores.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <system_error>
#include <utility>

namespace sikku {
std::string unwritten(const std::string& cause) {
    return "cannot write to standard output" + (cause.empty() ? "" : ": " + cause);
}

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void add_pattern_options(CLI::App& command, PatternOptions& options) {
    command
        .add_option("PATTERN", options.pattern,
                    "pattern file, name of a bundled pattern, studio link, or - for standard input")
        ->required();
    add_override_options(command, options);
}

void add_override_options(CLI::App& command, PatternOptions& options) {
    command.add_option("-n,--steps", options.steps, "derivation length, instead of the pattern's")->type_name("N");
    command.add_option("--set", options.settings, "value of a key or define of the pattern; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command.add_option("--variant", options.variant, "variant of the pattern")->type_name("NAME");
    command.add_option("--seed", options.seed, "random seed, instead of the pattern's")->type_name("N");
    add_trust_option(command, options.trusts_link);
}

void add_trust_option(CLI::App& command, bool& trusts_link) {
    command.add_flag("--trust-link", trusts_link,
                     "allow a studio link to name files of this machine and to set commands for plotters");
}

std::uint64_t seed_of(const PatternOptions& options) {
    const std::string& text = options.seed;
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (!text.empty() && (error != std::errc() || end != text.data() + text.size())) {
        throw UsageError(fmt::format("--seed {}: expected a whole number, 0 to 18446744073709551615", text));
    }
    return seed;
}

void add_budget_option(CLI::App& command, double& budget) {
    command.add_option("--budget", budget, "maximum number of derivation nodes visited (2e8)")
        ->type_name("NODES")
        ->check(above_zero);
}

void keep_input(std::string_view option, const std::string& output, const std::string& input) {
    std::error_code unknown;
    if (output.empty() || input.empty() || !std::filesystem::is_regular_file(output, unknown)) return;
    if (!std::filesystem::equivalent(output, input, unknown)) return;
    throw UsageError(fmt::format("{} {}: this file is read and would be replaced", option, printable(output)));
}

PatternFile find_named_pattern(const std::string& pattern) {
    try {
        return find_pattern(pattern);
    } catch (const NotFound& error) {
        if (bundled_arrangement(pattern))
            throw UsageError(pattern + ": this is an arrangement; `sikku play` plays it");
        const std::vector<std::string> arrangements = bundled_arrangements();
        const std::string_view near = nearest(pattern, {arrangements.begin(), arrangements.end()});
        throw UsageError(std::string(error.what()) +
                         (error.has_suggestion() ? ""
                          : near.empty()         ? "; `sikku patterns` lists the bundled ones"
                                                 : fmt::format("; `sikku play` plays the arrangement '{}'", near)));
    }
}

NamedText read_pattern_text(const std::string& pattern) {
    if (auto link = read_link_argument(pattern)) {
        check_text_of_link(*link);
        return {std::move(link->name), std::move(link->text)};
    }
    PatternFile found;
    if (pattern != "-") found = find_named_pattern(pattern);
    auto format = known_format(found.path);
    if (is_midi_file(found.path)) format = {"a MIDI file", true};
    if (format) {
        throw UsageError(
            fmt::format("{}: this is {}, not a pattern{}", pattern, format->name,
                        format->has_pattern ? "; `sikku show` prints the pattern if Sikku made the file" : ""));
    }
    if (lower_case(pattern).ends_with(".json")) {
        throw UsageError(
            fmt::format("{}: this is JSON, not a pattern; `sikku tiling` reads polygons, and "
                        "`sikku kolam --read` reads kolams",
                        pattern));
    }
    try {
        if (pattern == "-") {
            static bool was_read = false;
            if (std::exchange(was_read, true)) throw UsageError("-: standard input can be read only once");
            return {"-", read_pattern(stdin, "standard input", stop_monitor())};
        }
        return {found.name, read_pattern({pattern, found.path}, stop_monitor())};
    } catch (const std::runtime_error& error) {
        throw UsageError(error.what());
    }
}

std::string foreign_message(const std::string& pattern, const NamedText& text) {
    constexpr std::string_view track = "[[track]]";  // a line of every arrangement
    if (text.text.starts_with(track) || text.text.find("\n" + std::string(track)) != std::string::npos) {
        return pattern + ": this is an arrangement; `sikku play` reads it from a file whose name ends in .toml";
    }
    const ForeignKind kind = foreign_kind(text.text);
    if (kind == ForeignKind::none) return {};
    std::string message = fmt::format("{}: this is {}, not a pattern", pattern, foreign_kind_name(kind));
    if (kind == ForeignKind::fractint || kind == ForeignKind::cpfg) {
        const bool is_one = kind == ForeignKind::cpfg;
        std::string output = pattern == "-" ? "imported" : std::filesystem::path(pattern).stem().string();
        if (is_one) output += pattern.ends_with(".lsys") ? "-imported.lsys" : ".lsys";
        message += fmt::format("; `sikku import {} -o {}` makes {}", shell_word(pattern), shell_word(output),
                               is_one ? "a pattern of it" : "patterns of its entries");
    }
    return message;
}

std::span<const Interpreter* const> interpreters() {
    static const std::array all = {&prints(), &scores()};
    return all;
}

Document load(const PatternOptions& options, bool quiet) {
    const auto link = read_link_argument(options.pattern);
    return load(options, link ? &*link : nullptr, quiet);
}

Document load(const PatternOptions& options, const SharedWork* link, bool quiet) {
    std::vector<Setting> settings;
    if (link) settings = settings_of(*link, options);
    for (const std::string& text : options.settings) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            throw UsageError(fmt::format("--set {}: expected KEY=VALUE", text));
        }
        settings.push_back(Setting::assignment("--set", text.substr(0, equals), text.substr(equals + 1)));
    }
    if (!options.steps.empty()) {
        std::int64_t steps = 0;
        const char* end = options.steps.data() + options.steps.size();
        const auto [stopped, error] = std::from_chars(options.steps.data(), end, steps);
        if (error != std::errc() || stopped != end || steps < 0) {
            throw UsageError(fmt::format("-n {}: expected a whole number, 0 or more, below 2^63", options.steps));
        }
        settings.push_back({"-n", "derivation length", options.steps});
    }
    if (!options.seed.empty()) settings.push_back({"--seed", "seed", options.seed});
    NamedText text = link ? NamedText{link->name, link->text} : read_pattern_text(options.pattern);
    if (const std::string foreign = foreign_message(options.pattern, text); !link && !foreign.empty()) {
        throw UsageError(foreign);
    }
    const std::string& variant = link && options.variant.empty() ? link->variant : options.variant;
    if (link) check_pattern_of_link(*link, variant, options);
    Diagnostics diagnostics;
    if (interrupted()) throw Interrupted();
    Document document = compile(std::move(text.name), std::move(text.text), {variant, std::move(settings)},
                                interpreters(), diagnostics);
    diagnostics.throw_if_errors();
    if (!quiet) {
        for (const Diagnostic& warning : diagnostics.list()) tell("{}\n", diagnostic_message(warning));
    }
    return document;
}

void make(Work& work, const std::string& output, bool quiet) {
    Made made;
    {
        Progress progress(quiet);
        made = work.make(file_system(), output, progress.monitor());
    }
    if (quiet) return;
    report(made);
}

void report(const Made& made) {
    for (const Remark& remark : made.remarks) {
        tell("{}{}\n", remark.is_warning ? "sikku: warning: " : "", printable_lines(with_dashes(remark.text), 2000));
    }
}

Progress::Progress(bool quiet)
    : shown_(!quiet && isatty(STDERR_FILENO) == 1), started_(seconds_now()), last_(started_) {}

Progress::~Progress() {
    if (visible_) tell("\r\033[K");
}

void Progress::expect(double symbols) {
    expected_ = symbols;
    symbols_ = 0;
    started_ = seconds_now();
}

void Progress::add(std::uint64_t symbols) {
    symbols_ += static_cast<double>(symbols);
    if (interrupted()) throw Interrupted();
    // The clock costs more than most calls do.
    if (shown_ && (symbols == 0 || ++calls_ % 256 == 0)) show();
}

Monitor Progress::monitor() {
    return Monitor([](void*) { return interrupted(); },
                   [](void* progress, std::uint64_t symbols) { static_cast<Progress*>(progress)->add(symbols); },
                   this, [](void* progress, double symbols) { static_cast<Progress*>(progress)->expect(symbols); });
}

void Progress::show() {
    const double time = seconds_now();
    if (time - started_ < 0.5 || time - last_ < 0.1) return;
    last_ = time;
    visible_ = true;
    const double rate = symbols_ / (time - started_);
    if (expected_ > 0 && std::isfinite(expected_)) {
        const double share = std::min(1.0, symbols_ / expected_);
        const auto filled = static_cast<std::size_t>(share * 30);
        const double left = share > 0 ? (time - started_) * (1 / share - 1) : 0;
        tell("\r[{}{}] {:3.0f} %{}{}\033[K", std::string(filled, '#'), std::string(30 - filled, ' '), share * 100,
             share > 0 ? fmt::format(", about {:.0f} s left", left) : "",
             rate >= 1e6 ? fmt::format(", {:.0f} M symbols a second", rate / 1e6) : "");
    } else {
        tell("\r{:.1f} M symbols, {:.0f} M a second\033[K", symbols_ / 1e6, rate / 1e6);
    }
}

void write_file(const std::filesystem::path& path, const std::string& text) {
    if (path.empty()) return fmt::print("{}", text);
    OutputFile file(path);
    file.write(text);
    file.commit();
}

void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0) {
            if (errno == EINTR && !interrupted()) continue;
            if (interrupted()) throw Interrupted();
            throw std::runtime_error(unwritten(std::generic_category().message(errno)));
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

std::string extension_of(const std::string& file) {
    return lower_case(std::filesystem::path(file).extension().string());
}

}  // namespace sikku
