#include "art/tile_templates.h"

#include "art/plotter/dxf.h"
#include "art/print/lettering.h"
#include "art/vector/pdf.h"
#include "art/vector/svg.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_templates = 1'000;
constexpr std::size_t most_corners = 2'000;
constexpr double least_width = 190;  // of a row, in millimetres
constexpr double longest_side = 10'000;
constexpr double gap = 6;  // between templates
constexpr double dash = 3, dash_gap = 2;
constexpr int cut_colour = 0, seam_colour = 1, label_colour = 2;

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Do two sides have a point in common?
bool meet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
    const double first = cross(b - a, c - a), second = cross(b - a, d - a);
    const double third = cross(d - c, a - c), fourth = cross(d - c, b - c);
    return ((first > 0) != (second > 0)) && ((third > 0) != (fourth > 0));
}

bool crosses_itself(const std::vector<glm::dvec2>& outline) {
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = i + 2; k < count; ++k) {
            if (i == 0 && k + 1 == count) continue;
            if (meet(outline[i], outline[i + 1], outline[k], outline[(k + 1) % count])) return true;
        }
    }
    return false;
}

struct Template {
    std::uint32_t shape = 0;
    bool is_reflected = false;
    std::vector<glm::dvec2> cut, seam;  ///< millimetres
    std::string label;
    glm::dvec2 low{0.0}, high{0.0};
    glm::dvec2 at{0.0};  ///< where `low` lies on the page, y up
};

double distance_to_side(glm::dvec2 point, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = to - from;
    const double part = std::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(point, from + along * part);
}

bool contains(const std::vector<glm::dvec2>& outline, glm::dvec2 point) {
    bool inside = false;
    for (std::size_t i = 0, k = outline.size() - 1; i < outline.size(); k = i++) {
        const glm::dvec2 a = outline[i], b = outline[k];
        if ((a.y > point.y) != (b.y > point.y) && point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x) {
            inside = !inside;
        }
    }
    return inside;
}

/// A point far from all sides, on a grid, and its distance from them.
std::pair<glm::dvec2, double> roomiest(const std::vector<glm::dvec2>& outline, glm::dvec2 low, glm::dvec2 high) {
    constexpr int cells = 32;
    std::pair<glm::dvec2, double> best{(low + high) / 2.0, 0.0};
    for (int y = 1; y < cells; ++y) {
        for (int x = 1; x < cells; ++x) {
            const glm::dvec2 point = low + (high - low) * glm::dvec2(x, y) / static_cast<double>(cells);
            if (!contains(outline, point)) continue;
            double distance = std::numeric_limits<double>::max();
            for (std::size_t i = 0; i < outline.size(); ++i) {
                distance = std::min(distance, distance_to_side(point, outline[i], outline[(i + 1) % outline.size()]));
            }
            if (distance > best.second * (1 + 1e-9)) best = {point, distance};
        }
    }
    return best;
}

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
        if (kind.corners.size() > most_corners) {
            throw std::runtime_error(fmt::format("piece {} has {} corners; a template has at most {}", kind.name,
                                                 kind.corners.size(), most_corners));
        }
        Template& made = templates.emplace_back();
        made.shape = kind.shape;
        made.is_reflected = kind.is_reflected;
        made.label = label;
        made.seam = kind.corners;
        try {
            made.cut = offset_outline(kind.corners, options.seam + options.kerf / 2);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fmt::format("piece {}: {}", kind.name, error.what()));
        }
        made.low = made.high = made.cut.front();
        for (const glm::dvec2 corner : made.cut) {
            made.low = glm::dvec2(std::min(made.low.x, corner.x), std::min(made.low.y, corner.y));
            made.high = glm::dvec2(std::max(made.high.x, corner.x), std::max(made.high.y, corner.y));
        }
    }
    return templates;
}

/// Places templates in rows from top to bottom. Returns the size of the page.
glm::dvec2 arrange(std::vector<Template>& templates, double margin) {
    double width = least_width;
    for (const Template& each : templates) width = std::max(width, each.high.x - each.low.x);
    glm::dvec2 at(0.0);
    double row = 0;
    for (Template& each : templates) {
        const glm::dvec2 size = each.high - each.low;
        if (at.x > 0 && at.x + size.x > width) {
            at = {0, at.y + row + gap};
            row = 0;
        }
        each.at = {margin + at.x, at.y + size.y};  // from the top, for now
        at.x += size.x + gap;
        row = std::max(row, size.y);
    }
    double used = 0;
    for (const Template& each : templates) used = std::max(used, each.at.x + each.high.x - each.low.x);
    const glm::dvec2 page(used + margin, at.y + row + 2 * margin);
    if (!(page.x <= longest_side && page.y <= longest_side)) {
        throw std::runtime_error("the templates need a page of more than 10 m; choose a shorter step");
    }
    for (Template& each : templates) each.at.y = page.y - margin - each.at.y;
    return page;
}

void draw_closed(const std::vector<glm::dvec2>& outline, glm::dvec2 offset, int colour, PathSink& sink) {
    std::vector<glm::dvec2> ends;
    for (std::size_t i = 1; i <= outline.size(); ++i) ends.push_back(outline[i % outline.size()] + offset);
    sink.begin_stroke(outline.front() + offset, Pen{.colour = colour});
    sink.lines(ends);
    sink.end_stroke(true);
}

