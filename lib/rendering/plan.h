#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include "rendering/plan_view.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// Path of each robot's centre, world frame [m]; indexed by robot, in the world's order.
using PlanPaths = std::span<const std::vector<mrpt::math::TPoint2D>>;

/// The area that a plan of a run covers: the world's bounds, every object, map and path.
Bounds2D planArea(const World&, PlanPaths paths);
/// The view of that area; the longer side sets the scale.
PlanView planView(const World&, PlanPaths paths);

/// Draws a run from above to a PNG file: maps and objects in their colours, hot ones with a glow and their name; each
/// robot's path in a distinct colour, with a ring at its start and the robot at its end; robot names where there is
/// room; a grid and a scale in metres.
/// @param paths may be empty, as may each path in it: then no paths are drawn
/// @param world_from_robot final poses
/// @throws ConfigError when the file cannot be created, and std::runtime_error when the disk is full; in both cases no
/// partial file remains.
void writePlan(const std::filesystem::path& png, const World&, const Fleet&, PlanPaths paths,
               std::span<const mrpt::math::TPose2D> world_from_robot);

/// Checks the file name before a long run.
/// @throws ConfigError when the name does not end in .png, or nothing can be written there.
void checkPlanFile(const std::filesystem::path& png);

}  // namespace robosim
