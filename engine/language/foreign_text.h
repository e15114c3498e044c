// engine/language/foreign_text.h: recognises texts that were written for other programs.
#pragma once

#include <cstdint>
#include <string_view>

namespace sikku {

/// The program that a text that is not a pattern was written for.
enum class ForeignKind : std::uint8_t { none, fractint, cpfg, lpfg, lpy, html };

/// Recognises systems by their first lines: `Lsystem:` of cpfg, entries `NAME {` with an axiom of Fractint, modules
/// of lpfg, `produce` in Python of L-Py, tags of HTML. Cost: linear.
ForeignKind foreign_kind(std::string_view text);

/// True if the text has a line `NAME {` outside of comments, as Fractint's entries begin. Cost: linear.
bool has_fractint_entry(std::string_view text);

/// Describes the kind, for messages: `a Fractint collection of L-systems`.
std::string_view foreign_kind_name(ForeignKind kind);

}  // namespace sikku
