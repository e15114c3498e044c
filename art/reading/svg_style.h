// art/reading/svg_style.h: properties of SVG elements from style sheets, styles and attributes.
#pragma once

#include "engine/base/monitor.h"

#include <pugixml.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// A property of an element, from its style or its attribute; empty if it has neither. Style sheets are not read.
std::string svg_property(pugi::xml_node node, const char* name);

/// The style sheets of an SVG: rules with simple selectors, `rect`, `.a`, `#b`, `rect.a`, `*`, and lists of them.
/// Source: SVG 1.1 (Second Edition), section 6; CSS 2.1, sections 4.1 and 6.4.
class SvgStyle {
public:
    /// Reads all `style` elements. Cost: linear. @throws std::runtime_error if there are too many rules or elements
    /// are nested too deeply; Stopped
    explicit SvgStyle(pugi::xml_node root, const Monitor& monitor = {});

    /// The value of a property that applies to an element itself, not inherited: by `!important`, the style of the
    /// element, the most specific and then the last rule, the attribute. Empty if there is none.
    std::string property(pugi::xml_node node, const char* name) const;

    /// Number of rules with other selectors, or within `@media` and the like, that would set properties of polygons.
    std::size_t unread() const { return unread_; }

private:
    struct Declaration {
        std::string name, value;
        bool is_important = false;
    };
    /// A simple selector with the declarations of its rule.
    struct Rule {
        std::string element, id;
        std::vector<std::string> classes;
        int specificity = 0;
        std::size_t declarations = 0;  ///< index into declarations_
    };
    friend std::string svg_property(pugi::xml_node node, const char* name);

    static std::vector<Declaration> declarations_of(std::string_view text);
    static std::optional<Declaration> own_declaration(pugi::xml_node node, const char* name);
    void find_sheets(pugi::xml_node node, int level);
    void read_sheet(std::string text);
    void add_rule(std::string_view selectors, std::string_view body);
    bool add_selector(std::string_view selector);
    void count_unread(std::string_view body);
    bool applies(const Rule& rule, pugi::xml_node node, const std::vector<std::string_view>& classes) const;
    const Declaration* declared(pugi::xml_node node, const char* name) const;

    mutable Pulse pulse_;
    std::vector<std::vector<Declaration>> declarations_;
    std::vector<Rule> rules_;
    std::map<std::string, std::vector<std::size_t>, std::less<>>
        by_key_;  ///< rules by `#id`, else `.class`, else element
    std::size_t unread_ = 0;
};

}  // namespace sikku
