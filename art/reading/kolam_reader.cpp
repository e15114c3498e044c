#include "art/reading/kolam_reader.h"

#include "art/reading/dot_symmetry.h"
#include "art/reading/ink_pieces.h"
#include "art/reading/kolam_edge.h"
#include "engine/base/threads.h"
#include "engine/geometry/box.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace sikku {
namespace {

/// Least agreement of a gap in a kolam.
constexpr double good = 0.84;
constexpr double certain = 0.93;
/// Lattices whose gaps agree less on average, before and after the search for a displacement, are accidental.
constexpr double hopeless_here = 0.25;
constexpr double hopeless = 0.45;
/// Groups of at most this many dots belong to the kolam beside them: rings, tips.
constexpr std::size_t most_loose = 3;

double best_of(const GapEvidence& gap) {
    return gap.agreement[static_cast<std::size_t>(gap.best())];
}

/// Completes and prunes the dots of a grid by the lines around them. Places are those of the grid it was given.
class LineWork {
public:
    LineWork(const GreyPicture& smooth, FoundGrid found, const GapReader& reader)
        : ink_(smooth), found_(std::move(found)), reader_(reader), level_(line_level(smooth, found_)) {
        Box box;
        for (const GridDot dot : grid().dots()) {
            dots_.insert(dot);
            box.add(found_.at(dot), 2 * found_.spacing);
        }
        box_ = box;
        regular_ = found_.map;
        regular_.forget();
        exact_ = found_.map;
        exact_.follow();
    }

    /// Reads the gaps between given dots.
    LineReading read_as(const std::vector<GridDot>& places, const Monitor& monitor) {
        find_offset(monitor);
        is_given_ = true;
        dots_ = {places.begin(), places.end()};
        read_gaps(monitor);
        for (const GridDot place : dots_) {
            if (!found_.map.has_seen(place)) added_.insert(place);
        }
        return read_part();
    }

    std::vector<LineReading> read(const Monitor& monitor) {
        find_offset(monitor);
        read_gaps(monitor);
        for (int round = 0; round < 6 && !is_hopeless_ && add_encircled(monitor); ++round) {
        }
        std::vector<LineReading> readings;
        if (is_hopeless_) {
            readings.push_back(read_part());
            return readings;
        }
        std::vector<std::set<GridDot>> parts = kolams(monitor);
        const std::set<GridDot> all = dots_;
        for (std::set<GridDot>& part : parts) {
            if (!readings.empty() && part.size() <= most_loose) {
                readings.front().left_out += part.size();
                continue;
            }
            dots_ = std::move(part);
            readings.push_back(read_part());
        }
        return readings;
    }

private:
    /// Finds the displacement of the lines, if all dots lie on one side of the middles of their loops.
    void find_offset(const Monitor& monitor) {
        const std::vector<GridGap>& gaps = grid().gaps();
        const std::size_t stride = std::max<std::size_t>(1, gaps.size() / 40);
        const auto agreement = [&](glm::dvec2 offset) {
            double sum = 0;
            std::size_t count = 0;
            for (std::size_t i = 0; i < gaps.size(); i += stride, ++count) {
                sum +=
                    best_of(reader_.read(found_.map, grid().dots()[gaps[i].from], grid().dots()[gaps[i].to], offset));
            }
            return count > 0 ? sum / static_cast<double>(count) : 1.0;
        };
        const double here = agreement({0, 0});
        if (here > 0.9 || gaps.empty()) return;
        is_hopeless_ = here < hopeless_here;
        if (is_hopeless_) return;
        glm::dvec2 best(0.0);
        double most = here + 0.03;
        for (const double size : {0.09, 0.045}) {
            monitor.check();
            const int reach = size > 0.05 ? 2 : 1;
            std::vector<glm::dvec2> offsets;
            for (int y = -reach; y <= reach; ++y) {
                for (int x = -reach; x <= reach; ++x) offsets.push_back(best + size * glm::dvec2(x, y));
            }
            std::vector<double> found(offsets.size());
            for_each_index(offsets.size(), [&](std::size_t i) { found[i] = agreement(offsets[i]); });
            const auto highest = std::max_element(found.begin(), found.end());
            if (*highest <= most) continue;
            most = *highest;
            best = offsets[static_cast<std::size_t>(highest - found.begin())];
        }
        for (LatticeMap* map : {&found_.map, &regular_, &exact_}) map->offset(best);
        is_hopeless_ = most < hopeless;
    }

