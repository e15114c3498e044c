#include "engine/map/map_step.h"

#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sikku {

/// Makes one derivation step.
class MapStepper {
public:
    MapStepper(const Map& map, const MapSystem& system, std::uint32_t table, MapOrigins& origins,
               const Monitor& monitor)
        : old_(map),
          system_(system),
          table_(table),
          origins_(origins),
          pulse_(monitor),
          nearest_(2 * system.labels.size(), nobody) {}

    Map run(std::uint32_t step, const MapForecast& forecast) {
        step_ = step;
        const auto edges = static_cast<std::size_t>(forecast.edges + forecast.walls);
        map_.edges_.reserve(edges);
        map_.half_edges_.reserve(2 * edges);
        replace_edges();
        map_.ends_.reserve(2 * old_.cells() + 1);
        origins_.first_cell.clear();
        for (std::size_t cell = 0; cell < old_.cells(); ++cell) {
            origins_.first_cell.push_back(static_cast<std::uint32_t>(map_.ends_.size()));
            walk(old_.cell(cell));
            divide();
            pulse_();
        }
        origins_.first_cell.push_back(static_cast<std::uint32_t>(map_.ends_.size()));
        walk(old_.outer());
        branches_.clear();
        divide();
        return std::move(map_);
    }

private:
    static constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

    /// A branch of the current cell.
    struct Branch {
        std::uint32_t at = 0;  ///< number of half-edges of the wall before it
        std::uint32_t vertex = 0;
        std::uint32_t bucket = 0;  ///< twice the label, plus 1 if it points towards the edge
        std::uint32_t partner = nobody;
    };

    /// A daughter that is still to be made, between two matching branches and along the new wall.
    struct Daughter {
        std::uint32_t first = 0;  ///< branch
        std::uint32_t last = 0;
        HalfEdge wall;
    };

    const MapProduction& production(Label label) const { return system_.production(table_, label); }

    void replace_edges() {
        origins_.first_edge.resize(old_.edges().size() + 1);
        origins_.first_vertex.resize(old_.edges().size() + 1);
        map_.vertices_ = old_.vertices();
        for (std::size_t i = 0; i < old_.edges().size(); ++i) {
            const MapEdge& edge = old_.edges()[i];
            origins_.first_edge[i] = static_cast<std::uint32_t>(map_.edges_.size());
            origins_.first_vertex[i] = static_cast<std::uint32_t>(map_.vertices_);
            const std::vector<MapPart>& parts = production(edge.label).parts;
            std::uint32_t from = edge.tail;
            for (std::size_t k = 0; k < parts.size(); ++k) {
                const bool is_last = k + 1 == parts.size();
                const std::uint32_t to = is_last ? edge.head : static_cast<std::uint32_t>(map_.vertices_++);
                const bool back = parts[k].is_reversed;
                map_.edges_.push_back({parts[k].label, back ? to : from, back ? from : to, edge.born});
                from = to;
            }
            pulse_();
        }
        origins_.first_edge.back() = static_cast<std::uint32_t>(map_.edges_.size());
        origins_.first_vertex.back() = static_cast<std::uint32_t>(map_.vertices_);
    }

    /// Collects the new half-edges and the branches along an old wall.
    void walk(std::span<const HalfEdge> wall) {
        half_edges_.clear();
        branches_.clear();
        for (const HalfEdge half : wall) walk(half);
    }

    void walk(HalfEdge half) {
        const MapEdge& edge = old_.edges()[half.edge()];
        const MapProduction& rule = production(edge.label);
        const auto parts = static_cast<std::uint32_t>(rule.parts.size());
        const bool back = half.is_reversed();
        const std::vector<MapBranch>& side = back ? rule.left : rule.right;
        auto branch = side.begin();
        for (std::uint32_t i = 0; i <= parts; ++i) {
            const std::uint32_t position = back ? parts - i : i;
            for (; branch != side.end() && branch->position == position; ++branch) {
                const std::uint32_t vertex = position == 0       ? edge.tail
                                             : position == parts ? edge.head
                                                                 : origins_.first_vertex[half.edge()] + position - 1;
                branches_.push_back({static_cast<std::uint32_t>(half_edges_.size()), vertex,
                                     2 * branch->label + (branch->is_towards ? 1 : 0), nobody});
            }
            if (i == parts) break;
            const std::uint32_t part = back ? position - 1 : position;
            half_edges_.emplace_back(origins_.first_edge[half.edge()] + part, rule.parts[part].is_reversed != back);
        }
    }

