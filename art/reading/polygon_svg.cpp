#include "art/reading/polygon_files.h"

#include "art/reading/svg_attributes.h"
#include "art/reading/svg_path.h"
#include "art/reading/svg_style.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/tiling/polygon_place.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_copied_levels = 50;
constexpr std::size_t most_copied_elements = 1'000'000;
constexpr std::size_t most_copied_bytes = std::size_t{64} << 20U;  // seconds

/// A number from 0 to 1, or a percentage. @return nullopt for other texts
std::optional<double> opacity_of(std::string_view text) {
    text = trimmed(text);
    const bool is_percentage = text.ends_with('%');
    if (is_percentage) text.remove_suffix(1);
    double value = 0;
    if (!read_number(trimmed(text), value)) return std::nullopt;
    return is_percentage ? value / 100 : value;
}

/// True for a colour that is not painted: none, transparent, or one whose alpha is 0.
bool is_clear(std::string_view colour) {
    colour = trimmed(colour);
    if (colour == "none" || colour == "transparent") return true;
    if (colour.starts_with('#')) {
        return (colour.size() == 5 && colour.ends_with('0')) || (colour.size() == 9 && colour.ends_with("00"));
    }
    const std::size_t open = colour.find('(');
    if (open == std::string_view::npos || !colour.ends_with(')')) return false;
    const std::string_view inner = colour.substr(open + 1, colour.size() - open - 2);
    const std::size_t slash = inner.rfind('/');
    const bool has_alpha = slash != std::string_view::npos || std::count(inner.begin(), inner.end(), ',') == 3;
    if (!has_alpha) return false;
    const std::optional<double> alpha = opacity_of(inner.substr(inner.find_last_of("/,") + 1));
    return alpha && *alpha <= 0;
}

/// Properties that an element inherits from those around it.
struct Around {
    Transform transform;
    std::string fill = "black";
    bool is_opaque = true;   ///< the opacity of fills is not 0
    bool is_visible = true;  ///< by `visibility`

    bool is_filled() const { return is_opaque && !is_clear(lower_case(fill)); }
};

/// Something without straight edges.
struct OutlineCurve {
    bool is_filled = false;
    double area = 0;  ///< area of a circle or ellipse
    pugi::xml_node node;
    std::string why;
};

class SvgPolygons {
public:
    SvgPolygons(std::string_view text, pugi::xml_node root, const Monitor& monitor)
        : text_(text), root_(root), pulse_(monitor), style_(root, monitor) {}

    /// @param copy  the `use` element whose target the element is, if it is one
    void visit(pugi::xml_node node, Around around, int level, pugi::xml_node copy = {}) {
        node_ = node;
        if (level > most_svg_levels) refuse("elements are nested too deeply");
        if (!copied_.empty() && ++copied_elements_ > most_copied_elements) {
            refuse(fmt::format("the copies have more than {} elements", most_copied_elements));
        }
        pulse_();
        const std::string_view name = local_name(node.name());
        for (const char* hidden :
             {"defs", "clipPath", "mask", "pattern", "marker", "metadata", "title", "desc", "style", "script"}) {
            if (name == hidden) return;
        }
        if (name == "symbol" && !copy) return;
        if (name == "switch") ++switches_;
        if (is_hidden(node)) return;
        if (std::string_view(node.attribute("inkscape:label").value()) == "ground") {
            ++grounds_;
            return;
        }
        try {
            inherit(node, around);
            if (name == "symbol" || (name == "svg" && level > 0)) {
                if (name == "svg") around.transform = around.transform * moved(node);
                around.transform = around.transform * view(node, copy);
            }
            element(name, node, around, level);
        } catch (const Refused&) {
            throw;
        } catch (const std::runtime_error& error) {
            refuse(error.what());
        }
        for (const pugi::xml_node child : node.children()) {
            if (child.type() == pugi::node_element) visit(child, around, level + 1);
        }
    }

