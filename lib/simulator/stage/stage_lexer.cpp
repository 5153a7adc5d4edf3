#include "stage/stage_lexer.h"

#include <cctype>
#include <cmath>
#include <string_view>

#include "base/error_list.h"
#include "base/printable_text.h"
#include "base/xml_element.h"

namespace robosim::stage {
namespace {

bool isOneOf(char c, std::string_view set) { return set.find(c) != std::string_view::npos; }
bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool isAlphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

class Lexer {
 public:
  Lexer(std::string_view text, const std::shared_ptr<const std::string>& file) : text_(text), place_{file, 1} {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);  // byte order mark
  }

  std::vector<Token> tokens() {
    while (!text_.empty()) {
      next();
      if (tokens_.size() > kTokensMax) throw error("the file has more than 4 million words; is it a world of Stage?");
    }
    return std::move(tokens_);
  }

 private:
  void next() {
    const char c = text_.front();
    if (isOneOf(c, " \t\f\v")) {
      text_.remove_prefix(1);
    } else if (isOneOf(c, "\r\n")) {
      endLine();
    } else if (c == '#') {
      text_.remove_prefix(std::min(text_.find_first_of("\r\n"), text_.size()));
    } else if (isLetter(c) || c == '_') {
      add(TokenKind::word, take([](char each) { return isAlphanumeric(each) || isOneOf(each, ".-_[]"); }));
    } else if (isOneOf(c, "+-.0123456789")) {
      addNumber();
    } else if (c == '"') {
      addText();
    } else if (isOneOf(c, "()[]")) {
      add(c == '('   ? TokenKind::open_entity
          : c == ')' ? TokenKind::close_entity
          : c == '[' ? TokenKind::open_tuple
                     : TokenKind::close_tuple,
          text_.substr(0, 1));
      text_.remove_prefix(1);
    } else {
      throw error("unexpected character '" + quotable(std::string(1, c)) +
                  "'; a world of Stage consists of words, numbers, \"strings\", ( ) and [ ]");
    }
  }

  void endLine() {
    const bool is_pair = text_.size() > 1 && isOneOf(text_[1], "\r\n") && text_[1] != text_[0];
    text_.remove_prefix(is_pair ? 2 : 1);
    ++place_.line;
  }

  template <typename Accepts>
  std::string_view take(Accepts accepts) {
    std::size_t size = 0;
    while (size < text_.size() && accepts(text_[size])) ++size;
    const std::string_view taken = text_.substr(0, size);
    text_.remove_prefix(size);
    return taken;
  }

  void addNumber() {
    // An exponent is more than Stage reads.
    char before = ' ';
    const std::string_view digits = take([&](char c) {
      const bool is_part =
          isOneOf(c, ".0123456789") || isOneOf(c, "eE") || (isOneOf(c, "+-") && isOneOf(before, " eE"));
      before = c;
      return is_part;
    });
    const auto number = parseNumber(std::string(digits));
    if (!number) throw error("'" + quotable(std::string(digits)) + "' is not a number; write it as in -1.5");
    if (!(std::abs(*number) <= kNumberMax)) {
      throw error("'" + quotable(std::string(digits)) + "' is too large; numbers are at most 1e9");
    }
    add(TokenKind::number, digits);
    tokens_.back().number = *number;
  }

  void addText() {
    const std::size_t end = text_.find_first_of("\"\r\n", 1);
    if (end == std::string_view::npos || text_[end] != '"') throw error("a string has no closing '\"' on its line");
    add(TokenKind::text, text_.substr(1, end - 1));
    text_.remove_prefix(end + 1);
  }

  void add(TokenKind kind, std::string_view text) {
    if (text.size() > kTokenBytesMax) throw error("a word or string has more than 255 characters; shorten it");
    tokens_.push_back({kind, std::string(text), 0, place_});
  }

  ConfigError error(const std::string& what) const { return ConfigError(place_.text() + ": " + what); }

  std::string_view text_;
  Place place_;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokenize(const std::string& text, const std::shared_ptr<const std::string>& file) {
  return Lexer(text, file).tokens();
}

}  // namespace robosim::stage
