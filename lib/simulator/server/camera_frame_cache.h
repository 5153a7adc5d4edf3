#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "hardware/readings.h"

namespace robosim {

/// Cache of the newest picture of each camera whose robot has at least one viewer. Needed because a camera takes a
/// picture in some steps only, and a viewer does not receive every step.
class CameraFrameCache {
 public:
  struct Picture {
    std::uint64_t step = 0;
    Image image;
  };

  /// Updates the cache for one step: stores the pictures in the readings of the watched robots, and drops the pictures
  /// of all other robots, which would be outdated at the next request.
  /// @param watched robots that have a viewer; indices beyond `readings` are ignored
  /// @param readings by robot
  void update(const std::set<std::uint32_t>& watched, const std::vector<Readings>& readings);
  /// Newest picture of a camera, by robot and sensor index; null when there is none.
  const Picture* find(std::size_t robot, std::size_t slot) const;
  void clear() { pictures_.clear(); }

 private:
  void note(std::size_t robot, const Readings& readings);

  std::map<std::pair<std::size_t, std::size_t>, Picture> pictures_;
};

}  // namespace robosim
