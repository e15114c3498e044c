// tests/music/osc_test.cpp: live music as OSC messages. The other end reads and writes the bytes itself.
#include "music/live/osc_port.h"

#include "music/scores.h"
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku::live::osc_test {

// --- bytes of OSC

std::string number(std::uint64_t value, int bytes = 4) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
    return text;
}

std::string padded(std::string_view text) {
    std::string bytes(text);
    do {
        bytes += '\0';
    } while (bytes.size() % 4 != 0);
    return bytes;
}

/// @param types  without the comma
std::string message(std::string_view address, std::string_view types = "", std::string_view data = "") {
    return padded(address) + padded("," + std::string(types)) + std::string(data);
}

std::string set_message(std::string_view key, std::string_view value) {
    return message("/sikku/set", "ss", padded(key) + padded(value));
}

/// @param time  in seconds since 1900; 0: at once
std::string bundle(const std::vector<std::string>& elements, double time = 0) {
    const double whole = std::floor(time);
    const std::uint64_t tag =
        time == 0 ? 1 : static_cast<std::uint64_t>(whole) << 32 | static_cast<std::uint64_t>((time - whole) * 0x1p32);
    std::string bytes = std::string("#bundle\0", 8) + number(tag, 8);
    for (const std::string& one : elements) bytes += number(one.size()) + one;
    return bytes;
}

/// Seconds since 1900.
double system_time() {
    const auto since = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since).count() + 2'208'988'800.0;
}

struct Heard {
    std::string address;
    std::string types;
    std::vector<double> values;
    double due = 0;      ///< the time tag, in seconds since 1900; 0: at once
    double arrived = 0;  ///< in the same way
};

/// Reads bundles, and expects exactly what the program may send.
class BundleReader {
public:
    BundleReader(std::string_view bytes, double arrived) : bytes_(bytes), arrived_(arrived) {}
    void read(std::vector<Heard>& heard) {
        ASSERT_EQ(take(8), std::string("#bundle\0", 8));
        const std::uint64_t tag = take_number(8);
        const double due =
            tag == 1 ? 0 : static_cast<double>(tag >> 32) + static_cast<double>(tag & 0xFFFFFFFF) * 0x1p-32;
        while (!bytes_.empty()) {
            const std::size_t left = take_number(4);
            const std::size_t end = bytes_.size() - left;
            Heard one{take_text(), take_text().substr(1), {}, due, arrived_};
            for (const char type : one.types) {
                const auto bits = static_cast<std::uint32_t>(take_number(4));
                float real = 0;
                std::memcpy(&real, &bits, 4);
                one.values.push_back(type == 'i' ? static_cast<std::int32_t>(bits) : static_cast<double>(real));
            }
            ASSERT_EQ(bytes_.size(), end) << one.address;
            heard.push_back(std::move(one));
        }
    }

private:
    std::string_view take(std::size_t count) {
        const std::string_view part = bytes_.substr(0, count);
        bytes_.remove_prefix(std::min(count, bytes_.size()));
        return part;
    }
    std::uint64_t take_number(std::size_t count) {
        std::uint64_t value = 0;
        for (const char byte : take(count)) value = value << 8 | static_cast<unsigned char>(byte);
        return value;
    }
    std::string take_text() {
        const std::size_t size = bytes_.find('\0');
        return std::string(take((size / 4 + 1) * 4).substr(0, size));
    }
    std::string_view bytes_;
    double arrived_;
};

