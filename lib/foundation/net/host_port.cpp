#include "net/host_port.h"

#include <charconv>
#include <cstdint>

#include <arpa/inet.h>

#include "base/error_list.h"

namespace robosim {

HostPort HostPort::of(const std::string& address) {
  const auto colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  if (host.size() > 1 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  return {host, colon == std::string::npos ? "" : address.substr(colon + 1)};
}

std::string hostAndPort(const std::string& address) {
  const auto colon = address.rfind(':');
  const std::string host = colon == std::string::npos ? "" : address.substr(0, colon);
  const std::string port = colon == std::string::npos ? address : address.substr(colon + 1);
  std::uint16_t number = 0;
  const auto [stop, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (port.empty() || error != std::errc{} || stop != port.data() + port.size()) {
    throw ConfigError("'" + address +
                      "' is no address: must be host:port, :port or port, with a port in [0, 65535]; "
                      "127.0.0.1:3000, say, or [::1]:3000");
  }
  return (host.empty() ? "127.0.0.1" : host) + ":" + port;
}

std::string withPort(const std::string& address, int port) {
  return address.substr(0, address.rfind(':') + 1) + std::to_string(port);
}

bool isLoopback(const std::string& address) {
  const std::string host = HostPort::of(address).host;
  in_addr four{};
  if (inet_pton(AF_INET, host.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24 == 127;
  return host == "localhost" || (host == "::1" && address.front() == '[');
}

}  // namespace robosim
