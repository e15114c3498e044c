#include "art/gallery/forecast.h"

#include "engine/derivation/forecast.h"

namespace sikku {

JobForecast forecast_job(const GalleryJob& job, bool exact) {
    JobForecast result;
    result.symbols = "?";
    result.seconds = 0.0005;
    if (!job.pattern->text) {
        result.problem = job.pattern->problem;
        return result;
    }
    try {
        if (exact) {
            if (const auto word = forecast(job.document().grammar(), false)) result.symbols = word->length();
        }
        const Cost cost = job.work()->forecast();
        result.seconds = cost.seconds;
        result.bytes = cost.bytes;
        result.memory = cost.memory;
        result.band = cost.band;
    } catch (const std::exception& error) {
        result.problem = error.what();
    }
    return result;
}

double base_memory(bool pictures) {
    return pictures ? 130e6 : 20e6;
}

}  // namespace sikku
