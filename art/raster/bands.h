// art/raster/bands.h: makes a picture in bands on several threads, and delivers them in order.
#pragma once

#include "engine/base/threads.h"

#include <algorithm>
#include <cstddef>
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
    std::vector<Owned> workplaces;
    for (int i = 0; i < std::min(threads + 1, bands); ++i) workplaces.push_back(make());
    on_threads(threads, [&] {
        in_order(
            static_cast<std::size_t>(bands), workplaces.size(),
            [&](std::size_t band, std::size_t place) { draw(*workplaces[place], static_cast<int>(band)); },
            [&](std::size_t band, std::size_t place) { deliver(*workplaces[place], static_cast<int>(band)); });
    });
}

}  // namespace sikku
