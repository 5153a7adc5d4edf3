#include <iostream>

#include <CLI/CLI.hpp>
#include <google/protobuf/stubs/logging.h>

#include "base/fork_processes.h"
#include "base/log.h"
#include "base/seconds.h"
#include "client/network_hardware.h"
#include "control/controller_error.h"
#include "net/host_port.h"
#include "net/listen.h"
#include "net/reconnector.h"
#include "net/tls.h"
#include "remote/remote_port.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/connection.h"
#include "robosim/real_robot.h"
#include "robosim/robot_arguments.h"
#include "robosim/subcommands.h"
#include "run/known_world.h"
#include "run/local_run.h"

namespace robosim {

void logRobot(const std::string& line) { logInfo("robot", line); }

RemotePort::Options portOptions(const RobotArguments& arguments) {
  RemotePort::Options options;
  options.listen = hostAndPort(arguments.remote_port);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access(logRobot);
  if (!arguments.listener.unprotected) {
    checkExposure("--remote-port", options.listen, options.tls.has_value(), !options.access.isOpen());
  }
  options.log = logRobot;
  return options;
}

RemoteControlRobot::Options remoteOptions(const RobotArguments& arguments) {
  RemoteControlRobot::Options options;
  options.dead_man = fromSeconds(arguments.dead_man_s);
  options.log = logRobot;
  return options;
}

namespace {

struct DrivenRobot {
  Robot robot;
  std::string controller_name;
  std::unique_ptr<Controller> controller;

  void step() {
    guarded(controller_name, robot.name(), [this] { controller->step(robot); });
  }
};

struct RemotelyDrivenRobot {
  std::string controller_name;
  std::unique_ptr<RemoteControlRobot> robot;

  void step() {
    guarded(controller_name, robot->name(), [this] { robot->step(); });
  }
};

/// The robots of this process with their controllers and, with --remote-port, remote control.
class RobotProcess {
 public:
  explicit RobotProcess(const RobotArguments& arguments)
      : port_options_(arguments.remote_port.empty() ? RemotePort::Options{} : portOptions(arguments)),
        robots_(arguments.connection.awaitServer(arguments.connection.connectOptions(arguments.reconnect_timeout_s),
                                                 "robot"),
                arguments.names) {
    std::shared_ptr<const KnownWorld> known_world;
    if (!arguments.map.empty()) {
      const LoadedWorld loaded = loadWorld(arguments.map, {}, robots_.seed());
      known_world = makeKnownWorld(loaded.world, loaded.fleet);
    }
    for (std::size_t i = 0; i < arguments.names.size(); ++i) {
      const ControllerSetup setup{robots_.seed(), static_cast<std::uint32_t>(robots_.place(i)),
                                  robots_.worldFromStart(i), known_world};
      const std::string name = controllerOf(robots_.controller(i), arguments.controller);
      auto controller = makeController(name, setup, arguments.names[i]);
      reads_pictures_.push_back(needsPictures(name));
      if (arguments.remote_port.empty()) {
        driven_robots_.push_back({Robot(robots_.robot(i)), name, std::move(controller)});
      } else {
        remote_robots_.push_back({name, std::make_unique<RemoteControlRobot>(robots_.robot(i), std::move(controller),
                                                                             remoteOptions(arguments))});
      }
    }
    if (!arguments.remote_port.empty()) openPort();
  }

  void drive() {
    if (robots_.hasAnswered() && !robots_.nextStep()) return;
    do {
      for (auto& driven : driven_robots_) driven.step();
      for (auto& remote : remote_robots_) remote.step();
      if (port_) port_->publish(&robots_.received());
      requestPictures();
    } while (robots_.nextStep());
  }
  void rejoin() { robots_.rejoin(); }
  /// Address of the port for remote control; empty without one.
  std::string remoteAddress() const { return port_ ? withPort(port_options_.listen, port_->port()) : ""; }
  std::size_t unconfirmedMessages() const { return robots_.unconfirmedMessages(); }
  std::uint64_t stepNumber() { return robots_.robot(0).readings().time.step; }

 private:
  /// Pictures are rendered and sent only for a controller that requires a camera, and for a remote control that shows
  /// them.
  void requestPictures() {
    for (std::size_t i = 0; i < reads_pictures_.size(); ++i) {
      robots_.setPictures(i, reads_pictures_[i] || (port_ && port_->isWatched(i)));
    }
  }
  void openPort() {
    std::vector<RemoteControlRobot*> robots;
    for (auto& remote : remote_robots_) robots.push_back(remote.robot.get());
    port_ = std::make_unique<RemotePort>(
        port_options_, RemotePort::Run{robots_.world(), robots_.seed(), robots_.robot(0).readings().time.period_s},
        robots);
    logRobot("remote control on " + withPort(port_options_.listen, port_->port()));
  }

