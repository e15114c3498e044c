// art/font/text_runs.h: cuts a line of text into runs of one script and one direction.
#pragma once

#include <hb.h>

#include <cstddef>
#include <span>
#include <vector>

namespace sikku {

/// Code points of one script and one direction.
struct TextRun {
    std::size_t begin = 0, count = 0;
    hb_script_t script = HB_SCRIPT_COMMON;
    bool is_leftward = false;
};
/// The runs of a line from left to right. The first letter with a direction sets that of the line.
/// Source: Unicode Standard Annex #9.
std::vector<TextRun> runs_of(std::span<const hb_codepoint_t> codes);

}  // namespace sikku
