// studio/wasm/threads.cpp: the web build has one thread.
#include "engine/base/threads.h"

namespace sikku {

int thread_count(int threads) {
    return threads > 0 ? threads : 1;
}

int startable_threads(int /*wanted*/) {
    return 0;
}

void on_threads(int /*threads*/, const std::function<void()>& work) {
    work();
}

int available_threads() {
    return 1;
}

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = 0; i < count; ++i) work(i);
}

void run_both(const std::function<void()>& first, const std::function<void()>& second) {
    first();
    second();
}

void in_order(std::size_t count, std::size_t /*places*/, const std::function<void(std::size_t, std::size_t)>& work,
              const std::function<void(std::size_t, std::size_t)>& deliver) {
    for (std::size_t i = 0; i < count; ++i) {
        work(i, 0);
        deliver(i, 0);
    }
}

void hand_over_in_order(std::size_t /*places*/, int /*threads*/, const std::function<bool(std::size_t)>& prepare,
                        const std::function<void(std::size_t)>& work,
                        const std::function<void(std::size_t)>& deliver) {
    while (prepare(0)) {
        work(0);
        deliver(0);
    }
}

}  // namespace sikku
