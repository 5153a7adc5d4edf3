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

/// Indices into the Nomad's state vector (names and numbers of Nclient.h). Entries of missing sensors are 0.
enum ScoutStateIndex : std::size_t {
  STATE_IR_0 = 1,
  STATE_SONAR_0 = 17,  ///< to STATE_SONAR_0 + 15, counter-clockwise from straight ahead
  STATE_BUMPER = 33,   ///< a bit per segment
  STATE_CONF_X = 34,
  STATE_CONF_Y = 35,
  STATE_CONF_STEER = 36,   ///< heading, 0 … 3599
  STATE_CONF_TURRET = 37,  ///< equals the heading: a Scout has no turret
  STATE_VEL_RIGHT = 38,    ///< of the wheels
  STATE_VEL_LEFT = 39,
  STATE_MOTOR_STATUS = 41,  ///< 0: at rest
  STATE_COMPASS = 43,       ///< 0 … 3599
  STATE_ERROR = 44,         ///< 1: stalled
  NUM_STATE = 45,
};

/// Adapter with the names and units of the Nomad Scout. Lengths are tenths of an inch, angles tenths of a degree,
/// speeds the same per second; also the sonars, which the Nomad reports in whole inches. Commands return 1, as on the
/// Nomad.
///
/// vm, pr, sp and ac have two forms: two arguments for translation and rotation, or three as on a Scout, for the right
/// and the left wheel (the third, for the turret, is ignored).
///
/// In a Controller: construct one for the robot and call gs() at the start of each step. In a BlockingController's
/// loop: construct it with the clock; then gs() and ws() wait for the simulation.
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
  /// Waits until the selected axes, translation and rotation, are at rest.
  /// @param timeout_s 0: unlimited.
  /// @return 1; 0 on timeout.
  /// @throws std::logic_error for a ScoutRobot that was made without a clock.
  int ws(bool translation, bool rotation, bool turret, int timeout_s);
  int dp(int x, int y);               ///< sets the present position
  int da(int steer, int turret = 0);  ///< sets the present heading
  ///@}

  /// @name Sensing
  ///@{
  /// Fills State with the readings of this step. A second call in the same step waits for the next, if there is a
  /// clock.
  int gs();
  int get_sn();  ///< fills State with the sonars alone, without waiting
  /// Selects the sonars that are read; the others keep their last range.
  /// @param rate pause between two sonars on the Nomad; ignored here: all selected sonars fire in every step.
  /// @param order numbers from 0; the first number without a sonar ends the list.
  int conf_sn(int rate, std::span<const int> order);
  ///@}

 private:
  mrpt::math::TPose2D nomadFromRobot() const;
  void wait(const char* function);

  Robot& robot_;
  StepClock* clock_ = nullptr;
  ProfiledDrive drive_;
  mrpt::math::TPose2D nomad_from_odom_;
  std::array<bool, 16> sonar_on_;
  std::optional<std::uint64_t> state_step_;  ///< step of State
};

}  // namespace robosim
