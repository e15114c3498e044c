#include "engine/measure/fold.h"

#include "engine/base/numbers.h"
#include "engine/derivation/forecast.h"
#include "engine/measure/exact_quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <type_traits>

namespace sikku {
namespace {

constexpr double most_work = 3e7;
constexpr std::size_t longest_axiom = 1'000'000;  // walking a long word costs as much as composing it
constexpr std::size_t most_frames = 4096;
constexpr std::uint64_t most_corners = 5'000'000;  // corners of all hulls together

struct Overflow {};  // 64 bits do not suffice
struct TooMuch {};   // composition is too costly
struct BracesError : WordError {
    using WordError::WordError;
};

// --- sines in any precision ----------------------------------------------------------------------------------------

/// arctan(1 / x) x 2^bits
Integer fixed_arctangent(int x, unsigned bits) {
    Integer term = (Integer(1) << bits) / x;
    Integer sum = term;
    for (int i = 1; term != 0; ++i) {
        term /= x * x;
        sum += (i % 2 == 1 ? -term : term) / (2 * i + 1);
    }
    return sum;
}

struct FixedVector {
    Integer x, y;  // x 2^bits
};

/// Cosine and sine x 2^bits, within a few units of the last place; exact where they are 0, 1/2 or 1.
FixedVector fixed_unit_vector(TurnFraction turn, unsigned bits) {
    const FoldedTurn folded = fold_turn(turn);
    const std::int64_t distance = folded.rest < 0 ? -folded.rest : folded.rest;
    const Integer one = Integer(1) << bits;
    FixedVector near{one, 0};
    if (distance != 0) {
        const unsigned guard = 32;
        const Integer pi = 16 * fixed_arctangent(5, bits + guard) - 4 * fixed_arctangent(239, bits + guard);
        const Integer angle = pi * distance / (2 * Integer(turn.denominator));
        Integer term = Integer(1) << (bits + guard);
        near = {0, 0};
        for (int i = 0; term != 0; ++i) {
            Integer& sum = i % 2 == 0 ? near.x : near.y;
            sum += i % 4 < 2 ? term : -term;
            term = (term * angle >> (bits + guard)) / (i + 1);
        }
        near.x >>= guard;
        near.y >>= guard;
        if (3 * distance == turn.denominator) near.y = one / 2;
    }
    if (folded.rest < 0) near.y = -near.y;
    return by_quarters(folded.quarter, near);
}

double to_double(const Integer& fixed, unsigned bits) {
    if (fixed == 0) return 0.0;
    const Integer size = fixed < 0 ? Integer(-fixed) : fixed;
    const auto length = static_cast<unsigned>(msb(size));
    // 62 leading bits are more than a double holds.
    const unsigned drop = length > 62 ? length - 62 : 0;
    const double value = std::ldexp(static_cast<Integer>(size >> drop).convert_to<double>(),
                                    static_cast<int>(drop) - static_cast<int>(bits));
    return fixed < 0 ? -value : value;
}

/// fixed / 2^bits / denominator: in full below 2^53, rounded to a whole number beyond.
Quantity quantity(const Integer& fixed, unsigned bits, std::int64_t denominator) {
    const double value = to_double(fixed, bits) / static_cast<double>(denominator);
    if (std::fabs(value) < 0x1p53) return {value, ""};
    const Integer size = fixed < 0 ? Integer(-fixed) : fixed;
    const Integer divisor = Integer(denominator) << bits;
    const Integer rounded = (size + divisor / 2) / divisor;
    return {value, (fixed < 0 ? "-" : "") + rounded.str()};
}

// --- the two kinds of plane ----------------------------------------------------------------------------------------

/// Z[zeta] with Int coordinates.
template <int Rank, class Int>
class LatticeSpace {
public:
    using Point = std::array<Int, Rank>;
    using Heading = std::uint32_t;
    static constexpr bool wide = std::is_same_v<Int, Integer>;
    /// Coordinates in the plane, or, for rank 2, in an affine image of it, which suffices for convexity and is exact.
    using Key = std::conditional_t<Rank == 2 || wide, Int, long double>;
    struct Vertex {
        Point at;
        std::array<Key, 2> key;
    };

