#pragma once
#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/roles.h"

namespace robosim {

/// SHA-256 of a token: all have the same length, and no token is kept in memory.
using TokenHash = std::array<unsigned char, 32>;
TokenHash computeHash(std::string_view token);

/// One line of a token file.
struct TokenHolder {
  TokenHash token_hash;
  Role role = Role::viewer;
  std::vector<std::string> robots;  ///< robots that a token of the role robot may drive
  std::string name;                 ///< for logs; not secret
  /// Time (UTC) from which on the token is refused; nullopt for never.
  std::optional<std::chrono::sys_seconds> expires;
};

/// Table of the tokens of a file. A line is
///
///     TOKEN ROLE [ROBOT…] [name=NAME] [expires=DATE]
///
/// TOKEN: 16 or more printable ASCII characters without blanks. ROLE: viewer, robot (with one or more robots, in double
/// quotes if their names have blanks or '='), geometry, operator, or supervisor. NAME: 1 to 64 of A-Z a-z 0-9 . _ -;
/// without it a token is named after its line, "line-3". DATE: 2027-01-31, the last day (UTC) on which the token is
/// valid, or 2027-01-31T18:00:00Z, the time from which on it is refused. Empty lines and those that begin with # are
/// ignored.
class TokenTable {
 public:
  /// @param file name of the file for errors. No error quotes a token.
  /// @throws ConfigError
  static TokenTable parse(const std::string& text, const std::string& file);

  /// Compares with every token in constant time, against timing attacks. Null for an unknown token.
  const TokenHolder* find(const TokenHash& hash) const;
  const std::vector<TokenHolder>& holders() const { return holders_; }

 private:
  std::vector<TokenHolder> holders_;
};

}  // namespace robosim
