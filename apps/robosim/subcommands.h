#pragma once
#include "robosim/cli11_names.h"

namespace robosim {

/// How a run of the program ends.
enum ExitCode { kDone = 0, kBadInput = 1, kRunFailed = 2 };

/// @name The subcommands, one file each
/// Each adds itself to the program. What it throws says how it ended: ConfigError and std::invalid_argument for bad
/// input, anything else for a run that failed.
///@{
void addRun(CLI::App& program);
void addServe(CLI::App& program);
void addRobot(CLI::App& program);
void addRemote(CLI::App& program);
void addGeometry(CLI::App& program);
void addControl(CLI::App& program);
void addView(CLI::App& program);
void addReplay(CLI::App& program);
void addCheck(CLI::App& program);
void addExport(CLI::App& program);
void addBench(CLI::App& program);
///@}

/// `robosim bench camera`, `… gold`, `… maps`, `… network`, `… speed` and `… view`
void addBenchCamera(CLI::App& bench);
void addBenchGold(CLI::App& bench);
void addBenchMaps(CLI::App& bench);
void addBenchNetwork(CLI::App& bench);
void addBenchSpeed(CLI::App& bench);
void addBenchView(CLI::App& bench);

/// The way for a subcommand to end with a code of its own, after it has said why.
struct Exit {
  ExitCode code;
};

}  // namespace robosim
