#include "net/guess_limiter.h"

#include <algorithm>

#include <arpa/inet.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds kMinWait = 250ms;
constexpr std::chrono::milliseconds kMaxWait = 5s;
constexpr auto kMemory = 1min;

}  // namespace

bool GuessLimiter::Recent::contains(const TokenHash& token) const {
  return std::find(tokens_.begin(), tokens_.end(), token) != tokens_.end();
}

void GuessLimiter::Recent::add(const TokenHash& token) {
  if (contains(token)) return;
  tokens_[next_] = token;
  next_ = (next_ + 1) % tokens_.size();
}

std::chrono::milliseconds GuessLimiter::wait(const std::string& address, const TokenHash& token, Time now) const {
  const auto found = entries_.find(address);
  if (found == entries_.end()) return 0ms;
  const Entry& entry = found->second;
  const auto rest = std::chrono::ceil<std::chrono::milliseconds>(entry.blocked_until - now);
  // A longer wait than the maximum: the clock was set back.
  if (rest <= 0ms || rest > kMaxWait || entry.right.contains(token) || entry.wrong.contains(token)) return 0ms;
  return rest;
}

void GuessLimiter::noteWrong(const std::string& address, const TokenHash& token, Time now) {
  Entry& entry = refreshEntry(address, now);
  if (now - entry.last_guess > kMemory) entry.guesses = 0;
  if (entry.wrong.contains(token)) return;
  entry.wrong.add(token);
  entry.last_guess = now;
  if (++entry.guesses <= kFreeGuesses) return;
  constexpr int most_doublings = 5;
  const int doublings = std::min(entry.guesses - kFreeGuesses - 1, most_doublings);
  entry.blocked_until = now + std::min(kMinWait * (1 << doublings), kMaxWait);
}

void GuessLimiter::noteRight(const std::string& address, const TokenHash& token, Time now) {
  refreshEntry(address, now).right.add(token);
}

GuessLimiter::Entry& GuessLimiter::refreshEntry(const std::string& address, Time now) {
  const auto found = entries_.find(address);
  if (found == entries_.end() && entries_.size() >= kMaxAddresses) {
    entries_.erase(std::min_element(entries_.begin(), entries_.end(),
                                    [](const auto& a, const auto& b) { return a.second.last < b.second.last; }));
  }
  Entry& entry = entries_[address];
  entry.last = now;
  return entry;
}

std::string addressOf(std::string_view peer) {
  std::string host(peer);
  for (const std::string_view scheme : {"ipv4:", "ipv6:"}) {
    if (!host.starts_with(scheme)) continue;
    host.erase(0, scheme.size());
    host.resize(std::min(host.rfind(':'), host.size()));
  }
  for (const std::string_view bracket : {"%5B", "%5D", "[", "]"}) {
    if (const auto at = host.find(bracket); at != std::string::npos) host.erase(at, bracket.size());
  }
  host.resize(std::min(host.find('%'), host.size()));  // an interface: fe80::1%eth0
  in6_addr six{};
  if (inet_pton(AF_INET6, host.c_str(), &six) != 1) return host;
  std::array<char, INET6_ADDRSTRLEN> text{};
  if (IN6_IS_ADDR_V4MAPPED(&six)) {
    inet_ntop(AF_INET, &six.s6_addr[12], text.data(), text.size());
  } else {
    std::fill(six.s6_addr + 8, six.s6_addr + 16, 0);
    inet_ntop(AF_INET6, &six, text.data(), text.size());
  }
  return text.data();
}

}  // namespace robosim