    /// @param bits  a bound on the coordinates' size
    LatticeSpace(const Lattice& lattice, const Grammar& grammar, unsigned bits)
        : lattice_(lattice), grammar_(grammar), bits_(bits) {
        if constexpr (Rank > 2) {
            const unsigned fraction = wide ? fraction_bits() : 96;
            for (std::int64_t i = 0; i < Rank; ++i) {
                const FixedVector basis = fixed_unit_vector({i, lattice.headings}, fraction);
                if constexpr (wide) {
                    key_basis_[static_cast<std::size_t>(i)] = {basis.x, basis.y};
                } else {
                    key_basis_[static_cast<std::size_t>(i)] = {std::ldexp(static_cast<long double>(basis.x), -96),
                                                               std::ldexp(static_cast<long double>(basis.y), -96)};
                }
            }
        }
    }

    Point zero() const { return Point{}; }
    Heading ahead() const { return 0; }
    Point step(Symbol symbol) const {
        const auto coordinates = lattice_.step(symbol);
        Point point{};
        for (std::size_t i = 0; i < Rank; ++i) point[i] = coordinates[i];
        return point;
    }
    Heading turn(Symbol symbol) const { return lattice_.turn[symbol]; }
    Heading add(Heading a, Heading b) const { return (a + b) % lattice_.headings; }

    Point move(const Point& from, const Point& by, Heading heading) const {
        Point sum = from;
        for (std::size_t i = 0; i < Rank; ++i) {
            if (by[i] == 0) continue;
            const auto& power = lattice_.power[(heading + i) % lattice_.headings];
            for (std::size_t j = 0; j < Rank; ++j) {
                if (power[j] != 0) sum[j] += by[i] * power[j];
            }
        }
        if constexpr (!wide) {
            for (const Int coordinate : sum) {
                if (coordinate > limit || coordinate < -limit) throw Overflow();
            }
        }
        return sum;
    }
    bool same(const Point& a, const Point& b) const { return a == b; }

    Vertex vertex(const Point& point) const {
        Vertex result{point, {}};
        if constexpr (Rank == 2) {
            result.key = {point[0], point[1]};
        } else {
            for (std::size_t i = 0; i < Rank; ++i) {
                result.key[0] += static_cast<Key>(point[i]) * key_basis_[i][0];
                result.key[1] += static_cast<Key>(point[i]) * key_basis_[i][1];
            }
        }
        return result;
    }
    /// True if b is to the left of the line from a to c, or on it within the keys' rounding, so that corners along a
    /// straight edge do not accumulate.
    bool is_dent(const Vertex& a, const Vertex& b, const Vertex& c) const {
        using Wide = std::conditional_t<Rank == 2 && !wide, Int128, Key>;
        const Wide ax = static_cast<Wide>(b.key[0]) - a.key[0];
        const Wide ay = static_cast<Wide>(b.key[1]) - a.key[1];
        const Wide bx = static_cast<Wide>(c.key[0]) - a.key[0];
        const Wide by = static_cast<Wide>(c.key[1]) - a.key[1];
        const Wide one = ax * by;
        const Wide other = ay * bx;
        if constexpr (Rank == 2) {
            return one <= other;
        } else if constexpr (wide) {
            const Wide size = abs(ax) + abs(ay) + abs(bx) + abs(by);
            return one - other <= size << (bits_ + 4);
        } else {
            return one - other <= 0x1p-58L * (std::fabs(one) + std::fabs(other));
        }
    }

    double heading_degrees(Heading heading) const {
        return lattice_.first_heading + 360.0 * heading / lattice_.headings;
    }

