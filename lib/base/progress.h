#pragma once
#include <chrono>
#include <string>

namespace robosim {

/// A progress line on standard error that is rewritten in place. Prints nothing unless standard error is a terminal.
class Progress {
 public:
  Progress();
  ~Progress();  ///< clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether to show again: at most five times per second, so that callers need not format the text more often.
  bool due();
  void show(const std::string& text);

 private:
  bool on_terminal_;
  std::chrono::steady_clock::time_point next_;
  std::size_t shown_ = 0;
};

}  // namespace robosim
