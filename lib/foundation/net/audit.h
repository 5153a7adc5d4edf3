#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "base/log_limiter.h"
#include "net/access.h"

namespace robosim {

/// Line of the audit log, "audit: 2027-01-31T18:00:00Z anna (ipv4:192.0.2.7:4711): pause": time (UTC), name of the
/// token, peer, and action. Control characters of peer and action are escaped.
std::string auditLine(const Identity& client, const std::string& peer, const std::string& action,
                      Access::Clock::time_point when = Access::Clock::now());

/// Writer of audit lines with a rate limit for each token (LogLimiter), so that a client that repeats an action neither
/// fills the disk nor hides the actions of others. Suppressed lines are counted: "audit of anna: 40 more lines within
/// 1 s suppressed (limit: 20 lines/s)". Thread-safe.
class AuditLog {
 public:
  static constexpr int kLinesPerSecond = 20;

  /// @param log receives one line
  /// @param now determines the seconds of the limit
  explicit AuditLog(std::function<void(const std::string&)> log,
                    std::function<LogLimiter::Clock::time_point()> now = LogLimiter::Clock::now)
      : limiter_(std::move(log), std::move(now), kLinesPerSecond) {}

  void write(const Identity& client, const std::string& peer, const std::string& action) {
    limiter_.write("audit of " + client.name(), auditLine(client, peer, action));
  }
  /// Reports the lines suppressed in past seconds. Call about once a second, and at the end.
  void reportSuppressed() { limiter_.reportSuppressed(); }

 private:
  LogLimiter limiter_;
};

}  // namespace robosim
