// cli/play.cpp: `sikku play`: a curve as music.
#include "art/print/format.h"
#include "cli/arrangement_argument.h"
#include "cli/command.h"
#include "cli/link_argument.h"
#include "cli/live.h"
#include "cli/options.h"
#include "engine/base/text.h"
#include "music/scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace sikku {
namespace {

constexpr const char* pattern_message_address = "/sikku/pattern";
constexpr const char* set_message_address = "/sikku/set";

struct PlayCommand {
    PatternOptions pattern;  ///< except its name
    std::vector<std::string> patterns;
    std::string output;
    LiveOptions live;
    TableOptions options;
};

std::string listed(const std::vector<std::string>& words) {
    const std::vector<std::string_view> views(words.begin(), words.end());
    return alternatives(views);
}

/// All extensions of scores.
std::string all_extensions() {
    auto [all, sounds, views] = score_extensions();
    all.insert(all.end(), sounds.begin(), sounds.end());
    all.insert(all.end(), views.begin(), views.end());
    return listed(all);
}

/// The name of the format with the file's extension. @throws UsageError
std::string score_format_of(const std::string& output) {
    const std::string extension = std::filesystem::path(output).extension().string();
    const FormatName* format = find_format(scores().formats(), extension.substr(extension.empty() ? 0 : 1));
    if (format) return std::string(format->extension);
    if (print_format(output)) {
        throw UsageError(
            fmt::format("-o {}: this is a print; `sikku draw` draws the curve; a printed score is .pdf", output));
    }
    const auto [files, sounds, views] = score_extensions();
    throw UsageError(fmt::format("-o {}: {}; a score is {}; sound is {}; {} show it", output,
                                 extension.empty() ? "no extension" : "unknown extension", listed(files),
                                 listed(sounds), fmt::join(views, " and ")));
}

/// Uses the seed of the pattern for the options of the score, too. Those of a link contain it already: see assign().
void add_seed(const PatternOptions& options, OptionValues& values) {
    if (options.seed.empty() || has_option(values, "seed")) return;
    values.push_back({"seed", std::to_string(seed_of(options))});
}

/// The values after `@` of a part, such as `start=4,rhythm=E(3,8)`. Commas within parentheses, and those not followed
/// by `KEY=`, as in `canon=2 -12,4 -24`, belong to a value.
std::vector<Setting> part_settings(const std::string& name, std::string_view text) {
    std::vector<Setting> settings;
    while (!text.empty()) {
        std::size_t end = 0;
        for (int open = 0; end < text.size() && (open > 0 || text[end] != ','); ++end) {
            open += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
        }
        const std::string_view one = text.substr(0, end);
        const std::size_t equals = one.find('=');
        if (equals == 0 || (equals == std::string_view::npos && settings.empty())) {
            throw UsageError(
                fmt::format("{}: expected KEY=VALUE after '@', such as hilbert@transposition=-12,start=4", name));
        }
        if (equals == std::string_view::npos) {
            settings.back().value += fmt::format(",{}", one);
        } else {
            const Setting setting = part_setting(one.substr(0, equals), std::string(one.substr(equals + 1)));
            if (std::any_of(settings.begin(), settings.end(),
                            [&](const Setting& other) { return other.key == setting.key; })) {
                throw UsageError(fmt::format("{}: {} is given twice", name, setting.key));
            }
            settings.push_back(setting);
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return settings;
}

/// The index at which the values of a part begin in its name; its length if there are none.
std::size_t end_of_name(const std::string& name) {
    const std::size_t at = name.rfind('@');
    if (at == std::string::npos || at == 0 || is_link(name) || std::filesystem::exists(name)) return name.size();
    return at;
}

/// An arrangement file: it is played alone. A seed selects a human player, if there is one. @throws UsageError
void check_arrangement(const PlayCommand& command, const OptionValues& values) {
    const std::string& name = command.patterns.front();
    if (command.patterns.size() > 1) {
        throw UsageError(name + ": an arrangement is played alone; its tracks name the patterns");
    }
    const PatternOptions& pattern = command.pattern;
    const bool has_seed = !pattern.seed.empty() && !has_option(values, "humanise");
    if (!pattern.steps.empty() || !pattern.settings.empty() || !pattern.variant.empty() || has_seed) {
        throw UsageError(name +
                         ": -n, --set, --variant and --seed belong to patterns; its tracks have n, set, variant "
                         "and seed");
    }
}

void play_arrangement(const PlayCommand& command, const std::string& format, const OptionValues& values, bool quiet) {
    check_arrangement(command, values);
    scores().check(format, values);
    try {
        const auto [arrangement, folder] = read_arrangement_argument(command.patterns.front());
        if (!command.output.empty()) {
            return make(*plan_score(arrangement, format, values, folder), command.output, quiet);
        }
        Progress progress(quiet);
        fmt::print("{}", describe_score(arrangement, values, progress.monitor(), folder));
    } catch (const FileError& error) {
        throw UsageError(error.what());
    }
}

/// The parts of a score.
struct Parts {
    std::vector<Document> documents;
    OptionValues values;  ///< options of the command line, and of the link, if the first pattern is one
    OptionValues shared;  ///< those of the link
};

/// Texts that live music reads instead of files.
struct LiveTexts {
    LiveChanges changes;                    ///< those wanted now
    std::optional<std::string> input = {};  ///< standard input, once it was read
};

/// The text that is read instead of a pattern, if there is one.
std::optional<SharedWork> text_instead(const LiveTexts& texts, const std::string& name, bool is_first,
                                       const SharedWork* link) {
    SharedWork work = link ? *link : SharedWork();
    if (is_first && texts.changes.text) {
        work.name = pattern_message_address;
        work.text = *texts.changes.text;
        check_text(work, pattern_message_address, "");
        return work;
    }
    if (name != "-" || !texts.input) return std::nullopt;
    work.name = name;
    work.text = *texts.input;
    return work;
}

/// Sets keys by messages; the options of these keys no longer count. @throws UsageError if one names a file
void set_keys(const std::map<std::string, std::string>& values, Document& document, OptionValues& options) {
    std::vector<Setting> settings;
    for (const auto& [key, value] : values) {
        settings.push_back(Setting::assignment(set_message_address, key, value));
    }
    if (!settings.empty()) document = document.with(settings);
    for (const Key& key : document.pattern().keys) {
        if (key.value.source->setting() != set_message_address) continue;
        if (names_file(key)) refuse_key(key, set_message_address, "");
        std::erase_if(options, [&](const OptionValue& option) { return option.name == key.name; });
    }
}

/// @param live  null for files
Parts read_parts(const PlayCommand& command, const OptionValues& given, bool quiet, LiveTexts* live = nullptr) {
    Parts parts;
    parts.values = given;
    std::vector<Document>& documents = parts.documents;
    for (const std::string& given_name : command.patterns) {
        const std::size_t name_end = end_of_name(given_name);
        const std::string name = given_name.substr(0, name_end);
        PatternOptions one = command.pattern;
        one.pattern = name;
        if (is_arrangement(name)) throw UsageError(name + ": an arrangement is played alone");
        std::vector<Setting> own;
        if (name_end < given_name.size()) {
            own = part_settings(given_name, std::string_view(given_name).substr(name_end + 1));
        }
        for (const Setting& setting : own) {
            if (setting.key == "variant") one.variant = setting.value;
        }
        const auto link = read_link_argument(name);
        const SharedWork* work = link ? &*link : nullptr;
        if (const auto instead = live ? text_instead(*live, name, documents.empty(), work) : std::nullopt) {
            PatternOptions trusting = one;  // the text was checked, or is that of the user
            trusting.trusts_link = true;
            documents.push_back(load(trusting, &*instead, quiet));
        } else {
            documents.push_back(load(one, work, quiet));
            if (live && name == "-") live->input = documents.back().source().text();
        }
        for (const Setting& setting : own) {
            if (setting.key == "variant") continue;
            try {
                documents.back() = documents.back().with({setting});
            } catch (const PatternError& error) {
                throw UsageError(
                    fmt::format("{}: {}: {}", given_name, setting.key, error.diagnostics().front().message));
            }
        }
        if (work) {
            check_options_of_link(scores().options(), work->play, given, one);
            const Assignment assigned = blaming_link(work->play, given, [&] {
                return assign(scores(), documents.back(), options_with(work->play, given, one));
            });
            documents.back() = assigned.document;
            if (documents.size() == 1) parts.values = assigned.options;
        }
        if (documents.size() == 1) {
            add_seed(one, parts.values);
            if (work) parts.shared = work->play;
            if (live) set_keys(live->changes.values, documents.back(), parts.values);
        }
    }
    return parts;
}

/// The files that the command reads: patterns, and an arrangement with its patterns.
std::vector<std::filesystem::path> files_of(const PlayCommand& command) {
    if (is_arrangement(command.patterns.front())) return files_of_arrangement(command.patterns.front());
    std::vector<std::filesystem::path> files;
    for (const std::string& given : command.patterns) {
        const std::string name = given.substr(0, end_of_name(given));
        try {
            if (name != "-" && !is_link(name)) files.push_back(find_pattern(name).path);
        } catch (const NotFound&) {
            // An editor may be about to write it.
        }
    }
    return files;
}

void play_to_port(const PlayCommand& command, const OptionValues& given, bool quiet) {
    const bool has_arrangement = is_arrangement(command.patterns.front());
    if (has_arrangement) check_arrangement(command, given);
    LiveScore score;
    LiveTexts texts;
    score.files = [&] { return files_of(command); };
    score.open = [&, has_arrangement](const LiveChanges& changes, const Monitor& monitor) {
        if (has_arrangement) {
            if (changes.text || !changes.values.empty()) {
                throw UsageError("messages change patterns; arrangements change with their files");
            }
            try {
                const auto [arrangement, folder] = read_arrangement_argument(command.patterns.front());
                return stream_notes(arrangement, given, monitor, folder);
            } catch (const FileError& error) {
                throw UsageError(error.what());
            }
        }
        texts.changes = changes;
        const Parts parts = read_parts(command, given, quiet, &texts);
        return blaming_link(parts.shared, given,
                            [&] { return stream_notes(parts.documents, parts.values, monitor); });
    };
    play_live(command.live, score, quiet);
}

void run(const PlayCommand& command, bool quiet) {
    const std::string format = command.output.empty() ? "mid" : score_format_of(command.output);
    OptionValues given = command.options.values();
    const bool to_port = is_live(command.live, command.output);
    if (!command.pattern.seed.empty()) seed_of(command.pattern);  // throws if it is not a number
    // Before the patterns are read.
    if (!is_link(command.patterns.front())) scores().check(format, given);
    if (is_arrangement(command.patterns.front())) add_seed(command.pattern, given);
    if (to_port) return play_to_port(command, given, quiet);
    if (is_arrangement(command.patterns.front())) return play_arrangement(command, format, given, quiet);
    const Parts parts = read_parts(command, given, quiet);
    blaming_link(parts.shared, given, [&] {
        if (!command.output.empty())
            return make(*plan_score(parts.documents, format, parts.values), command.output, quiet);
        Progress progress(quiet);
        fmt::print("{}", describe_score(parts.documents, parts.values, progress.monitor()));
    });
}

}  // namespace

void add_play(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("play", "Play a curve: MIDI, printed scores, sound, a page that plays");
    auto options = std::make_shared<PlayCommand>();
    command
        ->add_option(
            "PATTERN", options->patterns,
            "pattern files, names of bundled patterns, studio links, or -; several become parts of one score, each "
            "perhaps with keys of its own: hilbert@transposition=-12,start=4; or an arrangement (.toml)")
        ->required();
    add_override_options(*command, options->pattern);
    command
        ->add_option(
            "-o,--output", options->output,
            fmt::format("output file: {}; without it, notes, bars, time and range are reported", all_extensions()))
        ->type_name("FILE");
    add_live_options(*command, options->live);
    options->options.add(*command, scores().options());
    command->footer(
        "Each horizontal run of the curve is a note: its height determines the pitch in the scale, its length the "
        "duration. With `--mapping symbols` a table in the pattern states what single symbols sound: "
        "`note A: C4 1/8`, `chord B: C4 E4 G4`, `drum k: bass drum`. A studio link sets values and, if it is the "
        "first pattern, options; options on the command line replace them.\n\n"
        "Examples:\n"
        "  sikku play hilbert -o hilbert.mid\n"
        "  sikku play hilbert-in-c --canon \"2 -12, 4 -24\" -o canon.mid\n"
        "  sikku play piece.toml -o piece.mid\n"
        "  sikku play hilbert --port FLUID --repeat\n"
        "  sikku play hilbert --port osc://localhost:57120,listen=9001 --repeat\n"
        "  sikku play dragon --mapping counterpoint --scale blues -o dragon.html\n"
        "  sikku play hilbert -n 40 --anchor piece --from-bar 1000000000 --bars 16 -o piece.musicxml");
    command->callback([options, &quiet] { run(*options, quiet); });
}

}  // namespace sikku
