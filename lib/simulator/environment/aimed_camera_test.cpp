// Robots whose camera pans, tilts and zooms, in a run.
#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "environment/environment.h"
#include "environment/state_bytes.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

constexpr const char* kRover = R"(<robot name="rover" help="Has a camera on a head.">
  <body radius_m="0.2" height_m="0.3"/>
  <limits speed_max_mps="1" accel_mps2="1" decel_mps2="2" turn_max_degps="100" turn_accel_degps2="200"/>
  <sensors>
    <odometry/>
    <camera> <ptz pan_degps="40" tilt_degps="20" zoom_per_s="2"/> </camera>
    <camera label="fixed"/>
    <blob_finder camera="camera"> <color name="gold" rgb="1 0.8 0.1"/> </blob_finder>
  </sensors>
</robot>)";
constexpr std::size_t kHead = 1;  ///< among its sensors

/// Two rovers; steps of 0.1 s.
std::unique_ptr<Environment> twoRovers() {
  World world = emptyWorld(4);
  for (const double x_m : {-1.0, 1.0}) {
    RobotPlacement placement;
    placement.name = x_m < 0 ? "a" : "b";
    placement.model = "rover";
    placement.world_from_robot = {x_m, 0, 0};
    world.robots.push_back(placement);
  }
  ErrorList errors;
  Fleet fleet = buildFleet(world, "rovers.xml", {{"rover", {"rover.xml", kRover}}}, {}, errors);
  errors.throwIfAny();
  return std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
}

CameraAim aimOf(const Environment& environment, std::size_t robot) {
  return CameraAim::from(std::get<Values>(environment.state().readings[robot].measurements[kHead]));
}

void steps(Environment& environment, int count) {
  for (int i = 0; i < count; ++i) environment.step();
}

constexpr CameraHeadCommand kAside{{60 * kRadPerDeg, -10 * kRadPerDeg, 3}, 0, 5 * kRadPerDeg};

TEST(AimedCamera, IsMountedAfterItsHeadAndSharesItsAimWithItsBlobFinder) {
  const auto environment = twoRovers();
  const auto& sensors = *environment->fleet().robots[0].info.sensors;
  std::vector<std::string> labels;
  for (const auto& sensor : sensors) labels.push_back(sensor.label + (sensor.pans ? " pans" : ""));
  EXPECT_EQ(labels, (std::vector<std::string>{"odometry", "ptz", "camera pans", "fixed", "blob_finder pans"}));
  EXPECT_EQ(cameraHeadIn(sensors), kHead);
  std::vector<Measurement> measurements = environment->state().readings[0].measurements;
  measurements[kHead] = CameraAim{0.5, 0.25, 2}.values();
  EXPECT_EQ(aimOf(sensors[2], sensors, measurements), (CameraAim{0.5, 0.25, 2}));
  EXPECT_EQ(aimOf(sensors[3], sensors, measurements), std::nullopt);
  EXPECT_EQ(aimOf(sensors[4], sensors, measurements), (CameraAim{0.5, 0.25, 2}));
  EXPECT_EQ(aimOf(sensors[kHead], sensors, measurements), std::nullopt);
}

TEST(AimedCamera, MovesByItsSpeedInEachStepOfTheRobotThatIsCommanded) {
  const auto environment = twoRovers();
  EXPECT_EQ(aimOf(*environment, 0), CameraAim{}) << "in step 0";
  environment->setCommand(0, {.camera_head = kAside});
  for (int n = 1; n <= 10; ++n) {
    environment->step();
    EXPECT_NEAR(aimOf(*environment, 0).pan_rad, n * 4 * kRadPerDeg, 1e-12);
    EXPECT_NEAR(aimOf(*environment, 0).tilt_rad, -n * 0.5 * kRadPerDeg, 1e-12);
    EXPECT_NEAR(aimOf(*environment, 0).zoom, 1 + n * 0.2, 1e-12);
    EXPECT_EQ(aimOf(*environment, 1), CameraAim{});
  }
  environment->setCommand(0, {.activity = Activity::halted, .camera_head = kAside});
  steps(*environment, 20);
  EXPECT_EQ(aimOf(*environment, 0), kAside.aim) << "also of a robot that has halted";
}

TEST(AimedCamera, ContinuesFromASavedState) {
  const auto run = twoRovers();
  run->setCommand(0, {.camera_head = kAside});
  steps(*run, 3);
  const std::string bytes = toBytes(*run->model(), run->state());
  const State state = stateFromBytes(*run->model(), bytes);
  EXPECT_EQ(state, run->state());
  EXPECT_EQ(toBytes(*run->model(), state), bytes);
  Environment other(run->model(), state);
  steps(*run, 5);
  steps(other, 5);
  EXPECT_NEAR(aimOf(other, 0).pan_rad, 8 * 4 * kRadPerDeg, 1e-12);
  EXPECT_EQ(other.digest(), run->digest());
  run->restore(state);
  steps(*run, 5);
  EXPECT_EQ(other.state(), run->state());
}

TEST(AimedCamera, IsPartOfTheDigest) {
  const auto moved = twoRovers(), still = twoRovers();
  moved->setCommand(1, {.camera_head = CameraHeadCommand{{0, 0, 1.5}}});
  EXPECT_EQ(moved->digest(), still->digest());
  moved->step();
  still->step();
  EXPECT_NE(moved->digest(), still->digest());
}

TEST(AimedCamera, LooksAheadAgainAfterItsRobotWasAbsent) {
  const auto environment = twoRovers();
  environment->setCommand(0, {.camera_head = kAside});
  steps(*environment, 5);
  environment->remove(0);
  steps(*environment, 2);
  environment->enter(0);
  environment->step();
  EXPECT_EQ(aimOf(*environment, 0), CameraAim{});
}

}  // namespace
}  // namespace robosim
