#include "music/live/osc_port.h"

#include "engine/base/diagnostic.h"
#include "music/live/osc_messages.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <limits>
#include <map>
#include <utility>

namespace sikku::live {
namespace {

/// As for ALSA's queue: it exceeds the scheduling latency of a busy machine, and delays of most networks.
constexpr Nanoseconds osc_ahead = second / 10;
/// Messages with a later time tag come from a machine whose clock differs; they count at once.
constexpr Nanoseconds latest_tag = second;
constexpr std::size_t most_held = 1000;  // received messages that wait for their time
constexpr int most_packets = 16;         // read at a time, so that floods do not delay notes

class Socket {
public:
    explicit Socket(int family) : descriptor_(socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    ~Socket() {
        if (descriptor_ >= 0) close(descriptor_);
    }
    int get() const { return descriptor_; }

private:
    int descriptor_;
};

struct SocketAddress {
    sockaddr_storage bytes{};
    socklen_t size = 0;
    const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&bytes); }
};

/// Looks up a host. Most programs listen to IPv4 only, so that is preferred.
SocketAddress look_up(const OscAddress& address, const UdpAddress& udp) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = AI_NUMERICSERV;
    addrinfo* list = nullptr;
    if (const int error = getaddrinfo(udp.host.c_str(), udp.port.c_str(), &hints, &list); error != 0) {
        throw PortError(fmt::format("{}: host '{}': {}", address.text, printable(udp.host),
                                    error == EAI_SYSTEM ? std::strerror(errno) : gai_strerror(error)));
    }
    const addrinfo* chosen = list;
    for (const addrinfo* one = list; one && chosen->ai_family != AF_INET; one = one->ai_next) {
        if (one->ai_family == AF_INET) chosen = one;
    }
    SocketAddress found;
    found.size = static_cast<socklen_t>(std::min<std::size_t>(chosen->ai_addrlen, sizeof(found.bytes)));
    std::memcpy(&found.bytes, chosen->ai_addr, found.size);
    freeaddrinfo(list);
    return found;
}

/// Time of the clock of the system minus that of the monotonic clock.
Nanoseconds system_ahead() {
    timespec time{};
    clock_gettime(CLOCK_REALTIME, &time);
    return static_cast<Nanoseconds>(time.tv_sec) * second + time.tv_nsec - MonotonicClock().now();
}

class OscPort final : public Port {
public:
    OscPort(const OscAddress& address, ChangeSink change)
        : name_(address.text),
          change_(std::move(change)),
          to_(look_up(address, address.to)),
          sender_(to_.bytes.ss_family) {
        if (sender_.get() < 0) fail("cannot send", errno);
        if (!address.listen) return;
        const SocketAddress own = look_up(address, *address.listen);
        listener_.emplace(own.bytes.ss_family);
        if (listener_->get() < 0 || bind(listener_->get(), own.get(), own.size) != 0) {
            const int error = errno;
            fail(fmt::format("cannot listen on {} port {}", printable(address.listen->host), address.listen->port),
                 error);
        }
    }

    Nanoseconds ahead() const override { return osc_ahead; }
    bool wants_places() const override { return true; }

    void send(std::span<const Message> messages, Nanoseconds time) override {
        OscBundles bundles(tag_time(time));
        for (const Message& message : messages) translator_.add(message, bundles);
        send(bundles);
    }

    void send_place(const Place& place, Nanoseconds time) override {
        constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
        OscBundles bundles(tag_time(time));
        bundles.add("/sikku/position", {static_cast<int>(std::min(place.bar, most)), place.beat});
        send(bundles);
    }

    std::vector<Received> wait(Clock& clock, Nanoseconds time) override {
        if (!held_.empty()) time = std::min(time, held_.begin()->first);
        if (listener_) {
            receive(clock, time);
        } else {
            clock.sleep_until(time);
        }
        std::vector<Received> due;
        const Nanoseconds now = clock.now();
        for (; !held_.empty() && held_.begin()->first <= now; held_.erase(held_.begin())) {
            due.push_back(held_.begin()->second);
        }
        return due;
    }

private:
    [[noreturn]] void fail(const std::string& what, int error) const {
        throw PortError(fmt::format("{}: {}: {}", name_, what, std::strerror(error)));
    }

    static Nanoseconds tag_time(Nanoseconds time) { return time == at_once ? 0 : time + system_ahead(); }

    void send(const OscBundles& bundles) const {
        for (const std::string& bundle : bundles.bundles()) {
            while (sendto(sender_.get(), bundle.data(), bundle.size(), 0, to_.get(), to_.size) < 0) {
                if (errno != EINTR) fail("cannot send", errno);
            }
        }
    }

    void receive(Clock& clock, Nanoseconds time) {
        const timespec timeout = timespec_of(std::max<Nanoseconds>(0, time - clock.now()));
        pollfd polled{listener_->get(), POLLIN, 0};
        if (ppoll(&polled, 1, &timeout, nullptr) <= 0) return;
        const Nanoseconds now = clock.now();
        for (int i = 0; i < most_packets; ++i) {
            const ssize_t size = recv(listener_->get(), packet_.data(), packet_.size(), MSG_DONTWAIT);
            if (size < 0) return;  // the queue is empty, or the packet was damaged
            std::vector<Received> received;
            read_osc(std::span(packet_).first(static_cast<std::size_t>(size)), received, change_);
            for (const Received& one : received) hold(one, now);
        }
    }

    void hold(Received received, Nanoseconds now) {
        if (held_.size() >= most_held) return;
        const Nanoseconds early = received.time == 0 ? 0 : received.time - system_ahead() - now;
        received.time = early > 0 && early <= latest_tag ? now + early : now;
        held_.emplace(received.time, received);
    }

    std::string name_;
    ChangeSink change_;
    SocketAddress to_;
    Socket sender_;
    std::optional<Socket> listener_;
    OscTranslator translator_;
    std::vector<char> packet_ = std::vector<char>(std::size_t{1} << 16);  // of any size that UDP allows
    std::multimap<Nanoseconds, Received> held_;                           // by their times
};

}  // namespace

bool has_osc() {
    return true;
}

std::unique_ptr<Port> open_osc_port(const OscAddress& address, const ChangeSink& change) {
    return std::make_unique<OscPort>(address, change);
}

}  // namespace sikku::live