    LineReading read_part() {
        const std::vector<GridDot> missing = complete();
        LineReading reading{.grid = found_.with({dots_.begin(), dots_.end()})};
        const GridDot origin = reading.grid.placed.origin - found_.placed.origin;
        reading.is_given = is_given_;
        for (const GridDot place : added_) {
            if (!dots_.contains(place)) continue;
            reading.added.push_back(place - origin);
            if (!is_given_) continue;
            if (!has_ink(place)) reading.blank.push_back(place - origin);
            reading.outside += !is_inside(ink_, found_.at(place));
        }
        std::sort(reading.added.begin(), reading.added.end(), is_before);
        for (const GridGap& gap : reading.grid.grid().gaps()) {
            const GridDot from = reading.grid.grid().dots()[gap.from];
            reading.evidence.push_back(evidence(from + origin, gap.side));
            reading.agreement += best_of(reading.evidence.back()) + reading.evidence.back().margin();
        }
        reading.agreement /= static_cast<double>(std::max<std::size_t>(1, reading.evidence.size()));
        if (is_hopeless_) return reading;
        for (const GridDot place : open_ends()) reading.open_ends.push_back(place - origin);
        for (const GridDot place : missing) {
            if (!dots_.contains(place)) reading.missing.push_back(place - origin);
        }
        reading.explained = explained(reading);
        std::vector<char> is_joined(reading.grid.grid().dots().size());
        for (std::size_t i = 0; i < reading.evidence.size(); ++i) {
            if (reading.evidence[i].best() == GapState::turned) continue;
            is_joined[reading.grid.grid().gaps()[i].from] = is_joined[reading.grid.grid().gaps()[i].to] = 1;
        }
        reading.joined = static_cast<std::size_t>(std::count(is_joined.begin(), is_joined.end(), 1));
        reading.reaches_edge = sikku::reaches_edge(ink_, reading.grid, level_);
        return reading;
    }
    const InkPieces& ink_pieces() const {
        if (!pieces_) pieces_.emplace(ink_, 0.4 * level_, box_.low, box_.high);
        return *pieces_;
    }
    const DotGrid& grid() const { return found_.grid(); }
    GridDot next(GridDot from, std::uint32_t side) const { return from + grid().step(side); }

