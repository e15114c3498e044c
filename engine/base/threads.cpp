#include "engine/base/threads.h"

#include <oneapi/tbb/concurrent_queue.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace sikku {

namespace tbb = oneapi::tbb;

int thread_count(int threads) {
    return threads > 0 ? threads : tbb::info::default_concurrency();
}

int startable_threads(int wanted) {
    std::atomic<bool> done{false};
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(std::max(wanted, 0)));
    try {
        for (int i = 0; i < wanted; ++i) threads.emplace_back([&done] { done.wait(false); });
    } catch (const std::system_error&) {
    }
    done = true;
    done.notify_all();
    for (std::thread& thread : threads) thread.join();
    return static_cast<int>(threads.size());
}

void on_threads(int threads, const std::function<void()>& work) {
    const int count = 1 + startable_threads(thread_count(threads) - 1);
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(std::max(count, tbb::info::default_concurrency())));
    tbb::task_arena arena(count);
    arena.execute(work);
}

int available_threads() {
    return tbb::this_task_arena::max_concurrency();
}

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
    // Each call is a task of its own, which may wait for others.
    tbb::parallel_for(std::size_t{0}, count, work, tbb::simple_partitioner());
}

void run_both(const std::function<void()>& first, const std::function<void()>& second) {
    tbb::parallel_invoke(first, second);
}

void in_order(std::size_t count, std::size_t places, const std::function<void(std::size_t, std::size_t)>& work,
              const std::function<void(std::size_t, std::size_t)>& deliver) {
    struct Item {
        std::size_t index = 0;
        std::size_t place = 0;
    };
    tbb::concurrent_queue<std::size_t> idle;
    for (std::size_t place = 0; place < places; ++place) idle.push(place);
    std::size_t next = 0;
    const auto begin =
        tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& control) {
            Item item;
            if (next == count) {
                control.stop();
                return item;
            }
            item.index = next++;
            // Never empty: the pipeline limits the items under way to the number of places.
            idle.try_pop(item.place);
            return item;
        });
    const auto make = tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, [&](Item item) {
        work(item.index, item.place);
        return item;
    });
    const auto hand_on = tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, [&](Item item) {
        deliver(item.index, item.place);
        idle.push(item.place);
    });
    tbb::parallel_pipeline(places, begin & make & hand_on);
}

void hand_over_in_order(std::size_t places, int threads, const std::function<bool(std::size_t)>& prepare,
                        const std::function<void(std::size_t)>& work,
                        const std::function<void(std::size_t)>& deliver) {
    const int allowed = std::min(threads, available_threads());
    if (allowed < 2) {
        while (prepare(0)) {
            work(0);
            deliver(0);
        }
        return;
    }
    enum State : int { idle, ready, taken, done };
    std::vector<std::atomic<int>> states(places);
    for (std::atomic<int>& state : states) state = idle;
    // A task that no thread has begun serves the next item of its place, too.
    std::vector<std::atomic<bool>> is_queued(places);
    for (std::atomic<bool>& each : is_queued) each = false;
    const auto try_to_work = [&](std::size_t place) noexcept {
        int expected = ready;
        if (!states[place].compare_exchange_strong(expected, taken)) return;
        work(place);
        states[place] = done;
        states[place].notify_all();
    };
    // In its own arena, a waiting thread starts no other work of the program.
    on_threads(allowed, [&] {
        tbb::task_group group;
        std::size_t prepared = 0;
        std::size_t delivered = 0;
        bool is_more = true;
        try {
            while (true) {
                while (is_more && prepared - delivered < places) {
                    const std::size_t place = prepared % places;
                    is_more = prepare(place);
                    if (!is_more) break;
                    states[place] = ready;
                    if (!is_queued[place].exchange(true)) {
                        group.run([&try_to_work, &is_queued, place] {
                            is_queued[place] = false;
                            try_to_work(place);
                        });
                    }
                    ++prepared;
                }
                if (delivered == prepared) break;
                const std::size_t place = delivered % places;
                try_to_work(place);
                // While another thread works on this place, works on later ones.
                for (std::size_t i = delivered + 1; i < prepared && states[place] != done; ++i)
                    try_to_work(i % places);
                for (int state = states[place]; state != done; state = states[place]) states[place].wait(state);
                deliver(place);
                states[place] = idle;
                ++delivered;
            }
        } catch (...) {
            for (std::atomic<int>& state : states) {
                int expected = ready;
                state.compare_exchange_strong(expected, idle);
            }
            group.wait();
            throw;
        }
        group.wait();
    });
}

}  // namespace sikku
