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

/// The way of each robot's centre, world frame [m]; indexed by robot, in the world's order.
using PlanPaths = std::span<const std::vector<mrpt::math::TPoint2D>>;

/// What a plan of a run shows: the world's bounds, every object, map and way.
Bounds2D planArea(const World&, PlanPaths paths);
/// The same, on a scale that the longer side sets.
PlanView planView(const World&, PlanPaths paths);

/// Draws a run from above to a PNG file: maps and objects in their colours, hot ones with a glow and their name; the
/// way of every robot in a colour of its own, from a ring at its start to the robot as it stands at the end, with its
/// name where there is room; a grid and a scale in metres.
/// @param paths may be empty, as may each path in it: then no ways are drawn
/// @param world_from_robot where the robots stand at the end
/// @throws ConfigError when there can be no such file, and std::runtime_error when there is no room for it; nothing
/// half-written stands under its name then.
void writePlan(const std::filesystem::path& png, const World&, const Fleet&, PlanPaths paths,
               std::span<const mrpt::math::TPose2D> world_from_robot);

/// Tells before a long run what writePlan() would tell after it.
/// @throws ConfigError when the name does not end in .png, or nothing can be written there.
void checkPlanFile(const std::filesystem::path& png);

}  // namespace robosim
