#include "art/deep/window_drawing.h"

#include "art/deep/patches.h"
#include "art/drawing/composition.h"
#include "art/drawing/extent_sink.h"
#include "art/drawing/framed_drawing.h"
#include "art/drawing/ink_shape.h"
#include "engine/base/chance.h"
#include "engine/base/numbers.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/plain_form.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Words up to this length are read whole and clipped, so that their strokes stay whole.
constexpr double most_clipped_symbols = 1e5;
/// Places have an error in their 113th bit, decimal lengths and angles in their 53rd; each step adds one such error.
constexpr double place_rounding = 0x1p-113, rounding = 0x1p-53;
constexpr double largest_error = 1e-3;  // in steps

/// The plain form of a grammar, which may be the grammar itself; null if there is none.
std::shared_ptr<const Grammar> plain_of(const std::shared_ptr<const Grammar>& grammar, std::string& why) {
    if (grammar->is_plain()) return grammar;
    if (auto plain = plain_form(*grammar)) return std::make_shared<const Grammar>(*std::move(plain));
    why = "a window needs a pattern without chance and contexts, and with fewer than 100,000 different modules";
    return nullptr;
}

/// The parts of a drawing. Returns nullptr, with the reason in `why`, without parts, or if their places are not
/// precise.
/// @param has_parameters  lengths were computed
std::unique_ptr<Patches> make_patches(const Grammar& plain, bool has_parameters, const Style& style,
                                      std::string& why) {
    auto patches = Patches::make(plain, style, why);
    if (!patches || patches->box().empty()) return patches;
    const glm::dvec2 size = patches->box().high - patches->box().low;
    const double error = std::max(size.x, size.y) * static_cast<double>(patches->levels()) *
                         (has_parameters ? rounding : place_rounding);
    if (error <= largest_error) return patches;
    why = fmt::format(
        "at n = {} the rounding errors of {} add up to more than {} steps; a window needs a smaller "
        "derivation length",
        plain.steps(), has_parameters ? "decimal lengths" : "places", largest_error);
    return nullptr;
}

}  // namespace

WindowDrawing::WindowDrawing(std::shared_ptr<const Grammar> grammar, std::unique_ptr<Patches> patches,
                             const Style& style, const DrawingOptions& options, const Reading& reading)
    : Drawing(options, reading), grammar_(std::move(grammar)), patches_(std::move(patches)), style_(style) {
    const ViewWindow& window = *options.window;
    extent_ = window_extent({0, 0, window.x1 - window.x0, window.y1 - window.y0}, orientation(options.placement));
    extent_.around = patches_->widest();
}

WindowDrawing::~WindowDrawing() = default;

std::unique_ptr<WindowDrawing> WindowDrawing::make(const std::shared_ptr<const Grammar>& grammar, const Style& style,
                                                   const DrawingOptions& options, const Reading& reading,
                                                   std::string& why) {
    // A frame is in the coordinates of the whole drawing.
    if (!options.window || options.frame || grammar->is_spatial() || grammar->map()) return nullptr;
    auto plain = plain_of(grammar, why);
    if (!plain) return nullptr;
    const auto cost = estimate(*plain, true);
    if (cost && cost->nodes <= most_clipped_symbols) return nullptr;
    if (style.line == Line::spline || has_ornaments(style, options) || style.hand > 0 || options.lesson_step ||
        has_frame(style, options) || options.repeat || options.colouring || reading.is_plot() ||
        reading.is_in_sheets) {
        why =
            "splines with polygons, dots, fields, weaves, parallel lines, borders, lines of text, repeats, colours "
            "by strand, hand-drawn lines, colouring pages, sheets and plots need the whole drawing";
        return nullptr;
    }
    auto patches = make_patches(*plain, !grammar->is_plain(), style, why);
    if (!patches) return nullptr;
    return std::unique_ptr<WindowDrawing>(
        new WindowDrawing(std::move(plain), std::move(patches), style, options, reading));
}

double WindowDrawing::scale() const {
    return options_.placement.scale * (grammar_->scale_percent() / 100);
}

void WindowDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    const double width = extent_.around * (style_.stroke.in_steps ? print.placement.step : 1.0);
    const Box box = seen_box(print, window, width + print.press.bleed);
    if (patches_->read({options_.window->x0, options_.window->y0}, box, sink, reading_)) is_empty_ = false;
}

void WindowDrawing::read_samples(PathSink& sink) const {
    patches_->read_samples(sink);
}

void WindowDrawing::report(DrawingReport& report) const {
    report.is_empty = is_empty_;
}

