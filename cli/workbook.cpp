// cli/workbook.cpp: `sikku workbook`: lessons of several kolams for a class.
#include "art/workbook/workbook.h"
#include "cli/command.h"
#include "cli/options.h"
#include "cli/sheet_item.h"

#include <memory>
#include <string>
#include <vector>

namespace sikku {
namespace {

struct WorkbookCommand {
    std::vector<std::string> kolams;
    std::string output;
    PatternOptions pattern;
    TableOptions options;
};

void run_workbook(const WorkbookCommand& command, bool quiet) {
    if (!lower_case(command.output).ends_with(".pdf")) {
        throw UsageError(fmt::format("-o {}: expected a PDF such as class.pdf", command.output));
    }
    std::vector<SheetItem> items;
    for (const std::string& kolam : command.kolams) items.push_back(read_sheet_item(kolam, command.pattern, quiet));
    make(*plan_workbook(items, command.options.values()), command.output, quiet);
}

}  // namespace

void add_workbook(CLI::App& app, bool& quiet) {
    auto* command =
        app.add_subcommand("workbook", "Make a workbook of kolams for a class, from easy to hard, as PDF");
    auto options = std::make_shared<WorkbookCommand>();
    command
        ->add_option("KOLAM", options->kolams,
                     "pattern file, name of a bundled pattern or studio link; then, after @, its look: "
                     "snake-kolam@n=3,border=rope")
        ->required();
    command->add_option("-o,--output", options->output, "output file")->type_name("FILE")->required();
    add_trust_option(*command, options->pattern.trusts_link);
    options->options.add(*command, workbook_options());
    command->footer(
        "For each kolam: the whole with notes for the teacher, the steps of a lesson, the lines to trace, half of "
        "them, the dots alone, and a page to colour. The front page lists levels and pages. Drawings are on white "
        "paper.\n\n"
        "Examples:\n"
        "  sikku workbook kolam-5x5-7761ybtk snake-kolam@n=2 -o class.pdf\n"
        "  sikku workbook a.lsys b.lsys c.lsys --booklet --heading 'Class 3' -o booklet.pdf");
    command->callback([options, &quiet] { run_workbook(*options, quiet); });
}

}  // namespace sikku
