#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace robosim {

/// What a run of the program left behind.
struct Ended {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `robosim ARGUMENTS` (through the shell, from the project's folder) to its end.
/// @param out where its standard output goes instead of to Ended::out
Ended runProgram(const std::string& arguments, const std::string& out = "");

/// A run of the program that goes on beside the test.
class StartedProgram {
 public:
  explicit StartedProgram(const std::vector<std::string>& arguments);  ///< robosim
  StartedProgram(const std::string& program, const std::vector<std::string>& arguments);
  ~StartedProgram();  ///< kills it if it still runs
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  bool isRunning();
  void interrupt();  ///< as Ctrl-C does
  void signal(int number);
  /// Waits until standard output, or standard error, has this text; fails the test if the program ends without it.
  ///@{
  void waitForOutput(const std::string& text) { waitFor(".out", text); }
  void waitForError(const std::string& text) { waitFor(".err", text); }
  ///@}
  std::string output() const;  ///< standard output so far
  std::string error() const;   ///< standard error so far
  Ended wait();

 private:
  void waitFor(const char* stream, const std::string& text);

  pid_t process_;
  std::string stem_;
  int status_ = 0;
  bool ended_ = false;
};

/// A new, empty folder of the running test's own.
std::filesystem::path emptyFolder();

/// How often a text has another in it.
std::size_t countOf(const std::string& part, const std::string& text);

std::string textOf(const std::filesystem::path& file);

}  // namespace robosim
