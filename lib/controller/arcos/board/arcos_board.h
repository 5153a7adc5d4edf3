#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include <mrpt/math/TPose2D.h>

#include "arcos/board/serial_camera.h"
#include "arcos/protocol/aux_port.h"
#include "arcos/protocol/config_packet.h"
#include "arcos/protocol/gripper_packet.h"
#include "arcos/protocol/io_packets.h"
#include "arcos/protocol/packet.h"
#include "arcos/protocol/parameters.h"
#include "arcos/protocol/sip.h"
#include "control/motion_profile.h"
#include "control/robot.h"

namespace robosim {

/// The controller board of an ActivMedia robot, simulated: executes the commands of ARCOS on a Robot, and describes the
/// robot's state in ARCOS packets. It knows what the robot senses, and neither the true world nor a connection.
///
/// In each time step: execute() the commands that have arrived, update(), then, after the step, sip().
class ArcosBoard {
 public:
  /// @param robot, parameters must outlive this @throws std::invalid_argument for a robot without odometry
  ArcosBoard(Robot& robot, const arcos::Parameters& parameters);

  /// State at the start of a session: odometry at 0, motors and sonar on, initial limits, robot stopped.
  void startSession();
  /// Stops the robot.
  void endSession();

  /// Executes a command of the robot, as opposed to the simulator or the session. Others have no effect.
  void execute(const arcos::Packet& command);
  /// Continues the motion for the next time step.
  /// @param is_link_alive false: the watchdog has expired, and the robot stands, at the hardware's deceleration, until
  /// it is true again; then it continues
  void update(bool is_link_alive);
  /// Sets the odometry to (0, 0, 0).
  void zeroOdometry() { setOdometry({}); }

  arcos::Sip sip() const;
  arcos::ConfigPacket config() const;
  arcos::EncoderTicks encoderTicks() const;
  arcos::GripperPacket gripper() const;
  /// Rate of the robot's gyro, counter-clockwise [rad/s]; nullopt: it has none.
  std::optional<double> gyroRate() const;
  /// The packet of what the device at AUX1 has answered, a camera that pans, tilts and zooms, when it is complete;
  /// empty until then.
  std::string takeAuxPacket() { return aux_.takePacket(); }
  CameraAim camera() const { return robot_.cameraAim(); }  ///< of the camera at AUX1
  arcos::DigitalPorts ports() const { return {.in = 0xFF, .out = digital_out_}; }

  /// Odometry in the frame of the session [m, rad].
  mrpt::math::TPose2D odometry() const;

 private:
  void setOdometry(const mrpt::math::TPose2D& session_from_robot);
  void executeMotion(std::uint8_t id, double argument);
  void setLimit(std::uint8_t id, double argument);
  void setOutputs(int mask_and_values);
  void moveGripper(int operation);
  double batteryVolts() const;
  void addBumpers(arcos::Sip& sip) const;

  Robot& robot_;
  const arcos::Parameters& parameters_;
  ProfiledDrive drive_;
  AxisLimits way_limits_, turn_limits_;  ///< as set by the program; an emergency stop ignores them
  bool are_motors_on_ = true;
  bool is_stopping_ = false;  ///< emergency stop: ignores motion until the robot stands
  bool is_sonar_on_ = true;
  int bumper_stall_ = 0;           ///< 1: front bumpers stall the motors, 2: rear bumpers
  double battery_test_volts_ = 0;  ///< 0: the true voltage
  std::uint8_t digital_out_ = 0xFF;
  SerialCamera camera_;
  arcos::AuxPort aux_;
  mrpt::math::TPose2D session_from_odom_;
  mrpt::math::TPose2D last_odom_from_robot_;
  double left_mm_ = 0, right_mm_ = 0;  ///< distances of the wheels since the start of the session, signed
};

}  // namespace robosim
