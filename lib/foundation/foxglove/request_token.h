#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace robosim::foxglove {

/// The token in the target of a WebSocket's request, "/?token=TOKEN": the protocol itself has no place for one, and
/// browsers cannot set headers of a WebSocket. Characters may be encoded as %2B; nullopt without a token.
inline std::optional<std::string> tokenOf(std::string_view target) {
  constexpr std::string_view kName = "token=";
  const auto query = target.find('?');
  if (query == std::string_view::npos) return std::nullopt;
  target.remove_prefix(query + 1);
  target = target.substr(0, target.find('#'));
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  while (!target.empty()) {
    const auto end = target.find('&');
    std::string_view part = target.substr(0, end);
    target = end == std::string_view::npos ? std::string_view() : target.substr(end + 1);
    if (!part.starts_with(kName)) continue;
    part.remove_prefix(kName.size());
    std::string token;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const bool is_encoded =
          part[i] == '%' && i + 2 < part.size() && digit(part[i + 1]) >= 0 && digit(part[i + 2]) >= 0;
      token += is_encoded ? static_cast<char>(digit(part[i + 1]) * 16 + digit(part[i + 2])) : part[i];
      if (is_encoded) i += 2;
    }
    return token;
  }
  return std::nullopt;
}

}  // namespace robosim::foxglove
