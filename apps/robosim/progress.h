#pragma once
#include <chrono>
#include <string>

namespace robosim {

/// One line on standard error that is written over and over. Shows nothing unless standard error is a terminal.
class Progress {
 public:
  Progress();
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether it is time to show again: five times a second at most, so that the text need not be made more often.
  bool due();
  void show(const std::string& text);

 private:
  bool on_terminal_;
  std::chrono::steady_clock::time_point next_;
  std::size_t shown_ = 0;
};

}  // namespace robosim
