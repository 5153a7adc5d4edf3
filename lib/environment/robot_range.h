#pragma once
#include <cstddef>

namespace robosim {

/// Range of robots: [begin, end) of the world's list.
struct RobotRange {
  std::size_t begin = 0, end = 0;
};

}  // namespace robosim
