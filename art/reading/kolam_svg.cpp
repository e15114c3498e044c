#include "art/reading/kolam_svg.h"

#include "art/reading/kolam_lines.h"
#include "art/reading/svg_attributes.h"
#include "art/reading/svg_path.h"
#include "art/reading/svg_style.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <pugixml.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_points = 20'000'000;

/// Properties that an element inherits from those around it.
struct Inherited {
    Transform transform;
    bool is_filled = true;
    bool is_stroked = false;
};

class SvgReader {
public:
    SvgReader(pugi::xml_node root, const Monitor& monitor) : monitor_(monitor), style_(root, monitor) {}

    void visit(pugi::xml_node node, Inherited around, int level) {
        if (level > most_svg_levels) throw std::runtime_error("elements are nested too deeply");
        monitor_.check();
        const std::string_view name = local_name(node.name());
        for (const char* hidden : {"defs", "clipPath", "mask", "symbol", "pattern", "marker", "metadata"}) {
            if (name == hidden) return;
        }
        if (style_.property(node, "display") == "none") return;
        if (const std::string fill = style_.property(node, "fill"); !fill.empty()) {
            around.is_filled = fill != "none" && fill != "transparent";
        }
        if (const std::string stroke = style_.property(node, "stroke"); !stroke.empty()) {
            around.is_stroked = stroke != "none" && stroke != "transparent";
        }
        around.transform = around.transform * parse_transform(node.attribute("transform").value());
        if (name == "path") {
            for (FlatPath& path : flatten_path(node.attribute("d").value(), most_points - points_)) {
                add(std::move(path), around);
            }
        } else if (name == "polygon" || name == "polyline") {
            add(path_of_points(numbers_of(node.attribute("points").value()), name == "polygon"), around);
        } else if (name == "circle" || name == "ellipse") {
            ellipse(node, around);
        } else if (name == "use") {
            ++copies;
        }
        for (const pugi::xml_node child : node.children()) {
            if (child.type() == pugi::node_element) visit(child, around, level + 1);
        }
    }

    std::vector<ClosedLine> lines;
    std::vector<glm::dvec2> dots;
    std::size_t open = 0;
    std::size_t copies = 0;  ///< `use` elements, which are not read

    std::size_t unread_rules() const { return style_.unread(); }

private:
    static double number(pugi::xml_node node, const char* name) {
        std::string_view text = node.attribute(name).value();
        while (!text.empty() && ((text.back() >= 'a' && text.back() <= 'z') || text.back() == '%'))
            text.remove_suffix(1);
        const auto numbers = numbers_of(text);
        return numbers.empty() ? 0 : numbers[0];
    }
    void ellipse(pugi::xml_node node, const Inherited& around) {
        const glm::dvec2 centre(number(node, "cx"), number(node, "cy"));
        if (around.is_filled) {
            if (dots.size() >= DotGrid::most_dots) throw std::runtime_error("too many dots");
            dots.push_back(around.transform(centre));
            return;
        }
        const bool is_circle = node.attribute("r");
        const glm::dvec2 radii(number(node, is_circle ? "r" : "rx"), number(node, is_circle ? "r" : "ry"));
        FlatPath ring{{}, true};
        for (int i = 0; i < 24; ++i) {
            const double angle = i * std::numbers::pi / 12;
            ring.points.push_back(centre + radii * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        add(std::move(ring), around);
    }
    void add(FlatPath path, const Inherited& around) {
        if (!around.is_stroked && around.is_filled && !path.is_closed) return;
        if (path.points.size() < 3) return;
        if (!path.is_closed) {
            // An end that nearly meets the beginning is one that a program rounded.
            double length = 0;
            for (std::size_t i = 1; i < path.points.size(); ++i) {
                length += glm::distance(path.points[i - 1], path.points[i]);
            }
            if (glm::distance(path.points.front(), path.points.back()) > 0.02 * length) {
                ++open;
                return;
            }
        }
        points_ += path.points.size();
        if (points_ > most_points) throw std::runtime_error("too many points");
        for (glm::dvec2& point : path.points) {
            point = around.transform(point);
            if (!(std::fabs(point.x) < 1e9 && std::fabs(point.y) < 1e9))
                throw std::runtime_error("a coordinate is too large");
        }
        lines.push_back(std::move(path.points));
    }

    const Monitor& monitor_;
    SvgStyle style_;
    std::size_t points_ = 0;
};

}  // namespace

ReadKolam read_kolam_svg(std::string_view text, std::optional<DotLattice> lattice, const Monitor& monitor) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed) {
        throw std::runtime_error(fmt::format("damaged XML at byte {}: {}", parsed.offset + 1, parsed.description()));
    }
    SvgReader reader(document.document_element(), monitor);
    reader.visit(document.document_element(), {}, 0);
    if (reader.lines.empty()) {
        throw std::runtime_error(
            reader.open > 0 ? fmt::format("the SVG has no closed lines, only {}", counted(reader.open, "open line"))
                            : std::string("the SVG has no paths, polygons or polylines"));
    }
    ReadKolam kolam = kolam_of_lines(reader.lines, std::move(reader.dots), true, lattice, monitor);
    if (reader.open > 0) kolam.notes.push_back(fmt::format("{} left out", counted(reader.open, "open line")));
    if (reader.copies > 0) {
        kolam.notes.push_back(fmt::format("{} left out: only original lines and dots are read",
                                          counted(reader.copies, "copied element")));
    }
    if (reader.unread_rules() > 0) {
        kolam.notes.push_back(fmt::format("{} not read: only simple selectors are supported",
                                          counted(reader.unread_rules(), "style rule")));
    }
    const pugi::xml_node title = document.document_element().child("title");
    kolam.title = printable(title.text().get(), 200);
    return kolam;
}

}  // namespace sikku
