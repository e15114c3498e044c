// cli/patterns.cpp: `sikku patterns`, `sikku show`, `sikku check`: lists, shows and checks pattern files.
#include "art/provenance/provenance.h"
#include "cli/arrangement_argument.h"
#include "cli/command.h"
#include "cli/link_argument.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/check.h"
#include "engine/language/arrangement_library.h"
#include "music/scale/scale.h"
#include "music/score/midi_texts.h"
#include "music/scores.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace sikku {
namespace {

/// Prints rows of three columns, each as wide as its longest entry.
void print_rows(const std::vector<std::array<std::string, 3>>& rows) {
    const auto width = [&](std::size_t column) {
        std::size_t widest = 0;
        for (const auto& row : rows) {
            const auto is_start = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0U) != 0x80U; };
            widest = std::max(
                widest, static_cast<std::size_t>(std::count_if(row[column].begin(), row[column].end(), is_start)));
        }
        return widest;
    };
    const std::size_t names = width(0), titles = width(1);
    for (const auto& row : rows) {
        fmt::print("  {:<{}}  {:<{}}{}{}\n", row[0], names, row[1], row[2].empty() ? 0 : titles,
                   row[2].empty() ? "" : "  ", row[2]);
    }
}

void list_patterns(const std::string& kind, bool names_only, bool quiet) {
    std::string last;
    bool any = false;
    const auto& patterns = PatternLibrary::bundled().patterns();
    std::vector<std::array<std::string, 3>> rows;  // rows of one kind
    for (const LibraryPattern& known : patterns) {
        if (!kind.empty() && known.kind != kind) continue;
        any = true;
        if (names_only) {
            fmt::print("{}\n", printable(known.name));
            continue;
        }
        if (known.kind != last) {
            print_rows(rows);
            rows.clear();
            fmt::print("{}{}\n", last.empty() ? "" : "\n", printable(known.kind));
        }
        last = known.kind;
        std::string text;
        try {
            text = read_pattern_text(known.file.string()).text;
        } catch (const UsageError& error) {
            tell_unless(quiet, "sikku: warning: {}\n", printable(error.what()));
        }
        Diagnostics diagnostics;
        const Pattern pattern = parse_pattern(known.name, std::move(text), diagnostics);
        rows.push_back({printable(known.name), printable(pattern.text("title")), printable(pattern.text("source"))});
    }
    print_rows(rows);
    if (any) return;
    std::set<std::string_view> kinds;
    for (const LibraryPattern& known : patterns) kinds.insert(known.kind);
    if (kinds.empty()) throw UsageError(missing_patterns());
    kinds.insert("arrangements");
    const std::string_view near = nearest(kind, {kinds.begin(), kinds.end()});
    throw UsageError(fmt::format("unknown kind of patterns '{}'; {}", kind,
                                 near.empty() ? fmt::format("there are: {}", fmt::join(kinds, ", "))
                                              : fmt::format("did you mean '{}'?", near)));
}

void show(const std::string& what, bool quiet) {
    if (const auto link = read_link_argument(what)) {
        std::fwrite(link->text.data(), 1, link->text.size(), stdout);
        const std::string values = describe_settings(*link);
        if (!values.empty() && !quiet) tell("the link sets {}\n", printable(values, std::string::npos));
        return;
    }
    if (lower_case(what).ends_with(".mtl")) {
        throw UsageError(fmt::format("{}: the pattern is in the .obj file beside this one", what));
    }
    std::optional<Provenance> found = read_provenance(what);
    if (!found) {
        if (auto texts = read_midi_file_texts(what)) found = {std::move(texts->pattern), std::move(texts->made)};
    }
    if (found) {
        std::fwrite(found->pattern.data(), 1, found->pattern.size(), stdout);
        if (!found->made.empty() && !quiet) tell("made with {}\n", printable(found->made, std::string::npos));
        return;
    }
    if (is_arrangement(what)) {
        const std::string text = read_arrangement_argument(what).arrangement.text;
        std::fwrite(text.data(), 1, text.size(), stdout);
        return;
    }
    NamedText text = read_pattern_text(what);
    if (text.text.empty()) throw std::runtime_error(fmt::format("{}: this file is empty", text.name));
    if (text.text.size() > most_pattern_bytes) throw UsageError(what + ": a pattern file is at most 64 MB");
    Diagnostics diagnostics;
    const auto source = read_source(std::move(text.name), std::move(text.text), diagnostics);
    if (diagnostics.is_unreadable()) diagnostics.throw_if_errors();
    if (!what.ends_with(".lsys") && !states_axiom(source->cleaned())) {
        throw std::runtime_error(fmt::format("{}: this text is not a pattern: it has no axiom", what));
    }
    std::fwrite(source->text().data(), 1, source->text().size(), stdout);
}