    /// Evidence between a place and its neighbour, read once.
    const GapEvidence& evidence(GridDot from, std::uint32_t side) {
        // Read from the dot whose side is among the first half.
        if (const std::uint32_t half = grid().sides() / 2; side >= half) {
            return evidence(next(from, side), side - half);
        }
        const auto [found, is_new] = evidence_.try_emplace({from, side});
        if (is_new) found->second = read_gap(from, side);
        return found->second;
    }
    /// Reads all gaps between the dots, in parallel.
    void read_gaps(const Monitor& monitor) {
        std::vector<std::pair<GridDot, std::uint32_t>> gaps;
        for (const GridDot place : dots_) {
            for (std::uint32_t side = 0; side < grid().sides() / 2; ++side) {
                if (dots_.contains(next(place, side))) gaps.emplace_back(place, side);
            }
        }
        std::vector<GapEvidence> read(gaps.size());
        for_each_index(gaps.size(), [&](std::size_t i) {
            if (i % 64 == 0) monitor.check();
            read[i] = read_gap(gaps[i].first, gaps[i].second);
        });
        for (std::size_t i = 0; i < gaps.size(); ++i) evidence_.insert_or_assign(gaps[i], read[i]);
    }
    GapEvidence read_gap(GridDot from, std::uint32_t side) const {
        GapEvidence gap;
        // Lines may follow each dot as drawn by hand, its rows, or the intended lattice.
        for (const LatticeMap* map : {&found_.map, &exact_, &regular_}) {
            const GapEvidence seen = reader_.read(*map, from, next(from, side));
            if (map == &found_.map || best_of(seen) > best_of(gap)) gap = seen;
            if (best_of(seen) >= certain || is_hopeless_) break;
        }
        if (best_of(gap) < 0.88 && !is_hopeless_) look_around(gap, from, side);
        return gap;
    }
    /// Strands drawn by hand may pass beside the middle between two dots.
    void look_around(GapEvidence& gap, GridDot from, std::uint32_t side) const {
        constexpr double size = 0.09;
        constexpr double penalty = 0.02;
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                if (x == 0 && y == 0) continue;
                const GapEvidence seen = reader_.read(found_.map, from, next(from, side), size * glm::dvec2(x, y));
                for (std::size_t i = 0; i < 3; ++i) {
                    gap.agreement[i] = std::max(gap.agreement[i], seen.agreement[i] - penalty);
                }
            }
        }
    }
    double ink_at(glm::dvec2 place) const { return ink_.at(found_.map(place)); }

    /// True if there is a spot of ink at a place, of any size that fits into a loop.
    bool has_blob(GridDot place) const {
        const glm::dvec2 at = found_.map(lattice_point(grid().lattice(), place));
        const double spacing = found_.map.spacing(lattice_point(grid().lattice(), place));
        for (double dy = -0.12; dy <= 0.121; dy += 0.06) {
            for (double dx = -0.12; dx <= 0.121; dx += 0.06) {
                const glm::dvec2 middle = at + spacing * glm::dvec2(dx, dy);
                double inside = 0;
                double around = 0;
                for (int k = 0; k < 12; ++k) {
                    const double angle = 2 * std::numbers::pi * k / 12;
                    const glm::dvec2 way(std::cos(angle), std::sin(angle));
                    inside += static_cast<double>(ink_.at(middle + 0.05 * spacing * way)) / 12;
                    around += static_cast<double>(ink_.at(middle + 0.17 * spacing * way)) / 12;
                }
                if (inside > 0.5 * level_ || (inside > 0.2 * level_ && inside - around > 0.3 * level_)) return true;
            }
        }
        return false;
    }

    /// True if two strands lead from a dot over the gap to a place and diverge, or run side by side, beyond it.
    bool strands_lead(GridDot from, std::uint32_t side) const {
        const DotLattice lattice = grid().lattice();
        const glm::dvec2 start = lattice_point(lattice, from);
        const glm::dvec2 along = lattice_point(lattice, next(from, side)) - start;
        const glm::dvec2 aside(-along.y, along.x);
        const double wide = lattice == DotLattice::square ? 0.46 : 0.27;
        for (const double part : {0.68, 0.78}) {
            std::array<double, 2> most{};
            std::array<double, 2> where{};
            for (std::size_t k = 0; k < 2; ++k) {
                const double sign = k == 0 ? 1 : -1;
                for (double off = 0.04; off <= wide; off += 0.02) {
                    const double ink = ink_at(start + part * along + sign * off * aside);
                    if (ink > most[k]) {
                        most[k] = ink;
                        where[k] = off;
                    }
                }
            }
            if (std::min(most[0], most[1]) < 0.45 * level_) return false;
            if (where[0] + where[1] < (part < 0.7 ? 0.16 : 0.26)) return false;
        }
        return true;
    }

    /// Adds places beside the grid that have lines around them although no dot was seen there: all gaps between them
    /// and dots have both strands, and some strands lead to them, or run around them alone. @return true if there
    /// were any
    bool add_encircled(const Monitor& monitor) {
        std::set<GridDot> tried;
        std::vector<GridDot> added;
        for (const GridDot place : dots_) {
            monitor.check();
            for (std::uint32_t side = 0; side < grid().sides(); ++side) {
                const GridDot to = next(place, side);
                if (dots_.contains(to) || !tried.insert(to).second) continue;
                if (!is_inside(ink_, found_.at(to))) continue;
                if (is_encircled(to)) added.push_back(to);
            }
        }
        for (const GridDot place : added) {
            dots_.insert(place);
            added_.insert(place);
        }
        return !added.empty();
    }
    bool is_encircled(GridDot place) {
        std::size_t gaps = 0;
        std::size_t joined = 0;
        for (std::uint32_t side = 0; side < grid().sides(); ++side) {
            if (!dots_.contains(next(place, side))) continue;
            const GapEvidence& gap = evidence(place, side);
            if (best_of(gap) < good) return false;
            ++gaps;
            joined += gap.best() != GapState::turned;
        }
        if (gaps == grid().sides()) return true;
        if (gaps == 0 || !has_blob(place)) return false;
        // A ring of its own touches the loops of several dots.
        return joined > 0 || (gaps > 1 && has_own_lines({place}));
    }

    /// Adds dots that the symmetry of the others suggests where the lines agree. @return places with ink where the
    /// lines do not agree, and places within the kolam that have ink
    std::vector<GridDot> complete() {
        if (is_hopeless_ || is_given_) return {};
        std::set<GridDot> asked;
        for (int round = 0; round < 3; ++round) {
            const FoundGrid now = found_.with({dots_.begin(), dots_.end()});
            const GridDot origin = now.placed.origin - found_.placed.origin;
            std::size_t added = 0;
            for (const GridDot place : places_by_symmetry(now.grid())) {
                const GridDot here = place + origin;
                if (!is_inside(ink_, found_.at(here))) continue;
                if (!is_likely(here)) {
                    asked.insert(here);
                    continue;
                }
                added += dots_.insert(here).second;
                added_.insert(here);
            }
            if (added == 0) break;
        }
        for (const GridDot place : dots_) {
            for (std::uint32_t side = 0; side < grid().sides(); ++side) {
                const GridDot to = next(place, side);
                if (!dots_.contains(to) && neighbours(to) > grid().sides() / 2) asked.insert(to);
            }
        }
        std::vector<GridDot> missing;
        for (const GridDot place : asked) {
            if (!dots_.contains(place) && has_ink(place)) missing.push_back(place);
        }
        return missing;
    }
    std::size_t neighbours(GridDot place) const {
        std::size_t count = 0;
        for (std::uint32_t side = 0; side < grid().sides(); ++side) count += dots_.contains(next(place, side));
        return count;
    }
    /// True if lines lead to a place, or around it and a spot, less clearly than is_encircled() requires.
    bool is_likely(GridDot place) {
        std::size_t gaps = 0;
        bool leads = has_blob(place);
        for (std::uint32_t side = 0; side < grid().sides(); ++side) {
            if (!dots_.contains(next(place, side))) continue;
            const GapEvidence& gap = evidence(place, side);
            if (best_of(gap) < 0.7) return false;
            ++gaps;
            leads = leads || gap.best() != GapState::turned;
        }
        return gaps > 0 && leads && has_ink(place);
    }
    bool has_ink(GridDot place) const {
        const glm::dvec2 middle = lattice_point(grid().lattice(), place);
        for (const double radius : {0.0, 0.1, 0.2, 0.3, 0.4}) {
            for (int k = 0; k < 16; ++k) {
                const double angle = 2 * std::numbers::pi * k / 16;
                if (ink_at(middle + radius * glm::dvec2(std::cos(angle), std::sin(angle))) > 0.5 * level_)
                    return true;
            }
        }
        return false;
    }

    /// True if a line leads over a gap, by its state or by ink that is connected.
    bool is_link(GridDot from, std::uint32_t side) {
        const GapEvidence& gap = evidence(from, side);
        if (gap.best() != GapState::turned && best_of(gap) >= 0.75) return true;
        const std::set<std::uint32_t> here = pieces_at(from, side);
        const std::set<std::uint32_t> there =
            pieces_at(next(from, side), (side + grid().sides() / 2) % grid().sides());
        return std::any_of(here.begin(), here.end(), [&](std::uint32_t piece) { return there.contains(piece); });
    }
    /// Pieces of ink on both flanks of a dot's side, where its strands are.
    std::set<std::uint32_t> pieces_at(GridDot from, std::uint32_t side) const {
        const glm::dvec2 start = lattice_point(grid().lattice(), from);
        const glm::dvec2 along = lattice_point(grid().lattice(), next(from, side)) - start;
        const glm::dvec2 aside = glm::dvec2(-along.y, along.x) * (grid().lattice() == DotLattice::square ? 1.0 : 0.6);
        std::set<std::uint32_t> pieces;
        for (const double sign : {-1.0, 1.0}) {
            for (int k = -8; k <= 8; ++k) {
                const double off = 0.015 * k;
                const glm::dvec2 place = start + (0.25 + off) * along + sign * (0.25 + off) * aside;
                if (const std::uint32_t piece = ink_pieces().at(found_.map(place)); piece != 0) pieces.insert(piece);
            }
        }
        return pieces;
    }

    /// Groups of dots that lines connect.
    std::vector<std::vector<GridDot>> linked_groups(const Monitor& monitor) {
        std::map<GridDot, std::size_t> group;
        std::vector<std::vector<GridDot>> groups;
        for (const GridDot first : dots_) {
            monitor.check();
            if (group.contains(first)) continue;
            groups.emplace_back();
            std::vector<GridDot> stack{first};
            group[first] = groups.size() - 1;
            while (!stack.empty()) {
                const GridDot at = stack.back();
                stack.pop_back();
                groups.back().push_back(at);
                for (std::uint32_t side = 0; side < grid().sides(); ++side) {
                    const GridDot to = next(at, side);
                    if (!dots_.contains(to) || group.contains(to) || !is_link(at, side)) continue;
                    group[to] = groups.size() - 1;
                    stack.push_back(to);
                }
            }
        }
        return groups;
    }

    /// The kolams on the lattice: groups of dots that lines join, with those that lie close beside or within them. A
    /// frame touches the kolam within it at few places, if at all.
    std::vector<std::set<GridDot>> kolams(const Monitor& monitor) {
        const std::vector<std::vector<GridDot>> groups = linked_groups(monitor);
        std::map<GridDot, std::size_t> group_of;
        for (std::size_t i = 0; i < groups.size(); ++i) {
            for (const GridDot place : groups[i]) group_of[place] = i;
        }
        std::vector<std::size_t> rim(groups.size());
        struct Gaps {
            std::size_t count = 0;
            double sum = 0;  ///< sum of their agreement
            double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0; }
        };
        std::vector<Gaps> inner(groups.size());
        std::map<std::pair<std::size_t, std::size_t>, Gaps> contacts;
        for (const auto& [place, group] : group_of) {
            for (std::uint32_t side = 0; side < grid().sides(); ++side) {
                const auto other = group_of.find(next(place, side));
                const bool is_inner = other != group_of.end() && other->second == group;
                rim[group] += !is_inner;
                if (other == group_of.end() || other->second < group) continue;
                Gaps& gaps = is_inner ? inner[group] : contacts[{group, other->second}];
                ++gaps.count;
                gaps.sum += best_of(evidence(place, side));
            }
        }
        std::vector<std::size_t> kolam(groups.size());
        std::iota(kolam.begin(), kolam.end(), std::size_t{0});
        const auto root = [&](std::size_t i) {
            while (kolam[i] != i) i = kolam[i];
            return i;
        };
        for (const auto& [pair, contact] : contacts) {
            const auto [a, b] = pair;
            const std::size_t small = std::min(groups[a].size(), groups[b].size());
            // Ornaments on the lattice agree with no kolam, neither among themselves nor with their neighbours.
            const double worse = std::min(inner[a].mean(), inner[b].mean());
            const double better = std::max(inner[a].mean(), inner[b].mean());
            bool touches = 8 * contact.count >= std::min(rim[a], rim[b]) &&
                           (worse >= 0.8 || better - worse < 0.12 || (worse >= 0.7 && contact.mean() >= 0.85));
            if (small <= most_loose) {
                touches = contact.count > 2 || contact.mean() >= (contact.count > 1 ? 0.7 : good);
                touches = touches && has_own_lines(groups[groups[a].size() == small ? a : b]);
            }
            if (touches) kolam[root(a)] = root(b);
        }
        std::map<std::size_t, std::set<GridDot>> all;
        for (const auto& [place, group] : group_of) all[root(group)].insert(place);
        std::vector<std::set<GridDot>> found;
        for (auto& [number, places] : all) found.push_back(std::move(places));
        // Frames come after the kolams within them.
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.size() > b.size(); });
        std::stable_partition(found.begin(), found.end(), [&](const std::set<GridDot>& places) {
            return std::none_of(found.begin(), found.end(), [&](const std::set<GridDot>& other) {
                return other.size() > most_loose && 10 * other.size() > places.size() && surrounds(places, other);
            });
        });
        join_inner(found);
        return found;
    }
    /// True if lines run around each of a few dots, and no farther, as those of a ring do. The ornaments of a border
    /// have lines beside them that run along it, or none on some side.
    bool has_own_lines(const std::vector<GridDot>& group) const {
        const double most = (static_cast<double>(group.size()) + 0.5) * found_.spacing;
        constexpr int ways = 24;
        constexpr int least_closed = 20;
        return std::all_of(group.begin(), group.end(), [&](GridDot place) {
            const glm::dvec2 middle = lattice_point(grid().lattice(), place);
            int closed = 0;
            for (int k = 0; k < ways; ++k) {
                const double angle = 2 * std::numbers::pi * k / ways;
                const glm::dvec2 way(std::cos(angle), std::sin(angle));
                for (double reach = 0.2; reach < 0.72; reach += 0.02) {
                    const std::uint32_t piece = ink_pieces().at(found_.map(middle + reach * way));
                    if (piece == 0) continue;
                    closed += ink_pieces().size(piece) < most;
                    break;
                }
            }
            return closed >= least_closed;
        });
    }
    /// True if the box of some places contains that of others, and leaves room on all sides.
    static bool surrounds(const std::set<GridDot>& places, const std::set<GridDot>& others) {
        const auto box = [](const std::set<GridDot>& list) {
            PlaceBox around;
            for (const GridDot place : list) around.add(place);
            return around;
        };
        const PlaceBox outer = box(places), inner = box(others);
        return outer.low.x < inner.low.x && outer.high.x > inner.high.x && outer.low.y < inner.low.y &&
               outer.high.y > inner.high.y;
    }
    /// Joins the few dots within a hole of a kolam to it.
    static void join_inner(std::vector<std::set<GridDot>>& found) {
        for (std::size_t i = 1; i < found.size(); ++i) {
            for (std::size_t k = 0; k < found.size(); ++k) {
                if (k == i || found[i].empty() || 10 * found[i].size() > found[k].size()) continue;
                const bool is_within = std::all_of(found[i].begin(), found[i].end(), [&](GridDot place) {
                    const auto row = [&](std::int32_t step) {
                        for (std::int32_t n = 1; n < 64; ++n) {
                            if (found[k].contains({place.x + 2 * n * step, place.y})) return true;
                        }
                        return false;
                    };
                    return row(1) && row(-1);
                });
                if (!is_within) continue;
                found[k].merge(found[i]);
                found[i].clear();
            }
        }
        std::erase_if(found, [](const auto& places) { return places.empty(); });
    }

    std::vector<GridDot> open_ends() {
        std::vector<GridDot> places;
        for (const GridDot place : dots_) {
            for (std::uint32_t side = 0; side < grid().sides(); ++side) {
                const GridDot to = next(place, side);
                if (dots_.contains(to) || !is_inside(ink_, found_.at(to))) continue;
                const GapEvidence& gap = evidence(place, side);
                const bool leads = gap.best() != GapState::turned && best_of(gap) > 0.6 && strands_lead(place, side);
                if (leads) places.push_back(to);
            }
        }
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
        return places;
    }

    /// The share of the ink near the dots, up to a spacing away, that lies around gaps that agree with a state or
    /// around dots, where loops turn.
    double explained(const LineReading& reading) const {
        const DotGrid& dots = reading.grid.grid();
        const DotLattice lattice = dots.lattice();
        const auto back = reading.grid.map.perspective().inverse();
        if (!back) return 0;
        Box box;
        for (const GridDot dot : dots.dots()) {
            box.add(reading.grid.at(dot), reading.grid.map.spacing(lattice_point(lattice, dot)));
        }
        const double step = std::max(1.0, reading.grid.spacing / 24);
        double all = 0;
        double good_ink = 0;
        const auto limit = [](double value, std::size_t size) {
            return std::clamp(value, 0.0, static_cast<double>(size));
        };
        for (double y = limit(box.low.y, ink_.height); y < limit(box.high.y, ink_.height); y += step) {
            for (double x = limit(box.low.x, ink_.width); x < limit(box.high.x, ink_.width); x += step) {
                if (ink_.at({x, y}) < 0.5 * level_) continue;
                const glm::dvec2 place = (*back)({x, y}) - reading.grid.map.shift();
                // The nearest place, and whether it is a dot.
                const GridDot near = nearest(place, dots);
                const auto index = dots.dot_at(near);
                if (!index) {
                    if (is_near_dot(place, dots)) ++all;
                    continue;
                }
                ++all;
                const std::int32_t gap =
                    dots.gap(*index, side_of(place - lattice_point(lattice, near), dots.sides()));
                good_ink += gap < 0 || best_of(reading.evidence[static_cast<std::size_t>(gap)]) >= 0.7;
            }
        }
        return all > 0 ? good_ink / all : 0;
    }
    /// The side of a dot that a direction leads to.
    static std::uint32_t side_of(glm::dvec2 way, std::uint32_t sides) {
        const double turns = std::atan2(way.y, way.x) / (2 * std::numbers::pi);
        return static_cast<std::uint32_t>(std::lround(turns * sides) + sides) % sides;
    }
    /// The place of the lattice of a grid, whose dots may be at odd places, nearest to a point.
    static GridDot nearest(glm::dvec2 point, const DotGrid& dots) {
        const GridDot first = dots.dots().front();
        return first + nearest_place(dots.lattice(), point - lattice_point(dots.lattice(), first));
    }
    static bool is_near_dot(glm::dvec2 point, const DotGrid& dots) {
        const GridDot near = nearest(point, dots);
        for (std::uint32_t side = 0; side < dots.sides(); ++side) {
            const GridDot to = near + dots.step(side);
            if (dots.dot_at(to) && glm::distance(lattice_point(dots.lattice(), to), point) < 1) return true;
        }
        return false;
    }

    const GreyPicture& ink_;
    FoundGrid found_;
    LatticeMap regular_;  ///< without the hand's deviations
    LatticeMap exact_;    ///< through the dots
    const GapReader& reader_;
    double level_;
    Box box_;                                  ///< around the dots that were found
    mutable std::optional<InkPieces> pieces_;  ///< of the ink in the box; many lattices do not need them
    bool is_hopeless_ = false;                 ///< hardly any gap agrees with a kolam
    bool is_given_ = false;                    ///< the dots were given
    std::set<GridDot> dots_;
    std::set<GridDot> added_;
    std::map<std::pair<GridDot, std::uint32_t>, GapEvidence> evidence_;
};

}  // namespace

