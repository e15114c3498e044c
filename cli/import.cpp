// cli/import.cpp: `sikku import`: imports systems of other programs as pattern files.
#include "engine/import/import.h"

#include "cli/command.h"
#include "engine/base/input_file.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "engine/language/foreign_text.h"
#include "engine/language/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

namespace sikku {
namespace {

struct ImportOptions {
    std::string file;
    std::vector<std::string> names;
    std::string output;
    std::string view;
    bool list = false;
};

SourcePointer read_source(const std::string& file) {
    std::error_code error;
    if (file != "-" && !std::filesystem::exists(file, error)) {
        throw UsageError(file + ": No such file or directory");
    }
    NamedText text = read_pattern_text(file);
    return std::make_shared<const Source>(std::move(text.name), std::move(text.text));
}

/// The view file that was named, or that beside a cpfg file.
SourcePointer view_of(const ImportOptions& options) {
    if (!options.view.empty()) return read_source(options.view);
    const std::filesystem::path beside = options.file == "-" ? "" : view_file_beside(options.file);
    return beside.empty() ? nullptr : read_source(beside.string());
}

/// The systems that the command line names, in the order of the file; all if it names none.
std::vector<std::size_t> chosen(const std::vector<ImportedSystem>& systems, const ImportOptions& options) {
    std::vector<std::size_t> indices;
    std::set<std::string> wanted;
    for (const std::string& name : options.names) wanted.insert(lower_case(name));
    std::vector<std::string_view> known;
    std::set<std::string> found;
    for (std::size_t i = 0; i < systems.size(); ++i) {
        known.push_back(systems[i].name);
        if (!wanted.empty() && !wanted.contains(lower_case(systems[i].name))) continue;
        found.insert(lower_case(systems[i].name));
        indices.push_back(i);
    }
    for (const std::string& name : options.names) {
        if (found.contains(lower_case(name))) continue;
        const std::string_view near = nearest(name, known);
        throw UsageError(
            fmt::format("{} contains no system '{}'{}", options.file, name,
                        near.empty() ? "; --list lists its systems" : fmt::format("; did you mean '{}'?", near)));
    }
    return indices;
}

void list_systems(const std::vector<ImportedSystem>& systems, const std::vector<std::size_t>& indices) {
    for (const std::size_t i : indices) {
        const ImportedSystem& system = systems[i];
        fmt::print("{:<24} line {:<6} {}\n", printable(system.name), system.line,
                   system.pattern.empty() ? "has errors"
                   : !system.draws        ? "draws nothing"
                   : system.losses.empty()
                       ? "complete"
                       : fmt::format("{} not supported", counted(system.losses.size(), "feature")));
    }
}

/// Writes each system to a file of its name; a number is added to names in use. @throws std::runtime_error for a file
/// that is there with other contents, which may be an edited pattern
void write_folder(const std::vector<ImportedSystem>& systems, const std::vector<std::size_t>& indices,
                  const std::string& folder, bool quiet) {
    std::filesystem::create_directories(folder);
    std::set<std::string> taken;
    OutputFiles files;
    std::size_t written = 0;
    std::size_t lossy = 0;
    std::size_t empty = 0;
    for (const std::size_t i : indices) {
        const ImportedSystem& system = systems[i];
        if (system.pattern.empty()) continue;
        if (interrupted()) throw Interrupted("interrupted");
        const std::string plain = import_file_name(system.name);
        std::string name = plain;
        for (int number = 2; !taken.insert(name).second; ++number) name = fmt::format("{}-{}", plain, number);
        if (name != plain) {
            tell_unless(quiet, "sikku: {}.lsys already exists: '{}' on line {} becomes {}.lsys\n", plain,
                        printable(system.name), system.line, name);
        }
        const std::filesystem::path file = std::filesystem::path(folder) / (name + ".lsys");
        std::error_code error;
        if (std::filesystem::exists(file, error) &&
            read_file(file, file.string(), most_pattern_bytes, stop_monitor()) != system.pattern) {
            throw std::runtime_error(
                fmt::format("{}: this file has other contents; remove it, or choose another folder",
                            printable(file.string(), 2000)));
        }
        files.add(file, system.pattern);
        ++written;
        if (!system.losses.empty()) ++lossy;
        if (!system.draws) ++empty;
    }
    files.commit();
    std::string note = lossy > 0 ? fmt::format(", {} of them incomplete", lossy) : "";
    if (empty > 0) note += fmt::format("; {} draw{} nothing", empty, empty == 1 ? "s" : "");
    tell_unless(quiet, "sikku: {} in {}{}\n", counted(written, "pattern"), printable(folder, 2000), note);
}

/// True if the message concerns one of the selected systems. Messages before the first system concern all.
bool concerns(const Diagnostic& diagnostic, const SourcePointer& file, const std::vector<ImportedSystem>& systems,
              const std::vector<std::size_t>& indices) {
    if (indices.size() == systems.size() || diagnostic.file != printable(file->name())) return true;
    const auto after = std::upper_bound(systems.begin(), systems.end(), diagnostic.where.line,
                                        [](int line, const ImportedSystem& system) { return line < system.line; });
    if (after == systems.begin()) return true;
    return std::binary_search(indices.begin(), indices.end(), static_cast<std::size_t>(after - systems.begin()) - 1);
}

void import_file(const ImportOptions& options, bool quiet) {
    keep_input("-o", options.output, options.file);
    const SourcePointer file = read_source(options.file);
    const auto format = import_format(file->text());
    if (!format) {
        const ForeignKind kind = foreign_kind(file->text());
        if (kind == ForeignKind::lpfg || kind == ForeignKind::lpy) {
            throw UsageError(fmt::format("{}: this is {}; only files of cpfg and Fractint can be imported",
                                         options.file, foreign_kind_name(kind)));
        }
        throw UsageError(
            fmt::format("{} is neither a cpfg file, which has a line 'Lsystem:', nor a Fractint collection, "
                        "which has entries 'NAME {{'",
                        options.file));
    }
    if (*format != ImportFormat::cpfg && !options.view.empty()) {
        throw UsageError("--view-file: a Fractint collection has no view file");
    }
    Diagnostics diagnostics;
    const SourcePointer view = *format == ImportFormat::cpfg ? view_of(options) : nullptr;
    const std::vector<ImportedSystem> systems =
        *format == ImportFormat::cpfg ? import_cpfg(file, view, diagnostics) : import_fractint(file, diagnostics);
    if (systems.empty()) diagnostics.throw_if_errors();
    const std::vector<std::size_t> indices = chosen(systems, options);
    if (options.list) return list_systems(systems, indices);
    const bool to_folder = !options.output.empty() && !options.output.ends_with(".lsys");
    if (!to_folder && indices.size() != 1) {
        throw UsageError(fmt::format("{} contains {}: name one of them, or give a folder with -o; --list lists them",
                                     options.file, counted(systems.size(), "system")));
    }
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        if (!concerns(diagnostic, file, systems, indices)) continue;
        if (diagnostic.warning) {
            tell_unless(quiet, "{}\n", diagnostic.text());
        } else {
            tell("{}\n", diagnostic.text());
        }
    }
    const ImportedSystem& first = systems[indices.front()];
    if (to_folder) {
        write_folder(systems, indices, options.output, quiet);
    } else if (!first.pattern.empty()) {
        write_file(options.output, first.pattern);
    }
    if (!to_folder && !first.pattern.empty() && !first.draws) {
        tell_unless(quiet, "sikku: warning: the pattern draws nothing at its derivation length{}\n",
                    first.losses.empty() ? "" : "; what is not supported may be the cause");
    }
    const bool all_good =
        std::none_of(indices.begin(), indices.end(), [&](std::size_t i) { return systems[i].pattern.empty(); });
    if (!all_good) throw CLI::RuntimeError(2);
}

}  // namespace

void add_import(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("import", "Convert cpfg and Fractint L-systems into pattern files");
    auto options = std::make_shared<ImportOptions>();
    command->add_option("FILE", options->file, "cpfg file, Fractint collection, or - for standard input")->required();
    command->add_option("NAMES", options->names, "entries of a collection (all)");
    command
        ->add_option("-o,--output", options->output,
                     "folder, or a file NAME.lsys for a single system (standard output)")
        ->type_name("PATH");
    command->add_option("--view-file", options->view, "view file of a cpfg file, for the angle (NAME.v beside it)")
        ->type_name("FILE");
    command->add_flag("--list", options->list, "list the entries of the file");
    command->footer(
        "Unsupported features are reported with their place, and in the description of the pattern.\n\n"
        "Examples:\n"
        "  sikku import fractint.l -o imported\n"
        "  sikku import fractint.l Dragon | sikku draw - -n 10 -o dragon.svg\n"
        "  sikku import plant.l --view-file plant.v -o plant.lsys");
    command->callback([options, &quiet] { import_file(*options, quiet); });
}

}  // namespace sikku
