#include "art/sheet/sheet_pages.h"

#include "art/sheet/sheet_maker.h"
#include "art/vector/pdf.h"
#include "art/writer/press_inks.h"
#include "engine/base/output.h"
#include "engine/base/threads.h"

#include <memory>
#include <utility>

namespace sikku {
namespace {

using Makers = std::vector<std::unique_ptr<SheetMaker>>;

Print print_of(const SheetOptions& document) {
    Print print;
    static_cast<WriterOptions&>(print) = document;
    print.title = document.title;
    print.made = document.made;
    print.style.ground.reset();
    return print;
}

/// Lays out the sheets of a page. Their texts are added to `missing` if the font lacks characters of them.
Makers arranged(const SheetPage& page, std::string& missing) {
    Makers makers;
    for (const PlacedSheet& sheet : page) {
        SheetMaker& maker = *makers.emplace_back(std::make_unique<SheetMaker>(sheet.cells, sheet.options));
        maker.arrange();
        maker.move(sheet.at);
        if (missing.empty()) missing = maker.missing();
    }
    return makers;
}

}  // namespace

std::string draw_pages(const std::vector<SheetPage>& pages, const SheetOptions& given,
                       const std::filesystem::path& file, Destination& destination) {
    SheetOptions document = given;
    load_inks(document.press, document.format);
    const Print print = print_of(document);
    const auto output = destination.open(file);
    const auto writer = write_pdf_pages(print, *output);
    std::string missing;
    on_threads(document.threads, [&] {
        Makers shown;  // the writer refers to the sheets of a page until the next one begins
        for (const SheetPage& page : pages) {
            Makers makers = arranged(page, missing);
            writer->begin_page(print, {0.0, 0.0, print.page.width, print.page.height}, glm::dvec2(0.0), 1.0);
            shown = std::move(makers);
            for (const auto& maker : shown) maker->write_parts(*writer);
            document.monitor.advance(1);
        }
        writer->finish();
    });
    output->commit();
    return missing;
}

}  // namespace sikku
