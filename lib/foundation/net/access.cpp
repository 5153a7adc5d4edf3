#include "net/access.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <utility>

#include <sys/stat.h>

#include "base/error_list.h"
#include "net/guess_limiter.h"
#include "net/peer_address.h"
#include "net/private_file.h"
#include "net/roles.h"
#include "net/wire_error.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;
using Time = Access::Clock::time_point;

/// Interval at which the file is checked for changes.
constexpr auto kPollPeriod = 1s;

grpc::Status invalidToken(const std::string& what) { return errorStatus(v1::ERROR_REASON_TOKEN_INVALID, what); }

bool isExpired(const TokenHolder& holder, Time now) { return holder.expires && now >= *holder.expires; }

/// Attributes of a file that change when it is written or replaced, or when its permissions change: device, inode,
/// size, modification time and status change time [ns]. All zeros for a file that does not exist.
using FileSignature = std::array<std::int64_t, 5>;

FileSignature readSignature(const std::filesystem::path& file) {
  struct stat about {};
  if (stat(file.c_str(), &about) != 0) return {};
  const auto ns = [](const timespec& time) { return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec; };
  return {static_cast<std::int64_t>(about.st_dev), static_cast<std::int64_t>(about.st_ino), about.st_size,
          ns(about.st_mtim), ns(about.st_ctim)};
}

}  // namespace

struct Access::State {
  State(TokenTable the_table, std::filesystem::path the_file, const Options& the_options)
      : options(the_options), file(std::move(the_file)), table(std::move(the_table)) {
    const Time now = options.now();
    polled = now;
    logExpired({}, now);
    expiries_until = now;
  }

  /// @name With the mutex held
  ///@{
  void poll(Time now);
  void reload();
  void logExpired(Time after, Time until) const;
  ///@}

  std::mutex mutex;
  const Options options;
  const std::filesystem::path file;  ///< empty: not from a file
  TokenTable table;
  GuessLimiter guesses;
  FileSignature read{}, changed{};  ///< of the file when last read or refused; at the last check
  Time polled;
  Time expiries_until;  ///< expiries up to this time have been reported
  std::uint64_t version = 0;
};

Access Access::read(const std::filesystem::path& file, const Options& options) {
  const FileSignature signature = readSignature(file);
  Access access;
  access.state_ = std::make_shared<State>(TokenTable::parse(readPrivateFile(file, "the file of tokens"), file.string()),
                                          file, options);
  access.state_->read = access.state_->changed = signature;
  return access;
}

Access Access::parse(const std::string& text, const std::string& file, const Options& options) {
  Access access;
  access.state_ = std::make_shared<State>(TokenTable::parse(text, file), "", options);
  return access;
}

Access::Authenticated Access::authenticate(std::optional<std::string_view> token, std::string_view peer) const {
  if (isOpen()) return {};
  if (!token) {
    return {errorStatus(v1::ERROR_REASON_TOKEN_REQUIRED,
                        "requires a token; specify its file with --token-file, or set the environment variable "
                        "ROBOSIM_TOKEN"),
            {}};
  }
  const TokenHash hash = computeHash(*token);
  const std::string address = addressOf(peer);
  const std::lock_guard lock(state_->mutex);
  const Time now = state_->options.now();
  if (const auto wait = state_->guesses.wait(address, hash, now); wait > 0ms) {
    return {errorStatus(v1::ERROR_REASON_TOO_MANY_WRONG_TOKENS,
                        "too many wrong tokens came from this address; try again in " +
                            std::to_string(std::chrono::ceil<std::chrono::seconds>(wait).count()) + " s"),
            {}};
  }
  const TokenHolder* holder = state_->table.find(hash);
  if (!holder) {
    state_->guesses.noteWrong(address, hash, now);
    return {
        invalidToken("the token is unknown; request a valid one from the operator of the environment (serve --tokens)"),
        {}};
  }
  if (isExpired(*holder, now)) {
    return {invalidToken("the token " + holder->name +
                         " has expired; request another from the operator of the environment"),
            {}};
  }
  state_->guesses.noteRight(address, hash, now);
  Authenticated done;
  done.identity.name_ = holder->name;
  done.identity.token_hash_ = hash;
  return done;
}

