#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "hardware/robot_info.h"
#include "ros/message_template.h"
#include "topics/topic.h"

namespace robosim {

/// The robots of a run as markers on the topic /robots, in the frame `map`: a cylinder with an arrow for each, at its
/// true pose.
class RobotMarkers {
 public:
  static Topic topic();

  /// Adds a robot, with the next index.
  void add(const RobotInfo& robot);
  std::size_t size() const { return robots_.size() / kMarkers; }
  /// The encoded message of a step; valid until the next call.
  /// @param poses by robot, in the world's frame; nullopt for one that is not in the world
  std::span<const std::uint8_t> message(std::span<const std::optional<mrpt::math::TPose2D>> poses,
                                        std::uint64_t time_ns);

 private:
  static constexpr std::size_t kMarkers = 2;  ///< of a robot

  std::vector<ros::Marker> robots_;  ///< kMarkers for each
  ros::MessageTemplate message_;     ///< empty after a robot was added
};

}  // namespace robosim
