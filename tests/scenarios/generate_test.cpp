// `robosim generate` from the command line.
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/test_folder.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

class Generate : public TestFolder {};

TEST_F(Generate, WritesWorldsOfEachKindThatCheckAccepts) {
  for (const std::string kind : {"maze --braid 0", "cave --rock 0.45", "office --room 3", "open --clutter 0.2"}) {
    const std::string out = quoted(in("w.xml"));
    const Ended made = runProgram("generate " + kind + " --robots 12 --seed 5 " + out);
    EXPECT_EQ(made.exit_code, 0) << kind << made.err;
    EXPECT_NE(made.out.find(", 12 robots\n"), std::string::npos) << made.out;
    const Ended check = runProgram("check " + out);
    EXPECT_EQ(check.exit_code, 0) << kind << check.out << check.err;
    EXPECT_EQ(check.out.find("edge"), std::string::npos) << "no robot reaches the edge: " << check.out;
  }
}

TEST_F(Generate, MakesAMazeWhoseGoldIsFound) {
  const std::string out = quoted(in("w.xml"));
  ASSERT_EQ(runProgram("generate maze --columns 6 --rows 6 --robots 2 --seed 3 " + out).exit_code, 0);
  const Ended run = runProgram("run --json " + out);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["gold_found"], true);
}

TEST_F(Generate, WritesTheSameTextToStandardOutputWithItsOptionsAsAComment) {
  const std::string options =
      "maze --columns 4 --rows 3 --robots 1 --seed 8 --no-gold --controller \"wall_follower distance_radii=2\"";
  const Ended printed = runProgram("generate " + options);
  EXPECT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_NE(printed.out.find("<!-- Made by robosim generate maze, seed 8, robots 1, controller wall_follower "
                             "distance_radii=2, no-gold, columns 4, rows 3 -->"),
            std::string::npos)
      << printed.out.substr(0, 300);
  EXPECT_NE(printed.out.find("distance_radii=\"2\""), std::string::npos);
  EXPECT_EQ(printed.out.find("Gold"), std::string::npos);
  EXPECT_EQ(runProgram("generate " + options).out, printed.out);
}

TEST_F(Generate, RejectsUnknownTypesFullWorldsAndOptionsOutOfBounds) {
  const std::string out = " " + quoted(in("w.xml"));
  const Ended type = runProgram("generate maze --types pionier" + out);
  EXPECT_EQ(type.exit_code, 1);
  EXPECT_NE(type.err.find("there is no robot type 'pionier'"), std::string::npos) << type.err;
  const Ended full = runProgram("generate maze --columns 3 --rows 3 --robots 10" + out);
  EXPECT_EQ(full.exit_code, 1);
  EXPECT_EQ(full.err,
            "robosim generate maze: the generated world has places for 9 robots, not for 10; make it larger, or take "
            "fewer\n");
  EXPECT_EQ(runProgram("generate maze --braid 2" + out).exit_code, 1);
  EXPECT_EQ(runProgram("generate" + out).exit_code, 1);
  EXPECT_TRUE(filesInFolder().empty());
}

}  // namespace
}  // namespace robosim
