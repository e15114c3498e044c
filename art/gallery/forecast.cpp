#include "art/gallery/forecast.h"

#include "engine/derivation/forecast.h"

namespace sikku {
namespace {

std::string length_of(const Grammar& grammar) {
    try {
        if (const auto word = forecast(grammar, false)) return word->length();
    } catch (const BudgetError&) {
        // Words too long to count can still be drawn.
    }
    return "?";
}

}  // namespace

JobForecast forecast_job(const GalleryJob& job, bool exact) {
    JobForecast result;
    result.symbols = "?";
    result.cost.seconds = 0.0005;
    if (!job.pattern->text) {
        result.problem = job.pattern->problem;
        return result;
    }
    try {
        if (exact && !job.pattern->piece) result.symbols = length_of(job.document().grammar());
        result.cost = job.work()->forecast();
    } catch (const std::exception& error) {
        result.problem = error.what();
    }
    return result;
}

double base_memory(bool pictures) {
    return pictures ? 130e6 : 20e6;
}

}  // namespace sikku
