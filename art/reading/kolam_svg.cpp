#include "art/reading/kolam_svg.h"

#include "art/reading/kolam_lines.h"
#include "art/reading/svg_path.h"
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
constexpr int most_levels = 200;

/// A matrix of SVG: x' = a x + c y + e, y' = b x + d y + f.
struct Transform {
    double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
    glm::dvec2 operator()(glm::dvec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
    Transform operator*(const Transform& o) const {
        return {a * o.a + c * o.b, b * o.a + d * o.b,     a * o.c + c * o.d,
                b * o.c + d * o.d, a * o.e + c * o.f + e, b * o.e + d * o.f + f};
    }
};

std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    for (std::size_t at = 0; at < text.size();) {
        at = text.find_first_not_of(" \t\r\n,", at);
        if (at == std::string_view::npos) break;
        // A sign begins the next number, too.
        std::size_t end = at + 1;
        while (end < text.size() && std::string_view(" \t\r\n,").find(text[end]) == std::string_view::npos &&
               ((text[end] != '-' && text[end] != '+') || text[end - 1] == 'e' || text[end - 1] == 'E')) {
            ++end;
        }
        double number = 0;
        if (!read_number(text.substr(at, end - at), number) || !(std::fabs(number) < 1e12)) {
            throw std::runtime_error(fmt::format("'{}' is not a number", printable(text.substr(at, end - at), 40)));
        }
        numbers.push_back(number);
        at = end;
    }
    return numbers;
}

Transform parse_transform(std::string_view text) {
    Transform all;
    for (std::size_t at = text.find_first_not_of(" \t\r\n,"); at < text.size();) {
        const std::size_t open = text.find('(', at);
        const std::size_t close = text.find(')', at);
        if (open == std::string_view::npos || close == std::string_view::npos || close < open) {
            throw std::runtime_error(fmt::format("'{}': damaged transform", printable(text, 80)));
        }
        const std::string_view name = trimmed(text.substr(at, open - at));
        const auto n = numbers_of(text.substr(open + 1, close - open - 1));
        const auto radians = [&] { return n[0] * std::numbers::pi / 180; };
        Transform one;
        if (name == "matrix" && n.size() == 6) {
            one = {n[0], n[1], n[2], n[3], n[4], n[5]};
        } else if (name == "translate" && (n.size() == 1 || n.size() == 2)) {
            one = {1, 0, 0, 1, n[0], n.size() == 2 ? n[1] : 0};
        } else if (name == "scale" && (n.size() == 1 || n.size() == 2)) {
            one = {n[0], 0, 0, n.size() == 2 ? n[1] : n[0], 0, 0};
        } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
            one = {std::cos(radians()), std::sin(radians()), -std::sin(radians()), std::cos(radians()), 0, 0};
            if (n.size() == 3) one = Transform{1, 0, 0, 1, n[1], n[2]} * one * Transform{1, 0, 0, 1, -n[1], -n[2]};
        } else if (name == "skewX" && n.size() == 1) {
            one.c = std::tan(radians());
        } else if (name == "skewY" && n.size() == 1) {
            one.b = std::tan(radians());
        } else {
            throw std::runtime_error(fmt::format("'{}': unknown transform", printable(text, 80)));
        }
        all = all * one;
        at = text.find_first_not_of(" \t\r\n,", close + 1);
    }
    return all;
}

/// A property of an element, from its attribute or its style; empty if neither has it.
std::string property(pugi::xml_node node, const char* name) {
    const std::string style = node.attribute("style").value();
    for (std::size_t at = 0; at < style.size();) {
        const std::size_t end = std::min(style.find(';', at), style.size());
        const std::string_view part = std::string_view(style).substr(at, end - at);
        const std::size_t colon = part.find(':');
        if (colon != std::string_view::npos && trimmed(part.substr(0, colon)) == name) {
            return std::string(trimmed(part.substr(colon + 1)));
        }
        at = end + 1;
    }
    return node.attribute(name).value();
}

/// Properties that an element inherits from those around it.
struct Inherited {
    Transform transform;
    bool is_filled = true;
    bool is_stroked = false;
};

class SvgReader {
public:
    explicit SvgReader(const Monitor& monitor) : monitor_(monitor) {}

    void visit(pugi::xml_node node, Inherited around, int level) {
        if (level > most_levels) throw std::runtime_error("elements are nested too deeply");
        monitor_.check();
        const std::string_view full = node.name();
        const std::string_view name = full.substr(full.find(':') == std::string_view::npos ? 0 : full.find(':') + 1);
        for (const char* hidden : {"defs", "clipPath", "mask", "symbol", "pattern", "marker", "metadata"}) {
            if (name == hidden) return;
        }
        if (property(node, "display") == "none") return;
        if (const std::string fill = property(node, "fill"); !fill.empty()) {
            around.is_filled = fill != "none" && fill != "transparent";
        }
        if (const std::string stroke = property(node, "stroke"); !stroke.empty()) {
            around.is_stroked = stroke != "none" && stroke != "transparent";
        }
        around.transform = around.transform * parse_transform(node.attribute("transform").value());
        if (name == "path") {
            for (FlatPath& path : flatten_path(node.attribute("d").value(), most_points - points_)) {
                add(std::move(path), around);
            }
        } else if (name == "polygon" || name == "polyline") {
            const auto numbers = numbers_of(node.attribute("points").value());
            FlatPath path;
            for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
                path.points.emplace_back(numbers[i], numbers[i + 1]);
            path.is_closed =
                name == "polygon" || (path.points.size() > 2 && path.points.front() == path.points.back());
            if (path.points.size() > 2 && path.points.front() == path.points.back()) path.points.pop_back();
            add(std::move(path), around);
        } else if (name == "circle" || name == "ellipse") {
            ellipse(node, around);
        }
        for (const pugi::xml_node child : node.children()) {
            if (child.type() == pugi::node_element) visit(child, around, level + 1);
        }
    }

    std::vector<ClosedLine> lines;
    std::vector<glm::dvec2> dots;
    std::size_t open = 0;

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
    std::size_t points_ = 0;
};

}  // namespace

ReadKolam read_kolam_svg(std::string_view text, std::optional<DotLattice> lattice, const Monitor& monitor) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed) {
        throw std::runtime_error(fmt::format("damaged XML at byte {}: {}", parsed.offset + 1, parsed.description()));
    }
    SvgReader reader(monitor);
    reader.visit(document.document_element(), {}, 0);
    if (reader.lines.empty()) {
        throw std::runtime_error(
            reader.open > 0 ? fmt::format("the SVG has no closed lines, only {}", counted(reader.open, "open line"))
                            : std::string("the SVG has no paths, polygons or polylines"));
    }
    ReadKolam kolam = kolam_of_lines(reader.lines, std::move(reader.dots), true, lattice, monitor);
    if (reader.open > 0) kolam.notes.push_back(fmt::format("{} left out", counted(reader.open, "open line")));
    const pugi::xml_node title = document.document_element().child("title");
    kolam.title = printable(title.text().get(), 200);
    return kolam;
}

}  // namespace sikku
