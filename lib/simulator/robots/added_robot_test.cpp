#include "robots/added_robot.h"

#include <gtest/gtest.h>

#include "robots/robot_colors.h"
#include "robots/robot_type_folders_text.h"
#include "world/world_file.h"

namespace robosim {
namespace {

/// A world of two scouts, with a timeline. @param errors receives its faults
Fleet fleetWithTimeline(const std::string& timeline, ErrorList& errors) {
  const World world = parseWorld(
      "<world><surface><size><xmin>-9</xmin><xmax>9</xmax><ymin>-9</ymin><ymax>9</ymax></size>"
      "<object><shape><robot model='scout' name='A' x='0' y='0'/></shape></object>"
      "<object><shape><robot model='scout' name='B' x='2' y='0'/></shape></object></surface>\n" +
          timeline + "</world>",
      "w.xml", errors);
  return buildFleet(world, "w.xml", robotTypesIn(robotTypeFolders("w.xml")), {}, errors);
}

Fleet twoScouts() {
  ErrorList errors;
  Fleet fleet = fleetWithTimeline("", errors);
  errors.throwIfAny();
  return fleet;
}

TEST(AddedRobot, IsTheLastAndSharesTheModelOfItsType) {
  const Fleet before = twoScouts();
  const Fleet after = withRobot(withRobot(before, {"C", "scout", {1, 2, 7}, "wander", "A"}), {"D", "pioneer3dx", {}});
  ASSERT_EQ(after.robots.size(), 4u);
  EXPECT_EQ(after.robots[2].model, before.robots[0].model);
  EXPECT_EQ(after.robots[2].info.name, "C");
  EXPECT_EQ(after.robots[2].info.neighbour, "A");
  EXPECT_EQ(*after.robots[2].controller, "wander");
  EXPECT_NEAR(after.robots[2].world_from_start.phi, 7 - 2 * M_PI, 1e-12);
  EXPECT_EQ(after.robots[3].info.type->model, "pioneer3dx");
  EXPECT_EQ(withRobot(after, {"E", "pioneer3dx", {}}).robots[4].model, after.robots[3].model);
}

TEST(AddedRobot, HasAColorOfItsOwnAndLeavesThoseOfOthers) {
  const Fleet before = twoScouts();
  const Fleet after = withRobot(withRobot(before, {"C", "scout", {}}), {"D", "pioneer3dx", {}, "", "", {{1, 0.5f, 0}}});
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(after.robots[i].color, before.robots[i].color);
  EXPECT_EQ(after.robots[3].color, (std::array{1.0f, 0.5f, 0.0f}));
  EXPECT_EQ(after.robots[3].info.color_rgb, 0xff8000u);
}

TEST(AddedRobot, OfAnUnknownTypeIsRefusedWithThoseThatAreKnown) {
  try {
    withRobot(twoScouts(), {"C", "scuot", {}});
    FAIL();
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("there is no robot type 'scuot'; did you mean scout?; known are: ")) << text;
    EXPECT_TRUE(text.ends_with(robotTypeFoldersText())) << text;
  }
}

TEST(AddedRobot, OfATimelineHasItsTypeCheckedWhenTheWorldIsRead) {
  ErrorList errors;
  fleetWithTimeline("<at time='1'><add><robot model='scuot' name='C' x='1' y='1'/></add></at>", errors);
  ASSERT_EQ(errors.count(), 1u);
  EXPECT_TRUE(errors.errors()[0].starts_with("w.xml:2: robot 'C': there is no robot type 'scuot'"))
      << errors.errors()[0];
}

}  // namespace
}  // namespace robosim
