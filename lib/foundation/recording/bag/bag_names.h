#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bags/bag.h"

namespace robosim {

/// A topic that is read, by its name and type.
struct BagName {
  std::string robot;     ///< "robot1"; "robot" without a namespace
  std::string sensor;    ///< label on the robot: "laser" of the topic "scan", "odometry" of "odom", else as the topic
  bool is_part = false;  ///< of a ring: the topic ends in "range_N"
  std::uint16_t part = 0;
};

/// What the recording says of its robots besides names of topics.
struct BagNamespaces {
  std::set<std::string> with_transforms;  ///< "robot1", of "/robot1/tf" and of frames such as "robot1/base_link"
  bool has_shared_frames = false;         ///< frames without such a prefix on /tf or /tf_static
};

/// Names of the topics of BagUse::observation and odometry (doc/ros2.md, "Recordings of other programs"). The first
/// part of a topic's name is its robot, unless the recording has one robot:
///
/// - Of topics with and without a namespace, a namespace is a robot only if it has transforms of its own.
/// - So are, of several namespaces whose frames are in one tree, those of a recording with at most one Odometry.
///
/// Labels are unique for each robot and type: of further topics, they are the whole names.
std::vector<BagName> bagNames(std::span<const BagTopic> topics, const BagNamespaces& namespaces);

}  // namespace robosim
