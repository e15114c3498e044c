#include "art/cutting/cutting_plan.h"
#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"

#include <fmt/format.h>

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

}  // namespace

std::string piece_counts(const CuttingPlan& plan, const CuttingSheet& sheet) {
    std::string text;
    for (const auto& [kind, count] : sheet.counts) {
        text += fmt::format("{}{} × {}", text.empty() ? "" : ", ", plan.kinds[kind].name, count);
    }
    return text;
}

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

}  // namespace sikku
