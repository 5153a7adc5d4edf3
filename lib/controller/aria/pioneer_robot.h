#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "aria/action.h"
#include "aria/odometer.h"
#include "aria/pioneer_sensors.h"
#include "aria/range_devices.h"
#include "aria/task_list.h"
#include "control/blocking_controller.h"
#include "control/motion_profile.h"

namespace robosim {

class KeyHandler;

/// Robot with the names and units of ARIA's ArRobot (mm, mm/s, deg, deg/s; counter-clockwise positive), and with
/// acquireSensorReadings() of the 2005 RoboSim. Requires a robot with odometry. doc/from_aria.md compares it with ARIA.
///
/// In a Controller: construct one for the robot and call update() at the start of each step. In a BlockingController's
/// loop: construct it with the clock and call waitForNextStep(), waitForRunExit(), run() or sleep(), which call
/// update() once per step.
///
/// ARIA processes a robot's cycle in a thread of its own (runAsync()). Here a cycle is a time step of the simulation,
/// and it is processed inside the wait functions, on the program's thread. Nothing runs concurrently: a program
/// computes in no simulated time, and the same program and seed give the same run. lock() and unlock() therefore do
/// nothing. A program that computes in a loop without waiting does not end, where in ARIA the robot would continue.
///
/// As in ARIA, setVel … move are direct motion: they disable the actions until clearDirectMotion(), or until
/// setDirectMotionPrecedenceTime().
class PioneerRobot : public PioneerSensors {
 public:
  enum WaitState { WAIT_CONNECTED, WAIT_FAILED_CONN, WAIT_RUN_EXIT, WAIT_TIMEDOUT };

  /// @throws std::invalid_argument for a robot without odometry.
  explicit PioneerRobot(Robot& robot);
  PioneerRobot(Robot& robot, StepClock& clock);

  /// Processes a new step, in ARIA's order: range devices, sensor interpretation tasks, actions (unless there is direct
  /// motion), user tasks. Call it once per step.
  void update();

  /// @name Running
  ///@{
  /// @throws std::logic_error for a PioneerRobot that was made without a clock.
  void waitForNextStep();
  void sleep(double ms);  ///< waits for the steps that take at least this time, as ArUtil::sleep()
  /// Starts the cycle, which the wait functions process. A program that only calls update() or waitForNextStep() need
  /// not call it. @param stop_if_not_connected ends the cycle when the robot halts
  void runAsync(bool stop_if_not_connected = true);
  void run(bool stop_if_not_connected = true);  ///< runAsync() and waitForRunExit()
  /// Ends the cycle: no tasks or actions are processed any more. Without disconnecting, the robot decelerates to rest.
  void stopRunning(bool do_disconnect = true);
  bool isRunning() const { return cycle_ == Cycle::running; }
  /// Processes steps until the cycle has ended, or for this time; 0 for no limit.
  WaitState waitForRunExit(double ms = 0);
  void lock() {}
  void unlock() {}
  ///@}

  /// @name Connection
  /// The robot is connected when it is constructed, and until it halts. The connect callbacks are called once, by the
  /// first of these functions, runAsync() and update().
  ///@{
  bool blockingConnect();
  bool asyncConnect() { return blockingConnect(); }
  WaitState waitForConnect() { return blockingConnect() ? WAIT_CONNECTED : WAIT_FAILED_CONN; }
  bool isConnected() const { return robot_.activity() == Activity::active; }
  bool disconnect();  ///< stops the robot permanently. @return false when it was not connected
  /// @return the callback's number, by which it is removed
  int addConnectCB(Functor functor, ListPos::Pos position = ListPos::LAST);
  bool remConnectCB(int number) { return on_connect_.rem(number); }
  int addDisconnectNormallyCB(Functor functor, ListPos::Pos position = ListPos::LAST);  ///< called by disconnect()
  bool remDisconnectNormallyCB(int number) { return on_disconnect_.rem(number); }
  int addRunExitCB(Functor functor, ListPos::Pos position = ListPos::LAST);  ///< called when the cycle ends
  bool remRunExitCB(int number) { return on_run_exit_.rem(number); }
  ///@}