/// Each side begins and ends with a dash.
void draw_dashed(const std::vector<glm::dvec2>& outline, glm::dvec2 offset, PathSink& sink) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
        const double length = glm::distance(from, to);
        const double gaps = std::max(0.0, std::round((length - dash) / (dash + dash_gap)));
        const double scale = length / (dash + gaps * (dash + dash_gap));
        for (double k = 0; k <= gaps; ++k) {
            const glm::dvec2 along = (to - from) / length * scale;
            const glm::dvec2 end = from + along * (k * (dash + dash_gap) + dash) + offset;
            sink.begin_stroke(from + along * (k * (dash + dash_gap)) + offset, Pen{.colour = seam_colour});
            sink.lines({&end, 1});
            sink.end_stroke(false);
        }
    }
}

void draw(const std::vector<Template>& templates, const TemplateOptions& options, PathSink& sink) {
    for (const Template& each : templates) draw_closed(each.cut, each.at - each.low, cut_colour, sink);
    for (const Template& each : templates) {
        if (options.seam > 0) draw_dashed(each.seam, each.at - each.low, sink);
    }
    for (const Template& each : templates) {
        const auto [middle, room] = roomiest(each.seam, each.low, each.high);
        // Within a circle of that room, with a little left free.
        const double width = text_width(each.label, 1);
        const double height = std::min(5.0, 1.7 * room / std::hypot(width, 1 + letter_descent));
        const glm::dvec2 start = middle + each.at - each.low - glm::dvec2(width * height / 2, height / 2);
        write_text(each.label, start, height, Pen{.width = 0.7, .colour = label_colour}, sink);
    }
}

}  // namespace

std::vector<glm::dvec2> offset_outline(std::span<const glm::dvec2> corners, double distance) {
    if (!(distance > 0)) return {corners.begin(), corners.end()};
    std::vector<glm::dvec2> outline;
    std::vector<std::pair<std::size_t, std::size_t>> of_corner;  // first and last point of each
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2 at = corners[i];
        const glm::dvec2 before = glm::normalize(at - corners[(i + count - 1) % count]);
        const glm::dvec2 after = glm::normalize(corners[(i + 1) % count] - at);
        const glm::dvec2 first(before.y, -before.x), second(after.y, -after.x);
        const double cosine = glm::dot(first, second);
        of_corner.emplace_back(outline.size(), 0);
        // The mitre is longer than twice the distance at angles below 60 degrees. At 60, no side without length.
        if (cross(before, after) > 0 && cosine < -0.5 - 1e-9) {
            const glm::dvec2 tip = glm::normalize(before - after);
            const double beyond = distance * (2 - glm::dot(first, tip)) / glm::dot(before, tip);
            outline.push_back(at + first * distance + before * beyond);
            outline.push_back(at + second * distance - after * beyond);
        } else {
            outline.push_back(at + (first + second) * (distance / (1 + cosine)));
        }
        of_corner.back().second = outline.size() - 1;
    }
    bool fits = true;  // each side keeps its direction
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = (i + 1) % count;
        const glm::dvec2 side = outline[of_corner[next].first] - outline[of_corner[i].second];
        fits = fits && glm::dot(side, corners[next] - corners[i]) > 0;
    }
    if (!fits || crosses_itself(outline)) {
        throw std::runtime_error(
            fmt::format("an allowance of {} mm does not fit into the notches of its outline", distance));
    }
    return outline;
}

void write_templates(const std::vector<CutKind>& kinds, const TemplateOptions& options, PrintFormat format,
                     const std::filesystem::path& file, Destination& destination) {
    if (kinds.empty()) throw std::runtime_error("nothing to draw: the pattern has no tiles");
    std::vector<Template> templates = make_templates(kinds, options);
    Print print;
    print.page.margin = 10;
    const glm::dvec2 page = arrange(templates, print.page.margin);
    print.page.width = page.x;
    print.page.height = page.y;
    // Millimetres from the bottom left corner become those from the top left corner.
    print.placement.to_page = glm::dmat3x2(1, 0, 0, -1, 0, page.y);
    print.style.stroke.value = 0.25;
    print.style.palette = {{0, 0, 0, 255}, {0, 0, 255, 255}, {255, 0, 0, 255}};
    print.style.cut_layers = {{cut_colour, "CUT"}, {seam_colour, "SEAM"}, {label_colour, "LABEL"}};
    print.layer_names = {{cut_colour, "cut"}, {seam_colour, "seam"}, {label_colour, "label"}};
    print.title = options.title;
    print.pattern = options.pattern;
    print.made = fmt::format("sikku {}, templates", SIKKU_VERSION);
    const auto output = destination.open(file);
    if (format == PrintFormat::dxf) {
        const auto writer = write_dxf(print, *output);
        writer->number_pens(
            std::vector<Pen>{{.colour = cut_colour}, {.colour = seam_colour}, {.colour = label_colour}});
        draw(templates, options, *writer);
        writer->finish();
    } else {
        const auto writer = format == PrintFormat::svg ? write_svg(print, *output) : write_pdf(print, *output);
        draw(templates, options, *writer);
        writer->finish();
    }
    output->commit();
}

}  // namespace sikku
