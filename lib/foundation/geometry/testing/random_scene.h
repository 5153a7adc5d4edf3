#pragma once
#include <cstddef>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "base/random.h"
#include "geometry/shapes/ray.h"
#include "geometry/shapes/solid.h"

namespace robosim {

/// Distribution of random solids for tests and benchmarks. Sizes are log-uniform, so that small, medium and large ones
/// are all common.
struct SolidSpread {
  Bounds2D area{-10, 10, -10, 10};  ///< of the centres
  double size_min_m = 0.05;         ///< smallest length, width or diameter
  double size_max_m = 3;            ///< largest of these
  double z_min_m = 0;               ///< lowest underside
  double z_max_m = 2;               ///< highest top
  double circle_share = 0.5;        ///< fraction of circles; the rest are boxes
  /// When > 0, corners, tops and extreme points of circles lie on multiples of this, and boxes are rotated by quarter
  /// turns only. Then faces touch, rays run along faces and through corners, and all sums of doubles are exact (for a
  /// power of two).
  double lattice_m = 0;
};

/// The outline of an area, as a box.
Outline rectangle(const Bounds2D&);

mrpt::math::TPoint2D randomPoint(Rng&, const Bounds2D&);
Circle randomCircle(Rng&, const SolidSpread&);
OrientedBox randomBox(Rng&, const SolidSpread&);
Outline randomOutline(Rng&, const SolidSpread&);
Solid randomSolid(Rng&, const SolidSpread&);
std::vector<Solid> randomSolids(Rng&, std::size_t count, const SolidSpread&);

/// A planar ray with a random origin in `area`, a height between z_min_m and z_max_m, and a random direction.
Ray randomPlanarRay(Rng&, const Bounds2D& area, double z_min_m, double z_max_m);
/// The same with a random direction in space.
Ray randomRay(Rng&, const Bounds2D& area, double z_min_m, double z_max_m);

}  // namespace robosim
