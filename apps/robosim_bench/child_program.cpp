#include "robosim_bench/child_program.h"

#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/program_folder.h"

namespace robosim {

ChildProgram::ChildProgram(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "robosim");
  std::vector<char*> argv;
  for (auto& word : arguments) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const auto robosim = programFolder() / "robosim";
  const int error = posix_spawn(&id_, robosim.c_str(), &quiet, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) throw std::runtime_error("cannot start " + robosim.string() + ": " + std::strerror(error));
}

ChildProgram::~ChildProgram() {
  if (hasEnded()) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

bool ChildProgram::hasEnded() { return has_ended_ = has_ended_ || waitpid(id_, nullptr, WNOHANG) == id_; }

double ChildProgram::cpuSeconds() {
  if (processes_.empty()) findProcesses();
  double sum_s = 0;
  for (const auto id : processes_) {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(id, &clock) != 0 || clock_gettime(clock, &time) != 0) continue;
    sum_s += static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  return sum_s;
}

void ChildProgram::findProcesses() {
  const std::string id = std::to_string(id_);
  std::ifstream made("/proc/" + id + "/task/" + id + "/children");
  processes_.assign(1, id_);
  for (pid_t child = 0; made >> child;) processes_.push_back(child);
}

}  // namespace robosim
