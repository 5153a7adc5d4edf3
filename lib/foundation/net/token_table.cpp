#include "net/token_table.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iomanip>
#include <sstream>

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include "base/error_list.h"

namespace robosim {
namespace {

constexpr std::size_t kMinTokenLength = 16;
constexpr std::size_t kMaxNameLength = 64;

static_assert(std::tuple_size_v<TokenHash> == SHA256_DIGEST_LENGTH);

bool isEqual(const TokenHash& a, const TokenHash& b) { return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0; }

bool isPrintable(const std::string& token) {
  return std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c <= '~'; });
}

bool isName(const std::string& name) {
  const auto is_fit = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-';
  };
  return !name.empty() && name.size() <= kMaxNameLength && std::all_of(name.begin(), name.end(), is_fit);
}

/// Reads a number that is followed by `end`, and skips both.
bool readNumber(std::string_view& text, std::size_t digits, std::string_view end, int& number) {
  if (text.size() < digits + end.size() || text.substr(digits, end.size()) != end) return false;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + digits, number);
  if (error != std::errc{} || stop != text.data() + digits || number < 0) return false;
  text.remove_prefix(digits + end.size());
  return true;
}

/// Expiry of a token with `expires=DATE`; nullopt for an invalid date.
std::optional<std::chrono::sys_seconds> readExpiry(std::string_view text) {
  using namespace std::chrono;
  int y = 0, m = 0, d = 0, hour = 0, minute = 0, second = 0;
  const bool is_day = text.size() == 10;
  if (!readNumber(text, 4, "-", y) || !readNumber(text, 2, "-", m)) return std::nullopt;
  if (!readNumber(text, 2, is_day ? "" : "T", d)) return std::nullopt;
  const year_month_day date{year(y), month(static_cast<unsigned>(m)), day(static_cast<unsigned>(d))};
  if (!date.ok()) return std::nullopt;
  if (is_day) return sys_days(date) + days(1);
  if (!readNumber(text, 2, ":", hour) || !readNumber(text, 2, ":", minute) || !readNumber(text, 2, "Z", second) ||
      !text.empty() || hour > 23 || minute > 59 || second > 59) {
    return std::nullopt;
  }
  return sys_days(date) + hours(hour) + minutes(minute) + seconds(second);
}

/// Reads the next word, which may be in double quotes.
bool readWord(std::istream& words, std::string& word, bool& is_quoted) {
  words >> std::ws;
  is_quoted = words.peek() == '"';
  return static_cast<bool>(words >> std::quoted(word));
}

/// Reads the words after the role: robots, and the attributes name and expires.
void readRest(std::istream& words, TokenHolder& holder, const std::function<void(const std::string&)>& report) {
  bool is_quoted = false;
  for (std::string word; readWord(words, word, is_quoted);) {
    const auto equals = is_quoted ? std::string::npos : word.find('=');
    const std::string attribute = word.substr(0, equals);
    if (equals == std::string::npos) {
      holder.robots.push_back(word);
    } else if (attribute == "name") {
      holder.name = word.substr(equals + 1);
      if (!isName(holder.name)) {
        report("name= must have 1 to " + std::to_string(kMaxNameLength) + " of the characters A-Z a-z 0-9 . _ -");
      }
    } else if (attribute == "expires") {
      holder.expires = readExpiry(std::string_view(word).substr(equals + 1));
      if (!holder.expires) {
        report("expires= must be a date, 2027-01-31 (the last valid day) or 2027-01-31T18:00:00Z, in UTC");
      }
    } else {
      report(
          "a token has the attributes name= and expires=, and no other; if this is a robot's name, put it in "
          "double quotes");
    }
  }
}

}  // namespace

TokenHash computeHash(std::string_view token) {
  TokenHash hash;
  SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), hash.data());
  return hash;
}

TokenTable TokenTable::parse(const std::string& text, const std::string& file) {
  TokenTable table;
  ErrorList errors;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto report = [&](const std::string& what) { errors.add(file, number, what); };
    std::istringstream words(line);
    std::string token, role;
    if (!(words >> token) || token.front() == '#') continue;
    words >> role;
    TokenHolder holder{computeHash(token), Role::viewer, {}, "line-" + std::to_string(number), {}};
    readRest(words, holder, report);
    if (token.size() < kMinTokenLength || !isPrintable(token)) {
      report("the token must have 16 or more characters of ASCII; 'openssl rand -hex 16' makes one");
    }
    if (table.find(holder.token_hash)) report("the token is already used in an earlier line; create another");
    const auto has_name = [&](const TokenHolder& other) { return other.name == holder.name; };
    if (std::any_of(table.holders_.begin(), table.holders_.end(), has_name)) {
      report("the name " + holder.name + " is that of an earlier line already; give each token its own");
    }
    const auto found = findRole(role);
    if (!found) {
      report("a role must follow the token: viewer, robot NAME…, geometry, operator, or supervisor");
    } else {
      holder.role = *found;
      const bool names_robots = !holder.robots.empty();
      if (holder.role == Role::robot && !names_robots) report("the role robot needs names: robot NAME…");
      if (holder.role != Role::robot && names_robots) report("only the role robot takes names");
    }
    table.holders_.push_back(std::move(holder));
  }
  if (table.holders_.empty()) {
    errors.add(file, number, "has no token, so that no client would be accepted; add a line TOKEN ROLE");
  }
  errors.throwIfAny();
  return table;
}

const TokenHolder* TokenTable::find(const TokenHash& hash) const {
  const TokenHolder* found = nullptr;
  for (const auto& holder : holders_) {
    if (isEqual(holder.token_hash, hash)) found = &holder;
  }
  return found;
}

}  // namespace robosim