    /// Converts points to coordinates of the plane, in turtle steps.
    class Embedding {
    public:
        explicit Embedding(const LatticeSpace& space) : space_(space) {
            const TurnFraction first = space.grammar_.heading().exact.value_or(
                TurnFraction{std::llround(space.lattice_.first_heading / 360.0 * 0x1p40), std::int64_t{1} << 40});
            // Sum of the two fractions, in 128 bits, reduced.
            const std::int64_t k = space.lattice_.headings;
            for (std::int64_t i = 0; i < Rank; ++i) {
                const std::int64_t divisor = std::gcd(k, first.denominator);
                const TurnFraction sum{first.numerator * (k / divisor) + i * (first.denominator / divisor),
                                       first.denominator * (k / divisor)};
                basis_[static_cast<std::size_t>(i)] = fixed_unit_vector(sum, bits());
            }
        }
        FixedVector placed(const Point& point) const {
            FixedVector sum{0, 0};
            for (std::size_t i = 0; i < Rank; ++i) {
                sum.x += basis_[i].x * Integer(point[i]);
                sum.y += basis_[i].y * Integer(point[i]);
            }
            return sum;
        }
        Quantity quantity(const Integer& fixed) const {
            return sikku::quantity(fixed, bits(), std::llround(1.0 / space_.lattice_.unit));
        }

    private:
        unsigned bits() const { return wide ? space_.fraction_bits() : 128; }
        const LatticeSpace& space_;
        std::array<FixedVector, Rank> basis_;
    };

private:
    // Differences fit into 64 bits and their products into 128; or a long double holds them exactly.
    static constexpr std::int64_t limit = std::int64_t{1} << (Rank == 2 ? 59 : 52);
    unsigned fraction_bits() const { return bits_ + 64; }

    const Lattice& lattice_;
    const Grammar& grammar_;
    unsigned bits_;
    std::array<std::array<Key, 2>, Rank> key_basis_;
};

/// A plane with coordinates in doubles.
class PlaneSpace {
public:
    using Point = glm::dvec2;
    struct Heading {
        std::uint32_t index = 0;
        double degrees = 0.0;
    };
    struct Vertex {
        Point at;
    };

    PlaneSpace(const Lattice& lattice, const Grammar& grammar) : lattice_(lattice), grammar_(grammar) {}

    Point zero() const { return Point(0.0); }
    Heading ahead() const { return {}; }
    Point step(Symbol symbol) const { return {grammar_.symbols()[symbol].command.value, 0.0}; }
    Heading turn(Symbol symbol) const {
        if (lattice_.headings > 0) return {lattice_.turn[symbol], 0.0};
        return {0, grammar_.symbols()[symbol].command.angle.degrees};
    }
    Heading add(Heading a, Heading b) const {
        if (lattice_.headings > 0) return {(a.index + b.index) % lattice_.headings, 0.0};
        return {0, std::fmod(a.degrees + b.degrees, 360.0)};
    }
    Point move(const Point& from, const Point& by, Heading heading) const {
        const glm::dvec2 unit =
            unit_vector(lattice_.headings > 0 ? 360.0 * heading.index / lattice_.headings : heading.degrees);
        return {from.x + unit.x * by.x - unit.y * by.y, from.y + unit.y * by.x + unit.x * by.y};
    }
    bool same(const Point& a, const Point& b) const {
        return std::hypot(a.x - b.x, a.y - b.y) <= 1e-9 * std::max(1.0, std::hypot(a.x, a.y));
    }
    Vertex vertex(const Point& point) const { return {point}; }
    bool is_dent(const Vertex& a, const Vertex& b, const Vertex& c) const {
        return (b.at.x - a.at.x) * (c.at.y - a.at.y) <= (b.at.y - a.at.y) * (c.at.x - a.at.x);
    }
    double heading_degrees(Heading heading) const {
        return lattice_.first_heading +
               (lattice_.headings > 0 ? 360.0 * heading.index / lattice_.headings : heading.degrees);
    }

