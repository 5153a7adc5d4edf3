#pragma once
#include <filesystem>
#include <string>

#include "rendering/drawn_run.h"
#include "rendering/picture_format.h"
#include "rendering/plan_view.h"
#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// The view of the area that a plan covers; the longer side sets the scale.
PlanView planView(const World&, const DrawnRun&);

/// Draws a run from above: maps and objects in their colours, hot ones with a glow and their name; each robot's path in
/// a distinct colour, with a ring at its start and the robot at its end; robot names where there is room; a grid and a
/// scale in metres.
/// @return the file, whose bytes depend only on the arguments and the installed font
std::string planPicture(PictureFormat, const World&, const Fleet&, const DrawnRun&);

/// The robots of a world at their starts.
DrawnRun startOf(const Fleet&);

/// Writes the plan of a run as a PNG, SVG or PDF file, according to its name.
/// @throws ConfigError when the file cannot be created, and std::runtime_error when the disk is full; in both cases no
/// partial file remains.
void writePlan(const std::filesystem::path& file, const World&, const Fleet&, const DrawnRun&);

/// Checks the file name before a long run.
/// @throws ConfigError when the name does not end in .png, .svg or .pdf, or nothing can be written there.
void checkPlanFile(const std::filesystem::path& file);

}  // namespace robosim
