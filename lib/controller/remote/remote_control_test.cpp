#include "remote/remote_control.h"

#include <gtest/gtest.h>

#include "remote/testing/test_robot.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

struct RemoteControlTest : testing::Test {
  std::vector<std::unique_ptr<TestRobot>> team;
  std::vector<RobotAddress> list;
  RemoteControl::Clock::time_point now{1h};

  RemoteControlTest() {
    for (const char* name : {"A", "B", "C"}) {
      team.push_back(std::make_unique<TestRobot>(name));
      list.push_back({name, "127.0.0.1", static_cast<std::uint16_t>(team.back()->port()), list.empty()});
    }
  }
  std::unique_ptr<RemoteControl> start(const std::string& driver = "Anna") {
    RemoteControl::Options options;
    options.driver = driver;
    options.now = [this] { return now; };
    return std::make_unique<RemoteControl>(list, options);
  }
  /// A tenth of a second for all robots.
  void step(RemoteControl& control) {
    for (auto& robot : team) robot->step();
    control.tick();
    now += 100ms;
  }
  void wait(RemoteControl& control, const std::function<bool()>& until, const CallSite& place = CallSite::here()) {
    waitUntil(
        until, [&] { step(control); }, place);
  }
  static bool allUp(const RemoteControl& control) {
    for (const auto& robot : control.robots()) {
      if (!robot.news.is_up) return false;
    }
    return true;
  }
  static std::string row(const RemoteControl& control) {
    std::string names;
    for (const auto& robot : control.robots()) names += robot.name;
    return names;
  }
};

TEST_F(RemoteControlTest, SetsSecondaryRobotsAutonomousAndClaimsThePrimary) {
  const auto control = start();
  wait(*control, [&] { return allUp(*control); });
  EXPECT_EQ(row(*control), "ABC");
  EXPECT_FALSE(control->robots()[0].news.state.autonomous());
  EXPECT_TRUE(control->robots()[1].news.state.autonomous());
  EXPECT_TRUE(control->robots()[2].news.state.autonomous());
}

TEST_F(RemoteControlTest, ConnectsThePrimaryLast) {
  team[1]->close();  // refused at once, and so settled
  const auto control = start();
  control->tick();
  EXPECT_EQ(team[0]->log(), "") << "the secondary robots are not connected yet";
  // Without a limit in time: the clock stands.
  waitUntil([&] { return control->primary().news.is_up; },
            [&] {
              for (auto& robot : team) robot->step();
              control->tick();
            });
  EXPECT_TRUE(control->robots()[2].news.is_up);
  EXPECT_FALSE(control->robots()[1].news.is_up);
}

TEST_F(RemoteControlTest, RequestsTheHeatOfSecondaryRobots) {
  const auto control = start();
  const auto answer = [&](std::size_t i) { return control->robots()[i].news.answers[0]; };
  wait(*control, [&] { return answer(1) && answer(2); });
  const auto first = answer(1)->step;
  wait(*control, [&] { return answer(1)->step > first; });  // repeatedly
  EXPECT_TRUE(answer(1)->has_sensor);
  EXPECT_EQ(answer(0), nullptr) << "the primary's is in its updates";
}

TEST_F(RemoteControlTest, SteersOnlyThePrimary) {
  const auto control = start();
  wait(*control, [&] { return allUp(*control); });
  control->send(makeOrder(OrderType::accelerate));
  wait(*control, [&] { return team[0]->hardware->lastCommand().speed_mps > 0; });
  EXPECT_EQ(team[1]->hardware->lastCommand(), (Command{.turn_radps = 1})) << "its controller's";
}

TEST_F(RemoteControlTest, ASwitchSetsTheOldPrimaryAutonomousAndClaimsTheNext) {
  const auto control = start();
  wait(*control, [&] { return allUp(*control); });
  EXPECT_TRUE(control->switchPrimary());
  EXPECT_EQ(row(*control), "BCA");
  wait(*control,
       [&] { return !control->robots()[0].news.state.autonomous() && control->robots()[2].news.state.autonomous(); });
  control->send(makeOrder(OrderType::accelerate));
  wait(*control, [&] { return team[1]->hardware->lastCommand().speed_mps > 0; });
  EXPECT_EQ(team[0]->hardware->lastCommand(), (Command{.turn_radps = 1}));
  wait(*control, [&] { return control->primary().news.update != nullptr; });
  EXPECT_EQ(control->primary().news.info->name, "B");
}

