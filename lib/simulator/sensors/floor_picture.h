#pragma once
#include <vector>

#include "world/world.h"

namespace robosim {

/// Whether a point is in an area or on its edge.
bool isOn(const Outline& area, const mrpt::math::TPoint2D& point);

/// A map that is painted on the floor (WorldMap::isFloor()): its cells, which take constant time, and its boxes.
class FloorPicture {
 public:
  explicit FloorPicture(const WorldMap& map);
  /// Whether a point of the floor is painted, in world frame [m].
  bool isPainted(const mrpt::math::TPoint2D& at) const;
  const std::array<float, 3>& color() const { return color_; }

 private:
  mrpt::math::TPose2D grid_from_world_;
  double cell_m_;
  std::uint32_t columns_, rows_;
  std::vector<bool> painted_;   ///< row by row, from the lowest
  std::vector<Outline> boxes_;  ///< of a map that has such, in the world
  std::array<float, 3> color_;
};

/// Those of a world, in its order.
std::vector<FloorPicture> floorPicturesOf(const std::vector<WorldMap>& maps);

}  // namespace robosim
