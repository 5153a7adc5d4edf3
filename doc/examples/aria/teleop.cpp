// Drives by the arrow keys of the terminal; Escape and q end the run. A pipe in the place of the terminal gives one key
// per time step, '.' for none:
//   printf '\033[A\033[A..........\033[C q' | robosim run room.xml --plugin build/libaria.so --controller aria_teleop
#include <atomic>
#include <memory>
#include <stdexcept>

#include <robosim/aria/aria.h>

#include "types.h"

using namespace robosim;

namespace {

/// The keyboard of the process, which drives one robot.
class Keyboard {
 public:
  Keyboard() {
    if (is_used_.exchange(true)) {
      throw std::runtime_error("the keyboard drives another robot already; give this one another controller");
    }
  }
  ~Keyboard() { is_used_ = false; }
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

 private:
  static inline std::atomic<bool> is_used_ = false;
};

void teleop(Robot& hardware, StepClock& clock) {
  const Keyboard keyboard;
  TerminalKeys terminal;
  KeyHandler keys(terminal);
  PioneerRobot robot(hardware, clock);
  SonarDevice sonar;
  robot.addRangeDevice(sonar);
  LaserDevice laser;
  if (robot.getNumLaser() > 0) robot.addRangeDevice(laser);
  robot.attachKeyHandler(keys);
  keys.addKeyHandler('q', [&] { robot.stopRunning(); });

  ActionDeceleratingLimiter limiter("limiter", true), backwards_limiter("backwards limiter", false);
  ActionKeydrive keydrive;
  robot.addAction(limiter, 100);
  robot.addAction(backwards_limiter, 95);
  robot.addAction(keydrive, 50);

  robot.enableMotors();
  robot.run(true);
}

}  // namespace

ControllerType teleopType() {
  return {"aria_teleop",
          "The arrow keys drive the robot, with speed limits before obstacles; space stops, Escape and q end.",
          {SensorKind::odometry, SensorKind::sonar},
          {},
          [](const ControllerSetup&, const ParameterValues&) -> std::unique_ptr<Controller> {
            return std::make_unique<BlockingController>(teleop);
          }};
}
