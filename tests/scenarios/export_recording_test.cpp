// `robosim export RAWLOG` (tables and figures) and `robosim run --csv`, the tables read by Python's csv and
// NumPy.
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "base/temporary_directory.h"
#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/program.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Result of `robosim export` with these arguments after a success.
std::string exported(const std::string& arguments) {
  const Ended ended = runProgram("export " + arguments);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return ended.out;
}

/// Compares out.csv and out.npz of a folder with `replay --print --csv`. @return the number of values compared
int compareWithReplay(const fs::path& rawlog, const fs::path& folder) {
  std::ofstream(folder / "replay.csv") << runProgram("replay --print --csv " + quoted(rawlog)).out;
  const Ended compared =
      StartedProgram("/usr/bin/python3", {ROBOSIM_SOURCE_DIR "/tests/compare_exports.py", folder / "replay.csv",
                                          folder / "out.csv", folder / "out.npz"})
          .wait();
  EXPECT_EQ(compared.exit_code, 0) << compared.err;
  EXPECT_NE(compared.out.find(" values are equal\n"), std::string::npos) << compared.out;
  return std::atoi(compared.out.c_str());
}

int exportAndCompare(const fs::path& rawlog) {
  const auto folder = emptyFolder();
  exported(quoted(rawlog) + " " + quoted(folder / "out.csv") + " " + quoted(folder / "out.npz"));
  return compareWithReplay(rawlog, folder);
}

