#include "art/print/recipe_comments.h"
#include "art/provenance/provenance_readers.h"

#include <algorithm>

namespace sikku {
namespace {

/// Maximum size of the comments of a recipe, with their marks and the bytes around them.
constexpr std::uint64_t most_bytes = 3 * most_commented_bytes;

}  // namespace

std::optional<Provenance> read_comment_provenance(const InputFile& file) {
    const std::uint64_t tail = file.size() - std::min(file.size(), most_bytes);
    for (const std::uint64_t begin : {std::uint64_t{0}, tail}) {
        if (auto found = read_recipe_comments(file.read(begin, most_bytes))) {
            return Provenance{std::move(found->first), std::move(found->second)};
        }
    }
    return std::nullopt;
}

}  // namespace sikku
