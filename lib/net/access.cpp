#include "net/access.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include "base/error_list.h"
#include "net/private_file.h"
#include "net/wire_error.h"

namespace robosim {
namespace {

constexpr std::size_t kShortestToken = 16;

using Hash = std::array<unsigned char, 32>;
static_assert(std::tuple_size_v<Hash> == SHA256_DIGEST_LENGTH);

Hash hashOf(std::string_view token) {
  Hash hash;
  SHA256(reinterpret_cast<const unsigned char*>(token.data()), token.size(), hash.data());
  return hash;
}

bool isEqual(const Hash& a, const Hash& b) { return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0; }

bool isPrintable(const std::string& token) {
  return std::all_of(token.begin(), token.end(), [](char c) { return c > ' ' && c <= '~'; });
}

grpc::Status refuse(grpc::StatusCode code, const std::string& what) { return {code, what}; }

}  // namespace

Access Access::read(const std::filesystem::path& file) {
  return parse(readPrivateFile(file, "the file of tokens"), file.string());
}

Access Access::parse(const std::string& text, const std::string& file) {
  Access access;
  ErrorList errors;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    std::string token, role, name;
    if (!(words >> token) || token.front() == '#') continue;
    words >> role;
    Holder holder{hashOf(token), Role::viewer, {}};
    while (words >> std::quoted(name)) holder.robots.push_back(name);
    if (token.size() < kShortestToken || !isPrintable(token)) {
      errors.add(file, number, "the token must have 16 or more characters of ASCII; 'openssl rand -hex 16' makes one");
    }
    if (access.holderOf(token)) errors.add(file, number, "the token stands in an earlier line already; make another");
    if (role == "robot") {
      holder.role = Role::robot;
      if (holder.robots.empty()) errors.add(file, number, "the role robot needs names: robot NAME…");
    } else if (role == "viewer" || role == "operator") {
      holder.role = role == "viewer" ? Role::viewer : Role::all;
      if (!holder.robots.empty()) errors.add(file, number, "only the role robot takes names");
    } else {
      errors.add(file, number, "after the token must stand its role: viewer, robot NAME…, or operator");
    }
    access.holders_.push_back(std::move(holder));
  }
  if (access.holders_.empty()) errors.add(file, number, "has no token, so nobody could come in; add a line TOKEN ROLE");
  errors.throwIfAny();
  return access;
}

/// Compares with every token in the same time, found or not, so that the time tells nothing.
const Access::Holder* Access::holderOf(std::string_view token) const {
  const Hash hash = hashOf(token);
  const Holder* found = nullptr;
  for (const auto& holder : holders_) {
    if (isEqual(holder.token_hash, hash)) found = &holder;
  }
  return found;
}

grpc::Status Access::check(std::optional<std::string_view> token, Right right,
                           std::span<const std::string> robots) const {
  if (isOpen()) return grpc::Status::OK;
  if (!token) {
    return refuse(grpc::StatusCode::UNAUTHENTICATED,
                  "asks for a token, and none was shown; name a file with yours in --token-file, or put it into the "
                  "environment variable ROBOSIM_TOKEN");
  }
  const Holder* holder = holderOf(*token);
  if (!holder) {
    return refuse(
        grpc::StatusCode::UNAUTHENTICATED,
        "the token is none of those known here; ask whoever started the environment (serve --tokens) for one");
  }
  if (holder->role == Role::all) return grpc::Status::OK;
  if (holder->role == Role::viewer && right != Right::look) {
    return refuse(grpc::StatusCode::PERMISSION_DENIED,
                  "the token is a viewer's, with which one may look and no more; use another");
  }
  if (holder->role == Role::robot && right != Right::drive) {
    return refuse(grpc::StatusCode::PERMISSION_DENIED, "the token is a robot's, with which one may drive " +
                                                           listed(holder->robots) + " and no more; use another");
  }
  for (const auto& robot : robots) {
    if (std::find(holder->robots.begin(), holder->robots.end(), robot) != holder->robots.end()) continue;
    return refuse(grpc::StatusCode::PERMISSION_DENIED, "the token is not for robot " + inQuotes(robot) + " but for " +
                                                           listed(holder->robots) + "; use another");
  }
  return grpc::Status::OK;
}

grpc::Status Access::check(const grpc::ServerContextBase& caller, Right right,
                           std::span<const std::string> robots) const {
  const auto& metadata = caller.client_metadata();
  const auto shown = metadata.find(kTokenKey);
  if (shown == metadata.end()) return check(std::nullopt, right, robots);
  std::string_view token(shown->second.data(), shown->second.size());
  if (token.substr(0, kTokenPrefix.size()) == kTokenPrefix) token.remove_prefix(kTokenPrefix.size());
  return check(token, right, robots);
}

}  // namespace robosim