/// True if the arrangement and its patterns are free of errors, and can be played together.
bool check_arrangement(const std::string& file) {
    try {
        const auto [arrangement, folder] = read_arrangement_argument(file);
        plan_score(arrangement, "mid", {}, folder);
        return true;
    } catch (const FileError& error) {
        fmt::print("{}\n", error.what());
    } catch (const PatternError& error) {
        for (const Diagnostic& diagnostic : error.diagnostics()) fmt::print("{}\n", diagnostic.text());
    } catch (const ScoreError& error) {
        fmt::print("{}: {}\n", file, error.what());
    }
    return false;
}

/// Adds the bundled arrangements to the list. Returns false if the kind is another.
bool list_arrangements(const std::string& kind, bool names_only) {
    if (!kind.empty() && kind != "arrangements") return false;
    std::vector<std::array<std::string, 3>> rows;
    const std::vector<std::string> names = bundled_arrangements();
    if (names.empty()) throw UsageError(missing_patterns());
    for (const std::string& name : names) {
        if (names_only) {
            fmt::print("{}\n", name);
            continue;
        }
        const Arrangement arrangement = read_arrangement_argument(name).arrangement;
        rows.push_back({name, printable(arrangement.title), printable(arrangement.source)});
    }
    if (!names_only) {
        fmt::print("{}arrangements\n", kind.empty() ? "\n" : "");
        print_rows(rows);
    }
    return true;
}

/// True if the file is free of errors.
bool check_scale_file(const std::string& file) {
    const NamedText text = read_pattern_text(file);
    const Source source(text.name, text.text);
    Diagnostics diagnostics;
    if (lower_case(file).ends_with(".scl")) {
        read_scl(source, diagnostics);
    } else {
        read_kbm(source, diagnostics);
    }
    for (const Diagnostic& diagnostic : diagnostics.sorted()) fmt::print("{}\n", diagnostic.text());
    return !diagnostics.has_errors();
}

constexpr std::size_t most_shown_errors = 50;  // errors of a pattern, as Diagnostics keep them

/// The format that is planned to read the files that keys of an interpreter name.
const char* format_to_check(const Interpreter& interpreter) {
    return interpreter.owner() == KeyOwner::music ? "mid" : "svg";
}

/// True if the files and patterns that keys name, such as Scala files and borders, can be read.
bool check_files(const Document& document) {
    const std::vector<Key>& keys = document.pattern().keys;
    bool good = true;
    for (const Interpreter* interpreter : interpreters()) {
        const bool has_files = std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
            const KeyInfo* row = find_language_key(key.name);
            return row && row->owner == interpreter->owner() && (names_file(key) || row->name == "border");
        });
        if (!has_files) continue;
        try {
            interpreter->plan(document, format_to_check(*interpreter), {});
        } catch (const PatternError& error) {
            for (const Diagnostic& diagnostic : error.diagnostics()) fmt::print("{}\n", diagnostic.text());
            good = false;
        } catch (const SettingError& error) {
            fmt::print("{}: {}\n", document.source().name(), error.what());
            good = false;
        }
    }
    return good;
}

