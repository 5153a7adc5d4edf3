#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "arcos/client/arcos_client.h"
#include "arcos/client/byte_channel.h"
#include "arcos/protocol/parameters.h"
#include "hardware/real_robot.h"

namespace robosim {

/// A robot type, as ArcosHardware needs it.
struct ArcosRobotType {
  RobotInfo info;  ///< with the sensors of the simulated type
  arcos::Parameters parameters;
};

/// A source of laser scans beside the robot's board, such as a scanner at a serial line of this computer.
class ScanSource {
 public:
  virtual ~ScanSource() = default;
  /// Ranges [mm] of the beams from right to left, kNoEcho_mm without an echo: the latest scan; empty while there is
  /// none of the last half second.
  virtual std::vector<std::uint16_t> latestScan() = 0;
};

/// A robot that speaks ARCOS: a real Pioneer, or a simulated one. The controllers that drive it are those that drive a
/// simulated robot; a time step is the cycle of its SIPs, 0.1 s. RobotInfo::limits are those that the robot is
/// configured for.
///
/// Commands are rounded to whole mm/s and degrees/s; the remainder is added to the next command, so that the rounding
/// does not accumulate. The robot stands, whatever its controller commands, while the emergency stop is pressed, its
/// motors are disabled, its battery is low or its laser scanner does not answer; BaseState::stop_reason and the log
/// state the reason. Without commands it stops by its own watchdog, within 2 s.
class ArcosHardware final : public RealRobot, public BaseLink {
 public:
  struct Options {
    /// The type of a subclass: the robot's answer in the handshake, such as "p3dx". @throws ConfigError
    std::function<ArcosRobotType(const std::string& subclass)> type_of;
    std::string name = "robot";         ///< RobotInfo::name
    std::unique_ptr<ScanSource> laser;  ///< null: that of a simulator, if the type has a laser
    bool requests_laser = true;         ///< false: a simulator is not asked for scans
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
    std::function<bool()> interrupted = [] { return false; };                 ///< ends the waits
  };
  static constexpr std::chrono::seconds kHandshakeMax{15};

  /// Connects, enables the motors, and waits for the first readings. Logs what the robot is, and which sensors of its
  /// type it lacks. @throws RobotLinkError @throws ConfigError for an unknown type
  ArcosHardware(std::unique_ptr<ByteChannel> channel, Options options);
  /// Stops the robot, and closes the session.
  ~ArcosHardware() override;

  const RobotInfo& info() const override { return info_; }
  const std::vector<std::string>& robots() const override { return names_; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override { command_ = command; }
  const Command& lastCommand() const override { return command_; }
  void send(const std::string& to, const std::string& text) override;
  BaseLink* base() override { return this; }
  BaseState baseState() const override { return base_; }
  void enableMotors(bool on) override;
  void enableSonar(bool on) override;

  bool nextStep() override;
  /// The destructor does not wait.
  void close(const std::function<void()>& each_step = [] {}) override;
  /// Number of SIPs received. Several that arrive together are one step.
  std::uint64_t sips() const { return client_.sips(); }

 private:
  void connect();
  void describe(ArcosRobotType type);
  void configure();
  /// Sends the command, and waits for a step. @return false when `is_over` does
  bool awaitStep(const std::function<bool()>& is_over);
  void sendCommand();
  void sendGrip();
  bool canCarryScans(const SensorInfo& laser) const;
  void processArrived(const std::string& bytes);
  bool isStepComplete() const;
  void takeReadings();
  void takeOdometry();
  void takeSonar(Measurement& measurement) const;
  void takeScan(const SensorInfo& laser, Measurement& measurement);
  void takeBumpers(const SensorInfo& bumper, Measurement& measurement) const;
  void takeBaseState();

  std::unique_ptr<ByteChannel> channel_;
  Options options_;
  ArcosClient client_;
  arcos::Parameters parameters_;
  RobotInfo info_;
  std::vector<std::string> names_;
  Readings readings_;
  Command command_;
  bool has_closed_gripper_ = false;
  BaseState base_;
  bool motors_wanted_ = true;
  bool has_simulated_laser_ = false;
  bool is_closed_ = false;
  int low_battery_sips_ = 0;                   ///< in a row
  bool has_laser_answered_ = true;             ///< in the last step
  bool was_silent_ = false;                    ///< for kSilenceWarning before the last step
  double unsent_mmps_ = 0, unsent_degps_ = 0;  ///< rounded off the commands so far
  std::uint64_t sips_taken_ = 0, scans_taken_ = 0;
  arcos::Sip last_sip_;
  mrpt::math::TPose2D board_from_start_, board_from_robot_;
};

}  // namespace robosim
