// tests/fuzz/svg_targets.h: fuzz targets that read SVG with copies and style sheets: arbitrary text, and pictures
// made of bytes, which are compared with the same pictures without copies and sheets.
#pragma once

#include "art/reading/polygon_files.h"
#include "engine/tiling/tiling.h"
#include "tests/fuzz/file_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace sikku {

/// The polygons read are complete and can be examined; errors and notes are plain text.
inline void try_svg(std::string_view text) {
    try {
        const PolygonList list = read_polygons_svg(text);
        must(list.size() > 0 && list.begin.back() == list.corners.size(), "a polygon is not complete");
        must(list.begin.size() == list.size() + 1, "a polygon has no end");
        for (const std::string& note : list.notes) must_be_plain(note, "a note");
        for (const std::string& name : list.colour_names) must_be_plain(name, "the name of a colour");
        for (const std::int32_t colour : list.colour) {
            must(static_cast<std::size_t>(colour) < list.colour_names.size(), "a colour has no name");
        }
        if (list.corners.size() > 2000) return;
        const TilingExamination t = examine_polygons(list, usual_tolerance(list), {}).examination;
        must(t.tiles <= list.size(), "there are more tiles than polygons");
    } catch (const std::runtime_error& error) {
        must_be_plain(error.what(), "an error");
    }
}

/// A picture of rectangles, groups and copies, with rules for their fills.
class MadePicture {
public:
    explicit MadePicture(std::string_view bytes) : bytes_(bytes) {
        const int rules = below(6);
        for (int i = 0; i < rules; ++i) rules_.push_back({below(7), below(3), fill(), below(4) == 0});
        const int definitions = 1 + below(5);
        for (int i = 0; i < definitions; ++i) nodes_.push_back(node(i, 2));
    }

    std::string with_copies() const {
        std::string sheet, text;
        for (const Rule& rule : rules_) {
            sheet += fmt::format("{}{{stroke:red;fill:{}{}}}", selector(rule), rule.fill,
                                 rule.is_important ? " !important" : "");
        }
        for (const Node& each : nodes_) text += copied(each);
        return "<svg><style>" + sheet + "</style>" + text + "</svg>";
    }
    std::string written_out() const {
        std::string text;
        for (const Node& each : nodes_) text += plain(each, "black", 0);
        return "<svg>" + text + "</svg>";
    }

private:
    enum class Kind : std::uint8_t { tile, group, copy };
    struct Node {
        Kind kind = Kind::tile;
        std::string id, classes, attribute, style, transform;
        int x = 0, y = 0, target = 0;
        std::vector<Node> children;
    };
    struct Rule {
        int form, name;
        std::string fill;
        bool is_important;
    };

    int below(int limit) {
        const int byte = at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : 0;
        return byte % limit;
    }
    std::string fill() { return fmt::format("c{}", below(4)); }

    /// @param number  of the definition; copies are of earlier ones
    Node node(int number, int depth) {
        Node made;
        const int kind = below(depth > 0 ? 4 : 1);
        made.kind = kind < 2 ? Kind::tile : kind == 2 ? Kind::group : Kind::copy;
        if (made.kind == Kind::copy && number == 0) made.kind = Kind::tile;
        made.id = depth == 2 ? fmt::format("d{}", number) : "";
        for (int i = 0; i < 3; ++i) {
            if (below(3) == 0) made.classes += fmt::format("{}k{}", made.classes.empty() ? "" : " ", i);
        }
        if (below(3) == 0) made.attribute = fill();
        if (below(5) == 0) made.style = fill();
        constexpr const char* transforms[] = {"", "rotate(90)", "translate(3 1)", "scale(2) translate(0 5)",
                                              "matrix(0 1 1 0 2 2)"};
        made.transform = transforms[below(5)];
        made.x = below(4);
        made.y = below(4);
        if (made.kind == Kind::copy) made.target = below(number);
        if (made.kind == Kind::group) {
            const int count = 1 + below(3);
            for (int i = 0; i < count; ++i) made.children.push_back(node(number, depth - 1));
        }
        return made;
    }

    static std::string name_of(Kind kind) { return kind == Kind::tile ? "rect" : kind == Kind::group ? "g" : "use"; }

