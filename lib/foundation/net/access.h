#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <grpcpp/grpcpp.h>

#include "net/token_table.h"

namespace robosim {

/// A client of a session, identified by its token. Created by Access::authenticate().
class Identity {
 public:
  /// Name of the token, for logs; "anyone" when no token is required.
  const std::string& name() const { return name_; }
  /// Whether two clients have sent the same token, or none is required of either.
  bool hasTokenOf(const Identity& other) const { return token_hash_ == other.token_hash_; }

 private:
  friend class Access;
  std::string name_ = "anyone";
  std::optional<TokenHash> token_hash_;
};

/// Permissions of clients, by token. A session authenticates once; each later request is checked against the current
/// tokens, because the file may have changed. Thread-safe; copies share their state.
class Access {
 public:
  using Clock = std::chrono::system_clock;

  struct Options {
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< receives one line
    /// Whether a reload of the file was requested (SIGHUP); returns true once per request.
    std::function<bool()> is_reload_requested = [] { return false; };
    std::function<Clock::time_point()> now = Clock::now;
  };

  /// Grants every right to every client.
  Access() = default;

  /// Reads a token file (TokenTable) that only its owner may read; refresh() reads it again when it has changed.
  /// @throws ConfigError; no error quotes a token.
  static Access read(const std::filesystem::path& file, const Options& options);
  static Access read(const std::filesystem::path& file) { return read(file, Options()); }
  /// The same from text; `file` names it in errors.
  static Access parse(const std::string& text, const std::string& file, const Options& options);
  static Access parse(const std::string& text, const std::string& file) { return parse(text, file, Options()); }

  /// Whether every client has every right.
  bool isOpen() const { return !state_; }

  struct Authenticated {
    /// OK; UNAUTHENTICATED for a missing, unknown or expired token; RESOURCE_EXHAUSTED after too many wrong tokens from
    /// that address (GuessLimiter). With an error text for the client.
    grpc::Status status;
    Identity identity;  ///< if the status is OK
  };
  /// @param token sent by the client; nullopt for none
  /// @param peer address of the client, as reported by gRPC or the web server
  Authenticated authenticate(std::optional<std::string_view> token, std::string_view peer) const;
  /// The same with the value of the header `authorization`: "Bearer TOKEN".
  Authenticated authenticateHeader(std::optional<std::string_view> value, std::string_view peer) const;
  /// The same for a call, with the token in its metadata: `authorization: Bearer TOKEN`.
  Authenticated authenticate(const grpc::ServerContextBase& call) const;

  /// Checks whether a client currently has a right.
  /// @param robots that the client requests to drive; empty when not yet known
  /// @return OK; UNAUTHENTICATED when its token has expired or was removed; PERMISSION_DENIED
  grpc::Status check(const Identity& client, Right right, std::span<const std::string> robots = {}) const;

  /// Reads the file again if it has changed (checked once a second), or if a reload was requested. The errors of an
  /// invalid file are logged, and the previous tokens stay valid. Call often, from any thread.
  /// @return a version number that increases whenever the result of a check may have changed: recheck open sessions
  std::uint64_t refresh() const;

 private:
  struct State;
  std::shared_ptr<State> state_;  ///< null: open
};

/// Metadata key of a call's token, and the prefix of its value.
constexpr const char* kTokenKey = "authorization";
constexpr std::string_view kTokenPrefix = "Bearer ";

}  // namespace robosim
