#include "robosim/bench_arguments.h"

#include <CLI/CLI.hpp>

#include "benchmark/sweep.h"
#include "robosim/arguments.h"
#include "run/local_run.h"

namespace robosim {

void addRunsAndSeed(CLI::App& command, int& runs, std::uint64_t& seed) {
  command.add_option("--runs", runs, "runs of each controller in each world, with different start poses")
      ->check(wholeNumberIn(1, 1000000))
      ->type_name("NUMBER")
      ->capture_default_str();
  command.add_option("--seed", seed, "seed of the first run, incremented by 1 for each further run")
      ->check(seedNumber())
      ->type_name("NUMBER")
      ->capture_default_str();
}

void addControllersOption(CLI::App& command, std::vector<std::string>& controllers) {
  command
      .add_option("--controller", controllers,
                  "controller of all robots, instead of those in the world, as NAME or \"NAME PARAMETER=VALUE …\"; "
                  "repeatable. \"NAME PARAMETER=1,2,3\" compares values")
      ->type_name("CONTROLLER")
      ->allow_extra_args(false);
}

std::vector<std::string> allControllers(const std::vector<std::string>& given) {
  std::vector<std::string> all;
  for (const auto& text : given) {
    for (const auto& choice : expandedChoices(text)) {
      checkController(choice);
      all.push_back(choice);
    }
  }
  if (all.empty()) all.emplace_back();
  return all;
}

}  // namespace robosim
