#include "cli/gallery_forecast.h"

#include "art/drawing/draw_view.h"
#include "art/raster/raster.h"
#include "art/style/style.h"
#include "engine/derivation/forecast.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <vector>

namespace sikku {
namespace {

/// Symbols of the word that draw, disc or polygon corner alike.
double drawn_symbols(const Grammar& grammar, const Forecast& known) {
    double drawn = 0;
    for (std::size_t symbol = 0; symbol < grammar.symbols().size() && symbol < known.rough_counts.size(); ++symbol) {
        const Action action = grammar.symbols()[symbol].command.action;
        if (action == Action::draw || action == Action::disc) drawn += known.rough_counts[symbol];
    }
    return drawn;
}

/// Upper bound of the seconds for matching contexts: as if every candidate were compared in full at every symbol of
/// the first word, in every step with contexts. The budget ends it before that.
double matching_seconds(const Grammar& grammar, double budget) {
    constexpr double seconds_a_symbol = 2e-9;
    if (grammar.whole_word_steps() == 0) return 0;
    double compared = 0;
    for (const Table& table : grammar.tables()) {
        if (table.context_free()) continue;
        std::vector<double> lengths(grammar.symbols().size(), 0);
        for (const Production& production : table.productions()) {
            lengths[production.predecessor.front()] +=
                static_cast<double>(production.left.size() + production.predecessor.size() + production.right.size());
        }
        double sum = 0;
        for (const Symbol symbol : grammar.axiom()) sum += lengths[symbol];
        compared = std::max(compared, sum);
    }
    compared *= static_cast<double>(grammar.whole_word_steps());
    return std::min(compared, budget / 4) * seconds_a_symbol;
}

/// @throws what draw() throws before it draws
void forecast_print(const DrawSettings& settings, const Document& loaded, JobForecast& result) {
    PlannedPrint planned = plan_print(settings);
    Diagnostics diagnostics;
    planned.print.style = read_style(loaded.pattern(), settings.dpi, diagnostics);
    diagnostics.throw_if_errors();
    const Grammar grammar = shorten(loaded.grammar());
    const PrintFormat format = planned.drawing.format;
    DrawingCost cost;
    {
        // The parts of large words are large, too: not several at a time.
        static std::mutex mutex;
        std::unique_lock lock(mutex, std::defer_lock);
        if (!is_vector(format)) lock.lock();
        const auto parts = seen_parts(grammar, planned.print.style, planned.drawing);
        if (!parts) require_affordable(grammar, true, settings.budget);
        cost = drawing_cost(grammar, parts ? &*parts : nullptr, planned.print, planned.drawing);
    }
    const double text = static_cast<double>(loaded.pattern().source->text().size());
    const bool spline = planned.print.style.line == Line::spline;
    result.seconds = 0.0005 + cost.nodes * (spline ? 3 : 1.5) * 8e-9;
    result.seconds += matching_seconds(grammar, settings.budget);
    result.memory = cost.memory + text;
    switch (format) {
        case PrintFormat::svg:
            result.seconds += cost.lines * (spline ? 60e-9 : 12e-9);
            result.bytes = 700 + text + cost.lines * (spline ? 30 : 5);
            return;
        case PrintFormat::pdf:
            result.seconds += 0.002 + cost.lines * (spline ? 250e-9 : 80e-9);
            result.bytes = 2000 + text + cost.lines * (spline ? 12 : 3);
            return;
        case PrintFormat::hpgl:
        case PrintFormat::gcode:
            result.seconds += cost.lines * 3e-6;
            result.bytes = 500 + cost.lines * (spline ? 60 : 12);
            result.memory += cost.lines * 250;
            return;
        default:
            break;
    }
    const PixelSize size = pixel_size(planned.print.page, planned.print.dpi);
    const double pixels = static_cast<double>(size.width) * size.height;
    result.seconds += 0.004 + pixels * 22e-9 + cost.lines * (spline ? 6 : 1) * 40e-9;
    result.bytes = 1000 + text + std::min(pixels * 3, pixels * 0.03 + cost.lines * 4);
    result.band = cost.thread_memory;
}

void forecast_score(const GalleryJob& job, const PlaySettings& settings, const Grammar& grammar,
                    JobForecast& result) {
    constexpr double unknown_symbols = 1e6;  // of a word whose length only deriving tells
    const auto known = estimate(grammar, true);
    double nodes = std::min(known ? known->nodes : unknown_symbols, settings.budget);
    double notes = std::min(known ? drawn_symbols(grammar, *known) : nodes / 2, nodes);
    if (job.keys.contains("bars") || job.keys.contains("seconds")) nodes = notes = std::min(notes, 10'000.0);
    result.seconds = 0.001 + nodes * 15e-9 + notes * 80e-9 + matching_seconds(grammar, settings.budget);
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
        const auto load_quietly = [&](const PatternOptions& options) {
            Document loaded = load(options, true);
            if (exact) {
                if (const auto word = forecast(loaded.grammar(), false)) result.symbols = word->length();
            }
            return loaded;
        };
        if (job.is_score()) {
            const PlaySettings settings = score_settings(job, job.file());
            forecast_score(job, settings, load_quietly(settings.pattern).grammar(), result);
        } else {
            const DrawSettings settings = print_settings(job, job.file());
            forecast_print(settings, load_quietly(settings.pattern), result);
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
