#include "art/cutting/piece_nest.h"

#include "art/drawing/ink_shape.h"
#include "art/print/outline.h"
#include "engine/base/threads.h"
#include "engine/geometry/simple_polygon.h"
#include "engine/tiling/polygon_place.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace sikku {
namespace {

constexpr double same_nest_turn = 1e-9;        // radians
constexpr std::size_t most_nest_corners = 60;  // of an outline
constexpr std::size_t most_nest_parts = 14;    // of an outline
constexpr std::size_t most_nest_forms = 60;    // of all kinds
constexpr std::size_t most_nest_kinds = 24;

double positive_turn(double turn) {
    turn = std::fmod(turn, 2 * std::numbers::pi);
    if (turn < 0) turn += 2 * std::numbers::pi;
    return 2 * std::numbers::pi - turn < same_nest_turn ? 0 : turn;
}

/// True if the second outline is a translation of the first.
bool is_displaced(const Outline& a, const Outline& b) {
    const Box first = box_of(a), second = box_of(b);
    const glm::dvec2 way = second.low - first.low;
    constexpr double same = 1e-7;
    return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](glm::dvec2 corner) {
               return std::any_of(b.begin(), b.end(),
                                  [&](glm::dvec2 other) { return glm::length(other - corner - way) < same; });
           });
}

bool boxes_touch(const Box& a, const Box& b) {
    return a.low.x <= b.high.x && a.high.x >= b.low.x && a.low.y <= b.high.y && a.high.y >= b.low.y;
}

/// Angles that turn sides parallel to an axis, those of the longest sides first.
std::vector<double> nest_turns(const Outline& outline, std::size_t most) {
    std::vector<std::pair<double, double>> found;  // length and turn
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 side = outline[(i + 1) % outline.size()] - outline[i];
        for (int quarter = 0; quarter < 4; ++quarter) {
            const double turn = positive_turn(quarter * std::numbers::pi / 2 - std::atan2(side.y, side.x));
            const auto known = std::find_if(found.begin(), found.end(),
                                            [&](const auto& one) { return std::fabs(one.second - turn) < 1e-6; });
            if (known == found.end()) {
                found.emplace_back(glm::length(side), turn);
            } else {
                known->first += glm::length(side);
            }
        }
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first * (1 + 1e-9); });
    found.resize(std::min(found.size(), most));
    std::vector<double> turns;
    for (const auto& [length, turn] : found) turns.push_back(turn);
    return turns;
}

}  // namespace

/// Free places of a form in an area, the best first.
class PieceNest::Places {
public:
    Places(PieceNest& nest, std::size_t form, const Box& area, Goal goal)
        : nest_(nest), form_(form), up_(goal.up), left_(left_of(goal.up)) {
        const Box& box = nest.forms_[form].box;
        const Outline& outline = nest.forms_[form].outline;
        for (const glm::dvec2 corner : outline) {
            lowest_ = std::min(lowest_, scalar_product(up_, corner));
            leftmost_ = std::max(leftmost_, scalar_product(left_, corner));
        }
        if (goal.of_middle) lowest_ = scalar_product(up_, nest.forms_[form].middle);
        room_ = {area.low - box.low, area.high - box.high};
        add(room_.low);
        add(room_.high);
        add({room_.low.x, room_.high.y});
        add({room_.high.x, room_.low.y});
    }

    /// Adds places beside the pieces that were laid since the last call, and returns the best free one.
    std::optional<glm::dvec2> best(const std::vector<Placed>& laid) {
        for (; seen_ < laid.size(); ++seen_) add_beside(laid);
        while (!heap_.empty()) {
            Candidate& top = heap_.front();
            for (; top.checked < laid.size(); ++top.checked) {
                ++work_;
                const NoFit* no_fit = no_fits_[top.checked];
                if (no_fit && no_fit->overlaps(top.at - laid[top.checked].at)) break;
            }
            if (top.checked == laid.size()) return top.at;
            std::pop_heap(heap_.begin(), heap_.end(), is_worse);
            heap_.pop_back();
        }
        return std::nullopt;
    }
    /// The value of a place: more is better.
    double worth(glm::dvec2 at) const { return scalar_product(up_, at) + lowest_; }
    double work() const { return work_; }
    /// Decides between places of equal value.
    double left(glm::dvec2 at) const { return scalar_product(left_, at) + leftmost_; }

private:
    struct Candidate {
        glm::dvec2 at;
        double worth, left;
        std::size_t checked = 0;  ///< pieces that it does not overlap, from the first one on
    };
    static bool is_worse(const Candidate& a, const Candidate& b) {
        return a.worth != b.worth ? a.worth < b.worth : a.left < b.left;
    }

