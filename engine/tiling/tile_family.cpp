#include "engine/tiling/tile_family.h"

#include "engine/tiling/polygon_place.h"

#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace sikku {
namespace {

/// Adds a mass to a sum.
void add(PolygonMass& sum, const PolygonMass& mass) {
    const double area = sum.area + mass.area;
    if (area > 0) sum.centre = (sum.centre * sum.area + mass.centre * mass.area) / area;
    sum.area = area;
}

/// A turn and a scale.
struct Turn {
    glm::dvec2 factor{1.0, 0.0};

    glm::dvec2 operator()(glm::dvec2 at) const { return complex_product(factor, at); }
    glm::dmat3x2 map(glm::dvec2 shift) const { return {factor, {-factor.y, factor.x}, shift}; }
};

/// Pairs of places that a map should bring together, with weights.
struct Pair {
    glm::dvec2 from, to;
    double weight;
};

struct Means {
    glm::dvec2 from{0.0}, to{0.0};
    double weight = 0;
    explicit Means(const std::vector<Pair>& pairs) {
        for (const Pair& pair : pairs) {
            from += pair.from * pair.weight;
            to += pair.to * pair.weight;
            weight += pair.weight;
        }
        if (weight > 0) {
            from /= weight;
            to /= weight;
        }
    }
};

/// The mean squared distance that remains.
double remainder(const std::vector<Pair>& pairs, const glm::dmat3x2& map) {
    double sum = 0, weight = 0;
    for (const Pair& pair : pairs) {
        const glm::dvec2 gap = map * glm::dvec3(pair.from, 1) - pair.to;
        sum += scalar_product(gap, gap) * pair.weight;
        weight += pair.weight;
    }
    return weight > 0 ? sum / weight : 0;
}

/// The turn and scale that bring pairs together by least squares; nullopt if there are too few.
std::optional<Turn> best_turn(const std::vector<Pair>& pairs) {
    constexpr std::size_t fewest = 6;
    if (pairs.size() < fewest) return std::nullopt;
    const Means mean(pairs);
    glm::dvec2 sum(0.0);
    double square = 0;
    for (const Pair& pair : pairs) {
        const glm::dvec2 from = pair.from - mean.from;
        sum += complex_product(pair.to - mean.to, {from.x, -from.y}) * pair.weight;
        square += scalar_product(from, from) * pair.weight;
    }
    if (!(square > 0)) return std::nullopt;
    return Turn{sum / square};
}

/// The parts of each symbol of the word before, and the tiles that it draws.
struct Family {
    std::vector<std::uint32_t> parents, parts;
    PolygonMass parents_mass, parts_mass;
};

std::vector<PolygonMass> masses_of(const PolygonList& polygons) {
    std::vector<PolygonMass> masses;
    masses.reserve(polygons.size());
    for (std::size_t i = 0; i < polygons.size(); ++i) masses.push_back(mass_of(polygons.polygon(i)));
    return masses;
}

class DivisionFinder {
public:
    DivisionFinder(const TileGeneration& before, const TileGeneration& after, const Monitor& monitor)
        : before_(before), after_(after), pulse_(monitor) {
        before_masses_ = masses_of(before.polygons);
        after_masses_ = masses_of(after.polygons);
        for (std::uint32_t i = 0; i < before.symbol.size(); ++i) {
            Family& family = families_[before.symbol[i]];
            family.parents.push_back(i);
            add(family.parents_mass, before_masses_[i]);
        }
        for (std::uint32_t i = 0; i < after.parent.size(); ++i) {
            Family& family = families_[after.parent[i]];
            family.parts.push_back(i);
            add(family.parts_mass, after_masses_[i]);
            area_ += after_masses_[i].area / static_cast<double>(after.parent.size());
        }
        for (const auto& [symbol, family] : families_) {
            if (family.parents.empty() || family.parts.empty()) continue;
            pairs_.push_back({family.parents_mass.centre, family.parts_mass.centre, family.parts_mass.area});
        }
    }

