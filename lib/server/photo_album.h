#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hardware/readings.h"

namespace robosim {

/// The newest picture of each camera that somebody watches: a camera takes one in some steps only, and a viewer does
/// not see each step.
class PhotoAlbum {
 public:
  struct Photo {
    std::uint64_t step = 0;
    std::string jpeg;
  };

  /// Keeps the pictures in a robot's readings of a step.
  void note(std::size_t robot, const Readings& readings);
  /// A camera's newest picture, by the robot and the camera's place among its sensors; null when there is none.
  const Photo* find(std::size_t robot, std::size_t slot) const;
  void clear() { photos_.clear(); }

 private:
  std::map<std::pair<std::size_t, std::size_t>, Photo> photos_;
};

}  // namespace robosim