    static std::string selector(const Rule& rule) {
        switch (rule.form) {
            case 0:
                return "rect";
            case 1:
                return fmt::format("g, #d{}", rule.name);
            case 2:
                return fmt::format(".k{}", rule.name);
            case 3:
                return fmt::format("rect.k{}", rule.name);
            case 4:
                return fmt::format(".k{}.k{}", rule.name, (rule.name + 1) % 3);
            case 5:
                return fmt::format("use.k{} , g.k{}", rule.name, rule.name);
            default:
                return "*";
        }
    }
    /// The specificity with which a rule applies to an element; 0: it does not.
    static int weight(const Rule& rule, const Node& node) {
        const std::string name = name_of(node.kind);
        const auto has = [&](int k) { return node.classes.find(fmt::format("k{}", k)) != std::string::npos; };
        switch (rule.form) {
            case 0:
                return name == "rect" ? 2 : 0;
            case 1:
                return node.id == fmt::format("d{}", rule.name) ? 100 : name == "g" ? 2 : 0;
            case 2:
                return has(rule.name) ? 10 : 0;
            case 3:
                return name == "rect" && has(rule.name) ? 11 : 0;
            case 4:
                return has(rule.name) && has((rule.name + 1) % 3) ? 20 : 0;
            case 5:
                return name != "rect" && has(rule.name) ? 11 : 0;
            default:
                return 1;
        }
    }
    std::string fill_of(const Node& node, const std::string& inherited) const {
        std::string best = node.attribute.empty() ? inherited : node.attribute;
        std::tuple<bool, bool, int> strength{false, false, 0};  // important, of the style, specificity
        if (!node.style.empty()) {
            best = node.style;
            strength = {false, true, 0};
        }
        for (const Rule& rule : rules_) {
            const int own = weight(rule, node);
            const std::tuple<bool, bool, int> other{rule.is_important, false, own};
            if (own == 0 || other < strength) continue;
            strength = other;
            best = rule.fill;
        }
        return best;
    }

    std::string copied(const Node& node) const {
        std::string text = fmt::format("<{}", name_of(node.kind));
        if (!node.id.empty()) text += fmt::format(" id=\"{}\"", node.id);
        if (!node.classes.empty()) text += fmt::format(" class=\"{}\"", node.classes);
        if (!node.attribute.empty()) text += fmt::format(" fill=\"{}\"", node.attribute);
        if (!node.style.empty()) text += fmt::format(" style=\"stroke:none; fill: {}\"", node.style);
        if (!node.transform.empty()) text += fmt::format(" transform=\"{}\"", node.transform);
        if (node.kind != Kind::group) text += fmt::format(" x=\"{}\" y=\"{}\"", node.x, node.y);
        if (node.kind == Kind::tile) text += " width=\"1\" height=\"2\"";
        if (node.kind == Kind::copy) {
            text += fmt::format(" {}href=\"#d{}\"", node.x % 2 == 0 ? "xlink:" : "", node.target);
        }
        text += ">";
        for (const Node& child : node.children) text += copied(child);
        return text + fmt::format("</{}>", name_of(node.kind));
    }
    std::string plain(const Node& node, const std::string& inherited, int level) const {
        if (level > 40) return "";
        const std::string fill = fill_of(node, inherited);
        const std::string head = fmt::format("<g transform=\"{}\">", node.transform);
        if (node.kind == Kind::tile) {
            return head + fmt::format("<rect x=\"{}\" y=\"{}\" width=\"1\" height=\"2\" fill=\"{}\"/></g>", node.x,
                                      node.y, fill);
        }
        if (node.kind == Kind::copy) {
            return head + fmt::format("<g transform=\"translate({},{})\">", node.x, node.y) +
                   plain(nodes_[static_cast<std::size_t>(node.target)], fill, level + 1) + "</g></g>";
        }
        std::string text = head;
        for (const Node& child : node.children) text += plain(child, fill, level + 1);
        return text + "</g>";
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    std::vector<Rule> rules_;
    std::vector<Node> nodes_;
};

/// A picture with copies and sheets has the polygons of the same picture written out.
inline void try_copies(std::string_view bytes) {
    const MadePicture picture(bytes);
    const PolygonList copied = read_polygons_svg(picture.with_copies());
    const PolygonList plain = read_polygons_svg(picture.written_out());
    must(copied.begin == plain.begin, "copies have other polygons");
    for (std::size_t i = 0; i < copied.corners.size(); ++i) {
        const glm::dvec2 gap = copied.corners[i] - plain.corners[i];
        must(std::max(std::fabs(gap.x), std::fabs(gap.y)) < 1e-6, "copies lie elsewhere");
    }
    for (std::size_t i = 0; i < copied.size(); ++i) {
        must(copied.colour_names[static_cast<std::size_t>(copied.colour[i])] ==
                 plain.colour_names[static_cast<std::size_t>(plain.colour[i])],
             "copies have other fills");
    }
}

}  // namespace sikku
