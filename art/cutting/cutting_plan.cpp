#include "art/cutting/cutting_plan.h"

#include "art/cutting/nested_sheets.h"
#include "art/drawing/ink_shape.h"
#include "art/print/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_kinds = 1'000;
constexpr std::size_t most_piece_corners = 2'000;
constexpr std::size_t most_sheets = 400;
constexpr std::size_t most_pieces = 200'000;  ///< on one sheet

/// A part of a sheet that is still free.
struct FreeArea {
    std::size_t sheet;
    Box box;
};

class Planner {
public:
    Planner(CuttingPlan& plan, const CuttingOptions& options, const Monitor& monitor)
        : plan_(plan), options_(options), monitor_(monitor) {
        const double half = options.gap / 2;
        const glm::dvec2 low(options.sheet.margin - half);
        whole_ = {low, glm::dvec2(options.sheet.width, options.sheet.height) - low};
    }

    void plan() {
        std::vector<std::size_t> order;
        for (std::size_t kind = 0; kind < plan_.kinds.size(); ++kind) order.push_back(kind);
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            const CutKind &first = plan_.kinds[a], &second = plan_.kinds[b];
            return first.colour != second.colour ? first.colour < second.colour
                                                 : first.area > second.area * (1 + 1e-9);
        });
        for (const CutKind& kind : plan_.kinds) area_of_all_ += kind.area * static_cast<double>(kind.pieces);
        for (auto first = order.begin(); first != order.end();) {
            const auto last = std::find_if(first, order.end(), [&](std::size_t kind) {
                return plan_.kinds[kind].colour != plan_.kinds[*first].colour;
            });
            plan_colour(std::vector<std::size_t>(first, last));
            first = last;
        }
        if (plan_.sheet_count > 0) plan_.in_use /= static_cast<double>(plan_.sheet_count);
    }

