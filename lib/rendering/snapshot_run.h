#pragma once
#include "rendering/drawn_run.h"
#include "rendering/run_paths.h"
#include "rendering/top_view.h"
#include "robots/fleet.h"
#include "robots/run_snapshot.h"

namespace robosim {

/// Content of a figure of one step: the paths so far, the present robots, and what their range sensors measured. Robots
/// that are stopped by an obstacle, or have found gold, have the mark of that event.
/// @param layers what to show
DrawnRun drawnRun(const Fleet&, const RunSnapshot&, const RunPaths&, const TopViewLayers& layers);

}  // namespace robosim
