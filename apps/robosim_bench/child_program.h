#pragma once
#include <string>
#include <vector>

#include <sys/types.h>

namespace robosim {

/// The program `robosim` beside this one, started as a child process without output. It is ended with this object.
class ChildProgram {
 public:
  /// @param arguments of robosim, its subcommand first
  /// @throws std::runtime_error when it cannot be started
  explicit ChildProgram(std::vector<std::string> arguments);
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  /// Whether the program has ended; it ends by itself only on an error, which it has printed.
  bool hasEnded();
  /// CPU time of the process and of the child processes that it had at the first call.
  double cpuSeconds();

 private:
  void findProcesses();

  pid_t id_ = 0;
  bool has_ended_ = false;
  std::vector<pid_t> processes_;
};

}  // namespace robosim