private:
    /// @param order  the kinds of one colour, the largest first
    void plan_colour(const std::vector<std::size_t>& order) {
        numbers_ = order;
        kinds_.clear();
        cuts_.clear();
        rows_.clear();
        double area = 0;
        for (const std::size_t number : order) {
            const CutKind& kind = plan_.kinds[number];
            cuts_.push_back(cut_outline(kind, options_.seam + options_.kerf / 2, "a piece on a cutting sheet"));
            kinds_.push_back({with_gap(cuts_.back()), kind.pieces, nullptr});
            rows_.emplace_back(kinds_.back().outline, options_.grain, whole_, monitor_);
            area += kind.area * static_cast<double>(kind.pieces);
        }
        for (std::size_t i = 0; i < order.size(); ++i) kinds_[i].rows = &rows_[i];
        std::vector<SheetDraft> drafts = lay_rows();
        const std::size_t most = most_sheets - plan_.sheets.size();
        std::vector<SheetDraft> nested =
            nest_sheets(kinds_, drafts, whole_, options_.grain, area / area_of_all_, most, monitor_);
        // Pieces in rows share more of their cuts.
        const bool is_less =
            options_.gap > 0 ? needs_less(kinds_, nested, drafts) : count_of(nested) < count_of(drafts);
        if (!nested.empty() && is_less) drafts = std::move(nested);
        for (const SheetDraft& draft : drafts) add(draft);
    }

    /// Lays rows of one kind after another.
    std::vector<SheetDraft> lay_rows() const {
        std::vector<SheetDraft> drafts;
        std::vector<FreeArea> free;
        for (std::size_t i = 0; i < kinds_.size(); ++i) lay(i, drafts, free);
        return drafts;
    }
    LaidPieces fill(std::size_t kind, const Box& area, std::uint64_t left) const {
        LaidPieces laid =
            rows_[kind].fill(area, static_cast<std::size_t>(std::min<std::uint64_t>(left, most_pieces + 1)));
        if (laid.copies.size() <= most_pieces) return laid;
        throw std::runtime_error(
            fmt::format("more than {} pieces fit on one sheet; use smaller sheets or a longer step", most_pieces));
    }
    void lay(std::size_t kind, std::vector<SheetDraft>& drafts, std::vector<FreeArea>& free) const {
        std::uint64_t left = kinds_[kind].pieces;
        const auto add_copies = [&](std::size_t sheet, const LaidPieces& laid) {
            for (const PieceCopy& copy : laid.copies) drafts[sheet].pieces.push_back({kind, copy});
            // Repeated sheets are full.
            if (drafts[sheet].copies > 1) return;
            for (const Box& rest : {laid.beside, laid.below}) {
                if (!rest.empty() && rest.low.y < rest.high.y) free.push_back({sheet, rest});
            }
        };
        for (std::size_t i = 0; i < free.size() && left > 0; ++i) {
            const FreeArea area = free[i];
            const LaidPieces laid = fill(kind, area.box, left);
            if (laid.copies.empty()) continue;
            left -= laid.copies.size();
            free.erase(free.begin() + static_cast<std::ptrdiff_t>(i--));
            add_copies(area.sheet, laid);
        }
        while (left > 0) {
            const LaidPieces laid = fill(kind, whole_, left);
            if (laid.copies.empty()) refuse(plan_.kinds[numbers_[kind]], rows_[kind].least_size());
            require_few_sheets(drafts.size());
            drafts.push_back({{}, left / laid.copies.size()});
            left -= drafts.back().copies * laid.copies.size();
            add_copies(drafts.size() - 1, laid);
        }
    }
    void require_few_sheets(std::size_t drafts) const {
        if (plan_.sheets.size() + drafts < most_sheets) return;
        throw std::runtime_error(
            fmt::format("the pieces need more than {} different sheets; use larger ones", most_sheets));
    }

    /// Adds half a gap to an outline, or to its convex hull if notches are too narrow for that.
    Outline with_gap(const Outline& cut) const {
        try {
            return offset_outline(cut, options_.gap / 2);
        } catch (const std::runtime_error&) {
            return offset_outline(convex_hull(cut), options_.gap / 2);
        }
    }

    [[noreturn]] void refuse(const CutKind& piece, glm::dvec2 size) const {
        const double margins = 2 * options_.sheet.margin;
        size -= glm::dvec2(options_.gap);
        throw std::runtime_error(
            fmt::format("piece {} needs {:.1f} x {:.1f} mm{}, but the sheets are {:g} x {:g} mm within their margins",
                        piece.name, size.x, size.y, options_.seam > 0 ? " with its allowance" : "",
                        options_.sheet.width - margins, options_.sheet.height - margins));
    }

    void add(const SheetDraft& draft) {
        CuttingSheet& sheet = plan_.sheets.emplace_back();
        sheet.colour = plan_.kinds[numbers_.front()].colour;
        sheet.copies = draft.copies;
        std::map<std::pair<std::size_t, double>, std::size_t> forms;
        double lowest = options_.sheet.height;
        for (const NestedPiece& piece : draft.pieces) {
            const PieceCopy& copy = piece.copy;
            const std::size_t kind = numbers_[piece.kind];
            const auto [known, is_new] = forms.try_emplace({piece.kind, copy.turn}, plan_.forms.size());
            if (is_new) {
                plan_.forms.push_back(
                    {kind, turned(cuts_[piece.kind], copy.turn), turned(plan_.kinds[kind].corners, copy.turn)});
            }
            sheet.pieces.push_back({known->second, copy.at});
            const auto same = [&](const auto& count) { return count.first == kind; };
            auto count = std::find_if(sheet.counts.begin(), sheet.counts.end(), same);
            if (count == sheet.counts.end()) count = sheet.counts.insert(count, {kind, 0});
            ++count->second;
            const PieceForm& form = plan_.forms[known->second];
            sheet.in_use += polygon_area(form.cut) / (options_.sheet.width * options_.sheet.height);
            for (const glm::dvec2 corner : form.cut) lowest = std::min(lowest, corner.y + copy.at.y);
        }
        sheet.length = options_.sheet.height - lowest;
        plan_.sheet_count += sheet.copies;
        plan_.in_use += sheet.in_use * static_cast<double>(sheet.copies);
    }

    CuttingPlan& plan_;
    const CuttingOptions& options_;
    const Monitor& monitor_;
    Box whole_;
    double area_of_all_ = 0;  // of all pieces
    /// Of the current colour, the largest first:
    std::vector<std::size_t> numbers_;  // indexes into CuttingPlan::kinds
    std::vector<Outline> cuts_;
    std::vector<NestKind> kinds_;
    std::vector<PieceRows> rows_;
};

}  // namespace

std::vector<glm::dvec2> cut_outline(const CutKind& piece, double growth, std::string_view what) {
    if (piece.corners.size() > most_piece_corners) {
        throw std::runtime_error(fmt::format("piece {} has {} corners; {} has at most {}", piece.name,
                                             piece.corners.size(), what, most_piece_corners));
    }
    try {
        return offset_outline(piece.corners, growth);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("piece {}: {}", piece.name, error.what()));
    }
}

CuttingPlan plan_cutting(std::vector<CutKind> kinds, const CuttingOptions& options, const Monitor& monitor) {
    if (kinds.empty()) throw std::runtime_error("there are no pieces to cut");
    if (kinds.size() > most_kinds) {
        throw std::runtime_error(
            fmt::format("there are {} kinds of pieces; cutting sheets allow at most {}", kinds.size(), most_kinds));
    }
    CuttingPlan plan;
    plan.kinds = std::move(kinds);
    Planner(plan, options, monitor).plan();
    return plan;
}

}  // namespace sikku
