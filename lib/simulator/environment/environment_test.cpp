#include "environment/environment.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "environment/local_hardware.h"
#include "environment/testing/small_world.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

struct Scenario {
  World world = emptyWorld(10);
  Fleet fleet;
  EnvironmentOptions options;

  void robot(const std::string& name, const mrpt::math::TPose2D& start, double radius_m = 0.25) {
    addDisc(world, fleet, name, start, radius_m);
  }
  std::unique_ptr<Environment> start() const { return std::make_unique<Environment>(world, fleet, options); }
};

TEST(Environment, MovesARobotByItsSpeedTimesTheTimeStep) {
  Scenario s;
  s.robot("a", {0, 0, M_PI_2});
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 0.5});
  for (int i = 0; i < 10; ++i) environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0, 1e-12);
  EXPECT_NEAR(environment->state().world_from_robot[0].y, 0.5, 1e-12);
  EXPECT_NEAR(environment->state().driven_m[0], 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(environment->time().seconds(), 1);
}

TEST(Environment, KeepsTheLastCommandUntilThereIsAnother) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->setCommand(0, {.speed_mps = 0.5});
  environment->step();
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0.1, 1e-12);
}

TEST(Environment, TreatsANonFiniteCommandAsZero) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  auto environment = s.start();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  environment->setCommand(0, {.speed_mps = std::numeric_limits<double>::infinity(),
                              .turn_radps = nan,
                              .laser_pan_rad = static_cast<float>(nan)});
  environment->step();
  EXPECT_EQ(environment->state().world_from_robot[0], mrpt::math::TPose2D(0, 0, 0));
  EXPECT_EQ(environment->state().laser_pan_rad[0], 0);
}

TEST(Environment, StopsARobotAtTheFirstContactAndMarksItStalled) {
  Scenario s;
  addWall(s.world, 1.5, 0, 1, 10);  // its face is at x = 1
  s.robot("a", {0.7, 0, 0});
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0.75, 2e-6);
  EXPECT_LT(environment->state().world_from_robot[0].x, 0.75);
  EXPECT_TRUE(environment->state().stalled[0]);
  EXPECT_TRUE(environment->state().readings[0].stalled);
  EXPECT_EQ(environment->state().stalls, 1u);
  environment->setCommand(0, {.speed_mps = -1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0.65, 2e-6) << "it can leave the wall";
  EXPECT_FALSE(environment->state().stalled[0]);
}

TEST(Environment, LetsARobotAtAWallTurnAndSlideAlongIt) {
  Scenario s;
  addWall(s.world, 1.5, 0, 1, 10);
  s.robot("a", {0.75 - 5e-7, 0, M_PI_2});  // nearer than the contact gap
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].y, 0.1, 1e-12);
  environment->setCommand(0, {.turn_radps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].phi, M_PI_2 + 0.1, 1e-12);
}

TEST(Environment, StopsARobotWhereAnotherStarted) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  s.robot("b", {0.55, 0, 0});
  auto environment = s.start();
  // b drives away at the same speed, yet a stops where b started: the rule is order-independent.
  environment->setCommand(0, {.speed_mps = 1});
  environment->setCommand(1, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0.05, 2e-6);
  EXPECT_NEAR(environment->state().world_from_robot[1].x, 0.65, 1e-12);
  EXPECT_TRUE(environment->state().stalled[0]);
  EXPECT_FALSE(environment->state().stalled[1]);
}

TEST(Environment, StopsBothRobotsWhosePathsCollide) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  s.robot("b", {0.65, 0, M_PI});
  auto environment = s.start();
  // The gap is 0.15 m; rule (a) allows each robot 0.1 m, but both together would touch.
  environment->setCommand(0, {.speed_mps = 1});
  environment->setCommand(1, {.speed_mps = 1});
  environment->step();
  EXPECT_EQ(environment->state().world_from_robot[0].x, 0);
  EXPECT_EQ(environment->state().world_from_robot[1].x, 0.65);
  EXPECT_EQ(environment->state().stalls, 2u);
}

