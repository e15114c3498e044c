#include "art/cutting/nested_sheets.h"

#include "art/drawing/ink_shape.h"
#include "art/print/outline.h"
#include "engine/base/chance.h"
#include "engine/tiling/polygon_place.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace sikku {
namespace {

/// Pieces on a sheet, above which the search would take too long.
constexpr std::size_t most_nested_on_sheet = 1'500;
/// Steps of PieceNest for all sheets of a plan: always, and where this may save a sheet.
constexpr double usual_work = 1.5e8, most_work = 8e8;
constexpr double most_density = 0.95;  ///< largest share of an area that pieces are expected to fill
constexpr double same_area = 1e-9;     // relative difference

class SheetNester {
public:
    SheetNester(std::span<const NestKind> kinds, const Box& area, bool keeps_direction, const Monitor& monitor)
        : kinds_(kinds), area_(area), monitor_(monitor), nest_(outlines_of(kinds), keeps_direction, monitor) {
        order_.resize(kinds.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        for (const NestKind& kind : kinds) mass_.push_back(mass_of(kind.outline));
    }
    bool is_possible() const { return nest_.is_possible(); }

    std::vector<SheetDraft> plan(double work, std::size_t sheet_limit) {
        std::vector<SheetDraft> sheets;
        const double end = nest_.work() + 2 * work;
        left_.clear();
        for (const NestKind& kind : kinds_) left_.push_back(kind.pieces);
        while (std::any_of(left_.begin(), left_.end(), [](std::uint64_t count) { return count > 0; })) {
            if (sheets.size() == sheet_limit || nest_.work() > end) return {};
            // The first sheet is often one of many alike.
            const double begin = nest_.work(), share = work / 2;
            Draft best = first_draft(begin + share / 2);
            if (best.pieces.empty()) return {};
            improve(best, begin + share);
            work -= std::min(share, nest_.work() - begin);
            SheetDraft& sheet = sheets.emplace_back();
            sheet.copies = std::numeric_limits<std::uint64_t>::max();
            for (const std::size_t kind : order_) {
                const std::uint64_t count = left_[kind] - best.left[kind];
                if (count > 0) sheet.copies = std::min(sheet.copies, left_[kind] / count);
            }
            for (const std::size_t kind : order_) left_[kind] -= sheet.copies * (left_[kind] - best.left[kind]);
            sheet.pieces = std::move(best.pieces);
        }
        return sheets;
    }

private:
    struct Draft {
        std::vector<NestedPiece> pieces;
        std::vector<std::uint64_t> left;  ///< pieces of kinds that have no room
    };
    /// Less is better; the first difference decides.
    struct Score {
        double left = 0;    ///< area of pieces that have no room
        double length = 0;  ///< used if none are left
        double depth = 0;   ///< of all pieces: free places gather at the bottom
        bool operator<(const Score& other) const {
            if (std::fabs(left - other.left) > same_area * (left + other.left)) return left < other.left;
            if (std::fabs(length - other.length) > 1e-6) return length < other.length;
            return depth < other.depth;
        }
    };

    static std::vector<Outline> outlines_of(std::span<const NestKind> kinds) {
        std::vector<Outline> outlines;
        for (const NestKind& kind : kinds) outlines.push_back(kind.outline);
        return outlines;
    }

    /// @param end  value of PieceNest::work() after which one draft is enough
    Draft first_draft(double end) {
        Draft best;
        Score least;
        for (const bool has_rows : {true, false}) {
            constexpr int directions = 4;
            for (int i = 0; i < 2 * directions; ++i) {
                if (!best.pieces.empty() && nest_.work() > end) return best;
                Draft draft{{}, left_};
                if (has_rows) lay_rows(draft);
                nest_.fill(area_, goal(std::numbers::pi * (i / 2) / 2, i % 2 == 1), order_, draft.left, draft.pieces);
                const Score score = score_of(draft);
                if (!best.pieces.empty() && !(score < least)) continue;
                best = std::move(draft);
                least = score;
            }
        }
        return best;
    }
    void lay_rows(Draft& draft) const {
        const auto kind = static_cast<std::size_t>(
            std::find_if(left_.begin(), left_.end(), [](std::uint64_t count) { return count > 0; }) - left_.begin());
        const auto most = static_cast<std::size_t>(std::min<std::uint64_t>(left_[kind], most_nested_on_sheet));
        for (const PieceCopy& copy : kinds_[kind].rows->fill(area_, most).copies)
            draft.pieces.push_back({kind, copy});
        draft.left[kind] -= draft.pieces.size();
    }
    static PieceNest::Goal goal(double turn, bool of_middle) {
        return {{-std::sin(turn), std::cos(turn)}, of_middle};
    }

    Score score_of(const Draft& draft) const {
        Score score;
        for (const std::size_t kind : order_) score.left += mass_[kind].area * static_cast<double>(draft.left[kind]);
        if (score.left == 0) score.length = area_.high.y - lowest_of(kinds_, draft.pieces);
        for (const NestedPiece& piece : draft.pieces) score.depth -= mass_[piece.kind].area * middle_of(piece).y;
        return score;
    }
    glm::dvec2 middle_of(const NestedPiece& piece) const {
        const glm::dvec2 way(std::cos(piece.copy.turn), std::sin(piece.copy.turn));
        return complex_product(mass_[piece.kind].centre, way) + piece.copy.at;
    }

    /// @param end  value of PieceNest::work() at which the search ends
    void improve(Draft& best, double end) {
        Score least = score_of(best);
        std::uint64_t state = 1;
        const auto chance = [&] {
            state = scrambled(state + 0x9e3779b97f4a7c15);
            return static_cast<double>(state >> 11U) * 0x1p-53;
        };
        const Box box = box_of(kinds_.front().outline);
        const double size = box.longest();
        // The search also ends if it has little to do, as for a single piece.
        for (int round = 0; round < 5'000 && nest_.work() < end; ++round) {
            monitor_.check();
            const glm::dvec2 middle = area_.low + area_.size() * glm::dvec2(chance(), chance());
            const glm::dvec2 half = size * (0.5 + glm::dvec2(chance(), chance()));
            const Box window{middle - half, middle + half};
            Draft draft{{}, best.left};
            Box around = window;
            for (const NestedPiece& piece : best.pieces) {
                if (!window.contains(middle_of(piece))) {
                    draft.pieces.push_back(piece);
                    continue;
                }
                ++draft.left[piece.kind];
                for (const glm::dvec2 corner : turned(kinds_[piece.kind].outline, piece.copy.turn)) {
                    around.add(corner + piece.copy.at);
                }
            }
            constexpr double reach = 0.15;
            around = {glm::max(around.low - reach * size, area_.low),
                      glm::min(around.high + reach * size, area_.high)};
            const bool is_up = chance() < 0.5, of_middle = chance() < 0.7;
            const double turn = is_up ? 0 : 2 * std::numbers::pi * chance();
            nest_.fill(around, goal(turn, of_middle), order_, draft.left, draft.pieces);
            const Score score = score_of(draft);
            if (least < score) continue;
            best = std::move(draft);
            least = score;
        }
    }

    std::span<const NestKind> kinds_;
    Box area_;
    Monitor monitor_;
    PieceNest nest_;
    std::vector<std::size_t> order_;
    std::vector<PolygonMass> mass_;    // of kinds
    std::vector<std::uint64_t> left_;  // pieces of kinds that are not planned yet
};

}  // namespace

double lowest_of(std::span<const NestKind> kinds, const std::vector<NestedPiece>& pieces) {
    double lowest = std::numeric_limits<double>::max();
    for (const NestedPiece& piece : pieces) {
        for (const glm::dvec2 corner : turned(kinds[piece.kind].outline, piece.copy.turn)) {
            lowest = std::min(lowest, corner.y + piece.copy.at.y);
        }
    }
    return lowest;
}

std::uint64_t count_of(const std::vector<SheetDraft>& sheets) {
    std::uint64_t count = 0;
    for (const SheetDraft& sheet : sheets) count += sheet.copies;
    return count;
}

bool needs_less(std::span<const NestKind> kinds, const std::vector<SheetDraft>& sheets,
                const std::vector<SheetDraft>& others) {
    const std::uint64_t count = count_of(sheets), other_count = count_of(others);
    if (count != other_count) return count < other_count;
    const auto free = [&](const std::vector<SheetDraft>& all) {
        double most = -std::numeric_limits<double>::max();
        for (const SheetDraft& sheet : all) most = std::max(most, lowest_of(kinds, sheet.pieces));
        return most;
    };
    constexpr double least = 0.01;  // millimetres
    return free(sheets) > free(others) + least;
}

std::vector<SheetDraft> nest_sheets(std::span<const NestKind> kinds, const std::vector<SheetDraft>& rows,
                                    const Box& area, bool keeps_direction, double effort, std::size_t sheet_limit,
                                    const Monitor& monitor) {
    const bool has_many = std::any_of(
        rows.begin(), rows.end(), [](const SheetDraft& sheet) { return sheet.pieces.size() > most_nested_on_sheet; });
    if (has_many) return {};
    double pieces = 0, area_of_pieces = 0;
    for (const NestKind& kind : kinds) {
        const auto count = static_cast<double>(kind.pieces);
        pieces += count;
        area_of_pieces += polygon_area(kind.outline) * count;
    }
    const double on_full_sheet = pieces * area.size().x * area.size().y / area_of_pieces;
    SheetNester nester(kinds, area, keeps_direction, monitor);
    if (!nester.is_possible()) return {};
    std::vector<SheetDraft> sheets = nester.plan(effort * usual_work, sheet_limit);
    const double least = std::ceil(pieces / (on_full_sheet * most_density));
    if (static_cast<double>(count_of(sheets)) <= least) return sheets;
    std::vector<SheetDraft> others = nester.plan(effort * most_work, sheet_limit);
    return !others.empty() && needs_less(kinds, others, sheets) ? others : sheets;
}

}  // namespace sikku
