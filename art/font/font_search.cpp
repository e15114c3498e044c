// art/font/font_search.cpp: finds installed fonts with fontconfig.
#include "art/font/font_module.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace sikku {
namespace {

using FontPattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

/// The properties that select outlines.
constexpr std::array properties = {FC_FAMILY, FC_STYLE, FC_WEIGHT, FC_SLANT, FC_WIDTH};

/// The values of a property, such as the names of a family in several languages.
std::vector<std::string> texts_of(const FontPattern& pattern, const char* property) {
    std::vector<std::string> texts;
    FcChar8* text = nullptr;
    for (int i = 0; FcPatternGetString(pattern.get(), property, i, &text) == FcResultMatch; ++i) {
        texts.emplace_back(reinterpret_cast<const char*>(text));
    }
    return texts;
}

std::string first_text(const FontPattern& pattern, const char* property) {
    const std::vector<std::string> texts = texts_of(pattern, property);
    return texts.empty() ? "" : texts.front();
}

/// A name without blanks and in lower case, as fontconfig compares names.
std::string bare_name(const std::string& name) {
    std::string bare;
    for (const char byte : name) {
        if (byte != ' ') bare += static_cast<char>(byte >= 'A' && byte <= 'Z' ? byte - 'A' + 'a' : byte);
    }
    return bare;
}

/// True if nothing is requested, or if a requested name is one of those found.
bool has_requested_name(const FontPattern& wanted, const FontPattern& found, const char* property) {
    const std::vector<std::string> requested = texts_of(wanted, property), names = texts_of(found, property);
    return requested.empty() || std::any_of(requested.begin(), requested.end(), [&](const std::string& name) {
               return std::any_of(names.begin(), names.end(),
                                  [&](const std::string& other) { return bare_name(name) == bare_name(other); });
           });
}

/// True if a number is not requested, or found as requested.
bool has_requested_number(const FontPattern& wanted, const FontPattern& found, const char* property) {
    double requested = 0, number = 0;
    if (FcPatternGetDouble(wanted.get(), property, 0, &requested) != FcResultMatch) return true;
    return FcPatternGetDouble(found.get(), property, 0, &number) == FcResultMatch &&
           std::fabs(requested - number) < 0.5;
}

/// True if fontconfig would thicken or slant the outlines of another style.
bool is_synthetic(const FontPattern& found) {
    FcBool is_emboldened = FcFalse;
    FcMatrix* matrix = nullptr;
    FcPatternGetBool(found.get(), FC_EMBOLDEN, 0, &is_emboldened);
    return is_emboldened == FcTrue || FcPatternGetMatrix(found.get(), FC_MATRIX, 0, &matrix) == FcResultMatch;
}

/// Sets a language that is not requested, which would be that of the environment.
void set_english(const FontPattern& query, const char* property) {
    FcValue value{};
    if (FcPatternGet(query.get(), property, 0, &value) == FcResultMatch) return;
    FcPatternAddString(query.get(), property, reinterpret_cast<const FcChar8*>("en"));
}

bool is_as_wanted(const FontPattern& wanted, const FontPattern& found) {
    return !is_synthetic(found) && has_requested_name(wanted, found, FC_FAMILY) &&
           has_requested_name(wanted, found, FC_STYLE) && has_requested_number(wanted, found, FC_WEIGHT) &&
           has_requested_number(wanted, found, FC_SLANT) && has_requested_number(wanted, found, FC_WIDTH);
}

/// Place of the first of some characters that no backslash precedes; the size of the text if there is none.
std::size_t find_bare(std::string_view text, std::string_view characters) {
    std::size_t at = 0;
    while (at < text.size() && characters.find(text[at]) == std::string_view::npos) at += text[at] == '\\' ? 2 : 1;
    return std::min(at, text.size());
}

/// A text without blanks before it, which fontconfig passes over.
std::string without_indent(std::string_view text) {
    return std::string(text.substr(std::min(text.find_first_not_of(" \t\r\n\v\f"), text.size())));
}

const FcConstant* constant_of(const std::string& name) {
    return FcNameGetConstant(reinterpret_cast<const FcChar8*>(name.c_str()));
}

/// True if fontconfig reads a value: a text, a number, or a name of this property such as `bold`.
bool is_value(const std::string& value, const std::string& property) {
    if (property == FC_FAMILY || property == FC_STYLE) return !value.empty();
    if (const FcConstant* const constant = constant_of(value)) return constant->object == property;
    char* end = nullptr;
    std::strtod(value.c_str(), &end);
    return end != value.c_str() && *end == '\0';
}

/// True if a part such as `bold` or `weight=200` sets one of the properties; fontconfig passes over unknown ones.
bool is_known(const std::string& part) {
    const std::size_t end = find_bare(part, "=_");
    const FcConstant* const constant = end == part.size() ? constant_of(part) : nullptr;
    const std::string property = constant ? constant->object : part.substr(0, end);
    return std::find(properties.begin(), properties.end(), property) != properties.end() &&
           (constant || (end < part.size() && is_value(without_indent(part.substr(end + 1)), property)));
}

[[noreturn]] void refuse_several() {
    throw std::runtime_error(
        "the name of a font states several families or styles; expected one of each, such as 'Noto Serif:bold'");
}

/// True if a property is stated twice.
bool has_several(const FontPattern& wanted) {
    return std::any_of(properties.begin(), properties.end(), [&](const char* property) {
        FcValue second{};
        return FcPatternGet(wanted.get(), property, 1, &second) == FcResultMatch;
    });
}

/// Refuses names of which fontconfig would pass over a part, so that another font would do.
void check_parts(const std::string& name) {
    std::size_t at = find_bare(name, "-,:");
    if (at < name.size() && name[at] == '-') {
        throw std::runtime_error(
            "a size follows '-' in the name of a font; expected ':', such as 'Noto Serif:bold', or '\\-' for a "
            "hyphen");
    }
    if (find_bare(name, ",") < name.size()) refuse_several();
    while (at < name.size()) {
        const std::size_t begin = at + 1;
        at = begin + find_bare(std::string_view(name).substr(begin), ":");
        if (is_known(without_indent(std::string_view(name).substr(begin, at - begin)))) continue;
        throw std::runtime_error(
            "unknown property or value in the name of a font; expected family, style, weight, slant or width, such "
            "as 'Noto Serif:bold' or 'Noto Serif:weight=200'");
    }
}

}  // namespace

