#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/angle_units.h"
#include "base/text_table.h"
#include "geometry/scene.h"
#include "robosim_bench/benchmarks.h"
#include "robosim_bench/min_time.h"
#include "robosim_bench/rounds.h"
#include "robosim_bench/workloads.h"
#include "sensors/raycast/camera.h"
#include "sensors/raycast/layer_fan.h"

namespace robosim {
namespace {

constexpr std::size_t kRobotsOfPicture = 100;
constexpr double kHeight_m = 0.25;  ///< of all cameras and scanners

/// The workload `laser` at its start.
struct LaserWorld {
  LoadedWorld loaded;
  Scene scene;
  std::vector<PlanarTransform> frames;  ///< by robot
  std::vector<SurfaceLook> looks;
  FloorLook floor;

  LaserWorld()
      : loaded(makeWorldToRun(workloadNamed("laser"), kRobotsOfPicture, 1)),
        scene(stationarySolids(loaded.world.objects, loaded.world.maps), kRobotsOfPicture, loaded.world.bounds),
        floor{loaded.world.bounds, {}} {
    for (std::size_t i = 0; i < kRobotsOfPicture; ++i) {
      const FleetRobot& robot = loaded.fleet.robots[i];
      Body body = robot.body();
      body.world_from_body = robot.world_from_start;
      scene.place(i, body.solid());
      frames.emplace_back(robot.world_from_start, body.heights().z_min_m);
    }
    scene.freeze();
    for (std::size_t i = 0; i < scene.stationaryCount() + kRobotsOfPicture; ++i) {
      const auto level = [&](std::size_t by) { return static_cast<std::uint8_t>(i * by % 256); };
      looks.push_back({{level(53), level(97), level(31)}, false});
    }
  }
};

/// One row of the table: what each robot of the world does in turn.
struct Load {
  std::string what;
  std::string unit;
  double aim_per_cpu_s;  ///< 0 for none
  std::function<double()> work;
};

Load pictures(const LaserWorld& world, std::uint32_t width_px, std::uint32_t height_px, double range_m, double tilt_deg,
              double aim) {
  const CameraInfo info{.width_px = width_px, .height_px = height_px, .field_of_view_rad = M_PI / 3, .rate_hz = 10};
  const auto camera = std::make_shared<RaycastCamera>(
      info, mrpt::math::TPose3D{0.2, 0, kHeight_m, 0, toRadians(tilt_deg), 0},
      RaycastOptions{.has_rgb = true, .has_depth = true, .has_body = false, .range_max_m = range_m});
  const auto picture = std::make_shared<RaycastPicture>();
  const std::string tilted = tilt_deg != 0 ? ", tilted by " + std::to_string(std::lround(tilt_deg)) + "°" : "";
  return {
      std::to_string(width_px) + " × " + std::to_string(height_px) + " RGB-D, " + std::to_string(std::lround(range_m)) +
          " m" + tilted,
      "pictures", aim, [&world, camera, picture] {
        for (std::size_t i = 0; i < kRobotsOfPicture; ++i) {
          camera->take({world.scene, world.looks, world.floor}, world.frames[i], world.scene.movingBody(i), *picture);
        }
        return static_cast<double>(kRobotsOfPicture);
      }};
}

Load scans(const LaserWorld& world, std::size_t layers, std::size_t columns, double range_m, double aim) {
  std::vector<mrpt::math::TPoint2D> directions;
  for (std::size_t i = 0; i < columns; ++i) {
    const double azimuth_rad = 2 * M_PI * static_cast<double>(i) / static_cast<double>(columns);
    directions.emplace_back(std::cos(azimuth_rad), std::sin(azimuth_rad));
  }
  std::vector<double> elevations_rad;
  for (std::size_t i = 0; i < layers; ++i) {
    elevations_rad.push_back(toRadians(-15 + 30 * static_cast<double>(i) / static_cast<double>(layers - 1)));
  }
  const auto fan = std::make_shared<LayerFan>(directions, elevations_rad, range_m);
  const auto distance_m = std::make_shared<std::vector<double>>(layers * columns);
  return {"lidar of " + std::to_string(layers) + " × " + std::to_string(columns) + " beams, " +
              std::to_string(std::lround(range_m)) + " m",
          "beams", aim, [&world, fan, distance_m] {
            for (std::size_t i = 0; i < kRobotsOfPicture; ++i) {
              const PlanarTransform& frame = world.frames[i];
              fan->cast(world.scene, {frame.x(), frame.y(), frame.z() + kHeight_m, frame.cos(), frame.sin()},
                        world.scene.movingBody(i), *distance_m);
            }
            return static_cast<double>(kRobotsOfPicture * distance_m->size());
          }};
}

void benchRaycast(double min_s, bool json) {
  const LaserWorld world;
  const std::vector<Load> loads{pictures(world, 64, 64, 8, 0, 100e3), pictures(world, 64, 64, 20, 0, 40e3),
                                pictures(world, 64, 64, 20, 10, 0),   pictures(world, 320, 240, 20, 0, 5e3),
                                pictures(world, 320, 240, 20, 10, 0), scans(world, 16, 360, 20, 20e6),
                                scans(world, 16, 360, 100, 20e6)};
  std::vector<Contender> contenders;
  for (const Load& load : loads) contenders.push_back({.work = load.work});
  const std::vector<Cost> costs = measureAlternately(contenders, min_s);
  const auto count = [](double number) { return withCommas(static_cast<std::uint64_t>(std::llround(number))); };
  Rows rows{{"what", "per s of CPU time", "target", "unit"}};
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const Load& load = loads[i];
    if (json) {
      std::cout
          << nlohmann::ordered_json{{"what", load.what}, {"unit", load.unit}, {"per_cpu_s", 1 / costs[i].cpu_s}}.dump()
          << std::endl;
    }
    rows.push_back(
        {load.what, count(1 / costs[i].cpu_s), load.aim_per_cpu_s > 0 ? count(load.aim_per_cpu_s) : "–", load.unit});
  }
  if (!json) std::cout << table(rows);
}

}  // namespace

void addRaycastBenchmark(CLI::App& program) {
  auto* command = program.add_subcommand("raycast", "Measure ray-cast cameras and multi-layer lidars");
  const auto min_s = std::make_shared<double>(1);
  const auto json = std::make_shared<bool>(false);
  addMinTime(*command, "each row", *min_s);
  command->add_flag("--json", *json, "print one JSON object per line");
  command->footer("Each of 100 robots of the workload `laser` takes a picture or scan at its start; one thread.");
  command->callback([=] { benchRaycast(*min_s, *json); });
}

}  // namespace robosim
