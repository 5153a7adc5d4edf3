// Sensor::robotReach() of all kinds of sensors for which it is finite.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "environment/environment.h"
#include "environment/step_phases.h"
#include "environment/testing/small_world.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kMeasuringSpeed_mps = 2;
constexpr std::uint32_t kOthers = 14;

/// A robot that measures, and others, discs and boxes, that are far away at first.
std::unique_ptr<Environment> sceneOf(Rng& rng) {
  World world = emptyWorld(60);
  Fleet fleet;
  addDisc(world, fleet, "measuring", {0, 0, rng.uniform(-3, 3)}, 0.2, {kMeasuringSpeed_mps, 4, 1e6, 1e6, 1e6});
  for (std::uint32_t i = 0; i < kOthers; ++i) {
    addDisc(world, fleet, "r" + std::to_string(i), {-50 + 3.0 * i, -50, rng.uniform(-3, 3)}, rng.uniform(0.1, 0.4));
    FleetRobot& robot = fleet.robots.back();
    Body body = robot.body();
    body.fiducial = 1 + i;
    const double radius_m = robot.info.radius_m;
    if (i % 2 != 0) body.shape = Cube{2 * radius_m * 0.8, 2 * radius_m * 0.6};  // of this radius
    robot.own_body = body;
  }
  addWall(world, 1.5, rng.uniform(-2, 2), 0.5, 0.1, rng.uniform(0, 3));
  for (int i = 0; i < 6; ++i) {
    WorldObject lamp;
    lamp.name = "lamp" + std::to_string(i);
    lamp.body = {.shape = Cylinder{0.02},
                 .world_from_body = {2.4 * std::cos(i), 2.4 * std::sin(i), 0},
                 .center_z_m = 0.1,
                 .height_m = 0.01};
    lamp.body.light_cd = 10;
    world.objects.push_back(lamp);
  }
  EnvironmentOptions options;
  options.seed = rng.below(1'000'000);
  auto environment = std::make_unique<Environment>(world, fleet, options);
  for (std::uint32_t i = 1; i <= kOthers; ++i) environment->setCommand(i, {.led_color = i});
  return environment;
}

/// From the measuring robot's centre to the nearest part of another robot [m].
double distanceTo(const Environment& environment, std::uint32_t robot) {
  const State& state = environment.state();
  Body body = environment.fleet().robots[robot].body();
  body.world_from_body = state.world_from_robot[robot];
  const auto& from = state.world_from_robot[0];
  return distance(body.solid().outline, {from.x, from.y});
}

/// Places the others about the measuring robot: discs so that they end at the reach or slightly beyond, boxes anywhere
/// near. Those for which there is no place stay where they are.
void placeOthers(Environment& environment, double reach_m, Rng& rng) {
  const auto centre = environment.state().world_from_robot[0];
  for (std::uint32_t robot = 1; robot <= kOthers; ++robot) {
    const double radius_m = environment.fleet().robots[robot].info.radius_m;
    const bool is_disc = std::holds_alternative<Cylinder>(environment.fleet().robots[robot].body().shape);
    constexpr double kBeyond_m[] = {0, 1e-6, 1e-3, -1e-3, -0.1};
    const double off_m = is_disc ? reach_m + radius_m + kBeyond_m[rng.below(5)]
                                 : rng.uniform(std::max(0.5, 0.3 * reach_m), 1.1 * reach_m + 2 * radius_m);
    const double direction = rng.uniform(-M_PI, M_PI);
    const PlaceBody place{environment.robotNames()[robot], centre.x + off_m * std::cos(direction),
                          centre.y + off_m * std::sin(direction), rng.uniform(-3, 3)};
    static_cast<void>(environment.apply({"test", place}));
  }
}

/// What the measuring robot's sensor measures when only robots within a distance are in the scene.
Measurement measuredWith(Environment& environment, const Sensor& sensor, double distance_m) {
  std::vector<std::uint32_t> known{0};
  for (std::uint32_t robot = 1; robot <= kOthers; ++robot) {
    if (distanceTo(environment, robot) <= distance_m + 1e-9) known.push_back(robot);
  }
  environment.phases().limitTo(known, {0, 1});
  std::vector<Readings> readings(1 + kOthers);
  readings[0].measurements = {sensor.blank()};
  environment.measure(sensor, std::vector<std::uint32_t>{0}, readings);
  return readings[0].measurements[0];
}

/// Numbers of random scenes in which robots beyond the reach change a measurement, and in which those in its outer half
/// do.
struct Changes {
  int beyond = 0, within = 0;
};

