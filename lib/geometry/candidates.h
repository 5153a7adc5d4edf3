#pragma once
#include <cstdint>
#include <span>

#include "geometry/rough_solid.h"

namespace robosim {

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
