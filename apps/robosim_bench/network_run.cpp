#include "robosim_bench/network_run.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include <unistd.h>

#include "base/error_list.h"
#include "robosim_bench/child_program.h"
#include "robosim_bench/rounds.h"
#include "robosim_bench/workloads.h"
#include "server/environment_server.h"

namespace robosim {
namespace {

/// Size of the readings used when the maximum throughput of gRPC was measured: 790 bytes.
const Workload kLoad{
    "network", "16 sonars of one ray, and 30 infrared rays of 10 cm",
    "<sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>"
    "<infrared range_min_m='0' range_max_m='0.1'><ring count='30' radius_m='0.25' z_m='0.2'/></infrared>",
    46};

/// Arguments of child processes that drive robots. @param separate_processes one process per robot
std::vector<std::string> robotArguments(const std::vector<std::string>& names, int port,
                                        const std::string& trusted_certificate, bool separate_processes) {
  std::vector<std::string> arguments{"robot"};
  if (separate_processes) arguments.emplace_back("--separate-processes");
  arguments.insert(arguments.end(), names.begin(), names.end());
  arguments.insert(arguments.end(), {"--environment", std::to_string(port), "--controller", "wander"});
  if (!trusted_certificate.empty()) arguments.insert(arguments.end(), {"--tls-ca", trusted_certificate});
  return arguments;
}

/// Runs in lockstep at maximum speed; measures several windows after one for warm-up.
class MeasuredRun final : public ServedRun {
 public:
  explicit MeasuredRun(const NetworkBench& bench)
      : MeasuredRun(bench, makeWorldToRun(kLoad, bench.layout.processes * bench.layout.robots_each, 1)) {}

  /// Connects the robot processes to this environment.
  void invite(int port) {
    const bool separate_processes =
        bench_.layout.processes > 1 && bench_.layout.robots_each == 1 && !bench_.separate_programs;
    const auto& names = run_info_->robot_names;
    const auto each = static_cast<std::ptrdiff_t>(separate_processes ? names.size() : bench_.layout.robots_each);
    for (auto name = names.begin(); name != names.end(); name += each) {
      programs_.push_back(std::make_unique<ChildProgram>(
          robotArguments(std::vector(name, name + each), port, bench_.tls_cert, separate_processes)));
    }
  }

  bool hasLostProgram() const {
    return std::any_of(programs_.begin(), programs_.end(), [](const auto& program) { return program->hasEnded(); });
  }

  Environment& environment() override { return environment_; }
  std::shared_ptr<const RunInfo> runInfo() const override { return run_info_; }
  void decide() override {
    if (environment_.time().step == 0) window_start_ = now();
  }
  void stepped(std::size_t /*late*/) override {
    ++steps_;
    if (Clocks::now().wall_s - window_start_.own.wall_s < bench_.window_s) return;
    const Times end = now();
    if (is_warm_) note(end);
    is_warm_ = true;
    steps_ = 0;
    window_start_ = now();
  }
  bool isOver() const override { return static_cast<int>(steps_per_s_.size()) == bench_.windows; }
  void ends(const RunReport&) override {}
  std::unique_ptr<PreparedRun> prepare(const WorldSource&) const override {
    throw ConfigError("a benchmark cannot load another world");
  }
  void replace(std::unique_ptr<PreparedRun>) override {}

  NetworkFigures figures() const { return {median(steps_per_s_), median(environment_cpu_us_), median(robots_cpu_us_)}; }

 private:
  struct Times {
    Clocks own;
    double robots_cpu_s = 0;
  };

  MeasuredRun(const NetworkBench& bench, LoadedWorld world)
      : bench_(bench),
        environment_(std::move(world.world), std::move(world.fleet), EnvironmentOptions{}),
        run_info_(std::make_shared<RunInfo>(environment_, WorldSource{}, 1,
                                            std::vector<std::uint8_t>(environment_.robotCount(), 1))) {}

  Times now() const {
    Times times{Clocks::now()};
    for (const auto& program : programs_) times.robots_cpu_s += program->cpuSeconds();
    return times;
  }

  void note(const Times& end) {
    const double us_each = 1e6 / static_cast<double>(steps_ * bench_.layout.processes);
    steps_per_s_.push_back(static_cast<double>(steps_) / (end.own.wall_s - window_start_.own.wall_s));
    environment_cpu_us_.push_back((end.own.cpu_s - window_start_.own.cpu_s) * us_each);
    robots_cpu_us_.push_back((end.robots_cpu_s - window_start_.robots_cpu_s) * us_each);
  }

  const NetworkBench& bench_;
  Environment environment_;
  std::shared_ptr<const RunInfo> run_info_;
  std::vector<std::unique_ptr<ChildProgram>> programs_;
  Times window_start_;
  bool is_warm_ = false;
  std::uint64_t steps_ = 0;
  std::vector<double> steps_per_s_, environment_cpu_us_, robots_cpu_us_;
};

}  // namespace

NetworkFigures measureNetwork(const NetworkBench& bench) {
  MeasuredRun run(bench);
  ServerOptions options;
  options.listen = ListenAddresses::parse("127.0.0.1:0");
  options.step_deadline = std::chrono::minutes(1);
  if (!bench.tls_cert.empty()) options.tls = TlsIdentity::read(bench.tls_cert, bench.tls_key);
  options.log = [](const std::string&) {};
  EnvironmentServer server(options, run.runInfo());
  run.invite(server.ports().front());
  server.serve(run, [&] { return run.hasLostProgram(); });
  if (!run.isOver()) throw std::runtime_error("a robot process has ended; its error is above");
  return run.figures();
}

}  // namespace robosim
