#include "robosim_bench/process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include <nlohmann/json.hpp>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/interrupt.h"
#include "robosim_bench/rounds.h"

namespace robosim {
namespace {

[[noreturn]] void writeResult(int pipe, const nlohmann::json& answer) {
  const std::string text = answer.dump();
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t n = write(pipe, text.data() + sent, text.size() - sent);
    if (n < 0 && errno != EINTR) break;
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  // _Exit() rather than exit(): the buffered standard output belongs to the parent.
  _exit(0);
}

std::string readAll(int pipe) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t n = read(pipe, buffer, sizeof buffer);
    if (n == 0 || (n < 0 && errno != EINTR)) return text;
    if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace

Memory Memory::now() {
  std::ifstream statm("/proc/self/statm");
  double pages_mapped = 0;
  double pages_resident = 0;
  statm >> pages_mapped >> pages_resident;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {pages_resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024 * 1024),
          static_cast<double>(usage.ru_maxrss) / 1024};
}

OtherLoad::OtherLoad() : start_s_(Clocks::now().wall_s), others_s_(othersTime()) {}

double OtherLoad::processors() const {
  return std::max(0.0, othersTime() - others_s_) / std::max(1e-9, Clocks::now().wall_s - start_s_);
}

long OtherLoad::ofProcessors() { return sysconf(_SC_NPROCESSORS_ONLN); }

/// CPU time of all programs less that of this process and its finished children [s].
double OtherLoad::othersTime() {
  std::ifstream stat("/proc/stat");
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, interrupts = 0, soft_interrupts = 0;
  stat >> name >> user >> nice >> system >> idle >> waiting >> interrupts >> soft_interrupts;
  double others_s = (user + nice + system + interrupts + soft_interrupts) / static_cast<double>(sysconf(_SC_CLK_TCK));
  for (const auto scope : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(scope, &usage);
    for (const auto& t : {usage.ru_utime, usage.ru_stime}) {
      others_s -= static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    }
  }
  return others_s;
}

nlohmann::json runInChildProcess(const std::function<nlohmann::json()>& measure) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error(std::string("cannot create a pipe: ") + std::strerror(errno));
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("cannot create a process: ") + std::strerror(errno));
  if (child == 0) {
    // Ctrl-C ends the child at once; the parent then cleans up.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // end with the parent
    close(ends[0]);
    try {
      writeResult(ends[1], {{"figures", measure()}});
    } catch (const std::exception& error) {
      writeResult(ends[1], {{"error", error.what()}});
    }
  }
  close(ends[1]);
  const std::string text = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGINT || WTERMSIG(status) == SIGTERM)) {
    throw Interrupted(kInterrupted);
  }
  const auto answer = nlohmann::json::parse(text, nullptr, false);
  if (answer.is_discarded()) {
    throw std::runtime_error(
        "the measuring process crashed" +
        (WIFSIGNALED(status) ? " with signal " + std::to_string(WTERMSIG(status)) : std::string()) +
        "; check whether there is enough memory");
  }
  if (answer.contains("error")) throw std::runtime_error(answer["error"].get<std::string>());
  return answer["figures"];
}

}  // namespace robosim
