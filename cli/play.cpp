// cli/play.cpp: `sikku play`: a curve as music.
#include "art/print/format.h"
#include "cli/command.h"
#include "cli/link_argument.h"
#include "cli/options.h"
#include "music/scores.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace sikku {
namespace {

struct PlayCommand {
    PatternOptions pattern;  ///< but for its name
    std::vector<std::string> patterns;
    std::string output;
    TableOptions options;
};

/// The name of the format with the file's extension. @throws UsageError
std::string format_of(const std::string& output) {
    const std::string extension = std::filesystem::path(output).extension().string();
    const FormatName* format = find_format(scores().formats(), extension.substr(extension.empty() ? 0 : 1));
    if (format) return std::string(format->extension);
    if (print_format(output)) {
        throw UsageError(fmt::format(
            "-o {}: this is a print; `sikku draw` draws the curve; for a printed score write .ly and run lilypond",
            output));
    }
    throw UsageError(
        fmt::format("-o {}: {}; a score is .mid, .musicxml or .ly; sound is .wav or .flac; .svg and .html show it",
                    output, extension.empty() ? "no extension" : "unknown extension"));
}

void make_score(const PlayCommand& command, const std::string& format, const std::vector<Document>& documents,
                const OptionValues& values, bool quiet) {
    if (command.output.empty()) {
        Progress progress(quiet);
        fmt::print("{}", describe_score(documents, values, progress.monitor()));
        return;
    }
    const auto work = plan_score(documents, format, values);
    make(*work, command.output, quiet);
}

/// Uses the seed of the pattern for the options of the score, too. Those of a link have it already: see assign().
void add_seed(const PatternOptions& options, OptionValues& values) {
    if (options.seed.empty() || has_option(values, "seed")) return;
    values.push_back({"seed", std::to_string(seed_of(options))});
}

void run(const PlayCommand& command, bool quiet) {
    const std::string format = command.output.empty() ? "mid" : format_of(command.output);
    const OptionValues given = command.options.values();
    if (!command.pattern.seed.empty()) seed_of(command.pattern);            // throws if it is not a number
    if (!is_link(command.patterns.front())) scores().check(format, given);  // before the patterns are read
    OptionValues shared;  // options of the link, if the first pattern is one
    OptionValues values = given;
    std::vector<Document> documents;
    for (const std::string& name : command.patterns) {
        PatternOptions one = command.pattern;
        one.pattern = name;
        const auto link = read_link_argument(name);
        const SharedWork* work = link ? &*link : nullptr;
        documents.push_back(load(one, work, quiet));
        if (work) {
            const Assignment assigned = blaming_link(work->play, given, [&] {
                return assign(scores(), documents.back(), options_with(work->play, given, one));
            });
            documents.back() = assigned.document;
            if (documents.size() == 1) values = assigned.options;
        }
        if (documents.size() == 1) {
            add_seed(one, values);
            if (work) shared = work->play;
        }
    }
    blaming_link(shared, given, [&] { make_score(command, format, documents, values, quiet); });
}

}  // namespace

void add_play(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("play", "Play a curve: MIDI, MusicXML, LilyPond, sound, a page that plays");
    auto options = std::make_shared<PlayCommand>();
    command
        ->add_option(
            "PATTERN", options->patterns,
            "pattern files, names of bundled patterns, studio links, or -; several become parts of one score")
        ->required();
    add_override_options(*command, options->pattern);
    command
        ->add_option(
            "-o,--output", options->output,
            "output file: .mid, .musicxml, .ly, .wav, .flac, .svg or .html; without it, notes, bars, time and "
            "range are reported")
        ->type_name("FILE");
    options->options.add(*command, scores().options());
    command->footer(
        "Each horizontal run of the curve is a note: its height determines the pitch in the scale, its length the "
        "duration. A studio link sets values and, if it is the first pattern, options; options on the command "
        "line replace them.\n\n"
        "Examples:\n"
        "  sikku play hilbert -o hilbert.mid\n"
        "  sikku play dragon --mapping counterpoint --scale blues -o dragon.html\n"
        "  sikku play hilbert -n 40 --anchor piece --from-bar 1000000000 --bars 16 -o piece.musicxml");
    command->callback([options, &quiet] { run(*options, quiet); });
}

}  // namespace sikku
