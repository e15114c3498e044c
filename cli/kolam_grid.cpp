// cli/kolam_grid.cpp: `sikku kolam --grid`.
#include "cli/kolam_grid.h"

#include "art/kolam/dot_grid_enumeration.h"
#include "art/kolam/dot_grid_pattern.h"
#include "cli/command.h"
#include "cli/mistakes.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace sikku {
namespace {

/// What goes wrong with the value of an option is the caller's mistake.
template <typename Work>
auto of_option(const char* option, Work&& work) {
    try {
        return work();
    } catch (const UsageError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw UsageError(fmt::format("{}: {}", option, error.what()));
    }
}

void write(const std::string& output, const std::string& text) {
    if (output.empty()) {
        fmt::print("{}", text);
        return;
    }
    write_file(output, text);
}

/// A kolam and how it came about.
struct MadeKolam {
    Crossings crossings;
    std::size_t changed = 0;
    int attempt = 1;
};

MadeKolam make_kolam(const KolamGridOptions& options, const DotGrid& grid, const RandomKolam& random) {
    if (options.crossings) {
        MadeKolam made;
        made.crossings = of_option("--crossings", [&] {
            const std::string& text = *options.crossings;
            return parse_crossings(grid, text.starts_with('@') ? read_pattern_text(text.substr(1)).text : text);
        });
        if (options.single_line) made.changed = make_single_line(grid, made.crossings, options.seed, stop_monitor());
        return made;
    }
    if (!options.single_line) return {random_crossings(grid, random)};
    if (const auto obstacle = single_line_obstacle(grid, random.symmetry)) throw std::runtime_error(*obstacle);
    auto found = find_single_line(grid, random, options.attempts, stop_monitor());
    if (!found) {
        throw std::runtime_error(fmt::format(
            "no single line with the symmetry {} was found in {}: another --seed or --density may find one, or more "
            "--attempts; on a small grid --enumerate shows whether there is one",
            grid_symmetry_name(random.symmetry), counted(options.attempts, "attempt")));
    }
    return {std::move(found->crossings), found->changed, found->attempt};
}

/// The second count, where it takes seconds at most.
std::optional<std::size_t> second_count(const DotGrid& grid, const Crossings& crossings) {
    const std::size_t longest = *std::max_element(grid.rows().begin(), grid.rows().end());
    const double width = static_cast<double>(std::min(grid.rows().size(), longest));
    if (static_cast<double>(grid.dots().size()) * width * width > 1e12) return std::nullopt;
    return laplacian_nullity(grid, crossings, stop_monitor());
}

void make_pattern(const KolamGridOptions& options, const DotGrid& grid, GridSymmetry symmetry, bool quiet) {
    if (options.as_json && options.output.empty()) {
        throw UsageError("--json: standard output is the pattern's; give its file with -o");
    }
    const std::string extension = std::filesystem::path(options.output).extension().string();
    for (const Interpreter* interpreter : interpreters()) {
        if (!extension.empty() && find_format(interpreter->formats(), extension.substr(1))) {
            throw UsageError(
                fmt::format("-o {}: a kolam is made as a pattern, NAME.lsys; `sikku {}` makes the file of it",
                            options.output, interpreter->owner() == KeyOwner::art ? "draw" : "play"));
        }
    }
    const RandomKolam random{options.seed, options.density.value_or(RandomKolam().density), symmetry};
    const MadeKolam made = make_kolam(options, grid, random);
    const std::string name = printable(grid.text(), 80);
    const auto crossed = std::count(made.crossings.begin(), made.crossings.end(), 1);
    const std::size_t lines = count_lines(grid, made.crossings, stop_monitor());
    const auto nullity = second_count(grid, made.crossings);
    if (nullity && *nullity != lines) {
        throw std::logic_error(fmt::format("{} by following them, but {} by the Laplacian", lines, *nullity));
    }

    KolamPatternOptions pattern;
    pattern.title = fmt::format("Kolam on {} dots", name);
    pattern.description = fmt::format("{}, {} of {} gaps crossed, {}", counted(grid.dots().size(), "dot"), crossed,
                                      grid.gaps().size(), counted(lines, "line"));
    if (!options.crossings) {
        pattern.description += fmt::format("; seed {}, density {}", random.seed, random.density);
        if (symmetry != GridSymmetry::none) {
            pattern.description += fmt::format(", symmetry {}", grid_symmetry_name(symmetry));
        }
    }
    pattern.coloured = options.colours;
    pattern.dot_symbols = options.dots;
    pattern.monitor = stop_monitor();
    write(options.output, kolam_pattern(grid, made.crossings, pattern).text);

    if (options.as_json) {
        fmt::print(
            "{{\"grid\": {}, \"dots\": {}, \"gaps\": {}, \"crossed\": {}, \"lines\": {}, \"laplacian_nullity\": {}, "
            "\"changed\": {}, \"attempt\": {}, \"crossings\": {}}}\n",
            json_string(grid.text()), grid.dots().size(), grid.gaps().size(), crossed, lines,
            nullity ? fmt::format("{}", *nullity) : "null", made.changed, made.attempt,
            json_string(crossings_text(grid, made.crossings)));
    } else {
        std::string note;
        if (options.single_line) note += fmt::format("; {} changed to join the lines", counted(made.changed, "gap"));
        if (made.attempt > 1) note += fmt::format(", attempt {}", made.attempt);
        tell_unless(quiet, "sikku: {}: {}{}\n", name, pattern.description, note);
    }
}

void enumerate(const KolamGridOptions& options, const DotGrid& grid, GridSymmetry symmetry) {
    EnumerationOptions enumeration;
    enumeration.symmetry = symmetry;
    enumeration.keep = options.limit;
    enumeration.threads = options.threads;
    enumeration.monitor = stop_monitor();
    const Enumeration found = of_option("--enumerate", [&] { return enumerate_single_lines(grid, enumeration); });
    std::string text =
        options.as_json ? enumeration_json(grid, symmetry, found) : enumeration_text(grid, symmetry, found);
    if (!options.as_json && found.kolams.size() < found.distinct && options.limit > 0) {
        text += fmt::format("and {} more (--limit)\n", found.distinct - found.kolams.size());
    }
    write(options.output, text);
}

}  // namespace

