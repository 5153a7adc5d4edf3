// Runs on ranks that know the robots near their own, with robots of several types and sensors with all errors.
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "distributed/testing/crowd_runs.h"
#include "environment/testing/small_world.h"
#include "robots/robot_model.h"
#include "robots/robot_types.h"
#include "sensors/camera_head.h"

namespace robosim {
namespace {

constexpr const char* kRest = R"(
    <heat range_max_m="5"><noise lag_s="1"/></heat>
    <bumper segments="7"><noise chatter="0.1"/></bumper>
    <odometry><noise diameter_ratio="1.003" turn_slip_s="0.01" contact_slip="0.3"/></odometry>
    <compass><noise/></compass>
    <battery><noise drop_v_per_mps="0.03" std_v="0.02"/></battery>
  </sensors></robot>)";

/// Types of robots that differ in body, speed and sensors.
RobotTypes mixedTypes() {
  const auto type = [](const std::string& name, const std::string& contents) {
    return std::pair{name, RobotTypeFile{name + ".xml", "<robot name=\"" + name + "\" help=\"One of a mixed crowd.\">" +
                                                            contents + kRest}};
  };
  return {type("scanner", R"(<body radius_m="0.2" height_m="0.4"/>
    <limits speed_max_mps="2" accel_mps2="5" decel_mps2="9" turn_max_degps="200" turn_accel_degps2="900"/>
    <sensors>
    <laser beams="20" field_of_view_deg="270" range_max_m="2" x_m="0.1" z_m="0.2" sweep_s="0.3" latency_s="0.1"
           noise="lms200"/>
    <laser label="second" beams="7" field_of_view_deg="90" range_max_m="1.5" z_m="0.2" rate_hz="7" phase_s="0.13"
           latency_s="0.2"><noise divergence_deg="2" reach_m="1.5" drift_m="0.1"/></laser>)"),
          type("bat", R"(<body length_m="0.45" width_m="0.3" height_m="0.35" fiducial="5"/>
    <limits speed_max_mps="1" accel_mps2="2" decel_mps2="4" turn_max_degps="100" turn_accel_degps2="300"/>
    <sensors>
    <sonar range_max_m="2" beam_width_deg="30" noise="polaroid"><ring count="8" radius_m="0.15" z_m="0.15"/>
      <noise robot_crosstalk="0.5" second_echoes="1" crosstalk="0.2" wall_deg="30" far_deg="10"/></sonar>
    <sonar range_max_m="1.5" model="rays" rays="5" firing_interval_s="0.04" label="slow">
      <ring count="4" radius_m="0.1" z_m="0.15"/></sonar>)"),
          type("bee", R"(<body radius_m="0.12" height_m="0.3"/>
    <limits speed_max_mps="4" accel_mps2="30" decel_mps2="40" turn_max_degps="600" turn_accel_degps2="3000"/>
    <sensors>
    <infrared noise="gp2d12"><noise dropout="0.1"/><ring count="4" radius_m="0.1" z_m="0.1"/></infrared>
    <infrared range_max_m="1" label="exact"><ring count="3" radius_m="0.1" z_m="0.1"/></infrared>
    <range_and_bearing range_max_m="2" count="4"><noise/></range_and_bearing>
    <omni_camera range_max_m="2" count="5"><noise/></omni_camera>
    <fiducial range_max_m="1.5" count="3"/>
    <light range_max_m="2"><ring count="4" radius_m="0.12" z_m="0.1"/></light>
    <ground><at x_m="0.1"/><noise/></ground>
    <imu><noise/></imu>
    <encoders/>
    <laser beams="9" field_of_view_deg="120" range_max_m="1.2" z_m="0.2" noise="urg04lx"/>)"),
          type("crab", R"(<body radius_m="0.2" height_m="0.35"/>
    <limits speed_max_mps="1" accel_mps2="3" decel_mps2="4" turn_max_degps="100" turn_accel_degps2="300"/>
    <drive type="omni" lateral_max_mps="2"/>
    <sensors>
    <imu/>
    <camera model="raycast" layers="rgb depth identity" width_px="9" height_px="6" z_m="0.3" range_max_m="1.2">
      <noise std="3" exposure_std="0.1"/></camera>
    <laser beams="9" field_of_view_deg="120" range_max_m="1.2" z_m="0.2" sweep_s="0.1" noise="urg04lx"/>)"),
          type("tank", R"(<body radius_m="0.2" height_m="0.35"/>
    <limits speed_max_mps="2" accel_mps2="3" decel_mps2="4" turn_max_degps="300" turn_accel_degps2="300"/>
    <drive type="tracked" track_factor="1.6" icr_x_m="0.05"/>
    <sensors>
    <laser beams="9" field_of_view_deg="120" range_max_m="1.2" z_m="0.2" noise="urg04lx"/>)")};
}

/// Gives the robots of a model the head of a camera, without its camera, whose pictures would need OpenGL.
void addCameraHeads(Fleet& fleet, const std::string& model_name) {
  std::shared_ptr<const RobotModel> model;
  for (auto& robot : fleet.robots) {
    if (robot.info.type->model != model_name) continue;
    if (!model) {
      RobotModel with_head = *robot.model;
      CameraHeadLimits limits{-1, 1, -0.5, 0.5, 4, 1, 0.5, 2};
      with_head.sensors.push_back(makeCameraHead({.limits = limits}));
      auto infos = *with_head.sensor_infos;
      infos.push_back(with_head.sensors.back()->info());
      with_head.sensor_infos = std::make_shared<const std::vector<SensorInfo>>(std::move(infos));
      model = std::make_shared<const RobotModel>(std::move(with_head));
    }
    robot.model = model;
    robot.info.sensors = model->sensor_infos;
  }
}

/// A street of six robots' width with as many rows as given; some places have boxes, and one has gold.
LoadedWorld mixedCrowd(int rows, std::uint64_t seed) {
  addDasher();
  constexpr int kColumns = 6;
  constexpr double kPitch_m = 1.2;
  const RobotTypes types = mixedTypes();
  const char* const controllers[] = {"dasher", "dasher", "wander", "stigmergy"};
  Rng rng(seed);
  LoadedWorld made;
  made.world = emptyWorld(1);
  made.world.bounds = {0, kColumns * kPitch_m, 0, rows * kPitch_m};
  made.world.communication = {.loss_probability = 0.1, .burst_gap_s = 2};
  made.world.communication.burst_s = 0.5;
  made.world.communication.burst_loss = 0.9;
  made.world.communication.delay_s = 0.2;
  made.world.communication.rate_hz = 3;
  for (int i = 0; i < rows * kColumns; ++i) {
    const double x_m = (i % kColumns + 0.5) * kPitch_m, y_m = (i / kColumns + 0.5) * kPitch_m;
    if (i == rows * kColumns / 2) {
      addGold(made.world, x_m, y_m, 0.1);
    } else if (rng.below(16) == 0) {
      addWall(made.world, x_m, y_m, rng.uniform(0.1, 0.6), 0.2, rng.uniform(0, 3));
      made.world.objects.back().body.light_cd = 2;
      made.world.objects.back().body.fiducial = i;
    } else {
      RobotPlacement& placement = made.world.robots.emplace_back();
      placement.name = "r" + std::to_string(i);
      placement.model = std::next(types.begin(), rng.below(5))->first;
      placement.controller = controllers[rng.below(4)];
      const auto off_m = [&] { return rng.uniform(-0.25, 0.25); };
      placement.world_from_robot = {x_m + off_m(), y_m + off_m(), rng.uniform(-M_PI, M_PI)};
    }
  }
  ErrorList errors;
  made.fleet = buildFleet(made.world, "mixed_crowd.xml", types, {}, errors);
  errors.throwIfAny();
  addCameraHeads(made.fleet, "tank");
  return made;
}

TEST(MixedCrowd, HasTheRunOfOneProcessOnRanksThatKnowNearRobots) {
  constexpr int kSteps = 25;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const LoadedWorld world = mixedCrowd(110, seed);
    const std::size_t robots = world.fleet.robots.size();
    ASSERT_GT(robots, 512u) << "rank 0 adds 256 to the digest, and knows not all";
    const std::string alone = resultAlone(world, kSteps);
    for (const int ranks : {2, 3, 5}) {
      const OnRanks near =
          runOf(world, kSteps, ranks, {.balance_steps = seed == 1 ? 0u : 6u, .exchange = RankExchange::near});
      EXPECT_EQ(near.exchange.find("ranks know the robots near their own: "), 0u) << near.exchange;
      EXPECT_EQ(near.result, alone) << "seed " << seed << ", " << ranks << " ranks";
      for (const auto& rank : near.measured) EXPECT_LT(rank.robots_moved, robots * kSteps * 9 / 10);
    }
  }
}

}  // namespace
}  // namespace robosim
