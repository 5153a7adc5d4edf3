#pragma once
#include <string>

namespace robosim {

/// Host and port of a network address.
struct HostPort {
  std::string host;  ///< an IPv6 address without its brackets
  std::string port;

  /// Splits "host:port" at its last colon; the port is empty without one. Validates neither part.
  static HostPort of(const std::string& address);
};

/// Normalises an address, "host:port", ":port" or "port", to "host:port"; the default host is 127.0.0.1.
/// @throws ConfigError for an invalid address.
std::string hostAndPort(const std::string& address);

/// The address, "host:port", with another port, such as the one that the system chose for port 0.
std::string withPort(const std::string& address, int port);

/// Whether an address, "host:port", is reachable from this machine only: 127.x.y.z, ::1 or localhost. Other host names
/// are not resolved and never count as loopback.
bool isLoopback(const std::string& address);

}  // namespace robosim
