#include "remote/origin.h"

#include <algorithm>
#include <cctype>

#include "net/host_port.h"

namespace robosim {
namespace {

std::string inLowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// A host with a port: appends ":" to one without, because isLoopback() removes the port.
std::string withPort(const std::string& host) {
  const auto colon = host.rfind(':');
  const bool has_port = colon != std::string::npos && host.find(']', colon) == std::string::npos;
  return has_port ? host : host + ":";
}

}  // namespace

bool isSameOrigin(const std::string& origin, const std::string& host, const std::string& listen) {
  const auto scheme_ends = origin.find("://");
  if (scheme_ends == std::string::npos || host.empty()) return false;
  const std::string scheme = origin.substr(0, scheme_ends);
  if (scheme != "http" && scheme != "https") return false;
  if (inLowerCase(origin.substr(scheme_ends + 3)) != inLowerCase(host)) return false;
  return !isLoopback(listen) || isLoopback(withPort(inLowerCase(host)));
}

}  // namespace robosim
