#include "art/kolam/interlaced_frame.h"

#include <algorithm>
#include <cstddef>

namespace sikku {
namespace {

constexpr std::uint32_t nowhere = UINT32_MAX;  // for dots and layers

/// Kinds of bands, from the rim inwards.
enum class Band : std::uint8_t {
    wreath,    ///< one layer, each dot linked to the next
    scallops,  ///< a wreath, with the dots of the next layer as loops within it
    zigzag,    ///< two layers, linked to each other but not along themselves
    stars      ///< stars between two wreaths
};

std::uint32_t width_of(Band band) {
    return band == Band::wreath ? 1 : band == Band::stars ? 3 : 2;
}

/// Which gaps of a layer are crossed.
struct Layer {
    bool along = false;   ///< those between its dots
    bool across = false;  ///< those to the next layer inwards
};

/// Chooses bands.
class BandChoice {
public:
    /// @param loops  the kind of band two layers wide that suits the rim
    BandChoice(Band loops, SplitMix& chance) : loops_(loops), chance_(chance) {}

    /// Wreaths, and at random places among them one or more bands of another kind, with a wreath at least between any
    /// two.
    std::vector<Band> any(std::uint32_t width) {
        const Band kind = random_kind(width);
        if (kind == Band::wreath) return std::vector<Band>(width, kind);
        const std::uint32_t most = (width + 1) / (width_of(kind) + 1);
        const std::uint32_t least = (most + 1) / 2;
        const auto count = static_cast<std::uint32_t>(least + chance_.below(most - least + 1));
        std::vector<std::uint32_t> wreaths(count + 1, 1);  // before, between and after them
        wreaths.front() = wreaths.back() = 0;
        for (std::uint32_t left = width + 1 - count * (width_of(kind) + 1); left > 0; --left) {
            ++wreaths[chance_.below(wreaths.size())];
        }
        std::vector<Band> bands(wreaths[0], Band::wreath);
        for (std::uint32_t i = 1; i <= count; ++i) {
            bands.push_back(kind);
            bands.insert(bands.end(), wreaths[i], Band::wreath);
        }
        return bands;
    }
    /// Bands around a middle of many dots, which needs an even line around it.
    std::vector<Band> around_many(std::uint32_t width) {
        std::vector<Band> bands = any(width - 1);
        bands.push_back(Band::wreath);
        return bands;
    }

private:
    Band random_kind(std::uint32_t width) {
        if (width < 2) return Band::wreath;
        std::vector<Band> kinds = {loops_};
        if (width >= 4) kinds.push_back(Band::stars);  // stars are lively, and need a third wreath
        kinds.insert(kinds.end(), kinds.begin(), kinds.end());
        if (width <= 3) kinds.push_back(Band::wreath);  // more of them would be tedious
        return kinds[chance_.below(kinds.size())];
    }

    Band loops_;
    SplitMix& chance_;
};

/// The dot on a side of a dot, or nowhere.
std::uint32_t neighbour(const DotGrid& grid, std::uint32_t dot, std::uint32_t side) {
    const std::int32_t gap = grid.gap(dot, side);
    if (gap < 0) return nowhere;
    const GridGap& between = grid.gaps()[static_cast<std::size_t>(gap)];
    return between.from == dot ? between.to : between.from;
}

class Frame {
public:
    Frame(const DotGrid& grid, const std::vector<std::uint32_t>& layers, std::uint32_t width, GapStates& states)
        : grid_(grid), layers_(layers), width_(width), states_(states) {}

    void cross(const std::vector<Band>& bands, GridSymmetry symmetry) {
        std::vector<Layer> crossed;
        for (const Band band : bands) append(band, crossed);
        for (std::size_t i = 0; i < states_.size(); ++i) {
            const GridGap& gap = grid_.gaps()[i];
            const std::uint32_t from = layers_[gap.from], to = layers_[gap.to], outer = std::min(from, to);
            if (outer >= width_) continue;
            if (from == to ? crossed[outer].along : crossed[outer].across) states_[i] = GapState::crossed;
        }
        std::vector<std::uint32_t> orbits;
        if (std::find(bands.begin(), bands.end(), Band::stars) != bands.end()) orbits = dot_orbits(grid_, symmetry);
        std::uint32_t layer = 0;
        for (const Band band : bands) {
            if (band == Band::stars) cross_stars(layer + 1, orbits);
            layer += width_of(band);
        }
        link_corners();
    }

private:
    static void append(Band band, std::vector<Layer>& layers) {
        switch (band) {
            case Band::wreath:
                layers.insert(layers.end(), {{true, false}});
                break;
            case Band::scallops:
                layers.insert(layers.end(), {{true, true}, {false, false}});
                break;
            case Band::zigzag:
                layers.insert(layers.end(), {{false, true}, {false, false}});
                break;
            case Band::stars:
                layers.insert(layers.end(), {{true, false}, {false, false}, {true, false}});
                break;
        }
    }

