#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace robosim {

/// Result of a run of the program.
struct Ended {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs `robosim ARGUMENTS` (through the shell, in the project's folder) to its end.
/// @param out receives its standard output instead of Ended::out
Ended runProgram(const std::string& arguments, const std::string& out = "");

/// The same with any command.
Ended runCommand(const std::string& command);

/// The program running concurrently with the test.
class StartedProgram {
 public:
  explicit StartedProgram(const std::vector<std::string>& arguments);  ///< robosim
  StartedProgram(const std::string& program, const std::vector<std::string>& arguments);
  ~StartedProgram();  ///< kills it if it still runs
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  pid_t process() const { return process_; }
  bool isRunning();
  void interrupt();  ///< like Ctrl-C
  void signal(int number);
  /// Waits until standard output, or standard error, contains this text; fails the test if the program ends before.
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

/// A new, empty folder for the running test.
std::filesystem::path emptyFolder();

/// Number of occurrences of a text in another.
std::size_t countOf(const std::string& part, const std::string& text);

std::string textOf(const std::filesystem::path& file);

}  // namespace robosim