  RemotePort::Options port_options_;
  NetworkHardware robots_;
  std::vector<std::uint8_t> reads_pictures_;  ///< by robot: whether its controller requires a camera
  std::vector<DrivenRobot> driven_robots_;
  std::vector<RemotelyDrivenRobot> remote_robots_;
  std::unique_ptr<RemotePort> port_;
};

bool isServed(const RobotArguments& arguments) {
  const ConnectOptions options = arguments.connection.connectOptions(arguments.reconnect_timeout_s);
  return isListening(options.address, options.connect_limit);
}

/// Drives the robots in the current run, until its end or, with joins_next_run, until the next one is loaded. @return
/// the address of the port for remote control, for the next run
std::string driveInOneRun(const RobotArguments& arguments) {
  RobotProcess process(arguments);
  Reconnector reconnector(Seconds(arguments.reconnect_timeout_s), logRobot);
  try {
    reconnector.run([&] { process.drive(); }, [&] { process.rejoin(); });
  } catch (const ConnectionError& error) {
    // An environment that awaits the next run ends the robots' connections when that is loaded.
    if (!arguments.joins_next_run || error.reason() != v1::ERROR_REASON_WORLD_REPLACED) {
      if (const std::size_t lost = process.unconfirmedMessages(); lost > 0) {
        logRobot("the environment has not confirmed the last " + std::to_string(lost) + " messages to other robots");
      }
      throw;
    }
  }
  std::cout << "the run is over after " << process.stepNumber() << " steps" << std::endl;
  return process.remoteAddress();
}

void driveRobots(RobotArguments arguments) {
  google::protobuf::SetLogHandler(nullptr);  // parse errors are logged by this program
  arguments.remote_port = driveInOneRun(arguments);
  while (arguments.joins_next_run && isServed(arguments)) arguments.remote_port = driveInOneRun(arguments);
}

/// Runs each robot in a separate process.
void driveInSeparateProcesses(RobotArguments arguments) {
  const auto mine = forkProcesses(arguments.names.size());
  if (!mine) return;
  arguments.names = {arguments.names[*mine]};
  arguments.connection.reports_waiting = *mine == 0;
  driveRobots(arguments);
}

}  // namespace

namespace {

constexpr const char* kRobotExamples =
    "Examples:\n"
    "  robosim robot Pioneer1 Scout1                                        (of a served world)\n"
    "  robosim robot --arcos serial:/dev/ttyUSB0 --controller wander --record run.rawlog    (a real Pioneer)\n"
    "  robosim robot --arcos tcp:127.0.0.1:8101 --controller wander         (of robosim arcos, or another simulator)\n"
    "  robosim robot --ros2 /robot1 --robot-type p3dx --controller wander   (a robot that speaks ROS 2)\n";

}  // namespace

void addRobot(CLI::App& program) {
  auto* command = addSubcommand(program, "robot");
  auto a = std::make_shared<RobotArguments>();
  command->add_option("NAME", a->names,
                      "names of robots in the environment's world; of a real robot, a name for the robot, or none");
  auto* separate_processes =
      command->add_flag("--separate-processes", a->separate_processes,
                        "run each robot in a separate process; takes half the time of separately started programs");
  addConnectionOptions(*command, a->connection);
  addControllerOption(*command, a->controller, "controller of all these robots, instead of those in the world");
  acceptFormerName(*command, *separate_processes, "--apart");
  command
      ->add_option("--map", a->map,
                   "world file that controllers which know the world, such as oracle, have as their map")
      ->type_name("FILE")
      ->transform(inputFile(kWorldKinds));
  command->add_flag("--join-next-run", a->joins_next_run,
                    "after the end of a run, drive in the next one that the environment serves, with a new controller");
  addConnectTimeout(*command, a->connection);
  addReconnectTimeout(*command, a->reconnect_timeout_s);
  command
      ->add_option(
          "--remote-port", a->remote_port,
          "accept remote control of these robots by 'robosim remote' at this address. Until then, their controllers "
          "drive")
      ->type_name("[HOST:]PORT")
      ->excludes(separate_processes);
  command
      ->add_option("--dead-man", a->dead_man_s, "a remotely driven robot stops when it receives nothing for this time")
      ->check(numberIn(0.05, 60))
      ->type_name("SECONDS")
      ->capture_default_str();
  addListenerOptions(*command, a->listener);
  command
      ->add_option("--robot-type", a->robot_type,
                   "robot type of --arcos or --ros2; default: what a robot of --arcos reports")
      ->type_name("TYPE");
  command
      ->add_option("--record", a->record,
                   "record the readings of a real robot to this file, as an MRPT rawlog or, if it ends in .mcap, as "
                   "MCAP with topics of ROS 2")
      ->type_name("FILE")
      ->check(fileName());
  addArcosRobotOptions(*command, *a);
  addRos2RobotOptions(*command, *a);
  for (const char* name : {"--robot-type", "--record"}) {
    dependsOn(command->get_option(name), {command->get_option("--arcos"), command->get_option("--ros2")})
        ->group(kRealRobotGroup);
  }
  const CLI::Option* remote_port = command->get_option("--remote-port");
  for (const char* name : {"--dead-man", "--tls-cert", "--tls-key", "--tokens", "--listen-unprotected"}) {
    dependsOn(command->get_option(name), remote_port)->group("Remote control");
  }
  command->get_option("--remote-port")->group("Remote control");
  for (const char* name : {"--separate-processes", "--map", "--join-next-run"}) {
    command->get_option(name)->excludes("--arcos")->excludes("--ros2");
  }
  command->footer(kRobotExamples);
  command->callback([a] {
    if (!a->arcos.empty()) return driveArcosRobot(*a);
    if (!a->ros2.empty()) return driveRos2Robot(*a);
    if (a->names.empty()) throw CLI::RequiredError("NAME");
    a->separate_processes ? driveInSeparateProcesses(*a) : driveRobots(*a);
  });
}

}  // namespace robosim
