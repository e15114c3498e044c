#include "art/cutting/cutting_plan.h"

#include "art/drawing/ink_shape.h"
#include "art/print/outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

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
        for (const std::size_t kind : order) lay(kind);
        for (CuttingSheet& sheet : plan_.sheets) finish(sheet);
        if (plan_.sheet_count > 0) plan_.in_use /= static_cast<double>(plan_.sheet_count);
    }

private:
    void lay(std::size_t kind) {
        const CutKind& piece = plan_.kinds[kind];
        if (plan_.sheets.empty() || plan_.sheets.back().colour != piece.colour) free_.clear();
        const std::vector<glm::dvec2> cut =
            cut_outline(piece, options_.seam + options_.kerf / 2, "a piece on a cutting sheet");
        const PieceRows rows(with_gap(cut), options_.grain, whole_, monitor_);
        std::uint64_t left = piece.pieces;
        const auto fill = [&](const Box& area) {
            LaidPieces laid =
                rows.fill(area, static_cast<std::size_t>(std::min<std::uint64_t>(left, most_pieces + 1)));
            if (laid.copies.size() <= most_pieces) return laid;
            throw std::runtime_error(fmt::format(
                "more than {} pieces fit on one sheet; use smaller sheets or a longer step", most_pieces));
        };
        for (std::size_t i = 0; i < free_.size() && left > 0; ++i) {
            const FreeArea area = free_[i];
            const LaidPieces laid = fill(area.box);
            if (laid.copies.empty()) continue;
            left -= laid.copies.size();
            free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(i--));
            add(kind, cut, area.sheet, laid);
        }
        while (left > 0) {
            const LaidPieces laid = fill(whole_);
            if (laid.copies.empty()) refuse(piece, rows.least_size());
            if (plan_.sheets.size() == most_sheets) {
                throw std::runtime_error(
                    fmt::format("the pieces need more than {} different sheets; use larger ones", most_sheets));
            }
            CuttingSheet& sheet = plan_.sheets.emplace_back();
            sheet.colour = piece.colour;
            sheet.copies = left / laid.copies.size();
            left -= sheet.copies * laid.copies.size();
            add(kind, cut, plan_.sheets.size() - 1, laid);
        }
    }

    /// Adds half a gap to an outline, or to its convex hull if notches are too narrow for that.
    std::vector<glm::dvec2> with_gap(const std::vector<glm::dvec2>& cut) const {
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

    /// Adds copies to a sheet and keeps the areas that they leave; repeated sheets are full.
    void add(std::size_t kind, const std::vector<glm::dvec2>& cut, std::size_t sheet, const LaidPieces& laid) {
        std::map<double, std::size_t> forms;
        for (const PieceCopy& copy : laid.copies) {
            const auto [at, is_new] = forms.try_emplace(copy.turn, plan_.forms.size());
            if (is_new)
                plan_.forms.push_back({kind, turned(cut, copy.turn), turned(plan_.kinds[kind].corners, copy.turn)});
            plan_.sheets[sheet].pieces.push_back({at->second, copy.at});
        }
        auto& counts = plan_.sheets[sheet].counts;
        if (counts.empty() || counts.back().first != kind) counts.emplace_back(kind, 0);
        counts.back().second += laid.copies.size();
        if (plan_.sheets[sheet].copies > 1) return;
        for (const Box& rest : {laid.beside, laid.below}) {
            if (!rest.empty() && rest.low.y < rest.high.y) free_.push_back({sheet, rest});
        }
    }

    void finish(CuttingSheet& sheet) {
        double lowest = options_.sheet.height;
        for (const PlacedForm& piece : sheet.pieces) {
            const PieceForm& form = plan_.forms[piece.form];
            sheet.in_use += polygon_area(form.cut) / (options_.sheet.width * options_.sheet.height);
            for (const glm::dvec2 corner : form.cut) lowest = std::min(lowest, corner.y + piece.at.y);
        }
        sheet.length = options_.sheet.height - lowest;
        plan_.sheet_count += sheet.copies;
        plan_.in_use += sheet.in_use * static_cast<double>(sheet.copies);
    }

    CuttingPlan& plan_;
    const CuttingOptions& options_;
    const Monitor& monitor_;
    Box whole_;
    std::vector<FreeArea> free_;
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