  /// @name Tasks: called once per step, the highest position first
  /// @return false when there is a task of this name already, or none to remove
  ///@{
  bool addUserTask(const std::string& name, int position, Functor functor);
  bool remUserTask(const std::string& name) { return user_tasks_.rem(name); }
  bool hasUserTask(const std::string& name) const { return user_tasks_.has(name); }
  bool addSensorInterpTask(const std::string& name, int position, Functor functor);
  bool remSensorInterpTask(const std::string& name) { return sensor_tasks_.rem(name); }
  bool hasSensorInterpTask(const std::string& name) const { return sensor_tasks_.has(name); }
  ///@}

  /// @name Keys
  ///@{
  /// Checks the keys once per step, in the user task "key handler" at position 50, as ARIA does.
  /// @param keys must outlive this, @param exit_on_escape the Escape key calls stopRunning()
  void attachKeyHandler(KeyHandler& keys, bool exit_on_escape = true);
  KeyHandler* getKeyHandler() const { return keys_; }  ///< null for none
  ///@}

  /// @name Motors and sonars; both are on at the start
  ///@{
  void enableMotors() { switchMotors(true); }
  void disableMotors() { switchMotors(false); }
  bool areMotorsEnabled() const { return robot_.baseState().motors_enabled.value_or(drive_.enabled()); }
  void enableSonar() { switchSonar(true); }
  void disableSonar() { switchSonar(false); }  ///< no reading is new; all are without echo
  bool areSonarsEnabled() const { return sonar_on_; }
  ///@}

  /// @name Direct motion
  ///@{
  void setVel(double mm_ps);
  void setVel2(double left_mm_ps, double right_mm_ps);
  void setRotVel(double deg_ps);
  void setLatVel(double mm_ps);  ///< to the left; without effect unless hasLatVel()
  bool hasLatVel() const { return robot_.info().type->drive.kind == DriveKind::omni; }
  void setHeading(double deg);       ///< in the frame of getPose(), by the smaller angle
  void setDeltaHeading(double deg);  ///< relative to the present heading
  void move(double mm);              ///< negative: backwards
  void stop();
  /// Whether move() is within this distance of its end; true without an active move(). 0 means getMoveDoneDist().
  bool isMoveDone(double delta_mm = 0) const;
  void setMoveDoneDist(double mm) { move_done_mm_ = mm; }
  double getMoveDoneDist() const { return move_done_mm_; }
  /// The same for setHeading() and setDeltaHeading(). 0 means getHeadingDoneDiff().
  bool isHeadingDone(double delta_deg = 0) const;
  void setHeadingDoneDiff(double deg) { heading_done_deg_ = deg; }
  double getHeadingDoneDiff() const { return heading_done_deg_; }
  void clearDirectMotion();  ///< enables the actions again
  bool isDirectMotion() const { return direct_since_s_.has_value(); }
  /// Time after the last direct motion command until the actions are enabled again; 0, the default, for never.
  void setDirectMotionPrecedenceTime(double ms) { precedence_ms_ = ms; }
  double getDirectMotionPrecedenceTime() const { return precedence_ms_; }
  ///@}

  /// @name Limits
  /// Values above the hardware's limits are clamped. @return false, without effect, for a value that is not positive.
  ///@{
  bool setTransVelMax(double mm_ps);
  bool setTransAccel(double mm_ps2);
  bool setTransDecel(double mm_ps2);
  bool setRotVelMax(double deg_ps);
  bool setRotAccel(double deg_ps2);
  bool setRotDecel(double deg_ps2);
  double getTransVelMax() const;
  double getTransAccel() const;
  double getTransDecel() const;
  double getRotVelMax() const;
  double getRotAccel() const;
  double getRotDecel() const;
  double getAbsoluteMaxTransVel() const;  ///< of the hardware [mm/s]
  double getAbsoluteMaxRotVel() const;    ///< of the hardware [deg/s]
  double getAbsoluteMaxLatVel() const;    ///< of the hardware [mm/s]; 0 unless hasLatVel()
  ///@}

