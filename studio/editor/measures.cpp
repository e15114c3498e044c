#include "studio/editor/measures.h"

#include "art/product/draw_settings.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "engine/map/map_measurement.h"
#include "engine/map/map_step.h"
#include "engine/measure/extent.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sikku {
namespace {

constexpr double drawing_budget = 2e8;
constexpr double quick_budget = 3e6;  // nodes, which take some 30 ms
constexpr double most_map_edges = 1e5;

std::string decimal_text(const Quantity& quantity) {
    return quantity.digits.empty() ? fmt::format("{}", quantity.value) : quantity.digits;
}

/// True if the line also passes through moves. False for a pattern whose print keys have errors.
bool is_spline(const Document& document) {
    try {
        return read_print_style(document, {}).line == Line::spline;
    } catch (const PatternError&) {
        return false;
    }
}

Measurement measured(const Grammar& grammar, const Monitor& monitor) {
    return measure(grammar, quick_budget, [&](std::uint64_t symbols) { monitor.advance(symbols); });
}

/// The drawn extent; null if it is unknown.
const std::array<Quantity, 4>* drawn_extent(const Measurement& measurement, bool spline) {
    if (!measurement.geometry) return nullptr;
    if (spline) return &measurement.geometry->box;
    return measurement.geometry->ink ? &*measurement.geometry->ink : nullptr;
}

/// `31 x 31 steps`, with three significant digits.
std::string extent_text(const Measurement& measurement, bool spline) {
    if (const auto* box = drawn_extent(measurement, spline)) {
        const auto& [left, bottom, right, top] = *box;
        return fmt::format(", {:.3g} x {:.3g} steps", right.value - left.value, top.value - bottom.value);
    }
    if (measurement.space && measurement.space->ink) {
        const auto size = measurement.space->ink->high - measurement.space->ink->low;
        return fmt::format(", {:.3g} x {:.3g} x {:.3g} steps", size.x, size.y, size.z);
    }
    return {};
}

MapMeasurement measured_map(const Document& document, const Monitor& monitor) {
    const Map map = derive_map(document.grammar(), {most_map_edges, most_map_edges * 1e4}, monitor);
    return measure_map(map, *document.map(), document.grammar().steps());
}

std::string map_text(const Document& document, const Monitor& monitor) {
    const MapMeasurement size = measured_map(document, monitor);
    return counted(size.cells, "cell") + ", " + counted(size.edges, "edge");
}

std::string word_text(const Document& document, const Monitor& monitor) {
    const Measurement measurement = measured(document.grammar(), monitor);
    const bool spline = is_spline(document);
    const Quantity& drawn = spline ? measurement.moves : measurement.drawn;
    return counted(readable(decimal_text(measurement.symbols)), "symbol") + ", " +
           counted(readable(decimal_text(drawn)), "segment") + extent_text(measurement, spline);
}

}  // namespace

QuickMeasures measure_quickly(const Document& document, const Monitor& monitor) {
    QuickMeasures measures;
    const Grammar& grammar = document.grammar();
    try {
        if (document.map()) {
            const MapMeasurement size = measured_map(document, monitor);
            measures.cells = fmt::format("{}", size.cells);
            measures.edges = fmt::format("{}", size.edges);
            return measures;
        }
        const auto expected = estimate(grammar, true);
        measures.is_derivable = !expected || expected->nodes <= drawing_budget;
        if (!measures.is_derivable) {
            measures.most = fmt::format("{}", largest_affordable(grammar, true, drawing_budget));
        }
        const Measurement measurement = measured(grammar, monitor);
        const bool spline = is_spline(document);
        measures.symbols = decimal_text(measurement.symbols);
        measures.segments = decimal_text(spline ? measurement.moves : measurement.drawn);
        if (const auto* box = drawn_extent(measurement, spline)) {
            measures.extent.emplace();
            for (std::size_t side = 0; side < box->size(); ++side)
                (*measures.extent)[side] = decimal_text((*box)[side]);
        }
    } catch (const BudgetError&) {  // the rest stays unknown
    } catch (const WordError&) {    // drawing reports the error
    }
    return measures;
}

std::string measures_text(const Document& document, const Monitor& monitor) {
    try {
        return document.map() ? map_text(document, monitor) : word_text(document, monitor);
    } catch (const BudgetError&) {
        return {};
    } catch (const WordError&) {
        return {};
    }
}

}  // namespace sikku
