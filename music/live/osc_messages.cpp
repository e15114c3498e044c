#include "music/live/osc_messages.h"

#include <fmt/format.h>
#include <lo/lo.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <string_view>

namespace sikku::live {
namespace {

constexpr std::size_t most_packet_bytes = 1400;  // routers need not split it
constexpr std::string_view bundle_word{"#bundle\0", 8};
constexpr std::size_t bundle_head_bytes = 16;
constexpr int most_nested = 8;
constexpr int most_position = 0x3FFF;  // as in MIDI
constexpr std::uint64_t seconds_1900_to_1970 = 2'208'988'800;
constexpr std::uint64_t tag_at_once = 1;

struct FreeMessage {
    void operator()(void* message) const { lo_message_free(message); }
};
using OscMessage = std::unique_ptr<void, FreeMessage>;

std::uint64_t tag_of(Nanoseconds time) {
    if (time <= 0) return tag_at_once;
    const auto whole = static_cast<std::uint64_t>(time);
    constexpr std::uint64_t unit = second;
    return (whole / unit + seconds_1900_to_1970) << 32 | ((whole % unit) << 32) / unit;
}

/// 0 for times before 1970 and `at once`.
Nanoseconds time_of_tag(std::uint64_t tag) {
    const std::uint64_t seconds = tag >> 32;
    if (seconds < seconds_1900_to_1970) return 0;
    return static_cast<Nanoseconds>(seconds - seconds_1900_to_1970) * second +
           static_cast<Nanoseconds>(((tag & 0xFFFFFFFF) * second) >> 32);
}

/// The most significant byte first.
void append_number(std::uint64_t value, int bytes, std::string& text) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
}

std::uint64_t number_of(std::span<const char> bytes) {
    std::uint64_t value = 0;
    for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
    return value;
}

std::string_view view_of(std::span<const char> bytes) {
    return {bytes.data(), bytes.size()};
}

/// Copies a number out of a message. OSC aligns values to 4 bytes, lo_arg to 8.
template <class Number>
Number number_at(const lo_arg* place) {
    Number value{};
    std::memcpy(&value, place, sizeof value);
    return value;
}

const char* text_at(const lo_arg* place) {
    return reinterpret_cast<const char*>(place);
}

/// The value of a key: a text or a number.
std::string text_of(char type, const lo_arg* place) {
    return type == 's'   ? text_at(place)
           : type == 'i' ? fmt::format("{}", number_at<std::int32_t>(place))
                         : fmt::format("{}", number_at<float>(place));
}

class OscReader {
public:
    OscReader(std::vector<Received>& received, const ChangeSink& change) : received_(received), change_(change) {}

    void read(std::span<char> bytes, Nanoseconds time, int depth) {
        if (!view_of(bytes).starts_with(bundle_word)) return read_message(bytes, time);
        if (bytes.size() < bundle_head_bytes || depth == most_nested) return;
        const Nanoseconds own = time_of_tag(number_of(bytes.subspan(bundle_word.size(), 8)));
        bytes = bytes.subspan(bundle_head_bytes);
        while (bytes.size() >= 4) {
            const std::uint64_t size = number_of(bytes.first(4));
            bytes = bytes.subspan(4);
            if (size > bytes.size()) return;
            read(bytes.first(size), own, depth + 1);
            bytes = bytes.subspan(size);
        }
    }

private:
    void read_message(std::span<char> bytes, Nanoseconds time) {
        using Kind = Received::Kind;
        static constexpr std::string_view own = "/sikku/";
        const std::string_view text = view_of(bytes);
        const std::string_view address = text.substr(0, std::min(text.size(), text.find('\0')));
        if (!address.starts_with(own)) return;
        const std::string_view name = address.substr(own.size());
        if (name.size() > 8) return;  // longer than all that are known
        const OscMessage message(lo_message_deserialise(bytes.data(), bytes.size(), nullptr));
        if (!message) return;
        const std::string_view types = lo_message_get_types(message.get());
        lo_arg** values = lo_message_get_argv(message.get());
        const auto add = [&](Kind kind, int position = 0) { received_.push_back({time, kind, position}); };
        if (name == "clock" && types.empty()) return add(Kind::clock);
        if (name == "start" && types.empty()) return add(Kind::start);
        if (name == "continue" && types.empty()) return add(Kind::resume);
        if (name == "stop" && types.empty()) return add(Kind::stop);
        if (name == "position" && types == "i") {
            const auto position = number_at<std::int32_t>(values[0]);
            if (position >= 0 && position <= most_position) add(Kind::position, position);
            return;
        }
        if (!change_) return;
        if (name == "pattern" && types == "s") return change_({{}, text_at(values[0])});
        if (name == "set" && (types == "ss" || types == "si" || types == "sf") && *text_at(values[0]) != '\0') {
            change_({text_at(values[0]), text_of(types[1], values[1])});
        }
    }

