#include "music/live/ports.h"

#include <alsa/asoundlib.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <ctime>

namespace sikku::live {
namespace {

constexpr int queue_patience = 1000;
constexpr std::size_t largest_event = 64;
/// Exceeds the scheduling latency of a busy machine; changes are heard with this delay.
constexpr Nanoseconds sent_ahead = second / 10;
constexpr std::size_t most_pending = 2000;  // events; the largest pool that the kernel grants

/// The library reports failures, too.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

/// A queue of the sequencer, which delivers events at their times. Its clock is not that of the program.
class Queue {
public:
    explicit Queue(snd_seq_t* sequencer) : sequencer_(sequencer) {
        number_ = snd_seq_alloc_named_queue(sequencer, "Sikku");
        if (number_ < 0 || snd_seq_queue_status_malloc(&status_) < 0) return;
        const bool is_started =
            snd_seq_start_queue(sequencer, number_, nullptr) >= 0 && snd_seq_drain_output(sequencer) >= 0;
        constexpr int tries = 20;
        Nanoseconds best = INT64_MAX;
        for (int i = 0; is_started && i < tries; ++i) best = std::min(best, measure(best));
        is_running_ = best < INT64_MAX;
    }
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;
    ~Queue() {
        if (status_) snd_seq_queue_status_free(status_);
        if (number_ >= 0) snd_seq_free_queue(sequencer_, number_);
    }
    /// False if the sequencer has no more queues.
    bool is_running() const { return is_running_; }

    /// Sets the time of an event. Times of the program never decrease; neither do those of events.
    void schedule(snd_seq_event_t& event, Nanoseconds time) {
        constexpr Nanoseconds precise = second / 5000;
        if (clock_.now() - measured_ > second) measure(precise);
        last_ = std::max({last_, time + later_, Nanoseconds{0}});
        snd_seq_real_time_t real{};
        real.tv_sec = static_cast<unsigned>(last_ / second);
        real.tv_nsec = static_cast<unsigned>(last_ % second);
        snd_seq_ev_schedule_real(&event, static_cast<unsigned char>(number_), 0, &real);
    }

private:
    /// Compares the clocks, and keeps the result if reading both took less than `limit`. @return its cost
    Nanoseconds measure(Nanoseconds limit) {
        const Nanoseconds before = clock_.now();
        if (snd_seq_get_queue_status(sequencer_, number_, status_) < 0) return INT64_MAX;
        const Nanoseconds after = clock_.now();
        if (after - before >= limit) return after - before;
        const snd_seq_real_time_t* real = snd_seq_queue_status_get_real_time(status_);
        later_ = static_cast<Nanoseconds>(real->tv_sec) * second + real->tv_nsec - before - (after - before) / 2;
        measured_ = after;
        return after - before;
    }

