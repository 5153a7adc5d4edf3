#pragma once
#include <cstdint>
#include <span>

#include "geometry/grid_index.h"

namespace robosim {

/// A solid in single precision, from the middle of the scene: enough to tell who may meet it. `round_m` has room for
/// what single precision loses, so that nobody who meets the solid misses this one.
struct RoughSolid {
  float x = 0, y = 0, axis_x = 1, axis_y = 0;
  float half_length_m = 0, half_width_m = 0, round_m = 0;

  static RoughSolid from(const GridItem&, const mrpt::math::TPoint2D& middle);
};

/// A place in the same way, from which someone looks.
struct RoughPlace {
  float x = 0, y = 0;
  float lost_m = 0;  ///< room for what single precision loses of the place

  /// @param spread_m how far around the place the looking starts
  static RoughPlace from(const mrpt::math::TPoint2D& place, double spread_m, const mrpt::math::TPoint2D& middle);
};

/// Some solids of a scene that a batch of rays or sectors may meet.
struct Candidates {
  static constexpr std::size_t kMost = 32;

  std::span<const std::uint32_t> indices;  ///< of them, in the two arrays; at most kMost
  const GridItem* items;
  const RoughSolid* rough;
  mrpt::math::TPoint2D middle;  ///< of the scene
  std::uint32_t first_body;     ///< the number of the first in the arrays among all bodies
  std::int64_t except;          ///< the number of a body that is left out, or a negative one
};

}  // namespace robosim