TEST(ExportRecording, WritesTheReplayedValuesForPython) {
  for (const char* name : {"opho2_1", "driven", "slam_sf"}) {
    EXPECT_GT(exportAndCompare(fs::path(ROBOSIM_SOURCE_DIR "/rawlogs") / (std::string(name) + ".rawlog")), 10'000)
        << name;
  }
}

TEST(ExportRecording, AcceptsRecordingsOfOtherPrograms) {
  const TemporaryDirectory folder;
  writeForeignRawlog(folder / "foreign.rawlog");
  // 50 times odometry (x, y, heading; its speeds are not measured), and a scan of 181 ranges.
  EXPECT_EQ(exportAndCompare(folder / "foreign.rawlog"), 50 * (3 + 181));
}

TEST(ExportRecording, WritesTheSameBytesEachTime) {
  const auto folder = emptyFolder();
  const std::string rawlog = "rawlogs/driven.rawlog ";
  EXPECT_NE(exported(rawlog + quoted(folder / "a.npz") + " " + quoted(folder / "a.csv")).find("a.npz: "),
            std::string::npos);
  exported(rawlog + quoted(folder / "b.NPZ") + " " + quoted(folder / "b.csv"));
  EXPECT_TRUE(textOf(folder / "a.npz") == textOf(folder / "b.NPZ"));
  EXPECT_TRUE(textOf(folder / "a.csv") == textOf(folder / "b.csv"));
  EXPECT_EQ(textOf(folder / "a.csv").rfind("step,time_s,robot,GROUND_TRUTH/x_m,GROUND_TRUTH/y_m,", 0), 0U);
}

TEST(ExportRecording, ReportsErrorsAndLeavesFilesUnchanged) {
  const auto folder = emptyFolder();
  const auto rawlog = folder / "run.csv";  // an unusual name of a rawlog
  fs::copy_file(ROBOSIM_SOURCE_DIR "/rawlogs/driven.rawlog", rawlog);
  fs::create_hard_link(rawlog, folder / "hard.npz");
  fs::create_hard_link(rawlog, folder / "b.csv.part");  // the temporary name of an output
  const std::string before = textOf(rawlog);
  const auto out = [&](const char* name) { return " " + quoted(folder / name); };
  const struct {
    std::string arguments, complaint;
  } cases[] = {
      {quoted(rawlog) + out("run.csv"), "is both WORLD and OUT; name two files"},
      {quoted(rawlog) + out("hard.npz"), "hard.npz: is both WORLD and OUT; name two files"},
      {quoted(rawlog) + out("b.csv"), "b.csv"},
      {quoted(rawlog) + out("a.csv") + out("a.gridmap"),
       "a.gridmap: can be made of a world only, but " + (folder / "a.csv").string() + " is a table of a rawlog"},
      {quoted(rawlog) + out("a.html") + out("a.gridmap"),
       "a.gridmap: can be made of a world only, but " + (folder / "a.html").string() + " is a page of a rawlog"},
      {quoted(rawlog) + out("a.html") + " --seed 7", "--resolution, --heights and --seed are for worlds"},
      {"worlds/small_maze.xml" + out("a.html"), "worlds/small_maze.xml"},
      {quoted(rawlog) + out("a.gridmap"),
       "a.gridmap: can be made of a world only, but " + rawlog.string() + " is a rawlog; export it by another command"},
      {quoted(rawlog) + out("a.svg") + out("none/a.pdf"), "none/a.pdf: cannot be created: the folder "},
      {quoted(rawlog) + out("a.svg") + " --heights 0 1", "--heights: has no effect without an OUT in "},
      {quoted(rawlog) + out("a.jpg"), "a.jpg: unknown format"},
      {quoted(rawlog) + out("a.csv") + " --seed 7", "--resolution, --heights and --seed are for worlds"},
      {quoted(rawlog) + out("a.csv") + " --resolution 1", "--resolution: has no effect without an OUT in "},
      {quoted(rawlog) + out("none/a.npz"), "none/a.npz: cannot be created: the folder "},
      {"rawlogs/none.rawlog" + out("a.npz"), "rawlogs/none.rawlog: no such file"},
      {"worlds/small_maze.xml" + out("a.csv"), "worlds/small_maze.xml"},
  };
  for (const auto& [arguments, complaint] : cases) {
    const Ended ended = runProgram("export " + arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_NE(ended.err.find(complaint), std::string::npos) << arguments << "\n" << ended.err;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 3);
  EXPECT_TRUE(textOf(rawlog) == before);
}

TEST(ExportRecording, DrawsAFigureOfTheRun) {
  const auto folder = emptyFolder();
  const std::string run = quoted(folder / "run.rawlog");
  const Ended recorded = runProgram("run worlds/lab_map.xml --record " + run);
  ASSERT_EQ(recorded.exit_code, 0) << recorded.err;
  const auto draw = [&](const std::string& name) {
    exported(run + " " + quoted(folder / (name + ".png")) + " " + quoted(folder / (name + ".svg")) + " " +
             quoted(folder / (name + ".pdf")) + " " + quoted(folder / (name + ".csv")));
  };
  draw("a");
  draw("b");
  EXPECT_FALSE(fs::exists(folder / "a.yaml")) << "a .png of a recording is no map";
  for (const char* ending : {".png", ".svg", ".pdf", ".csv"}) {
    EXPECT_TRUE(textOf(folder / (std::string("a") + ending)) == textOf(folder / (std::string("b") + ending))) << ending;
  }
  const ToolRun text = runTool("pdftotext -layout a.pdf -", folder);
  for (const char* word : {"lab_map, 37.5 s", "Pioneer1", "Scout1", "Gold", "x [m]", "y [m]", "14", "start",
                           "gold found", "message sent"}) {
    EXPECT_NE(text.output.find(word), std::string::npos) << word << " is not in " << text.output;
  }
  const cv::Mat png = cv::imread((folder / "a.png").string());
  // To the picture's size, because 180 mm are not a whole number of pixels.
  const std::string width = std::to_string(png.cols), height = std::to_string(png.rows);
  const ToolRun drawn =
      runTool("rsvg-convert -w " + width + " -h " + height + " a.svg -o svg.png && pdftoppm -scale-to-x " + width +
                  " -scale-to-y " + height + " -png -singlefile a.pdf pdf",
              folder);
  ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
  for (const char* other : {"svg.png", "pdf.png"}) {
    const cv::Mat picture = cv::imread((folder / other).string());
    ASSERT_EQ(picture.size(), png.size());
    cv::Mat difference;
    cv::absdiff(png, picture, difference);
    EXPECT_LT(cv::mean(difference.reshape(1))[0], 1) << other << ": of 255";
  }
}

TEST(ExportRecording, DrawsTheTrajectoryOfAnotherProgram) {
  const TemporaryDirectory folder;
  writeForeignRawlog(folder / "foreign.rawlog");
  exported(quoted(folder / "foreign.rawlog") + " " + quoted(folder / "a.svg"));
  EXPECT_NE(textOf(folder / "a.svg").find("<title>foreign, 9.8 s</title>"), std::string::npos);
}

TEST(ExportRecording, ReadsATruncatedRecordingUpToTheDamage) {
  const auto folder = emptyFolder();
  const std::string whole = textOf(ROBOSIM_SOURCE_DIR "/rawlogs/driven.rawlog");
  std::ofstream(folder / "cut.rawlog") << whole.substr(0, whole.size() / 2);
  const Ended ended = runProgram("export " + quoted(folder / "cut.rawlog") + " " + quoted(folder / "out.csv") + " " +
                                 quoted(folder / "out.npz"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("cut.rawlog"), std::string::npos) << ended.err;
  EXPECT_GT(compareWithReplay(folder / "cut.rawlog", folder), 1000);
}

TEST(RunTables, AreThoseOfTheRecordingOfTheRun) {
  const auto folder = emptyFolder();
  const auto file = [&](const char* name) { return quoted(folder / name) + " "; };
  const Ended run = runProgram("run worlds/opho2_1.xml --time 5 --record " + file("run.rawlog") + "--csv " +
                               file("run.csv") + "--npz " + file("run.npz"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("run.csv"), std::string::npos) << run.out;
  exported(file("run.rawlog") + file("out.csv") + file("out.npz"));
  EXPECT_TRUE(textOf(folder / "run.csv") == textOf(folder / "out.csv"));
  EXPECT_TRUE(textOf(folder / "run.npz") == textOf(folder / "out.npz"));
  const Ended alone = runProgram("run worlds/opho2_1.xml --time 5 --csv " + file("alone.csv"));
  EXPECT_TRUE(textOf(folder / "alone.csv") == textOf(folder / "out.csv")) << alone.err;
}

TEST(RunTables, CoverTheStepsBeforeAnInterrupt) {
  const auto folder = emptyFolder();
  // At real time the run would take half an hour. It is interrupted after its recording has been opened.
  StartedProgram run({"run", "worlds/small_maze.xml", "--speed", "1", "--controller", "wander", "--csv",
                      (folder / "out.csv").string(), "--npz", (folder / "out.npz").string(), "--record",
                      (folder / "run.rawlog").string()});
  run.waitForFile((folder / "run.rawlog.part").string());
  run.interrupt();
  EXPECT_EQ(run.wait().exit_code, 130);
  EXPECT_GT(compareWithReplay(folder / "run.rawlog", folder), 0);
}

TEST(RunTables, AreRefusedInPlaceOfAnInput) {
  const Ended ended = runProgram("run worlds/small_maze.xml --time 1 --csv worlds/small_maze.xml");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("is both WORLD and --csv; name two files"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace robosim
