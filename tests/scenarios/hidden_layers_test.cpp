// --hide: layers that pictures and figures are drawn without.
#include <gtest/gtest.h>

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
                .find("the layers are paths, sensors, events, names"),
            std::string::npos);
  EXPECT_NE(error_of("export worlds/small_maze.xml " + out + " --hide paths").find("a plan of a world has no paths"),
            std::string::npos);
  EXPECT_NE(error_of("export rawlogs/opho2_1.rawlog " + out + " --hide sensors").find("has no sensors"),
            std::string::npos);
}

}  // namespace
}  // namespace robosim
