#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>
#include <google/protobuf/stubs/logging.h>

#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "net/host_port.h"
#include "recording/recording_error.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/run_arguments.h"
#include "robosim/subcommands.h"
#include "robots/world_source.h"
#include "run/run_outputs.h"
#include "server/environment_server.h"

namespace robosim {
namespace {

constexpr const char* kServeSession =
    "Example in three terminals:\n"
    "  robosim serve worlds/small_maze.xml --wait-for-robots --speed 10\n"
    "  robosim robot Pioneer1 Scout1\n"
    "  robosim control status --watch       (also: pause, step 10, start, speed 2, load FILE, stop)\n"
    "From another machine: create a certificate and a token for each client,\n"
    "  openssl req -x509 -newkey rsa:2048 -nodes -keyout key.pem -out cert.pem -days 365 \\\n"
    "      -subj /CN=sim -addext subjectAltName=DNS:sim.example.org\n"
    "  (umask 077; echo \"$(openssl rand -hex 16) operator\" >tokens)\n"
    "  robosim serve WORLD --listen 0.0.0.0:3000 --tls-cert cert.pem --tls-key key.pem --tokens tokens\n"
    "and on the other machine, with cert.pem and the token in a file of mode 600:\n"
    "  robosim control sim.example.org:3000 status --tls-ca cert.pem --token-file token\n"
    "The command load of a control panel starts the next run; its output files are numbered: run_2.rawlog.\n"
    "Exit codes: 0 complete, also when a signal (Ctrl-C, SIGTERM, SIGHUP) has ended it; 3 steps were taken without a\n"
    "robot, or messages were lost; 4 a geometry worker returned wrong results; 1 bad input, 2 run failed. The "
    "summary,\n"
    "--json and the recording name robots and workers.\n";

struct ServeArguments {
  RunArguments of_run;
  bool wait_for_robots = false;
  std::string listen = kDefaultListen;
  std::string pace = "lockstep";
  double check_results = 0.01;
  std::string on_lost_robot;  ///< empty: default according to the pace
  double step_deadline_s = 1;
  bool paused = false;
  StandardServices standard_services;
  ListenerArguments listener;
};

/// Robots driven by other processes: all, if the environment waits for them; otherwise those without a controller.
std::vector<std::uint8_t> networkedRobots(const Fleet& fleet, const ServeArguments& arguments) {
  std::vector<std::uint8_t> networked;
  for (const auto& robot : fleet.robots) {
    const bool has_controller = !arguments.of_run.run.controller.empty() || !robot.controller.empty();
    networked.push_back(arguments.wait_for_robots || !has_controller);
  }
  return networked;
}

/// "run.rawlog" → "run_2.rawlog" for the second run; an empty name stays empty.
std::string numbered(const std::string& file, int number) {
  if (file.empty() || number == 1) return file;
  const std::filesystem::path path(file);
  return (path.parent_path() / (path.stem().string() + "_" + std::to_string(number) + path.extension().string()))
      .string();
}

/// Policy for lost robots. By default a lockstep run waits for them, and a real-time run continues.
OnLostRobot lostRobotPolicy(const ServeArguments& arguments) {
  if (arguments.on_lost_robot.empty()) {
    return arguments.pace == "realtime" ? OnLostRobot::continue_ : OnLostRobot::wait;
  }
  for (const auto policy : {OnLostRobot::wait, OnLostRobot::continue_}) {
    if (arguments.on_lost_robot == nameOf(policy)) return policy;
  }
  return OnLostRobot::fail;
}

/// One run of one world with its controllers, its outputs, and its ServedRun.
struct WorldRunState {
  RunArguments arguments;
  std::vector<std::uint8_t> networked;
  LocalRun run;
  RunInfo run_info;
  RunOutputs outputs;
  RunReport report;
  std::optional<std::uint64_t> late;  ///< robot-steps whose command came too late; real-time pace only
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

