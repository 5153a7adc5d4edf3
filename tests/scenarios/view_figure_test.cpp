// `robosim view --offscreen fig.svg|fig.pdf`: figures of worlds, recordings and served runs.
#include <filesystem>

#include <gtest/gtest.h>

#include "robots/world_source.h"
#include "tests/scenarios/foreign_rawlog.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

std::size_t countIn(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// The SVG figure of a source. @param options may select a time or sizes
std::string figureOf(const std::string& source, const fs::path& folder, const std::string& options = "") {
  const auto file = folder / "fig.svg";
  const Ended view = runProgram("view " + source + " --offscreen " + quoted(file) + " " + options);
  EXPECT_EQ(view.exit_code, 0) << view.err;
  return fs::exists(file) ? textOf(file) : "";
}

std::string refusalOfView(const std::string& options) {
  const Ended view = runProgram("view worlds/small_maze.xml " + options);
  EXPECT_EQ(view.exit_code, 1) << options;
  return view.err;
}

/// Lines of paths, without their rims.
std::size_t pathsIn(const std::string& svg) { return countIn(svg, "stroke-width:1.6;"); }
/// Areas that sensors measured as free.
std::size_t areasIn(const std::string& svg) { return countIn(svg, "fill-opacity:0.17;"); }

TEST(ViewFigure, OfAWorldHasAPolygonForEachSonarAndLaser) {
  std::size_t expected = 0;
  for (const auto& robot : loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", {}).fleet.robots) {
    for (const auto& sensor : *robot.info.sensors) {
      if (sensor.kind == SensorKind::sonar) expected += sensor.beams.size();
      // A scan is one area; a laser of few beams has a sector for each.
      if (sensor.kind == SensorKind::laser) expected += sensor.beams.size() > 2 ? 1 : sensor.beams.size();
    }
  }
  ASSERT_GT(expected, 16U);
  const std::string svg = figureOf("worlds/small_maze.xml", emptyFolder());
  EXPECT_NE(svg.find(" width=\"88mm\" height=\""), std::string::npos) << svg.substr(0, 200);
  EXPECT_EQ(areasIn(svg), expected);
  EXPECT_EQ(pathsIn(svg), 0U);
  EXPECT_EQ(countIn(svg, "<image"), 0U);
}

TEST(ViewFigure, OfARecordingHasThePathsUntilItsTime) {
  const auto folder = emptyFolder();
  const std::string rawlog = quoted(folder / "run.rawlog");
  ASSERT_EQ(runProgram("run worlds/small_maze.xml --controller wander --time 5 --record " + rawlog).exit_code, 0);
  const std::size_t robots = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", {}).fleet.robots.size();
  const std::string whole = figureOf(rawlog, folder), half = figureOf(rawlog, folder, "--to 2.5");
  EXPECT_EQ(pathsIn(whole), robots);
  EXPECT_EQ(pathsIn(half), robots);
  EXPECT_NE(whole.find(", 5.0 s</title>"), std::string::npos);
  EXPECT_NE(half.find(", 2.5 s</title>"), std::string::npos);
  EXPECT_NE(figureOf(rawlog, folder, "--width-mm 120.5 --font-pt 10").find(" width=\"120.5mm\""), std::string::npos);
}

TEST(ViewFigure, OfARecordingOfAnotherProgramHasItsScanAndPath) {
  const auto folder = emptyFolder();
  writeForeignRawlog(folder / "foreign.rawlog");
  const std::string svg = figureOf(quoted(folder / "foreign.rawlog"), folder);
  EXPECT_EQ(countIn(svg, "fill:rgb(86"), 3U) << "the scan, its echoes and the legend";
  EXPECT_EQ(pathsIn(svg), 1U);
}

TEST(ViewFigure, OfAServedRunShowsItsNewestStep) {
  ServedWorld served(paused());
  const std::string svg = figureOf("localhost:" + std::to_string(served.port()), emptyFolder());
  EXPECT_GT(areasIn(svg), 0U);
}

TEST(ViewFigure, RefusesSizesForPicturesAndOptionsOfPictures) {
  const auto folder = emptyFolder();
  const std::string png = quoted(folder / "a.png"), svg = quoted(folder / "a.svg");
  EXPECT_NE(
      refusalOfView("--width-mm 88 --offscreen " + png).find("--width-mm: applies to figures of runs in .svg or .pdf"),
      std::string::npos);
  EXPECT_NE(refusalOfView("--font-pt 8 --offscreen " + quoted(folder / "a.mp4")).find("--font-pt: applies to figures"),
            std::string::npos);
  for (const char* option :
       {"--3d", "--follow Scout1", "--view 2d@Scout1", "--size 640x480", "--scale 2", "--antialias", "--camera"}) {
    EXPECT_NE(refusalOfView(std::string(option) + " --offscreen " + svg).find("applies to pictures and videos"),
              std::string::npos)
        << option;
  }
  EXPECT_NE(refusalOfView("--width-mm 5 --offscreen " + svg).find("must be a number in [20, 2000]"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "a.svg"));
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

}  // namespace
}  // namespace robosim
