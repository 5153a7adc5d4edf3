#pragma once
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace robosim {

/// A wait that takes so long has failed, also on a slow machine.
inline constexpr std::chrono::minutes kLongestWait{5};

/// Result of a run of the program.
struct Ended {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// A path as one argument of a command line.
inline std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// Runs `robosim ARGUMENTS` (through the shell, in the project's folder) to its end.
/// @param out receives its standard output instead of Ended::out
Ended runProgram(const std::string& arguments, const std::string& out = "");

/// The same with any command.
Ended runCommand(const std::string& command);

/// The program running concurrently with the test. A thread reads its output, so that it never waits for the test.
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
  /// Waits until standard output, or standard error, contains this text a number of times; fails the test if the
  /// program ends before, or after kLongestWait.
  ///@{
  void waitForOutput(const std::string& text) { waitFor(out_, text, 1); }
  void waitForError(const std::string& text, std::size_t times = 1) { waitFor(err_, text, times); }
  ///@}
  /// Waits until a file exists, as above.
  void waitForFile(const std::filesystem::path&);
  /// Waits until a folder contains a file, as above.
  void waitForFileIn(const std::filesystem::path& folder);
  std::string output() const;  ///< standard output so far
  std::string error() const;   ///< standard error so far
  Ended wait();

 private:
  void start(const std::string& program, const std::vector<std::string>& arguments);
  void readOutput();
  void waitFor(const std::string& stream, const std::string& text, std::size_t times);
  void waitForFiles(const std::filesystem::path& folder, const std::function<bool()>& is_there);

  pid_t process_ = -1;
  int end_ = -1;  ///< file descriptor that is readable when the process has ended
  int out_pipe_ = -1, err_pipe_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable has_output_;
  std::string out_, err_;
  bool is_all_read_ = false;  ///< the process has ended, and its output is complete
  std::thread reader_;
  int status_ = 0;
  bool ended_ = false;
};

/// A new, empty folder for the running test.
std::filesystem::path emptyFolder();

/// Number of occurrences of a text in another.
std::size_t countOf(const std::string& part, const std::string& text);

std::string textOf(const std::filesystem::path& file);

}  // namespace robosim
