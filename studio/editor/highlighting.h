// studio/editor/highlighting.h: grammars for syntax highlighting, made from the tables of the language.
#pragma once

#include <string>

namespace sikku {

/// A TextMate grammar in JSON, for VS Code and other editors.
std::string textmate_grammar();

/// A syntax file for Vim and Neovim.
std::string vim_syntax();

}  // namespace sikku
