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

/// How many of `wanted` threads may be started now beside those that are there: fewer under a low `ulimit -u` or
/// `-v`. Cost: 20 µs a thread.
int startable_threads(int wanted);

/// Calls `work`, whose parallel parts have so many threads (0: all cores), and gives back what it gives. More threads
/// than cores are only had, and without a warning of the library's on the terminal, if they are allowed here. Where
/// fewer threads may be started, which the library would end the program for, there are fewer.
template <typename Work>
decltype(auto) on_threads(int threads, Work&& work) {
    const int count = 1 + startable_threads(thread_count(threads) - 1);
    const oneapi::tbb::global_control allowed(
        oneapi::tbb::global_control::max_allowed_parallelism,
        static_cast<std::size_t>(std::max(count, oneapi::tbb::info::default_concurrency())));
    oneapi::tbb::task_arena arena(count);
    return arena.execute(std::forward<Work>(work));
}

}  // namespace sikku
