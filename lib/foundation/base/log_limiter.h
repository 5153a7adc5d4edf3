#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace robosim {

/// Rate limiter (fixed window of 1 s) for log lines that a peer can cause: of each kind, the first `lines_per_second`
/// lines of a second are written, and the others are counted. One line reports the count once that second is over:
/// before the next line of the kind, or when reportSuppressed() is called. Seconds are those of `now`.
/// Thread-safe.
class LogLimiter {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int kLinesPerSecond = 10;

  /// @param log receives one line; called with the limiter's lock held, so it must not call the limiter
  explicit LogLimiter(std::function<void(const std::string&)> log, std::function<Clock::time_point()> now = Clock::now,
                      int lines_per_second = kLinesPerSecond);
  LogLimiter(const LogLimiter&) = delete;
  LogLimiter& operator=(const LogLimiter&) = delete;

  /// Writes a line, or counts it.
  /// @param kind lines of one kind share a limit; named in the report ("refused viewers"). Must not contain text from a
  ///        peer: every kind is kept for the limiter's lifetime.
  void write(std::string_view kind, const std::string& line);
  /// Reports the lines suppressed in past seconds. Call about once a second, and at the end.
  void reportSuppressed();

 private:
  struct Window {
    std::chrono::time_point<Clock, std::chrono::seconds> second;
    int lines = 0;
    std::uint64_t suppressed = 0;
  };
  void report(const std::string& kind, Window& window);

  std::mutex mutex_;
  std::function<void(const std::string&)> log_;
  std::function<Clock::time_point()> now_;
  int lines_per_second_;
  std::map<std::string, Window, std::less<>> windows_;  ///< by kind
  std::atomic<bool> has_suppressed_{false};             ///< makes reportSuppressed() cheap in the common case
};

}  // namespace robosim
