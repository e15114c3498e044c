#include "art/reading/svg_style.h"

#include "art/reading/svg_attributes.h"
#include "engine/base/characters.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_rules = 10'000;
constexpr std::string_view blanks = " \t\r\n\f";

/// The first of some characters outside of strings, parentheses and brackets, or the end.
std::size_t find_outside(std::string_view text, std::string_view wanted, std::size_t at) {
    int depth = 0;
    for (; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '\\') {
            ++at;
        } else if (c == '"' || c == '\'') {
            for (++at; at < text.size() && text[at] != c; ++at) {
                if (text[at] == '\\') ++at;
            }
        } else if (depth == 0 && wanted.find(c) != std::string_view::npos) {
            return at;
        } else if (c == '(' || c == '[') {
            ++depth;
        } else if ((c == ')' || c == ']') && depth > 0) {
            --depth;
        }
    }
    return text.size();
}

/// Replaces `/* */`, and the `<!--` and `-->` that old files have around a sheet, by blanks.
void remove_comments(std::string& text) {
    for (std::size_t at = text.find("/*"); at != std::string::npos; at = text.find("/*", at)) {
        const std::size_t end = text.find("*/", at + 2);
        const std::size_t after = end == std::string::npos ? text.size() : end + 2;
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(after),
                  ' ');
    }
    for (const std::string_view mark : {"<!--", "-->"}) {
        for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at)) {
            text.replace(at, mark.size(), mark.size(), ' ');
        }
    }
}

bool is_name(char c) {
    return is_letter_or_digit(c) || c == '-' || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

}  // namespace

std::vector<SvgStyle::Declaration> SvgStyle::declarations_of(std::string_view text) {
    std::vector<Declaration> result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = find_outside(text, ";", at);
        const std::string_view part = text.substr(at, end - at);
        at = end + 1;
        const std::size_t colon = part.find(':');
        if (colon == std::string_view::npos) continue;
        std::string_view value = trimmed(part.substr(colon + 1));
        const std::size_t mark = value.rfind('!');
        const bool is_important =
            mark != std::string_view::npos && lower_case(trimmed(value.substr(mark + 1))) == "important";
        if (is_important) value = trimmed(value.substr(0, mark));
        result.push_back({lower_case(trimmed(part.substr(0, colon))), std::string(value), is_important});
    }
    return result;
}

/// The declaration of the element's style that applies.
std::optional<SvgStyle::Declaration> SvgStyle::own_declaration(pugi::xml_node node, const char* name) {
    std::optional<Declaration> best;
    for (Declaration& each : declarations_of(node.attribute("style").value())) {
        if (each.name == name && (!best || each.is_important >= best->is_important)) best = std::move(each);
    }
    return best;
}

std::string svg_property(pugi::xml_node node, const char* name) {
    const auto own = SvgStyle::own_declaration(node, name);
    return own ? own->value : node.attribute(name).value();
}

SvgStyle::SvgStyle(pugi::xml_node root, const Monitor& monitor) : pulse_(monitor) {
    find_sheets(root, 0);
}

void SvgStyle::find_sheets(pugi::xml_node node, int level) {
    if (level > most_svg_levels) throw std::runtime_error("elements are nested too deeply");
    pulse_();
    if (local_name(node.name()) == "style") {
        std::string text;
        for (const pugi::xml_node child : node.children()) text += child.value();
        const std::string_view whole_type = node.attribute("type").value();
        const std::string type = lower_case(std::string(trimmed(whole_type.substr(0, whole_type.find(';')))));
        if (!type.empty() && type != "text/css") return count_unread(text);
        const std::string media = lower_case(std::string(trimmed(node.attribute("media").value())));
        if (media.empty() || media == "all" || media == "screen") {
            read_sheet(std::move(text));
        } else {
            count_unread(text);
        }
        return;
    }
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element) find_sheets(child, level + 1);
    }
}

void SvgStyle::read_sheet(std::string text) {
    remove_comments(text);
    const std::string_view sheet = text;
    for (std::size_t at = sheet.find_first_not_of(blanks); at < sheet.size();
         at = sheet.find_first_not_of(blanks, at)) {
        pulse_();
        const std::size_t open = find_outside(sheet, "{;", at);
        const std::string_view head = trimmed(sheet.substr(at, open - at));
        // The rest of a damaged sheet, such as one with an unbalanced bracket.
        if (open == sheet.size()) return count_unread(sheet.substr(at));
        if (sheet[open] == ';') {
            // `@import` brings rules of another file.
            if (lower_case(head).starts_with("@import")) ++unread_;
            at = open + 1;
            continue;
        }
        std::size_t close = open + 1;
        for (int depth = 1; depth > 0 && close < sheet.size(); ++close) {
            close = find_outside(sheet, "{}", close);
            if (close == sheet.size()) break;
            depth += sheet[close] == '{' ? 1 : -1;
        }
        const std::size_t end =
            close > open + 1 && close <= sheet.size() && sheet[close - 1] == '}' ? close - 1 : close;
        const std::string_view body = sheet.substr(open + 1, end - open - 1);
        if (head.starts_with('@')) {
            const std::string name = lower_case(std::string(head.substr(0, head.find_first_of(" \t\r\n\f("))));
            if (name != "@font-face" && name != "@keyframes" && name != "@page") count_unread(body);
        } else {
            add_rule(head, body);
        }
        at = close;
    }
}