    class Embedding {
    public:
        explicit Embedding(const PlaneSpace& space) : space_(space) {}
        glm::dvec2 placed(const Point& at) const {
            const glm::dvec2 unit = unit_vector(space_.lattice_.first_heading);
            return {unit.x * at.x - unit.y * at.y, unit.y * at.x + unit.x * at.y};
        }
        Quantity quantity(double coordinate) const { return Quantity::of(coordinate); }

    private:
        const PlaneSpace& space_;
    };

private:
    const Lattice& lattice_;
    const Grammar& grammar_;
};

template <class Embedding, class Point>
std::array<Quantity, 2> position(const Embedding& embedding, const Point& point) {
    const auto at = embedding.placed(point);
    return {embedding.quantity(at.x), embedding.quantity(at.y)};
}

template <class Embedding, class Vertex>
std::array<Quantity, 4> box_of(const Embedding& embedding, const std::vector<Vertex>& hull) {
    auto low = embedding.placed(hull.front().at), high = low;
    for (const Vertex& vertex : hull) {
        const auto at = embedding.placed(vertex.at);
        low = {std::min(low.x, at.x), std::min(low.y, at.y)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y)};
    }
    return {embedding.quantity(low.x), embedding.quantity(low.y), embedding.quantity(high.x),
            embedding.quantity(high.y)};
}

/// The corners of a hull, in doubles.
template <class Embedding, class Vertex>
std::vector<glm::dvec2> corners_of(const Embedding& embedding, const std::vector<Vertex>& hull) {
    std::vector<glm::dvec2> corners;
    for (const Vertex& vertex : hull) {
        const auto [x, y] = position(embedding, vertex.at);
        corners.emplace_back(x.value, y.value);
    }
    return corners;
}

// --- composition ---------------------------------------------------------------------------------------------------

template <class Space>
class Folder {
public:
    Folder(const Space& space, const Grammar& grammar) : space_(space), grammar_(grammar) {
        const std::vector<char> needed = grammar.reachable();
        for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
            if (!needed[symbol]) continue;
            needed_.push_back(symbol);
            if (grammar.symbols()[symbol].command.action == Action::move) has_moves_ = true;
        }
    }

    Fold run() {
        Level level(grammar_.symbols().size());
        for (const Symbol symbol : needed_) level[symbol] = std::make_shared<Element>(primitive(symbol));
        if (grammar_.interpretation()) apply(*grammar_.interpretation(), level);
        for (std::size_t i = grammar_.schedule().size(); i > 0; --i) {
            const ScheduleRun& run = grammar_.schedule()[i - 1];
            const Table& table = grammar_.tables()[run.table];
            for (std::int64_t step = 0; step < run.steps && apply(table, level); ++step) {
            }
        }
        Element whole = empty();
        whole.frames.front().box.corners.push_back(space_.vertex(space_.zero()));
        for (const Symbol symbol : grammar_.axiom()) append(whole, *level[symbol]);
        reduce(whole);
        return result(whole);
    }

private:
    using Vertex = typename Space::Vertex;
    struct Placed {
        typename Space::Point at;
        typename Space::Heading heading;
    };
    struct Hull {
        std::vector<Vertex> corners;
        std::size_t limit = 512;  // above it, the corners are made convex again
    };
    /// Extent up to the next ']' whose '[' is outside of the part.
    struct Frame {
        Hull box;  // positions reached
        Hull ink;  // ends of segments drawn; unused if every step draws
    };
    struct Open {
        Placed state;
        Integer position;
    };
    /// Number of pairs that a part of a word leaves open, and the lowest such number within it.
    struct Nesting {
        Integer net = 0, low = 0;
        void append(const Nesting& part) {
            if (part.net == 0 && part.low == 0) return;
            const Integer lower = net + part.low;
            low = std::min(low, lower);
            net += part.net;
        }
        bool is_balanced() const { return net == 0 && low == 0; }
    };
    /// Effect of a part of a word. frames[0] is relative to its start; each ']' without '[' begins a new frame,
    /// relative to the state that it restores. `open` and `end` belong to the last frame.
    struct Element {
        std::vector<Frame> frames;
        std::vector<Integer> pops;  // positions of those ']', counted from 0
        std::vector<Open> open;     // '[' without ']'
        Placed end;
        Integer symbols = 0;
        bool draws = false;
        std::int64_t net = 0;  // net depth of brackets
        std::int64_t highest = 0;
        Nesting braces, edges;  // for polygons, and for inserted edges
        bool has_cylinder = false;
    };
    using Level = std::vector<std::shared_ptr<const Element>>;

