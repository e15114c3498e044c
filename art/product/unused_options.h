// art/product/unused_options.h: options that a print accepts but that have no effect.
#pragma once

#include "art/product/draw_settings.h"
#include "art/writer/draw_options.h"
#include "engine/base/option.h"
#include "engine/interpreter.h"
#include "engine/language/document.h"
#include "engine/language/grammar.h"

#include <set>
#include <string>

namespace sikku {

/// A print and the options that were given for it.
struct GivenOptions {
    std::set<std::string, std::less<>> names;
    bool has_pixels = false;  ///< a length in the options or in the pattern is in px
    RecipeOptions recipe{};   ///< those that set no key
    bool has(std::string_view name) const { return names.contains(name); }
};

/// @param pattern  the text of the pattern
/// @param keys  set by some of the values
GivenOptions given_options(const OptionValues& values, const std::vector<Setting>& keys, const std::string& pattern);

/// True if warn_of_unused() needs the contents of the drawing.
bool needs_contents(const GivenOptions& given);

/// The contents of a drawing in space, whose facets have shades of all colours: by the symbols that may occur.
Contents contents_in_space(const Grammar& grammar);

/// Warns of each option that has no effect on this print: `'arcs' has no effect: the drawing has no curves`. Effects
/// that other warnings report are left out.
/// @param report  of the drawing, if one was made; a default one otherwise
void warn_of_unused(const GivenOptions& given, const DrawSettings& settings, const Style& style, PrintFormat format,
                    bool is_spatial, const DrawReport& report, Made& made);

/// Names of the options that have no effect on prints of a document in a format, as far as this is known before it is
/// drawn. @throws PatternError
std::set<std::string> options_without_effect(const Document& document, const DrawSettings& settings,
                                             PrintFormat format);

}  // namespace sikku