    snd_seq_t* sequencer_;
    MonotonicClock clock_;
    int number_ = -1;
    bool is_running_ = false;
    snd_seq_queue_status_t* status_ = nullptr;
    Nanoseconds later_ = 0;     // its clock minus that of the program
    Nanoseconds measured_ = 0;  // when they were compared
    Nanoseconds last_ = 0;      // time of the last event
};

/// A client of the sequencer.
class Sequencer {
public:
    Sequencer() {
        snd_lib_error_set_handler(say_nothing);
        const int error = snd_seq_open(&handle_, "default", SND_SEQ_OPEN_DUPLEX, SND_SEQ_NONBLOCK);
        if (error < 0) {
            throw PortError(fmt::format(
                "the ALSA sequencer cannot be opened: {}; `sudo modprobe snd-seq` may load it", snd_strerror(error)));
        }
        snd_seq_set_client_name(handle_, "Sikku");
    }
    Sequencer(const Sequencer&) = delete;
    Sequencer& operator=(const Sequencer&) = delete;
    ~Sequencer() { snd_seq_close(handle_); }
    snd_seq_t* get() const { return handle_; }

private:
    snd_seq_t* handle_ = nullptr;
};

std::vector<PortInfo> ports_of(snd_seq_t* sequencer) {
    std::vector<PortInfo> ports;
    snd_seq_client_info_t* client = nullptr;
    snd_seq_port_info_t* port = nullptr;
    if (snd_seq_client_info_malloc(&client) < 0 || snd_seq_port_info_malloc(&port) < 0) throw std::bad_alloc();
    const int own = snd_seq_client_id(sequencer);
    snd_seq_client_info_set_client(client, -1);
    while (snd_seq_query_next_client(sequencer, client) >= 0) {
        const int number = snd_seq_client_info_get_client(client);
        if (number == own || number == SND_SEQ_CLIENT_SYSTEM) continue;
        snd_seq_port_info_set_client(port, number);
        snd_seq_port_info_set_port(port, -1);
        while (snd_seq_query_next_port(sequencer, port) >= 0) {
            const unsigned able = snd_seq_port_info_get_capability(port);
            const auto can = [able](unsigned all) { return (able & all) == all; };
            if ((able & SND_SEQ_PORT_CAP_NO_EXPORT) != 0) continue;
            PortInfo info;
            info.client = number;
            info.number = snd_seq_port_info_get_port(port);
            info.client_name = snd_seq_client_info_get_name(client);
            info.name = snd_seq_port_info_get_name(port);
            info.is_output = can(SND_SEQ_PORT_CAP_WRITE | SND_SEQ_PORT_CAP_SUBS_WRITE);
            info.is_input = can(SND_SEQ_PORT_CAP_READ | SND_SEQ_PORT_CAP_SUBS_READ);
            if (info.is_output || info.is_input) ports.push_back(std::move(info));
        }
    }
    snd_seq_port_info_free(port);
    snd_seq_client_info_free(client);
    return ports;
}

class AlsaPort final : public Port {
public:
    AlsaPort(const std::string& name, bool has_input) : name_(name) {
        const std::vector<PortInfo> ports = ports_of(handle());
        other_ = choose_port(ports, name);
        port_ = check(snd_seq_create_simple_port(
            handle(), "Music",
            SND_SEQ_PORT_CAP_READ | SND_SEQ_PORT_CAP_SUBS_READ | SND_SEQ_PORT_CAP_WRITE | SND_SEQ_PORT_CAP_SUBS_WRITE,
            SND_SEQ_PORT_TYPE_MIDI_GENERIC | SND_SEQ_PORT_TYPE_APPLICATION));
        check(snd_seq_connect_to(handle(), port_, other_.client, other_.number));
        // The sequencer announces what ends.
        check(snd_seq_connect_from(handle(), port_, SND_SEQ_CLIENT_SYSTEM, SND_SEQ_PORT_SYSTEM_ANNOUNCE));
        if (has_input && other_.is_input) check(snd_seq_connect_from(handle(), port_, other_.client, other_.number));
        snd_seq_set_client_pool_output(handle(), most_pending);  // fewer are enough for most music
        if (snd_midi_event_new(largest_event, &encoder_) < 0) throw std::bad_alloc();
        snd_midi_event_no_status(encoder_, 1);
    }
    AlsaPort(const AlsaPort&) = delete;
    AlsaPort& operator=(const AlsaPort&) = delete;
    ~AlsaPort() override { snd_midi_event_free(encoder_); }

    Nanoseconds ahead() const override { return queue_.is_running() ? sent_ahead : 0; }

