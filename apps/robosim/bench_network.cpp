#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <iostream>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error_list.h"
#include "robosim/arguments.h"
#include "robosim/progress.h"
#include "robosim/subcommands.h"
#include "robosim/text.h"
#include "robosim/workloads.h"
#include "server/environment_server.h"

namespace robosim {
namespace {

using Clock = std::chrono::steady_clock;

/// As much as the figures of what gRPC can do at most were taken with: 790 bytes of readings.
constexpr Workload kLoad{
    "network", "16 sonars of one ray, and 30 infrared rays of 10 cm",
    "<sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>"
    "<infrared range_min_m='0' range_max_m='0.1'><ring count='30' radius_m='0.25' z_m='0.2'/></infrared>",
    46};

/// So many processes, with so many robots each.
struct Crowd {
  std::size_t processes = 0, robots_each = 0;
  double aim_steps_per_s = 0;  ///< 0 for none

  std::string text() const { return withCommas(processes) + " × " + withCommas(robots_each); }
};

constexpr Crowd kCrowds[] = {{1, 1, 10000}, {10, 1}, {100, 1, 300}, {1, 1000, 100}};

struct Arguments {
  std::vector<std::string> crowds;
  int windows = 5;
  double window_s = 1;
  std::string tls_cert, tls_key;  ///< empty: without TLS
  bool json = false;
};

/// `robosim robot` in a process of its own, which ends with this.
class RobotProcess {
 public:
  RobotProcess(const std::vector<std::string>& names, int port, const std::string& trusted_certificate) {
    std::vector<std::string> words{"robosim", "robot"};
    words.insert(words.end(), names.begin(), names.end());
    for (const auto& word : {"--environment", "", "--controller", "wander"}) words.emplace_back(word);
    words[words.size() - 3] = std::to_string(port);
    if (!trusted_certificate.empty()) words.insert(words.end(), {"--tls-ca", trusted_certificate});
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = posix_spawn(&id_, "/proc/self/exe", &quiet, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (error != 0) throw std::runtime_error("cannot start a process of robots: " + std::string(std::strerror(error)));
  }
  ~RobotProcess() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  RobotProcess(const RobotProcess&) = delete;
  RobotProcess& operator=(const RobotProcess&) = delete;

 private:
  pid_t id_ = 0;
};

/// Steps as fast as its robots answer, and takes the time of several windows after a first one that warms up.
class MeasuredRun final : public ServedRun {
 public:
  MeasuredRun(LoadedWorld world, const Arguments& arguments)
      : environment_(std::move(world.world), std::move(world.fleet), EnvironmentOptions{}),
        exhibit_(std::make_shared<Exhibit>(environment_, WorldSource{}, 1,
                                           std::vector<std::uint8_t>(environment_.robotCount(), 1))),
        arguments_(arguments) {}

  Environment& environment() override { return environment_; }
  std::shared_ptr<const Exhibit> exhibit() const override { return exhibit_; }
  void decide() override {
    if (environment_.time().step == 0) window_start_ = Clock::now();
  }
  void stepped(std::size_t /*late*/) override {
    ++steps_;
    const std::chrono::duration<double> passed = Clock::now() - window_start_;
    if (passed.count() < arguments_.window_s) return;
    if (is_warm_) steps_per_s_.push_back(static_cast<double>(steps_) / passed.count());
    is_warm_ = true;
    steps_ = 0;
    window_start_ = Clock::now();
  }
  bool isOver() const override { return static_cast<int>(steps_per_s_.size()) == arguments_.windows; }
  void load(const WorldSource&) override { throw ConfigError("a benchmark keeps its world"); }

  double medianStepsPerSecond() {
    const auto middle = steps_per_s_.begin() + static_cast<std::ptrdiff_t>(steps_per_s_.size() / 2);
    std::nth_element(steps_per_s_.begin(), middle, steps_per_s_.end());
    return *middle;
  }

