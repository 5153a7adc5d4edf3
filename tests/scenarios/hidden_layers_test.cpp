// --hide, --show and --only: layers and robots of pictures and figures.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// An SVG figure of the shipped recording.
std::string figure(const std::string& subcommand, const std::string& options) {
  const auto file = emptyFolder() / "figure.svg";
  const std::string output = subcommand == "view" ? "--offscreen " : "";
  const Ended ended = runProgram(subcommand + " rawlogs/opho2_1.rawlog " + output + quoted(file) + " " + options);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  return textOf(file);
}

/// Lines of paths, without their rims.
std::size_t pathsIn(const std::string& svg) { return countOf("stroke-width:1.6;", svg); }

TEST(HiddenLayers, AreNotDrawnInFigures) {
  const std::string all = figure("export", "");
  EXPECT_EQ(pathsIn(all), 4u);
  const std::string without = figure("export", "--hide paths,events");
  EXPECT_EQ(pathsIn(without), 0u);
  EXPECT_LT(without.size(), figure("export", "--hide paths").size());
  EXPECT_EQ(countOf("fill-opacity:0.17;", figure("view", "--hide sensors")), 0u) << "areas that sensors measured";
}

TEST(HiddenLayers, OfTheSameRecordingLeaveTheSameMarksInFiguresOfViewAndExport) {
  EXPECT_EQ(figure("view", "--hide sensors,paths"), figure("export", "--width-mm 88 --hide paths"));
}

TEST(HiddenLayers, AreRefusedByUnknownNamesAndWhereThereAreNone) {
  const auto error_of = [](const std::string& arguments) {
    const Ended ended = runProgram(arguments);
    EXPECT_NE(ended.exit_code, 0) << arguments;
    return ended.err;
  };
  const std::string out = quoted(emptyFolder() / "plan.svg");
  EXPECT_NE(error_of("view worlds/small_maze.xml --offscreen " + out + " --hide names,pats")
                .find("there is no layer 'pats'; did you mean paths?"),
            std::string::npos);
  EXPECT_NE(error_of("view worlds/small_maze.xml --offscreen " + out + " --hide floor")
                .find("the layers are paths, starts, sensors, events, names"),
            std::string::npos);
  EXPECT_NE(error_of("export worlds/small_maze.xml " + out + " --hide paths").find("a plan of a world has no paths"),
            std::string::npos);
  EXPECT_NE(error_of("export rawlogs/opho2_1.rawlog " + out + " --hide sensors").find("has no sensors"),
            std::string::npos);
}

namespace fs = std::filesystem;

/// 10 m × 10 m with a red, a green and a blue robot.
fs::path writeHall(const fs::path& folder) {
  std::string robots;
  const std::pair<const char*, const char*> colors[] = {{"Robot1", "1 0 0"}, {"Robot2", "0 1 0"}, {"Robot3", "0 0 1"}};
  int x_m = 2;
  for (const auto& [name, color] : colors) {
    robots += "<object><shape><robot><model>pioneer3dx</model><name>" + std::string(name) + "</name><x>" +
              std::to_string(x_m) + "</x><y>5</y><color>" + color + "</color></robot></shape></object>";
    x_m += 3;
  }
  std::ofstream(folder / "hall.xml")
      << "<world><surface><size><xmin>0</xmin><xmax>10</xmax><ymin>0</ymin><ymax>10</ymax></size>" << robots
      << "</surface></world>";
  return folder / "hall.xml";
}

/// For red, green and blue: whether a picture has pixels of this colour.
std::string colorsIn(const fs::path& png) {
  const cv::Mat picture = cv::imread(png.string());
  std::string seen;
  for (const auto& [letter, channel] : {std::pair{'r', 2}, {'g', 1}, {'b', 0}}) {
    cv::Scalar low(0, 0, 0), high(40, 40, 40);
    low[channel] = 215;
    high[channel] = 255;
    cv::Mat pixels;
    cv::inRange(picture, low, high, pixels);
    if (cv::countNonZero(pixels) > 20) seen += letter;
  }
  return seen;
}

