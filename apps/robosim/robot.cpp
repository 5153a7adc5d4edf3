#include <chrono>
#include <iostream>

#include <CLI/CLI.hpp>
#include <google/protobuf/stubs/logging.h>

#include "control/network_hardware.h"
#include "maze/controllers.h"
#include "net/listen.h"
#include "net/redial.h"
#include "remote/remote_port.h"
#include "robosim/apart.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/local_run.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

struct Arguments {
  std::vector<std::string> names;
  bool apart = false;
  ConnectionArguments connection;
  std::string controller;
  double patience_s = 10;
  std::string remote_port;
  ListenerArguments listener;
  double dead_man_s = 0.5;
};

void log(const std::string& line) { std::cerr << "robosim robot: " + line + "\n"; }

struct Seat {
  Robot robot;
  std::unique_ptr<Controller> controller;
};

std::string controllerOf(const NetworkHardware& robots, std::size_t i, const std::string& instead) {
  if (!instead.empty()) return instead;
  return robots.controller(i).empty() ? kDefaultController : robots.controller(i);
}

/// Nobody may steer these robots from afar by mistake. @throws ConfigError
RemotePort::Options portOptions(const Arguments& arguments) {
  RemotePort::Options options;
  options.listen = hostAndPort(arguments.remote_port);
  options.tls = arguments.listener.identity();
  options.access = arguments.listener.access();
  if (!arguments.connection.insecure) {
    refuseExposure("--remote-port", options.listen, options.tls.has_value(), !options.access.isOpen());
  }
  options.log = log;
  return options;
}

/// The robots of this process, and who drives them: their controllers, or with --remote-port persons, too.
class Crew {
 public:
  explicit Crew(const Arguments& arguments)
      : port_options_(arguments.remote_port.empty() ? RemotePort::Options{} : portOptions(arguments)),
        robots_(arguments.connection.dialOptions(), arguments.names) {
    for (std::size_t i = 0; i < arguments.names.size(); ++i) {
      const ControllerSetup setup{robots_.seed(), static_cast<std::uint32_t>(robots_.place(i))};
      auto controller = makeController(controllerOf(robots_, i, arguments.controller), setup);
      if (arguments.remote_port.empty()) {
        seats_.push_back({Robot(robots_.robot(i)), std::move(controller)});
      } else {
        addRemote(robots_.robot(i), std::move(controller), arguments.dead_man_s);
      }
    }
    if (!arguments.remote_port.empty()) openPort();
  }

  void drive() {
    do {
      for (auto& seat : seats_) seat.controller->step(seat.robot);
      for (auto& robot : remote_robots_) robot->step();
      if (port_) port_->tell();
    } while (robots_.nextStep());
  }
  void rejoin() { robots_.rejoin(); }
  std::uint64_t stepNumber() { return robots_.robot(0).readings().time.step; }

 private:
  void addRemote(Hardware& hardware, std::unique_ptr<Controller> controller, double dead_man_s) {
    RemoteControlRobot::Options options;
    options.dead_man = std::chrono::duration_cast<Helm::Clock::duration>(std::chrono::duration<double>(dead_man_s));
    options.log = log;
    remote_robots_.push_back(std::make_unique<RemoteControlRobot>(hardware, std::move(controller), options));
  }

  void openPort() {
    std::vector<RemoteControlRobot*> robots;
    for (auto& robot : remote_robots_) robots.push_back(robot.get());
    port_ = std::make_unique<RemotePort>(
        port_options_, RemotePort::Run{robots_.world(), robots_.seed(), robots_.robot(0).readings().time.period_s},
        robots);
    const std::string& address = port_options_.listen;
    log("remote control on " + address.substr(0, address.rfind(':') + 1) + std::to_string(port_->port()));
  }

  RemotePort::Options port_options_;
  NetworkHardware robots_;
  std::vector<Seat> seats_;
  std::vector<std::unique_ptr<RemoteControlRobot>> remote_robots_;
  std::unique_ptr<RemotePort> port_;
};

void driveRobots(const Arguments& arguments) {
  google::protobuf::SetLogHandler(nullptr);  // what a remote control sends amiss, our own log tells
  Crew crew(arguments);
  Redial redial(std::chrono::duration<double>(arguments.patience_s), log);
  redial.keepTalking([&] { crew.drive(); }, [&] { crew.rejoin(); });
  std::cout << "the run is over after " << crew.stepNumber() << " steps" << std::endl;
}

/// Each robot in a process of its own.
void driveRobotsApart(Arguments arguments) {
  const auto mine = goOnApart(arguments.names.size());
  if (!mine) return;
  arguments.names = {arguments.names[*mine]};
  driveRobots(arguments);
}

}  // namespace

void addRobot(CLI::App& program) {
  auto* command = program.add_subcommand("robot", "Drive one or many robots of an environment elsewhere");
  auto a = std::make_shared<Arguments>();
  command->add_option("NAME", a->names, "robots of the environment's world")->required();
  auto* apart = command->add_flag("--apart", a->apart,
                                  "each robot in a process of its own; many take half the time of as many programs");
  addConnectionOptions(*command, a->connection);
  command->add_option("--controller", a->controller, "for all these robots, in place of what the world names")
      ->check(CLI::IsMember(controllerNames()));
  addPatience(*command, a->patience_s);
  command
      ->add_option(
          "--remote-port", a->remote_port,
          "let people drive these robots: where 'robosim remote' finds them. Until one does, their controllers "
          "drive")
      ->type_name("[HOST:]PORT")
      ->excludes(apart);
  command
      ->add_option("--dead-man", a->dead_man_s,
                   "a robot that a person drives stops when it has heard nothing from them for so long")
      ->check(numberIn(0.05, 60))
      ->type_name("SECONDS")
      ->capture_default_str();
  addListenerOptions(*command, a->listener);
  command->callback([a] { a->apart ? driveRobotsApart(*a) : driveRobots(*a); });
}

}  // namespace robosim
