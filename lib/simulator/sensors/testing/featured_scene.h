#pragma once
#include <vector>

#include "sensors/floor_picture.h"
#include "sensors/sensor.h"

namespace robosim {

/// Test fixture: robots, discs of 0.2 m radius and 0.3 m height, among objects with lights, marks and colours. The
/// first robot measures.
struct FeaturedScene {
  std::vector<mrpt::math::TPose2D> robots{{0, 0, 0}};
  std::vector<Command> commands{{}};  ///< by robot; missing ones are at rest without LEDs
  std::vector<Body> objects;
  std::vector<FloorPicture> pictures;
  std::uint64_t step = 1;

  /// The values that a sensor measures.
  std::vector<double> values(const Sensor& sensor);
};

/// Bodies of objects.
Body pillarBody(double x_m, double y_m, double radius_m, double z_min_m = 0, double z_max_m = 1);
Body boxBody(const mrpt::math::TPose2D& pose, double length_m, double width_m, double z_min_m = 0, double z_max_m = 1);
Body coloured(Body body, const std::array<float, 3>& rgb);
/// A lamp of 1 cm radius and 2 cm height about a point.
Body lampAt(const mrpt::math::TPoint3D& at, double light_cd);

/// Whether the first body on the segment between two points is the object `seen` or a robot, or there is none: by a
/// search of all objects, and of all robots but the first.
/// @param robot index of the robot that is looked at; 0 for none
bool isFreeByHand(const FeaturedScene& scene, const mrpt::math::TPoint3D& from, const mrpt::math::TPoint3D& to,
                  const Body* seen, std::size_t robot = 0);

}  // namespace robosim
