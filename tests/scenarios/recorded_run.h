#pragma once
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/program.h"

namespace robosim {

/// Runs and records a world. @return the summary
inline nlohmann::json recordRun(const std::string& arguments, const std::filesystem::path& file) {
  const Ended run = runProgram("run " + arguments + " --json --record " + quoted(file));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out);
}

/// Error text of the program, which must refuse the arguments.
inline std::string refusalOf(const std::string& arguments) {
  const Ended ended = runProgram(arguments);
  EXPECT_EQ(ended.exit_code, 1) << ended.out << ended.err;
  return ended.err;
}

}  // namespace robosim
