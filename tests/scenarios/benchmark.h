#pragma once
#include <string>

#include "tests/scenarios/program.h"

namespace robosim {

/// Runs `robosim_bench ARGUMENTS` to its end, like runProgram().
inline Ended runBenchmark(const std::string& arguments) { return runCommand("'" ROBOSIM_BENCH "' " + arguments); }

}  // namespace robosim
