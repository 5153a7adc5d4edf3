#include "web/origin.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "net/host_port.h"

namespace robosim {
namespace {

std::string inLowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// Whether a text is "host" or "host:port": the host a name of letters, digits, '-', '.' and '_', or an IPv6 address in
/// brackets. Excludes in particular the '@' of user information, which precedes the host in a URL.
bool isHost(std::string_view text) {
  const auto consistsOf = [](std::string_view part, std::string_view others, auto is_allowed) {
    return !part.empty() && std::all_of(part.begin(), part.end(), [&](unsigned char c) {
      return is_allowed(c) || others.find(static_cast<char>(c)) != std::string_view::npos;
    });
  };
  const auto is_digit = [](unsigned char c) { return c >= '0' && c <= '9'; };
  const auto is_letter_or_digit = [](unsigned char c) { return c < 0x80 && std::isalnum(c) != 0; };
  const auto is_hexadecimal = [](unsigned char c) { return std::isxdigit(c) != 0; };
  const bool is_bracketed = text.starts_with('[');
  const auto host_ends = is_bracketed ? text.find(']') : text.find(':');
  const std::string_view host = text.substr(is_bracketed ? 1 : 0, host_ends - (is_bracketed ? 1 : 0));
  if (is_bracketed && host_ends == std::string_view::npos) return false;
  if (!(is_bracketed ? consistsOf(host, ":.", is_hexadecimal) : consistsOf(host, "-._", is_letter_or_digit)))
    return false;
  const std::string_view rest =
      host_ends == std::string_view::npos ? std::string_view() : text.substr(host_ends + (is_bracketed ? 1 : 0));
  return rest.empty() || (rest.front() == ':' && consistsOf(rest.substr(1), "", is_digit));
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
  if (scheme_ends == std::string::npos || !isHost(host)) return false;
  const std::string scheme = origin.substr(0, scheme_ends);
  if (scheme != "http" && scheme != "https") return false;
  if (inLowerCase(origin.substr(scheme_ends + 3)) != inLowerCase(host)) return false;
  return !isLoopback(listen) || isLoopback(withPort(inLowerCase(host)));
}

}  // namespace robosim
