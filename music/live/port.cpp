#include "music/live/port.h"

#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <ctime>
#include <utility>

namespace sikku::live {
namespace {

/// Declared as in the kernel; the C library of Debian 12 lacks it.
struct SchedulingAttributes {
    std::uint32_t size = sizeof(SchedulingAttributes);
    std::uint32_t policy = SCHED_OTHER;
    std::uint64_t flags = 0;
    std::int32_t nice = 0;
    std::uint32_t priority = 0;
    std::uint64_t runtime = 0;  // nanoseconds
    std::uint64_t deadline = 0;
    std::uint64_t period = 0;
};

/// Since Linux 6.12 a thread with shorter slices of time than others runs sooner after it has waited. Every user may
/// ask for that; older kernels ignore it.
void ask_for_short_slices() {
    SchedulingAttributes attributes;
    attributes.flags = 1;  // not for threads that are started later
    attributes.runtime = 100'000;
    syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace

timespec timespec_of(Nanoseconds time) {
    return {static_cast<time_t>(time / second), static_cast<long>(time % second)};
}

Nanoseconds MonotonicClock::now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<Nanoseconds>(time.tv_sec) * second + time.tv_nsec;
}

void MonotonicClock::sleep_until(Nanoseconds time) {
    if (time <= 0) return;
    const timespec until = timespec_of(time);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

void prefer_this_thread() {
    sched_param parameters{};
    parameters.sched_priority = 10;
    if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0) return;
    ask_for_short_slices();
}

void ClockReader::read(std::span<const std::uint8_t> bytes, Nanoseconds time, std::vector<Received>& received) {
    using Kind = Received::Kind;
    static constexpr std::array<std::pair<std::uint8_t, Kind>, 4> kinds = {{{clock_byte, Kind::clock},
                                                                            {start_byte, Kind::start},
                                                                            {continue_byte, Kind::resume},
                                                                            {stop_byte, Kind::stop}}};
    for (const std::uint8_t byte : bytes) {
        for (const auto& [first, kind] : kinds) {
            if (byte == first) received.push_back({time, kind, 0});
        }
        if (byte >= 0xF8) continue;
        if (byte >= 0x80) expected_ = byte == position_byte ? 2 : 0;
        if (byte >= 0x80 || expected_ == 0) continue;
        position_ = expected_ == 2 ? byte : position_ | byte << 7;
        if (--expected_ == 0) received.push_back({time, Kind::position, position_});
    }
}

}  // namespace sikku::live
