// art/raster/bands.h: makes a picture in bands on several threads, and delivers them in order.
#pragma once

#include "engine/base/threads.h"

#include <oneapi/tbb/concurrent_queue.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace sikku {

/// Calls `draw(workplace, band)` for each of `bands` bands on `threads` threads (0: all cores), and
/// `deliver(workplace, band)` in order, one at a time. `make()` makes a workplace, at most one for each thread and
/// one for a band that waits to be delivered. Exceptions end the work and are passed on.
template <class Make, class Draw, class Deliver>
void in_bands(int bands, int threads, Make&& make, Draw&& draw, Deliver&& deliver) {
    using Owned = decltype(make());
    threads = thread_count(threads);
    if (threads == 1 || bands == 1) {
        const Owned workplace = make();
        for (int band = 0; band < bands; ++band) {
            draw(*workplace, band);
            deliver(*workplace, band);
        }
        return;
    }
    using Workplace = typename Owned::element_type;
    const int workplaces = std::min(threads + 1, bands);
    std::vector<Owned> owned;
    oneapi::tbb::concurrent_queue<Workplace*> idle;
    for (int i = 0; i < workplaces; ++i) {
        owned.push_back(make());
        idle.push(owned.back().get());
    }
    struct Job {
        Workplace* workplace;
        int band;
    };
    int next = 0;
    using oneapi::tbb::filter_mode;
    const auto begin = oneapi::tbb::make_filter<void, Job>(filter_mode::serial_in_order,
                                                           [&](oneapi::tbb::flow_control& control) -> Job {
                                                               if (next == bands) {
                                                                   control.stop();
                                                                   return {};
                                                               }
                                                               Job job{nullptr, next++};
                                                               // Never empty: the pipeline limits the bands under way
                                                               // to the number of workplaces.
                                                               idle.try_pop(job.workplace);
                                                               return job;
                                                           });
    const auto work = oneapi::tbb::make_filter<Job, Job>(filter_mode::parallel, [&](Job job) {
        draw(*job.workplace, job.band);
        return job;
    });
    const auto hand_on = oneapi::tbb::make_filter<Job, void>(filter_mode::serial_in_order, [&](Job job) {
        deliver(*job.workplace, job.band);
        idle.push(job.workplace);
    });
    on_threads(threads,
               [&] { oneapi::tbb::parallel_pipeline(static_cast<std::size_t>(workplaces), begin & work & hand_on); });
}

}  // namespace sikku
