#pragma once
#include <array>
#include <string>

namespace robosim {

/// Addresses ("host:port") at which the environment listens, by kind of client. Equal addresses share a port.
struct ListenAddresses {
  std::string viewers, robots, geometry, control;

  /// Parses the value of `--listen`: one address for all, or some of `viewers=…,robots=…,geometry=…,control=…`, with
  /// the default for the others. An address is "host:port", ":port" or "port"; the default host is 127.0.0.1. Port 0
  /// lets the system choose.
  /// @throws ConfigError
  static ListenAddresses parse(const std::string& text);
  std::array<std::string, 4> all() const { return {viewers, robots, geometry, control}; }
};

/// Default address for all kinds of clients: the viewers' port of 2005.
constexpr const char* kDefaultListen = "127.0.0.1:3000";

/// Checks that an address that other machines can reach is protected by TLS and tokens.
/// @throws ConfigError that names the missing options
void checkExposure(const ListenAddresses& listen, bool has_tls, bool has_tokens);
/// The same for one address, given by the command-line option `option`.
void checkExposure(const std::string& option, const std::string& address, bool has_tls, bool has_tokens);

}  // namespace robosim
