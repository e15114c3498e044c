// art/gallery/forecast.h: estimates the cost of a job before it begins.
#pragma once

#include "art/gallery/jobs.h"
#include "engine/base/cost.h"

#include <string>

namespace sikku {

/// The same on every machine.
struct JobForecast {
    std::string symbols;  ///< of the word: digits, "about 10^k", or "?" where only deriving tells, and for pieces
    Cost cost;            ///< on one thread, in a program that makes nothing else
    std::string problem;  ///< why it cannot be made, as far as that is known already

    /// The cost of the job in a program that has already made others.
    double own_seconds() const { return cost.seconds - cost.shared_seconds; }
    double own_memory() const { return cost.memory - cost.shared_memory; }
};

/// @param exact  the length of the word is told to the last digit
JobForecast forecast_job(const GalleryJob& job, bool exact);

/// Bytes that the program takes before the first job, with the module for pictures or without.
double base_memory(bool pictures);

}  // namespace sikku
