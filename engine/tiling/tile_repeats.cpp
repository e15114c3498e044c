#include "engine/tiling/tile_repeats.h"

#include "engine/derivation/levels.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace sikku {

TileRepeats::TileRepeats(const Grammar& grammar, Turtle& turtle, TileCollector& collector, const Monitor& monitor)
    : symbols_(grammar.symbols().size()), turtle_(turtle), collector_(collector), monitor_(monitor) {
    constexpr std::int64_t most_levels = 64, most_numbers = std::int64_t{1} << 18;
    const Levels levels(grammar, true);
    const std::int64_t count =
        std::min({levels.count(), most_numbers / static_cast<std::int64_t>(symbols_ + 1), most_levels});
    for (const SymbolInfo& symbol : grammar.symbols()) {
        polygons_.push_back(symbol.command.action == Action::polygon_end ? 1.0 : 0.0);
        lengths_.push_back(1.0);
    }
    for (std::int64_t level = 1; level <= count; ++level) {
        const std::size_t below = polygons_.size() - symbols_;
        const Table& table = levels.table(level);
        for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
            const Word* successor = table.successor(symbol);
            double polygons = successor ? 0.0 : polygons_[below + symbol];
            double length = successor ? 0.0 : lengths_[below + symbol];
            if (successor) {
                for (const Symbol child : *successor) {
                    polygons += polygons_[below + child];
                    length += lengths_[below + child];
                }
            }
            polygons_.push_back(polygons);
            lengths_.push_back(length);
        }
    }
}

bool TileRepeats::is_worthwhile(Symbol symbol, std::int64_t level) const {
    const std::size_t at = static_cast<std::size_t>(level) * symbols_ + symbol;
    if (at >= polygons_.size()) return false;
    if (polygons_[at] > 0) return polygons_[at] >= least_tiles && polygons_[at] <= most_tiles;
    return lengths_[at] >= least_moves && lengths_[at] <= most_moves;
}

bool TileRepeats::passes_over(Symbol symbol, std::int64_t level) {
    if (begun_) {
        if (level < level_) return false;
        end();
    }
    if (!is_worthwhile(symbol, level)) return false;
    const auto here = turtle_.stand();
    if (!here) return false;
    const Key key{symbol, level, here->heading, here->pen.colour};
    const auto found = parts_.find(key);
    if (found == parts_.end()) {
        if (kept_ < most_kept && parts_.size() < most_parts) begin(parts_[key], level, *here);
        return false;
    }
    const Part& part = found->second;
    if (!part.is_usable) return false;
    if (part.tiles) collector_.add_part(*part.tiles, here->coordinates);
    TurtleStand there = part.end;
    for (std::size_t i = 0; i < there.coordinates.size(); ++i) there.coordinates[i] += here->coordinates[i];
    there.position += here->position;
    there.pen = here->pen;  // tiles have no widths
    there.pen.colour = part.end.pen.colour;
    turtle_.skip_to(there);
    monitor_.advance(part.end.position);
    return true;
}

void TileRepeats::begin(Part& part, std::int64_t level, const TurtleStand& here) {
    begun_ = &part;
    level_ = level;
    start_ = here;
    mark_ = collector_.mark();
    turtle_.lowest_depth();
}

void TileRepeats::end() {
    Part& part = *std::exchange(begun_, nullptr);
    const auto here = turtle_.stand();
    const std::int64_t lowest = turtle_.lowest_depth();
    if (!here || here->depth != start_.depth || lowest < start_.depth) return;
    const TileMark mark = collector_.mark();
    if (mark.polygons > mark_.polygons) {
        part.tiles = collector_.keep_part(mark_, start_.coordinates);
        if (!part.tiles) return;
        kept_ += mark.tiles - mark_.tiles;
    }
    part.end = *here;
    for (std::size_t i = 0; i < here->coordinates.size(); ++i) {
        part.end.coordinates[i] -= start_.coordinates[i];
        if (std::abs(part.end.coordinates[i]) > farthest) return;
    }
    part.end.position -= start_.position;
    part.is_usable = true;
}

}  // namespace sikku