    Element empty() const {
        Element element;
        element.frames.resize(1);
        element.end = {space_.zero(), space_.ahead()};
        return element;
    }

    Element primitive(Symbol symbol) const {
        Element element = empty();
        element.symbols = 1;
        const Command& command = grammar_.symbols()[symbol].command;
        if (command.is_step()) {
            element.end.at = space_.step(symbol);
            element.frames[0].box.corners.push_back(space_.vertex(element.end.at));
            element.draws = command.action == Action::draw;
            if (element.draws && has_moves_) {
                element.frames[0].ink.corners = {space_.vertex(space_.zero()), space_.vertex(element.end.at)};
            }
        } else if (command.action == Action::turn) {
            element.end.heading = space_.turn(symbol);
        } else if (command.action == Action::push) {
            element.open.push_back({element.end, 0});
            element.net = element.highest = 1;
        } else if (command.action == Action::pop) {
            element.frames.resize(2);
            element.pops.push_back(0);
            element.net = -1;
        } else if (command.action == Action::polygon_begin) {
            element.braces.net = 1;
            element.has_cylinder = command.value != 0;
        } else if (command.action == Action::polygon_end) {
            element.braces = {-1, -1};
        } else if (command.action == Action::edge_begin) {
            element.edges.net = 1;
        } else if (command.action == Action::edge_end) {
            element.edges = {-1, -1};
        }
        return element;
    }

    /// Replaces each symbol's effect by that of its successor. False if the table changes nothing.
    bool apply(const Table& table, Level& level) {
        Level next = level;
        bool changed = false;
        for (const Symbol symbol : needed_) {
            const Word* successor = table.successor(symbol);
            if (!successor) continue;
            if (successor->size() == 1) {
                next[symbol] = level[successor->front()];
            } else {
                Element element = empty();
                for (const Symbol child : *successor) append(element, *level[child]);
                reduce(element);
                next[symbol] = std::make_shared<Element>(std::move(element));
            }
            changed = changed || next[symbol] != level[symbol];
        }
        level.swap(next);
        return changed;
    }

    void append(Element& element, const Element& part) {
        Placed here = element.end;
        place(element.frames.back(), part.frames.front(), here);
        for (std::size_t i = 1; i < part.frames.size(); ++i) {
            if (!element.open.empty()) {
                here = element.open.back().state;
                element.open.pop_back();
            } else {
                element.frames.emplace_back();
                element.pops.push_back(element.symbols + part.pops[i - 1]);
                here = {space_.zero(), space_.ahead()};
            }
            place(element.frames.back(), part.frames[i], here);
        }
        for (const Open& open : part.open) {
            element.open.push_back({placed(here, open.state), element.symbols + open.position});
        }
        if (element.frames.size() + element.open.size() > most_frames) throw TooMuch();
        element.end = placed(here, part.end);
        element.highest = std::max(element.highest, element.net + part.highest);
        element.net += part.net;
        element.draws = element.draws || part.draws;
        element.braces.append(part.braces);
        element.edges.append(part.edges);
        element.has_cylinder = element.has_cylinder || part.has_cylinder;
        element.symbols += part.symbols;
    }

    Placed placed(const Placed& here, const Placed& part) const {
        return {space_.move(here.at, part.at, here.heading), space_.add(here.heading, part.heading)};
    }

    void place(Frame& frame, const Frame& part, const Placed& here) {
        place(frame.box, part.box, here);
        place(frame.ink, part.ink, here);
    }
    void place(Hull& hull, const Hull& part, const Placed& here) {
        placed_corners_ += part.corners.size();
        if (placed_corners_ > most_corners) throw TooMuch();
        for (const Vertex& vertex : part.corners) {
            hull.corners.push_back(space_.vertex(space_.move(here.at, vertex.at, here.heading)));
        }
        if (hull.corners.size() > hull.limit) make_convex(hull);
    }

