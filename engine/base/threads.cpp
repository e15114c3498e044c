#include "engine/base/threads.h"

#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace sikku {

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

}  // namespace sikku