FoundFont find_font(const std::string& pattern) {
    check_parts(pattern);
    const FontPattern wanted(FcNameParse(reinterpret_cast<const FcChar8*>(pattern.c_str())), FcPatternDestroy);
    if (!wanted || texts_of(wanted, FC_FAMILY).empty()) {
        throw std::runtime_error("expected the name of an installed font, such as 'Noto Serif' or 'Noto Serif:bold'");
    }
    if (has_several(wanted)) refuse_several();
    const FontPattern query(FcPatternDuplicate(wanted.get()), FcPatternDestroy);
    if (!query) throw std::bad_alloc();
    set_english(query, FC_LANG);
    set_english(query, FC_NAMELANG);
    FcConfigSubstitute(nullptr, query.get(), FcMatchPattern);
    FcDefaultSubstitute(query.get());
    FcResult result = FcResultNoMatch;
    const FontPattern found(FcFontMatch(nullptr, query.get(), &result), FcPatternDestroy);
    FoundFont font;
    if (!found) return font;
    font.file = first_text(found, FC_FILE);
    FcPatternGetInteger(found.get(), FC_INDEX, 0, &font.index);
    font.variations = first_text(found, FC_FONT_VARIATIONS);
    font.name = first_text(found, FC_FAMILY);
    if (const std::string style = first_text(found, FC_STYLE); !style.empty()) font.name += ' ' + style;
    font.is_wanted = is_as_wanted(wanted, found);
    return font;
}

}  // namespace sikku
