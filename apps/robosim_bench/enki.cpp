#include "robosim_bench/enki.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/program_folder.h"
#include "robosim_bench/workloads.h"
#include "run/local_run.h"

namespace robosim {
namespace {

constexpr const char* kProgram = "robosim_enki";

std::filesystem::path enkiProgram() { return programFolder() / kProgram; }

/// The child process `robosim_enki`, with pipes for commands and answers (enki_peer.cpp).
class EnkiProcess {
 public:
  EnkiProcess() {
    int commands[2];
    int answers[2];
    if (pipe2(commands, O_CLOEXEC) != 0) throw failed();
    if (pipe2(answers, O_CLOEXEC) != 0) {
      closeBoth(commands);
      throw failed();
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, commands[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, answers[1], STDOUT_FILENO);
    const std::string program = enkiProgram().string();
    std::string name = kProgram;
    char* const argv[] = {name.data(), nullptr};
    const int error = posix_spawn(&id_, program.c_str(), &actions, nullptr, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(commands[0]);
    close(answers[1]);
    commands_ = commands[1];
    answers_ = answers[0];
    if (error != 0) {
      errno = error;
      id_ = 0;
      closePipes();
      throw failed();
    }
  }
  ~EnkiProcess() {
    closePipes();  // the process ends at the end of its standard input
    waitpid(id_, nullptr, 0);
  }
  EnkiProcess(const EnkiProcess&) = delete;
  EnkiProcess& operator=(const EnkiProcess&) = delete;

  void send(const std::string& commands) const {
    for (std::size_t written = 0; written < commands.size();) {
      const ssize_t now = write(commands_, commands.data() + written, commands.size() - written);
      if (now <= 0) throw failed();
      written += static_cast<std::size_t>(now);
    }
  }
  std::string ask(const std::string& command) const {
    send(command + '\n');
    std::string answer;
    for (char c = 0; c != '\n'; answer += c) {
      if (read(answers_, &c, 1) != 1) throw failed();
    }
    return answer;
  }

 private:
  static std::runtime_error failed() {
    return std::runtime_error(std::string(kProgram) +
                              ", the program with Enki, cannot be started: " + std::strerror(errno));
  }
  static void closeBoth(const int (&pipe)[2]) {
    close(pipe[0]);
    close(pipe[1]);
  }
  void closePipes() const {
    close(commands_);
    close(answers_);
  }

  pid_t id_ = 0;
  int commands_ = -1;
  int answers_ = -1;
};

/// The workload's world as commands. Enki's world is a rectangle from (0, 0) with built-in walls; the wall objects of
/// RoboSim's world are omitted.
std::string commandsFor(const World& world, const Workload& workload, double radius_m, double speed_max_mps) {
  constexpr std::size_t kWalls = 4;  // the world's first objects, one per side, of thickness `scale` [m]
  const double half_m = world.bounds.x_max - workload.scale;
  std::ostringstream out;
  out.precision(17);
  out << "world " << 2 * half_m << ' ' << 2 * half_m << '\n';
  for (std::size_t i = kWalls; i < world.objects.size(); ++i) {
    const Body& body = world.objects[i].body;
    const auto& pose = body.world_from_body;
    if (const auto* circle = std::get_if<Cylinder>(&body.shape)) {
      out << "circle " << pose.x + half_m << ' ' << pose.y + half_m << ' ' << circle->radius_m << '\n';
    } else {
      const auto& box = std::get<Cube>(body.shape);
      out << "box " << pose.x + half_m << ' ' << pose.y + half_m << ' ' << pose.phi << ' ' << box.length_m << ' '
          << box.width_m << '\n';
    }
  }
  out << "robots " << radius_m << ' ' << speed_max_mps << '\n';
  for (const auto& robot : world.robots) {
    const auto& pose = robot.world_from_robot;
    out << "robot " << pose.x + half_m << ' ' << pose.y + half_m << ' ' << pose.phi << '\n';
  }
  return out.str();
}

EnkiFigures compare(std::size_t robots, std::uint64_t seed, double min_s) {
  const Workload& infrared = workloadNamed("infrared");
  LoadedWorld made = makeWorldToRun(infrared, robots, seed);
  const auto& model = *made.fleet.robots.front().model;
  const EnkiProcess enki;
  enki.send(commandsFor(made.world, infrared, model.radius_m, model.type->limits.speed_max_mps));
  LocalRun run(std::move(made), {.environment = {.seed = seed, .period_s = 0.1, .threads = 1}, .controller = ""});

  constexpr int kWarmUpSteps = 20;
  for (int i = 0; i < kWarmUpSteps; ++i) run.step();
  Clocks enki_clocks;
  const auto enki_steps = [&](int steps) {
    std::istringstream answer(enki.ask("step " + std::to_string(steps)));
    answer >> enki_clocks.cpu_s >> enki_clocks.wall_s;
  };
  enki_steps(kWarmUpSteps);

  const auto units = static_cast<double>(robots);
  const Contender contenders[] = {{.work =
                                       [&] {
                                         run.step();
                                         return units;
                                       }},
                                  {.work =
                                       [&] {
                                         enki_steps(1);
                                         return units;
                                       },
                                   .clocks = [&] { return enki_clocks; }}};
  const auto costs = measureAlternately(contenders, min_s);
  return {robots, costs[0], costs[1]};
}

}  // namespace

EnkiBench benchEnki(const std::vector<std::size_t>& robots, std::uint64_t seed, double min_s) {
  EnkiBench bench;
  if (!std::filesystem::exists(enkiProgram())) {
    bench.why_no_peer = "RoboSim was built without Enki; install libenki-dev and rebuild";
    return bench;
  }
  for (const auto number : robots) {
    if (number <= kMaxBesideEnki) bench.figures.push_back(compare(number, seed, min_s));
  }
  return bench;
}

}  // namespace robosim
