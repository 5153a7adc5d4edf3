#include <CLI/CLI.hpp>

#include "robosim/subcommands.h"

namespace robosim {

void addBench(CLI::App& program) {
  auto* bench = program.add_subcommand("bench", "Measure: how well and how fast");
  bench->require_subcommand(1);
  addBenchCamera(*bench);
  addBenchGold(*bench);
  addBenchMaps(*bench);
  addBenchNetwork(*bench);
  addBenchSpeed(*bench);
  addBenchView(*bench);
}

}  // namespace robosim
