// Wanders with ARIA's stock actions. The program is a function with its own loop, as an ARIA program's main(); the
// simulation proceeds while it waits.
#include <memory>

#include <robosim/aria/aria.h>

#include "types.h"

using namespace robosim;

namespace {

void wander(Robot& hardware, StepClock& clock) {
  PioneerRobot robot(hardware, clock);
  SonarDevice sonar;
  robot.addRangeDevice(sonar);
  // With a laser on the robot, obstacles between the sonars are seen as well.
  LaserDevice laser;
  if (robot.getNumLaser() > 0) robot.addRangeDevice(laser);

  ActionStallRecover recover;
  ActionBumpers bumpers;
  ActionAvoidFront avoid_near("avoid front near", 225, 0);
  ActionAvoidFront avoid_far;
  ActionConstantVelocity constant_velocity("constant velocity", 400);
  robot.addAction(recover, 100);
  robot.addAction(bumpers, 75);
  robot.addAction(avoid_near, 50);
  robot.addAction(avoid_far, 49);
  robot.addAction(constant_velocity, 25);

  robot.runAsync(true);
  robot.enableMotors();
  robot.waitForRunExit();
}

}  // namespace

ControllerType wanderType() {
  return {"aria_wander",
          "Drives about with ARIA's actions, away from obstacles and out of stalls.",
          {SensorKind::odometry, SensorKind::sonar},
          {},
          [](const ControllerSetup&, const ParameterValues&) -> std::unique_ptr<Controller> {
            return std::make_unique<BlockingController>(wander);
          }};
}
