// art/font/font_search.cpp: finds installed fonts with fontconfig.
#include "art/font/font_module.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

using FontPattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

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

}  // namespace

FoundFont find_font(const std::string& pattern) {
    const FontPattern wanted(FcNameParse(reinterpret_cast<const FcChar8*>(pattern.c_str())), FcPatternDestroy);
    if (!wanted || texts_of(wanted, FC_FAMILY).empty()) {
        throw std::runtime_error("expected the name of an installed font, such as 'Noto Serif' or 'Noto Serif:bold'");
    }
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
