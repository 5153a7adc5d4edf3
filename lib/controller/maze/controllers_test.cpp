#include "maze/controllers.h"

#include <set>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

TEST(Controllers, AreListedWithOneSentenceEach) {
  EXPECT_EQ(controllers().names(),
            (std::vector<std::string>{"gold_finder", "wander", "wall_follower", "still", "random_walk", "levy_walk",
                                      "wall_search", "heat_gradient", "stigmergy", "oracle", "coordinated_frontiers",
                                      "market", "forage", "soccer", "push_together", "hold_door", "pass_door"}));
  for (const auto& type : controllers().types()) {
    EXPECT_EQ(type.help.back(), '.') << type.name;
  }
}

TEST(Controllers, AreCreatedByName) {
  for (const auto& name : controllers().names()) {
    FakeHardware hardware;
    Robot robot(hardware);
    const auto controller = controllers().make(name, {.seed = 1});
    for (int i = 0; i < 20; ++i) {
      controller->step(robot);
      hardware.advance();
    }
    const bool moved = hardware.odometry().odom_from_robot != mrpt::math::TPose2D();
    // At the start are the place of hold_door, by default; pass_door waits for it; an oracle without a map stands
    // still.
    const std::set<std::string> standing{"still", "oracle", "hold_door", "pass_door"};
    EXPECT_EQ(moved, !standing.contains(name)) << name;
  }
}

TEST(Controllers, OfUnknownNamesAreRefusedWithAListOfAll) {
  try {
    controllers().make("gold_digger", {});
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(
        error.what(),
        "there is no controller 'gold_digger'; take one of gold_finder, wander, wall_follower, still, "
        "random_walk, levy_walk, wall_search, heat_gradient, stigmergy, oracle, coordinated_frontiers, market, "
        "forage, soccer, push_together, hold_door, pass_door");
  }
}

}  // namespace
}  // namespace robosim
