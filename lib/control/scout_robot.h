#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <mrpt/math/TPose2D.h>

#include "control/blocking_controller.h"
#include "control/motion_profile.h"
#include "control/robot.h"

namespace robosim {

/// Places in the Nomad's state vector (Nclient.h names and numbers). What this robot has not, reads 0.
enum ScoutStateIndex : std::size_t {
  STATE_IR_0 = 1,
  STATE_SONAR_0 = 17,  ///< to STATE_SONAR_0 + 15, counter-clockwise from straight ahead
  STATE_BUMPER = 33,   ///< a bit per segment
  STATE_CONF_X = 34,
  STATE_CONF_Y = 35,
  STATE_CONF_STEER = 36,   ///< heading, 0 … 3599
  STATE_CONF_TURRET = 37,  ///< as heading: a Scout's top does not turn
  STATE_VEL_RIGHT = 38,    ///< of the wheels
  STATE_VEL_LEFT = 39,
  STATE_MOTOR_STATUS = 41,  ///< 0: at rest
  STATE_COMPASS = 43,       ///< 0 … 3599
  STATE_ERROR = 44,         ///< 1: stalled
  NUM_STATE = 45,
};

/// A robot as the Nomad Scout's users know it. Lengths are tenths of an inch, angles tenths of a degree, speeds those
/// per second; also the sonars, which the Nomad itself tells in whole inches. Commands return 1, as on the Nomad.
///
/// vm, pr, sp and ac come in two forms: with two arguments for the translation and the rotation, and with three, as a
/// Scout has them, for the right and the left wheel (the third, for the turret, means nothing).
///
/// In a Controller: make one for the robot and call gs() first thing in each step. In a BlockingController's loop: make
/// it with the clock; then gs() and ws() wait for the simulation.
class ScoutRobot {
 public:
  /// @throws std::invalid_argument for a robot without odometry.
  explicit ScoutRobot(Robot& robot);
  ScoutRobot(Robot& robot, StepClock& clock);
  ScoutRobot(const ScoutRobot&) = delete;
  ScoutRobot& operator=(const ScoutRobot&) = delete;

  std::array<long, NUM_STATE> State{};  ///< as of the last gs(); by ScoutStateIndex

  /// @name Motion
  ///@{
  int vm(int translation, int rotation);  ///< velocity move
  int vm(int right, int left, int turret);
  int pr(int translation, int rotation);  ///< relative position move
  int pr(int right, int left, int turret);
  int sp(int translation, int rotation);  ///< highest speeds of pr
  int sp(int right, int left, int turret);
  int ac(int translation, int rotation);  ///< accelerations, up and down
  int ac(int right, int left, int turret);
  int st();  ///< stops
  /// Waits until the translation and the rotation, as asked for, have come to rest.
  /// @param timeout_s 0: without end.
  /// @return 1; 0 when the time was out.
  /// @throws std::logic_error for a ScoutRobot that was made without a clock.
  int ws(bool translation, bool rotation, bool turret, int timeout_s);
  int dp(int x, int y);               ///< says where the robot is
  int da(int steer, int turret = 0);  ///< says what its heading is
  ///@}

  /// @name Sensing
  ///@{
  /// Fills State with the readings of this step. Called again in one step, it waits for the next, if there is a clock.
  int gs();
  int get_sn();  ///< fills State with the sonars alone, without waiting
  /// Chooses the sonars that are read; the others keep what they told last.
  /// @param rate pause between two sonars on the Nomad; here all that are chosen fire in every step.
  /// @param order numbers from 0; anything that is no sonar's ends the list.
  int conf_sn(int rate, std::span<const int> order);
  ///@}

 private:
  mrpt::math::TPose2D nomadFromRobot() const;
  void wait(const char* who);

  Robot& robot_;
  StepClock* clock_ = nullptr;
  ProfiledDrive drive_;
  mrpt::math::TPose2D nomad_from_odom_;
  std::array<bool, 16> sonar_on_;
  std::optional<std::uint64_t> state_step_;  ///< the step that State tells of
};

}  // namespace robosim
