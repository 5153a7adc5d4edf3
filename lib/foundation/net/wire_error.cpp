#include "net/wire_error.h"

namespace robosim {

void checkProtocol(std::uint32_t version) {
  if (version == kProtocolVersion) return;
  const std::string older = version < kProtocolVersion ? "the caller" : "the environment";
  throw WireError("the caller uses version " + std::to_string(version) + " of the protocol, the environment version " +
                      std::to_string(kProtocolVersion) + "; " + older + " is the older program: bring it up to date",
                  v1::ERROR_REASON_PROTOCOL_VERSION);
}

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kMaxBytes = 60;
  std::string result = "'";
  for (const char c : text.substr(0, kMaxBytes)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kMaxBytes ? "…'" : "'");
}

}  // namespace robosim