    void add(glm::dvec2 at) {
        constexpr double slack = NoFit::touching;
        if (at.x < room_.low.x - slack || at.x > room_.high.x + slack || at.y < room_.low.y - slack ||
            at.y > room_.high.y + slack) {
            return;
        }
        at = {std::clamp(at.x, std::min(room_.low.x, room_.high.x), std::max(room_.low.x, room_.high.x)),
              std::clamp(at.y, std::min(room_.low.y, room_.high.y), std::max(room_.low.y, room_.high.y))};
        // Equal heights up to rounding are equal.
        constexpr double grain = 1e6;
        heap_.push_back({at, std::round(worth(at) * grain) / grain, left(at), 0});
        std::push_heap(heap_.begin(), heap_.end(), is_worse);
    }

    /// Adds the corners of the no-fit polygon of the next piece, and where it crosses others and the border.
    void add_beside(const std::vector<Placed>& laid) {
        const glm::dvec2 at = laid[seen_].at;
        const NoFit& own = nest_.no_fit(laid[seen_].form, form_);
        const Box box{own.box().low + at, own.box().high + at};
        no_fits_.push_back(boxes_touch(box, room_) ? &own : nullptr);
        if (!no_fits_.back()) return;
        for (const glm::dvec2 point : own.points()) add(point + at);
        for (const NoFit::Side& side : own.sides()) {
            const glm::dvec2 from = side.from + at, along = side.to - side.from;
            for (int axis = 0; axis < 2; ++axis) {
                for (const double line : {room_.low[axis], room_.high[axis]}) {
                    const double share = (line - from[axis]) / along[axis];
                    if (!(share > 0 && share < 1)) continue;
                    glm::dvec2 crossing = from + share * along;
                    crossing[axis] = line;
                    add(crossing);
                }
            }
        }
        work_ += static_cast<double>(seen_);
        for (std::size_t other = 0; other < seen_; ++other) {
            if (!no_fits_[other]) continue;
            const NoFit& beside = *no_fits_[other];
            const glm::dvec2 way = laid[other].at - at;
            if (!boxes_touch({beside.box().low + laid[other].at, beside.box().high + laid[other].at}, box)) continue;
            work_ += static_cast<double>(own.sides().size() * beside.sides().size());
            for (const NoFit::Side& a : own.sides()) {
                Box near;
                near.add(a.from);
                near.add(a.to);
                const glm::dvec2 along = a.to - a.from;
                for (const NoFit::Side& b : beside.sides()) {
                    const glm::dvec2 from = b.from + way, to = b.to + way;
                    if ((from.x < near.low.x && to.x < near.low.x) || (from.x > near.high.x && to.x > near.high.x) ||
                        (from.y < near.low.y && to.y < near.low.y) || (from.y > near.high.y && to.y > near.high.y)) {
                        continue;
                    }
                    const double first = determinant(along, from - a.from), last = determinant(along, to - a.from);
                    if ((first > 0) == (last > 0)) continue;
                    const glm::dvec2 other_way = to - from;
                    const double start = determinant(other_way, a.from - from);
                    const double end = determinant(other_way, a.to - from);
                    if ((start > 0) == (end > 0)) continue;
                    add(at + a.from + (start / (start - end)) * along);
                }
            }
        }
    }

    PieceNest& nest_;
    std::size_t form_;
    glm::dvec2 up_, left_;
    double lowest_ = std::numeric_limits<double>::max();
    double leftmost_ = -std::numeric_limits<double>::max();
    Box room_;
    std::size_t seen_ = 0;
    double work_ = 0;
    std::vector<const NoFit*> no_fits_;  // of the pieces seen
    std::vector<Candidate> heap_;
};

PieceNest::PieceNest(const std::vector<Outline>& outlines, bool keeps_direction, const Monitor& monitor)
    : outlines_(outlines), monitor_(monitor) {
    is_possible_ = outlines.size() <= most_nest_kinds;
    for (const Outline& outline : outlines) {
        is_possible_ = is_possible_ && outline.size() <= most_nest_corners;
        if (!is_possible_) return;
        parts_.push_back(convex_parts(outline));
        is_possible_ = !parts_.back().empty() && parts_.back().size() <= most_nest_parts;
    }
    const std::size_t most = std::max<std::size_t>(most_nest_forms / outlines.size(), 2);
    for (std::size_t kind = 0; kind < outlines.size(); ++kind) {
        monitor.check();
        auto& forms = turned_.emplace_back();
        for (const double turn :
             keeps_direction ? std::vector<double>{0, std::numbers::pi} : nest_turns(outlines[kind], most)) {
            const Outline outline = turned(outlines[kind], turn);
            const bool is_known = std::any_of(forms.begin(), forms.end(), [&](std::size_t form) {
                return is_displaced(forms_[form].outline, outline);
            });
            if (!is_known) forms.push_back(add_form(kind, turn));
        }
    }
}

