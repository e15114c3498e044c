// engine/base/threads.h: runs work on a given number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace sikku {

/// `threads`, or, if it is 0 or less, one for each core.
int thread_count(int threads);

/// Number of `wanted` threads that can be started now in addition to the existing ones: fewer under a low `ulimit -u`
/// or `-v`. Cost: 20 µs per thread.
int startable_threads(int wanted);

/// Calls `work`, whose parallel parts use this many threads (0: all cores). More threads than cores are used only if
/// the limits allow them, and without the library's warning. Fewer threads are used if no more can be started, in
/// which case the library would abort the program.
void on_threads(int threads, const std::function<void()>& work);

/// Number of threads that parallel parts use here.
int available_threads();

/// Calls `work(i)` for each i below `count`, in parallel and in any order. Exceptions end the work and are passed on.
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work);

/// Calls both, in parallel. Exceptions are passed on.
void run_both(const std::function<void()>& first, const std::function<void()>& second);

/// Calls `work(i, place)` for each i below `count`, in parallel, and then `deliver(i, place)` in order, one at a
/// time. Places are numbers below `places`, each given to one i at a time. Exceptions end the work and are passed on.
void in_order(std::size_t count, std::size_t places, const std::function<void(std::size_t, std::size_t)>& work,
              const std::function<void(std::size_t, std::size_t)>& deliver);

/// Calls `prepare(place)` until it returns false. After each call that returns true, `work(place)` runs in parallel;
/// then `deliver(place)` is called in the order of `prepare`. The calling thread calls `prepare` and `deliver`.
/// `work` must not throw. Places are numbers below `places`, each in use from `prepare` to `deliver`. Exceptions end
/// the work.
/// @param threads  maximum number of threads
void hand_over_in_order(std::size_t places, int threads, const std::function<bool(std::size_t)>& prepare,
                        const std::function<void(std::size_t)>& work,
                        const std::function<void(std::size_t)>& deliver);

}  // namespace sikku