    /// Finds, for each branch, the first one after it that matches and stands in another corner. Whether two branches
    /// share a corner does not change when the cell divides, so this is done once for a cell.
    void find_partners() {
        std::size_t later = branches_.size();  // from here on they are in nearest_
        for (std::size_t i = branches_.size(); i > 0; --i) {
            Branch& branch = branches_[i - 1];
            while (later > i && branches_[later - 1].at > branch.at) {
                --later;
                nearest_[branches_[later].bucket] = static_cast<std::uint32_t>(later);
            }
            const std::uint32_t partner = nearest_[branch.bucket ^ 1];
            // Around the end of the wall: the beginning and the end are one corner.
            const bool is_apart = partner != nobody && branches_[partner].at - branch.at < half_edges_.size();
            branch.partner = is_apart ? partner : nobody;
        }
        for (const Branch& branch : branches_) nearest_[branch.bucket] = nobody;
    }

    void append(std::uint32_t begin, std::uint32_t end) {
        map_.half_edges_.insert(map_.half_edges_.end(), half_edges_.begin() + begin, half_edges_.begin() + end);
    }

    void end_wall() { map_.ends_.push_back(map_.half_edges_.size()); }

    HalfEdge new_wall(const Branch& one, const Branch& other) {
        const bool back = (one.bucket & 1) != 0;  // points towards its edge
        const std::uint32_t tail = back ? other.vertex : one.vertex;
        const std::uint32_t head = back ? one.vertex : other.vertex;
        map_.edges_.push_back({one.bucket / 2, tail, head, step_});
        return {map_.edges_.size() - 1, back};
    }

    /// Emits the wall from half-edge `begin` to `end`, without the parts that branches from `first` to before `last`
    /// cut off from it, which are added to the list of daughters.
    void emit(std::uint32_t begin, std::uint32_t end, std::uint32_t first, std::uint32_t last, bool may_divide) {
        for (std::uint32_t i = first; i < last && may_divide; ++i) {
            const std::uint32_t partner = branches_[i].partner;
            if (partner >= last) continue;
            const HalfEdge wall = new_wall(branches_[i], branches_[partner]);
            append(begin, branches_[i].at);
            map_.half_edges_.push_back(wall);
            begin = branches_[partner].at;
            daughters_.push_back({i, partner, wall.opposite()});
            i = partner;
            may_divide = system_.divides_all;
        }
        append(begin, end);
    }

    /// Divides the current cell. Branches before the first that matches never match again, nor do those that a wall
    /// leaves in different daughters: each is examined once.
    void divide() {
        find_partners();
        emit(0, static_cast<std::uint32_t>(half_edges_.size()), 0, static_cast<std::uint32_t>(branches_.size()),
             true);
        end_wall();
        while (!daughters_.empty()) {
            const Daughter daughter = daughters_.back();
            daughters_.pop_back();
            emit(branches_[daughter.first].at, branches_[daughter.last].at, daughter.first + 1, daughter.last,
                 system_.divides_all);
            map_.half_edges_.push_back(daughter.wall);
            end_wall();
        }
    }

    const Map& old_;
    const MapSystem& system_;
    std::uint32_t table_;
    MapOrigins& origins_;
    Pulse pulse_;
    std::uint32_t step_ = 0;
    Map map_;
    // State of the current cell:
    std::vector<HalfEdge> half_edges_;
    std::vector<Branch> branches_;
    std::vector<Daughter> daughters_;
    std::vector<std::uint32_t> nearest_;  // by bucket, the nearest branch after the current ones
};

namespace {

// Peak of memory: an old edge with its origins and its half-edges, a new one with its half-edges and its share of the
// cells, vectors with room to grow.
constexpr double bytes_of_old_edge = 40;
constexpr double bytes_of_new_edge = 40;
constexpr double bytes_of_branch = 40;

}  // namespace

MapForecast forecast_step(const Map& map, const MapSystem& system, std::uint32_t table) {
    std::vector<double> counts(system.labels.size(), 0);
    for (const MapEdge& edge : map.edges()) ++counts[edge.label];
    MapForecast forecast;
    double& branches = forecast.branches;
    for (Label label = 0; label < counts.size(); ++label) {
        const MapProduction& rule = system.production(table, label);
        forecast.edges += counts[label] * static_cast<double>(rule.parts.size());
        branches += counts[label] * static_cast<double>(rule.left.size() + rule.right.size());
    }
    forecast.vertices =
        static_cast<double>(map.vertices()) + forecast.edges - static_cast<double>(map.edges().size());
    forecast.walls = std::floor(branches / 2);
    if (!system.divides_all) forecast.walls = std::min(forecast.walls, static_cast<double>(map.cells()));
    return forecast;
}