Access::Authenticated Access::authenticateHeader(std::optional<std::string_view> value, std::string_view peer) const {
  if (value && value->starts_with(kTokenPrefix)) value->remove_prefix(kTokenPrefix.size());
  return authenticate(value, peer);
}

Access::Authenticated Access::authenticate(const grpc::ServerContextBase& call) const {
  if (isOpen()) return {};
  const auto& metadata = call.client_metadata();
  const auto entry = metadata.find(kTokenKey);
  if (entry == metadata.end()) return authenticate(std::nullopt, "");
  return authenticateHeader(std::string_view(entry->second.data(), entry->second.size()), peerOf(call));
}

grpc::Status Access::check(const Identity& client, Right right, std::span<const std::string> robots) const {
  if (isOpen()) return grpc::Status::OK;
  const std::lock_guard lock(state_->mutex);
  const TokenHolder* holder = client.token_hash_ ? state_->table.find(*client.token_hash_) : nullptr;
  if (!holder) return invalidToken("the token was withdrawn; request another from the operator of the environment");
  if (isExpired(*holder, state_->options.now())) {
    return invalidToken("the token " + holder->name +
                        " has expired; request another from the operator of the environment");
  }
  if (!permits(holder->role, right)) {
    return errorStatus(v1::ERROR_REASON_PERMISSION_DENIED,
                       "the token " + refusalText(holder->role, holder->robots, right));
  }
  if (holder->role != Role::robot) return grpc::Status::OK;
  for (const auto& robot : robots) {
    if (std::find(holder->robots.begin(), holder->robots.end(), robot) != holder->robots.end()) continue;
    return errorStatus(
        v1::ERROR_REASON_PERMISSION_DENIED,
        "the token is not for robot " + inQuotes(robot) + " but for " + listed(holder->robots) + "; use another",
        robot);
  }
  return grpc::Status::OK;
}

std::uint64_t Access::refresh() const {
  if (isOpen()) return 0;
  const std::lock_guard lock(state_->mutex);
  const Time now = state_->options.now();
  // The clock may also be set back.
  if (now >= state_->polled + kPollPeriod || now < state_->polled) state_->poll(now);
  if (!state_->file.empty() && state_->options.is_reload_requested()) state_->reload();
  return state_->version;
}

void Access::State::poll(Time now) {
  polled = now;
  const auto has_expired = [&](const TokenHolder& holder) {
    return isExpired(holder, now) && !isExpired(holder, expiries_until);
  };
  if (std::any_of(table.holders().begin(), table.holders().end(), has_expired)) ++version;
  logExpired(expiries_until, now);
  expiries_until = now;
  if (file.empty()) return;
  const FileSignature found = readSignature(file);
  // A file that changed since the last check may be incomplete: it is read after a period without changes.
  if (found == std::exchange(changed, found) && found != read) reload();
}

void Access::State::reload() {
  read = changed = readSignature(file);
  try {
    table = TokenTable::parse(readPrivateFile(file, "the file of tokens"), file.string());
    ++version;
    options.log("tokens: read " + std::to_string(table.holders().size()) + " from " + file.string() + " again");
    logExpired({}, options.now());
  } catch (const ConfigError& error) {
    constexpr std::size_t most = 10;
    for (const auto& line : std::span(error.errors()).first(std::min(error.errors().size(), most))) {
      options.log("tokens: " + line);
    }
    options.log("tokens: " + file.string() + " is not valid; the tokens that were read before stay in force");
  }
}

/// Logs the tokens that expired within a time interval.
void Access::State::logExpired(Time after, Time until) const {
  for (const auto& holder : table.holders()) {
    if (isExpired(holder, until) && !isExpired(holder, after)) options.log("tokens: " + holder.name + " has expired");
  }
}

}  // namespace robosim
