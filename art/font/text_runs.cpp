#include "art/font/text_runs.h"

#include <fribidi.h>

#include <algorithm>
#include <cstdint>
#include <new>

namespace sikku {
namespace {

static_assert(sizeof(FriBidiChar) == sizeof(hb_codepoint_t));

/// Levels of embedding; odd ones run from right to left.
std::vector<FriBidiLevel> levels_of(std::span<const hb_codepoint_t> codes) {
    const auto length = static_cast<FriBidiStrIndex>(codes.size());
    std::vector<FriBidiCharType> types(codes.size());
    std::vector<FriBidiBracketType> brackets(codes.size());
    std::vector<FriBidiLevel> levels(codes.size());
    fribidi_get_bidi_types(codes.data(), length, types.data());
    fribidi_get_bracket_types(codes.data(), length, types.data(), brackets.data());
    FriBidiParType direction = FRIBIDI_PAR_ON;
    if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), length, &direction, levels.data()) == 0) {
        throw std::bad_alloc();
    }
    return levels;
}

/// Scripts of letters; signs that all scripts share, and marks, have that of the letters before them.
std::vector<hb_script_t> scripts_of(std::span<const hb_codepoint_t> codes) {
    hb_unicode_funcs_t* const unicode = hb_unicode_funcs_get_default();
    std::vector<hb_script_t> scripts;
    for (const hb_codepoint_t code : codes) scripts.push_back(hb_unicode_script(unicode, code));
    const auto is_shared = [](hb_script_t script) {
        return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
    };
    const auto first = std::find_if_not(scripts.begin(), scripts.end(), is_shared);
    hb_script_t last = first == scripts.end() ? HB_SCRIPT_LATIN : *first;
    for (hb_script_t& script : scripts) {
        if (is_shared(script)) script = last;
        last = script;
    }
    return scripts;
}

}  // namespace

std::vector<TextRun> runs_of(std::span<const hb_codepoint_t> codes) {
    std::vector<TextRun> runs;
    if (codes.empty()) return runs;
    const std::vector<FriBidiLevel> levels = levels_of(codes);
    const std::vector<hb_script_t> scripts = scripts_of(codes);
    std::vector<FriBidiLevel> run_levels;
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (runs.empty() || levels[i] != run_levels.back() || scripts[i] != runs.back().script) {
            runs.push_back({i, 0, scripts[i], levels[i] % 2 == 1});
            run_levels.push_back(levels[i]);
        }
        ++runs.back().count;
    }
    // Rule L2: from the highest level down, runs of at least that level are reversed.
    const FriBidiLevel highest = *std::max_element(run_levels.begin(), run_levels.end());
    for (FriBidiLevel level = highest; level > 0; --level) {
        for (std::size_t begin = 0; begin < runs.size(); ++begin) {
            std::size_t end = begin;
            while (end < runs.size() && run_levels[end] >= level) ++end;
            std::reverse(runs.begin() + static_cast<std::ptrdiff_t>(begin),
                         runs.begin() + static_cast<std::ptrdiff_t>(end));
            std::reverse(run_levels.begin() + static_cast<std::ptrdiff_t>(begin),
                         run_levels.begin() + static_cast<std::ptrdiff_t>(end));
            begin = end;
        }
    }
    return runs;
}

}  // namespace sikku
