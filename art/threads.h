// art/threads.h: work on a number of threads.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sikku {

/// `threads`, or, if it is 0 or less, one for each core.
inline int thread_count(int threads) {
    return threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
}

/// Calls `work`, whose parallel parts have so many threads (0: all cores), and gives back what it gives. More threads
/// than cores are only had, and without a warning of the library's on the terminal, if they are allowed here.
template <typename Work>
decltype(auto) on_threads(int threads, Work&& work) {
    const int count = thread_count(threads);
    const oneapi::tbb::global_control allowed(
        oneapi::tbb::global_control::max_allowed_parallelism,
        static_cast<std::size_t>(std::max(count, oneapi::tbb::info::default_concurrency())));
    oneapi::tbb::task_arena arena(count);
    return arena.execute(std::forward<Work>(work));
}

}  // namespace sikku
