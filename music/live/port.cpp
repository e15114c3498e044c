#include "music/live/port.h"

#include <sched.h>

#include <ctime>

namespace sikku::live {

Nanoseconds MonotonicClock::now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<Nanoseconds>(time.tv_sec) * second + time.tv_nsec;
}

void MonotonicClock::sleep_until(Nanoseconds time) {
    if (time <= 0) return;
    timespec until{};
    until.tv_sec = static_cast<time_t>(time / second);
    until.tv_nsec = static_cast<long>(time % second);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

void prefer_this_thread() {
    sched_param parameters{};
    parameters.sched_priority = 10;
    sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters);
}

void ClockReader::read(std::span<const std::uint8_t> bytes, Nanoseconds time, std::vector<Received>& received) {
    using Kind = Received::Kind;
    for (const std::uint8_t byte : bytes) {
        switch (byte) {
            case clock_byte:
                received.push_back({time, Kind::clock, 0});
                continue;
            case start_byte:
                received.push_back({time, Kind::start, 0});
                continue;
            case continue_byte:
                received.push_back({time, Kind::resume, 0});
                continue;
            case stop_byte:
                received.push_back({time, Kind::stop, 0});
                continue;
            case position_byte:
                expected_ = 2;
                continue;
            default:
                break;
        }
        if (byte >= 0xF8) continue;
        if (byte >= 0x80) expected_ = 0;
        if (expected_ == 0) continue;
        position_ = expected_ == 2 ? byte : position_ | byte << 7;
        if (--expected_ == 0) received.push_back({time, Kind::position, position_});
    }
}

}  // namespace sikku::live
