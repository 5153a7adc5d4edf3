#include "sensors/sonar_interference.h"

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// Whether a sonar at the first robot's centre, which faces along x, receives the pings of a second robot there.
bool receives(const mrpt::math::TPose2D& second, const std::vector<Solid>& solids, double half_deg,
              double range_max_m) {
  Scene scene(solids, 2, {-20, 20, -20, 20});
  const std::vector<mrpt::math::TPose2D> poses{{0, 0, 0}, second};
  for (std::size_t i = 0; i < 2; ++i) scene.place(i, {Circle{{poses[i].x, poses[i].y}, 0.2}, {0, 0.3}});
  scene.freeze();
  const Snapshot now{.scene = scene,
                     .heat_sources = {},
                     .world_from_robot = poses,
                     .frames = {},
                     .last_motion = {},
                     .laser_pan_rad = {},
                     .time = {},
                     .seed = 1};
  return mayReceivePing(now, 0, {{0, 0, 0.1}, {1, 0, 0}}, toRadians(half_deg), range_max_m);
}

TEST(SonarInterference, ComesFromRobotsInViewOnly) {
  EXPECT_TRUE(receives({3, 1, 0}, {}, 20, 5)) << "18.4° aside";
  EXPECT_FALSE(receives({3, 1, 0}, {}, 18, 5));
  EXPECT_FALSE(receives({3, 1, 0}, {}, 20, 3)) << "3.16 m away";
  EXPECT_FALSE(receives({3, 1, 0}, {block(1.5, 0.5, 0.2, 2)}, 20, 5)) << "behind a wall";
}

}  // namespace
}  // namespace robosim
