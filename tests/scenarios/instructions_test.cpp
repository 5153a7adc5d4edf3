// Comparison of instruction counts with stored ones; the test `instructions` compares measured counts.
#include <fstream>

#include <gtest/gtest.h>

#include "tests/instructions/counts.h"
#include "tests/instructions/loads.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using Lines = std::vector<std::string>;

InstructionCounts counts(double sonar, double laser) {
  return {.compiler = "g++ 12", .vectors = "x86-64-v3", .instructions = {{"sonar", sonar}, {"laser", laser}}};
}

const char* const kHowToFix =
    "If what was gained is worth it, keep the new counts: ./dev bench --instructions --update";

TEST(Instructions, MayGrowByTenPercentAndFallWithoutLimit) {
  EXPECT_EQ(listGrowth(counts(1100, 5000), counts(1000, 50000)), Lines{});
}

TEST(Instructions, ReportLargerGrowthAndHowToFixIt) {
  EXPECT_EQ(listGrowth(counts(1000, 60500), counts(1000, 50000)),
            (Lines{"laser: 60,500 instructions a robot-step, which is +21.0 % on the 50,000 that are kept; +10 % is "
                   "allowed",
                   kHowToFix}));
}

TEST(Instructions, ReportAnotherCompiler) {
  InstructionCounts now = counts(1200, 50000);
  now.compiler = "g++ 13";
  EXPECT_EQ(listGrowth(now, counts(1000, 50000)),
            (Lines{"sonar: 1,200 instructions a robot-step, which is +20.0 % on the 1,000 that are kept; +10 % is "
                   "allowed",
                   "The counts that are kept are of g++ 12 for x86-64-v3, these of g++ 13 for x86-64-v3: they may "
                   "differ for that reason alone.",
                   kHowToFix}));
}

TEST(Instructions, ReportNewAndMissingLoads) {
  InstructionCounts now = counts(1000, 50000);
  now.instructions.erase("laser");
  now.instructions["radar"] = 1;
  EXPECT_EQ(listGrowth(now, counts(1000, 50000)),
            (Lines{"radar: there is no count to compare with", "laser: a count is kept, but there is no such load",
                   kHowToFix}));
}

TEST(Instructions, LimitTheCostOfErrorsOfSensors) {
  InstructionCounts now = counts(1000, 20000);
  now.instructions["sonar, Gaussian noise"] = 19457;
  now.instructions["sonar, all errors"] = 38915;
  now.instructions["laser, all errors"] = 139565;
  now.instructions["laser, mixed pixels"] = 900000;
  EXPECT_EQ(listCostlyErrors(now), Lines{});
  now.instructions["sonar, Gaussian noise"] = 19600;
  now.instructions["laser, all errors of laser and sonars"] = 141000;
  now.instructions["radar, all errors"] = 1;
  EXPECT_EQ(listCostlyErrors(now),
            (Lines{"laser, all errors of laser and sonars: 5.05 times the 27,913 instructions of laser without errors; "
                   "5.0 times is allowed: make the error model cheaper",
                   "radar, all errors: there is no load without errors to compare with",
                   "sonar, Gaussian noise: 2.52 times the 7,783 instructions of sonar without errors; 2.5 times is "
                   "allowed: make the error model cheaper"}));
}

TEST(Instructions, AreStoredInAFile) {
  const auto file = emptyFolder() / "counts.json";
  EXPECT_TRUE(readCounts(file).instructions.empty()) << "no file, no counts";
  writeCounts(file, counts(1000.26, 50000));
  EXPECT_EQ(readCounts(file).compiler, "g++ 12");
  EXPECT_EQ(readCounts(file).vectors, "x86-64-v3");
  EXPECT_EQ(readCounts(file).instructions, (std::map<std::string, double>{{"sonar", 1000.3}, {"laser", 50000}}));
  std::ofstream(file) << "{}";
  EXPECT_THROW(readCounts(file), std::runtime_error);
}

TEST(Instructions, AreStoredForEveryLoad) {
  const auto kept = readCounts(ROBOSIM_SOURCE_DIR "/tests/data/instructions.json");
  for (const auto& load : instructionLoads()) EXPECT_TRUE(kept.instructions.count(load.name)) << load.name;
  EXPECT_EQ(kept.instructions.size(), instructionLoads().size());
}

TEST(Instructions, CountTheMeasuredWork) {
  for (const auto& load : instructionLoads()) {
    const InstructionWork work = load.prepare();
    EXPECT_GE(work.units, 1) << load.name;
    robosimCounted(work.work);
  }
}

}  // namespace
}  // namespace robosim
