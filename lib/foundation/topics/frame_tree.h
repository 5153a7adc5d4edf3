#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/poses/CPose3D.h>

#include "ros/messages.h"

namespace robosim {

/// A pose of ROS; a rotation of length 0, as of a message that leaves it out, is none.
mrpt::poses::CPose3D toPose(const ros::Vector3& translation, const ros::Quaternion& rotation);
mrpt::poses::CPose3D toPose(const ros::Pose& pose);
/// Whether all numbers of a pose are finite.
bool isFinite(const ros::Point& position, const ros::Quaternion& rotation);
bool isFinite(const ros::Vector3& translation, const ros::Quaternion& rotation);

/// The tree of frames of transforms (tf2), with their poses over time.
class FrameTree {
 public:
  /// A pose of a frame in its parent's.
  struct Stamped {
    std::int64_t time_ns = 0;
    ros::Transform transform;
  };

  /// Adds the pose of a frame. One that is not finite is left out.
  /// @param is_static whether it is valid at all times; the last one of a frame is
  void add(const ros::TransformStamped& transform, std::int64_t time_ns, bool is_static);
  /// Call after the last add().
  void sort();

  bool isEmpty() const { return frames_.empty(); }
  bool contains(const std::string& frame) const;
  /// The pose of a frame in another one at a time, by the latest transforms that are not later, or else the first ones;
  /// nullopt when transforms do not connect them.
  std::optional<mrpt::poses::CPose3D> find(const std::string& in, const std::string& frame, std::int64_t time_ns) const;
  /// The frame that a frame's transforms are in; empty for none.
  const std::string& parentOf(const std::string& frame) const;
  /// The poses of a frame in its parent's in the order of time, without those that repeat the one before.
  const std::vector<Stamped>& posesOf(const std::string& frame) const;
  /// Names of the frames with a parent.
  std::vector<std::string> names() const;

 private:
  struct Frame {
    std::string parent;
    bool is_static = false;
    std::vector<Stamped> poses;
  };

  std::map<std::string, Frame> frames_;  ///< by name
};

/// A frame's name without the slash of ROS 1.
std::string frameName(const std::string& name);

}  // namespace robosim
