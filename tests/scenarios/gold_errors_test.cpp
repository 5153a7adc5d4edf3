// The gold finder with the errors of all sensors. tests/verify/gold_errors.sh measures all mazes with 100 runs each.
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

TEST(GoldFinder, SucceedsWithTheErrorsOfAllSensors) {
  // With a success rate of 95 %, fewer than 17 of 20 runs succeed with a probability of 1.6 % only.
  for (const std::string world : {"small_maze", "opho2_1"}) {
    const auto csv = emptyFolder() / "runs.csv";
    const Ended ended = runProgram("bench gold " + world + " --noise all --runs 20 --csv '" + csv.string() + "'");
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    std::ifstream lines(csv);
    int found = 0, runs = -1;  // the first line has the names of the columns
    for (std::string line; std::getline(lines, line); ++runs) {
      std::istringstream cells(line);
      std::string cell;  // the sixth: gold_found
      for (int i = 0; i < 6; ++i) std::getline(cells, cell, ',');
      found += cell == "1" ? 1 : 0;
    }
    EXPECT_EQ(runs, 20) << world;
    EXPECT_GE(found, 17) << world;
  }
}

}  // namespace
}  // namespace robosim