    void reduce(Element& element) const {
        for (Frame& frame : element.frames) {
            make_convex(frame.box);
            make_convex(frame.ink);
        }
    }

    /// The convex hull, anticlockwise: Andrew's monotone chain.
    void make_convex(Hull& wanted) const {
        std::vector<Vertex>& points = wanted.corners;
        const auto key = [](const Vertex& vertex) {
            if constexpr (std::is_same_v<Space, PlaneSpace>) {
                return std::pair(vertex.at.x, vertex.at.y);
            } else {
                return std::tie(vertex.key[0], vertex.key[1]);
            }
        };
        std::sort(points.begin(), points.end(), [&](const Vertex& a, const Vertex& b) { return key(a) < key(b); });
        points.erase(std::unique(points.begin(), points.end(),
                                 [&](const Vertex& a, const Vertex& b) { return key(a) == key(b); }),
                     points.end());
        if (points.size() < 3) return;
        std::vector<Vertex> hull;
        const auto add = [&](const Vertex& point, std::size_t fixed) {
            while (hull.size() >= fixed + 2 && space_.is_dent(hull[hull.size() - 2], hull.back(), point)) {
                hull.pop_back();
            }
            hull.push_back(point);
        };
        for (const Vertex& point : points) add(point, 0);
        const std::size_t lower = hull.size() - 1;
        for (std::size_t i = points.size() - 1; i > 0; --i) add(points[i - 1], lower);
        hull.pop_back();
        points.swap(hull);
        wanted.limit = std::max<std::size_t>(512, 2 * points.size());
    }

    Fold result(const Element& whole) const {
        if (!whole.pops.empty()) {
            throw WordError(
                fmt::format("symbol {} of the word: ']' without '['", Integer(whole.pops.front() + 1).str()));
        }
        if (!whole.open.empty()) {
            throw WordError(fmt::format("symbol {} of the word: this '[' is not closed",
                                        Integer(whole.open.back().position + 1).str()));
        }
        if (!whole.braces.is_balanced()) {
            throw BracesError(whole.braces.low < 0 ? "the word has a '}' without '{'"
                                                   : "the word has a '{' that is not closed");
        }
        // A walk finds the place of the error.
        if (!whole.edges.is_balanced() || whole.has_cylinder) throw TooMuch();
        const typename Space::Embedding embedding(space_);
        const Frame& frame = whole.frames.front();
        Fold fold;
        fold.box = box_of(embedding, frame.box.corners);
        if constexpr (std::is_same_v<Space, PlaneSpace>) {
            for (const Quantity& side : fold.box) {
                if (!std::isfinite(side.value)) throw TooMuch();
            }
        }
        fold.box_hull = corners_of(embedding, frame.box.corners);
        if (whole.draws) {
            const auto& ink = has_moves_ ? frame.ink.corners : frame.box.corners;
            fold.ink = box_of(embedding, ink);
            fold.ink_hull = corners_of(embedding, ink);
        }
        fold.end = position(embedding, whole.end.at);
        fold.heading = std::fmod(space_.heading_degrees(whole.end.heading), 360.0);
        if (fold.heading < 0) fold.heading += 360.0;
        if (fold.heading >= 360.0) fold.heading = 0.0;
        fold.closed = space_.same(space_.zero(), whole.end.at);
        fold.depth = whole.highest;
        return fold;
    }

    const Space& space_;
    const Grammar& grammar_;
    std::vector<Symbol> needed_;
    bool has_moves_ = false;
    std::uint64_t placed_corners_ = 0;
};

