// engine/language/function_names.h: the functions of expressions, for help and syntax highlighting.
#pragma once

#include <string_view>
#include <vector>

namespace sikku {

/// The names of the functions that expressions can call, in the order of the manual.
std::vector<std::string_view> function_names();

}  // namespace sikku