const GreyPicture& InkReader::smooth_for(const FoundGrid& grid) {
    // Pages have kolams of similar sizes.
    const double blur = std::exp2(std::round(4 * std::log2(0.018 * grid.spacing)) / 4);
    if (!smooth_ || smooth_->first != blur) smooth_.emplace(blur, blurred(ink_, blur));
    return smooth_->second;
}

LineReading InkReader::read_as(const FoundGrid& grid, const std::vector<GridDot>& places, const Monitor& monitor) {
    const GreyPicture& smooth = smooth_for(grid);
    const GapReader reader(smooth, grid.grid(), grid.map, grid.dot_radius, templates_, monitor);
    return LineWork(smooth, grid, reader).read_as(places, monitor);
}

std::vector<LineReading> InkReader::read(const FoundGrid& grid, const Monitor& monitor) {
    const GreyPicture& smooth = smooth_for(grid);
    const GapReader reader(smooth, grid.grid(), grid.map, grid.dot_radius, templates_, monitor);
    std::vector<LineReading> readings = LineWork(smooth, grid, reader).read(monitor);
    if (readings.size() == 1 && readings[0].left_out == 0) return readings;
    // Spots that do not belong to a kolam may have bent its lattice.
    for (LineReading& reading : readings) {
        constexpr std::size_t least_dots = 9;
        if (reading.grid.grid().dots().size() < least_dots) continue;
        FoundGrid alone = reading.grid;
        alone.map = reading.grid.map.fitted_to(alone.grid().dots());
        std::vector<LineReading> again = LineWork(smooth, std::move(alone), reader).read(monitor);
        if (again[0].grid.grid().dots().size() < reading.grid.grid().dots().size()) continue;
        again[0].left_out += reading.left_out;
        reading = std::move(again[0]);
    }
    return readings;
}

}  // namespace sikku
