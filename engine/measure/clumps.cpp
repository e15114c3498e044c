#include "engine/measure/clumps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sikku {
namespace {

constexpr float small_share = 1.0F / 16;

}  // namespace

Clumps::Clumps(const Grammar& grammar, const Parts<double>& parts) : itself_(grammar.symbols().size()) {
    std::iota(itself_.begin(), itself_.end(), Symbol{0});
    below_.resize(parts.all().size());

    struct Child {
        const Symbol* symbol;
        const DrawnPart<double>* part;  // null: a bracket
        std::uint32_t heading;
    };
    std::vector<Child> children;
    std::vector<std::uint32_t> open;
    const auto add_word = [&](std::span<const Symbol> word, int level, std::uint32_t heading) {
        children.clear();
        float largest = 0;
        for (const Symbol& symbol : word) {
            if (grammar.is_push(symbol)) {
                open.push_back(heading);
                children.push_back({&symbol, nullptr, heading});
                continue;
            }
            if (grammar.is_pop(symbol)) {
                heading = open.back();
                open.pop_back();
                children.push_back({&symbol, nullptr, heading});
                continue;
            }
            // Composed in a heading that does not occur; the result is not used.
            if (!parts.occurs(level, heading)) break;
            const DrawnPart<double>& part = parts.part(symbol, level, heading);
            largest = std::max(largest, part.extent);
            children.push_back({&symbol, &part, heading});
            heading = (heading + part.turn) % parts.headings();
        }
        open.clear();
        const float small = largest * small_share;
        bool joins = false;      // the last clump may be extended
        bool has_large = false;  // the last clump contains a large part
        for (const Child& child : children) {
            const bool stands_alone =
                !child.part || (!child.part->draws() && (child.part->x != 0 || child.part->y != 0));
            const bool is_large = child.part && child.part->extent > small;
            if (stands_alone || !joins || (is_large && has_large)) {
                clumps_.push_back({child.symbol, child.symbol, {}});
                has_large = false;
            }
            joins = !stands_alone;
            has_large = has_large || is_large;
            Clump& clump = clumps_.back();
            clump.end = child.symbol + 1;
            if (!child.part) continue;
            clump.part.append(*child.part);
            clump.part.turn = (clump.part.turn + child.part->turn) % parts.headings();
            clump.part.returns =
                clump.part.draws() && std::hypot(clump.part.x, clump.part.y) < 0.5 * clump.part.extent;
        }
    };

    for (int level = 1; level <= parts.levels(); ++level) {
        for (std::uint32_t heading = 0; heading < parts.headings(); ++heading) {
            if (!parts.occurs(level, heading)) continue;
            for (const Symbol& symbol : itself_) {
                const std::size_t index = parts.index(symbol, level, heading);
                if (!parts.all()[index].draws()) continue;
                const auto first = static_cast<std::uint32_t>(clumps_.size());
                const Word* successor = parts.successor(symbol, level);
                add_word(successor ? std::span<const Symbol>(*successor) : std::span(&symbol, 1), level - 1, heading);
                below_[index] = {first, static_cast<std::uint32_t>(clumps_.size()) - first};
            }
        }
    }
}

}  // namespace sikku
