// art/gallery/forecast.h: estimates the cost of a job before it begins.
#pragma once

#include "art/gallery/jobs.h"
#include "engine/base/cost.h"

#include <string>

namespace sikku {

/// The forecast of a job, the same on every machine.
struct JobForecast {
    std::string symbols;  ///< length of the word: digits, "about 10^k", or "?" if it must be derived, and for pieces
    Cost cost;            ///< on one thread, in a program that makes nothing else
    std::string problem;  ///< reason why it cannot be made, as far as known

    /// The cost of the job in a program that has already made others.
    double own_seconds() const { return cost.seconds - cost.shared_seconds; }
    double own_memory() const { return cost.memory - cost.shared_memory; }
};

/// @param exact  give the length of the word to the last digit
JobForecast forecast_job(const GalleryJob& job, bool exact);

/// Bytes that the program uses before the first job, with or without the module for pictures.
double base_memory(bool pictures);

}  // namespace sikku
