#include "robosim_bench/min_time.h"

#include <CLI/CLI.hpp>

#include "robosim/arguments.h"

namespace robosim {

void addMinTime(CLI::App& command, const std::string& of, double& min_s) {
  auto* option = command.add_option("--min-time", min_s, "minimum measuring time of " + of + ", seconds")
                     ->check(numberIn(1e-6, 3600))
                     ->type_name("SECONDS")
                     ->capture_default_str();
  acceptFormerName(command, *option, "--at-least");
}

}  // namespace robosim
