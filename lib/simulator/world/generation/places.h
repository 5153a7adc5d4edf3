#pragma once
#include <cstdint>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "world/world.h"

namespace robosim {

/// Places at which a robot can stand, and the ways between them.
struct Places {
  std::vector<mrpt::math::TPoint2D> at;          ///< world frame [m]
  std::vector<std::vector<std::uint32_t>> next;  ///< by place: places that can be reached from it directly
};

/// Points of a square grid that keep a distance from all objects and from the bounds, as far as they are connected:
/// the largest such set; of equal ones that with the first point.
/// @param pitch_m of the grid @param clearance_m distance to keep
Places placesAmong(const std::vector<WorldObject>& objects, const Bounds2D& bounds, double pitch_m, double clearance_m);

/// Number of steps from the nearest of some sources to every place.
class StepsFromSources {
 public:
  explicit StepsFromSources(const Places& places);
  void addSource(std::uint32_t place);
  /// The place with the most steps among those that `may_be` accepts; of equal ones the first. The number of places if
  /// none is accepted.
  template <typename Accepts>
  std::uint32_t farthest(const Accepts& may_be) const {
    auto best = static_cast<std::uint32_t>(steps_.size());
    for (std::uint32_t i = 0; i < steps_.size(); ++i) {
      if ((best == steps_.size() || steps_[i] > steps_[best]) && may_be(i)) best = i;
    }
    return best;
  }
  std::uint32_t at(std::uint32_t place) const { return steps_[place]; }

 private:
  const Places& places_;
  std::vector<std::uint32_t> steps_;
};

}  // namespace robosim
