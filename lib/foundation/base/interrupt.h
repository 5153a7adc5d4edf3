#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>

namespace robosim {

/// Signal handler for an orderly end: during its lifetime the first Ctrl-C (SIGINT), SIGTERM or SIGHUP requests the end
/// instead of ending the program; the second one ends it. An ignored SIGHUP (nohup) stays ignored. One instance at a
/// time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool isRequested() const;
  /// Ignores all further interrupts until the process ends. For a command whose outputs are complete: its exit code is
  /// then the same for a signal that arrives while the process ends.
  void ignoreUntilExit();
  /// Number of the signal that requested the end; 0 for none. Also valid without an instance.
  static int signal();

 private:
  bool is_ignored_until_exit_ = false;
};

/// Ends a command because of Interrupt::signal(). The program's exit code is 128 + the signal's number.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws Interrupted "interrupted; what" when a signal has requested the end.
void throwIfInterrupted(const std::string& what);

/// Registration of an unfinished file, which is removed when a signal ends the program, provided that
/// removePartialFilesOnSignals() was called and at most kMaxPartialFiles exist.
class PartialFile {
 public:
  static constexpr std::size_t kMaxPartialFiles = 64;

  explicit PartialFile(const std::string& path);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

 private:
  std::size_t slot_ = kMaxPartialFiles;
};

/// Makes SIGINT, SIGTERM, SIGHUP and SIGPIPE remove all PartialFiles before they end the program, and a file size limit
/// (SIGXFSZ) an ordinary write error. Call once, when the program starts.
void removePartialFilesOnSignals();

}  // namespace robosim
