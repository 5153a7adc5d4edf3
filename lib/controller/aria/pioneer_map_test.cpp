#include "aria/pioneer_map.h"

#include <gtest/gtest.h>

#include "base/error_list.h"

namespace robosim {
namespace {

const std::string kMap = R"(2D-Map
Resolution: 20
Cairn: RobotHome 100 200 270 "" ICON ""
Cairn: Goal 3000 -400.5 0 "by the door" ICON "kitchen"
Cairn: GoalWithHeading 1 2 45 "" ICON "kitchen"
Cairn: ForbiddenLine 0 0 0 "" ICON "no entry" 10 20 30 40
LINES
-100 0 100 0
DATA
5 6
)";

TEST(PioneerMap, ReadsObjectsWallsAndPoints) {
  const PioneerMap map = PioneerMap::parse(kMap, "a.map");
  EXPECT_EQ(map.getResolution(), 20);
  ASSERT_EQ(map.getMapObjects().size(), 4u);
  EXPECT_EQ(map.getMapObjects()[0].getPose(), (PioneerPose{.x = 100, .y = 200, .th = -90}));
  EXPECT_FALSE(map.getMapObjects()[0].hasFromTo());
  const PioneerMapObject& line = map.getMapObjects()[3];
  ASSERT_TRUE(line.hasFromTo());
  EXPECT_EQ(line.from_to->second, (PioneerPose{.x = 30, .y = 40, .th = 0}));
  ASSERT_EQ(map.getLines().size(), 1u);
  EXPECT_EQ(map.getLines()[0].from.x, -100);
  ASSERT_EQ(map.getPoints().size(), 1u);
  EXPECT_EQ(map.getPoints()[0].y, 6);
}

TEST(PioneerMap, FindsAnObjectByNameAndType) {
  const PioneerMap map = PioneerMap::parse(kMap, "a.map");
  const PioneerMapObject* goal = map.findFirstMapObject("kitchen");
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->getType(), "Goal");
  EXPECT_EQ(goal->getDescription(), "by the door");
  EXPECT_EQ(goal->getPose().y, -400.5);
  EXPECT_EQ(map.findFirstMapObject("kitchen", "GoalWithHeading")->getPose().th, 45);
  EXPECT_EQ(map.findFirstMapObject("kitchen", "Dock"), nullptr);
  EXPECT_EQ(map.findFirstMapObject("cellar"), nullptr);
}

TEST(PioneerMap, ReportsFaultsWithTheirLine) {
  const auto error_of = [](const std::string& line) -> std::string {
    try {
      PioneerMap::parse("2D-Map\n" + line + "\n", "a.map");
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("Cairn: Goal 1 2"),
            "a.map:2: a cairn has a type, x, y, theta, a name, an icon and a label; something is missing");
  EXPECT_EQ(error_of("Cairn: Goal 1 two 3 \"\" ICON \"g\""), "a.map:2: 'two' of the cairn Goal is not a number");
}

TEST(PioneerMap, ReadsTheShippedMap) {
  const PioneerMap map = PioneerMap::readFile(ROBOSIM_SOURCE_DIR "/maps/office.map");
  EXPECT_FALSE(map.getLines().empty());
}

}  // namespace
}  // namespace robosim
