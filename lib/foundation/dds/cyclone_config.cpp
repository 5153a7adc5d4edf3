#include "dds/cyclone_config.h"

#include <algorithm>
#include <cctype>

#include "base/error_list.h"

namespace robosim::dds {
namespace {

/// The text as an attribute's value. @throws ConfigError for characters that no name or address has
const std::string& checked(const std::string& text, const char* what) {
  const bool is_valid = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '.' || c == ':' || c == '-' || c == '_' || c == '%';
  });
  if (!is_valid) throw ConfigError("\"" + text + "\" is no " + what + "; an example is 192.0.2.7");
  return text;
}

/// Whether a text is an address rather than the name of an interface.
bool isAddress(const std::string& text) {
  return text.find(':') != std::string::npos || text.find_first_not_of("0123456789.") == std::string::npos;
}

}  // namespace

std::string cycloneConfig(const Options& options) {
  const bool is_local = options.interface.empty();
  const std::string interface = is_local ? "127.0.0.1" : checked(options.interface, "network interface");
  std::string peers = is_local ? R"(<Peer address="127.0.0.1"/>)" : "";
  for (const auto& peer : options.peers) peers += R"(<Peer address=")" + checked(peer, "address of a peer") + R"("/>)";
  return std::string("<CycloneDDS><Domain><General><Interfaces><NetworkInterface ") +
         (isAddress(interface) ? "address" : "name") + "=\"" + interface + "\"" +
         (is_local ? R"( multicast="false")" : "") + "/></Interfaces>" +
         (is_local ? "<AllowMulticast>false</AllowMulticast>" : "") +
         // Ports by number: participants without multicast are found there.
         "</General><Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
         std::to_string(kMaxParticipants - 1) + "</MaxAutoParticipantIndex>" +
         // Peers that begin later and do not know this participant's port wait for its next announcement.
         "<SPDPInterval>2s</SPDPInterval>" + (peers.empty() ? "" : "<Peers>" + peers + "</Peers>") +
         "</Discovery></Domain></CycloneDDS>";
}

}  // namespace robosim::dds
