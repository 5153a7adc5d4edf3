#include "robots/robot_selection.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

Fleet fleetNamed(const std::vector<std::string>& names) {
  Fleet fleet;
  for (const auto& name : names) {
    fleet.robots.emplace_back();
    fleet.robots.back().info.name = name;
  }
  return fleet;
}

const Fleet kFleet = fleetNamed({"Robot1", "Robot2", "Robot9", "Robot10", "Scout1", "a..b2"});

/// Names of the chosen robots, each followed by a space.
std::string chosen(const std::vector<std::string>& patterns) {
  const auto flags = RobotSelection(patterns).flagsIn(kFleet, RobotSelection::Unmatched::refused);
  std::string names;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i]) names += kFleet.robots[i].info.name + " ";
  }
  return names;
}

std::string errorOf(const std::vector<std::string>& patterns, const Fleet& fleet = kFleet) {
  try {
    RobotSelection(patterns).flagsIn(fleet, RobotSelection::Unmatched::refused);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotSelection, ChoosesRobotsByName) {
  EXPECT_EQ(chosen({"Robot9"}), "Robot9 ");
  EXPECT_EQ(chosen({"Scout1", "Robot1"}), "Robot1 Scout1 ") << "in the order of the fleet";
}

TEST(RobotSelection, OfNoPatternIsThatOfAllRobots) {
  EXPECT_TRUE(RobotSelection().isAll());
  EXPECT_TRUE(RobotSelection().flagsIn(kFleet, RobotSelection::Unmatched::refused).empty());
}

TEST(RobotSelection, ChoosesByAsterisksAndQuestionMarks) {
  EXPECT_EQ(chosen({"Robot?"}), "Robot1 Robot2 Robot9 ");
  EXPECT_EQ(chosen({"*1"}), "Robot1 Scout1 ");
  EXPECT_EQ(chosen({"R*o*1*"}), "Robot1 Robot10 ");
  EXPECT_EQ(chosen({"*"}), "Robot1 Robot2 Robot9 Robot10 Scout1 a..b2 ");
}

TEST(RobotSelection, ChoosesRangesByTheirNumbersNotTheirLetters) {
  EXPECT_EQ(chosen({"Robot2..Robot10"}), "Robot2 Robot9 Robot10 ");
  EXPECT_EQ(chosen({"Robot2..9"}), "Robot2 Robot9 ");
}

TEST(RobotSelection, TakesANameThatLooksLikeARangeAsAName) { EXPECT_EQ(chosen({"a..b2"}), "a..b2 "); }

TEST(RobotSelection, RefusesPatternsWithoutARobot) {
  EXPECT_EQ(errorOf({"Robt9"}), "--only Robt9: there is no robot Robt9; did you mean Robot9?");
  EXPECT_EQ(errorOf({"Bob"}, fleetNamed({"Ann"})), "--only Bob: there is no robot Bob; there is Ann");
  EXPECT_EQ(errorOf({"Bob"}, fleetNamed({})), "--only Bob: there is no robot Bob; there is none");
  EXPECT_NE(errorOf({"Zumo20..30"}).find("there is no robot Zumo20..30"), std::string::npos);
  EXPECT_EQ(errorOf({"Robot9..2"}), "--only Robot9..2: the range ends before it begins; give the lower number first");
  std::vector<std::string> many;
  for (int i = 0; i < 1000; ++i) many.push_back("Number" + std::to_string(i));
  const std::string text = errorOf({"Bob"}, fleetNamed(many));
  EXPECT_LT(text.size(), 300u) << text;
  EXPECT_TRUE(text.ends_with(" more")) << text;
}

TEST(RobotSelection, IgnoresPatternsOfAnotherWorld) {
  EXPECT_EQ(RobotSelection({"Bob", "Robot1"}).flagsIn(kFleet, RobotSelection::Unmatched::ignored),
            (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace robosim
