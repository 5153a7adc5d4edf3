#include "base/fork_processes.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace robosim {
namespace {

void endWith(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) std::_Exit(EXIT_FAILURE);  // the parent has already ended
}

bool endsWell(pid_t id) {
  int status = 0;
  while (waitpid(id, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
}

}  // namespace

std::optional<std::size_t> forkProcesses(std::size_t processes) {
  const pid_t self = getpid();
  std::vector<pid_t> ids;
  for (std::size_t i = 0; i < processes; ++i) {
    const pid_t id = fork();
    if (id < 0) throw std::runtime_error("cannot create a process: " + std::string(std::strerror(errno)));
    if (id == 0) {
      endWith(self);
      return i;
    }
    ids.push_back(id);
  }
  std::size_t failed = 0;
  for (const auto id : ids) {
    if (!endsWell(id)) ++failed;
  }
  if (failed > 0) {
    throw std::runtime_error(std::to_string(failed) + " of " + std::to_string(processes) + " processes failed");
  }
  return std::nullopt;
}

}  // namespace robosim
