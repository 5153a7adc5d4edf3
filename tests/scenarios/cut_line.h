#pragma once
#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace robosim {

/// A line of TCP to a port of this machine that a test can cut, at any byte. Whoever calls again is put through again.
class CutLine {
 public:
  explicit CutLine(int port);
  ~CutLine();
  CutLine(const CutLine&) = delete;
  CutLine& operator=(const CutLine&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(own_port_); }
  /// Cuts the line that stands after so many more bytes from the caller.
  void cutAfter(int bytes) { bytes_left_ = bytes; }
  /// Passes nothing on any more, as when a machine has lost its power: the line stands, and nobody hears otherwise.
  void fallSilent() { is_silent_ = true; }

 private:
  void answerCalls();
  void carry(int caller);

  int port_, own_port_ = 0, listener_ = -1;
  std::atomic<int> bytes_left_{-1};  ///< below 0: all
  std::atomic<bool> is_silent_{false}, is_ending_{false};
  std::thread thread_;
};

}  // namespace robosim
