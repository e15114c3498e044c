#include "music/live/osc_port.h"

#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <string_view>

namespace sikku::live {
namespace {

constexpr std::string_view osc_scheme = "osc://";

void check_port_number(std::string_view port) {
    std::uint16_t number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    if (error != std::errc() || end != port.data() + port.size() || number == 0) {
        throw PortError(fmt::format("port number '{}': expected 1 to 65535", printable(port, 80)));
    }
}

UdpAddress read_udp_address(std::string_view text) {
    const bool has_brackets = text.starts_with('[');
    if (!has_brackets && text.find(':') != text.rfind(':')) {
        throw PortError("IPv6 addresses are written in brackets, as in osc://[::1]:9000");
    }
    const std::size_t host_end = has_brackets ? text.find(']') : text.find(':');
    const std::string_view host = text.substr(has_brackets ? 1 : 0, host_end - (has_brackets ? 1 : 0));
    if (has_brackets && host_end == std::string_view::npos) throw PortError("']' is missing");
    if (host.empty()) throw PortError("the host is missing, as in osc://localhost:9000");
    const std::size_t colon = has_brackets ? host_end + 1 : host_end;
    if (colon >= text.size()) {
        throw PortError(fmt::format("the port number is missing, as in osc://{}:9000", printable(text, 80)));
    }
    const std::string_view port = text.substr(colon + 1);
    if (text[colon] != ':') throw PortError("expected ':' and a port number after ']'");
    check_port_number(port);
    return {std::string(host), std::string(port)};
}

UdpAddress read_listen(std::string_view text) {
    if (text.find_first_of(":[") != std::string_view::npos) return read_udp_address(text);
    check_port_number(text);
    return {"127.0.0.1", std::string(text)};
}

}  // namespace

bool is_osc_address(const std::string& text) {
    return text.starts_with(osc_scheme);
}

OscAddress read_osc_address(const std::string& text) {
    constexpr std::string_view listen = "listen=";
    const std::string_view rest = std::string_view(text).substr(osc_scheme.size());
    const std::size_t comma = rest.find(',');
    OscAddress address;
    address.text = printable(text);
    address.to = read_udp_address(rest.substr(0, comma));
    if (comma == std::string_view::npos) return address;
    const std::string_view setting = rest.substr(comma + 1);
    if (!setting.starts_with(listen)) throw PortError("expected listen=PORT after ',', as in listen=9001");
    address.listen = read_listen(setting.substr(listen.size()));
    return address;
}

}  // namespace sikku::live