    std::optional<Turn> turn() const { return best_turn(pairs_); }
    /// Without a turn, lengths grow as the root of the area.
    Turn growth() const {
        double parents = 0, parts = 0;
        for (const PolygonMass& mass : before_masses_) parents += mass.area;
        for (const PolygonMass& mass : after_masses_) parts += mass.area;
        return {{parents > 0 && parts > 0 ? std::sqrt(parts / parents) : 1.0, 0}};
    }

    /// @param is_exact  the turn keeps the start of the turtle in its place
    TileDivision division(const Turn& turn, bool is_exact) {
        const Means mean(pairs_);
        const glm::dmat3x2 shifted = turn.map(pairs_.empty() ? glm::dvec2(0.0) : mean.to - turn(mean.from));
        // Parts that surround the corner of their parent are all shifted alike.
        const bool is_shift = !is_exact || remainder(pairs_, shifted) < 1e-12 * area_;
        result_.map = is_shift ? shifted : turn.map(glm::dvec2(0.0));
        double spread = 0;
        for (const Pair& pair : pairs_) {
            const glm::dvec2 way = pair.to - mean.to;
            spread += scalar_product(way, way) * pair.weight / mean.weight;
        }
        if (!is_exact && spread > 0) result_.deviation = std::sqrt(remainder(pairs_, result_.map) / spread);
        find_parents();
        find_middles();
        find_share();
        find_inside();
        return std::move(result_);
    }

private:
    glm::dvec2 mapped(glm::dvec2 at) const { return result_.map * glm::dvec3(at, 1); }

    glm::dmat3x2 inverse() const {
        const glm::dmat2x2 turn = glm::inverse(glm::dmat2x2(result_.map[0], result_.map[1]));
        return {turn[0], turn[1], -(turn * result_.map[2])};
    }

    /// Counts the points of a part in each tile.
    void count(std::uint32_t part, const PolygonFinder& finder, const glm::dmat3x2& back,
               std::map<std::uint32_t, double>& votes) {
        const auto points = points_within(after_.polygons.polygon(part));
        for (const glm::dvec2 point : points) {
            const std::uint32_t tile = finder.at(back * glm::dvec3(point, 1));
            if (tile != no_number) votes[tile] += after_masses_[part].area / static_cast<double>(points.size());
        }
    }
    static std::uint32_t most_voted(const std::map<std::uint32_t, double>& votes) {
        std::uint32_t best = no_number;
        double most = 0;
        for (const auto& [tile, number] : votes) {
            if (number > most * (1 + 1e-9)) {
                most = number;
                best = tile;
            }
        }
        return best;
    }

    void find_parents() {
        result_.parent.assign(after_.parent.size(), no_number);
        const PolygonFinder finder(before_.polygons);
        const glm::dmat3x2 back = inverse();
        std::map<std::uint32_t, double> votes;
        for (const auto& entry : families_) {
            const auto& family = entry.second;
            votes.clear();
            for (const std::uint32_t part : family.parts) {
                pulse_();
                if (family.parents.size() == 1) {
                    result_.parent[part] = family.parents.front();
                } else if (family.parents.empty()) {
                    count(part, finder, back, votes);
                } else {
                    votes.clear();
                    count(part, finder, back, votes);
                    std::erase_if(votes, [&](const auto& vote) {
                        return std::find(family.parents.begin(), family.parents.end(), vote.first) ==
                               family.parents.end();
                    });
                    const std::uint32_t best = most_voted(votes);
                    result_.parent[part] = best == no_number ? nearest(family.parents, part) : best;
                }
            }
            if (!family.parents.empty()) continue;
            const std::uint32_t best = most_voted(votes);
            for (const std::uint32_t part : family.parts) result_.parent[part] = best;
        }
    }

