#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "dds/participant.h"
#include "hardware/base_link.h"
#include "hardware/real_robot.h"
#include "topics/frame_tree.h"
#include "topics/sensor_readings.h"

namespace robosim {

/// A robot that speaks ROS 2: a real one, one of RoboSim (serve --ros2), or one of another simulator. It publishes
/// nav_msgs/Odometry, and drives by geometry_msgs/Twist or TwistStamped on `cmd_vel`; its other sensors are those of a
/// robot type of which it has the topics (sourcesOf()). Scans have the beams of the first message, at the place that
/// /tf and /tf_static give, else at that of the type's scanner.
///
/// A time step is 0.1 s of the robot's own clock, the stamps of its odometry, so that a simulated robot may be faster
/// or slower than real time. The robot stands, whatever its controller commands, while a range sensor's readings are
/// old or motors are disabled; BaseState::stop_reason and the log state the reason. It receives a command in each step;
/// a robot that is silent is sent one to stop.
class Ros2Hardware final : public RealRobot, public BaseLink {
 public:
  using Clock = std::chrono::steady_clock;

  struct Options {
    std::string prefix = {};     ///< namespace of the topics, "/robot1"; empty for none
    RobotInfo type;              ///< of which the robot is
    std::string name = "robot";  ///< RobotInfo::name
    /// Names of topics in place of those below the prefix: "scan" → "/base_scan".
    std::map<std::string, std::string> topics = {};
    /// Time in which messages of the same moment follow that of the odometry.
    std::chrono::milliseconds together{20};
    std::string where = {};                                                   ///< "domain 0", for messages
    std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line
    std::function<bool()> interrupted = [] { return false; };                 ///< ends the waits
  };
  static constexpr double kPeriod_s = 0.1;
  static constexpr std::chrono::seconds kAppearanceMax{15};  ///< of the robot's first messages
  /// Age of a reading of a range sensor, or three times its interval.
  static constexpr std::uint64_t kReadingMax_ns = 500'000'000;

  /// Waits for the robot's odometry and scans. Logs which sensors of its type it lacks. @throws RobotLinkError when
  /// there is no robot @throws Interrupted
  Ros2Hardware(std::shared_ptr<dds::Participant> participant, Options options);
  /// Sends a command to stop.
  ~Ros2Hardware() override;

  const RobotInfo& info() const override { return info_; }
  const std::vector<std::string>& robots() const override { return names_; }
  const Readings& readings() const override { return readings_; }
  void command(const Command& command) override { command_ = command; }
  const Command& lastCommand() const override { return command_; }
  void send(const std::string& to, const std::string& text) override;
  BaseLink* base() override { return this; }
  BaseState baseState() const override { return base_; }
  /// ROS 2 has no such command: without motors, the robot is sent commands to stand.
  void enableMotors(bool on) override { motors_wanted_ = on; }
  void enableSonar(bool) override {}

  bool nextStep() override;
  void close(const std::function<void()>& each_step = [] {}) override;

 private:
  /// A topic of a sensor, and its last message.
  struct Channel {
    std::string topic;
    const ros::MessageType* type = nullptr;
    std::size_t sensor = 0;  ///< in info_.sensors
    std::size_t beam = 0;
    std::uint64_t readings_max_ns = 0;  ///< age from which on the robot stops; 0: any
    std::uint64_t read_ns = 0;          ///< stamp of the last message that could be read
    std::string fault;                  ///< why the last message could not be read; empty if it could
    /// @name Guarded by mutex_
    ///@{
    std::vector<std::uint8_t> message;
    bool is_new = false;
    std::uint64_t stamp_ns = 0;  ///< of the robot's clock
    std::uint64_t interval_ns = 0;
    Clock::time_point arrived_at{};
    ///@}
    std::unique_ptr<dds::Reader> reader;
  };

  std::string topicName(const std::string& below) const;
  void subscribe();
  void receive(Channel& channel, const dds::Sample& sample);
  void awaitRobot();
  void describe();
  /// Gives a scanner the beams of its first message. @return false for one that is no scan, which is logged
  bool becomeScanner(SensorInfo& sensor, const Channel& channel);
  mrpt::math::TPose3D mountOf(const ros::LaserScan& scan, const SensorInfo& of_type);
  bool awaitStep(const std::function<bool()>& is_over);
  /// @name With mutex_ locked
  ///@{
  bool isOdometryDue() const;
  bool isStepComplete() const;
  ///@}
  void sendCommand();
  void sendSpeeds(double speed_mps, double turn_radps, double lateral_mps = 0);
  void takeReadings();
  void takeBaseState();
  /// Which range sensor's readings are old; empty for none.
  std::string oldReading();

  std::shared_ptr<dds::Participant> participant_;
  Options options_;
  RobotInfo info_;
  std::vector<std::string> names_;
  Readings readings_;
  Command command_;
  BaseState base_;
  bool motors_wanted_ = true;
  bool is_closed_ = false;
  bool was_silent_ = false;

  std::mutex mutex_;
  std::condition_variable arrived_;
  FrameTree frames_;  ///< guarded by mutex_
  std::string base_frame_;
  std::uint64_t start_ns_ = 0, step_ns_ = 0;  ///< stamps of the odometry at the start and in the last step
  bool has_taken_ = false;
  std::optional<mrpt::math::TPose2D> odom_from_start_;
  std::unique_ptr<dds::Writer> twist_, twist_stamped_;
  /// Readers are destroyed before what they use.
  std::vector<std::unique_ptr<Channel>> channels_;  ///< the first one is the odometry's
  std::vector<std::unique_ptr<Channel>> unread_;    ///< of sensors that the robot does not have
  std::vector<std::unique_ptr<dds::Reader>> transforms_;
};

}  // namespace robosim
