#include "robosim/real_robot.h"

#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/error_list.h"
#include "control/robot.h"
#include "maze/controllers.h"
#include "net/host_port.h"
#include "recording/rawlog_writer.h"
#include "robots/robot_types.h"
#include "run/local_run.h"

namespace robosim {
namespace {

void checkSensors(const std::string& controller, const RobotInfo& robot) {
  const ControllerType& type = controllers().typeOf(controller);
  for (const SensorKind kind : missingSensors(type, *robot.sensors)) {
    throw ConfigError("controller " + type.name + " requires a sensor of kind " + nameOf(kind) +
                      ", which the robot does not have; use another controller");
  }
}

/// A robot, its controller or remote control, and its recording.
class Driving {
 public:
  Driving(RealRobot& hardware, const std::string& where, const RobotArguments& arguments)
      : hardware_(hardware), controller_name_(arguments.controller) {
    checkSensors(controller_name_, hardware_.info());
    auto controller = makeController(controller_name_, ControllerSetup{}, hardware_.info().name);
    if (arguments.remote_port.empty()) {
      robot_.emplace(hardware_);
      controller_ = std::move(controller);
    } else {
      remote_ = std::make_unique<RemoteControlRobot>(hardware_, std::move(controller), remoteOptions(arguments));
      openPort(where, arguments);
    }
    if (!arguments.record.empty()) {
      recording_ = std::make_unique<RawlogWriter>(arguments.record, std::span(&hardware_.info(), 1));
    }
  }

  void drive() {
    try {
      do {
        record();
        guarded(controller_name_, hardware_.info().name,
                [this] { remote_ ? remote_->step() : controller_->step(*robot_); });
        if (port_) port_->publish();
      } while (!isHalted() && hardware_.nextStep());
      hardware_.close([this] { record(); });
    } catch (...) {
      if (recording_) recording_->close();
      throw;
    }
    if (recording_) recording_->close();
    std::cout << "drove for " << hardware_.readings().time.step << " cycles" << std::endl;
  }

 private:
  void openPort(const std::string& where, const RobotArguments& arguments) {
    const RemotePort::Options options = portOptions(arguments);
    port_ = std::make_unique<RemotePort>(options, RemotePort::Run{where, 0, hardware_.readings().time.period_s},
                                         std::vector{remote_.get()});
    logRobot("remote control on " + withPort(options.listen, port_->port()));
  }

  void record() {
    if (recording_) recording_->write(std::span(&hardware_.readings(), 1), {});
  }

  bool isHalted() const { return robot_ && robot_->activity() != Activity::active; }

  RealRobot& hardware_;
  std::string controller_name_;
  std::optional<Robot> robot_;
  std::unique_ptr<Controller> controller_;
  std::unique_ptr<RemoteControlRobot> remote_;
  std::unique_ptr<RemotePort> port_;
  std::unique_ptr<RawlogWriter> recording_;
};

}  // namespace

FleetRobot robotTypeNamed(const std::string& name) {
  const RobotTypes types = robotTypesIn(robotTypeFolders("."));
  if (!types.contains(name)) {
    throw ConfigError("there is no robot type '" + name + "'; choose one with --robot-type, or add " + name +
                      ".xml to a folder robots/ of ROBOSIM_PATH");
  }
  return robotOfType(types, name);
}

void checkRealRobotArguments(const std::string& option, const RobotArguments& arguments) {
  if (arguments.names.size() > 1) throw ConfigError(option + " drives one robot; give one name, or none");
  if (arguments.controller.empty()) {
    throw ConfigError(option + " needs --controller, as in --controller wander; robosim controllers lists them");
  }
}

void driveRealRobot(RealRobot& robot, const std::string& where, const RobotArguments& arguments) {
  Driving(robot, where, arguments).drive();
}

}  // namespace robosim