    std::vector<Received>& received_;
    const ChangeSink& change_;
};

}  // namespace

OscBundles::OscBundles(Nanoseconds time) : head_(bundle_word) {
    append_number(tag_of(time), 8, head_);
}

void OscBundles::add(const char* address, std::initializer_list<std::variant<int, float>> values) {
    const OscMessage message(lo_message_new());
    if (!message) throw std::bad_alloc();
    for (const auto& value : values) {
        if (const int* whole = std::get_if<int>(&value)) {
            lo_message_add_int32(message.get(), *whole);
        } else {
            lo_message_add_float(message.get(), std::get<float>(value));
        }
    }
    std::string bytes(lo_message_length(message.get(), address), '\0');
    lo_message_serialise(message.get(), address, bytes.data(), nullptr);
    if (bundles_.empty() || bundles_.back().size() + 4 + bytes.size() > most_packet_bytes) bundles_.push_back(head_);
    append_number(bytes.size(), 4, bundles_.back());
    bundles_.back() += bytes;
}

void OscTranslator::add(const Message& message, OscBundles& bundles) {
    const auto& bytes = message.bytes;
    Channel& channel = channels_[static_cast<std::size_t>(message.channel())];
    const int number = message.channel() + 1;
    const auto pitch_of = [](const Channel& of, int key) {
        const auto tuned = of.tuned.find(key);
        return static_cast<float>((tuned == of.tuned.end() ? key : tuned->second) + of.bend);
    };
    switch (message.kind()) {
        case 0x80:
            if (const auto note = channel.sounding.find(bytes[1]); note != channel.sounding.end()) {
                bundles.add("/sikku/off", {number, note->second});
                channel.sounding.erase(note);
            }
            break;
        case 0x90:
            channel.sounding[bytes[1]] = pitch_of(channel, bytes[1]);
            bundles.add("/sikku/on", {number, channel.sounding[bytes[1]], static_cast<int>(bytes[2])});
            break;
        case 0xB0:
            control(channel, number, bytes[1], bytes[2], bundles);
            break;
        case 0xC0:
            bundles.add("/sikku/program", {number, bytes[1] + 1});
            break;
        case 0xE0:
            channel.bend = ((bytes[1] | bytes[2] << 7) - midi::centre) * channel.bend_range / midi::centre;
            for (const auto& [key, name] : channel.sounding) {
                bundles.add("/sikku/slide", {number, name, pitch_of(channel, key)});
            }
            break;
        case 0xF0:  // the tuning of a key
            channels_[bytes[5] & 0x0F].tuned[bytes[7]] = (bytes[8] << 14 | bytes[9] << 7 | bytes[10]) / 0x1p14;
            break;
        case clock_byte:
            bundles.add("/sikku/clock");
            break;
        case start_byte:
            bundles.add("/sikku/start");
            break;
        case continue_byte:
            bundles.add("/sikku/continue");
            break;
        case stop_byte:
            bundles.add("/sikku/stop");
            break;
        default:
            break;
    }
}

/// Registered parameters set the range of bends, which keys contain.
void OscTranslator::control(Channel& channel, int number, int controller, int value, OscBundles& bundles) {
    constexpr int data_entry = 6;
    constexpr int fine_data_entry = 38;
    constexpr int parameter = 100;
    constexpr int parameter_group = 101;
    constexpr int all_notes_off = 123;
    if (controller == parameter) {
        channel.parameter = value;
    } else if (controller == data_entry) {
        if (channel.parameter == 0) channel.bend_range = value;
    } else if (controller == all_notes_off) {
        bundles.add("/sikku/silence", {number});
    } else if (controller != fine_data_entry && controller != parameter_group) {
        bundles.add("/sikku/control", {number, controller, value});
    }
}

void read_osc(std::span<char> packet, std::vector<Received>& received, const ChangeSink& change) {
    OscReader(received, change).read(packet, 0, 0);
}

}  // namespace sikku::live
