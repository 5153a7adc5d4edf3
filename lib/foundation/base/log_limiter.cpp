#include "base/log_limiter.h"

#include <utility>

namespace robosim {

LogLimiter::LogLimiter(std::function<void(const std::string&)> log, std::function<Clock::time_point()> now,
                       int lines_per_second)
    : log_(std::move(log)), now_(std::move(now)), lines_per_second_(lines_per_second) {}

void LogLimiter::write(std::string_view kind, const std::string& line) {
  const std::lock_guard lock(mutex_);
  auto found = windows_.find(kind);
  if (found == windows_.end()) found = windows_.emplace(kind, Window{}).first;
  Window& window = found->second;
  const auto second = std::chrono::floor<std::chrono::seconds>(now_());
  if (second != window.second) {
    report(found->first, window);
    window = {second, 0, 0};
  }
  if (window.lines < lines_per_second_) {
    ++window.lines;
    log_(line);
  } else {
    ++window.suppressed;
    has_suppressed_ = true;
  }
}

void LogLimiter::reportSuppressed() {
  if (!has_suppressed_) return;
  const std::lock_guard lock(mutex_);
  const auto second = std::chrono::floor<std::chrono::seconds>(now_());
  bool is_any_left = false;
  for (auto& [kind, window] : windows_) {
    if (second != window.second) report(kind, window);
    is_any_left = is_any_left || window.suppressed > 0;
  }
  has_suppressed_ = is_any_left;
}

void LogLimiter::report(const std::string& kind, Window& window) {
  if (window.suppressed == 0) return;
  log_(kind + ": " + std::to_string(std::exchange(window.suppressed, 0)) +
       " more lines within 1 s suppressed (limit: " + std::to_string(lines_per_second_) + " lines/s)");
}

}  // namespace robosim
