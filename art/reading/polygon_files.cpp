#include "art/reading/polygon_files.h"

#include "art/reading/svg_attributes.h"
#include "art/reading/svg_path.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_points = 50'000'000;
constexpr double most_coordinate = 1e9;
constexpr std::size_t most_nested = 50;

/// `line 3, column 7` of a byte of a text.
std::string line_and_column(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, std::min(at, text.size()));
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t start = before.rfind('\n');
    return fmt::format("line {}, column {}", line,
                       before.size() - (start == std::string_view::npos ? 0 : start + 1) + 1);
}

/// Collects polygons from the events of a parser.
class JsonPolygons : public nlohmann::json_sax<nlohmann::json> {
public:
    JsonPolygons(std::string_view text, const Monitor& monitor) : text_(text), pulse_(monitor) {}

    bool null() override { return value("null"); }
    bool boolean(bool) override { return value("a truth value"); }
    bool number_integer(number_integer_t number) override { return take(static_cast<double>(number)); }
    bool number_unsigned(number_unsigned_t number) override { return take(static_cast<double>(number)); }
    bool number_float(number_float_t number, const string_t&) override { return take(number); }
    bool string(string_t& text) override {
        if (in() == In::top && key_ == "title") polygons_.title = printable(text, 200);
        return value("a text");
    }
    bool binary(binary_t&) override { return value("bytes"); }
    bool key(string_t& name) override {
        key_ = name;
        if (in() == In::top) has_list_ = has_list_ || name == "list";
        return true;
    }
    bool start_object(std::size_t) override {
        if (in() == In::list) {
            corners_seen_ = false;
            colour_ = 0;
            return push(In::tile);
        }
        return push(open("an object", nested_.empty() ? In::top : In::skipped));
    }
    bool start_array(std::size_t) override {
        switch (in()) {
            case In::nothing:
                has_list_ = true;
                return push(In::list);
            case In::top:
                return push(key_ == "list" ? In::list : In::skipped);
            case In::list:
                colour_ = 0;
                return push(In::polygon);
            case In::tile:
                if (key_ != "corners") return push(In::skipped);
                if (std::exchange(corners_seen_, true)) refuse("'corners' occurs twice");
                return push(In::polygon);
            case In::polygon:
                numbers_ = 0;
                return push(In::corner);
            case In::corner:
                refuse_corner("a list");
            default:
                return push(In::skipped);
        }
    }
    bool end_object() override {
        if (in() == In::tile) {
            if (!corners_seen_) refuse("'corners' is missing");
            polygons_.end_polygon(colour_);
        }
        nested_.pop_back();
        return true;
    }
    bool end_array() override {
        pulse_();
        const In ended = in();
        nested_.pop_back();
        if (ended == In::corner) {
            if (numbers_ != 2) refuse_corner(counted(numbers_, "number"));
            if (polygons_.corners.size() >= most_points) {
                throw std::runtime_error(fmt::format("the polygons have more than {} corners", most_points));
            }
            polygons_.corners.emplace_back(at_[0], at_[1]);
        } else if (ended == In::polygon) {
            if (polygons_.corners.size() - polygons_.begin.back() < 3) refuse("a polygon has three corners or more");
            if (in() == In::list) polygons_.end_polygon(0);
        }
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
        // The parser counts the bytes that it read.
        throw std::runtime_error(
            fmt::format("{}: this is not valid JSON", line_and_column(text_, position > 0 ? position - 1 : 0)));
    }

    PolygonList finish() {
        if (!has_list_)
            throw std::runtime_error("expected a list of polygons, or an object with such a list as 'list'");
        return std::move(polygons_);
    }

private:
    /// What the innermost bracket contains.
    enum class In : std::uint8_t { nothing, top, list, tile, polygon, corner, skipped };

