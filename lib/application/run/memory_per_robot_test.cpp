// The memory that a robot takes during a run, of which doc/performance.md gives the parts.
#include <gtest/gtest.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/memory_bound.h"
#include "robots/robot_types.h"
#include "run/local_run.h"

namespace robosim {
namespace {

constexpr std::size_t kColumns = 50;
constexpr double kPitch_m = 4;

WorldObject standingBox(double x_m, double y_m, double length_m, double width_m) {
  const Body body{.shape = Cube{length_m, width_m}, .world_from_body = {x_m, y_m, 0}, .center_z_m = 0.5, .height_m = 1};
  return {.name = "box", .body = body, .line = {}};
}

/// Rows of robots with 16 sonars of one ray, a box and a quarter of a wall for each.
LoadedWorld worldOf(std::size_t robots) {
  World world;
  world.bounds = {-kPitch_m * kColumns, kPitch_m * kColumns, -kPitch_m * kColumns, kPitch_m * kColumns};
  world.robots.reserve(robots);
  world.objects.reserve(2 * robots);
  for (std::size_t i = 0; i < robots; ++i) {
    const double x_m = kPitch_m * (static_cast<double>(i % kColumns) - 0.5 * kColumns);
    const double y_m = kPitch_m * (static_cast<double>(i / kColumns) - 0.5 * kColumns);
    world.objects.push_back(standingBox(x_m + 2, y_m, 0.8, 0.8));
    if (i % 4 == 0) world.objects.push_back(standingBox(x_m, y_m + 2, 4, 0.1));
    RobotPlacement robot;
    robot.name = "r" + std::to_string(i);
    robot.model = "disc";
    robot.controller = "wander";
    robot.world_from_robot = {x_m, y_m, 0.1 * static_cast<double>(i)};
    world.robots.push_back(robot);
  }
  const RobotTypes types{
      {"disc",
       {"disc.xml",
        "<?xml version='1.0'?><robot name='disc'><body radius_m='0.25' height_m='0.3'/>"
        "<limits speed_max_mps='0.7' accel_mps2='1' decel_mps2='2' turn_max_degps='115' turn_accel_degps2='286'/>"
        "<sensors><sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>"
        "<odometry/></sensors></robot>"}}};
  ErrorList errors;
  Fleet fleet = buildFleet(world, "rows.xml", types, checkController, errors);
  errors.throwIfAny();
  world.robots = std::vector<RobotPlacement>();  // as loadWorldToRun() of a file does
  world.objects.shrink_to_fit();
  return {std::move(world), std::move(fleet)};
}

#ifdef __GLIBC__
std::size_t bytesInUse() {
  const struct mallinfo2 now = mallinfo2();
  return now.uordblks + now.hblkhd;
}

/// Bytes that a run of so many robots holds after a few steps.
std::size_t bytesOf(std::size_t robots) {
  const std::size_t before = bytesInUse();
  LocalRun run(worldOf(robots), {});
  for (int i = 0; i < 20; ++i) run.step();
  return bytesInUse() - before;
}

TEST(MemoryPerRobot, IsBounded) {
  if (!MemoryBound::kBounds) GTEST_SKIP() << "the address sanitizer has another allocator";
  constexpr std::size_t kSome = 1000, kMore = 2000;
  bytesOf(kMore);  // fills what is kept by threads
  const double per_robot =
      (static_cast<double>(bytesOf(kMore)) - static_cast<double>(bytesOf(kSome))) / (kMore - kSome);
  RecordProperty("bytes", static_cast<int>(per_robot));
  EXPECT_LT(per_robot, 1850);
  EXPECT_GT(per_robot, 500) << "the measurement itself";
}
#endif

}  // namespace
}  // namespace robosim
