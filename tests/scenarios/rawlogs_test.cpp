// The recordings in rawlogs/: RoboSim replays them, and MRPT's programs open them.
#include <cstdio>
#include <fstream>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>

#include "tests/scenarios/program.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

const fs::path kRawlogs = ROBOSIM_SOURCE_DIR "/rawlogs";

std::set<std::string> rawlogs() {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(kRawlogs)) {
    if (entry.path().extension() == ".rawlog") names.insert(entry.path().filename().string());
  }
  return names;
}

TEST(Rawlogs, AreSmallAndDescribedInTheReadme) {
  const std::string readme = textOf(kRawlogs / "README.md");
  std::uintmax_t bytes = 0;
  for (const auto& name : rawlogs()) {
    EXPECT_NE(readme.find("`" + name + "`"), std::string::npos) << name;
    bytes += fs::file_size(kRawlogs / name);
  }
  EXPECT_EQ(rawlogs(), (std::set<std::string>{"driven.rawlog", "opho2_1.rawlog", "slam.rawlog", "slam_sf.rawlog"}));
  EXPECT_LT(bytes, 3'000'000u);
}

TEST(Rawlogs, AreReproducible) {
  for (const auto& [rawlog, world] : {std::pair{"opho2_1", "worlds/opho2_1.xml"},
                                      {"slam", "rawlogs/slam.xml"},
                                      {"slam_sf", "rawlogs/slam.xml"},
                                      {"driven", "rawlogs/driven.xml"}}) {
    const Ended check = runProgram("replay rawlogs/" + std::string(rawlog) + ".rawlog --check " + world);
    EXPECT_EQ(check.exit_code, 0) << rawlog << "\n" << check.out << check.err << "rawlogs/make.sh makes it again";
    EXPECT_EQ(check.out.rfind("The same run: ", 0), 0u) << check.out;
  }
}

TEST(Rawlogs, AreReadByRawlogEdit) {
  const auto folder = emptyFolder();
  for (const auto& name : rawlogs()) {
    const bool is_sf = name == "slam_sf.rawlog";
    const ToolRun info = runTool("rawlog-edit -i '" + (kRawlogs / name).string() + "' --info", folder);
    EXPECT_EQ(info.exit_code, 0) << info.output;
    EXPECT_NE(
        info.output.find(is_sf ? "Actions/SensoryFrame format       : Yes" : "Observations format               : Yes"),
        std::string::npos)
        << info.output;
    if (is_sf) {
      EXPECT_NE(info.output.find("Observations format               : No"), std::string::npos) << info.output;
    }
  }
}

TEST(Rawlogs, IcpSlamIsMuchMoreAccurateThanOdometry) {
  const PathError error = icpSlamError(kRawlogs / "slam.rawlog", "Rover", "laser", "icp-slam.ini", emptyFolder());
  std::printf("icp-slam: %.3f m from the truth (RMS); the wheels: %.3f m\n", error.rms_m, error.odometry_rms_m);
  EXPECT_EQ(error.poses, 451u);
  EXPECT_GT(error.odometry_rms_m, 0.5);
  EXPECT_LT(error.rms_m, 0.2);
}

TEST(Rawlogs, RbpfSlamReadsTheRecordingInPairs) {
  const auto folder = emptyFolder();
  // With one particle, in a fifth of the time of five.
  const std::string settings = textOf(ROBOSIM_SOURCE_DIR "/doc/examples/slam/rbpf-slam.ini");
  const std::string with_one = std::regex_replace(settings, std::regex("sampleSize +=.*"), "sampleSize = 1");
  ASSERT_NE(with_one, settings);
  std::ofstream(folder / "one.ini") << with_one;
  const ToolRun slam = runTool("rbpf-slam one.ini '" + (kRawlogs / "slam_sf.rawlog").string() + "'", folder);
  EXPECT_EQ(slam.exit_code, 0) << slam.output;
  EXPECT_EQ(countOf("\n", textOf(folder / "rbpf-slam" / "log_estimated_path.txt")), 453u) << "451 steps and two notes";
}

TEST(Rawlogs, DrivenRunContainsCameraPictures) {
  std::size_t pictures = 0;
  forEachObservation(kRawlogs / "driven.rawlog", [&](const mrpt::obs::CObservation::Ptr& observation) {
    const auto* picture = dynamic_cast<const mrpt::obs::CObservationImage*>(observation.get());
    if (!picture) return;
    ++pictures;
    EXPECT_EQ(picture->image.getWidth(), 160u);
    EXPECT_EQ(picture->image.getHeight(), 120u);
  });
  EXPECT_EQ(pictures, 38u) << "two a second in 18.8 s";
  const Ended printed = runProgram("replay rawlogs/driven.rawlog --print --sensor STATUS --from 5 --to 5");
  EXPECT_NE(printed.out.find("command 0.500 m/s, 0.000 rad/s, by a person"), std::string::npos) << printed.out;
}

}  // namespace
}  // namespace robosim