/// A UDP socket of the other end, on this machine.
class Peer {
public:
    explicit Peer(int family = AF_INET) : family_(family), socket_(socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in6 six = address_six(0);
        sockaddr_in four = address_four(0);
        is_bound_ = family == AF_INET6 ? bind(socket_, reinterpret_cast<sockaddr*>(&six), sizeof six) == 0
                                       : bind(socket_, reinterpret_cast<sockaddr*>(&four), sizeof four) == 0;
        const int room = 1 << 20;
        setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
    }
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;
    ~Peer() { close(socket_); }
    bool is_bound() const { return is_bound_; }
    std::string port() const {
        sockaddr_in6 own{};
        socklen_t size = sizeof own;
        getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size);
        return std::to_string(ntohs(own.sin6_port));  // at the same place for IPv4
    }
    std::string address() const { return (family_ == AF_INET6 ? "osc://[::1]:" : "osc://127.0.0.1:") + port(); }
    void send(const std::string& port, std::string_view bytes) const {
        const sockaddr_in to = address_four(static_cast<std::uint16_t>(std::stoi(port)));
        sendto(socket_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    }

    /// Reads until `is_enough`, or for so many seconds.
    template <typename Test>
    bool read_until(Test&& is_enough, double seconds = 60) {
        const double begin = system_time();
        while (!is_enough(heard_)) {
            if (system_time() - begin > seconds) return false;
            pollfd polled{socket_, POLLIN, 0};
            if (poll(&polled, 1, 20) <= 0) continue;
            std::array<char, 65536> bytes{};
            const ssize_t size = recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
            if (size < 0) continue;
            EXPECT_LE(size, 1472) << "fits into a packet of Ethernet";
            BundleReader({bytes.data(), static_cast<std::size_t>(size)}, system_time()).read(heard_);
        }
        return true;
    }
    bool read_until_count(const std::string& address, std::size_t count) {
        return read_until([&](const std::vector<Heard>&) { return all(address).size() >= count; });
    }
    void read_rest(double seconds = 0.3) {
        read_until([](const std::vector<Heard>&) { return false; }, seconds);
    }
    const std::vector<Heard>& heard() const { return heard_; }
    std::vector<Heard> all(const std::string& address) const {
        std::vector<Heard> found;
        for (const Heard& one : heard_) {
            if (one.address == address) found.push_back(one);
        }
        return found;
    }
    std::set<double> programs() const {
        std::set<double> found;
        for (const Heard& one : all("/sikku/program")) found.insert(one.values.at(1));
        return found;
    }

private:
    static sockaddr_in address_four(std::uint16_t port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return address;
    }
    static sockaddr_in6 address_six(std::uint16_t port) {
        sockaddr_in6 address{};
        address.sin6_family = AF_INET6;
        address.sin6_port = htons(port);
        address.sin6_addr = in6addr_loopback;
        return address;
    }
    int family_;
    int socket_;
    bool is_bound_ = false;
    std::vector<Heard> heard_;
};

/// The number of a port that nobody listens on.
std::string free_port() {
    return Peer().port();
}

/// A thread that reads while the program runs.
Outcome run_heard(const std::vector<std::string>& arguments, Surroundings surroundings, Peer& peer) {
    std::atomic<bool> is_over{false};
    Outcome outcome;
    std::thread runner([&] {
        outcome = run(arguments, std::move(surroundings));
        is_over = true;
    });
    peer.read_until([&](const std::vector<Heard>&) { return is_over.load(); }, 150);
    runner.join();
    peer.read_rest();
    return outcome;
}

#define NEEDS_OSC() \
    if (!has_osc()) GTEST_SKIP() << "built without liblo"

/// A bar lasts 240 ms.
const std::string curve =
    "axiom: X\nderivation length: 3\nX --> -YF+XFX+FY-\nY --> +XF-YFY-FX+\ntempo: 1000\ninstrument: Flute\n";

constexpr double seconds_per_tick = 60.0 / (1000.0 * ticks_per_quarter);

/// Compares what was heard with the notes of the pattern.
/// @param precision  of keys, in semitones
void expect_notes(const Peer& peer, const NoteList& list, double precision = 0.0002) {
    const std::vector<Heard> begun = peer.all("/sikku/on");
    ASSERT_EQ(begun.size(), list.notes.size());
    const double start = peer.all("/sikku/start").at(0).due;
    std::multimap<std::pair<double, double>, double> ends;  // channel and key
    for (const Heard& one : peer.all("/sikku/off")) {
        EXPECT_EQ(one.types, "if");
        ends.emplace(std::pair(one.values[0], one.values[1]), one.due);
    }
    for (std::size_t i = 0; i < begun.size(); ++i) {
        const Heard& one = begun[i];
        const Note& note = list.notes[i];
        ASSERT_EQ(one.types, "ifi");
        EXPECT_NEAR(one.values[1], note.key, precision) << i;
        EXPECT_EQ(one.values[2], note.velocity) << i;
        EXPECT_NEAR(one.due - start, static_cast<double>(note.onset) * seconds_per_tick, 0.001) << i;
        EXPECT_LT(one.due - one.arrived, 0.101) << i;
        const auto end = ends.lower_bound({one.values[0], one.values[1]});
        ASSERT_TRUE(end != ends.end() && end->first == std::pair(one.values[0], one.values[1])) << i;
        EXPECT_NEAR(end->second - one.due, static_cast<double>(note.duration) * seconds_per_tick, 0.001) << i;
        ends.erase(end);
    }
    EXPECT_TRUE(ends.empty()) << "a note ends that did not begin";
    EXPECT_TRUE(std::any_of(begun.begin(), begun.end(), [](const Heard& one) { return one.arrived < one.due; }))
        << "notes arrive before they are due";
}

