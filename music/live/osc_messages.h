// music/live/osc_messages.h: messages of OSC, written from those of MIDI and read from the network.
#pragma once

#include "music/live/osc_port.h"

#include <array>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace sikku::live {

/// Messages with a time tag, in as many bundles as fit into packets of Ethernet.
class OscBundles {
public:
    /// @param time  by the clock of the system, since 1970; 0: at once
    explicit OscBundles(Nanoseconds time);
    void add(const char* address, std::initializer_list<std::variant<int, float>> values = {});
    /// The bundles, each for a packet of its own; none if no message was added.
    const std::vector<std::string>& bundles() const { return bundles_; }

private:
    std::string head_;
    std::vector<std::string> bundles_;
};

/// Translates messages of MIDI. Keys contain the tuning and the bend of their channel.
class OscTranslator {
public:
    void add(const Message& message, OscBundles& bundles);

private:
    struct Channel {
        int parameter = -1;  // the registered parameter that data entry sets
        double bend_range = 2;
        double bend = 0;                // semitones
        std::map<int, double> tuned;    // keys with other pitches
        std::map<int, float> sounding;  // their keys in `on` by those of MIDI
    };
    void control(Channel& channel, int number, int controller, int value, OscBundles& bundles);
    std::array<Channel, midi::channels> channels_;
};

/// Reads a packet of the network: a message, or a bundle of messages and bundles. Unknown addresses, other types of
/// values and damaged messages are ignored.
/// @param received  receives clock messages; their times are time tags by the clock of the system, 0: at once
void read_osc(std::span<char> packet, std::vector<Received>& received, const ChangeSink& change);

}  // namespace sikku::live