 private:
  Environment environment_;
  std::shared_ptr<const Exhibit> exhibit_;
  const Arguments& arguments_;
  Clock::time_point window_start_;
  bool is_warm_ = false;
  std::uint64_t steps_ = 0;
  std::vector<double> steps_per_s_;
};

double measure(const Crowd& crowd, const Arguments& arguments) {
  const std::size_t robots = crowd.processes * crowd.robots_each;
  MeasuredRun run(makeWorldToRun(kLoad, robots, 1), arguments);
  ServerOptions options;
  options.listen = ListenAddresses::parse("127.0.0.1:0");
  options.step_deadline = std::chrono::minutes(1);
  if (!arguments.tls_cert.empty()) options.tls = TlsIdentity::read(arguments.tls_cert, arguments.tls_key);
  options.log = [](const std::string&) {};
  EnvironmentServer server(options, run.exhibit());
  std::vector<std::unique_ptr<RobotProcess>> processes;
  for (std::size_t p = 0; p < crowd.processes; ++p) {
    const auto first = run.exhibit()->robot_names.begin() + static_cast<std::ptrdiff_t>(p * crowd.robots_each);
    const std::vector<std::string> names(first, first + static_cast<std::ptrdiff_t>(crowd.robots_each));
    processes.push_back(std::make_unique<RobotProcess>(names, server.ports().front(), arguments.tls_cert));
  }
  server.serve(run, [] { return false; });
  return run.medianStepsPerSecond();
}

std::vector<Crowd> chosen(const Arguments& arguments) {
  std::vector<Crowd> crowds;
  for (const Crowd& crowd : kCrowds) {
    const std::string word = std::to_string(crowd.processes) + "x" + std::to_string(crowd.robots_each);
    const auto& wanted = arguments.crowds;
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), word) != wanted.end()) crowds.push_back(crowd);
  }
  return crowds;
}

void benchNetwork(const Arguments& arguments) {
  Rows rows{{"processes × robots", "steps/s", "to reach", "robot-steps/s"}};
  for (const Crowd& crowd : chosen(arguments)) {
    {
      Progress progress;
      if (progress.due()) progress.show(crowd.text() + " …");
    }
    const double steps_per_s = measure(crowd, arguments);
    const double robot_steps_per_s = steps_per_s * static_cast<double>(crowd.processes * crowd.robots_each);
    if (arguments.json) {
      std::cout << nlohmann::ordered_json{{"processes", crowd.processes},
                                          {"robots_each", crowd.robots_each},
                                          {"steps_per_s", steps_per_s},
                                          {"robot_steps_per_s", robot_steps_per_s}}
                       .dump()
                << std::endl;
      continue;
    }
    rows.push_back({crowd.text(), withCommas(static_cast<std::uint64_t>(steps_per_s)),
                    crowd.aim_steps_per_s > 0 ? withCommas(static_cast<std::uint64_t>(crowd.aim_steps_per_s)) : "–",
                    withCommas(static_cast<std::uint64_t>(robot_steps_per_s))});
  }
  if (!arguments.json) std::cout << table(rows);
}

}  // namespace

void addBenchNetwork(CLI::App& bench) {
  auto* command = bench.add_subcommand("network", "How many steps a second robots in other processes can follow");
  auto a = std::make_shared<Arguments>();
  std::vector<std::string> words;
  for (const Crowd& crowd : kCrowds) {
    words.push_back(std::to_string(crowd.processes) + "x" + std::to_string(crowd.robots_each));
  }
  command->add_option("--crowd", a->crowds, "processes x robots in each; may be given several times; all without")
      ->check(CLI::IsMember(words));
  command->add_option("--windows", a->windows, "how many times to measure each; the median is told")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--window", a->window_s, "seconds to measure for each time")
      ->check(numberIn(1e-6, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  auto* cert = command->add_option("--tls-cert", a->tls_cert, "measure with TLS: a certificate for 127.0.0.1")
                   ->type_name("FILE")
                   ->check(fileName());
  command->add_option("--tls-key", a->tls_key, "its key")->type_name("FILE")->check(fileName())->needs(cert);
  cert->needs("--tls-key");
  command->add_flag("--json", a->json, "print one JSON object a line");
  command->footer(
      "Each process is a 'robosim robot' on this machine, whose robots wander with 16 sonars and 30 infrareds.");
  command->callback([a] { benchNetwork(*a); });
}

}  // namespace robosim