TEST(Osc, NotesAndPlacesAreThoseOfTheScore) {
    NEEDS_OSC();
    Peer peer;
    const Outcome outcome = run_heard({"play", "-", "--port", peer.address()}, {.input = curve}, peer);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "26 notes"));
    const NoteList list = list_notes(std::vector{parse("x.lsys", curve)}, {}, {});
    expect_notes(peer, list);
    EXPECT_EQ(peer.heard().front().address, "/sikku/program");
    EXPECT_EQ(peer.programs(), std::set<double>{74}) << "as General MIDI counts them, from 1";
    const std::vector<Heard> places = peer.all("/sikku/position");
    ASSERT_EQ(places.size(), 16u);
    const double start = peer.all("/sikku/start").at(0).due;
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_EQ(places[i].types, "ii");
        EXPECT_EQ(places[i].values,
                  (std::vector<double>{static_cast<double>(i / 4 + 1), static_cast<double>(i % 4 + 1)}));
        EXPECT_NEAR(places[i].due - start, static_cast<double>(i) * 0.06, 0.001);
    }
    const std::vector<Heard> stops = peer.all("/sikku/stop");
    ASSERT_EQ(stops.size(), 1u);
    EXPECT_EQ(peer.heard().back().address, "/sikku/stop");
    EXPECT_NEAR(stops[0].due - start, static_cast<double>(list.end) * seconds_per_tick, 0.001);
    EXPECT_TRUE(peer.all("/sikku/clock").empty());
    EXPECT_TRUE(peer.all("/sikku/control").empty());
    EXPECT_EQ(peer.all("/sikku/silence").size(), 1u);
}

TEST(Osc, MicrotonesAreTheSameInEveryTuning) {
    NEEDS_OSC();
    for (const std::string tuning : {"bend", "mts", "mpe"}) {
        SCOPED_TRACE(tuning);
        Peer peer;
        const Outcome outcome =
            run_heard({"play", "-", "--port", peer.address(), "--set", "scale=22-edo", "--tuning", tuning},
                      {.input = curve}, peer);
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        const NoteList list =
            list_notes(std::vector{parse("x.lsys", curve, {"", {Setting("scale", "22-edo")}})}, {}, {});
        EXPECT_TRUE(std::any_of(list.notes.begin(), list.notes.end(),
                                [](const Note& note) { return note.key != std::floor(note.key); }));
        expect_notes(peer, list, tuning == "mpe" ? 0.003 : 0.0002);  // a wide bend is coarse
        EXPECT_TRUE(peer.all("/sikku/control").empty());
    }
}

TEST(Osc, ClockAndRepetitions) {
    NEEDS_OSC();
    Peer peer;
    const Outcome outcome = run_heard({"play", "-", "--port", peer.address(), "--clock", "send", "--repeat", "2"},
                                      {.input = curve}, peer);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(peer.all("/sikku/clock").size(), 2 * 16 * 24 + 1u);
    const std::vector<Heard> places = peer.all("/sikku/position");
    ASSERT_EQ(places.size(), 32u);
    EXPECT_EQ(places[16].values, (std::vector<double>{1, 1}));
}

TEST(Osc, NumbersInBracketsAreAddressesOfIpv6) {
    NEEDS_OSC();
    Peer peer(AF_INET6);
    if (!peer.is_bound()) GTEST_SKIP() << "this machine has no IPv6";
    const Outcome outcome = run_heard({"play", "-", "--port", peer.address()}, {.input = curve}, peer);
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(peer.all("/sikku/on").size(), 26u);
}

