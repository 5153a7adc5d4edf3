#include "maze/coordinated_frontiers.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

const mrpt::math::TPose2D kStart(10, 5, 0);

TEST(TeamTargets, CostDecreasesLinearlyWithTheDistance) {
  TeamTargets targets({.range_m = 4, .discount_m = 8}, 0.2);
  EXPECT_EQ(targets.computeCost({0, 0}), 0);
  targets.set("A", mrpt::math::TPoint2D(0.1, 0.1));
  EXPECT_EQ(targets.computeCost({0, 0}), 80) << "8 m in cells of 0.2 m, 2 each";
  EXPECT_EQ(targets.computeCost({10, 0}), 40) << "2 m away";
  EXPECT_EQ(targets.computeCost({20, 0}), 0) << "4 m away";
  targets.set("B", mrpt::math::TPoint2D(4.1, 0.1));
  EXPECT_EQ(targets.computeCost({10, 0}), 80) << "2 m from both";
  targets.set("A", std::nullopt);
  EXPECT_EQ(targets.computeCost({0, 0}), 0);
}

TEST(TargetMessage, RoundTrips) {
  EXPECT_EQ((TargetMessage{mrpt::math::TPoint2D(1.2, -0.35)}.text()), "TARGET 1200 -350");
  EXPECT_EQ(TargetMessage{}.text(), "TARGET");
  EXPECT_EQ(TargetMessage::parse("TARGET 1200 -350")->target_m, mrpt::math::TPoint2D(1.2, -0.35));
  EXPECT_FALSE(TargetMessage::parse("TARGET")->target_m);
  EXPECT_FALSE(TargetMessage::parse("TARGET 1"));
  EXPECT_FALSE(TargetMessage::parse("GOLD A"));
}

struct CoordinatedFrontiersTest : testing::Test {
  CoordinatedFrontiersTest() { hardware.robot_names = {"fake", "other"}; }
  void run(CoordinatedFrontiers& controller, int steps) {
    for (int i = 0; i < steps; ++i) {
      controller.step(robot);
      hardware.advance();
    }
  }
  std::vector<std::string> sentOf(const std::string& word) const {
    std::vector<std::string> texts;
    for (const auto& message : hardware.sent) {
      if (message.text.starts_with(word)) texts.push_back(message.text);
    }
    return texts;
  }
  FakeHardware hardware;
  Robot robot{hardware};
};

TEST_F(CoordinatedFrontiersTest, SendsItsTargetAndItsMapInTheFrameOfTheWorld) {
  CoordinatedFrontiers controller({.seed = 1, .world_from_start = kStart});
  run(controller, 20);
  const auto targets = sentOf("TARGET");
  ASSERT_FALSE(targets.empty());
  const auto target = TargetMessage::parse(targets[0])->target_m;
  EXPECT_LT((*target - mrpt::math::TPoint2D(10, 5)).norm(), 6);
  EXPECT_GT((*target - mrpt::math::TPoint2D(10, 5)).norm(), 1);
  const auto maps = sentOf("MAP");
  ASSERT_EQ(maps.size(), 2u) << "one per second";
  const auto map = MapMessage::parse(maps[0]);
  EXPECT_EQ(map->cell_um, 150000) << "0.6 radii";
  // The cell of the start has been searched: (66, 33), at (2, 1) in tile (8, 4).
  const auto tile = std::find_if(map->tiles.begin(), map->tiles.end(), [](const MapTile& t) {
    return t.tile == Cell{8, 4};
  });
  ASSERT_NE(tile, map->tiles.end());
  EXPECT_NE(tile->searched & (1ull << 10), 0u);
}

TEST_F(CoordinatedFrontiersTest, LeavesTheSurroundingsOfAnotherTargetToTheOther) {
  CoordinatedFrontiers alone({.seed = 1, .world_from_start = kStart}), controller(alone);
  alone.step(robot);
  const auto own = TargetMessage::parse(sentOf("TARGET").at(0))->target_m;
  hardware.sent.clear();
  hardware.mutableReadings().inbox.edit() = {{"other", "fake", TargetMessage{own}.text()}};
  controller.step(robot);
  const auto evaded = TargetMessage::parse(sentOf("TARGET").at(0))->target_m;
  EXPECT_GT((*evaded - *own).norm(), 3);
}

TEST_F(CoordinatedFrontiersTest, DoesNotSearchWhatOthersHaveSearched) {
  CoordinatedFrontiers controller({.seed = 1, .world_from_start = kStart});
  // Everything to the right of x = 10.8 m, up to 8 m away, has been searched.
  MapMessage searched{150000, {}};
  for (int y = -3; y <= 12; ++y) {
    for (int x = 9; x <= 15; ++x) searched.tiles.push_back({{x, y}, ~0ull, 0});
  }
  for (std::size_t i = 0; i < searched.tiles.size(); i += MapMessage::kMaxTiles) {
    MapMessage part{150000, {}};
    for (std::size_t k = i; k < std::min(searched.tiles.size(), i + MapMessage::kMaxTiles); ++k) {
      part.tiles.push_back(searched.tiles[k]);
    }
    hardware.mutableReadings().inbox.edit().push_back({"other", "fake", part.text()});
  }
  controller.step(robot);
  EXPECT_LT(TargetMessage::parse(sentOf("TARGET").at(0))->target_m->x, 10.8);
}

TEST_F(CoordinatedFrontiersTest, WithoutItsStartSendsNothing) {
  CoordinatedFrontiers controller({.seed = 1});
  run(controller, 30);
  EXPECT_TRUE(hardware.sent.empty());
  EXPECT_NE(hardware.odometry().odom_from_robot, mrpt::math::TPose2D());
}

TEST(CoordinatedFrontiers, FindsTheGold) {
  auto walls = FakeMaze::room(-1, 6, -1, 4);
  walls.push_back(FakeMaze::box(2.5, 0.85, 0.1, 3.7));
  FakeMaze maze(walls, {5.3, -0.4}, 20);
  Robot robot(maze.hardware);
  CoordinatedFrontiers controller({.seed = 3, .world_from_start = kStart});
  for (int i = 0; i < 1500 && robot.activity() == Activity::active; ++i) {
    controller.step(robot);
    maze.hardware.advance();
  }
  EXPECT_EQ(robot.activity(), Activity::found);
}

}  // namespace
}  // namespace robosim
