#include "engine/measurement.h"

#include "engine/base/json_text.h"
#include "engine/base/memory.h"
#include "engine/language/undrawn.h"
#include "engine/map/map_measurement.h"
#include "engine/map/map_step.h"
#include "engine/measure/extent.h"

namespace sikku {
namespace {

MapMeasurement measured_map(const Document& document, double budget, const Monitor& monitor) {
    const MapLimits limits{budget, static_cast<double>(available_memory()) / 2};
    const Map map = derive_map(document.grammar(), limits, monitor);
    return measure_map(map, *document.map(), document.grammar().steps());
}

Measurement measured_word(const Document& document, double budget, const Monitor& monitor) {
    return measure(document.grammar(), budget, [&](std::uint64_t symbols) { monitor.advance(symbols); });
}

}  // namespace

std::string measure_as_json(const Document& document, double budget, const Monitor& monitor) {
    const std::string title = document.text("title");
    if (document.map()) return measurement_json(title, measured_map(document, budget, monitor));
    std::string json = measurement_json(title, measured_word(document, budget, monitor));
    const auto undrawn = meant_as_steps(document.pattern(), document.grammar());
    if (!undrawn.empty()) json.insert(json.rfind('}'), ", \"undrawn\": " + JsonText(undrawn).text);
    return json;
}

std::string measure_as_text(const Document& document, double budget, const Monitor& monitor) {
    const std::string title = document.text("title");
    if (document.map()) return measurement_text(title, measured_map(document, budget, monitor));
    return measurement_text(title, measured_word(document, budget, monitor));
}

}  // namespace sikku
