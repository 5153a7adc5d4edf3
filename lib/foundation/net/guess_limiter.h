#pragma once
#include <array>
#include <chrono>
#include <map>
#include <string>
#include <string_view>

#include "net/token_table.h"

namespace robosim {

/// Exponential back-off for wrong tokens, by address. After kFreeGuesses different wrong tokens each further one blocks
/// the address, for 250 ms at first, then twice as long each time, at most 5 s: its tokens are refused without a
/// lookup. Exempt are tokens that were accepted from the address before, and repetitions of a wrong token, so that
/// valid users behind the same NAT are hardly affected; a new token waits at most 5 s after the last guess. An entry is
/// removed one minute after its last wrong token. Memory is bounded: beyond kMaxAddresses the least recently used entry
/// is removed.
class GuessLimiter {
 public:
  using Time = std::chrono::system_clock::time_point;
  static constexpr int kFreeGuesses = 5;
  static constexpr std::size_t kMaxAddresses = 1024;

  /// Remaining time for which the address is blocked for this token; 0 when the token may be looked up.
  std::chrono::milliseconds wait(const std::string& address, const TokenHash& token, Time now) const;
  void noteWrong(const std::string& address, const TokenHash& token, Time now);
  void noteRight(const std::string& address, const TokenHash& token, Time now);

  std::size_t addresses() const { return entries_.size(); }

 private:
  /// Ring buffer of recent tokens; unused entries are all zeros.
  class Recent {
   public:
    bool contains(const TokenHash& token) const;
    void add(const TokenHash& token);

   private:
    std::array<TokenHash, 4> tokens_{};
    std::size_t next_ = 0;
  };
  struct Entry {
    Recent right, wrong;
    int guesses = 0;
    Time last_guess, blocked_until, last;
  };
  Entry& refreshEntry(const std::string& address, Time now);

  std::map<std::string, Entry> entries_;  ///< by address
};

/// Normalised address of a peer without its port: "ipv4:192.0.2.7:4711" and "192.0.2.7" are equal. IPv6 addresses are
/// reduced to their first 64 bits, because a host may choose the others freely.
std::string addressOf(std::string_view peer);

}  // namespace robosim