Map step_map(const Map& map, const MapSystem& system, std::uint32_t table, std::uint32_t step, MapOrigins& origins,
             const Monitor& monitor) {
    const MapForecast forecast = forecast_step(map, system, table);
    if (forecast.edges + forecast.walls >= static_cast<double>(most_map_edges)) {
        throw BudgetError(fmt::format("step {} could make {:.0f} edges; a map has fewer than 2^31", step,
                                      forecast.edges + forecast.walls));
    }
    return MapStepper(map, system, table, origins, monitor).run(step, forecast);
}

MapDerivation::MapDerivation(const Grammar& grammar, const MapLimits& limits, Monitor monitor)
    : grammar_(grammar), limits_(limits), monitor_(monitor), map_(*grammar.map()) {
    if (grammar.steps() > most_steps) {
        throw BudgetError(fmt::format("maps are derived in at most {} steps; n is {}", most_steps, grammar.steps()));
    }
    edges_made_ = static_cast<double>(map_.edges().size());
}

/// Refuses a derivation that must exceed the budget before most of the budget is spent: the parts of edges are
/// counted without the walls between them, which can only add to them.
void MapDerivation::require_least_edges() {
    constexpr double cheap_edges = 3e6;   // that take a fraction of a second
    constexpr std::int64_t far = 10'000;  // maximum number of steps forecast
    const auto now = static_cast<double>(map_.edges().size());
    if (limits_.edges - edges_made_ <= cheap_edges || !std::isfinite(limits_.edges) || now < 2 * looked_ahead_at_)
        return;
    looked_ahead_at_ = now;
    const MapSystem& system = *grammar_.map();
    std::vector<double> counts(system.labels.size(), 0), next(counts.size());
    for (const MapEdge& edge : map_.edges()) ++counts[edge.label];
    double made = edges_made_;
    std::size_t run = run_;
    std::int64_t step_of_run = step_of_run_;
    for (std::int64_t ahead = 0; ahead < far && run < grammar_.schedule().size(); ++ahead) {
        const ScheduleRun& current = grammar_.schedule()[run];
        std::fill(next.begin(), next.end(), 0.0);
        double edges = 0;
        for (Label label = 0; label < counts.size(); ++label) {
            if (counts[label] == 0) continue;
            for (const MapPart& part : system.production(current.table, label).parts)
                next[part.label] += counts[label];
            edges += counts[label] * static_cast<double>(system.production(current.table, label).parts.size());
        }
        counts.swap(next);
        made += edges;
        if (made > limits_.edges) {
            throw BudgetError(fmt::format(
                "the map of step {} (of n = {}) has at least {:.0f} edges, {:.0f} with those of the steps before it, "
                "and the budget is {:.0f}; choose a derivation length below {}",
                step_ + ahead + 1, grammar_.steps(), edges, made, limits_.edges, step_ + ahead + 1));
        }
        if (++step_of_run == current.steps) {
            ++run;
            step_of_run = 0;
        }
    }
}

void MapDerivation::require_affordable(std::uint32_t table) {
    require_least_edges();
    const MapForecast forecast = forecast_step(map_, *grammar_.map(), table);
    const double edges = forecast.edges + forecast.walls;
    edges_made_ += edges;
    const double bytes = static_cast<double>(map_.edges().size()) * bytes_of_old_edge + edges * bytes_of_new_edge +
                         forecast.branches * bytes_of_branch;
    if (edges_made_ <= limits_.edges && bytes <= limits_.bytes && edges < static_cast<double>(most_map_edges)) return;
    // With a schedule, a shorter derivation consists of different steps.
    const std::string advice =
        grammar_.has_schedule() ? "" : fmt::format("; the largest derivation length that fits is {}", step_);
    const std::string limit =
        edges_made_ > limits_.edges
            ? fmt::format("the budget is {:.0f}", limits_.edges)
            : fmt::format("there is not enough memory for them and {:.0f} branches", forecast.branches);
    throw BudgetError(
        fmt::format("the map of step {} (of n = {}) could have {:.0f} edges, {:.0f} with those of the "
                    "steps before it, and {}{}",
                    step_ + 1, grammar_.steps(), edges, edges_made_, limit, advice));
}

bool MapDerivation::next() {
    if (run_ == grammar_.schedule().size()) return false;
    const ScheduleRun& run = grammar_.schedule()[run_];
    require_affordable(run.table);
    map_ = step_map(map_, *grammar_.map(), run.table, static_cast<std::uint32_t>(step_ + 1), origins_, monitor_);
    monitor_.advance(map_.edges().size());
    ++step_;
    if (++step_of_run_ == run.steps) {
        ++run_;
        step_of_run_ = 0;
    }
    return true;
}

Map derive_map(const Grammar& grammar, const MapLimits& limits, const Monitor& monitor) {
    MapDerivation derivation(grammar, limits, monitor);
    while (derivation.next()) {
    }
    return derivation.take();
}

}  // namespace sikku
