#include "art/drawing/faint_inks.h"

#include "art/style/contrast.h"
#include "engine/base/chance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_points = 10'000'000;

/// Thrown when nothing more can be found.
struct Found {};

class ContentsSink : public PathSink {
public:
    explicit ContentsSink(const Style& style) : style_(style) {}

    void begin_stroke(glm::dvec2, const Pen& pen) override { change_pen(pen); }
    void change_pen(const Pen& pen) override {
        if (style_.draws(pen)) lines_.insert(style_.index(pen));
    }
    void lines(std::span<const glm::dvec2> ends) override { count(ends.size()); }
    void curves(std::span<const glm::dvec2> controls) override { count(controls.size()); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override {
        contents_.has_polygons = true;
        fill(vertices.size(), pen);
    }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override {
        contents_.has_areas = true;
        fill(outline.size(), pen);
    }
    void disc(glm::dvec2, double, const Pen& pen) override {
        contents_.has_discs = true;
        fill(1, pen);
    }
    Contents contents() const {
        Contents result = contents_;
        result.lines.assign(lines_.begin(), lines_.end());
        result.fills.assign(fills_.begin(), fills_.end());
        return result;
    }

private:
    void fill(std::size_t points, const Pen& pen) {
        fills_.insert(style_.index(pen));
        count(points);
    }
    void count(std::size_t points) {
        points_ += points;
        if (points_ > most_points) throw Found();
    }

    const Style& style_;
    Contents contents_;
    std::set<int> lines_, fills_;
    std::size_t points_ = 0;
};

/// A set of hashed places: open addressing, without memory of its own for each.
class PlaceSet {
public:
    void insert(std::uint64_t place) {
        if (place == none) place = 1;
        if (2 * (size_ + 1) > slots_.size()) grow();
        std::uint64_t& slot = slots_[slot_of(slots_, place)];
        size_ += slot == none ? 1 : 0;
        slot = place;
    }
    std::size_t size() const { return size_; }
    /// The number of places that are in another set, too.
    std::size_t shared(const PlaceSet& other) const {
        if (other.size_ == 0) return 0;
        return static_cast<std::size_t>(std::count_if(slots_.begin(), slots_.end(), [&](std::uint64_t place) {
            return place != none && other.slots_[slot_of(other.slots_, place)] == place;
        }));
    }

private:
    static constexpr std::uint64_t none = 0;

    /// The slot of a place, or the empty one where it belongs.
    static std::size_t slot_of(const std::vector<std::uint64_t>& slots, std::uint64_t place) {
        std::size_t at = static_cast<std::size_t>(place >> 20U) & (slots.size() - 1);
        while (slots[at] != none && slots[at] != place) at = (at + 1) & (slots.size() - 1);
        return at;
    }
    void grow() {
        std::vector<std::uint64_t> larger(std::max<std::size_t>(64, 2 * slots_.size()), none);
        for (const std::uint64_t place : slots_) {
            if (place != none) larger[slot_of(larger, place)] = place;
        }
        slots_ = std::move(larger);
    }

    std::vector<std::uint64_t> slots_;
    std::size_t size_ = 0;
};

/// Finds faint ink. Faint lines along the edges of visible fills are seen as joints, and faint fills by visible lines
/// or fills along their edges; fields of powders have to be visible themselves.
class FaintSink : public PathSink {
public:
    explicit FaintSink(const Print& print) : print_(print), ground_(*print.style.ground) {
        const int count = std::max(static_cast<int>(print.style.palette.size()), 1);
        for (int i = 0; i < count && !has_suspects_; ++i) {
            const Pen pen{.colour = i};
            has_suspects_ =
                is_faint(print.style.line_colour(pen), ground_) || is_faint(print.style.fill_colour(pen), ground_);
        }
    }
    bool has_suspects() const { return has_suspects_; }
    std::vector<FaintInk> found() const {
        std::vector<FaintInk> result;
        for (const FaintInk& ink : inks_) {
            const bool is_between = ink.kind == FaintInk::Kind::lines && lies_on(faint_lines_, visible_fills_);
            const bool is_outlined = ink.kind == FaintInk::Kind::areas && print_.style.powders.empty() &&
                                     (lies_on(faint_fills_, visible_lines_) || lies_on(faint_fills_, visible_fills_));
            if (!is_between && !is_outlined) result.push_back(ink);
        }
        return result;
    }