  /// @name Pose and odometer
  ///@{
  /// Sets the present pose; getPose() continues from it. The range devices' points move with the frame.
  void moveTo(const PioneerPose& pose, bool do_cumulative = true);
  double getOdometerDistance() const { return odometer_.distance(); }  ///< driven forwards and backwards [mm]
  double getOdometerDegrees() const { return odometer_.degrees(); }    ///< turned to either side [deg]
  double getOdometerTime() const { return odometer_.seconds(); }       ///< [s] since resetOdometer()
  void resetOdometer() { odometer_.reset(); }
  ///@}

  /// @name Range devices; distances [mm] from the robot's centre
  /// Without range devices, the queries of current points use the sonar and laser echoes of this step.
  ///@{
  /// @param device must outlive its entry.
  void addRangeDevice(RangeDevice& device) { devices_.add(device, *this); }
  bool remRangeDevice(const RangeDevice& device) { return devices_.rem(device); }
  bool hasRangeDevice(const RangeDevice& device) const { return devices_.has(device); }
  RangeDevice* findRangeDevice(const std::string& name) const { return devices_.find(name); }
  const std::vector<RangeDevice*>& getRangeDeviceList() const { return devices_.list(); }
  /// The nearest point between two directions, counter-clockwise; `if_none` when there is none.
  double checkRangeDevicesCurrentPolar(double from_deg, double to_deg, double if_none = 30000) const;
  /// The nearest point within the rectangle between two corners in the robot's frame; `if_none` when there is none.
  double checkRangeDevicesCurrentBox(double x1, double y1, double x2, double y2, double if_none = 30000) const;
  /// The same as in ARIA: without a point, the smallest maximum range of the devices, or 30000 without devices.
  /// @param angle, reading_pos receive the point's direction [deg] and place in the robot's frame, @param device
  /// receives the device, null for the echoes of this step. Unchanged when there is no point; may be null.
  ///@{
  double checkRangeDevicesCurrentPolar(double from_deg, double to_deg, double* angle,
                                       const RangeDevice** device = nullptr) const;
  double checkRangeDevicesCumulativePolar(double from_deg, double to_deg, double* angle = nullptr,
                                          const RangeDevice** device = nullptr) const;
  double checkRangeDevicesCurrentBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos,
                                     const RangeDevice** device = nullptr) const;
  double checkRangeDevicesCumulativeBox(double x1, double y1, double x2, double y2, PioneerPose* reading_pos = nullptr,
                                        const RangeDevice** device = nullptr) const;
  ///@}
  ///@}

  /// @name Actions
  ///@{
  /// @param action must outlive its entry. The highest priority comes first.
  void addAction(Action& action, int priority);
  bool remAction(Action& action);  ///< @return false when it is not in the list
  bool remAction(const std::string& name);
  Action* findAction(const std::string& name) const { return actions_.find(name); }
  void deactivateActions() { actions_.deactivateAll(); }
  ///@}

 private:
  enum class Cycle { by_caller, running, ended };  ///< by_caller: runAsync() was not called

  void announceConnection();
  void endCycle();
  void switchMotors(bool on);
  void switchSonar(bool on);
  void beginDirectMotion();
  bool limitWay(double AxisLimits::*limit, double value);
  bool limitTurn(double AxisLimits::*limit, double value);
  void obey(const ActionDesired& desired);
  ClosestOfDevices currentPolar(double from_deg, double to_deg) const;
  ClosestOfDevices currentBox(double x1, double y1, double x2, double y2) const;

  StepClock* clock_ = nullptr;
  ProfiledDrive drive_;
  AxisLimits way_limits_, turn_limits_;  ///< as set; an action may change those of the drive
  Odometer odometer_;
  RangeDevices devices_;
  ActionList actions_;
  TaskList sensor_tasks_, user_tasks_;
  CallbackList on_connect_, on_disconnect_, on_run_exit_;
  KeyHandler* keys_ = nullptr;
  double move_done_mm_ = 40, heading_done_deg_ = 3;
  std::optional<double> direct_since_s_;  ///< time of the last direct motion command; nullopt without direct motion
  double precedence_ms_ = 0;
  Cycle cycle_ = Cycle::by_caller;
  bool stops_if_not_connected_ = true;
  bool is_announced_ = false;
};

}  // namespace robosim
