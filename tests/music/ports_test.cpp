#include "music/live/ports.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#if __has_include(<alsa/asoundlib.h>)
#include <alsa/asoundlib.h>
#endif

namespace sikku::live::ports_test {

const std::vector<PortInfo> ports = {
    {14, 0, "Midi Through", "Midi Through Port-0", true, true},
    {20, 0, "USB Keys", "USB Keys MIDI 1", true, true},
    {20, 1, "USB Keys", "USB Keys MIDI 2", true, true},
    {24, 0, "Pads", "Pads out", false, true},
    {128, 0, "FLUID Synth (88)", "Synth input port (88:0)", true, false},
};

TEST(Ports, AreChosenByNameOrAddress) {
    const auto chosen = [](const std::string& name) { return choose_port(ports, name).address(); };
    EXPECT_EQ(chosen("20:1"), "20:1");
    EXPECT_EQ(chosen("fluid"), "128:0");
    EXPECT_EQ(chosen("USB Keys MIDI 2"), "20:1");
    EXPECT_EQ(chosen("usb keys"), "20:0") << "the first port of a client";
    EXPECT_EQ(chosen("FLUID Synth (88):Synth input port (88:0)"), "128:0");
    EXPECT_EQ(chosen("through"), "14:0");
}

TEST(Ports, MessagesListThem) {
    const auto refused = [](const std::vector<PortInfo>& known, const std::string& name) -> std::string {
        try {
            return "chosen: " + choose_port(known, name).address();
        } catch (const PortError& error) {
            return error.what();
        }
    };
    EXPECT_EQ(refused(ports, "midi"),
              "several ports are like 'midi': 'Midi Through Port-0' (14:0), 'USB Keys MIDI 1' (20:0), 'USB Keys MIDI "
              "2' (20:1)");
    EXPECT_EQ(refused(ports, "Pads").substr(0, 32), "unknown port 'Pads'; there are: ");
    EXPECT_EQ(refused({}, "x"), "unknown port 'x'; no program or device has one: start a synthesizer first");
}

#if __has_include(<alsa/asoundlib.h>)
/// A client of the sequencer, for the other end.
class Client {
public:
    Client() {
        snd_seq_open(&handle_, "default", SND_SEQ_OPEN_DUPLEX, 0);
        snd_seq_set_client_name(handle_, "Sikku test");
        port_ = snd_seq_create_simple_port(
            handle_, "In and out",
            SND_SEQ_PORT_CAP_WRITE | SND_SEQ_PORT_CAP_SUBS_WRITE | SND_SEQ_PORT_CAP_READ | SND_SEQ_PORT_CAP_SUBS_READ,
            SND_SEQ_PORT_TYPE_APPLICATION);
    }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;
    ~Client() { leave(); }
    void leave() {
        if (handle_) snd_seq_close(handle_);
        handle_ = nullptr;
    }
    snd_seq_event_t next() const {
        snd_seq_event_t* event = nullptr;
        do {
            snd_seq_event_input(handle_, &event);
        } while (event->type == SND_SEQ_EVENT_PORT_SUBSCRIBED);
        return *event;
    }
    void send_clock() const {
        snd_seq_event_t event;
        snd_seq_ev_clear(&event);
        event.type = SND_SEQ_EVENT_CLOCK;
        snd_seq_ev_set_source(&event, static_cast<unsigned char>(port_));
        snd_seq_ev_set_subs(&event);
        snd_seq_ev_set_direct(&event);
        snd_seq_event_output_direct(handle_, &event);
    }

private:
    snd_seq_t* handle_ = nullptr;
    int port_ = 0;
};

TEST(Ports, AlsaDeliversAndReportsTheEnd) {
    if (!has_alsa()) GTEST_SKIP() << "built without ALSA";
    if (!std::filesystem::exists("/dev/snd/seq")) GTEST_SKIP() << "this machine has no ALSA sequencer";
    Client other;
    const auto port = open_alsa_port("Sikku test", true);
    MonotonicClock clock;
    const Nanoseconds due = clock.now() + port->ahead();
    port->send(std::vector<Message>{{0x91, 60, 100}, {0xE1, 0x10, 0x41}, {0x81, 60, 64}}, due);
    const snd_seq_event_t on = other.next();
    EXPECT_GE(clock.now(), due - second / 100) << "the queue delivers events when they are due";
    EXPECT_EQ(on.type, SND_SEQ_EVENT_NOTEON);
    EXPECT_EQ(on.data.note.channel, 1);
    EXPECT_EQ(on.data.note.note, 60);
    EXPECT_EQ(other.next().data.control.value, 0x41 * 128 + 0x10 - 8192);
    EXPECT_EQ(other.next().type, SND_SEQ_EVENT_NOTEOFF);
    other.send_clock();
    std::vector<Received> received;
    for (int i = 0; i < 20 && received.empty(); ++i) received = port->wait(clock, clock.now() + second / 10);
    ASSERT_EQ(received.size(), 1u);
    EXPECT_EQ(received.front().kind, Received::Kind::clock);
    other.leave();
    EXPECT_THROW(for (int i = 0; i < 20; ++i) port->wait(clock, clock.now() + second / 10), PortError);
}
#endif

}  // namespace sikku::live::ports_test
