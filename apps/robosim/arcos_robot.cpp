#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "arcos/client/arcos_hardware.h"
#include "arcos/client/open_channel.h"
#include "base/error_list.h"
#include "base/interrupt.h"
#include "robosim/arguments.h"
#include "robosim/command_line.h"
#include "robosim/device_library.h"
#include "robosim/real_robot.h"
#include "robosim/robot_arguments.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

/// The robot type of a subclass. @throws ConfigError when there is none, or it does not speak ARCOS
ArcosRobotType typeOf(const std::string& name) {
  const FleetRobot robot = robotTypeNamed(name);
  if (!robot.model->arcos) {
    throw ConfigError("robot type '" + name + "' has no <arcos>, which describes a robot to ARCOS; add it, or choose " +
                      "another one with --robot-type");
  }
  return {robot.info, *robot.model->arcos};
}

ArcosHardware::Options arcosHardwareOptions(const RobotArguments& arguments, const Interrupt& interrupt) {
  ArcosHardware::Options options;
  options.type_of = [type = arguments.robot_type](const std::string& subclass) {
    return typeOf(type.empty() ? subclass : type);
  };
  if (!arguments.names.empty()) options.name = arguments.names.front();
  if (!arguments.laser.empty()) options.laser = loadSickLaser(arguments.laser, logRobot);
  options.requests_laser = !arguments.has_no_laser_request;
  options.log = logRobot;
  options.interrupted = [&interrupt] { return interrupt.isRequested(); };
  return options;
}

}  // namespace

void addArcosRobotOptions(CLI::App& command, RobotArguments& arguments) {
  command
      .add_option("--arcos", arguments.arcos,
                  "drive a robot that speaks ARCOS, such as a Pioneer, with the controller of --controller: "
                  "tcp:HOST:PORT, serial:DEVICE, serial:DEVICE:BAUD, or replay:FILE of --arcos-log")
      ->type_name("ADDRESS")
      ->group(kRealRobotGroup);
  const CLI::Option* arcos = command.get_option("--arcos");
  command.add_option("--laser", arguments.laser, "serial device of a SICK LMS200 on the robot, as in /dev/ttyUSB1")
      ->type_name("DEVICE")
      ->group(kRealRobotGroup);
  command
      .add_option("--arcos-log", arguments.arcos_log, "log all bytes between the robot and this program to this file")
      ->type_name("FILE")
      ->check(fileName())
      ->group(kRealRobotGroup);
  command
      .add_flag(
          "--no-laser-request", arguments.has_no_laser_request,
          "do not ask a simulator for the scans of its laser: the robot then has none, and SIPs alone fit on a slow "
          "line")
      ->excludes("--laser")
      ->group(kRealRobotGroup);
  for (const char* name : {"--laser", "--arcos-log", "--no-laser-request"}) dependsOn(command.get_option(name), arcos);
}

void driveArcosRobot(const RobotArguments& arguments) {
  checkRealRobotArguments("--arcos", arguments);
  const Interrupt interrupt;
  auto channel = openChannel(arguments.arcos);
  if (!arguments.arcos_log.empty()) channel = logChannel(std::move(channel), arguments.arcos_log);
  ArcosHardware robot(std::move(channel), arcosHardwareOptions(arguments, interrupt));
  driveRealRobot(robot, arguments.arcos, arguments);
}

}  // namespace robosim