    PolygonList finish() {
        const bool has_fills = filled_.list.size() > 0;
        Polygons& chosen = has_fills ? filled_ : outlined_;
        std::size_t circles = 0, curved_lines = 0;
        for (const OutlineCurve& curve : curves_) {
            // A filled circle no larger than the smallest tile marks a place; a larger one would be a tile.
            const bool counts = curve.is_filled || !has_fills;
            if (counts && !(curve.area > 0 && curve.area <= chosen.least_area)) {
                node_ = curve.node;
                refuse(curve.why);
            }
            ++(curve.area > 0 ? circles : curved_lines);
        }
        PolygonList result = std::move(chosen.list);
        result.colour_names.resize(colours_.size());
        for (const auto& [fill, colour] : colours_) {
            result.colour_names[static_cast<std::size_t>(colour)] = printable(fill, 40);
        }
        const auto note = [&](std::size_t count, const char* thing, const char* what) {
            if (count > 0) result.notes.push_back(fmt::format("{} {}", counted(count, thing), what));
        };
        if (has_fills) note(outlined_.list.size(), "unfilled outline", "left out");
        note(open_, "open line", "left out");
        note(curved_lines, "curved line", "left out");
        note(circles, "circle", "left out");
        note(grounds_, "ground", "left out");
        note(others_, "text or picture", "left out");
        note(clips_, "clipped or masked element", "read as a whole");
        note(opacities_, "opacity", "not understood: its shapes count as visible");
        note(switches_, "switch", "read with all its alternatives");
        note(style_.unread(), "style rule",
             "not read: only simple selectors outside of @media and similar rules are supported");
        return result;
    }

private:
    struct Refused : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    struct Polygons {
        PolygonList list;
        double least_area = 0;
    };

