#pragma once
#include <string>

namespace robosim {

/// Whether a page may access the server that listens at `listen`. The browser's `Origin` and `Host` headers must match,
/// so that a page of another site in the same browser cannot drive robots. For a server on a loopback address, `Host`
/// must name this machine, which prevents DNS rebinding.
/// @param origin "https://host:port"; empty when absent, which is refused
/// @param host "host:port"
/// @param listen "host:port"
bool isSameOrigin(const std::string& origin, const std::string& host, const std::string& listen);

}  // namespace robosim
