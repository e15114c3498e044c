#include "art/cutting/cutting_sheets.h"

#include "engine/geometry/lettering.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

/// The description of a sheet, in its upper margin; empty if that is too narrow.
std::vector<PieceSheet::Heading> headings(const std::string& title, const CuttingPlan& plan, std::size_t index,
                                          const std::string& material, const Page& page) {
    constexpr double least_margin = 4, most_height = 3.5;
    if (page.margin < least_margin) return {};
    const CuttingSheet& sheet = plan.sheets[index];
    std::string text = title.empty() ? "" : title + " · ";
    text += fmt::format("colour {} · sheet {} of {}", material, index + 1, plan.sheets.size());
    if (sheet.copies > 1) text += fmt::format(", cut {} times", sheet.copies);
    text += fmt::format(" · {} · {:.1f} % in use", piece_counts(plan, sheet), 100 * sheet.in_use);
    const double height = std::min(most_height, page.margin / 2.5);
    const double inset = std::max(page.margin, height);
    const glm::dvec2 start(inset, page.height - (page.margin + height) / 2);
    return {{shortened(text, height, page.width - 2 * inset), {start, height}}};
}

}  // namespace

std::vector<DrawReport> write_cutting_sheets(const CuttingPlan& plan, const CuttingOptions& options,
                                             const std::vector<std::string>& materials, bool labels,
                                             PieceWriting writing, const std::filesystem::path& file,
                                             Destination& destination) {
    std::vector<PieceShape> shapes;
    for (const PieceForm& form : plan.forms) {
        PieceShape& shape = shapes.emplace_back();
        shape.cut = form.cut;
        if (options.seam > 0) shape.seam = form.seam;
        shape.label = plan.kinds[form.kind].name;
        constexpr double most_height = 5;
        if (labels) shape.place = label_place(shape.label, form.seam, most_height);
    }
    std::vector<PieceSheet> sheets;
    for (std::size_t i = 0; i < plan.sheets.size(); ++i) {
        PieceSheet& sheet = sheets.emplace_back();
        sheet.page = options.sheet;
        for (const PlacedForm& piece : plan.sheets[i].pieces) sheet.pieces.push_back({piece.form, piece.at});
        if (labels) sheet.headings = headings(writing.title, plan, i, materials[i], options.sheet);
    }
    writing.made = fmt::format("sikku {}, cutting sheets", SIKKU_VERSION);
    writing.shares_cuts = options.gap == 0;
    return write_pieces(shapes, sheets, writing, file, destination);
}

}  // namespace sikku
