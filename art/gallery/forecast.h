// art/gallery/forecast.h: estimates the cost of a job before it begins.
#pragma once

#include "art/gallery/jobs.h"

#include <string>

namespace sikku {

/// Rough, and the same on every machine.
struct JobForecast {
    std::string symbols;  ///< of the word: digits, "about 10^k", or "?" where only deriving tells, and for pieces
    double seconds = 0;   ///< on one core of a usual machine
    double bytes = 0;     ///< of the file
    double memory = 0;    ///< bytes while it is made on one thread, beside what the program takes
    double band = 0;      ///< more for each further thread, if it is a picture
    std::string problem;  ///< why it cannot be made, as far as that is known already
};

/// @param exact  the length of the word is told to the last digit
JobForecast forecast_job(const GalleryJob& job, bool exact);

/// Bytes that the program takes before the first job, with the module for pictures or without.
double base_memory(bool pictures);

}  // namespace sikku
