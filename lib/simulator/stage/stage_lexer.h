#pragma once
#include <memory>
#include <string>
#include <vector>

namespace robosim::stage {

/// Line of a file of Stage, for errors and notes.
struct Place {
  std::shared_ptr<const std::string> file;  ///< null: none
  int line = 0;

  /// "pioneer.inc:12"
  std::string text() const { return (file ? *file : std::string()) + ":" + std::to_string(line); }
};

enum class TokenKind { word, number, text, open_entity, close_entity, open_tuple, close_tuple };

/// A token of a world file of Stage.
struct Token {
  TokenKind kind = TokenKind::word;
  std::string text;  ///< the word, the content of the string, or the characters of the number
  double number = 0;
  Place place;
};

/// Greatest absolute value of a number, as in RoboSim's own files.
constexpr double kNumberMax = 1e9;
/// Longest word or string [bytes]; Stage has room for no more.
constexpr std::size_t kTokenBytesMax = 255;
/// Most tokens of a file.
constexpr std::size_t kTokensMax = 4'000'000;

/// Divides a file into tokens. `#` begins a comment to the end of the line; LF, CR and CRLF end lines.
/// @throws ConfigError "file:line: what" for an unexpected character, an open string, a number that is none or above
/// kNumberMax, and a token above kTokenBytesMax
std::vector<Token> tokenize(const std::string& text, const std::shared_ptr<const std::string>& file);

}  // namespace robosim::stage