TEST_F(RemoteControlTest, SkipsAnUnreachableRobotAndReconnectsIt) {
  team[1]->close();
  const auto control = start();
  wait(*control, [&] { return control->robots()[0].news.is_up && control->robots()[2].news.is_up; });
  EXPECT_NE(control->robots()[1].news.problem.find("no robot answers at " + team[1]->address()), std::string::npos);
  EXPECT_FALSE(control->switchTo("B"));
  EXPECT_TRUE(control->switchPrimary());
  EXPECT_EQ(row(*control), "CBA");

  team[1]->reopen();
  wait(*control, [&] { return allUp(*control); });
  EXPECT_TRUE(control->robots()[1].news.state.autonomous());
  EXPECT_TRUE(control->switchTo("B"));
  EXPECT_EQ(row(*control), "BAC");
}

TEST_F(RemoteControlTest, AReconnectedRobotIsDrivenOnlyIfItIsStillThePrimary) {
  const auto control = start();
  wait(*control, [&] { return allUp(*control); });
  team[0]->close();
  wait(*control, [&] { return !control->primary().news.is_up; });
  team[0]->reopen();
  wait(*control, [&] { return control->primary().news.is_up; });
  EXPECT_FALSE(control->primary().news.state.autonomous());

  team[0]->close();
  wait(*control, [&] { return !control->primary().news.is_up; });
  EXPECT_TRUE(control->switchPrimary());
  team[0]->reopen();
  wait(*control, [&] { return allUp(*control); });
  EXPECT_TRUE(control->robots()[2].news.state.autonomous()) << "A, at the tail";
}

TEST_F(RemoteControlTest, AReconnectedRobotIsNotAutonomousAfterAStop) {
  const auto control = start();
  wait(*control, [&] { return allUp(*control); });
  control->send(modeOrder(true));
  wait(*control, [&] { return control->primary().news.state.autonomous(); });
  control->send(stopOrder("Anna's page is hidden"));
  control->send(makeOrder(OrderType::check_win));
  wait(*control, [&] { return team[0]->hardware->win_checks > 0; });  // the stop precedes it
  EXPECT_TRUE(team[0]->robot.state().autonomous()) << "the driver has not requested this stop";
  control->send(makeOrder(OrderType::stop));
  wait(*control, [&] { return !control->primary().news.state.autonomous(); });
  team[0]->close();
  wait(*control, [&] { return !control->primary().news.is_up; });
  team[0]->reopen();
  wait(*control, [&] { return control->primary().news.is_up && control->primary().news.state.is_yours(); });
  EXPECT_FALSE(control->primary().news.state.autonomous());
}

TEST_F(RemoteControlTest, KeepsThePrimaryWithoutAnotherFitRobot) {
  team[1]->close();
  team[2]->close();
  const auto control = start();
  wait(*control, [&] { return control->primary().news.is_up; });
  EXPECT_FALSE(control->switchPrimary());
  EXPECT_FALSE(control->switchTo("unknown"));
  EXPECT_EQ(row(*control), "ABC");
}

TEST_F(RemoteControlTest, ASecondRemoteControlWatchesAndSkipsRobotsOfTheFirst) {
  const auto anna = start();
  wait(*anna, [&] { return allUp(*anna); });
  const auto ben = start("Ben");
  wait(*ben, [&] { return allUp(*ben); });
  EXPECT_FALSE(ben->primary().news.state.is_yours());
  EXPECT_EQ(ben->primary().news.state.driver(), "Anna");
  EXPECT_FALSE(ben->switchPrimary()) << "all of them are Anna's";
  ben->send(makeOrder(OrderType::accelerate));
  wait(*ben, [&] { return ben->primary().news.update != nullptr; });
  EXPECT_EQ(team[0]->hardware->lastCommand().speed_mps, 0);
}

TEST_F(RemoteControlTest, SendsTheNameOfTheNextDriver) {
  const auto control = start();
  wait(*control, [&] { return allUp(*control); });
  control->setDriver("Ben");
  wait(*control, [&] { return control->primary().news.state.driver() == "Ben"; });
  EXPECT_TRUE(control->primary().news.state.is_yours());
}

}  // namespace
}  // namespace robosim
