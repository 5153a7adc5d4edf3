#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "geometry/shapes/solid.h"
#include "hardware/sensor_info.h"
#include "world/world.h"

namespace robosim {

/// An event of a run at a place.
struct RunEvent {
  enum class Kind { gold, message, stall };  ///< found gold; sent a message; was stopped by an obstacle
  Kind kind;
  std::size_t robot;
  mrpt::math::TPoint2D at;  ///< of the robot, world frame
};

/// What a range sensor measured, in the world frame [m].
struct SensedArea {
  SensorKind kind;
  std::vector<std::vector<mrpt::math::TPoint2D>> free{};  ///< freeAreas()
  std::vector<mrpt::math::TPoint2D> echoes{};             ///< within the sensor's range
};

/// Separates two pieces of a path, between which the way is unknown: the robot was absent, or moved to another place.
inline const mrpt::math::TPoint2D kPathGap{std::numeric_limits<double>::quiet_NaN(),
                                           std::numeric_limits<double>::quiet_NaN()};
inline bool isGap(const mrpt::math::TPoint2D& point) { return std::isnan(point.x); }

/// Content of a plan or figure. Vectors by robot are in the world's order, or empty.
struct DrawnRun {
  std::string title{};  ///< empty: the world's name
  /// Of each robot's centre, world frame; may be empty. Pieces are separated by kPathGap.
  std::vector<std::vector<mrpt::math::TPoint2D>> paths{};
  /// Final poses; a robot without one is not drawn.
  std::vector<std::optional<mrpt::math::TPose2D>> world_from_robot{};
  std::vector<RunEvent> events{};
  std::vector<SensedArea> sensed{};
  bool has_names = true;  ///< whether the names of robots and hot objects are written
};

/// The area that a picture of a run covers: the world's bounds, every object, map and path.
Bounds2D areaOf(const World&, const DrawnRun&);

}  // namespace robosim