TEST(Environment, StopsASlowRobotThatAFastReversingRobotWouldHit) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  addDisc(s.world, s.fleet, "b", {2.505, 0, 0}, 0.25, {20, 2, 1e6, 1e6, 1e6});
  auto environment = s.start();
  // Alone, b would come to x = 0.505, 5 mm from where a started; a goes 20 mm ahead in the same time.
  environment->setCommand(0, {.speed_mps = 0.2});
  environment->setCommand(1, {.speed_mps = -20});
  environment->step();
  EXPECT_EQ(environment->state().world_from_robot[0].x, 0);
  EXPECT_EQ(environment->state().world_from_robot[1].x, 2.505);
  EXPECT_EQ(environment->state().stalls, 2u);
}

TEST(Environment, LetsRobotsCrossTheSamePointAtDifferentTimes) {
  Scenario s;
  s.robot("a", {-0.05, 0, 0}, 0.01);
  s.robot("b", {0.02, -0.1, M_PI_2}, 0.01);
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->setCommand(1, {.speed_mps = 1});
  environment->step();
  // They are nearest after 85 % of the step, a at (0.035, 0) and b at (0.02, -0.015): 0.0212 m, more than both radii.
  EXPECT_EQ(environment->state().stalls, 0u);
}

TEST(Environment, KeepsARobotOnTheSurface) {
  Scenario s;
  s.robot("a", {9.7, 0, 0});
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 9.75, 2e-6) << "the edge is at 10";
  EXPECT_TRUE(environment->state().stalled[0]);
  environment->setCommand(0, {.turn_radps = M_PI_2 / 0.1});
  for (int i = 0; i < 8; ++i) environment->step();  // 2 rad/s at most: 1.6 rad to the left
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].y, 0.1, 1e-3) << "it can drive along the edge";
}

TEST(Environment, IgnoresObstaclesAtOtherHeights) {
  Scenario s;
  addWall(s.world, 1.5, 0, 1, 10);
  s.world.objects[0].body.center_z_m = 0.85;  // a beam from 0.35 to 1.35 m over a robot of 0.3 m
  s.robot("a", {0.7, 0, 0});
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_NEAR(environment->state().world_from_robot[0].x, 0.8, 1e-12);
}

TEST(Environment, NeverLetsARobotThroughAThinWallAtTopSpeed) {
  for (const double speed_mps : {1.0, 10.0, 1000.0}) {
    for (const double turned_rad : {0.0, 0.3, M_PI_4}) {
      Scenario s;
      addWall(s.world, 1, 0, 0.001, 30, turned_rad);
      addDisc(s.world, s.fleet, "a", {-2, 0, 0}, 0.05, {speed_mps, 100, 1e9, 1e9, 1e9});
      s.options.period_s = 1;
      auto environment = s.start();
      for (const double turn_radps : {0.0, 0.1, -0.1}) {
        environment->setCommand(0, {.speed_mps = speed_mps, .turn_radps = turn_radps});
        for (int i = 0; i < 10; ++i) environment->step();
        const auto& pose = environment->state().world_from_robot[0];
        const double beyond = (pose.x - 1) * std::cos(turned_rad) + pose.y * std::sin(turned_rad);
        const bool round_its_end = std::abs(-(pose.x - 1) * std::sin(turned_rad) + pose.y * std::cos(turned_rad)) > 15;
        EXPECT_TRUE(beyond < -0.05 || round_its_end) << speed_mps << " m/s, wall turned " << turned_rad;
      }
    }
  }
}

