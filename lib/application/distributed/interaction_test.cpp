#include "distributed/interaction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "environment/testing/small_world.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kPeriod_s = 0.1;

struct Scenario {
  World world = emptyWorld(10);
  Fleet fleet;

  /// Adds a robot of 0.25 m radius and up to 1 m/s, with odometry and a sensor.
  void robot(const std::string& sensor_xml = "", double radius_m = 0.25) {
    addDisc(world, fleet, "r" + std::to_string(fleet.robots.size()), {0, 0, 0}, radius_m);
    if (sensor_xml.empty()) return;
    auto model = std::make_shared<RobotModel>(*fleet.robots.back().model);
    model->sensors.push_back(sensorFrom(sensor_xml));
    fleet.robots.back().model = model;
  }
  Interaction interaction() const { return Interaction::of(world, fleet, kPeriod_s); }
};

TEST(Interaction, OfRobotsWithoutRangeSensorsIsByCollisions) {
  Scenario s;
  s.robot();
  EXPECT_NEAR(s.interaction().step_m, 0.1, 1e-6);
  EXPECT_NEAR(s.interaction().reach_m, 2 * 0.25 + 2 * 0.1, 1e-5);
  s.robot("", 0.4);
  EXPECT_NEAR(s.interaction().reach_m, 2 * 0.4 + 2 * 0.1, 1e-5);
  EXPECT_EQ(s.interaction().unlimited_by, "");
}

TEST(Interaction, OfRangeSensorsReachesToTheEdgeOfTheLargestRobot) {
  const auto reach = [](const std::string& sensor_xml) {
    Scenario s;
    s.robot(sensor_xml);
    s.robot("", 0.4);
    EXPECT_EQ(s.interaction().unlimited_by, "") << sensor_xml;
    return s.interaction().reach_m;
  };
  EXPECT_NEAR(reach("<laser range_max_m='8' x_m='0.3' y_m='-0.4'/>"), 8 + 0.5 + 0.4, 1e-4);
  EXPECT_NEAR(reach("<sonar range_max_m='3'><at x_m='0.1'/><at x_m='-0.2'/></sonar>"), 3 + 0.2 + 0.4, 1e-4);
  EXPECT_NEAR(reach("<range_and_bearing range_max_m='6'/>"), 6 + 0.4, 1e-4);
  // A scan that began 2 s ago, from where a robot of 1 m/s was then.
  EXPECT_NEAR(reach("<laser range_max_m='8' sweep_s='1.5' latency_s='0.5'/>"), 8 + 2 + 0.4, 1e-4);
  // Less than a collision's reach.
  for (const char* near : {"<compass/>", "<bumper travel_m='0.01'/>", "<heat/>", "<battery/>"})
    EXPECT_NEAR(reach(near), 2 * 0.4 + 2 * 0.1, 1e-4) << near;
}

TEST(Interaction, IsUnlimitedByWhatDependsOnRobotsAnywhere) {
  const auto cause = [](const Scenario& s) { return s.interaction().unlimited_by; };
  Scenario beacons;
  beacons.robot();
  beacons.robot("<beacons><beacon x_m='9'/></beacons>");
  EXPECT_EQ(cause(beacons), "sensor 'beacons' of robot 'r1' may measure robots at any distance");
  Scenario camera;
  camera.robot("<camera/>");
  EXPECT_EQ(cause(camera), "sensor 'camera' of robot 'r0' may measure robots at any distance");
  Scenario hot;
  hot.robot();
  hot.fleet.robots[0].own_body = hot.fleet.robots[0].body();
  hot.fleet.robots[0].own_body->heat_celsius = 30;
  EXPECT_EQ(cause(hot), "robot 'r0' is hot");
  Scenario radio;
  radio.robot();
  radio.world.communication.loss_probability = 0.5;
  EXPECT_EQ(cause(radio), "");
  radio.world.communication.range_m = 5;
  EXPECT_EQ(cause(radio), "messages depend on the positions of their senders and receivers");
  radio.world.communication = {.wall_loss = 0.1};
  EXPECT_EQ(cause(radio), "messages depend on the positions of their senders and receivers");
}

}  // namespace
}  // namespace robosim
