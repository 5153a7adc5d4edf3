#include "tests/scenarios/program.h"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/temporary_directory.h"

namespace robosim {

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::size_t countOf(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

namespace {

/// Temporary folder of this test run, removed at its end.
const std::filesystem::path& scratch() {
  static const TemporaryDirectory folder;
  return folder.path();
}

std::string testName() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "_" + test->name();
  std::replace(name.begin(), name.end(), '/', '_');  // in names of parameterised tests
  return name;
}

/// Output file for the next program of the test.
std::string outputStem() {
  static int programs = 0;
  return scratch() / (testName() + "_program_" + std::to_string(++programs));
}

Ended ended(int status, const std::string& stem) {
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, textOf(stem + ".out"), textOf(stem + ".err")};
}

}  // namespace

std::filesystem::path emptyFolder() {
  auto folder = scratch() / testName();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

StartedProgram::StartedProgram(const std::vector<std::string>& arguments)
    : StartedProgram(ROBOSIM_PROGRAM, arguments) {}

StartedProgram::StartedProgram(const std::string& program, const std::vector<std::string>& arguments) {
  start(program, arguments);
  reader_ = std::thread([this] { readOutput(); });
}

void StartedProgram::start(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  std::array<int, 2> out{}, err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  process_ = fork();
  if (process_ == 0) {
    const bool ready =
        chdir(ROBOSIM_SOURCE_DIR) == 0 && dup2(out[1], STDOUT_FILENO) >= 0 && dup2(err[1], STDERR_FILENO) >= 0;
    if (ready) execv(program.c_str(), words.data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  out_pipe_ = out[0];
  err_pipe_ = err[0];
  for (const int pipe : {out_pipe_, err_pipe_}) fcntl(pipe, F_SETFL, O_NONBLOCK);
  end_ = static_cast<int>(syscall(SYS_pidfd_open, process_, 0));  // Debian 12 declares pidfd_open() for C only
  if (end_ < 0) throw std::runtime_error("no descriptor of the started program");
}

/// Reads until the process has ended, not until the pipes have: a program that it left behind may keep them open.
void StartedProgram::readOutput() {
  std::array<pollfd, 3> waits{pollfd{out_pipe_, POLLIN, 0}, pollfd{err_pipe_, POLLIN, 0}, pollfd{end_, POLLIN, 0}};
  for (bool has_ended = false; !has_ended;) {
    poll(waits.data(), waits.size(), -1);
    has_ended = waits[2].revents != 0;
    // Its output would be lost, as if it had written none.
    if ((waits[2].revents & POLLNVAL) != 0) ADD_FAILURE() << "the descriptor of a started program was closed by others";
    for (std::size_t i = 0; i < 2; ++i) {
      std::array<char, 65536> bytes;
      ssize_t count = 0;
      while ((count = read(waits[i].fd, bytes.data(), bytes.size())) > 0) {
        const std::lock_guard lock(mutex_);
        (i == 0 ? out_ : err_).append(bytes.data(), static_cast<std::size_t>(count));
      }
      if (count == 0) waits[i].fd = -1;  // closed: poll() ignores it from now on
    }
    const std::lock_guard lock(mutex_);
    is_all_read_ = has_ended;
    has_output_.notify_all();
  }
}

StartedProgram::~StartedProgram() {
  if (isRunning()) {
    kill(process_, SIGKILL);
    waitpid(process_, &status_, 0);
  }
  reader_.join();
  for (const int file : {end_, out_pipe_, err_pipe_}) close(file);
}

bool StartedProgram::isRunning() {
  if (!ended_) ended_ = waitpid(process_, &status_, WNOHANG) != 0;
  return !ended_;
}

void StartedProgram::interrupt() { signal(SIGINT); }

void StartedProgram::signal(int number) {
  if (isRunning()) kill(process_, number);
}

std::string StartedProgram::output() const {
  const std::lock_guard lock(mutex_);
  return out_;
}
std::string StartedProgram::error() const {
  const std::lock_guard lock(mutex_);
  return err_;
}

void StartedProgram::waitFor(const std::string& stream, const std::string& text, std::size_t times) {
  std::unique_lock lock(mutex_);
  const auto is_there = [&] { return countOf(text, stream) >= times; };
  const bool is_over = has_output_.wait_for(lock, kLongestWait, [&] { return is_there() || is_all_read_; });
  if (is_there()) return;
  ADD_FAILURE() << "the program " << (is_over ? "ended without saying '" : "has not said for 5 minutes '") << text
                << "'\n"
                << stream << err_;
}

void StartedProgram::waitForFiles(const std::filesystem::path& folder, const std::function<bool()>& is_there) {
  const int events = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  if (inotify_add_watch(events, folder.c_str(), IN_CREATE | IN_MOVED_TO) < 0)
    throw std::runtime_error("no file events");
  std::array<pollfd, 2> waits{pollfd{events, POLLIN, 0}, pollfd{end_, POLLIN, 0}};
  const int longest_ms = static_cast<int>(std::chrono::milliseconds(kLongestWait).count());
  while (!is_there()) {
    std::array<char, 4096> names;
    while (read(events, names.data(), names.size()) > 0) {
    }
    if (is_there()) break;
    poll(waits.data(), waits.size(), longest_ms);
    if (waits[0].revents != 0 || is_there()) continue;
    ADD_FAILURE() << "the program has not created the expected file in " << folder << "\n" << error();
    break;
  }
  close(events);
}

void StartedProgram::waitForFile(const std::filesystem::path& file) {
  waitForFiles(file.parent_path(), [&] { return std::filesystem::exists(file); });
}

void StartedProgram::waitForFileIn(const std::filesystem::path& folder) {
  waitForFiles(folder, [&] { return !std::filesystem::is_empty(folder); });
}

Ended StartedProgram::wait() {
  if (!ended_) waitpid(process_, &status_, 0);
  ended_ = true;
  std::unique_lock lock(mutex_);
  has_output_.wait(lock, [&] { return is_all_read_; });
  return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1, out_, err_};
}

namespace {

Ended run(const std::string& command, const std::string& out) {
  const std::string stem = outputStem();
  const std::string line = "cd '" ROBOSIM_SOURCE_DIR "' && " + command + " >'" + (out.empty() ? stem + ".out" : out) +
                           "' 2>'" + stem + ".err' </dev/null";
  return ended(std::system(line.c_str()), stem);
}

}  // namespace

Ended runProgram(const std::string& arguments, const std::string& out) {
  return run("'" ROBOSIM_PROGRAM "' " + arguments, out);
}

Ended runCommand(const std::string& command) { return run(command, ""); }

}  // namespace robosim