  WorldRunState(LoadedWorld world, const WorldSource& source, const ServeArguments& a, RunArguments of_this_run)
      : arguments(std::move(of_this_run)),
        networked(networkedRobots(world.fleet, a)),
        run(std::move(world), arguments.run, networked),
        run_info(run.environment(), source, arguments.run.environment.seed, networked),
        outputs(arguments, run.environment(), noteOf(source, run, arguments.run, networked)) {
    outputs.observe(run.environment());
    if (a.pace == "realtime") late = 0;
  }

  void finish(EndedBy ended_by) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    outputs.finish(run, wall.count(), ended_by, late, report);
  }
};

class PreparedWorldRun final : public PreparedRun {
 public:
  explicit PreparedWorldRun(std::shared_ptr<WorldRunState> s) : state(std::move(s)) {}
  std::shared_ptr<WorldRunState> state;
};

/// The sequence of runs of one program: loading another world from a control panel starts the next run. Each has
/// separate outputs.
class WorldRun final : public ServedRun {
 public:
  explicit WorldRun(const ServeArguments& arguments) : arguments_(arguments) {
    state_ = createState(sourceOf(arguments.of_run), 1);
  }

  Environment& environment() override { return state_->run.environment(); }
  /// Shared with viewers, which keep the run alive.
  std::shared_ptr<const RunInfo> runInfo() const override { return {state_, &state_->run_info}; }
  void decide() override { state_->run.decide(); }
  void stepped(std::size_t late) override {
    if (state_->late) *state_->late += late;
    state_->run.noteOutcome();
    state_->outputs.observe(state_->run.environment());
  }
  bool isOver() const override {
    return state_->run.gold().all_halted_s.has_value() || arguments_.of_run.timeIsUp(state_->run.environment().time());
  }
  void ends(const RunReport& report) override {
    state_->report = report;
    all_robots_ = all_robots_ && report.hasAllRobots();
    is_trusted_ = is_trusted_ && report.isTrusted();
  }
  std::unique_ptr<PreparedRun> prepare(const WorldSource& source) const override {
    try {
      return std::make_unique<PreparedWorldRun>(createState(source, number_ + 1));
    } catch (const RecordingError& error) {  // of the next run; the current run continues
      throw ConfigError(error.what());
    }
  }
  void replace(std::unique_ptr<PreparedRun> next) override {
    state_->finish(EndedBy::control_panel);
    state_ = static_cast<PreparedWorldRun&>(*next).state;
    state_->start = std::chrono::steady_clock::now();
    ++number_;
  }

  void keep() { state_->outputs.keep(state_->run.environment()); }
  void finish(Served how) {
    state_->finish(how == Served::interrupted                    ? EndedBy::interrupt
                   : how == Served::robot_lost                   ? EndedBy::robot_lost
                   : how == Served::stopped                      ? EndedBy::control_panel
                   : state_->run.gold().all_halted_s.has_value() ? EndedBy::all_halted
                                                                 : EndedBy::time_limit);
  }
  /// @throws Exit when a run of this program was incomplete or untrusted.
  void throwIfIncomplete() const {
    if (!is_trusted_) throw Exit{kUntrusted};
    if (!all_robots_) throw Exit{kIncomplete};
  }

 private:
  std::shared_ptr<WorldRunState> createState(const WorldSource& source, int number) const {
    RunArguments of_this_run = arguments_.of_run;
    of_this_run.world = source.file;
    of_this_run.record = numbered(of_this_run.record, number);
    of_this_run.picture = numbered(of_this_run.picture, number);
    LoadedWorld world = loadWorldToRun(source, of_this_run.run.controller);
    return std::make_shared<WorldRunState>(std::move(world), source, arguments_, std::move(of_this_run));
  }

