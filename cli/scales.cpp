// cli/scales.cpp: `sikku scales`: the bundled scales, and those in Scala files.
#include "music/scale/scale.h"
#include "music/score/scale_text.h"

#include "cli/command.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace sikku {
namespace {

Scale read_scale_file(const std::string& path) {
    if (std::error_code error; !std::filesystem::exists(path, error)) {
        throw UsageError(path + ": No such file or directory");
    }
    NamedText text = read_pattern_text(path);
    Diagnostics diagnostics;
    const Source source(std::move(text.name), std::move(text.text));
    std::optional<Scale> scale = read_scl(source, diagnostics);
    diagnostics.throw_if_errors();
    for (const Diagnostic& diagnostic : diagnostics.sorted()) tell("{}\n", diagnostic.text());
    return std::move(scale).value();
}

struct ScalesOptions {
    std::vector<std::string> words;
    std::string tonic = "C";
    bool as_json = false;
};

void show_scales(const ScalesOptions& options) {
    const auto tonic = parse_note(options.tonic);
    if (!tonic) throw UsageError(fmt::format("--tonic {}: expected a note such as C, F# or Eb", options.tonic));
    const auto show = [&](const Scale& scale) {
        fmt::print("{}", options.as_json ? "[" + scale_json(scale) + "]\n" : scale_text(scale, *tonic));
    };

    const std::string wanted = fmt::format("{}", fmt::join(options.words, " "));
    if (lower_case(wanted).ends_with(".scl")) return show(read_scale_file(wanted));
    // `pentatonic` is a scale elsewhere; here it is the group.
    std::vector<const Scale*> found = scales_of_group(wanted);
    if (!options.words.empty() && found.empty()) {
        if (const Scale* scale = find_scale(wanted)) return show(*scale);
    }
    if (found.empty()) found = search_scales(options.words);
    if (found.empty()) throw UsageError(unknown_scale(wanted));
    if (!options.as_json) {
        fmt::print("{}", scale_listing(found));
        return;
    }
    std::string text;
    for (const Scale* scale : found) text += (text.empty() ? "[" : ",\n ") + scale_json(*scale);
    fmt::print("{}]\n", text);
}

}  // namespace

void add_scales(CLI::App& app, bool& /*quiet*/) {
    auto* command = app.add_subcommand("scales", "List the bundled scales, or show one");
    auto options = std::make_shared<ScalesOptions>();
    command->add_option("WORDS", options->words, "scale, words to search for, or Scala file (.scl)");
    command->add_option("--tonic", options->tonic, "first note of the scale, which determines the names of notes")
        ->type_name("NOTE")
        ->capture_default_str();
    command->add_flag("--json", options->as_json, "print an array of JSON");
    command->footer(
        "Notes between the keys of a piano are named with their distance in cents: E-14.\n\n"
        "Examples:\n"
        "  sikku scales\n"
        "  sikku scales harmonic minor --tonic D\n"
        "  sikku scales mela 29\n"
        "  sikku scales pentatonic\n"
        "  sikku scales my-tuning.scl --json");
    command->callback([options] { show_scales(*options); });
}

}  // namespace sikku