    In in() const { return nested_.empty() ? In::nothing : nested_.back(); }
    bool push(In inside) {
        if (nested_.size() >= most_nested)
            throw std::runtime_error(fmt::format("more than {} nested brackets", most_nested));
        nested_.push_back(inside);
        return true;
    }
    [[noreturn]] void refuse(const std::string& what) const {
        throw std::runtime_error(fmt::format("polygon {}: {}", polygons_.size() + 1, what));
    }
    [[noreturn]] void refuse_corner(const std::string& what) const {
        refuse(fmt::format("corner {}: expected [x, y], not {}",
                           polygons_.corners.size() - polygons_.begin.back() + 1, what));
    }
    /// Anything but a number or a bracket.
    bool value(const char* what) {
        open(what, In::skipped);
        return true;
    }
    /// Refuses `what` where only something else may stand; else returns `inside`.
    In open(const char* what, In inside) const {
        if (in() == In::nothing && inside == In::skipped) {
            throw std::runtime_error(fmt::format("expected a list of polygons, not {}", what));
        }
        if (in() == In::list) refuse(fmt::format("expected a list of corners, not {}", what));
        if (in() == In::polygon || in() == In::corner) refuse_corner(what);
        if (in() == In::tile && key_ == "corners")
            refuse(fmt::format("'corners' is {}, not a list of corners", what));
        if (in() == In::top && key_ == "list") {
            throw std::runtime_error(fmt::format("'list' is {}, not a list of polygons", what));
        }
        return inside;
    }
    bool take(double number) {
        if (in() == In::corner) {
            if (!(std::fabs(number) <= most_coordinate)) {
                refuse_corner(fmt::format("{:g}, which is larger than {:g}", number, most_coordinate));
            }
            if (numbers_ < 2) at_[numbers_] = number;
            ++numbers_;
            return true;
        }
        if (in() == In::tile && key_ == "colour") {
            if (!(std::fabs(number) <= 1e6) || number != std::floor(number)) {
                refuse("'colour' is not a whole number of up to a million");
            }
            colour_ = static_cast<std::int32_t>(number);
            return true;
        }
        return value("a number");
    }

    std::string_view text_;
    Pulse pulse_;
    PolygonList polygons_;
    std::vector<In> nested_;
    std::string key_;
    bool has_list_ = false;
    bool corners_seen_ = false;
    std::int32_t colour_ = 0;
    std::size_t numbers_ = 0;
    std::array<double, 2> at_{};
};

/// Properties that an element inherits from those around it.
struct Around {
    Transform transform;
    std::string fill = "black";
};

class SvgPolygons {
public:
    SvgPolygons(std::string_view text, const Monitor& monitor) : text_(text), pulse_(monitor) {}