    void send(std::span<const Message> messages, Nanoseconds time) override {
        for (const Message& message : messages) {
            snd_seq_event_t event;
            snd_seq_ev_clear(&event);
            snd_midi_event_reset_encode(encoder_);
            if (snd_midi_event_encode(encoder_, message.bytes.data(), message.size, &event) < 0) continue;
            snd_seq_ev_set_source(&event, static_cast<unsigned char>(port_));
            snd_seq_ev_set_subs(&event);
            if (queue_.is_running() && time != at_once) {
                queue_.schedule(event, time);
            } else {
                snd_seq_ev_set_direct(&event);
            }
            for (int error = -EAGAIN; error == -EAGAIN;) {
                error = snd_seq_event_output_direct(handle(), &event);
                if (error == -EAGAIN) await_room();
                if (error < 0 && error != -EAGAIN) fail(snd_strerror(error));
            }
        }
    }

    std::vector<Received> wait(Clock& clock, Nanoseconds time) override {
        std::vector<Received> received;
        const timespec timeout = timespec_of(std::max<Nanoseconds>(0, time - clock.now()));
        std::array<pollfd, 4> polled{};
        const int count = snd_seq_poll_descriptors(handle(), polled.data(), polled.size(), POLLIN);
        if (snd_seq_event_input_pending(handle(), 0) == 0 &&
            ppoll(polled.data(), static_cast<nfds_t>(count), &timeout, nullptr) <= 0) {
            return received;
        }
        const Nanoseconds now = clock.now();
        snd_seq_event_t* event = nullptr;
        while (snd_seq_event_input(handle(), &event) >= 0) read(*event, now, received);
        return received;
    }

private:
    snd_seq_t* handle() const { return sequencer_.get(); }

    [[noreturn]] void fail(const std::string& what) const {
        throw PortError(fmt::format("port '{}': {}", name_, what));
    }
    int check(int result) const {
        if (result < 0) fail(snd_strerror(result));
        return result;
    }

    void await_room() const {
        std::array<pollfd, 4> polled{};
        const int count = snd_seq_poll_descriptors(handle(), polled.data(), polled.size(), POLLOUT);
        if (poll(polled.data(), static_cast<nfds_t>(count), queue_patience) == 0) {
            fail("it takes no messages");
        }
    }

    bool is_other(const snd_seq_addr_t& address) const {
        return address.client == other_.client && address.port == other_.number;
    }

    void read(const snd_seq_event_t& event, Nanoseconds now, std::vector<Received>& received) const {
        using Kind = Received::Kind;
        const auto add = [&](Kind kind, int position = 0) { received.push_back({now, kind, position}); };
        switch (event.type) {
            case SND_SEQ_EVENT_CLOCK:
                return add(Kind::clock);
            case SND_SEQ_EVENT_START:
                return add(Kind::start);
            case SND_SEQ_EVENT_CONTINUE:
                return add(Kind::resume);
            case SND_SEQ_EVENT_STOP:
                return add(Kind::stop);
            case SND_SEQ_EVENT_SONGPOS:
                return add(Kind::position, event.data.control.value);
            case SND_SEQ_EVENT_CLIENT_EXIT:
                if (event.data.addr.client == other_.client) fail("it has vanished");
                break;
            case SND_SEQ_EVENT_PORT_EXIT:
                if (is_other(event.data.addr)) fail("it has vanished");
                break;
            case SND_SEQ_EVENT_PORT_UNSUBSCRIBED:
                if (event.data.connect.sender.port == port_ &&
                    event.data.connect.sender.client == snd_seq_client_id(handle()) &&
                    is_other(event.data.connect.dest)) {
                    fail("it was disconnected");
                }
                break;
            default:
                break;
        }
    }

    Sequencer sequencer_;
    Queue queue_{sequencer_.get()};
    std::string name_;
    PortInfo other_;
    int port_ = -1;
    snd_midi_event_t* encoder_ = nullptr;
};

}  // namespace

bool has_alsa() {
    return true;
}

std::vector<PortInfo> list_ports() {
    const Sequencer sequencer;
    return ports_of(sequencer.get());
}

std::unique_ptr<Port> open_alsa_port(const std::string& name, bool has_input) {
    return std::make_unique<AlsaPort>(name, has_input);
}

}  // namespace sikku::live
