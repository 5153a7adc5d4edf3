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

std::string interfaceElement(const std::string& interface) {
  if (interface.empty()) return R"(<NetworkInterface autodetermine="true"/>)";
  return std::string("<NetworkInterface ") + (isAddress(interface) ? "address" : "name") + "=\"" +
         checked(interface, "network interface") + "\"/>";
}

}  // namespace

std::string cycloneConfig(const Options& options) {
  std::string peers = R"(<Peer address="127.0.0.1"/>)";
  for (const auto& peer : options.peers) peers += R"(<Peer address=")" + checked(peer, "address of a peer") + R"("/>)";
  return "<CycloneDDS><Domain><General><Interfaces>" + interfaceElement(options.interface) + "</Interfaces>" +
         (options.isLocal() ? "<MulticastTimeToLive>0</MulticastTimeToLive>" : "") +
         // Ports by number: participants without multicast are found there.
         "</General><Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" +
         std::to_string(kMaxParticipants - 1) + "</MaxAutoParticipantIndex>" +
         // Peers that begin later and do not know this participant's port wait for its next announcement.
         "<SPDPInterval>2s</SPDPInterval><Peers>" + peers + "</Peers></Discovery></Domain></CycloneDDS>";
}

}  // namespace robosim::dds
