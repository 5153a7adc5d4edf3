#include "robosim/workloads.h"

#include <cmath>

#include "base/random.h"
#include "base/xml_reader.h"
#include "geometry/scene.h"
#include "sensors/registry.h"

namespace robosim {
namespace {

constexpr double kSquarePerRobot_m2 = 16;
constexpr double kRadius_m = 0.25;
constexpr double kHeight_m = 0.3;

constexpr Workload kWorkloads[] = {
    {"sonar", "16 sonars of one ray, 5 m",
     "<sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>", 16},
    {"sector", "16 sonars of the exact 20° sector, 5 m",
     "<sonar model='sector' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>", 0},
    {"laser", "16 sonars of one ray, 5 m, and a laser of 181 beams, 8 m",
     "<sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>"
     "<laser z_m='0.25' range_max_m='8'/>",
     16 + 181},
    {"infrared", "24 infrared rays of 10 cm",
     "<infrared range_min_m='0' range_max_m='0.1'><ring count='24' radius_m='0.25' z_m='0.2'/></infrared>", 24},
};

void addObject(World& world, Body body) {
  WorldObject object;
  object.name = "object" + std::to_string(world.objects.size());
  body.center_z_m = 0.5;
  body.height_m = 1;
  object.body = body;
  world.objects.push_back(std::move(object));
}

std::shared_ptr<const RobotModel> modelFor(const Workload& workload) {
  auto model = std::make_shared<RobotModel>();
  model->name = workload.name;
  model->body.shape = Cylinder{kRadius_m};
  model->body.height_m = kHeight_m;
  model->body.center_z_m = kHeight_m / 2;
  model->radius_m = kRadius_m;
  model->limits = {.speed_max_mps = 0.7, .turn_max_radps = 2, .accel_mps2 = 1, .decel_mps2 = 2, .turn_accel_radps2 = 5};
  ErrorList errors;
  const XmlElement all = parseXml(std::string("<sensors>") + workload.sensors + "<odometry/></sensors>", workload.name);
  auto infos = std::make_shared<std::vector<SensorInfo>>();
  for (auto& reader : XmlReader(all, workload.name, errors).all()) {
    model->sensors.push_back(readSensor(reader, {1, kRadius_m, kHeight_m}));
    infos->push_back(model->sensors.back()->info());
  }
  errors.throwIfAny();
  model->sensor_infos = infos;
  return model;
}

/// Free places for robots: drawn at random, and drawn again where something stands.
class Places {
 public:
  Places(const World& world, std::size_t robots) : scene_(solidsOf(world), robots, world.bounds) {}

  bool isFree(const mrpt::math::TPoint2D& p) const {
    const Bounds2D around{p.x - 3 * kRadius_m, p.x + 3 * kRadius_m, p.y - 3 * kRadius_m, p.y + 3 * kRadius_m};
    std::vector<BodyId> near;
    scene_.stationaryNear(around, near);
    for (const auto body : near) {
      if (distance(scene_.solid(body).outline, p) < 1.2 * kRadius_m) return false;
    }
    return true;
  }

 private:
  static std::vector<Solid> solidsOf(const World& world) {
    std::vector<Solid> solids;
    for (const auto& object : world.objects) solids.push_back(object.body.solid());
    return solids;
  }
  Scene scene_;
};

}  // namespace

std::span<const Workload> workloads() { return kWorkloads; }

const Workload& workloadNamed(const std::string& name) {
  std::string known;
  for (const auto& workload : kWorkloads) {
    if (name == workload.name) return workload;
    known += (known.empty() ? "" : ", ") + std::string(workload.name);
  }
  throw ConfigError("there is no workload '" + name + "'; known are: " + known);
}

LoadedWorld makeWorld(const Workload& workload, std::size_t robots, std::uint64_t seed) {
  LoadedWorld made;
  World& world = made.world;
  world.name = workload.name;
  const double half_m = std::sqrt(kSquarePerRobot_m2 * static_cast<double>(robots)) / 2;
  world.bounds = {-half_m - 1, half_m + 1, -half_m - 1, half_m + 1};
  for (const double side : {-1.0, 1.0}) {
    addObject(world, {.shape = Cube{1, 2 * half_m + 2}, .world_from_body = {side * (half_m + 0.5), 0, 0}});
    addObject(world, {.shape = Cube{2 * half_m + 2, 1}, .world_from_body = {0, side * (half_m + 0.5), 0}});
  }
  Rng rng(seed, RandomPurpose::scenery);
  const auto somewhere = [&] {
    const double x = rng.uniform(-half_m, half_m);
    return mrpt::math::TPose2D(x, rng.uniform(-half_m, half_m), rng.uniform(-M_PI, M_PI));
  };
  for (std::size_t i = 0; i < robots; ++i) {
    const auto pose = somewhere();
    const double half_width_m = rng.uniform(0.2, 0.6);
    if (rng.below(2)) {
      addObject(world, {.shape = Cylinder{half_width_m}, .world_from_body = pose});
    } else {
      addObject(world, {.shape = Cube{2 * half_width_m, 2 * rng.uniform(0.2, 0.6)}, .world_from_body = pose});
    }
    if (i % 4 == 0) addObject(world, {.shape = Cube{4, 0.1}, .world_from_body = somewhere()});
  }

  const Places places(world, robots);
  const auto model = modelFor(workload);
  // Robots start one in each square of a raster of 4 m, so that no two of them touch.
  const auto columns = static_cast<std::size_t>(std::ceil(2 * half_m / 4));
  const double pitch_m = 2 * half_m / static_cast<double>(columns);
  for (std::size_t i = 0; i < robots; ++i) {
    FleetRobot robot;
    const double left = -half_m + pitch_m * static_cast<double>(i % columns);
    const double bottom = -half_m + pitch_m * static_cast<double>(i / columns);
    do {
      robot.world_from_start = {left + rng.uniform(0.3, pitch_m - 0.3), bottom + rng.uniform(0.3, pitch_m - 0.3),
                                rng.uniform(-M_PI, M_PI)};
    } while (!places.isFree({robot.world_from_start.x, robot.world_from_start.y}));
    robot.info = {.name = "r" + std::to_string(i),
                  .model = model->name,
                  .neighbour = "",
                  .radius_m = kRadius_m,
                  .height_m = kHeight_m,
                  .limits = model->limits,
                  .sensors = model->sensor_infos};
    robot.model = model;
    robot.body = model->body;
    robot.body.world_from_body = robot.world_from_start;
    robot.controller = "wander";
    made.fleet.robots.push_back(std::move(robot));
  }
  return made;
}

}  // namespace robosim