template <int Rank>
Fold fold_exactly(const Lattice& lattice, const Grammar& grammar, unsigned bits) {
    try {
        const LatticeSpace<Rank, std::int64_t> narrow(lattice, grammar, bits);
        return Folder(narrow, grammar).run();
    } catch (const Overflow&) {
        const LatticeSpace<Rank, Integer> wide(lattice, grammar, bits);
        return Folder(wide, grammar).run();
    }
}

/// Bits that coordinates of an edge may need beyond those of its length.
double extra_bits(const Grammar& grammar) {
    double most = 1;
    for (const EdgeLength& edge : grammar.edges()) {
        double way = 0;
        for (const EdgeLength::Part& part : edge.parts)
            way += std::fabs(part.length) * static_cast<double>(part.count);
        most = std::max(most, way / std::fabs(edge.length));
    }
    return std::ceil(std::log2(most));
}

/// Number of compositions, weighted by the size of the numbers.
double work_of(const Grammar& grammar, double bits) {
    const std::vector<char> needed = grammar.reachable();
    double work = 0;
    for (const ScheduleRun& run : grammar.schedule()) {
        double compositions = 1;
        for (Symbol symbol = 0; symbol < needed.size(); ++symbol) {
            const Word* successor = needed[symbol] ? grammar.tables()[run.table].successor(symbol) : nullptr;
            if (successor) compositions += static_cast<double>(successor->size());
        }
        work += compositions * static_cast<double>(run.steps);
    }
    const double limbs = std::max(1.0, bits / 64);
    return work * limbs * std::sqrt(limbs);
}

}  // namespace

Quantity quantity_of(const Integer& whole) {
    const auto value = whole.convert_to<double>();
    return {value, std::fabs(value) < 0x1p53 ? "" : whole.str()};
}

Quantity quantity_of(const Lattice& lattice, const std::array<Integer, most_coordinates>& real) {
    Integer size = 1;
    for (const Integer& coordinate : real) size += abs(coordinate);
    const auto bits = static_cast<unsigned>(msb(size)) + 64;
    Integer sum = 0;
    for (std::int64_t i = 0; i < lattice.rank; ++i) {
        const Integer& coordinate = real[static_cast<std::size_t>(i)];
        const std::int64_t divisor = std::gcd(i, std::int64_t{lattice.headings});
        if (coordinate != 0) sum += coordinate * fixed_unit_vector({i / divisor, lattice.headings / divisor}, bits).x;
    }
    return quantity(sum, bits, std::llround(1.0 / lattice.unit));
}

Quantity Quantity::of(double value) {
    return {value, std::fabs(value) < 0x1p53 || !std::isfinite(value) ? "" : fmt::format("{:.0f}", value)};
}

std::optional<Fold> fold(const Grammar& grammar, bool refuses_braces) {
    if (!grammar.is_plain() || grammar.map() || grammar.whole_word_steps() > 0) return std::nullopt;
    const Lattice lattice = make_lattice(grammar);
    const double bits = std::max(0.0, estimate(grammar, true)->log10_length) * 3.33 + 48 + extra_bits(grammar);
    if (grammar.axiom().size() > longest_axiom) return std::nullopt;
    if (work_of(grammar, bits) > most_work) return std::nullopt;
    for (const SymbolInfo& symbol : grammar.symbols()) {
        if (!std::isfinite(symbol.command.value) || !std::isfinite(symbol.command.angle.degrees)) return std::nullopt;
    }
    try {
        const auto precision = static_cast<unsigned>(bits);
        if (lattice.rank == 2) return fold_exactly<2>(lattice, grammar, precision);
        if (lattice.rank == 4) return fold_exactly<4>(lattice, grammar, precision);
        if (lattice.rank == 6) return fold_exactly<6>(lattice, grammar, precision);
        if (lattice.rank == 8) return fold_exactly<8>(lattice, grammar, precision);
        const PlaneSpace plane(lattice, grammar);
        return Folder(plane, grammar).run();
    } catch (const TooMuch&) {
        return std::nullopt;
    } catch (const BracesError&) {
        if (refuses_braces) throw;
        return std::nullopt;  // a walk finds the place
    }
}

}  // namespace sikku
