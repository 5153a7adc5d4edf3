#include "net/wire_error.h"

namespace robosim {

std::string truncatedForStatus(const std::string& text) {
  constexpr std::size_t kMaxBytes = 2000;
  if (text.size() <= kMaxBytes) return text;
  std::size_t end = kMaxBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a UTF-8 character
  return text.substr(0, end) + " …";
}

void checkProtocol(std::uint32_t version) {
  if (version == kProtocolVersion) return;
  const std::string older = version < kProtocolVersion ? "the caller" : "the environment";
  throw WireError("the caller speaks version " + std::to_string(version) + " of the protocol, the environment " +
                      std::to_string(kProtocolVersion) + "; " + older + " is the older program: bring it up to date",
                  grpc::StatusCode::FAILED_PRECONDITION);
}

std::string inQuotes(std::string_view text) {
  constexpr std::size_t kMaxBytes = 60;
  std::string result = "'";
  for (const char c : text.substr(0, kMaxBytes)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kMaxBytes ? "…'" : "'");
}

}  // namespace robosim
