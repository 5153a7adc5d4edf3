#pragma once
#include <array>
#include <string>

namespace robosim {

/// Where the environment listens, "host:port", for each kind of client. Equal ones share a port.
struct ListenAddresses {
  std::string viewers, robots, geometry, control;

  /// Reads what `--listen` says: one address for all, or some of `viewers=…,robots=…,geometry=…,control=…`, the others
  /// then having the default. An address is "host:port", ":port" or "port", the host being 127.0.0.1 if none is named.
  /// Port 0 lets the system choose.
  /// @throws ConfigError
  static ListenAddresses parse(const std::string& text);
  std::array<std::string, 4> all() const { return {viewers, robots, geometry, control}; }
};

/// The default: 2005's port for viewers, for all.
constexpr const char* kDefaultListen = "127.0.0.1:3000";

/// "host:port" of such an address. @throws ConfigError when it is none.
std::string hostAndPort(const std::string& address);

/// Sees to it that nobody listens to the network unprotected by mistake: without TLS and tokens only on loopback.
/// @throws ConfigError that names what to add
void refuseExposure(const ListenAddresses& listen, bool has_tls, bool has_tokens);
/// The same for one address; `option` is what names it on the command line.
void refuseExposure(const std::string& option, const std::string& address, bool has_tls, bool has_tokens);

/// Whether an address, "host:port", is reached from this machine only: 127.x.y.z, ::1 or localhost. A name that this
/// machine may resolve to one of these counts for none.
bool isLoopback(const std::string& address);

}  // namespace robosim
