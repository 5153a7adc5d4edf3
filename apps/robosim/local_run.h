#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/controller.h"
#include "environment/environment.h"
#include "environment/local_hardware.h"
#include "robots/fleet.h"
#include "robots/world_source.h"

namespace robosim {

struct RunOptions {
  EnvironmentOptions environment;
  std::string controller;  ///< for every robot; empty: what the world names, and kDefaultController where it names none
};

/// What a robot runs that neither the world nor the command line gives a controller: the 2005 application.
constexpr const char* kDefaultController = "gold_finder";

/// What a robot runs.
/// @param instead for every robot in place of its own; empty for its own
std::string controllerOf(const FleetRobot& robot, const std::string& instead);

/// Adds to `errors` each robot that lacks a sensor its controller cannot do without. `world_file` names the file in
/// errors.
void checkControllers(const LoadedWorld& world, const std::string& world_file, const std::string& instead,
                      ErrorList& errors);

/// Reads a world that is to be run: as loadWorld(), with checkControllers(), and there must be a robot.
/// @throws ConfigError with every fault found.
LoadedWorld loadWorldToRun(const std::string& file, const std::string& instead);
LoadedWorld loadWorldToRun(const WorldSource& source, const std::string& instead);

/// When and by whom the gold was found, who has won, and when all had stopped; simulated seconds.
struct GoldOutcome {
  std::optional<std::string> found_by;
  std::optional<double> found_s;
  std::optional<std::string> won_by;  ///< whoever reached the gold and said so (CheckWin); has found it, too
  std::optional<double> won_s;
  std::optional<double> all_halted_s;
};

/// An environment and the controllers of its robots in this process: where the two towers of the house meet.
class LocalRun {
 public:
  /// @param elsewhere by robot: whether something outside of this process drives it; empty for none
  /// @throws ConfigError for an unknown controller.
  LocalRun(LoadedWorld world, const RunOptions& options, const std::vector<std::uint8_t>& elsewhere = {});

  /// Lets every controller decide, then takes one time step.
  void step();
  /// @name The same in parts, for whoever has the environment step
  ///@{
  void decide();
  void noteOutcome();  ///< after the step
  ///@}

  Environment& environment() { return environment_; }
  const Environment& environment() const { return environment_; }
  const GoldOutcome& gold() const { return gold_; }

 private:
  struct Seat {
    LocalHardware hardware;
    Robot robot;
    std::unique_ptr<Controller> controller;
    Seat(Environment& environment, std::size_t i, std::unique_ptr<Controller> c)
        : hardware(environment, i), robot(hardware), controller(std::move(c)) {}
  };

  Environment environment_;
  Workers workers_;
  std::vector<std::unique_ptr<Seat>> seats_;  ///< on the heap: a Robot holds on to its LocalHardware
  GoldOutcome gold_;
};

}  // namespace robosim
