#include <algorithm>
#include <charconv>
#include <chrono>
#include <iostream>

#include <CLI/CLI.hpp>
#include <google/protobuf/stubs/logging.h>

#include "arcos/protocol/parameters.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "net/host_port.h"
#include "recording/recording_error.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/connection.h"
#include "robosim/foxglove_options.h"
#include "robosim/ros2_options.h"
#include "robosim/run_arguments.h"
#include "robosim/serve_arguments.h"
#include "robosim/subcommands.h"
#include "robosim/web_options.h"
#include "server/environment_server.h"
#include "serving/world_run.h"

namespace robosim {
namespace {

constexpr const char* kServeSession =
    "Example in three terminals:\n"
    "  robosim serve worlds/small_maze.xml --wait-for-robots --speed 10\n"
    "  robosim robot Pioneer1 Scout1\n"
    "  robosim control status --watch       (also: pause, step 10, start, speed 2, load FILE, record on, stop)\n"
    "From another machine: create a certificate and a token for each client,\n"
    "  openssl req -x509 -newkey rsa:2048 -nodes -keyout key.pem -out cert.pem -days 365 \\\n"
    "      -subj /CN=sim -addext subjectAltName=DNS:sim.example.org\n"
    "  (umask 077; echo \"$(openssl rand -hex 16) operator\" >tokens)\n"
    "  robosim serve WORLD --listen 0.0.0.0:3000 --tls-cert cert.pem --tls-key key.pem --tokens tokens\n"
    "and on the other machine, with cert.pem and the token in a file of mode 600:\n"
    "  robosim control sim.example.org:3000 status --tls-ca cert.pem --token-file token\n"
    "For programs of ARIA and others that speak ARCOS (doc/arcos.md), in real time:\n"
    "  robosim serve worlds/open_house.xml --arcos 8101 --arcos-all\n"
    "The command load of a control panel starts the next run; its output files are numbered: run_2.rawlog.\n"
    "Exit codes: 0 complete, also when a signal (Ctrl-C, SIGTERM, SIGHUP) has ended it; 3 steps were taken without a\n"
    "robot, or messages were lost; 4 a geometry worker returned wrong results; 1 bad input, 2 run failed. The "
    "summary,\n"
    "--json and the recording name robots and workers.\n";

/// ARCOS programs keep real time: their run does, too.
std::string resolvePace(const ServeArguments& arguments) {
  if (!arguments.pace.empty()) return arguments.pace;
  return arguments.arcos.empty() ? "lockstep" : "realtime";
}

/// Policy for lost robots. By default a lockstep run waits for them, and a real-time run continues.
OnLostRobot lostRobotPolicy(const ServeArguments& arguments) {
  if (arguments.on_lost_robot.empty()) {
    return resolvePace(arguments) == "realtime" ? OnLostRobot::continue_ : OnLostRobot::wait;
  }
  for (const auto policy : {OnLostRobot::wait, OnLostRobot::continue_}) {
    if (arguments.on_lost_robot == nameOf(policy)) return policy;
  }
  return OnLostRobot::fail;
}

EndedBy reasonOf(Served how, const WorldRun& run) {
  switch (how) {
    case Served::interrupted:
      return EndedBy::interrupt;
    case Served::robot_lost:
      return EndedBy::robot_lost;
    case Served::stopped:
      return EndedBy::control_panel;
    case Served::to_its_end:
      return run.endedByItself();
  }
  return EndedBy::interrupt;
}

ServerOptions serverOptions(const ServeArguments& arguments) {
  ServerOptions options;
  options.log = [](const std::string& line) { logInfo("serve", line); };
  options.listen = ListenAddresses::parse(arguments.listen);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access(options.log);
  if (!arguments.listener.unprotected) checkExposure(options.listen, options.tls.has_value(), !options.access.isOpen());
  options.step_deadline = std::chrono::milliseconds(std::llround(arguments.step_deadline_s * 1000));
  options.pace = resolvePace(arguments) == "realtime" ? Pace::realtime : Pace::lockstep;
  options.check_results = arguments.check_results;
  options.on_lost_robot = lostRobotPolicy(arguments);
  options.speed = speedNumber(arguments.of_run.speed);
  options.is_paused = arguments.paused;
  options.awaits_next_run = arguments.await_next_run;
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

constexpr double kUnlimited_s = 1e9;

/// The robots of --arcos-factory: "MODEL" or "MODEL:NUMBER".
struct Factory {
  std::string model;
  std::size_t most = 32;

  /// @throws ConfigError
  static Factory parse(const std::string& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    Factory factory{text.substr(0, colon)};
    if (colon == text.size()) return factory;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + colon + 1, end, factory.most);
    if (error != std::errc{} || stop != end || factory.most < 1 || factory.most > kAddedRobotsMax) {
      throw ConfigError("--arcos-factory " + text + ": must be a robot type, optionally with a number from 1 to " +
                        std::to_string(kAddedRobotsMax) + ", as in p3dx or p3dx:20");
    }
    return factory;
  }
};

/// Adds the first robot of a factory; the others are added for programs.
void addFactoryRobot(const std::string& factory, WorldChanges& changes) {
  if (changes.random_robots > 0) {
    throw ConfigError("--arcos-factory and --random-robots both add robots; use one of them");
  }
  changes.random_robots = 1;
  changes.random_model = Factory::parse(factory).model;
}

/// @throws ConfigError for options that do not fit
std::optional<ArcosOptions> arcosOptions(const ServeArguments& arguments) {
  if (arguments.arcos.empty()) {
    return std::nullopt;
  }
  if (resolvePace(arguments) != "realtime")
    throw ConfigError("--arcos needs --pace realtime: ARCOS programs keep real time");
  ArcosOptions options;
  options.listen = hostAndPort(arguments.arcos);
  if (!isLoopback(options.listen) && !arguments.arcos_unprotected) {
    throw ConfigError("--arcos " + arguments.arcos + ": other machines could drive the robots, because ARCOS has " +
                      "neither passwords nor encryption; use 127.0.0.1, or add --arcos-unprotected in a network that " +
                      "you trust");
  }
  const double steps_per_cycle = arcos::kCycle_s / arguments.of_run.run.environment.period_s;
  if (std::abs(steps_per_cycle - std::round(steps_per_cycle)) > 1e-6 || steps_per_cycle < 0.5) {
    throw ConfigError("--step must divide the cycle of ARCOS, 0.1 s, as 0.1, 0.05 and 0.02 do");
  }
  options.has_all = arguments.arcos_all;
  options.may_load_maps = arguments.arcos_maps;
  if (!arguments.arcos_factory.empty()) {
    const Factory factory = Factory::parse(arguments.arcos_factory);
    options.factory = factory.model;
    options.factory_most = factory.most;
  }
  const double speed = speedNumber(arguments.of_run.speed);
  options.speed = speed > 0 ? speed : 1;
  options.log = [](const std::string& line) { logInfo("serve", line); };
  return options;
}

/// @throws ConfigError for an address that is invalid, or exposed without protection
std::optional<FoxgloveOptions> foxgloveOptions(const ServeArguments& arguments, const ServerOptions& server) {
  if (arguments.foxglove.address.empty()) return std::nullopt;
  return FoxgloveOptions{
      foxgloveServer(arguments.foxglove, server.tls, server.access, arguments.listener.unprotected, server.log),
      server.pace == Pace::realtime};
}

std::optional<PageOptions> pageOptions(const ServeArguments& arguments, const ServerOptions& server) {
  if (arguments.web.empty()) return std::nullopt;
  return PageOptions{
      livePageServer(arguments.web, server.tls, server.access, arguments.listener.unprotected, server.log),
      server.pace == Pace::realtime};
}

}  // namespace

void serveWorld(const ServeArguments& arguments) {
  Interrupt interrupt;
  RunArguments of_run = arguments.of_run;
  if (!arguments.arcos_factory.empty()) addFactoryRobot(arguments.arcos_factory, of_run.changes);
  checkRunArguments(of_run);
  google::protobuf::SetLogHandler(nullptr);  // parse errors are logged by this program
  const ServerOptions options = serverOptions(arguments);
  const LiveOptions live{foxgloveOptions(arguments, options),
                         ros2Options(arguments.ros2, of_run.distribution, !options.access.isOpen(), options.log),
                         pageOptions(arguments, options), options.access, options.log};
  WorldRun run({of_run, arguments.wait_for_robots, options.pace == Pace::realtime, arcosOptions(arguments), live});
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
  run.finish(reasonOf(how, run));
  interrupt.ignoreUntilExit();
  if (!run.isTrusted()) throw Exit{kUntrusted};
  if (!run.hadAllRobots()) throw Exit{kIncomplete};
}

void addArcosOptions(CLI::App& command, ServeArguments& arguments) {
  const CLI::Option* arcos =
      command
          .add_option("--arcos", arguments.arcos,
                      "serve robots to programs that speak ARCOS, such as those of ARIA: each robot without a "
                      "controller whose type has <arcos>, the first on this port, the others on the ports that follow")
          ->type_name("[HOST:]PORT");
  dependsOn(command
                .add_option("--arcos-factory", arguments.arcos_factory,
                            "serve ARCOS programs on one port: for each, a robot of this type comes to a random free "
                            "place, and leaves with the program. NUMBER: the most at once, by default 32")
                ->type_name("TYPE[:NUMBER]"),
            arcos);
  dependsOn(command.add_flag("--arcos-all", arguments.arcos_all,
                             "serve robots with a controller, in the world or by --controller, to ARCOS programs, too"),
            arcos);
  dependsOn(command.add_flag("--arcos-unprotected", arguments.arcos_unprotected,
                             "allow ARCOS programs from other machines, without passwords or encryption"),
            arcos);
  setGroup(command, kArcosGroup, {"--arcos", "--arcos-factory", "--arcos-all", "--arcos-unprotected"});
}

void addServe(CLI::App& program) {
  auto* command = addSubcommand(program, "serve");
  auto a = std::make_shared<ServeArguments>();
  addRunArguments(*command, a->of_run);
  dependsOn(command
                ->add_flag("--record-on-request", a->of_run.is_recorded_on_request,
                           "the recording is off until a control panel starts it (robosim control record on), or an "
                           "operator on the page of robosim remote")
                ->group(kRecordingGroup),
            command->get_option("--record"));
  command->add_flag("--wait-for-robots", a->wait_for_robots,
                    "wait for a robot process for every robot, including those with a controller in the world");
  command->add_option("--listen", a->listen, "host:port, or viewers=…,robots=…,geometry=…,control=…")
      ->type_name("ADDRESS")
      ->capture_default_str();
  command
      ->add_option("--pace", a->pace,
                   "lockstep: a step waits for every robot; realtime: a late robot keeps its last command. Default: "
                   "lockstep, or realtime with --arcos")
      ->check(CLI::IsMember({"lockstep", "realtime"}));
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
  command->add_flag("--await-next-run", a->await_next_run,
                    "after the end of a run, keep serving until a control panel loads the next world or sends stop");
  command->add_flag("--health", a->standard_services.health,
                    "answer gRPC's health checks on every port, for every client, without a token");
  command->add_flag("--reflection", a->standard_services.reflection,
                    "describe the protocol to gRPC tools on every port, for every client, without a token");
  setGroup(*command, kClientsGroup,
           {"--wait-for-robots", "--listen", "--pace", "--step-deadline", "--on-lost-robot", "--check-results",
            "--paused", "--await-next-run", "--health", "--reflection"});
  addArcosOptions(*command, *a);
  addFoxgloveOptions(*command, a->foxglove,
                     "serve the topics of ROS 2 to Foxglove and Lichtblick, which may also drive robots, and pause the "
                     "run (doc/ros2.md); usually 8765. Uses --tls-cert and --tokens",
                     kClientsGroup);
  addWebOption(*command, a->web,
               "show the run live on a page in browsers, to up to 256 viewers, with its paths so far; supervisors "
               "drag robots and objects there (doc/run_page.md); usually 8081. Uses --tls-cert and --tokens",
               kClientsGroup);
  addRos2Options(*command, a->ros2, kRos2Group, true);
  addListenerOptions(*command, a->listener);
  command->footer([] { return std::string(kServeSession) + "\n" + controllersHelp(); });
  command->callback([a, command] {
    // Programs drive for as long as they wish.
    if (!a->arcos.empty() && command->count("--time") == 0) a->of_run.time_s = kUnlimited_s;
    serveWorld(*a);
  });
}

}  // namespace robosim
