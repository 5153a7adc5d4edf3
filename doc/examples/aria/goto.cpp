// Drives to four goals with ActionGoto, and around obstacles; then the robot halts. Between the waits the program reads
// and commands the robot, as an ARIA program does that has locked it.
#include <memory>
#include <vector>

#include <robosim/aria/aria.h>

#include "types.h"

using namespace robosim;

namespace {

void driveTo(const std::vector<PioneerPose>& goals, Robot& hardware, StepClock& clock) {
  PioneerRobot robot(hardware, clock);
  SonarDevice sonar;
  robot.addRangeDevice(sonar);

  ActionLimiterForwards limiter_near("speed limiter near", 200, 500, 150),
      limiter_far("speed limiter far", 250, 1100, 400);
  ActionAvoidFront avoid("avoid front", 300, 150, 15);
  ActionGoto go_to("goto", goals.front());
  robot.addAction(limiter_near, 95);
  robot.addAction(limiter_far, 90);
  robot.addAction(avoid, 60);
  robot.addAction(go_to, 50);

  robot.runAsync(true);
  robot.enableMotors();
  for (const PioneerPose& goal : goals) {
    robot.lock();
    go_to.setGoal(goal);
    robot.unlock();
    while (robot.isRunning() && !go_to.haveAchievedGoal()) robot.sleep(100);
  }
  robot.stopRunning();
  robot.waitForRunExit();
}

}  // namespace

ControllerType gotoType() {
  return {"aria_goto",
          "Drives to the corners of a square and back to its start with ARIA's actions, and halts.",
          {SensorKind::odometry, SensorKind::sonar},
          {{"side_m", 2.5, 0.5, 100, "m", "side of the square, ahead and to the left of the start"}},
          [](const ControllerSetup&, const ParameterValues& p) -> std::unique_ptr<Controller> {
            const double side = 1000 * p["side_m"];
            const std::vector<PioneerPose> goals{{side, 0, 0}, {side, side, 0}, {0, side, 0}, {0, 0, 0}};
            return std::make_unique<BlockingController>(
                [goals](Robot& robot, StepClock& clock) { driveTo(goals, robot, clock); });
          }};
}
