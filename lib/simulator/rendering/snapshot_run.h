#pragma once
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "rendering/drawn_run.h"
#include "rendering/run_paths.h"
#include "robots/fleet.h"
#include "robots/run_snapshot.h"
#include "robots/view_layers.h"

namespace robosim {

/// Part of a robot's path, for a figure.
struct DrawnPath {
  std::vector<mrpt::math::TPoint2D> points;  ///< pieces separated by kPathGap
  std::vector<double> times_s;               ///< of the points
};
/// A robot's path within a time range, without its end at a present robot.
DrawnPath drawnPath(std::size_t robot, const RunPaths& paths, double from_s, double to_s, bool is_present);

/// The snapshot without the robots that are not shown: they are absent in it. They are only in views, not in the
/// pictures of robots' cameras.
RunSnapshot onlyShown(RunSnapshot snapshot, const ViewLayers& layers);

/// Content of a figure of one step: the paths so far, the present robots, and what their range sensors measured. Robots
/// that were stopped by an obstacle, have found gold or sent a message have the mark of that event.
/// @param layers what to show, but the density, which depends on the world: densityOf()
/// @param events so far, of which those from layers.paths_from_s to the snapshot are marked; null: those of the
/// snapshot
DrawnRun drawnRun(const Fleet&, const RunSnapshot&, const RunPaths&, const ViewLayers& layers,
                  const RunEvents* events = nullptr);
/// Adds what happened in a step: stalls that begin, gold that is found, messages that are received.
void addEvents(RunEvents&, const Fleet&, const RunSnapshot&);

}  // namespace robosim
