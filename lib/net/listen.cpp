#include "net/listen.h"

#include <charconv>
#include <cstdint>
#include <map>
#include <sstream>

#include <arpa/inet.h>

#include "base/error_list.h"

namespace robosim {

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

bool isLoopback(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  in_addr four{};
  if (inet_pton(AF_INET, host.c_str(), &four) == 1) return ntohl(four.s_addr) >> 24 == 127;
  return host == "localhost" || host == "[::1]";
}

void refuseExposure(const std::string& option, const std::string& address, bool has_tls, bool has_tokens) {
  if ((has_tls && has_tokens) || isLoopback(address)) return;
  const std::string tls = has_tls ? "" : "--tls-cert FILE and --tls-key FILE, so that nobody can listen in";
  const std::string tokens = has_tokens ? "" : "--tokens FILE, so that not everyone may come in";
  throw ConfigError(option + " " + address + " is open to other machines: add " + tls +
                    (!has_tls && !has_tokens ? ", and " : "") + tokens +
                    "; or --insecure, if everyone on the network may do everything here; or listen on 127.0.0.1");
}

void refuseExposure(const ListenAddresses& listen, bool has_tls, bool has_tokens) {
  for (const auto& address : listen.all()) refuseExposure("--listen", address, has_tls, has_tokens);
}

ListenAddresses ListenAddresses::parse(const std::string& text) {
  ListenAddresses listen{kDefaultListen, kDefaultListen, kDefaultListen, kDefaultListen};
  if (text.find('=') == std::string::npos) {
    const std::string all = hostAndPort(text);
    return {all, all, all, all};
  }
  const std::map<std::string, std::string*> of_word{{"viewers", &listen.viewers},
                                                    {"robots", &listen.robots},
                                                    {"geometry", &listen.geometry},
                                                    {"control", &listen.control}};
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto equals = part.find('=');
    const auto found = of_word.find(part.substr(0, equals));
    if (equals == std::string::npos || found == of_word.end()) {
      throw ConfigError("--listen " + text + ": '" + part +
                        "' must be one of viewers=…, robots=…, geometry=… and control=…, with an address");
    }
    *found->second = hostAndPort(part.substr(equals + 1));
  }
  return listen;
}

}  // namespace robosim
