#include <chrono>
#include <iostream>

#include "control/network_hardware.h"
#include "maze/controllers.h"
#include "net/redial.h"
#include "robosim/arguments.h"
#include "robosim/connection.h"
#include "robosim/local_run.h"
#include "robosim/subcommands.h"

namespace robosim {
namespace {

struct Arguments {
  std::vector<std::string> names;
  ConnectionArguments connection;
  std::string controller;
  double patience_s = 10;
};

struct Seat {
  Robot robot;
  std::unique_ptr<Controller> controller;
};

std::string controllerOf(const NetworkHardware& robots, std::size_t i, const std::string& instead) {
  if (!instead.empty()) return instead;
  return robots.controller(i).empty() ? kDefaultController : robots.controller(i);
}

/// The robots of this process, and who drives them.
class Crew {
 public:
  explicit Crew(const Arguments& arguments) : robots_(arguments.connection.dialOptions(), arguments.names) {
    for (std::size_t i = 0; i < arguments.names.size(); ++i) {
      const ControllerSetup setup{robots_.seed(), static_cast<std::uint32_t>(robots_.place(i))};
      seats_.push_back(
          {Robot(robots_.robot(i)), makeController(controllerOf(robots_, i, arguments.controller), setup)});
    }
  }

  void drive() {
    do {
      for (auto& seat : seats_) seat.controller->step(seat.robot);
    } while (robots_.nextStep());
  }
  void rejoin() { robots_.rejoin(); }
  std::uint64_t stepNumber() const { return seats_.front().robot.stepNumber(); }

 private:
  NetworkHardware robots_;
  std::vector<Seat> seats_;
};

void driveRobots(const Arguments& arguments) {
  Crew crew(arguments);
  Redial redial(std::chrono::duration<double>(arguments.patience_s),
                [](const std::string& line) { std::cerr << "robosim robot: " + line + "\n"; });
  redial.keepTalking([&] { crew.drive(); }, [&] { crew.rejoin(); });
  std::cout << "the run is over after " << crew.stepNumber() << " steps" << std::endl;
}

}  // namespace

void addRobot(CLI::App& program) {
  auto* command = program.add_subcommand("robot", "Drive one or many robots of an environment elsewhere");
  auto a = std::make_shared<Arguments>();
  command->add_option("NAME", a->names, "robots of the environment's world")->required();
  addConnectionOptions(*command, a->connection);
  command->add_option("--controller", a->controller, "for all these robots, in place of what the world names")
      ->check(CLI::IsMember(controllerNames()));
  addPatience(*command, a->patience_s);
  command->callback([a] { driveRobots(*a); });
}

}  // namespace robosim