  const ServeArguments& arguments_;
  std::shared_ptr<WorldRunState> state_;
  int number_ = 1;
  bool all_robots_ = true;  ///< in all runs so far
  bool is_trusted_ = true;
};

ServerOptions serverOptions(const ServeArguments& arguments) {
  ServerOptions options;
  options.log = [](const std::string& line) { logInfo("serve", line); };
  options.listen = ListenAddresses::parse(arguments.listen);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access(options.log);
  if (!arguments.listener.unprotected) checkExposure(options.listen, options.tls.has_value(), !options.access.isOpen());
  options.step_deadline = std::chrono::milliseconds(std::llround(arguments.step_deadline_s * 1000));
  options.pace = arguments.pace == "realtime" ? Pace::realtime : Pace::lockstep;
  options.check_results = arguments.check_results;
  options.on_lost_robot = lostRobotPolicy(arguments);
  options.speed = speedNumber(arguments.of_run.speed);
  options.is_paused = arguments.paused;
  options.standard_services = arguments.standard_services;
  return options;
}

/// Logs the listening addresses, for scripts and for ports chosen by the system.
void logPorts(const ServerOptions& options, const std::array<int, 4>& ports) {
  constexpr const char* clients[] = {"viewers", "robots", "geometry workers", "control panels"};
  const auto addresses = options.listen.all();
  const auto at = [&](std::size_t i) { return withPort(addresses[i], ports[i]); };
  std::string line = "listening on " + at(0);
  if (std::count(addresses.begin(), addresses.end(), addresses[0]) < 4) {
    line = "listening";
    for (std::size_t i = 0; i < 4; ++i) line += (i == 0 ? " for " : ", for ") + (clients[i] + (" on " + at(i)));
  }
  logInfo("serve", line);
}

void serveWorld(const ServeArguments& arguments) {
  const Interrupt interrupt;
  checkRunArguments(arguments.of_run);
  google::protobuf::SetLogHandler(nullptr);  // parse errors are logged by this program
  const ServerOptions options = serverOptions(arguments);
  WorldRun run(arguments);
  EnvironmentServer server(options, run.runInfo());
  logPorts(options, server.ports());
  Served how = Served::interrupted;
  try {
    how = server.serve(run, [&] { return interrupt.isRequested(); });
  } catch (const RecordingError&) {
    throw;
  } catch (...) {
    run.keep();
    throw;
  }
  run.finish(how);
  run.throwIfIncomplete();
}

}  // namespace

void addServe(CLI::App& program) {
  auto* command = addSubcommand(program, "serve");
  auto a = std::make_shared<ServeArguments>();
  addRunArguments(*command, a->of_run);
  command->add_flag("--wait-for-robots", a->wait_for_robots,
                    "wait for a robot process for every robot, including those with a controller in the world");
  command->add_option("--listen", a->listen, "host:port, or viewers=…,robots=…,geometry=…,control=…")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command
      ->add_option("--pace", a->pace,
                   "lockstep: a step waits for every robot; realtime: a late robot keeps its last command")
      ->check(CLI::IsMember({"lockstep", "realtime"}))
      ->capture_default_str();
  command
      ->add_option("--step-deadline", a->step_deadline_s,
                   "how long a step waits for a robot before its connection is closed")
      ->check(numberIn(0.001, 3600))
      ->type_name("SECONDS")
      ->capture_default_str();
  command
      ->add_option("--on-lost-robot", a->on_lost_robot,
                   "when a robot process ends before its robot has halted: wait until a process drives it again; "
                   "continue without it; or fail, which ends the run. Default: wait in lockstep, continue in real time")
      ->check(CLI::IsMember({"wait", "continue", "fail"}));
  command
      ->add_option("--check-results", a->check_results,
                   "share of each geometry worker's results that is recomputed to check them; at least one robot per "
                   "step")
      ->check(numberIn(0, 1))
      ->type_name("FRACTION")
      ->capture_default_str();
  command->add_flag("--paused", a->paused, "start paused, until a control panel sends start");
  command->add_flag("--health", a->standard_services.health,
                    "answer gRPC's health checks on every port, for every client, without a token");
  command->add_flag("--reflection", a->standard_services.reflection,
                    "describe the protocol to gRPC tools on every port, for every client, without a token");
  addListenerOptions(*command, a->listener);
  command->footer([] { return std::string(kServeSession) + "\n" + controllersHelp(); });
  command->callback([a] { serveWorld(*a); });
}

}  // namespace robosim