    std::string fault(const std::string& what) const {
        const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node_.offset_debug(), 0));
        return fmt::format("{}, <{}>: {}", line_and_column(text_, at), printable(node_.name(), 40), what);
    }
    [[noreturn]] void refuse(const std::string& what) const { throw Refused(fault(what)); }

    bool is_hidden(pugi::xml_node node) {
        if (lower_case(style_.property(node, "display")) == "none") return true;
        return opacity(style_.property(node, "opacity")).value_or(1) <= 0;
    }
    /// Parses an opacity; nullopt if the property is not set, or counted as not understood.
    std::optional<double> opacity(const std::string& text) {
        if (text.empty() || text == "inherit") return std::nullopt;
        const std::optional<double> value = opacity_of(text);
        if (!value) ++opacities_;
        return value;
    }
    void inherit(pugi::xml_node node, Around& around) {
        const auto inherited = [&](const char* name) {
            std::string value = style_.property(node, name);
            return value == "inherit" ? std::string() : value;
        };
        if (std::string fill = inherited("fill"); !fill.empty()) around.fill = std::move(fill);
        if (const auto value = opacity(inherited("fill-opacity"))) around.is_opaque = *value > 0;
        if (const std::string visibility = lower_case(inherited("visibility")); !visibility.empty()) {
            around.is_visible = visibility == "visible";
        }
        for (const char* name : {"clip-path", "mask"}) {
            const std::string value = lower_case(style_.property(node, name));
            if (!value.empty() && value != "none") ++clips_;
        }
        const std::string transform = style_.property(node, "transform");
        if (transform != node.attribute("transform").value() && lower_case(transform) != "none") {
            refuse("its transform is a style; expected an attribute");
        }
        around.transform = around.transform * parse_transform(node.attribute("transform").value());
    }
    Transform moved(pugi::xml_node node) const { return {.e = number(node, "x"), .f = number(node, "y")}; }

    /// Maps the view box of a symbol or of a picture in a picture to its place. Source: SVG 1.1, sections 5.6
    /// and 7.8.
    Transform view(pugi::xml_node node, pugi::xml_node copy) const {
        const std::vector<double> box = numbers_of(node.attribute("viewBox").value());
        if (box.empty()) return {};
        const auto length = [&](const char* name) {
            return copy && !copy.attribute(name).empty() ? number(copy, name) : number(node, name);
        };
        const double width = length("width"), height = length("height");
        if (box.size() != 4 || !(box[2] > 0 && box[3] > 0 && width > 0 && height > 0)) {
            refuse("expected a viewBox of four numbers, a width and a height, all sizes above 0");
        }
        double across = width / box[2], down = height / box[3];
        const std::string ratio(trimmed(node.attribute("preserveAspectRatio").value()));
        if (ratio.empty() || ratio == "xMidYMid" || ratio == "xMidYMid meet") {
            across = down = std::min(across, down);
        } else if (ratio != "none") {
            refuse(fmt::format("preserveAspectRatio is '{}'; expected xMidYMid or none", printable(ratio, 40)));
        }
        const double x = (width - across * box[2]) / 2 - across * box[0];
        const double y = (height - down * box[3]) / 2 - down * box[1];
        return {across, 0, 0, down, x, y};
    }

    void element(std::string_view name, pugi::xml_node node, const Around& around, int level) {
        if (name == "use") {
            copy(node, around, level);
        } else if (!around.is_visible) {
            return;
        } else if (name == "path") {
            const std::string_view data = node.attribute("d").value();
            count_copied(data.size());
            if (const std::size_t at = first_curve(data); at != std::string_view::npos) {
                curves_.push_back({around.is_filled(), 0, node,
                                   fmt::format("byte {} of its path is the curve '{}'; tiles have straight edges",
                                               at + 1, data[at])});
                return;
            }
            for (const FlatPath& path : flatten_path(data, most_polygon_corners - points_)) add(path, around);
        } else if (name == "polygon" || name == "polyline") {
            const std::string_view data = node.attribute("points").value();
            count_copied(data.size());
            const std::vector<double> numbers = numbers_of(data);
            if (numbers.size() % 2 != 0) refuse("its points have an odd number of coordinates");
            add(path_of_points(numbers, name == "polygon"), around);
        } else if (name == "rect") {
            rectangle(node, around);
        } else if (name == "circle" || name == "ellipse") {
            circle(name, node, around);
        } else if (name == "line") {
            ++open_;
        } else if (name == "text" || name == "image" || name == "foreignObject") {
            ++others_;
        }
    }

    void count_copied(std::size_t bytes) {
        if (copied_.empty()) return;
        copied_bytes_ += bytes;
        if (copied_bytes_ > most_copied_bytes) {
            refuse(fmt::format("the copies have more than {} MB of paths", most_copied_bytes >> 20U));
        }
    }

    /// Visits the target of a `use` element, with the properties that it inherits from there.
    void copy(pugi::xml_node node, Around around, int level) {
        std::string_view target = node.attribute("href").value();
        for (const pugi::xml_attribute each : node.attributes()) {
            if (target.empty() && std::string_view(each.name()).ends_with(":href")) target = each.value();
        }
        target = trimmed(target);
        if (target.empty()) return;
        if (target.front() != '#') {
            refuse(fmt::format("it copies '{}'; expected the id of an element in this file", printable(target, 60)));
        }
        if (ids_.empty()) find_ids();
        const auto found = ids_.find(target.substr(1));
        if (found == ids_.end()) refuse(fmt::format("no element has the id '{}'", printable(target.substr(1), 60)));
        if (std::find(copied_.begin(), copied_.end(), found->second) != copied_.end()) {
            refuse("it copies an element that contains it");
        }
        if (copied_.size() >= most_copied_levels) {
            refuse(fmt::format("copies are nested more than {} levels deep", most_copied_levels));
        }
        around.transform = around.transform * moved(node);
        copied_.push_back(found->second);
        visit(found->second, std::move(around), level + 1, node);
        copied_.pop_back();
        node_ = node;
    }
    void find_ids() {
        std::vector<pugi::xml_node> left = {root_};
        while (!left.empty()) {
            pulse_();
            const pugi::xml_node node = left.back();
            left.pop_back();
            // The first of several elements with one id counts.
            const std::string_view id = node.attribute("id").value();
            if (!id.empty()) ids_.try_emplace(id, node);
            for (pugi::xml_node child = node.last_child(); child; child = child.previous_sibling()) {
                if (child.type() == pugi::node_element) left.push_back(child);
            }
        }
    }

    /// A length in user units.
    double number(pugi::xml_node node, const char* name) const {
        const std::string text(trimmed(node.attribute(name).value()));
        if (text.empty()) return 0;
        const std::vector<double> numbers = numbers_of(text);
        if (numbers.size() != 1) refuse(fmt::format("'{}' is not a number", name));
        return numbers.front();
    }
    void rectangle(pugi::xml_node node, const Around& around) {
        if (number(node, "rx") > 0 || number(node, "ry") > 0) {
            curves_.push_back({around.is_filled(), 0, node, "it has round corners; tiles have straight edges"});
            return;
        }
        const double x = number(node, "x"), y = number(node, "y");
        const double width = number(node, "width"), height = number(node, "height");
        if (!(width > 0 && height > 0)) return;
        add({{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, true}, around);
    }
    void circle(std::string_view name, pugi::xml_node node, const Around& around) {
        const bool is_round = name == "circle";
        const double across = number(node, is_round ? "r" : "rx"), down = number(node, is_round ? "r" : "ry");
        const Transform& t = around.transform;
        const double area = std::numbers::pi * across * down * std::fabs(t.a * t.d - t.b * t.c);
        if (area > 0)
            curves_.push_back({around.is_filled(), area, node, "this is a curve; tiles have straight edges"});
    }
    void add(const FlatPath& path, const Around& around) {
        if (!path.is_closed) {
            if (path.points.size() > 1) ++open_;
            return;
        }
        points_ += path.points.size();
        if (points_ > most_polygon_corners)
            refuse(fmt::format("the polygons have more than {} corners", most_polygon_corners));
        Polygons& polygons = around.is_filled() ? filled_ : outlined_;
        PolygonList& list = polygons.list;
        for (const glm::dvec2 point : path.points) {
            const glm::dvec2 at = around.transform(point);
            if (!(std::fabs(at.x) <= most_polygon_coordinate && std::fabs(at.y) <= most_polygon_coordinate)) {
                refuse(fmt::format("a coordinate is larger than {:g}", most_polygon_coordinate));
            }
            list.corners.emplace_back(at.x, -at.y);
        }
        const auto colour =
            colours_.try_emplace(around.fill, static_cast<std::int32_t>(colours_.size())).first->second;
        list.end_polygon(colour);
        const double area = mass_of(list.polygon(list.size() - 1)).area;
        if (list.size() == 1 || area < polygons.least_area) polygons.least_area = area;
    }

    std::string_view text_;
    pugi::xml_node root_;
    Pulse pulse_;
    SvgStyle style_;
    pugi::xml_node node_;  ///< the element that is being read
    Polygons filled_, outlined_;
    std::vector<OutlineCurve> curves_;
    std::unordered_map<std::string_view, pugi::xml_node> ids_;
    std::vector<pugi::xml_node> copied_;  ///< targets of the `use` elements around node_
    std::map<std::string, std::int32_t> colours_;
    std::size_t points_ = 0, copied_elements_ = 0, copied_bytes_ = 0;
    std::size_t open_ = 0, grounds_ = 0, others_ = 0, clips_ = 0, switches_ = 0, opacities_ = 0;
};

}  // namespace

PolygonList read_polygons_svg(std::string_view text, const Monitor& monitor) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed) {
        throw std::runtime_error(fmt::format("{}: damaged XML: {}",
                                             line_and_column(text, static_cast<std::size_t>(parsed.offset)),
                                             parsed.description()));
    }
    const pugi::xml_node root = document.document_element();
    SvgPolygons polygons(text, root, monitor);
    polygons.visit(root, {}, 0);
    PolygonList result = polygons.finish();
    if (text.find("<?xml-stylesheet") != std::string_view::npos) {
        result.notes.emplace_back("the style sheet in another file is not read");
    }
    if (result.size() == 0) throw std::runtime_error("the SVG has no closed polygons");
    result.title = printable(root.child("title").text().get(), 200);
    return result;
}

}  // namespace sikku
