#pragma once
#include <string>
#include <vector>

#include "environment/environment.h"

namespace robosim {

/// Worlds put together by hand, for tests.
/// An empty square from -half to half [m].
World emptyWorld(double half_m);
void addWall(World& world, double x_m, double y_m, double length_m, double width_m, double turned_rad = 0);

/// A hot pillar.
void addGold(World& world, double x_m, double y_m, double radius_m = 0.2);

/// Adds a robot that is a disc without sensors but for its odometry: speed up to 1 m/s, turn up to 2 rad/s, reached at
/// once unless other limits are given.
void addDisc(World& world, Fleet& fleet, const std::string& name, const mrpt::math::TPose2D& start,
             double radius_m = 0.25, const MotionLimits& limits = {1, 2, 1e6, 1e6, 1e6});

}  // namespace robosim
