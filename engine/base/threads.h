// engine/base/threads.h: runs work on a given number of threads.
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

/// Number of `wanted` threads that can be started now in addition to the existing ones: fewer under a low `ulimit -u`
/// or `-v`. Cost: 20 µs per thread.
int startable_threads(int wanted);

/// Calls `work`, whose parallel parts use this many threads (0: all cores), and returns its result. More threads than
/// cores are used only if the limits allow them, and without the library's warning. Fewer threads are used if no more
/// can be started, in which case the library would abort the program.
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