    void begin_stroke(glm::dvec2 start, const Pen& pen) override {
        pen_ = pen;
        line(std::span(&start, 1), 1);
    }
    void change_pen(const Pen& pen) override { pen_ = pen; }
    void lines(std::span<const glm::dvec2> ends) override { line(ends, 1); }
    void curves(std::span<const glm::dvec2> controls) override { line(controls, 3); }
    void end_stroke(bool) override {}
    void polygon(std::span<const glm::dvec2> vertices, const Pen& pen) override { fill(vertices, 1, pen); }
    void area(std::span<const glm::dvec2> outline, const Pen& pen) override { fill(outline, 3, pen); }
    void disc(glm::dvec2, double, const Pen& pen) override {
        count(1);
        note(FaintInk::Kind::discs, print_.style.fill_colour(pen));
    }

private:
    static constexpr std::size_t most_places = 1'000'000;

    /// Records the ends of lines or curves: each `stride`th point, from the last one.
    void put(PlaceSet& places, std::span<const glm::dvec2> points, std::size_t stride) {
        for (std::size_t i = stride - 1; i < points.size() && places.size() < most_places; i += stride) {
            const auto whole = [](double value) { return static_cast<std::uint64_t>(std::llround(value * 1e5)); };
            places.insert(scrambled(scrambled(whole(points[i].x)) ^ whole(points[i].y)));
        }
    }
    static bool lies_on(const PlaceSet& places, const PlaceSet& others) {
        return 2 * places.shared(others) >= places.size() && others.size() > 0;
    }

    void line(std::span<const glm::dvec2> points, std::size_t stride) {
        count(points.size());
        if (!print_.style.draws(pen_)) return;
        const Colour colour = print_.style.line_colour(pen_);
        if (colour.alpha == 0) return;
        put(note(FaintInk::Kind::lines, colour) ? faint_lines_ : visible_lines_, points, stride);
    }
    void fill(std::span<const glm::dvec2> points, std::size_t stride, const Pen& pen) {
        count(points.size());
        const Colour colour = print_.style.fill_colour(pen);
        if (colour.alpha == 0) return;
        PlaceSet& places = note(FaintInk::Kind::areas, colour) ? faint_fills_ : visible_fills_;
        // The outline of an area begins with its start.
        put(places, stride == 3 ? points.subspan(1) : points, stride);
    }
    void count(std::size_t points) {
        points_ += points;
        if (points_ > most_points) throw Found();
    }
    bool is_faint_here(Colour colour) {
        const auto known =
            std::find_if(tested_.begin(), tested_.end(), [&](const auto& each) { return each.first == colour; });
        if (known != tested_.end()) return known->second;
        const bool is_found = is_faint(colour, ground_);
        constexpr std::size_t most_tested = 16;
        if (tested_.size() < most_tested) tested_.emplace_back(colour, is_found);
        return is_found;
    }
    /// @return true if the colour is faint
    bool note(FaintInk::Kind kind, Colour colour) {
        if (!is_faint_here(colour)) return false;
        const bool is_known = std::any_of(inks_.begin(), inks_.end(),
                                          [&](const FaintInk& ink) { return ink.kind == kind && ink.ink == colour; });
        if (!is_known) inks_.push_back({kind, colour, ground_});
        return true;
    }

    const Print& print_;
    Colour ground_;
    Pen pen_;
    std::vector<FaintInk> inks_;
    std::vector<std::pair<Colour, bool>> tested_;  // colours, and whether they are faint
    PlaceSet faint_lines_, visible_lines_, faint_fills_, visible_fills_;
    bool has_suspects_ = false;
    std::size_t points_ = 0;
};

}  // namespace

std::vector<FaintInk> faint_inks(const Drawing& drawing, const Print& print) {
    if (!print.style.ground || print.style.ground->alpha < 255) return {};
    FaintSink sink(print);
    if (!sink.has_suspects()) return {};
    try {
        drawing.read(print, sink);
    } catch (const Found&) {
    }
    return sink.found();
}

Contents contents_of(const Drawing& drawing, const Print& print) {
    ContentsSink sink(print.style);
    try {
        drawing.read(print, sink);
    } catch (const Found&) {
    }
    return sink.contents();
}

}  // namespace sikku
