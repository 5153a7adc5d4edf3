#include "net/listen.h"

#include <map>
#include <sstream>

#include "base/error_list.h"
#include "net/host_port.h"

namespace robosim {

void checkExposure(const std::string& option, const std::string& address, bool has_tls, bool has_tokens) {
  if ((has_tls && has_tokens) || isLoopback(address)) return;
  const std::string tls = has_tls ? "" : "--tls-cert FILE and --tls-key FILE, to encrypt connections";
  const std::string tokens = has_tokens ? "" : "--tokens FILE, to authenticate clients";
  throw ConfigError(option + " " + address + " is open to other machines: add " + tls +
                    (!has_tls && !has_tokens ? ", and " : "") + tokens +
                    "; or --listen-unprotected, to grant every right to all clients; or listen on 127.0.0.1");
}

void checkExposure(const ListenAddresses& listen, bool has_tls, bool has_tokens) {
  for (const auto& address : listen.all()) checkExposure("--listen", address, has_tls, has_tokens);
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
