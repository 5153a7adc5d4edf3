#pragma once
#include "robosim/cli11_names.h"

namespace robosim {

/// @name The benchmarks, one file each; each function adds a subcommand to the program
///@{
void addArcosBenchmark(CLI::App& program);
void addCameraBenchmark(CLI::App& program);
void addErrorsBenchmark(CLI::App& program);
void addLearnBenchmark(CLI::App& program);
void addMapsBenchmark(CLI::App& program);
void addNetworkBenchmark(CLI::App& program);
void addOdometryBenchmark(CLI::App& program);
void addRaycastBenchmark(CLI::App& program);
void addRecordingBenchmark(CLI::App& program);
void addSpeedBenchmark(CLI::App& program);
void addViewBenchmark(CLI::App& program);
///@}

}  // namespace robosim
