#include "art/cutting/tile_templates.h"

#include "art/cutting/cutting_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace sikku {
namespace {

constexpr std::size_t most_templates = 1'000;
constexpr double least_width = 190;  // width of a row, in millimetres
constexpr double longest_side = 10'000;
constexpr double template_gap = 6;  // between templates

struct Template {
    std::uint32_t shape = 0;
    bool is_reflected = false;
    std::vector<glm::dvec2> cut, seam;  ///< millimetres
    std::string label;
    Box box;
    glm::dvec2 at{0.0};  ///< place of the box's low corner on the page, y up
};

std::vector<Template> make_templates(const std::vector<CutKind>& kinds, const TemplateOptions& options) {
    std::vector<Template> templates;
    for (const CutKind& kind : kinds) {
        const auto same = [&](const Template& other) {
            return other.shape == kind.shape && other.is_reflected == kind.is_reflected;
        };
        const std::string label = fmt::format("{} × {}", kind.name, kind.pieces);
        if (const auto known = std::find_if(templates.begin(), templates.end(), same); known != templates.end()) {
            known->label += ", " + label;
            continue;
        }
        if (templates.size() == most_templates) {
            throw std::runtime_error(
                fmt::format("the tiling has more than {} shapes, the limit for templates", most_templates));
        }
        Template& made = templates.emplace_back();
        made.shape = kind.shape;
        made.is_reflected = kind.is_reflected;
        made.label = label;
        made.seam = kind.corners;
        made.cut = cut_outline(kind, options.seam + options.kerf / 2, "a template");
        made.box = box_of(made.cut);
    }
    return templates;
}

/// Places templates in rows from top to bottom. Returns the size of the page.
glm::dvec2 arrange(std::vector<Template>& templates, double margin) {
    double width = least_width;
    for (const Template& each : templates) width = std::max(width, each.box.high.x - each.box.low.x);
    glm::dvec2 at(0.0);
    double row = 0;
    for (Template& each : templates) {
        const glm::dvec2 size = each.box.high - each.box.low;
        if (at.x > 0 && at.x + size.x > width) {
            at = {0, at.y + row + template_gap};
            row = 0;
        }
        each.at = {margin + at.x, at.y + size.y};  // from the top, for now
        at.x += size.x + template_gap;
        row = std::max(row, size.y);
    }
    double used = 0;
    for (const Template& each : templates) used = std::max(used, each.at.x + each.box.high.x - each.box.low.x);
    const glm::dvec2 page(used + margin, at.y + row + 2 * margin);
    if (!(page.x <= longest_side && page.y <= longest_side)) {
        throw std::runtime_error("the templates need a page of more than 10 m; choose a shorter step");
    }
    for (Template& each : templates) each.at.y = page.y - margin - each.at.y;
    return page;
}

}  // namespace

std::vector<DrawReport> write_templates(const std::vector<CutKind>& kinds, const TemplateOptions& options,
                                        PieceWriting writing, const std::filesystem::path& file,
                                        Destination& destination) {
    if (kinds.empty()) throw std::runtime_error("nothing to draw: there are no tiles");
    std::vector<Template> templates = make_templates(kinds, options);
    PieceSheet sheet;
    sheet.page.margin = 10;
    const glm::dvec2 page = arrange(templates, sheet.page.margin);
    sheet.page.width = page.x;
    sheet.page.height = page.y;
    std::vector<PieceShape> shapes;
    for (const Template& each : templates) {
        constexpr double most_height = 5;
        sheet.pieces.push_back({shapes.size(), each.at - each.box.low});
        shapes.push_back({each.cut, options.seam > 0 ? each.seam : std::vector<glm::dvec2>{}, each.label,
                          label_place(each.label, each.seam, most_height)});
    }
    writing.made = fmt::format("sikku {}, templates", SIKKU_VERSION);
    return write_pieces(shapes, {sheet}, writing, file, destination);
}

}  // namespace sikku
