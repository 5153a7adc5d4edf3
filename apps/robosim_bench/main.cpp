#include <CLI/CLI.hpp>

#include "robosim/command_line.h"
#include "robosim/program.h"
#include "robosim_bench/benchmarks.h"
#include "run/outputs/standard_parts.h"

int main(int argc, char** argv) {
  CLI::App program("Measures the speed and memory use of RoboSim, beside its peers where they are installed.");
  program.name("robosim_bench");
  robosim::setHelpFormat(program);
  program.set_version_flag("--version", "robosim_bench " ROBOSIM_VERSION);
  program.require_subcommand(1);
  robosim::addSpeedBenchmark(program);
  robosim::addNetworkBenchmark(program);
  robosim::addCameraBenchmark(program);
  robosim::addRaycastBenchmark(program);
  robosim::addViewBenchmark(program);
  robosim::addMapsBenchmark(program);
  robosim::addLearnBenchmark(program);
  robosim::addArcosBenchmark(program);
  robosim::addOdometryBenchmark(program);
  robosim::addErrorsBenchmark(program);
  robosim::addRecordingBenchmark(program);
  program.footer(
      "Figures and conditions: doc/performance.md.\n"
      "Try:  robosim_bench speed --workload sonar --robots 1000");
  robosim::useStandardParts();
  return robosim::execute(program, argc, argv);
}
