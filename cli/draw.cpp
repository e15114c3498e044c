// cli/draw.cpp: `sikku draw`: a print.
#include "cli/draw.h"

#include "engine/forecast.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>

namespace sikku {
namespace {

double length(const char* option, const std::string& text, double dpi) {
    const auto value = parse_length(text, dpi);
    if (!value || !std::isfinite(*value)) {
        throw UsageError(
            fmt::format("{} {}: expected a length such as 5mm, 1.5cm, 2in, 12pt or 300px", option, text));
    }
    return *value;
}

Page page_of(const DrawSettings& options) {
    const auto size = parse_size(options.size, options.dpi);
    if (!size) {
        throw UsageError(
            fmt::format("--size {}: expected A0 to A6, letter, legal, tabloid, or WIDTHxHEIGHT such as "
                        "300x300mm",
                        options.size));
    }
    Page page{size->x, size->y, length("--margin", options.margin, options.dpi)};
    if (options.landscape && page.height > page.width) std::swap(page.width, page.height);
    constexpr double most = 10'000;  // millimetres: wider than any press or plotter
    if (!(page.width >= 1 && page.height >= 1 && page.width <= most && page.height <= most)) {
        throw UsageError(fmt::format("--size {}: a page is between 1 mm and 10 m wide and high", options.size));
    }
    if (page.margin < 0) throw UsageError(fmt::format("--margin {}: a margin is 0 or more", options.margin));
    if (!(2 * page.margin < std::min(page.width, page.height))) {
        throw UsageError(fmt::format("--margin {}: the margins leave nothing of a page of {:g} x {:g} mm",
                                     options.margin, page.width, page.height));
    }
    return page;
}

std::string made_with(const DrawSettings& options, const Grammar& grammar) {
    std::string text = fmt::format("sikku {}, -n {}", SIKKU_VERSION, grammar.steps());
    if (options.window) text += " --window " + *options.window;
    if (!options.pattern.variant.empty()) text += " --variant " + options.pattern.variant;
    for (const std::string& setting : options.pattern.settings) text += fmt::format(" --set '{}'", setting);
    return text;
}

}  // namespace

PlannedPrint plan_print(const DrawSettings& options) {
    const auto format = print_format(options.output);
    if (!format) {
        std::error_code error;
        if (std::filesystem::is_directory(options.output, error)) {
            throw UsageError(fmt::format("-o {}: this is a folder; a print is a file such as {}", options.output,
                                         (std::filesystem::path(options.output) / "print.svg").string()));
        }
        throw UsageError(
            fmt::format("-o {}: unknown extension; a print is .svg, .pdf, .png, .tif, .jpg or .exr", options.output));
    }
    if (!(options.dpi >= 1 && options.dpi <= 10'000)) throw UsageError("--dpi: between 1 and 10000");
    if (!std::isfinite(options.rotate)) throw UsageError("--rotate: expected degrees");
    PlannedPrint planned;
    Print& print = planned.print;
    DrawOptions& drawing = planned.drawing;
    print.page = page_of(options);
    print.dpi = options.dpi;
    const bool pixels = *format != PrintFormat::svg && *format != PrintFormat::pdf;
    if (pixels && std::max(print.page.width, print.page.height) * options.dpi / 25.4 > 200'000) {
        throw UsageError(
            "the picture would be over 200,000 pixels wide or high: a smaller --size or --dpi is needed");
    }
    drawing.format = *format;
    drawing.placement.rotate = options.rotate;
    drawing.placement.mirror = options.mirror;
    if (options.step) {
        drawing.placement.step = length("--step", *options.step, options.dpi);
        if (!(*drawing.placement.step > 0 && *drawing.placement.step <= 10'000)) {
            throw UsageError(fmt::format("--step {}: a step is above 0 and at most 10 m long", *options.step));
        }
    }
    if (options.window) {
        drawing.window = parse_window(*options.window);
        if (!drawing.window) {
            throw UsageError(
                fmt::format("--window {}: expected X0,Y0,X1,Y1 in turtle steps, numbers of any length, X0 below X1 "
                            "and Y0 below Y1",
                            *options.window));
        }
    }
    drawing.threads = options.threads;
    drawing.budget = options.budget;
    drawing.compression = options.compression;
    return planned;
}

void draw_print(const DrawSettings& options, const Telling& telling) {
    auto [print, drawing] = plan_print(options);
    LoadedPattern loaded = load(options.pattern, telling);
    Diagnostics diagnostics;
    print.style = read_style(loaded.pattern, options.dpi, diagnostics);
    diagnostics.throw_if_errors();
    print.title = loaded.pattern.text("title");
    print.pattern = loaded.pattern.source->text();
    print.made = made_with(options, loaded.grammar);
    // Contexts are resolved before it is known how much there is to draw.
    std::optional<Progress> progress;
    if (telling.watch) {
        drawing.watch = telling.watch;
    } else {
        progress.emplace(0, telling.quiet);
        drawing.begin = [&](int passes) {
            progress.emplace(passes * expected_symbols(loaded.grammar, true), telling.quiet);
        };
        drawing.watch = [&](std::uint64_t symbols) { progress->add(symbols); };
    }
    const Page page = print.page;
    const DrawReport report = draw(loaded.grammar, std::move(print), drawing, options.output);
    progress.reset();
    if (report.leaves_pattern_out) {
        telling.say(
            "sikku: warning: {} does not hold the text of the pattern, which is over 60,000 bytes: `sikku "
            "show` cannot give it back\n",
            options.output);
    }
    if (report.overflows) {
        telling.say(
            "sikku: warning: the drawing is {:.1f} x {:.1f} mm, the page has room for {:.1f} x {:.1f}: what lies "
            "outside is cut off\n",
            report.size.x, report.size.y, page.width - 2 * page.margin, page.height - 2 * page.margin);
    }
}

void add_draw(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("draw", "Draw a print: SVG, PDF, PNG, TIFF, JPEG or EXR");
    auto options = std::make_shared<DrawSettings>();
    add_pattern_options(*command, options->pattern);
    command->add_option("-o,--output", options->output, "The file; its extension says which kind")->required();
    command
        ->add_option("--size", options->size, "A0 to A6, letter, legal, tabloid, or WIDTHxHEIGHT such as 300x300mm")
        ->capture_default_str();
    command->add_flag("--landscape", options->landscape, "The page lies on its side");
    command->add_option("--margin", options->margin, "On all four sides")->capture_default_str();
    auto* fit = command->add_flag("--fit", options->fit, "Fill the page within its margins (default)");
    command->add_option("--step", options->step, "Length of one turtle step on paper, instead of --fit")
        ->excludes(fit);
    command
        ->add_option("--window", options->window,
                     "The part X0,Y0,X1,Y1 of the drawing, in turtle steps, fills the page; of lines in one "
                     "pen, at any derivation length")
        ->type_name("X0,Y0,X1,Y1")
        ->excludes(fit);
    command->add_option("--rotate", options->rotate, "Degrees anticlockwise")->capture_default_str();
    command->add_flag("--mirror", options->mirror, "Left and right exchanged, before --rotate");
    command->add_option("--dpi", options->dpi, "Pixels an inch of pictures, and of px in lengths")
        ->capture_default_str();
    command->add_option("--compression", options->compression, "Of PNG: 1, quick and large, to 9")
        ->check(CLI::Range(1, 9))
        ->capture_default_str();
    add_budget_option(*command, options->budget);
    command->add_option("-j,--jobs", options->threads, "Threads for pictures; 0: one for each core")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str();
    command->footer(
        "Lengths are in mm, cm, in, pt or px. The file appears whole or not at all.\n\n"
        "Examples:\n"
        "  sikku draw snake-kolam -o snake.svg\n"
        "  sikku draw anklets-of-krishna -n 6 --size A1 --landscape -o anklets.pdf\n"
        "  sikku draw hilbert -n 60 --window 0,0,200,200 -o corner.svg\n"
        "  sikku draw my.lsys --step 5mm --set 'stroke=0.7mm navy' -o my.png --dpi 600");
    command->callback([options, &quiet] { draw_print(*options, {.quiet = quiet, .listener = {}, .watch = {}}); });
}

}  // namespace sikku
