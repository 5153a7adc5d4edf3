// Maps and recordings of other programs, given to the commands as they are.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <nlohmann/json.hpp>

#include "base/temporary_directory.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

std::string succeeded(const std::string& arguments) {
  const Ended ended = runProgram(arguments);
  EXPECT_EQ(ended.exit_code, 0) << arguments << "\n" << ended.out << ended.err;
  return ended.out;
}

TEST(ForeignMaps, GiveTheSameWorldAsAnOctoMapAndAsAGrid) {
  const fs::path folder = emptyFolder();
  const std::string voxels = quoted(folder / "maze.bt");
  succeeded("export small_maze " + voxels + " " + quoted(folder / "maze.ot") + " --resolution 0.05");
  succeeded("export " + voxels + " " + quoted(folder / "of_bt.yaml"));
  succeeded("export " + quoted(folder / "maze.ot") + " " + quoted(folder / "of_ot.yaml"));
  succeeded("export small_maze --resolution 0.05 --heights 0.1 1 " + quoted(folder / "of_world.yaml"));
  EXPECT_TRUE(textOf(folder / "of_bt.png") == textOf(folder / "of_ot.png"));
  EXPECT_TRUE(textOf(folder / "of_bt.png") == textOf(folder / "of_world.png"));
  EXPECT_EQ(textOf(folder / "of_bt.yaml").substr(20), textOf(folder / "of_world.yaml").substr(23));
}

TEST(ForeignMaps, AreTakenWhereverAWorldIs) {
  const fs::path folder = emptyFolder();
  succeeded("export small_maze " + quoted(folder / "maze.bt") + " --resolution 0.1");
  std::ofstream(folder / "around.xml")
      << "<world><surface><map file='maze.bt' z_min='0.2' z_max='0.3'/></surface></world>";
  for (const std::string file : {"maze.bt", "around.xml"}) {
    const std::string path = quoted(folder / file);
    EXPECT_NE(succeeded("check " + path).find("ok: "), std::string::npos);
    succeeded("run " + path + " --random-robots 2 --time 1 --controller wander");
    succeeded("view " + path + " --size 200x200 --offscreen " + quoted(folder / "view.png"));
  }
}

TEST(ForeignMaps, AreMadeOfSimpleMapsAsMrptSavesThem) {
  const fs::path folder = emptyFolder();
  mrpt::maps::CSimpleMap map;
  for (int i = 0; i < 3; ++i) {
    // A wall 1 m ahead, and open ground to the left and the right.
    auto scan = mrpt::obs::CObservation2DRangeScan::Create();
    scan->maxRange = 4;
    scan->resizeScan(181);
    for (std::size_t beam = 0; beam < 181; ++beam) {
      scan->setScanRange(beam, beam > 80 && beam < 100 ? 1.0F : 3.0F);
      scan->setScanRangeValidity(beam, true);
    }
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(scan);
    map.insert(mrpt::poses::CPose3DPDFGaussian(mrpt::poses::CPose3D(0, 0, 0, 0, 0, 0)), *frame);
  }
  ASSERT_TRUE(map.saveToFile((folder / "lab.simplemap").string()));
  const std::string path = quoted(folder / "lab.simplemap");
  const std::string checked = succeeded("check " + path);
  EXPECT_NE(checked.find("cells of 0.05 m"), std::string::npos) << checked;
  succeeded("run " + path + " --robot pioneer3dx@1.2,1.5 --time 1 --controller wander");
  EXPECT_NE(runProgram("run " + path + " --robot pioneer3dx@1,0 --time 1").exit_code, 0) << "the wall is there";
  succeeded("export " + path + " " + quoted(folder / "lab.gridmap"));
  std::ofstream(folder / "around.xml")
      << "<world><surface><map file='lab.simplemap' resolution='0.2'/></surface></world>";
  EXPECT_NE(succeeded("check " + quoted(folder / "around.xml")).find("cells of 0.2 m"), std::string::npos);
}

/// A robot drives along x at 0.5 m/s past a scanner's view of a wall 2 m away, as CARMEN logs it.
void writeCarmenLog(const fs::path& file) {
  std::ofstream out(file);
  out << "# CARMEN Logfile\nPARAM robot_frontlaser_offset 0.1 0 host 0\n";
  for (int i = 0; i < 20; ++i) {
    const std::string time = std::to_string(1000 + i) + ".5 host " + std::to_string(i) + "\n";
    out << "ODOM " << 0.5 * i << " 0 0 0.5 0 0 " << time << "FLASER 181";
    for (int beam = 0; beam < 181; ++beam) out << " 2.00";
    out << " 0 0 0 " << 0.5 * i << " 0 0 " << time;
  }
}

TEST(CarmenLogs, AreRecordingsForReplayExportAndView) {
  const fs::path folder = emptyFolder();
  const std::string log = quoted(folder / "lab.clf");
  writeCarmenLog(folder / "lab.clf");
  const auto summary = nlohmann::json::parse(succeeded("replay --json " + log));
  EXPECT_EQ(summary["entries"], 41);
  EXPECT_EQ(summary["observations"], 40);
  EXPECT_DOUBLE_EQ(summary["duration_s"], 19);
  EXPECT_DOUBLE_EQ(summary["driven_m"]["robot"], 9.5);
  EXPECT_EQ(summary["not_read"], nlohmann::json::array());
  EXPECT_NE(succeeded("replay --print --sensor laser --from 1 --to 1 " + log).find("2"), std::string::npos);
  succeeded("export " + log + " " + quoted(folder / "lab.csv") + " " + quoted(folder / "lab.rawlog"));
  const auto again = nlohmann::json::parse(succeeded("replay --json " + quoted(folder / "lab.rawlog")));
  EXPECT_EQ(again["channels"], summary["channels"]);
  succeeded("view " + log + " --size 200x200 --offscreen " + quoted(folder / "view.png"));
  EXPECT_GT(fs::file_size(folder / "view.png"), 500u);
}

TEST(CarmenLogs, AreReadAroundWrongLinesWhichAreNamed) {
  const fs::path folder = emptyFolder();
  writeCarmenLog(folder / "lab.log");
  std::ofstream(folder / "lab.log", std::ios::app) << "FLASER 180 1 2 3\nODOM 10 0 0 0 0 0 1020.5 host 20\n";
  const Ended replay = runProgram("replay " + quoted(folder / "lab.log"));
  EXPECT_EQ(replay.exit_code, 1) << "the output is complete but for the damage";
  EXPECT_NE((replay.out + replay.err)
                .find("lab.log:43: FLASER: announces 180 readings, but 3 numbers follow; the line is left out"),
            std::string::npos)
      << replay.out << replay.err;
  EXPECT_NE(replay.out.find("10.00 m by robot"), std::string::npos) << replay.out;
}

}  // namespace
}  // namespace robosim
