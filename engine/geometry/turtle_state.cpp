#include "engine/geometry/turtle_state.h"

#include <fmt/format.h>

namespace sikku {

void throw_at(std::uint64_t position, std::string_view what) {
    throw WordError(fmt::format("symbol {} of the word: {}", position, what));
}

}  // namespace sikku