/// A port in this process.
struct OwnPort {
    Peer peer;
    std::string listen = free_port();
    std::vector<PatternChange> changes;
    std::unique_ptr<Port> port =
        open_osc_port(read_osc_address(peer.address() + ",listen=" + listen),
                      [this](PatternChange change) { changes.push_back(std::move(change)); });
    MonotonicClock clock;

    /// Messages that the port receives within a tenth of a second.
    std::vector<Received> received() {
        std::vector<Received> all;
        for (const Nanoseconds end = clock.now() + second / 10; clock.now() < end;) {
            for (const Received& one : port->wait(clock, end)) all.push_back(one);
        }
        return all;
    }
    void send(const std::string& bytes) const { peer.send(listen, bytes); }
};

TEST(Osc, ChangesOfSoundingNotes) {
    NEEDS_OSC();
    OwnPort own;
    own.port->send(std::vector<Message>{{0xB1, 101, 0},
                                        {0xB1, 100, 0},
                                        {0xB1, 6, 12},
                                        {0xB1, 38, 0},
                                        {0xB1, 7, 90},
                                        {0xE1, 0, 0x60},
                                        {0x91, 60, 100},
                                        {0xE1, 0, 0x20},
                                        {0x81, 60, 64},
                                        {0xB1, 123, 0},
                                        {0xE1, 0, 0x40}},
                   Port::at_once);
    own.peer.read_until_count("/sikku/silence", 1);
    std::string text;
    for (const Heard& one : own.peer.heard()) {
        text += one.address.substr(7);
        for (const double value : one.values) text += " " + std::to_string(static_cast<int>(value));
        text += "\n";
        EXPECT_EQ(one.due, 0) << "at once";
    }
    EXPECT_EQ(text, "control 2 7 90\non 2 66 100\nslide 2 66 54\noff 2 66\nsilence 2\n");
}

TEST(Osc, LargeTicksAreSentInSeveralPackets) {
    NEEDS_OSC();
    OwnPort own;
    std::vector<Message> many;
    for (int key = 0; key < 128; ++key) many.push_back({0x90, key, 1});
    own.port->send(many, own.clock.now());
    EXPECT_TRUE(own.peer.read_until_count("/sikku/on", 128));
}

TEST(Osc, ReceivesAClock) {
    NEEDS_OSC();
    using Kind = Received::Kind;
    OwnPort own;
    own.send(message("/sikku/position", "i", number(8)));
    own.send(message("/sikku/start"));
    own.send(bundle({message("/sikku/clock"), bundle({message("/sikku/clock")}), message("/sikku/stop")}));
    own.send(message("/sikku/continue"));
    std::vector<std::pair<Kind, int>> kinds;
    for (const Received& one : own.received()) kinds.emplace_back(one.kind, one.position);
    EXPECT_EQ(kinds, (std::vector<std::pair<Kind, int>>{{Kind::position, 8},
                                                        {Kind::start, 0},
                                                        {Kind::clock, 0},
                                                        {Kind::clock, 0},
                                                        {Kind::stop, 0},
                                                        {Kind::resume, 0}}));
}

TEST(Osc, TimeTagsAreHeeded) {
    NEEDS_OSC();
    OwnPort own;
    const Nanoseconds begin = own.clock.now();
    own.send(bundle({message("/sikku/stop")}, system_time() + 0.4));
    own.send(bundle({message("/sikku/clock")}, system_time() + 0.2));
    own.send(bundle({message("/sikku/start")}, system_time() + 1000));  // its clock is wrong
    std::vector<Received> all;
    while (own.clock.now() < begin + second) {
        for (const Received& one : own.port->wait(own.clock, begin + second)) {
            EXPECT_LE(one.time, own.clock.now());
            all.push_back(one);
        }
    }
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].kind, Received::Kind::start);
    EXPECT_EQ(all[1].kind, Received::Kind::clock);
    EXPECT_EQ(all[2].kind, Received::Kind::stop);
    EXPECT_NEAR(static_cast<double>(all[2].time - all[1].time), 0.2e9, 0.01e9);
    EXPECT_GE(all[1].time - begin, second / 5 - second / 100);
}