    std::uint32_t nearest(const std::vector<std::uint32_t>& parents, std::uint32_t part) const {
        const auto distance = [&](std::uint32_t parent) {
            const glm::dvec2 way = mapped(before_masses_[parent].centre) - after_masses_[part].centre;
            return scalar_product(way, way);
        };
        return *std::min_element(parents.begin(), parents.end(),
                                 [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
    }

    void find_middles() {
        parts_of_.assign(before_.symbol.size(), {});
        sums_.assign(before_.symbol.size(), {});
        for (std::uint32_t part = 0; part < result_.parent.size(); ++part) {
            if (result_.parent[part] == no_number) continue;
            parts_of_[result_.parent[part]].push_back(part);
            add(sums_[result_.parent[part]], after_masses_[part]);
        }
        for (std::uint32_t part = 0; part < result_.parent.size(); ++part) {
            const std::uint32_t parent = result_.parent[part];
            const glm::dvec2 family =
                parent == no_number ? families_.at(after_.parent[part]).parts_mass.centre : sums_[parent].centre;
            result_.family_middle.push_back(family);
            result_.parent_middle.push_back(parent == no_number ? family : mapped(before_masses_[parent].centre));
        }
    }

    void find_share() {
        constexpr double rounding = 1e-6;
        const double growth = std::fabs(glm::determinant(glm::dmat2x2(result_.map[0], result_.map[1])));
        const double margin = rounding * std::sqrt(area_);
        result_.is_cut = true;
        std::vector<glm::dvec2> outline;
        for (std::uint32_t parent = 0; parent < parts_of_.size(); ++parent) {
            if (parts_of_[parent].empty()) continue;
            outline.clear();
            for (const glm::dvec2 corner : before_.polygons.polygon(parent)) outline.push_back(mapped(corner));
            const double area = before_masses_[parent].area * growth;
            result_.is_cut = result_.is_cut && std::fabs(sums_[parent].area - area) <= rounding * area;
            const glm::dvec2 middle = mapped(before_masses_[parent].centre);
            while (result_.share > TileDivision::least_share && !has_room(parent, outline, middle, margin)) {
                result_.is_cut = false;
                result_.share = std::max(result_.share - 0.05, TileDivision::least_share);
            }
        }
    }

    /// True if the parts of a parent, made smaller around their common middle, lie within it.
    bool has_room(std::uint32_t parent, const std::vector<glm::dvec2>& outline, glm::dvec2 middle, double margin) {
        for (const std::uint32_t part : parts_of_[parent]) {
            for (const glm::dvec2 corner : after_.polygons.polygon(part)) {
                pulse_();
                if (!contains(outline, middle + result_.share * (corner - sums_[parent].centre), margin))
                    return false;
            }
        }
        return true;
    }

    void find_inside() {
        const glm::dmat3x2 back = inverse();
        double inside = 0, area = 0;
        for (std::uint32_t part = 0; part < result_.parent.size(); ++part) {
            if (result_.parent[part] == no_number) continue;
            const auto parent = before_.polygons.polygon(result_.parent[part]);
            const auto points = points_within(after_.polygons.polygon(part));
            const double each = after_masses_[part].area / static_cast<double>(points.size());
            for (const glm::dvec2 point : points) {
                pulse_();
                area += each;
                if (contains(parent, back * glm::dvec3(point, 1))) inside += each;
            }
        }
        result_.inside = area > 0 ? inside / area : 1;
    }

    const TileGeneration& before_;
    const TileGeneration& after_;
    Pulse pulse_;
    std::vector<PolygonMass> before_masses_, after_masses_;
    std::map<std::uint32_t, Family> families_;  // by symbol of the word before
    std::vector<Pair> pairs_;
    double area_ = 0;  // mean area of a part
    TileDivision result_;
    std::vector<std::vector<std::uint32_t>> parts_of_;  // parts of each tile before
    std::vector<PolygonMass> sums_;
};

}  // namespace

std::vector<TileDivision> tile_divisions(const std::vector<TileGeneration>& generations,
                                         const std::optional<glm::dvec2>& factor, const Monitor& monitor) {
    std::vector<DivisionFinder> finders;
    for (std::size_t i = 0; i + 1 < generations.size(); ++i) {
        finders.emplace_back(generations[i], generations[i + 1], monitor);
    }
    // Generations of few tiles grow like the next one.
    std::optional<Turn> turn;
    if (factor) turn = Turn{*factor};
    std::vector<TileDivision> divisions(finders.size());
    for (std::size_t i = finders.size(); i-- > 0;) {
        monitor.check();
        if (!factor) {
            if (const auto own = finders[i].turn()) turn = own;
        }
        divisions[i] = finders[i].division(turn ? *turn : finders[i].growth(), factor.has_value());
    }
    return divisions;
}

}  // namespace sikku
