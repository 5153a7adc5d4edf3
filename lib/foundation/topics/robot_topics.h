#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TPose3D.h>

#include "base/ros_distribution.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"
#include "hardware/robot_velocity.h"
#include "ros/message_template.h"
#include "topics/topic.h"

namespace robosim {

/// Takes messages of topics.
class TopicSink {
 public:
  virtual ~TopicSink() = default;
  /// Whether messages of a topic are taken; others are not made.
  virtual bool wants(std::size_t /*topic*/) const { return true; }
  /// @param topic index in RobotTopics::topics() @returns the bytes to which the message is appended
  virtual std::vector<std::uint8_t>& beginMessage(std::size_t topic) = 0;
  /// The message is complete.
  virtual void endMessage() = 0;
  /// A message whose bytes are at hand.
  virtual void put(std::size_t topic, std::span<const std::uint8_t> message) {
    auto& bytes = beginMessage(topic);
    bytes.insert(bytes.end(), message.begin(), message.end());
    endMessage();
  }
};

/// How the frames of several robots differ.
enum class FrameNames {
  prefixed,  ///< "<robot>/odom", in one tree on /tf and /tf_static
  plain,     ///< "odom", in a tree for each robot on /<robot>/tf and /<robot>/tf_static, as Nav2 expects it
};

/// The form of the topics of robots.
struct TopicForm {
  FrameNames frames = FrameNames::prefixed;
  RosDistribution distribution = RosDistribution::jazzy;
};

/// What is true of a robot, and no sensor measures.
struct RobotTruth {
  mrpt::math::TPose2D world_from_robot;
  RobotVelocity velocity;
};

/// The topics of a robot, below "/<robot>/", and their messages of a step (doc/ros2.md). Frames are "<robot>/odom",
/// "<robot>/base_link" and "<robot>/<sensor>" (REP 105), or without the prefix; ranges follow REP 117.
class RobotTopics {
 public:
  explicit RobotTopics(const RobotInfo& robot, const TopicForm& form = {});

  const std::vector<Topic>& topics() const { return topics_; }
  /// Poses of the sensors that do not pan in the robot's frame, for /tf_static.
  const std::vector<ros::TransformStamped>& mounts() const { return mounts_; }
  /// Index of /tf in topics(), which all robots have in common if frames are prefixed.
  std::size_t transformTopic() const { return transform_; }
  /// The topic of mounts().
  const Topic& staticTopic() const { return static_; }

  /// Passes the messages of a step to the sink; none of a sensor that keeps its reading.
  /// @param kept by sensor: whether it does; of no sensor beyond its end
  void write(const Readings& readings, const std::optional<RobotTruth>& truth, const std::optional<Command>& command,
             std::span<const std::uint8_t> kept, TopicSink& sink);

 private:
  /// The messages of a sensor.
  struct SensorMessages {
    std::size_t topic = 0;  ///< the first one
    std::string frame;
    mrpt::math::TPose3D robot_from_frame;
    bool is_clockwise = false;                   ///< order of the readings
    std::size_t scan_size = 0;                   ///< number of ranges of a LaserScan; 0 for separate ranges
    std::vector<ros::MessageTemplate> of_topic;  ///< empty before the first one of a sensor with any number of values
    std::size_t size = 0;                        ///< number of values in that message
    std::vector<std::string> frames_of_beams;    ///< of sensors with separate ranges
  };
  /// The changing transform of a sensor's frame, or of a beam's; of the odometry, that of the robot's frame.
  struct MovedFrame {
    std::size_t sensor = 0, beam = 0;
    std::array<double, 7> pose{};  ///< x, y, z and the rotation's x, y, z, w
  };
  struct Encoder;

  std::size_t addTopic(const std::string& name, const ros::MessageType& type, TopicDelivery delivery);
  void addSensor(const SensorInfo& sensor);
  void addRangeSensor(const SensorInfo& sensor, const std::string& part, SensorMessages& made);
  void addMount(const std::string& frame, const mrpt::math::TPose3D& pose);
  void makeTransformMessage();

  RosDistribution distribution_;
  std::string name_, frame_prefix_, base_frame_, odom_frame_;
  std::shared_ptr<const std::vector<SensorInfo>> sensors_;
  std::vector<Topic> topics_;
  Topic static_;
  std::vector<ros::TransformStamped> mounts_;
  std::vector<SensorMessages> of_sensor_;
  std::size_t transform_ = 0, truth_ = 0, command_ = 0, inbox_ = 0;
  ros::MessageTemplate truth_message_, command_message_, transform_message_;
  std::vector<MovedFrame> moved_, in_transform_message_;
  std::vector<float> points_;    ///< x, y, z of a step; reused
  std::vector<double> numbers_;  ///< reused
};

/// The message of /tf_static, or of /<robot>/tf_static of a single robot with plain frames: poses of the sensors of
/// robots. Without transforms if there are none.
TopicMessage staticTransforms(std::span<const RobotTopics> robots, std::uint64_t time_ns);

/// The pose of a body in plan.
ros::Pose poseOf(const mrpt::math::TPose2D& pose);
/// The yaw of a rotation about any axis, which need not be normalised [rad, (-π, π]]; 0 for none.
double yawOf(const ros::Quaternion& rotation);

}  // namespace robosim
