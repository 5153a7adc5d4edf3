#pragma once
#include <functional>

#include "robosim/cli11_names.h"
#include "run/local_run.h"
#include "run/run_outputs.h"

namespace robosim {

/// Shows a run in a window, which steps and observes it, until the window is closed or a signal ends it.
/// @param speed simulated seconds per second; 0: unlimited
/// @return why the run ended
using RunWindow =
    std::function<EndedBy(LocalRun& run, const RunArguments& arguments, double speed, RunOutputs& outputs)>;

/// Adds the subcommand `run`.
/// @param window of --view; null in the executable that has no windows
void addRunCommand(CLI::App& program, const RunWindow& window);

}  // namespace robosim