TEST(Osc, ReceivesChanges) {
    NEEDS_OSC();
    OwnPort own;
    own.send(set_message("tempo", "90"));
    own.send(message("/sikku/set", "si", padded("tempo") + number(91)));
    own.send(message("/sikku/set", "sf", padded("angle") + number(0x42b50000)));
    own.send(message("/sikku/pattern", "s", padded(curve)));
    own.received();
    std::vector<std::pair<std::string, std::string>> changes;
    for (const PatternChange& one : own.changes) changes.emplace_back(one.key, one.value);
    EXPECT_EQ(changes, (std::vector<std::pair<std::string, std::string>>{
                           {"tempo", "90"}, {"tempo", "91"}, {"angle", "90.5"}, {"", curve}}));
}

/// Packets that mean nothing.
std::vector<std::string> hostile_packets() {
    std::vector<std::string> packets = {
        "",
        std::string(1, '\0'),
        "/",
        "/sikku/start",
        std::string("/sikku/start\0\0\0\0", 16),
        "#bundle",
        std::string("#bundle\0", 8),
        std::string("#bundle\0", 8) + number(1, 8) + number(0xFFFFFFFF),
        std::string("#bundle\0", 8) + number(1, 8) + number(0x7FFFFFFF) + message("/sikku/start"),
        std::string("#bundle\0", 8) + number(1, 8) + number(0) + number(0) + "abc",
        message("/sikku/start", "i", number(1)),
        message("/sikku/start", "i"),
        message("/sikku/start", "", number(1)),
        message("/sikku/position"),
        message("/sikku/position", "i"),
        message("/sikku/position", "f", number(0)),
        message("/sikku/position", "s", padded("8")),
        message("/sikku/position", "i", number(0xFFFFFFFF)),
        message("/sikku/position", "i", number(0x4000)),
        message("/sikku/position", "ii", number(1) + number(2)),
        message("/sikku/set", "s", padded("tempo")),
        message("/sikku/set", "ss", padded("tempo")),
        message("/sikku/set", "ss", padded("") + padded("x")),
        message("/sikku/set", "sb", padded("tempo") + number(4) + "1234"),
        message("/sikku/set", "sb", padded("tempo") + number(0xFFFFFFF0) + "1234"),
        message("/sikku/set", "ss", "tempo"),
        message("/sikku/pattern", "s", "not ended"),
        message("/sikku/pattern", "b", number(4) + "axio"),
        message("/sikku/pattern", "[s]", padded("x")),
        message("/sikku/load", "s", padded("/etc/passwd")),
        message("/sikku/*", "", ""),
        message("//start", "", ""),
        message("/" + std::string(10'000, 'x')),
        message("/sikku/" + std::string(10'000, 'x'), "s", padded("x")),
        message("/sikku/start", std::string(10'000, 'T')),
        message("/sikku/start", std::string(60'000, 'i')),
        message("/sikku/" + std::string(64'000, '/')),
        std::string(65'000, '\xFF'),
        std::string(65'000, '\0'),
        std::string("/sikku/start\0\0\0\0;i\0\0", 20),
    };
    std::string nested = message("/sikku/stop");
    for (int i = 0; i < 3000; ++i) nested = bundle({nested});
    packets.push_back(nested);
    // Every beginning of a bundle that would mean something.
    const std::string whole =
        bundle({bundle({set_message("tempo", "90")}), message("/sikku/position", "i", number(1))});
    for (std::size_t size = 1; size < whole.size(); ++size) packets.push_back(whole.substr(0, size));
    return packets;
}

std::size_t memory_pages() {
    std::size_t all = 0;
    std::size_t resident = 0;
    std::ifstream("/proc/self/statm") >> all >> resident;
    return resident;
}

TEST(Osc, HostilePacketsMeanNothing) {
    NEEDS_OSC();
    OwnPort own;
    for (const std::string& packet : hostile_packets()) {
        own.send(packet);
        const auto received = own.port->wait(own.clock, own.clock.now() + second / 100);
        EXPECT_TRUE(received.empty() && own.changes.size() <= 1) << packet.substr(0, 100);
        for (const PatternChange& one : own.changes) EXPECT_EQ(one.value, "90") << "of a whole message";
        own.changes.clear();
    }
    // Changed bytes of a packet: whatever they mean, they do no harm.
    const std::string whole =
        bundle({bundle({set_message("tempo", "90")}), message("/sikku/position", "i", number(1))});
    for (std::size_t i = 0; i < whole.size(); ++i) {
        for (const char byte : {'\0', '\x7F', '\xFF', ',', '#'}) {
            std::string changed = whole;
            changed[i] = byte;
            own.send(changed);
            own.port->wait(own.clock, own.clock.now());
        }
    }
    own.received();
    own.send(message("/sikku/start"));
    ASSERT_EQ(own.received().size(), 1u) << "it still listens";
}

TEST(Osc, FloodsTakeNoMemory) {
    NEEDS_OSC();
    OwnPort own;
    own.received();
    const std::size_t before = memory_pages();
    const std::string late = bundle(std::vector<std::string>(1000, message("/sikku/clock")), system_time() + 0.9);
    for (int i = 0; i < 100'000; ++i) {
        own.send(i % 100 == 0 ? late : message("/sikku/clock"));
        if (i % 8 == 0) {
            EXPECT_LE(own.port->wait(own.clock, 0).size(), 1000u);
        }
    }
    for (int i = 0; i < 12; ++i) own.received();
    EXPECT_LT(memory_pages(), before + (sanitized ? 500'000'000 : 10'000'000) / 4096);
    own.send(message("/sikku/start"));
    EXPECT_EQ(own.received().size(), 1u) << "it still listens";
}

TEST(Osc, MusicGoesOnInAFlood) {
    NEEDS_OSC();
    Peer peer;
    const ScratchFolder folder;
    folder.write("x.lsys", curve);
    const std::string listen = free_port();
    Child child({"play", "x.lsys", "--port", peer.address() + ",listen=" + listen, "--repeat"},
                {.folder = folder.path()});
    ASSERT_TRUE(peer.read_until_count("/sikku/on", 5));
    const std::vector<std::string> packets = hostile_packets();
    for (std::size_t i = 0; i < 100'000; ++i) {
        peer.send(listen, i % 50 == 0   ? packets[i / 50 % packets.size()]
                          : i % 50 == 1 ? set_message("key " + std::to_string(i), "x")
                                        : message("/sikku/stop"));
    }
    peer.read_rest();
    const std::size_t before = peer.all("/sikku/on").size();
    ASSERT_TRUE(peer.read_until_count("/sikku/on", before + 30));
    child.send(SIGINT);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 130) << outcome.errors.substr(0, 2000);
    EXPECT_LT(outcome.peak, sanitized ? 2'000'000 : 200'000) << "kilobytes";
    EXPECT_LT(outcome.errors.size(), 1'000'000u);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"x.lsys"});
    EXPECT_EQ(contents(folder / "x.lsys"), curve);
}

TEST(Osc, MessagesChangeThePattern) {
    NEEDS_OSC();
    Peer peer;
    const ScratchFolder folder;
    const std::string file = folder.write("x.lsys", curve);
    const std::string scale = folder.write("x.scl", "x\n 2\n3/2\n2/1\n");
    const std::string listen = free_port();
    Child child({"play", file, "--port", peer.address() + ",listen=" + listen, "--repeat", "--instrument", "Cello"});
    const auto until_program = [&](double program) {
        return peer.read_until([&](const std::vector<Heard>&) { return peer.programs().contains(program); });
    };
    const auto with = [](const std::string& instrument) {
        std::string text = curve;
        return text.replace(text.find("Flute"), 5, instrument);
    };
    // Sends a change with an error, which is reported and not heard.
    const auto refused = [&](const std::string& bytes) {
        peer.send(listen, bytes);
        std::this_thread::sleep_for(std::chrono::seconds(1));
    };
    ASSERT_TRUE(until_program(43));
    peer.send(listen, set_message("instrument", "Oboe"));
    ASSERT_TRUE(until_program(69)) << "it replaces the option";
    refused(set_message("scale", "dorain"));
    refused(set_message("axiom", "G"));
    refused(set_message("scale", scale));
    refused(message("/sikku/pattern", "s", padded(curve + "scale: " + scale + "\n")));
    refused(message("/sikku/pattern", "s", padded("axiom: F\nderivation lenght: 3\n")));
    refused(message("/sikku/load", "s", padded(file)));
    EXPECT_EQ(peer.programs(), (std::set<double>{43, 69}));
    peer.send(listen, set_message("instrument", "Harmonica"));
    ASSERT_TRUE(until_program(23)) << "values with errors are forgotten";
    child.send(SIGINT);
    Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_TRUE(has(outcome.errors, "unknown scale 'dorain'"));
    EXPECT_TRUE(has(outcome.errors, "the melody contains no notes"));
    EXPECT_TRUE(has(outcome.errors, "/sikku/set names a file of this machine: scale '" + scale + "'"));
    EXPECT_TRUE(has(outcome.errors, "/sikku/pattern names a file of this machine: scale '" + scale + "'"));
    EXPECT_TRUE(has(outcome.errors, "unknown key 'derivation lenght'"));
    EXPECT_TRUE(has(outcome.errors, "the version before it plays on"));
    EXPECT_EQ(count_of(outcome.errors, "changed from bar"), 2u);
    EXPECT_EQ(contents(file), curve);

    // A text replaces that of the file, until the file is written again.
    Peer other;
    Child second({"play", file, "--port", other.address() + ",listen=" + listen, "--repeat"});
    const auto until_other = [&](double program) {
        return other.read_until([&](const std::vector<Heard>&) { return other.programs().contains(program); });
    };
    ASSERT_TRUE(until_other(74));
    other.send(listen, message("/sikku/pattern", "s", padded(with("Oboe"))));
    ASSERT_TRUE(until_other(69));
    folder.write("x.lsys", with("Harmonica") + "// later\n");
    ASSERT_TRUE(until_other(23));
    second.send(SIGINT);
    EXPECT_EQ(second.wait().status, 130);
}

TEST(Osc, StandardInputCanBeChangedToo) {
    NEEDS_OSC();
    Peer peer;
    const std::string listen = free_port();
    Child child({"play", "-", "--port", peer.address() + ",listen=" + listen, "--repeat"}, {.input = curve});
    Outcome outcome;
    std::thread waiter([&] { outcome = child.wait(); });
    EXPECT_TRUE(peer.read_until_count("/sikku/on", 5));
    peer.send(listen, set_message("instrument", "Oboe"));
    EXPECT_TRUE(peer.read_until([&](const std::vector<Heard>&) { return peer.programs().contains(69); }));
    child.send(SIGINT);
    waiter.join();
    EXPECT_EQ(outcome.status, 130) << outcome.errors;
}

TEST(Osc, FollowsAClock) {
    NEEDS_OSC();
    Peer peer;
    const std::string listen = free_port();
    Child child({"play", "-", "--port", peer.address() + ",listen=" + listen, "--clock", "follow"}, {.input = curve});
    Outcome outcome;
    std::thread waiter([&] { outcome = child.wait(); });
    EXPECT_TRUE(peer.read_until_count("/sikku/program", 1));
    peer.read_rest();
    EXPECT_TRUE(peer.all("/sikku/on").empty()) << "before the clock starts";
    EXPECT_TRUE(peer.all("/sikku/start").empty()) << "the other program leads";
    peer.send(listen, message("/sikku/position", "i", number(16)));
    peer.send(listen, message("/sikku/continue"));
    for (int i = 0; i <= 12 * 24; ++i) {
        peer.send(listen, message("/sikku/clock"));
        std::this_thread::sleep_for(std::chrono::microseconds(1000));
    }
    waiter.join();
    peer.read_rest();
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    const NoteList list = list_notes(std::vector{parse("x.lsys", curve)}, {}, {});
    const auto late = std::count_if(list.notes.begin(), list.notes.end(),
                                    [](const Note& note) { return note.onset >= 4 * ticks_per_quarter; });
    EXPECT_EQ(static_cast<std::int64_t>(peer.all("/sikku/on").size()), late);
    const std::vector<Heard> places = peer.all("/sikku/position");
    ASSERT_EQ(places.size(), 12u);
    EXPECT_EQ(places[0].values, (std::vector<double>{2, 1}));
    EXPECT_EQ(peer.all("/sikku/off").size(), peer.all("/sikku/on").size());
}

TEST(Osc, AddressesAreRead) {
    const auto read = [](const std::string& text) -> std::string {
        try {
            const OscAddress address = read_osc_address(text);
            std::string all = address.to.host + " " + address.to.port;
            if (address.listen) all += " " + address.listen->host + " " + address.listen->port;
            return all;
        } catch (const PortError& error) {
            return error.what();
        }
    };
    EXPECT_EQ(read("osc://localhost:9000"), "localhost 9000");
    EXPECT_EQ(read("osc://[::1]:9000"), "::1 9000");
    EXPECT_EQ(read("osc://10.0.0.1:9000,listen=9001"), "10.0.0.1 9000 127.0.0.1 9001");
    EXPECT_EQ(read("osc://h:1,listen=0.0.0.0:65535"), "h 1 0.0.0.0 65535");
    EXPECT_EQ(read("osc://h:1,listen=[::]:2"), "h 1 :: 2");
    EXPECT_EQ(read("osc://localhost"), "the port number is missing, as in osc://localhost:9000");
    EXPECT_EQ(read("osc://[::1]"), "the port number is missing, as in osc://[::1]:9000");
    EXPECT_EQ(read("osc://::1:9000"), "IPv6 addresses are written in brackets, as in osc://[::1]:9000");
    EXPECT_EQ(read("osc://:9000"), "the host is missing, as in osc://localhost:9000");
    EXPECT_EQ(read("osc://"), "the host is missing, as in osc://localhost:9000");
    EXPECT_EQ(read("osc://[]:1"), "the host is missing, as in osc://localhost:9000");
    EXPECT_EQ(read("osc://[::1:9000"), "']' is missing");
    EXPECT_EQ(read("osc://[::1]9000"), "expected ':' and a port number after ']'");
    for (const std::string port : {"", "x", "0", "65536", "-1", "+1", "9000/", "9000 ", "99999999999999999999"}) {
        EXPECT_EQ(read("osc://h:" + port), "port number '" + port + "': expected 1 to 65535");
        EXPECT_EQ(read("osc://h:1,listen=" + port), "port number '" + port + "': expected 1 to 65535");
    }
    EXPECT_EQ(read("osc://h:1,hear=2"), "expected listen=PORT after ',', as in listen=9001");
}

TEST(Osc, WrongCommandLines) {
    std::vector<std::tuple<std::vector<std::string>, int, std::string>> all = {
        {{"--port", "osc://localhost"}, 2, "the port number is missing, as in osc://localhost:9000"},
        {{"--port", "osc://localhost:70000"}, 2, "expected 1 to 65535"},
        {{"--port", "osc://localhost:9000", "--clock", "follow"},
         2,
         "--clock follow needs a port to listen on: --port osc://localhost:9000,listen=9001"},
        {{"--port", "osc://localhost:9000", "-o", "x.mid"}, 2, "-o and --port cannot be combined"},
    };
    Peer peer;
    if (has_osc()) {
        all.push_back({{"--port", "osc://no.such.host.invalid:9000"}, 1, "host 'no.such.host.invalid': "});
        all.push_back({{"--port", "osc://127.0.0.1:9,listen=" + peer.port()},
                       1,
                       "cannot listen on 127.0.0.1 port " + peer.port() + ": Address already in use"});
        all.push_back(
            {{"--port", "osc://127.0.0.1:9,listen=192.0.2.1:9001"}, 1, "cannot listen on 192.0.2.1 port 9001"});
    } else {
        all.push_back({{"--port", "osc://127.0.0.1:9"}, 1, "this program was built without liblo"});
    }
    for (const auto& [arguments, status, error] : all) {
        std::vector<std::string> whole = {"play", "hilbert"};
        whole.insert(whole.end(), arguments.begin(), arguments.end());
        const Outcome outcome = run(whole);
        EXPECT_EQ(outcome.status, status) << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, error));
    }
}

/// Arrangements consist of several patterns.
TEST(Osc, ArrangementsAreNotChangedByMessages) {
    NEEDS_OSC();
    Peer peer;
    const ScratchFolder folder;
    folder.write("x.lsys", curve);
    const std::string file = folder.write("x.toml", "[[track]]\npattern = \"x.lsys\"\n");
    const std::string listen = free_port();
    Child child({"play", file, "--port", peer.address() + ",listen=" + listen, "--repeat"});
    ASSERT_TRUE(peer.read_until_count("/sikku/on", 3));
    peer.send(listen, set_message("tempo", "90"));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    child.send(SIGINT);
    const Outcome outcome = child.wait();
    EXPECT_EQ(outcome.status, 130);
    EXPECT_TRUE(has(outcome.errors, "messages change patterns; arrangements change with their files"));
}

}  // namespace sikku::live::osc_test