/// The same with each variant, up to the first in which a file cannot be read.
bool check_files_of_variants(const NamedText& text) {
    const Document plain = parse(text.name, text.text);
    const std::vector<Variant>& variants = plain.pattern().variants;
    return check_files(plain) && std::all_of(variants.begin(), variants.end(), [&](const Variant& variant) {
               return check_files(parse(text.name, text.text, {std::string(variant.name.view()), {}}));
           });
}

/// True if the file is free of errors.
bool check(const std::string& file) {
    NamedText text = read_pattern_text(file);
    const NamedText copy = text;
    if (const std::string foreign = foreign_message(file, text); !foreign.empty()) {
        fmt::print("{}\n", foreign);
        return false;
    }
    std::size_t errors = 0;
    for (const Diagnostic& diagnostic :
         check_pattern(std::move(text.name), std::move(text.text), interpreters(), stop_monitor())) {
        fmt::print("{}\n", diagnostic.text());
        if (!diagnostic.warning) ++errors;
    }
    if (errors >= most_shown_errors) fmt::print("{}: the first {} errors are shown\n", file, errors);
    return errors == 0 && check_files_of_variants(copy);
}

}  // namespace

void add_patterns(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("patterns", "List the bundled patterns");
    auto kind = std::make_shared<std::string>();
    auto names_only = std::make_shared<bool>(false);
    command->add_option(
        "KIND", *kind, "kolams, kolam-library, tilings, curves, plants, maps, words, melodies or arrangements (all)");
    command->add_flag("--names", *names_only, "print names only, one in each line");
    command->footer("Examples:\n  sikku patterns\n  sikku patterns kolams");
    command->callback([kind, names_only, &quiet] {
        if (*kind != "arrangements") list_patterns(*kind, *names_only, quiet);
        list_arrangements(*kind, *names_only);
    });
}

void add_show(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand(
        "show", "Print the text of a pattern, or of the pattern that a print or score was made from");
    auto what = std::make_shared<std::string>();
    command
        ->add_option(
            "PATTERN", *what,
            "bundled pattern, pattern file, studio link, -, or a print or score made by sikku, except sound files")
        ->required();
    command->footer("Examples:\n  sikku show snake-kolam > my.lsys\n  sikku show print.png");
    command->callback([what, &quiet] { show(*what, quiet); });
}

void add_check(CLI::App& app, bool& /*quiet*/) {
    auto* command = app.add_subcommand(
        "check", "Report every error of patterns, arrangements, Scala and MIDI files, with its place");
    auto files = std::make_shared<std::vector<std::string>>();
    command
        ->add_option(
            "FILE", *files,
            "pattern files, bundled patterns, studio links, -, arrangements (.toml), scales (.scl), key maps (.kbm) "
            "or MIDI files")
        ->required();
    command->footer(
        "Exits with 0 and prints at most warnings if the files have no errors. Errors in MIDI files exit with 1, "
        "other errors with 2.\n\n"
        "Examples:\n  sikku check my.lsys patterns/*/*.lsys");
    command->callback([files] {
        bool good = true;
        bool is_score_good = true;
        for (const std::string& file : *files) {
            const std::string name = lower_case(file);
            if (is_arrangement(file)) {
                good = check_arrangement(file) && good;
            } else if (name.ends_with(".scl") || name.ends_with(".kbm")) {
                good = check_scale_file(file) && good;
            } else if (name.ends_with(".mid") || name.ends_with(".midi") || is_midi_file(file)) {
                is_score_good = check_midi_file(file) && is_score_good;
            } else {
                good = check(file) && good;
            }
        }
        if (!good) throw CLI::RuntimeError(2);
        if (!is_score_good) throw CLI::RuntimeError(1);
    });
}

}  // namespace sikku
