#pragma once

namespace robosim {

/// Release of ROS 2 whose messages are made. They differ in Range, which has no variance in Humble.
enum class RosDistribution { jazzy, humble };

}  // namespace robosim
