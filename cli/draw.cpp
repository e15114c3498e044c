// cli/draw.cpp: `sikku draw`: a print.
#include "art/print/format.h"
#include "art/prints.h"
#include "cli/command.h"
#include "cli/link_argument.h"
#include "cli/options.h"
#include "music/scores.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace sikku {
namespace {

struct DrawCommand {
    PatternOptions pattern;
    std::string output;
    TableOptions options;
};

/// The name of the format with the file's extension. @throws UsageError
std::string print_format_of(const std::string& output) {
    if (const auto format = print_format(output)) return std::string(info(*format).extension);
    std::error_code error;
    if (std::filesystem::is_directory(output, error)) {
        throw UsageError(fmt::format("-o {}: this is a folder; a print is a file such as {}", output,
                                     (std::filesystem::path(output) / "print.svg").string()));
    }
    const std::string extension = std::filesystem::path(output).extension().string();
    if (find_format(scores().formats(), extension.substr(extension.empty() ? 0 : 1))) {
        throw UsageError(fmt::format("-o {}: this is a score; `sikku play` writes it", output));
    }
    std::string known;
    for (const FormatInfo& row : print_formats()) {
        if (info(row.format).kind != FormatKind::model)
            known += fmt::format("{}.{}", known.empty() ? "" : ", ", row.extension);
    }
    throw UsageError(fmt::format("-o {}: {}; a print is {}, a model is .obj or .glb, a relief .stl, .obj or .glb",
                                 output, extension.empty() ? "no extension" : "unknown extension", known));
}

void run(const DrawCommand& command, bool quiet) {
    const std::string format = print_format_of(command.output);
    const OptionValues given = command.options.values();
    auto link = read_link_argument(command.pattern.pattern);
    if (link && has_option(given, "generations")) {
        // A single derivation length and a list of generations exclude each other.
        for (OptionValues* values : {&link->settings, &link->draw}) {
            std::erase_if(*values, [](const OptionValue& value) { return value.name == "derivation length"; });
        }
    }
    if (!link) prints().check(format, given);  // before the pattern is read
    Assignment assigned{load(command.pattern, link ? &*link : nullptr, quiet), given};
    const OptionValues shared = link ? link->draw : OptionValues();
    check_options_of_link(prints().options(), shared, given, command.pattern);
    const auto work = blaming_link(shared, given, [&] {
        if (link) assigned = assign(prints(), assigned.document, options_with(shared, given, command.pattern));
        return prints().plan(assigned.document, format, assigned.options);
    });
    make(*work, command.output, quiet);
}

}  // namespace

void add_draw(CLI::App& app, bool& quiet) {
    auto* command =
        app.add_subcommand("draw",
                           "Draw a print (SVG, PDF, PNG, TIFF, JPEG, EXR, GIF, HP-GL, G-code, DXF), a model "
                           "(OBJ, glTF) or a relief (STL, OBJ, glTF)");
    auto options = std::make_shared<DrawCommand>();
    add_pattern_options(*command, options->pattern);
    command->add_option("-o,--output", options->output, "output file; its extension selects the format")
        ->type_name("FILE")
        ->required();
    options->options.add(*command, prints().options());
    command->footer(
        "Lengths are in mm, cm, m, in, pt or px. The file appears whole or not at all. A studio link sets values "
        "and options; options on the command line replace them.\n\n"
        "Examples:\n"
        "  sikku draw snake-kolam -o snake.svg\n"
        "  sikku draw anklets-of-krishna -n 6 --size A1 --landscape -o anklets.pdf\n"
        "  sikku draw hilbert -n 60 --window -40,0,0,58 -o corner.svg\n"
        "  sikku draw snake-kolam --dots --border kaavi --animate -o snake.svg\n"
        "  sikku draw bush-3d --view 30,15,perspective -o bush.png\n"
        "  sikku draw bush-3d -o bush.glb\n"
        "  sikku draw penrose-rhombs -n 4 --relief 2mm,3mm --size 150x150mm -o tiles.stl\n"
        "  sikku draw bush-3d --generations 1:7 --size 100x100mm -o growth.gif\n"
        "  sikku draw spiral-tiling -o spiral.gcode --profile z\n"
        "  sikku draw snake-kolam --cmyk press.icc --bleed 3mm --marks -o press.pdf\n"
        "  sikku draw 'https://…/sikku-studio.html#sikku1.…' -o print.pdf\n"
        "  sikku draw my.lsys --step 5mm --stroke '0.7mm navy' -o my.png --dpi 600");
    command->callback([options, &quiet] { run(*options, quiet); });
}

}  // namespace sikku
