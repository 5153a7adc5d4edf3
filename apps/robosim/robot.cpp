#include <iostream>

#include "control/network_hardware.h"
#include "maze/controllers.h"
#include "robosim/connection.h"
#include "robosim/local_run.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

struct Arguments {
  std::vector<std::string> names;
  ConnectionArguments connection;
  std::string controller;
};

struct Seat {
  Robot robot;
  std::unique_ptr<Controller> controller;
};

std::string controllerOf(const NetworkHardware& robots, std::size_t i, const std::string& instead) {
  if (!instead.empty()) return instead;
  return robots.controller(i).empty() ? kDefaultController : robots.controller(i);
}

void driveRobots(const Arguments& arguments) {
  NetworkHardware robots(arguments.connection.dialOptions(), arguments.names);
  std::vector<Seat> seats;
  for (std::size_t i = 0; i < arguments.names.size(); ++i) {
    const ControllerSetup setup{robots.seed(), static_cast<std::uint32_t>(robots.place(i))};
    seats.push_back({Robot(robots.robot(i)), makeController(controllerOf(robots, i, arguments.controller), setup)});
  }
  do {
    for (auto& seat : seats) seat.controller->step(seat.robot);
  } while (robots.nextStep());
  std::cout << "the run is over after " << seats.front().robot.stepNumber() << " steps" << std::endl;
}

}  // namespace

void addRobot(CLI::App& program) {
  auto* command = program.add_subcommand("robot", "Drive one or many robots of an environment elsewhere");
  auto a = std::make_shared<Arguments>();
  command->add_option("NAME", a->names, "robots of the environment's world")->required();
  addConnectionOptions(*command, a->connection);
  command->add_option("--controller", a->controller, "for all these robots, in place of what the world names")
      ->check(CLI::IsMember(controllerNames()));
  command->callback([a] { driveRobots(*a); });
}

}  // namespace robosim