TEST(SelectedRobots, AreTheOnlyOnesInEveryPicture) {
  const auto folder = emptyFolder();
  const std::string hall = quoted(writeHall(folder)), rawlog = quoted(folder / "run.rawlog");
  const auto shown = [&](const std::string& arguments) {
    const fs::path png = folder / "picture.png";
    const Ended ended = runProgram(arguments + " " + quoted(png));
    EXPECT_EQ(ended.exit_code, 0) << arguments << ended.err;
    return colorsIn(png);
  };
  const std::string run = "run " + hall + " --controller still --time 0.2 --record " + rawlog;
  EXPECT_EQ(shown(run + " --picture"), "rgb");
  EXPECT_EQ(shown(run + " --only Robot3 --picture"), "b");
  EXPECT_EQ(shown("export " + rawlog + " --only Robot3"), "b");
  EXPECT_EQ(shown("export " + rawlog + " --only 'Robot2..3'"), "gb");
  EXPECT_EQ(shown("view " + hall + " --hide names,sensors --only Robot3 --offscreen"), "b");
  EXPECT_EQ(shown("view " + rawlog + " --hide names,sensors --only 'R*1,Robot3' --offscreen"), "rb");
}

TEST(SelectedRobots, AreTheOnlyOnesInPlansFiguresAndScenes) {
  const auto folder = emptyFolder();
  const std::string hall = quoted(writeHall(folder));
  const auto bytes = [&](const std::string& arguments, const char* name) {
    const Ended ended = runProgram(arguments + " " + quoted(folder / name));
    EXPECT_EQ(ended.exit_code, 0) << arguments << ended.err;
    return textOf(folder / name);
  };
  constexpr const char* kRed = "rgb(100%,0%,0%)";
  EXPECT_GT(countOf(kRed, bytes("export " + hall, "a.svg")), 0u);
  EXPECT_EQ(countOf(kRed, bytes("export " + hall + " --only Robot3", "b.svg")), 0u);
  EXPECT_EQ(countOf(kRed, bytes("view " + hall + " --only Robot3 --offscreen", "c.svg")), 0u);
  const std::string scene = bytes("export " + hall + " --only Robot3", "d.3Dscene");
  EXPECT_EQ(countOf("Robot1", scene), 0u);
  EXPECT_EQ(countOf("Robot3", scene), 1u);
}

TEST(DensityMaps, AreInEveryPicture) {
  const auto folder = emptyFolder();
  const std::string hall = quoted(writeHall(folder)), rawlog = quoted(folder / "run.rawlog");
  ASSERT_EQ(runProgram("run " + hall + " --controller wander --time 2 --show visits --picture " +
                       quoted(folder / "run.svg") + " --record " + rawlog)
                .exit_code,
            0);
  EXPECT_EQ(countOf("<image", textOf(folder / "run.svg")), 1u);
  for (const std::string& subcommand : {"export " + rawlog + " ", "view " + rawlog + " --offscreen "}) {
    for (const char* layer : {"density", "visits"}) {
      const std::string figure = quoted(folder / "figure.svg");
      const Ended ended = runProgram(subcommand + figure + " --show " + layer);
      EXPECT_EQ(ended.exit_code, 0) << ended.err;
      EXPECT_EQ(countOf("<image", textOf(folder / "figure.svg")), 1u) << subcommand << layer;
    }
  }
}

TEST(DensityMaps, AndSelectionsAreRefusedWhereTheyWouldHaveNoEffect) {
  const auto folder = emptyFolder();
  const std::string hall = quoted(writeHall(folder)), png = quoted(folder / "a.png"), svg = quoted(folder / "a.svg");
  const auto expect_error = [](const std::string& arguments, const std::string& text) {
    const Ended ended = runProgram(arguments);
    EXPECT_NE(ended.exit_code, 0) << arguments;
    EXPECT_NE(ended.err.find(text), std::string::npos) << arguments << ended.err;
  };
  expect_error("view " + hall + " --offscreen " + png + " --hide starts", "a picture or video has no starts");
  expect_error("view " + hall + " --offscreen " + png + " --hide density", "is not shown without --show");
  expect_error("view " + hall + " --offscreen " + png + " --only Robt3", "did you mean Robot");
  expect_error("export " + hall + " " + svg + " --show visits", "a plan of a world has no visits");
  expect_error("export " + hall + " " + png + " --only Robot3", "a map has no robots");
  expect_error("run " + hall + " --time 0.1 --picture " + png + " --hide sensors", "a plan of a run has no sensors");
  expect_error("run " + hall + " --time 0.1 --picture " + png + " --only Robot4", "there is no robot Robot4");
  expect_error("run " + hall + " --time 0.1 --only Robot3", "has no effect without --picture or --view");
}

}  // namespace
}  // namespace robosim
