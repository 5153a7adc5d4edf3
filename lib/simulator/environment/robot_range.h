#pragma once
#include <cstddef>

namespace robosim {

/// Range of robots: [begin, end) of the world's list.
struct RobotRange {
  std::size_t begin = 0, end = 0;
  bool operator==(const RobotRange&) const = default;

  bool empty() const { return begin >= end; }
  bool contains(std::size_t robot) const { return robot >= begin && robot < end; }
};

/// Number of robots that one thread takes at a time.
constexpr std::size_t kRobotChunk = 64;

/// The robots of a process that shares a run with others.
struct RobotShare {
  RobotRange kept;      ///< whose readings it needs
  RobotRange digested;  ///< that it adds to the run's digest: kept ones, and whole chunks of RunDigest
};

}  // namespace robosim