void SvgStyle::count_unread(std::string_view body) {
    // Within at-rules, declarations follow other braces.
    static constexpr std::array<std::string_view, 8> needed = {"fill",         "display",   "visibility", "opacity",
                                                               "fill-opacity", "transform", "clip-path",  "mask"};
    for (std::size_t at = 0; at < body.size();) {
        const std::size_t end = std::min(body.find_first_of("{};", at), body.size());
        const std::string_view part = body.substr(at, end - at);
        at = end + 1;
        if (end < body.size() && body[end] == '{') continue;
        const std::string name = lower_case(trimmed(part.substr(0, part.find(':'))));
        if (std::find(needed.begin(), needed.end(), name) == needed.end()) continue;
        ++unread_;
        return;
    }
}

void SvgStyle::add_rule(std::string_view selectors, std::string_view body) {
    declarations_.push_back(declarations_of(body));
    bool is_read = true;
    for (std::size_t at = 0; at <= selectors.size();) {
        const std::size_t end = find_outside(selectors, ",", at);
        is_read = add_selector(trimmed(selectors.substr(at, end - at))) && is_read;
        at = end + 1;
    }
    if (!is_read) count_unread(body);
}

/// Returns false if it is not a simple selector.
bool SvgStyle::add_selector(std::string_view selector) {
    if (selector.empty()) return false;
    Rule rule;
    rule.declarations = declarations_.size() - 1;
    for (std::size_t at = 0; at < selector.size();) {
        const char kind = selector[at];
        const std::size_t begin = kind == '.' || kind == '#' ? at + 1 : at;
        std::size_t end = begin;
        if (kind == '*' && at == 0) {
            ++end;
        } else {
            while (end < selector.size() && is_name(selector[end])) ++end;
        }
        if (end == begin) return false;
        const std::string name(selector.substr(begin, end - begin));
        if (kind == '.') {
            rule.classes.push_back(name);
            rule.specificity += 100;
        } else if (kind == '#') {
            if (!rule.id.empty() && rule.id != name) return true;  // an element has only one
            rule.id = name;
            rule.specificity += 10'000;
        } else if (at > 0) {
            return false;
        } else if (kind != '*') {
            rule.element = name;
            ++rule.specificity;
        }
        at = end;
    }
    if (rules_.size() >= most_rules) {
        throw std::runtime_error(fmt::format("its style sheets have more than {} rules", most_rules));
    }
    const std::string key = !rule.id.empty()        ? "#" + rule.id
                            : !rule.classes.empty() ? "." + rule.classes.front()
                                                    : rule.element;
    by_key_[key].push_back(rules_.size());
    rules_.push_back(std::move(rule));
    return true;
}

bool SvgStyle::applies(const Rule& rule, pugi::xml_node node, const std::vector<std::string_view>& classes) const {
    if (!rule.element.empty() && rule.element != local_name(node.name())) return false;
    if (!rule.id.empty() && rule.id != node.attribute("id").value()) return false;
    return std::all_of(rule.classes.begin(), rule.classes.end(), [&](const std::string& name) {
        return std::find(classes.begin(), classes.end(), name) != classes.end();
    });
}

/// The declaration of the sheets that applies to an element; null if there is none.
const SvgStyle::Declaration* SvgStyle::declared(pugi::xml_node node, const char* name) const {
    std::vector<std::string_view> classes = split_words(node.attribute("class").value(), blanks);
    std::sort(classes.begin(), classes.end());
    classes.erase(std::unique(classes.begin(), classes.end()), classes.end());
    const Declaration* best = nullptr;
    std::size_t best_rule = 0;
    const auto consider = [&](std::string_view key) {
        const auto found = by_key_.find(key);
        if (found == by_key_.end()) return;
        for (const std::size_t number : found->second) {
            pulse_();
            const Rule& rule = rules_[number];
            if (!applies(rule, node, classes)) continue;
            for (const Declaration& each : declarations_[rule.declarations]) {
                if (each.name != name) continue;
                const Rule& other = rules_[best_rule];
                const bool is_stronger =
                    !best || (each.is_important != best->is_important ? each.is_important
                              : rule.specificity != other.specificity ? rule.specificity > other.specificity
                                                                      : number >= best_rule);
                if (!is_stronger) continue;
                best = &each;
                best_rule = number;
            }
        }
    };
    consider("");
    consider(local_name(node.name()));
    for (const std::string_view each : classes) consider("." + std::string(each));
    if (const std::string_view id = node.attribute("id").value(); !id.empty()) consider("#" + std::string(id));
    return best;
}

std::string SvgStyle::property(pugi::xml_node node, const char* name) const {
    const Declaration* sheet = rules_.empty() ? nullptr : declared(node, name);
    if (!sheet) return svg_property(node, name);
    const auto own = own_declaration(node, name);
    return own && own->is_important >= sheet->is_important ? own->value : sheet->value;
}

}  // namespace sikku
