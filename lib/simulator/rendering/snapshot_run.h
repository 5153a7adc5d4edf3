#pragma once
#include "rendering/drawn_run.h"
#include "rendering/run_paths.h"
#include "rendering/top_view.h"
#include "robots/fleet.h"
#include "robots/run_snapshot.h"

namespace robosim {

/// Content of a figure of one step: the paths so far, the present robots, and what their range sensors measured. Robots
/// that were stopped by an obstacle, have found gold or sent a message have the mark of that event.
/// @param layers what to show
/// @param events so far, of which those from layers.paths_from_s to the snapshot are marked; null: those of the
/// snapshot
DrawnRun drawnRun(const Fleet&, const RunSnapshot&, const RunPaths&, const TopViewLayers& layers,
                  const RunEvents* events = nullptr);
/// Adds what happened in a step: stalls that begin, gold that is found, messages that are received.
void addEvents(RunEvents&, const Fleet&, const RunSnapshot&);

}  // namespace robosim
