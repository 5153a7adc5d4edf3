#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "maze/grid.h"
#include "maze/surface_point.h"

namespace robosim {

/// Surfaces seen so far: for each cell, and each side of a wall in it, the mean of the points seen there and of their
/// normals. Thin walls have their two sides in the same cells.
class SurfaceMap {
 public:
  explicit SurfaceMap(double cell_m) : cells_(cell_m) {}

  /// Adds a point. Points beyond the largest grid are ignored.
  void add(const SurfacePoint& point);
  /// The surface near a point that faces the same way and is nearest along the normal; nullopt if there is none that
  /// was seen repeatedly.
  std::optional<SurfacePoint> nearest(const SurfacePoint& point) const;
  void reset();

 private:
  struct Patch {
    mrpt::math::TPoint2D point, normal;
    int count = 0;
    std::int32_t next = -1;  ///< the next patch of its cell
  };
  struct Head {
    std::int32_t first = -1;
  };

  Grid<Head> cells_;
  std::vector<Patch> patches_;
};

}  // namespace robosim
