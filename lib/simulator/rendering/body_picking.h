#pragma once
#include <optional>
#include <string>

#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"
#include "rendering/pane_projection.h"
#include "robots/fleet.h"
#include "robots/run_snapshot.h"

namespace robosim {

/// A robot or an object under the mouse.
struct PickedBody {
  std::string name;
  bool is_robot = false;
  Body body;          ///< at its present place; a robot's is the disc that collides
  double at_z_m = 0;  ///< height of the point that was picked
};

/// What is seen at a pixel: the nearest robot or object in the line of sight. From above, robots are drawn over the
/// objects, and are at least 6 pixels in radius. Walls of maps are not picked, and do not cover what is behind them.
std::optional<PickedBody> pickBody(const PaneProjection& pane, const mrpt::math::TPoint2D& pixel,
                                   const RunSnapshot& snapshot, const LoadedWorld& world);

/// The robot or object of this name in the world at present.
std::optional<PickedBody> bodyNamed(const std::string& name, const RunSnapshot& snapshot, const LoadedWorld& world);

}  // namespace robosim