TEST(Environment, AcceleratesAndBrakesAsTheModelCan) {
  Scenario s;
  addDisc(s.world, s.fleet, "a", {0, 0, 0}, 0.25,
          {.speed_max_mps = 0.7, .turn_max_radps = 1, .accel_mps2 = 3, .decel_mps2 = 2, .turn_accel_radps2 = 5});
  auto environment = s.start();
  const auto speed_after_step = [&](double wish_mps) {
    environment->setCommand(0, {.speed_mps = wish_mps});
    environment->step();
    return environment->state().speed_mps[0];
  };
  EXPECT_DOUBLE_EQ(speed_after_step(9), 0.3);
  EXPECT_DOUBLE_EQ(speed_after_step(9), 0.6);
  EXPECT_DOUBLE_EQ(speed_after_step(9), 0.7) << "never above its top speed";
  EXPECT_DOUBLE_EQ(speed_after_step(-9), 0.5);
  EXPECT_DOUBLE_EQ(speed_after_step(0.45), 0.45);
  EXPECT_DOUBLE_EQ(speed_after_step(-9), 0.25);
  EXPECT_DOUBLE_EQ(speed_after_step(-9), 0.05);
  EXPECT_DOUBLE_EQ(speed_after_step(-9), 0) << "it stops before it reverses";
  EXPECT_DOUBLE_EQ(speed_after_step(-9), -0.3);
}

TEST(Environment, BrakesARobotThatHasHalted) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  s.robot("b", {3, 0, 0});
  auto environment = s.start();
  environment->setCommand(0, {.speed_mps = 1, .activity = Activity::found});
  environment->step();
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_EQ(environment->state().activity[0], Activity::found) << "a halt is final";
  EXPECT_EQ(environment->state().world_from_robot[0].x, 0);
  EXPECT_FALSE(environment->allHalted());
  environment->setCommand(1, {.activity = Activity::halted});
  environment->step();
  EXPECT_TRUE(environment->allHalted());
}

/// Counts the stationary solids near its robot. Its range is 2 m.
class NeighbourCounter : public Sensor {
 public:
  NeighbourCounter() {
    info_.kind = SensorKind::heat;
    info_.label = "neighbours";
    info_.range_max_m = 2;
    info_.beams.push_back({{0, 0, 0.1, 0, 0, 0}});
  }
  const SensorInfo& info() const override { return info_; }
  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      std::get<Scalar>(readings[robot].measurements[slot]).value = static_cast<double>(now.scene.neighbourCount(robot));
    }
  }

 private:
  SensorInfo info_;
};

TEST(Environment, ListsNeighboursUpToTheRangeOfTheSensorsThatUseThem) {
  Scenario s;
  addWall(s.world, 1, 0, 0.1, 0.1);
  addWall(s.world, 8, 0, 0.1, 0.1);
  s.robot("a", {0, 0, 0});
  for (const auto& [other, neighbours] :
       {std::pair{"<beacons range_max_m='50'><beacon x_m='9'/></beacons>", 1}, std::pair{"<laser range_max_m='9'/>", 2},
        std::pair{"<laser x_m='1.5' range_max_m='6.5'/>", 2}}) {
    FleetRobot& robot = s.fleet.robots[0];
    auto model = std::make_shared<RobotModel>(*robot.model);
    model->sensors = {std::make_shared<NeighbourCounter>(), sensorFrom(other)};
    model->sensor_infos =
        std::make_shared<std::vector<SensorInfo>>(std::vector{model->sensors[0]->info(), model->sensors[1]->info()});
    robot.info.sensors = model->sensor_infos;
    robot.model = std::move(model);
    EXPECT_EQ(std::get<Scalar>(s.start()->state().readings[0].measurements[0]).value, neighbours) << other;
  }
}

TEST(Environment, ProvidesARobotAsHardware) {
  Scenario s;
  s.robot("a", {0, 0, 0});
  s.robot("b", {3, 0, 0});
  auto environment = s.start();
  LocalHardware a(*environment, 0);
  LocalHardware b(*environment, 1);
  EXPECT_EQ(b.info().name, "b");
  EXPECT_EQ(b.robots(), (std::vector<std::string>{"a", "b"}));
  a.command({.speed_mps = 1});
  a.send("b", "hello");
  environment->step();
  EXPECT_NEAR(std::get<Odometry>(a.readings().measurements[0]).odom_from_robot.x, 0.1, 1e-12);
  ASSERT_EQ(b.readings().inbox.size(), 1u);
  EXPECT_EQ(b.readings().inbox[0], (RobotMessage{"a", "b", "hello"}));
}

}  // namespace
}  // namespace robosim