    /// Crosses all gaps around dots of a layer, as many as have no neighbour in common, beginning with the first;
    /// then those between the others of this layer.
    void cross_stars(std::uint32_t layer, const std::vector<std::uint32_t>& orbits) {
        std::vector<char> is_taken(orbits.size());
        for (const std::vector<std::uint32_t>& orbit : orbits_of(layer, orbits)) {
            if (!take_stars(orbit, layer, is_taken)) continue;
            for (const std::uint32_t dot : orbit) cross_all(dot);
        }
        GapStates linked = states_;
        for (std::size_t i = 0; i < linked.size(); ++i) {
            const GridGap& gap = grid_.gaps()[i];
            if (layers_[gap.from] != layer || layers_[gap.to] != layer) continue;
            if (is_lonely(grid_, gap.from, states_) && is_lonely(grid_, gap.to, states_))
                linked[i] = GapState::crossed;
        }
        states_ = std::move(linked);
    }
    /// The dots of a layer by orbit, in the order of their first dots.
    std::vector<std::vector<std::uint32_t>> orbits_of(std::uint32_t layer,
                                                      const std::vector<std::uint32_t>& orbits) const {
        std::vector<std::vector<std::uint32_t>> members;
        std::vector<std::uint32_t> numbers(orbits.size(), nowhere);  // by orbit
        for (std::uint32_t dot = 0; dot < orbits.size(); ++dot) {
            if (layers_[dot] != layer) continue;
            std::uint32_t& number = numbers[orbits[dot]];
            if (number == nowhere) {
                number = static_cast<std::uint32_t>(members.size());
                members.emplace_back();
            }
            members[number].push_back(dot);
        }
        return members;
    }
    /// Marks these dots and their neighbours; none, and returns false, if one of them is missing, marked, or in a
    /// layer further away.
    bool take_stars(const std::vector<std::uint32_t>& middles, std::uint32_t layer, std::vector<char>& marks) const {
        std::vector<std::uint32_t> taken;
        const auto take = [&](std::uint32_t dot) {
            if (dot == nowhere || marks[dot] || layers_[dot] + 1 < layer || layers_[dot] > layer + 1) return false;
            marks[dot] = 1;
            taken.push_back(dot);
            return true;
        };
        const bool has_room = std::all_of(middles.begin(), middles.end(), [&](std::uint32_t middle) {
            bool is_free = take(middle);
            for (std::uint32_t side = 0; side < grid_.sides() && is_free; ++side) {
                is_free = take(neighbour(grid_, middle, side));
            }
            return is_free;
        });
        if (!has_room) {
            for (const std::uint32_t dot : taken) marks[dot] = 0;
        }
        return has_room;
    }
    void cross_all(std::uint32_t dot) {
        for (std::uint32_t side = 0; side < grid_.sides(); ++side) {
            const std::int32_t gap = grid_.gap(dot, side);
            if (gap >= 0) states_[static_cast<std::size_t>(gap)] = GapState::crossed;
        }
    }
    /// Links dots of the rim that no band reaches, such as sharp corners.
    void link_corners() {
        std::vector<std::uint32_t> corners;
        for (std::uint32_t dot = 0; dot < layers_.size(); ++dot) {
            if (layers_[dot] == 0 && is_lonely(grid_, dot, states_)) corners.push_back(dot);
        }
        for (const std::uint32_t dot : corners) cross_all(dot);
    }

    const DotGrid& grid_;
    const std::vector<std::uint32_t>& layers_;
    std::uint32_t width_;
    GapStates& states_;
};

/// True if a dot of the rim has no neighbour in the next layer.
bool has_sharp_corners(const DotGrid& grid, const std::vector<std::uint32_t>& layers) {
    for (std::uint32_t dot = 0; dot < layers.size(); ++dot) {
        bool is_sharp = layers[dot] == 0;
        for (std::uint32_t side = 0; side < grid.sides() && is_sharp; ++side) {
            const std::uint32_t other = neighbour(grid, dot, side);
            is_sharp = other == nowhere || layers[other] == 0;
        }
        if (is_sharp) return true;
    }
    return false;
}

}  // namespace

bool is_lonely(const DotGrid& grid, std::uint32_t dot, const GapStates& states) {
    for (std::uint32_t side = 0; side < grid.sides(); ++side) {
        const std::int32_t gap = grid.gap(dot, side);
        if (gap >= 0 && states[static_cast<std::size_t>(gap)] != GapState::turned) return false;
    }
    return true;
}

std::vector<std::uint32_t> dot_layers(const DotGrid& grid) {
    std::vector<std::uint32_t> layers(grid.dots().size(), nowhere);
    std::vector<std::uint32_t> order;
    for (std::uint32_t dot = 0; dot < layers.size(); ++dot) {
        for (std::uint32_t side = 0; side < grid.sides() && layers[dot] != 0; ++side) {
            if (grid.gap(dot, side) < 0) layers[dot] = 0;
        }
        if (layers[dot] == 0) order.push_back(dot);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::uint32_t side = 0; side < grid.sides(); ++side) {
            const std::uint32_t other = neighbour(grid, order[i], side);
            if (other == nowhere || layers[other] != nowhere) continue;
            layers[other] = layers[order[i]] + 1;
            order.push_back(other);
        }
    }
    return layers;
}

void cross_frame(const DotGrid& grid, GridSymmetry symmetry, const std::vector<std::uint32_t>& layers,
                 std::uint32_t width, SplitMix& chance, GapStates& states) {
    constexpr std::ptrdiff_t many = 40;
    // Zigzags would lean at sharp corners.
    BandChoice choice(has_sharp_corners(grid, layers) ? Band::scallops : Band::zigzag, chance);
    const std::ptrdiff_t within =
        std::count_if(layers.begin(), layers.end(), [&](std::uint32_t layer) { return layer >= width; });
    Frame(grid, layers, width, states)
        .cross(within >= many ? choice.around_many(width) : choice.any(width), symmetry);
}

}  // namespace sikku
