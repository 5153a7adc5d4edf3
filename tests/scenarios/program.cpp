#include "tests/scenarios/program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
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

StartedProgram::StartedProgram(const std::string& program, const std::vector<std::string>& arguments)
    : process_(-1), stem_(outputStem()) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  process_ = fork();
  if (process_ != 0) return;
  const bool ready = chdir(ROBOSIM_SOURCE_DIR) == 0 && std::freopen((stem_ + ".out").c_str(), "w", stdout) &&
                     std::freopen((stem_ + ".err").c_str(), "w", stderr);
  if (ready) execv(program.c_str(), words.data());
  _exit(127);
}

StartedProgram::~StartedProgram() {
  if (!isRunning()) return;
  kill(process_, SIGKILL);
  waitpid(process_, &status_, 0);
}

bool StartedProgram::isRunning() {
  if (!ended_) ended_ = waitpid(process_, &status_, WNOHANG) != 0;
  return !ended_;
}

void StartedProgram::interrupt() { signal(SIGINT); }

void StartedProgram::signal(int number) {
  if (isRunning()) kill(process_, number);
}

std::string StartedProgram::output() const { return textOf(stem_ + ".out"); }
std::string StartedProgram::error() const { return textOf(stem_ + ".err"); }

void StartedProgram::waitFor(const char* stream, const std::string& text) {
  const auto is_there = [&] { return textOf(stem_ + stream).find(text) != std::string::npos; };
  while (!is_there()) {
    if (!isRunning() && !is_there()) {
      ADD_FAILURE() << "the program ended without saying '" << text << "'\n" << textOf(stem_ + stream) << error();
      return;
    }
    std::this_thread::yield();
  }
}

Ended StartedProgram::wait() {
  if (!ended_) waitpid(process_, &status_, 0);
  ended_ = true;
  return ended(status_, stem_);
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
