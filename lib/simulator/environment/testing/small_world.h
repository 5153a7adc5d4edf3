#pragma once
#include <string>
#include <vector>

#include "environment/environment.h"

namespace robosim {

/// Builds small worlds for tests.
/// An empty square from -half to half [m].
World emptyWorld(double half_m);
void addWall(World& world, double x_m, double y_m, double length_m, double width_m, double turned_rad = 0);

/// Adds a box that robots push.
void addBox(World& world, const mrpt::math::TPose2D& at, double length_m, double width_m, const Movable& movable = {});

/// Adds a hot pillar.
void addGold(World& world, double x_m, double y_m, double radius_m = 0.2);

/// Adds a disc-shaped robot with odometry as its only sensor: speed up to 1 m/s, turn rate up to 2 rad/s, reached
/// immediately unless other limits are given.
void addDisc(World& world, Fleet& fleet, const std::string& name, const mrpt::math::TPose2D& start,
             double radius_m = 0.25, const MotionLimits& limits = {1, 2, 1e6, 1e6, 1e6});

}  // namespace robosim
