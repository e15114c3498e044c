#include "cli/gallery_forecast.h"

#include "art/draw_view.h"
#include "art/raster.h"
#include "engine/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

/// A word whose length only deriving tells is taken for one of so many symbols.
constexpr double unknown_symbols = 1e6;

/// Symbols of the word that draw, disc or polygon corner alike.
double drawn_symbols(const Grammar& grammar, const Forecast& known) {
    double drawn = 0;
    for (std::size_t symbol = 0; symbol < grammar.symbols().size() && symbol < known.rough_counts.size(); ++symbol) {
        const Action action = grammar.symbols()[symbol].command.action;
        if (action == Action::draw || action == Action::disc) drawn += known.rough_counts[symbol];
    }
    return drawn;
}

void forecast_print(const GalleryJob& job, const LoadedPattern& loaded, double nodes, double drawn,
                    JobForecast& result) {
    const PlannedPrint planned = plan_print(print_settings(job, job.file()));
    const double text = static_cast<double>(loaded.pattern.source->text().size());
    const Key* line = loaded.pattern.find("line");
    const bool spline = line && line->value.view() == "spline";
    const double passes = spline ? 3 : 1.5;
    result.seconds = 0.0005 + nodes * passes * 8e-9;
    const double pieces = drawn * (spline ? 6 : 1);
    switch (planned.drawing.format) {
        case PrintFormat::svg:
            result.seconds += drawn * (spline ? 60e-9 : 12e-9);
            result.bytes = 700 + text + drawn * (spline ? 30 : 5);
            result.memory = 4e6 + text;
            return;
        case PrintFormat::pdf:
            result.seconds += 0.002 + drawn * (spline ? 250e-9 : 80e-9);
            result.bytes = 2000 + text + drawn * (spline ? 12 : 3);
            result.memory = 5e6 + text;
            return;
        default:
            break;
    }
    const PixelSize size = pixel_size(planned.print.page, planned.print.dpi);
    const double pixels = static_cast<double>(size.width) * size.height;
    const double rows = std::min({128.0, static_cast<double>(size.height), std::max(32.0, 4194304.0 / size.width)});
    result.seconds += 0.004 + pixels * 22e-9 + pieces * 40e-9;
    result.bytes = 1000 + text + std::min(pixels * 3, pixels * 0.03 + drawn * 4);
    // Lines of the flattened drawing, a band at work, and what the library keeps of the file.
    result.band = size.width * rows * 12;
    result.memory = 6e6 + std::min(pieces * 12, 64e6) + 1.5 * result.band;
}

void forecast_score(const GalleryJob& job, double nodes, double drawn, JobForecast& result) {
    const double notes = drawn;
    result.seconds = 0.001 + nodes * 15e-9 + notes * 80e-9;
    result.bytes = 600 + notes * 9;
    result.memory = 8e6;
    if (job.format == "wav" || job.format == "flac") {
        result.seconds += 1 + notes * 0.002;
        result.bytes += notes * 44'100;
        result.memory += 60e6;
    } else if (job.format != "mid" && job.format != "midi") {
        result.seconds += notes * 1e-6;
        result.bytes += notes * 120;
        result.memory += notes * 300;
    }
}

/// See draw_view().
bool has_view(const Grammar& grammar, const LoadedPattern& loaded, const GalleryJob& job) {
    const PrintFormat format = plan_print(print_settings(job, job.file())).drawing.format;
    if (format == PrintFormat::svg || format == PrintFormat::pdf) return false;
    const Key* line = loaded.pattern.find("line");
    return !(line && line->value.view() == "spline") && Parts<double>::make(grammar).has_value();
}

}  // namespace

JobForecast forecast_job(const GalleryJob& job, bool exact) {
    JobForecast result;
    result.symbols = "?";
    result.seconds = 0.0005;
    if (!job.pattern->text) {
        result.problem = job.pattern->problem;
        return result;
    }
    try {
        const PatternOptions options =
            job.is_score() ? score_settings(job, job.file()).pattern : print_settings(job, job.file()).pattern;
        const LoadedPattern loaded = load(options, true);
        const double budget =
            job.is_score() ? score_settings(job, job.file()).budget : print_settings(job, job.file()).budget;
        const Grammar& grammar = loaded.grammar;
        if (exact) {
            if (const auto word = forecast(grammar, false)) result.symbols = word->length();
        }
        const auto known = estimate(grammar, true);
        double nodes = known ? known->nodes : std::min(unknown_symbols, budget);
        double drawn = known ? drawn_symbols(grammar, *known) : nodes / 2;
        const bool whole = !job.is_score() || !(job.keys.contains("bars") || job.keys.contains("seconds"));
        // A picture of a large word may cost what is seen of it.
        const bool is_seen = !job.is_score() && nodes > most_read_symbols && has_view(grammar, loaded, job);
        if (is_seen) {
            const PlannedPrint planned = plan_print(print_settings(job, job.file()));
            const PixelSize size = pixel_size(planned.print.page, planned.print.dpi);
            nodes = drawn = std::min(nodes, 8.0 * size.width * size.height);
        } else if (nodes > budget && whole && !job.is_score()) {
            require_affordable(shorten(grammar), true, budget);
        }
        nodes = std::min(nodes, budget);
        drawn = std::min(drawn, nodes);
        if (!whole) nodes = drawn = std::min(drawn, 10'000.0);
        if (job.is_score()) {
            forecast_score(job, nodes, drawn, result);
        } else {
            forecast_print(job, loaded, nodes, drawn, result);
        }
    } catch (const std::exception& error) {
        result.problem = error.what();
    }
    return result;
}

double base_memory(bool pictures) {
    return pictures ? 130e6 : 20e6;
}

}  // namespace sikku
