#include "net/wire_error.h"

namespace robosim {

std::string fitForStatus(const std::string& text) {
  constexpr std::size_t kLongest = 2000;
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // not within a letter of UTF-8
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
  constexpr std::size_t kLongest = 60;
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > kLongest ? "…'" : "'");
}

}  // namespace robosim
