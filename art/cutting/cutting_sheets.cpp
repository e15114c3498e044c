#include "art/cutting/cutting_sheets.h"

#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"
#include "engine/geometry/lettering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

std::string percent(double share) {
    return fmt::format("{:.1f} %", 100 * share);
}

/// Area of the finished pieces as part of all sheets.
double finished(const CuttingPlan& plan, const CuttingOptions& options) {
    double area = 0;
    for (const CutKind& kind : plan.kinds) area += kind.area * static_cast<double>(kind.pieces);
    return area / (options.sheet.width * options.sheet.height * static_cast<double>(plan.sheet_count));
}

/// The kinds of pieces on a sheet and how many of each: `A × 28, B × 4`.
std::string piece_counts(const CuttingPlan& plan, const CuttingSheet& sheet) {
    std::string text;
    for (const auto& [kind, count] : sheet.counts) {
        text += fmt::format("{}{} × {}", text.empty() ? "" : ", ", plan.kinds[kind].name, count);
    }
    return text;
}

/// The description of a sheet, in its upper margin; empty if that is too narrow.
std::vector<PieceSheet::Heading> headings(const std::string& title, const CuttingPlan& plan, std::size_t index,
                                          const std::string& material, const Page& page) {
    constexpr double least_margin = 4, most_height = 3.5;
    if (page.margin < least_margin) return {};
    const CuttingSheet& sheet = plan.sheets[index];
    std::string text = title.empty() ? "" : title + " · ";
    text += fmt::format("colour {} · sheet {} of {}", material, index + 1, plan.sheets.size());
    if (sheet.copies > 1) text += fmt::format(", cut {} times", sheet.copies);
    text += fmt::format(" · {} · {} in use", piece_counts(plan, sheet), percent(sheet.in_use));
    const double height = std::min(most_height, page.margin / 2.5);
    const double inset = std::max(page.margin, height);
    const glm::dvec2 start(inset, page.height - (page.margin + height) / 2);
    return {{shortened(text, height, page.width - 2 * inset), {start, height}}};
}

}  // namespace

std::string cutting_text(const std::string& title, const CuttingOptions& options, const CuttingPlan& plan,
                         const std::vector<std::string>& materials, const std::vector<std::string>& files) {
    std::string text = fmt::format("{}, sheets of {:g} x {:g} mm\n", title.empty() ? "(untitled)" : printable(title),
                                   options.sheet.width, options.sheet.height);
    text += fmt::format("{:<24} {:>6}  {:<14}  {:>7} {:>10}  pieces\n", "file", "sheets", "colour", "in use",
                        "length mm");
    for (std::size_t i = 0; i < plan.sheets.size(); ++i) {
        const CuttingSheet& sheet = plan.sheets[i];
        text += fmt::format("{:<24} {:>6}  {:<14}  {:>7} {:>10.0f}  {}\n", printable(files[i]), sheet.copies,
                            printable(materials[i]), percent(sheet.in_use), std::ceil(sheet.length),
                            piece_counts(plan, sheet));
    }
    text += fmt::format("{}, {} in use", counted(plan.sheet_count, "sheet"), percent(plan.in_use));
    const double net = finished(plan, options);
    if (plan.in_use - net > 5e-4) text += fmt::format(", {} without allowances", percent(net));
    return text + "\n";
}

std::string cutting_json(const std::string& title, const CuttingOptions& options, const CuttingPlan& plan,
                         const std::vector<std::string>& materials, const std::vector<std::string>& files) {
    std::vector<JsonText> sheets;
    for (std::size_t i = 0; i < plan.sheets.size(); ++i) {
        const CuttingSheet& sheet = plan.sheets[i];
        std::vector<std::pair<std::string, std::uint64_t>> pieces;
        for (const auto& [kind, count] : sheet.counts) pieces.emplace_back(plan.kinds[kind].name, count);
        sheets.push_back(JsonText::object("file", files[i], "sheets", sheet.copies, "colour", sheet.colour,
                                          "material", materials[i], "in_use", sheet.in_use, "length", sheet.length,
                                          "pieces", JsonText::object_of(pieces)));
    }
    return JsonText::object("title", title, "width", options.sheet.width, "height", options.sheet.height, "margin",
                            options.sheet.margin, "seam", options.seam, "kerf", options.kerf, "gap", options.gap,
                            "sheets", plan.sheet_count, "in_use", plan.in_use, "finished", finished(plan, options),
                            "list", sheets)
        .line();
}

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