Changes changesOf(const std::string& sensor_xml) {
  const auto sensor = sensorFrom(sensor_xml);
  const double reach_m = sensor->robotReach(kMeasuringSpeed_mps);
  EXPECT_TRUE(std::isfinite(reach_m)) << sensor_xml;
  Rng rng(1);
  Changes changes;
  for (int round = 0; round < 150; ++round) {
    const auto environment = sceneOf(rng);
    for (int step = 0; step < 3; ++step) {
      environment->setCommand(0, {.speed_mps = rng.uniform(-2, 2), .turn_radps = rng.uniform(-4, 4)});
      environment->step();
    }
    placeOthers(*environment, reach_m, rng);
    const Measurement within = measuredWith(*environment, *sensor, reach_m);
    if (measuredWith(*environment, *sensor, 100) != within) ++changes.beyond;
    if (measuredWith(*environment, *sensor, reach_m / 2) != within) ++changes.within;
  }
  return changes;
}

TEST(RobotReach, OfRangeSensorsContainsAllRobotsThatAffectAMeasurement) {
  for (const char* sensor : {
           "<sonar range_max_m='2' beam_width_deg='30'><ring count='8' radius_m='0.2' z_m='0.1'/></sonar>",
           "<sonar range_max_m='2' beam_width_deg='40' model='rays' rays='5'><at x_m='-0.3' y_m='0.2' z_m='0.1' "
           "angle_deg='70'/><at x_m='0.1' z_m='0.1'/></sonar>",
           "<sonar range_max_m='2' noise='polaroid'><noise robot_crosstalk='0.5' crosstalk='0.2' second_echoes='1' "
           "ringing='0.1'/><ring count='8' radius_m='0.1' z_m='0.1'/></sonar>",
           "<infrared range_max_m='1'><ring count='12' radius_m='0.2' z_m='0.1'/></infrared>",
           "<infrared noise='gp2d12'><ring count='12' radius_m='0.2' z_m='0.1'/></infrared>",
           "<laser beams='90' field_of_view_deg='360' range_max_m='2' z_m='0.1'/>",
           "<laser beams='90' field_of_view_deg='360' range_max_m='2' x_m='0.2' y_m='-0.1' z_m='0.1' sweep_s='0.3' "
           "latency_s='0.2'/>",
           "<laser beams='60' field_of_view_deg='360' range_max_m='2' z_m='0.1' noise='lms200' sweep_s='0.1'/>",
           "<laser beams='60' field_of_view_deg='360' range_max_m='2' z_m='0.1'><noise divergence_deg='2' "
           "reach_m='1.5' drift_m='0.1'/></laser>",
           "<range_and_bearing range_max_m='2' count='14' z_m='0.1'/>",
           "<range_and_bearing range_max_m='2' count='3' z_m='0.1'><noise/></range_and_bearing>",
           "<omni_camera range_max_m='2' x_m='0.1' z_m='0.5'><noise/></omni_camera>",
           "<fiducial range_max_m='2' x_m='0.1' z_m='0.5' field_of_view_deg='300'/>",
       }) {
    const Changes changes = changesOf(sensor);
    EXPECT_EQ(changes.beyond, 0) << sensor;
    EXPECT_GT(changes.within, 30) << sensor << ": the scenes are too easy";
  }
}

TEST(RobotReach, OfLightSensorsContainsAllRobotsThatCastShadows) {
  const Changes changes = changesOf("<light range_max_m='3.2'><ring count='4' radius_m='0.2' z_m='0.1'/></light>");
  EXPECT_EQ(changes.beyond, 0);
  EXPECT_GT(changes.within, 5);
}

TEST(RobotReach, OfABumperIsThatOfItsSegments) {
  const Changes changes = changesOf("<bumper segments='8' travel_m='0.1' z_m='0.1'/>");
  EXPECT_EQ(changes.beyond, 0);
  EXPECT_GT(changes.within, 10);
}

TEST(RobotReach, OfSensorsOfTheOwnRobotIsZero) {
  for (const char* sensor :
       {"<heat range_max_m='5'><noise lag_s='1'/></heat>", "<compass><noise/></compass>", "<odometry/>",
        "<ground><at x_m='0.1'/><noise/></ground>", "<battery><noise drop_v_per_mps='0.03' std_v='0.02'/></battery>"}) {
    EXPECT_EQ(sensorFrom(sensor)->robotReach(kMeasuringSpeed_mps), 0) << sensor;
    const Changes changes = changesOf(sensor);
    EXPECT_EQ(changes.beyond, 0) << sensor;
  }
}

}  // namespace
}  // namespace robosim