std::size_t PieceNest::add_form(std::size_t kind, double turn) {
    Form form{kind, turn, turned(outlines_[kind], turn), {}, {}, {}};
    for (const Outline& part : parts_[kind]) form.parts.push_back(turned(part, turn));
    form.box = box_of(form.outline);
    form.middle = mass_of(form.outline).centre;
    forms_.push_back(std::move(form));
    return forms_.size() - 1;
}

std::size_t PieceNest::form_of(const NestedPiece& piece) {
    const double turn = positive_turn(piece.copy.turn);
    for (std::size_t form = 0; form < forms_.size(); ++form) {
        if (forms_[form].kind == piece.kind && std::fabs(forms_[form].turn - turn) < same_nest_turn) return form;
    }
    return add_form(piece.kind, turn);
}

const NoFit& PieceNest::no_fit(std::size_t fixed, std::size_t moved) {
    return *no_fits_.at({fixed, moved});
}

void PieceNest::fill(const Box& area, Goal goal, std::span<const std::size_t> kinds, std::vector<std::uint64_t>& left,
                     std::vector<NestedPiece>& laid) {
    std::vector<Placed> placed;
    std::vector<char> is_laid(forms_.size(), 0);
    for (const NestedPiece& piece : laid) {
        const std::size_t form = form_of(piece);
        placed.push_back({form, piece.copy.at});
        is_laid.resize(forms_.size(), 0);
        is_laid[form] = 1;
    }
    for (const std::size_t kind : kinds) {
        if (left[kind] == 0) continue;
        const std::vector<std::size_t>& moved = turned_[kind];
        // The no-fit polygons of these forms beside those that lie there or will.
        std::vector<std::pair<std::size_t, std::size_t>> wanted;
        for (std::size_t fixed = 0; fixed < forms_.size(); ++fixed) {
            const bool will_lie = std::find(moved.begin(), moved.end(), fixed) != moved.end();
            if (!is_laid[fixed] && !will_lie) continue;
            for (const std::size_t form : moved) {
                if (no_fits_.try_emplace({fixed, form}).second) wanted.emplace_back(fixed, form);
            }
        }
        for_each_index(wanted.size(), [&](std::size_t i) {
            monitor_.check();
            no_fits_.at(wanted[i]) =
                std::make_unique<NoFit>(forms_[wanted[i].first].parts, forms_[wanted[i].second].parts);
        });
        std::vector<std::unique_ptr<Places>> places;
        for (const std::size_t form : moved) {
            const glm::dvec2 size = forms_[form].box.size(), room = area.size();
            if (size.x > room.x + NoFit::touching || size.y > room.y + NoFit::touching) {
                places.push_back(nullptr);
            } else {
                places.push_back(std::make_unique<Places>(*this, form, area, goal));
            }
        }
        std::vector<std::optional<glm::dvec2>> best(moved.size());
        while (left[kind] > 0) {
            monitor_.check();
            for_each_index(moved.size(), [&](std::size_t i) {
                if (places[i]) best[i] = places[i]->best(placed);
            });
            std::optional<std::size_t> chosen;
            double most = 0, leftmost = 0;
            constexpr double near = 1e-6;
            for (std::size_t i = 0; i < moved.size(); ++i) {
                if (!best[i]) continue;
                const double worth = places[i]->worth(*best[i]), begin = places[i]->left(*best[i]);
                if (chosen && !(worth > most + near || (worth > most - near && begin > leftmost + near))) continue;
                chosen = i;
                most = worth;
                leftmost = begin;
            }
            if (!chosen) break;
            const std::size_t form = moved[*chosen];
            placed.push_back({form, *best[*chosen]});
            laid.push_back({kind, {forms_[form].turn, *best[*chosen]}});
            is_laid[form] = 1;
            --left[kind];
        }
        for (const auto& each : places) work_ += each ? each->work() : 0;
    }
}

}  // namespace sikku