namespace {

/// Adds up the area that polygons cover within a box.
class CoverSink : public PolygonSink {
public:
    explicit CoverSink(const Box& box) : box_(box) {}
    /// Cut at each side of the box. Source: Sutherland & Hodgman, CACM 17, 1974.
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
        corners_.assign(vertices.begin(), vertices.end());
        for (int side = 0; side < 4 && !corners_.empty(); ++side) {
            const int axis = side % 2;
            const auto depth = [&](glm::dvec2 at) {
                return side < 2 ? at[axis] - box_.low[axis] : box_.high[axis] - at[axis];
            };
            kept_.clear();
            for (std::size_t i = 0; i < corners_.size(); ++i) {
                const glm::dvec2 a = corners_[i], b = corners_[(i + 1) % corners_.size()];
                const double from = depth(a), to = depth(b);
                if (from >= 0) kept_.push_back(a);
                if ((from >= 0) != (to >= 0)) kept_.push_back(a + (b - a) * (from / (from - to)));
            }
            std::swap(corners_, kept_);
        }
        if (corners_.size() > 2) area += std::fabs(polygon_area(corners_));
    }

    double area = 0;

private:
    Box box_;
    std::vector<glm::dvec2> corners_, kept_;
};

double area_of(const Box& box) {
    return (box.high.x - box.low.x) * (box.high.y - box.low.y);
}

}  // namespace

std::optional<FilledPage> find_filled_page(const Grammar& grammar, const Style& style, glm::dvec2 size, double around,
                                           const ReadingLimits& limits, std::string& why) {
    constexpr std::int64_t longest = 500, tried_one_by_one = 20;
    constexpr std::uint64_t tries = 40;
    constexpr double uncovered = 1e-7, largest_page = 1e6, spot_size = 0.01;
    Box page;
    page.add(glm::dvec2(-around));
    page.add(size + around);
    const double area = area_of(page);
    if (!(area <= largest_page)) {
        why = fmt::format("the page has more than {:.0f} square steps", largest_page);
        return std::nullopt;
    }
    bool may_have_tiles = true, has_tiles = false;
    std::int64_t searched = 0;
    const auto uncovered_to = [](std::int64_t steps) {
        return fmt::format("its polygons cover no place of this size up to a derivation length of {}", steps);
    };
    const auto refuse = [&](std::string reason) {
        const bool has_none = !may_have_tiles && !has_tiles;
        why = has_none ? "this drawing has no tiles, which are polygons between { and }" : std::move(reason);
        return std::nullopt;
    };
    for (std::int64_t steps = 1; steps <= longest; steps += steps < tried_one_by_one ? 1 : 1 + steps / 10) {
        limits.monitor.check();
        const auto deeper = grammar.with_steps(steps);
        if (!deeper) continue;
        const auto plain = plain_of(std::make_shared<const Grammar>(*deeper), why);
        if (!plain) return refuse(why);
        const auto patches = make_patches(*plain, !grammar.is_plain(), style, why);
        if (!patches)
            return refuse(searched > 0 ? fmt::format("{}; beyond it, {}", uncovered_to(searched), why) : why);
        const glm::dvec2 whole = patches->box().high - patches->box().low;
        // A drawing smaller than the page is not searched, so it may have tiles.
        may_have_tiles = !patches->box().empty();
        if (!may_have_tiles || whole.x * whole.y < area) continue;
        may_have_tiles = false;
        searched = steps;
        for (std::uint64_t i = 0; i < tries; ++i) {
            const QuadVector centre = patches->random_place(scrambled(grammar.seed()) + i);
            // Whole numbers can be given again as a window.
            const auto corner = [](Quad middle, double side) {
                const double low = std::floor(static_cast<double>(middle) - side / 2);
                return static_cast<Quad>(low);
            };
            const QuadVector low{corner(centre.x, size.x), corner(centre.y, size.y)};
            const auto is_covered = [&](const Box& box) {
                CoverSink cover(box);
                patches->read(low, box, cover, limits);
                has_tiles = has_tiles || cover.area > 0;
                return cover.area >= area_of(box) * (1 - uncovered);
            };
            // Most places fail at the edge of the page.
            bool may_fit = true;
            for (int k = 0; k < 16 && may_fit; ++k) {
                if (k == 5 || k == 6 || k == 9 || k == 10) continue;
                const glm::dvec2 at = page.low + (page.high - page.low) * (glm::dvec2(k % 4, k / 4) / 3.0);
                Box spot;
                spot.add(at - spot_size);
                spot.add(at + spot_size);
                may_fit = is_covered(spot);
            }
            if (!may_fit || !is_covered(page)) continue;
            return FilledPage{steps,
                              {low.x, low.y, low.x + static_cast<Quad>(size.x), low.y + static_cast<Quad>(size.y)}};
        }
    }
    return refuse(uncovered_to(longest));
}

}  // namespace sikku
