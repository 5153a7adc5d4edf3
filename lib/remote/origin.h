#pragma once
#include <string>

namespace robosim {

/// Whether a page may talk to the server that listens at `listen`. A browser says where the page comes from, `Origin`,
/// and whom it believes to talk to, `Host`: they must be the same, so that a page from elsewhere, open in the same
/// browser, cannot drive robots. A server that only this machine reaches must be called by a name that means this
/// machine, or a page could have its own name resolve to it ("DNS rebinding").
/// @param origin "https://host:port"; empty for none, which no browser sends and is refused
/// @param host "host:port"
/// @param listen "host:port"
bool isSameOrigin(const std::string& origin, const std::string& host, const std::string& listen);

}  // namespace robosim
