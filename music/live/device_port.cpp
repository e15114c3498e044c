#include "music/live/ports.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>

namespace sikku::live {
namespace {

constexpr int device_patience = 1000;

class DevicePort final : public Port {
public:
    DevicePort(const std::string& path, bool has_input) : path_(path), has_input_(has_input) {
        struct stat status {};
        if (stat(path.c_str(), &status) != 0) fail("cannot open", errno);
        if (!S_ISCHR(status.st_mode) && !S_ISFIFO(status.st_mode)) {
            throw PortError(fmt::format("{}: neither a MIDI device nor a pipe; -o writes files", path));
        }
        descriptor_ = open(path.c_str(), (has_input ? O_RDWR : O_WRONLY) | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
        if (descriptor_ < 0 && errno == ENXIO && S_ISFIFO(status.st_mode)) {
            throw PortError(fmt::format("{}: no program reads this pipe", path));
        }
        if (descriptor_ < 0) fail("cannot open", errno);
    }
    DevicePort(const DevicePort&) = delete;
    DevicePort& operator=(const DevicePort&) = delete;
    ~DevicePort() override { close(descriptor_); }

    void send(std::span<const Message> messages, Nanoseconds) override {
        bytes_.clear();
        for (const Message& message : messages) {
            bytes_.insert(bytes_.end(), message.span().begin(), message.span().end());
        }
        for (std::size_t sent = 0; sent < bytes_.size();) {
            const ssize_t count = write(descriptor_, bytes_.data() + sent, bytes_.size() - sent);
            if (count >= 0) {
                sent += static_cast<std::size_t>(count);
            } else if (errno == EAGAIN) {
                await_room();
            } else if (errno != EINTR) {
                fail("the port has vanished", errno);
            }
        }
    }

    std::vector<Received> wait(Clock& clock, Nanoseconds time) override {
        const timespec timeout = timespec_of(std::max<Nanoseconds>(0, time - clock.now()));
        pollfd polled{descriptor_, static_cast<short>(has_input_ ? POLLIN : 0), 0};
        std::vector<Received> received;
        if (ppoll(&polled, 1, &timeout, nullptr) <= 0) return received;
        if ((polled.revents & (POLLERR | POLLHUP | POLLNVAL)) != 0) fail("the port has vanished", 0);
        const Nanoseconds now = clock.now();
        std::array<std::uint8_t, 256> block{};
        for (;;) {
            const ssize_t count = read(descriptor_, block.data(), block.size());
            if (count < 0 && errno != EAGAIN && errno != EINTR) fail("the port has vanished", errno);
            if (count == 0) fail("no clock can be read from it", 0);
            if (count < 0) return received;
            reader_.read(std::span(block).first(static_cast<std::size_t>(count)), now, received);
        }
    }

private:
    [[noreturn]] void fail(const char* what, int error) const {
        throw PortError(error == 0 ? fmt::format("{}: {}", path_, what)
                                   : fmt::format("{}: {}: {}", path_, what, std::strerror(error)));
    }

    void await_room() const {
        pollfd polled{descriptor_, POLLOUT, 0};
        if (poll(&polled, 1, device_patience) == 0) fail("the port takes no messages", 0);
    }

    std::string path_;
    bool has_input_;
    int descriptor_ = -1;
    std::vector<std::uint8_t> bytes_;
    ClockReader reader_;
};

}  // namespace

std::unique_ptr<Port> open_device(const std::string& path, bool has_input) {
    return std::make_unique<DevicePort>(path, has_input);
}

}  // namespace sikku::live
