#include <iostream>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

#include "arcos/client/arcos_hardware.h"
#include "arcos/client/open_channel.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "control/robot.h"
#include "maze/controllers.h"
#include "net/host_port.h"
#include "recording/rawlog_writer.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/device_library.h"
#include "robosim/robot_arguments.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "run/local_run.h"

namespace robosim {
namespace {

/// The robot type of a subclass. @throws ConfigError when there is none, or it does not speak ARCOS
ArcosRobotType typeOf(const std::string& name) {
  const RobotTypes types = robotTypesIn(robotTypeFolders("."));
  if (!types.contains(name)) {
    throw ConfigError("there is no robot type '" + name + "'; choose one with --robot-type, or add " + name +
                      ".xml to a folder robots/ of ROBOSIM_PATH");
  }
  const FleetRobot robot = robotOfType(types, name);
  if (!robot.model->arcos) {
    throw ConfigError("robot type '" + name + "' has no <arcos>, which describes a robot to ARCOS; add it, or choose " +
                      "another one with --robot-type");
  }
  return {robot.info, *robot.model->arcos};
}

void checkSensors(const std::string& controller, const RobotInfo& robot) {
  const ControllerType& type = controllers().typeOf(controller);
  for (const SensorKind kind : missingSensors(type, *robot.sensors)) {
    throw ConfigError("controller " + type.name + " requires a sensor of kind " + nameOf(kind) +
                      ", which the robot does not have; use another controller");
  }
}

/// The robot, its controller or remote control, and its recording.
class ArcosProcess {
 public:
  explicit ArcosProcess(const RobotArguments& arguments)
      : hardware_(open(arguments), hardwareOptions(arguments)), controller_name_(arguments.controller) {
    checkSensors(controller_name_, hardware_.info());
    auto controller = makeController(controller_name_, ControllerSetup{}, hardware_.info().name);
    if (arguments.remote_port.empty()) {
      robot_.emplace(hardware_);
      controller_ = std::move(controller);
    } else {
      remote_ = std::make_unique<RemoteControlRobot>(hardware_, std::move(controller), remoteOptions(arguments));
      openPort(arguments);
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
  static std::unique_ptr<ByteChannel> open(const RobotArguments& arguments) {
    auto channel = openChannel(arguments.arcos);
    return arguments.arcos_log.empty() ? std::move(channel) : logChannel(std::move(channel), arguments.arcos_log);
  }

  ArcosHardware::Options hardwareOptions(const RobotArguments& arguments) {
    ArcosHardware::Options options;
    options.type_of = [type = arguments.arcos_type](const std::string& subclass) {
      return typeOf(type.empty() ? subclass : type);
    };
    if (!arguments.names.empty()) options.name = arguments.names.front();
    if (!arguments.laser.empty()) options.laser = loadSickLaser(arguments.laser, logRobot);
    options.log = logRobot;
    options.interrupted = [this] { return interrupt_.isRequested(); };
    return options;
  }

  void openPort(const RobotArguments& arguments) {
    const RemotePort::Options options = portOptions(arguments);
    port_ = std::make_unique<RemotePort>(
        options, RemotePort::Run{arguments.arcos, 0, hardware_.readings().time.period_s}, std::vector{remote_.get()});
    logRobot("remote control on " + withPort(options.listen, port_->port()));
  }

  void record() {
    if (recording_) recording_->write(std::span(&hardware_.readings(), 1), {});
  }

  bool isHalted() const { return robot_ && robot_->activity() != Activity::active; }

  Interrupt interrupt_;
  ArcosHardware hardware_;
  std::string controller_name_;
  std::optional<Robot> robot_;
  std::unique_ptr<Controller> controller_;
  std::unique_ptr<RemoteControlRobot> remote_;
  std::unique_ptr<RemotePort> port_;
  std::unique_ptr<RawlogWriter> recording_;
};

}  // namespace

void addArcosRobotOptions(CLI::App& command, RobotArguments& arguments) {
  command
      .add_option("--arcos", arguments.arcos,
                  "drive a robot that speaks ARCOS, such as a Pioneer, with the controller of --controller: "
                  "tcp:HOST:PORT, serial:DEVICE, serial:DEVICE:BAUD, or replay:FILE of --arcos-log")
      ->type_name("ADDRESS")
      ->group("A real robot");
  const CLI::Option* arcos = command.get_option("--arcos");
  command.add_option("--robot-type", arguments.arcos_type, "robot type of --arcos; default: what the robot reports")
      ->type_name("TYPE")
      ->group("A real robot");
  command.add_option("--laser", arguments.laser, "serial device of a SICK LMS200 on the robot, as in /dev/ttyUSB1")
      ->type_name("DEVICE")
      ->group("A real robot");
  command
      .add_option("--record", arguments.record,
                  "record the readings of --arcos to this file, as an MRPT rawlog or, if it ends in .mcap, as MCAP "
                  "with topics of "
                  "ROS 2")
      ->type_name("FILE")
      ->check(fileName())
      ->group("A real robot");
  command
      .add_option("--arcos-log", arguments.arcos_log, "log all bytes between the robot and this program to this file")
      ->type_name("FILE")
      ->check(fileName())
      ->group("A real robot");
  for (const char* name : {"--robot-type", "--laser", "--record", "--arcos-log"}) {
    dependsOn(command.get_option(name), arcos);
  }
}

void driveArcosRobot(const RobotArguments& arguments) {
  if (arguments.names.size() > 1) throw ConfigError("--arcos drives one robot; give one name, or none");
  if (arguments.controller.empty()) {
    throw ConfigError("--arcos needs --controller, as in --controller wander; robosim controllers lists them");
  }
  ArcosProcess(arguments).drive();
}

}  // namespace robosim