void add_kolam_grid_options(CLI::App& command, KolamGridOptions& options) {
    auto* grid =
        command
            .add_option("--grid", options.grid,
                        "make a kolam on this grid of dots: 7x7, or the number of dots in each row: 1-3-5-3-1")
            ->type_name("ROWS")
            ->group(grid_heading);
    auto* symmetry = command
                         .add_option("--symmetry", options.symmetry,
                                     "none, C2 (half turn), C4 (quarter turn), mirror-x (left and right), mirror-y "
                                     "(top and bottom), mirrors (both) or D4 (all); excludes --crossings (none)")
                         ->type_name("GROUP")
                         ->group(grid_heading)
                         ->needs(grid);
    auto* density =
        command.add_option("--density", options.density, "share of the gaps in which lines cross, 0 to 1 (0.7)")
            ->type_name("SHARE")
            ->check(number_between(0, 1))
            ->group(grid_heading)
            ->needs(grid);
    auto* crossings =
        command
            .add_option(
                "--crossings", options.crossings,
                "all, none, or a 0 or 1 for each gap: row by row from the top, first the gaps within the row, "
                "then the gaps to the next row; @FILE reads them from a file")
            ->type_name("GAPS")
            ->group(grid_heading)
            ->needs(grid)
            ->excludes(symmetry)
            ->excludes(density);
    auto* single =
        command
            .add_flag(
                "--single-line", options.single_line,
                "make a single line, changing as few gaps as possible; with C4 the grid needs a dot in its middle, "
                "with C2 or mirrors a dot or a gap; with D4 one dot at most on each diagonal")
            ->group(grid_heading)
            ->needs(grid);
    command
        .add_option("--attempts", options.attempts,
                    "attempts to find a single line with a symmetry, 1 to 1000000 (1000)")
        ->type_name("N")
        ->group(grid_heading)
        ->needs(single)
        ->check(whole_number(1, 1'000'000));
    auto* colours = command.add_flag("--colours", options.colours, "give each line its own colour")
                        ->needs(grid)
                        ->group(grid_heading);
    auto* dots =
        command.add_flag("--dots", options.dots, "draw the dots in the pattern")->needs(grid)->group(grid_heading);
    auto* enumerate = command
                          .add_flag("--enumerate", options.enumerate,
                                    "count and list all single-line kolams, with --symmetry only symmetric ones")
                          ->group(grid_heading)
                          ->needs(grid)
                          ->excludes(crossings)
                          ->excludes(density)
                          ->excludes(single)
                          ->excludes(colours)
                          ->excludes(dots);
    command
        .add_option("--limit", options.limit, "maximum number of kolams that --enumerate lists, up to 10000000 (100)")
        ->type_name("N")
        ->group(grid_heading)
        ->needs(enumerate)
        ->check(whole_number(0, 10'000'000));
}

void kolam_grid(const KolamGridOptions& options, bool quiet) {
    const DotGrid grid = of_option("--grid", [&] { return parse_dot_grid(options.grid); });
    const GridSymmetry symmetry = of_option("--symmetry", [&] {
        const GridSymmetry wanted = parse_grid_symmetry(options.symmetry);
        require_symmetry(grid, wanted);
        return wanted;
    });
    if (options.enumerate) {
        enumerate(options, grid, symmetry);
    } else {
        make_pattern(options, grid, symmetry, quiet);
    }
}

}  // namespace sikku
