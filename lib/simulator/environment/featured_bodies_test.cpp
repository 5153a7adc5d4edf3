// What sensors of the floor, of lights, of LEDs and of marks measure in a run, and after interventions.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"
#include "robots/fleet.h"

namespace robosim {
namespace {

constexpr const char* kType = R"(<robot name="bot" help="Sees all of it.">
  <body radius_m="0.1" height_m="0.2" fiducial="5"/>
  <limits speed_max_mps="1" accel_mps2="1000" decel_mps2="1000" turn_max_degps="100" turn_accel_degps2="36000"/>
  <sensors>
    <ground><at/></ground>
    <light><at x_m="0.1" z_m="0.1"/></light>
    <omni_camera count="2"/>
    <fiducial count="2"/>
  </sensors>
</robot>)";
enum Slot { kGround, kLight, kCamera, kFiducial };

/// A painted square of cells of 0.5 m.
WorldMap floorOf(std::uint32_t cells) {
  WorldMap map;
  map.height_m = 0;
  map.plan.columns = map.plan.rows = cells;
  map.plan.cell_m = 0.5;
  map.plan.occupied = {{.columns = cells, .rows = cells}};
  return map;
}

/// A dark area about the origin, where the first robot is, a second robot 1 m ahead of it, and a lamp of 4 cd above,
/// 2.1 m ahead, as high as the light sensor.
struct Swarm {
  explicit Swarm(const std::function<void(World&)>& change = {}) {
    World world = emptyWorld(4);
    WorldObject area{.name = "area",
                     .body = {.shape = Cylinder{0.5}, .world_from_body = {}, .center_z_m = -0.05, .height_m = 0.1},
                     .line = {}};
    area.body.color = {0.2f, 0.2f, 0.2f};
    world.objects.push_back(area);
    WorldObject lamp{
        .name = "lamp", .body = {.shape = Cylinder{0.01}, .world_from_body = {}, .height_m = 0.02}, .line = {}};
    lamp.body.world_from_body = {2.1, 0, 0};
    lamp.body.center_z_m = 0.3;
    lamp.body.light_cd = 4;
    lamp.body.color = {1, 1, 0};
    world.objects.push_back(lamp);
    for (const double x_m : {0.0, 1.0}) {
      RobotPlacement placement;
      placement.name = x_m == 0 ? "first" : "second";
      placement.model = "bot";
      placement.world_from_robot = {x_m, 0, 0};
      world.robots.push_back(placement);
    }
    if (change) change(world);
    ErrorList errors;
    Fleet fleet = buildFleet(world, "swarm.xml", {{"bot", {"bot.xml", kType}}}, {}, errors);
    errors.throwIfAny();
    environment = std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
  }
  std::vector<double> values(Slot slot, std::size_t robot = 0) const {
    return std::get<Values>(environment->state().readings[robot].measurements[slot]).values;
  }
  void intervene(const std::string& change) const {
    EXPECT_EQ(environment->apply({"test", parseChange(change, "test")}), "") << change;
    environment->step();
  }
  std::unique_ptr<Environment> environment;
};

TEST(FeaturedBodies, AreasOfTheFloorAreChangedByInterventions) {
  const Swarm swarm;
  EXPECT_FLOAT_EQ(swarm.values(kGround)[0], 0.2f);
  EXPECT_EQ(swarm.values(kGround, 1)[0], 1);
  swarm.intervene("<change name='area' color='0.5 0.5 0.5'/>");
  EXPECT_FLOAT_EQ(swarm.values(kGround)[0], 0.5f);
  swarm.intervene("<place name='area' x='1' y='0'/>");  // below the second robot
  EXPECT_EQ(swarm.values(kGround)[0], 1);
  EXPECT_FLOAT_EQ(swarm.values(kGround, 1)[0], 0.5f);
  swarm.intervene(
      "<add><cube><name>track</name><x>0.5</x><y>0</y><z>-0.05</z><length>2</length><width>0.1</width>"
      "<height>0.1</height><color>0 0 0</color></cube></add>");  // over the area
  EXPECT_EQ(swarm.values(kGround)[0], 0);
  EXPECT_EQ(swarm.values(kGround, 1)[0], 0);
  swarm.intervene("<remove name='track'/>");
  EXPECT_FLOAT_EQ(swarm.values(kGround, 1)[0], 0.5f);
}

TEST(FeaturedBodies, RobotsDriveOverAreasAndPictures) {
  const Swarm swarm([](World& world) {
    WorldMap map = floorOf(10);
    map.world_from_map = {-2.5, -2.5, 0};
    world.maps.push_back(map);
  });
  EXPECT_FLOAT_EQ(swarm.values(kGround, 1)[0], 0.5f) << "the picture's grey";
  for (int i = 0; i < 5; ++i) {
    swarm.environment->setCommand(1, {.speed_mps = 1});
    swarm.environment->step();
  }
  EXPECT_NEAR(swarm.environment->state().world_from_robot[1].x, 1.5, 1e-9);
  EXPECT_EQ(swarm.environment->state().stalls, 0u);
}

TEST(FeaturedBodies, LightsAreSwitchedAndMovedByInterventions) {
  const Swarm swarm;
  // 2 m along the axis and 0.2 m up; the second robot, 0.2 m high, is below the line at its place, 0.2 m high as well.
  const double distance_2 = 4 + 0.04;
  const double lux = 4 / distance_2 * 2 / std::sqrt(distance_2);
  swarm.intervene("<remove name='second'/>");
  EXPECT_NEAR(swarm.values(kLight)[0], lux, 1e-6);
  swarm.intervene("<change name='lamp' light='8'/>");
  EXPECT_NEAR(swarm.values(kLight)[0], 2 * lux, 1e-6);
  swarm.intervene("<change name='lamp' light='0'/>");
  EXPECT_EQ(swarm.values(kLight)[0], 0);
  swarm.intervene("<change name='lamp' light='4'/>");
  swarm.intervene("<place name='lamp' x='-2' y='0'/>");
  EXPECT_EQ(swarm.values(kLight)[0], 0) << "behind";
}

TEST(FeaturedBodies, LedsAreSeenInTheStepOfTheirCommand) {
  const Swarm swarm;
  EXPECT_EQ(swarm.values(kCamera)[0], 0xffff00) << "the lamp";
  swarm.environment->setCommand(1, {.led_color = 0x1234ff});
  swarm.environment->step();
  const auto seen = swarm.values(kCamera);
  EXPECT_EQ(seen[0], 0x1234ff);
  EXPECT_FLOAT_EQ(seen[1], 1);
  EXPECT_EQ(seen[3], 0xffff00);
  swarm.environment->setCommand(1, {.led_color = 0x1234ff});
  swarm.intervene("<remove name='second'/>");
  EXPECT_EQ(swarm.values(kCamera)[0], 0xffff00);
}

TEST(FeaturedBodies, MarksOfRobotsMoveWithThem) {
  const Swarm swarm;
  EXPECT_EQ(swarm.values(kFiducial)[0], 5);
  EXPECT_FLOAT_EQ(swarm.values(kFiducial)[1], 1);
  swarm.environment->setCommand(1, {.speed_mps = 1});
  swarm.environment->step();
  EXPECT_FLOAT_EQ(swarm.values(kFiducial)[1], 1.1f);
  swarm.environment->setCommand(1, {});
  swarm.intervene("<change name='lamp' fiducial='9'/>");
  EXPECT_EQ(swarm.values(kFiducial)[4], -1) << "a mark at 0.3 m is hidden by the robot";
  swarm.intervene("<remove name='second'/>");
  EXPECT_EQ(swarm.values(kFiducial)[0], 9);
}

TEST(FeaturedBodies, AreInSavedStatesAndTheDigest) {
  const Swarm swarm, other;
  swarm.environment->setCommand(1, {.led_color = 0xff00ff});
  other.environment->setCommand(1, {.led_color = 0xff00fe});
  swarm.intervene("<change name='lamp' light='2' fiducial='3'/>");
  other.intervene("<change name='lamp' light='2' fiducial='3'/>");
  EXPECT_NE(swarm.environment->digest(), other.environment->digest());
  const auto& model = *swarm.environment->model();
  const State restored = stateFromBytes(model, toBytes(model, swarm.environment->state()));
  EXPECT_EQ(restored, swarm.environment->state());
  EXPECT_EQ(restored.commands[1].led_color, 0xff00ffu);
  Environment continued(swarm.environment->model(), restored);
  continued.step();
  swarm.environment->step();
  EXPECT_EQ(continued.digest(), swarm.environment->digest());
}

TEST(FeaturedBodies, AreInTheDigestOfTheModel) {
  const auto digest = [](const std::function<void(World&)>& change) {
    return digestOf(*Swarm(change).environment->model());
  };
  const auto exact = digest({});
  EXPECT_NE(exact, digest([](World& world) { world.objects[1].body.light_cd = 5; }));
  EXPECT_NE(exact, digest([](World& world) { world.objects[1].body.fiducial = 5; }));
  EXPECT_NE(exact, digest([](World& world) { world.maps.push_back(floorOf(1)); }));
}

}  // namespace
}  // namespace robosim
