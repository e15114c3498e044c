// studio/editor/highlighting.h: grammars for the highlighting of editors, made from the tables of the language.
#pragma once

#include <string>

namespace sikku {

/// A TextMate grammar as JSON, which VS Code and other editors read.
std::string textmate_grammar();

/// A syntax file of Vim.
std::string vim_syntax();

}  // namespace sikku