    void visit(pugi::xml_node node, Around around, int level) {
        node_ = node;
        if (level > most_svg_levels) refuse("elements are nested too deeply");
        pulse_();
        const std::string_view full = node.name();
        const std::string_view name = full.substr(full.find(':') == std::string_view::npos ? 0 : full.find(':') + 1);
        for (const char* hidden :
             {"defs", "clipPath", "mask", "symbol", "pattern", "marker", "metadata", "title", "desc", "style"}) {
            if (name == hidden) return;
        }
        if (svg_property(node, "display") == "none") return;
        if (std::string_view(node.attribute("inkscape:label").value()) == "ground") {
            ++grounds_;
            return;
        }
        if (std::string fill = svg_property(node, "fill"); !fill.empty()) around.fill = std::move(fill);
        try {
            if (node.attribute("transform").empty() && !svg_property(node, "transform").empty()) {
                refuse("its transform is a style; expected an attribute");
            }
            around.transform = around.transform * parse_transform(node.attribute("transform").value());
            if (name == "svg" && level > 0) {
                if (!node.attribute("viewBox").empty()) refuse("a picture in a picture cannot have a viewBox");
                around.transform = around.transform * Transform{.e = number(node, "x"), .f = number(node, "y")};
            }
            element(name, node, around);
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
        const bool has_fills = filled_.size() > 0;
        PolygonList result = std::move(has_fills ? filled_ : outlined_);
        result.colour_names.resize(colours_.size());
        for (const auto& [fill, colour] : colours_) {
            result.colour_names[static_cast<std::size_t>(colour)] = printable(fill, 40);
        }
        const auto note = [&](std::size_t count, const char* thing) {
            if (count > 0) result.notes.push_back(fmt::format("{} left out", counted(count, thing)));
        };
        if (has_fills) note(outlined_.size(), "unfilled outline");
        note(open_, "open line");
        note(grounds_, "ground");
        note(others_, "text or picture");
        return result;
    }

private:
    struct Refused : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    [[noreturn]] void refuse(const std::string& what) const {
        const auto at = static_cast<std::size_t>(std::max<std::ptrdiff_t>(node_.offset_debug(), 0));
        throw Refused(fmt::format("{}, <{}>: {}", line_and_column(text_, at), printable(node_.name(), 40), what));
    }
    void element(std::string_view name, pugi::xml_node node, const Around& around) {
        if (name == "path") {
            const std::string_view data = node.attribute("d").value();
            if (const std::size_t at = first_curve(data); at != std::string_view::npos) {
                refuse(fmt::format("byte {} of its path is the curve '{}'; tiles have straight edges", at + 1,
                                   data[at]));
            }
            for (const FlatPath& path : flatten_path(data, most_points - points_)) add(path, around);
        } else if (name == "polygon" || name == "polyline") {
            const std::vector<double> numbers = numbers_of(node.attribute("points").value());
            if (numbers.size() % 2 != 0) refuse("its points have an odd number of coordinates");
            FlatPath path;
            for (std::size_t i = 0; i < numbers.size(); i += 2) path.points.emplace_back(numbers[i], numbers[i + 1]);
            const bool returns = path.points.size() > 2 && path.points.front() == path.points.back();
            path.is_closed = name == "polygon" || returns;
            if (returns) path.points.pop_back();
            add(path, around);
        } else if (name == "rect") {
            rectangle(node, around);
        } else if (name == "circle" || name == "ellipse") {
            if (is_visible(around)) refuse("this is a curve; tiles have straight edges");
        } else if (name == "use") {
            refuse("copies of elements are not supported; write each tile as an element");
        } else if (name == "line") {
            ++open_;
        } else if (name == "text" || name == "image" || name == "foreignObject") {
            ++others_;
        }
    }
    static bool is_visible(const Around& around) { return around.fill != "none" && around.fill != "transparent"; }

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
            refuse("it has round corners; tiles have straight edges");
        }
        const double x = number(node, "x"), y = number(node, "y");
        const double width = number(node, "width"), height = number(node, "height");
        if (!(width > 0 && height > 0)) return;
        add({{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, true}, around);
    }
    void add(const FlatPath& path, const Around& around) {
        if (!path.is_closed) {
            if (path.points.size() > 1) ++open_;
            return;
        }
        points_ += path.points.size();
        if (points_ > most_points) refuse(fmt::format("the polygons have more than {} corners", most_points));
        PolygonList& list = is_visible(around) ? filled_ : outlined_;
        for (const glm::dvec2 point : path.points) {
            const glm::dvec2 at = around.transform(point);
            if (!(std::fabs(at.x) <= most_coordinate && std::fabs(at.y) <= most_coordinate)) {
                refuse(fmt::format("a coordinate is larger than {:g}", most_coordinate));
            }
            list.corners.emplace_back(at.x, -at.y);
        }
        const auto colour =
            colours_.try_emplace(around.fill, static_cast<std::int32_t>(colours_.size())).first->second;
        list.end_polygon(colour);
    }

    std::string_view text_;
    Pulse pulse_;
    pugi::xml_node node_;  ///< the element that is being read
    PolygonList filled_, outlined_;
    std::map<std::string, std::int32_t> colours_;
    std::size_t points_ = 0;
    std::size_t open_ = 0, grounds_ = 0, others_ = 0;
};

}  // namespace

PolygonList read_polygons_json(std::string_view text, const Monitor& monitor) {
    JsonPolygons polygons(text, monitor);
    nlohmann::json::sax_parse(text.begin(), text.end(), &polygons);
    return polygons.finish();
}

PolygonList read_polygons_svg(std::string_view text, const Monitor& monitor) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
    if (!parsed) {
        throw std::runtime_error(fmt::format("{}: damaged XML: {}",
                                             line_and_column(text, static_cast<std::size_t>(parsed.offset)),
                                             parsed.description()));
    }
    SvgPolygons polygons(text, monitor);
    const pugi::xml_node root = document.document_element();
    polygons.visit(root, {}, 0);
    PolygonList result = polygons.finish();
    if (result.size() == 0) throw std::runtime_error("the SVG has no closed polygons");
    result.title = printable(root.child("title").text().get(), 200);
    return result;
}

}  // namespace sikku
