#include "robosim/workloads.h"

#include <cmath>
#include <fstream>

#include "base/random.h"
#include "base/xml_element.h"
#include "geometry/scene.h"
#include "world/world_file.h"

namespace robosim {
namespace {

constexpr double kSquarePerRobot_m2 = 16;
constexpr double kRadius_m = 0.25;

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

/// A type of robot as worlds/robots/ has them: a disc of 0.5 m, lively enough to wander.
std::string robotTypeText(const Workload& workload) {
  return std::string("<?xml version='1.0'?>\n<robot name='") + workload.name + "'>\n<body radius_m='" +
         toText(kRadius_m) + "' height_m='0.3'/>\n" +
         "<limits speed_max_mps='0.7' accel_mps2='1' decel_mps2='2' turn_max_degps='115' turn_accel_degps2='286'/>\n" +
         "<sensors>" + workload.sensors + "<odometry/></sensors>\n</robot>\n";
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw std::runtime_error(file.string() + ": could not be written; is the disk full?");
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

World makeWorld(const Workload& workload, std::size_t robots, std::uint64_t seed) {
  World world;
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
  // Robots start one in each square of a raster of 4 m, so that no two of them touch.
  const auto columns = static_cast<std::size_t>(std::ceil(2 * half_m / 4));
  const double pitch_m = 2 * half_m / static_cast<double>(columns);
  for (std::size_t i = 0; i < robots; ++i) {
    RobotPlacement robot;
    robot.name = "r" + std::to_string(i);
    robot.model = workload.name;
    robot.controller = "wander";
    const double left = -half_m + pitch_m * static_cast<double>(i % columns);
    const double bottom = -half_m + pitch_m * static_cast<double>(i / columns);
    do {
      robot.world_from_robot = {left + rng.uniform(0.3, pitch_m - 0.3), bottom + rng.uniform(0.3, pitch_m - 0.3),
                                rng.uniform(-M_PI, M_PI)};
    } while (!places.isFree({robot.world_from_robot.x, robot.world_from_robot.y}));
    world.robots.push_back(std::move(robot));
  }
  return world;
}

}  // namespace

std::span<const Workload> workloads() { return kWorkloads; }

const Workload& workloadNamed(const std::string& name) {
  for (const auto& workload : kWorkloads) {
    if (name == workload.name) return workload;
  }
  throw std::invalid_argument("there is no workload '" + name + "'");
}

LoadedWorld makeWorldToRun(const Workload& workload, std::size_t robots, std::uint64_t seed) {
  const RobotTypes types{{workload.name, {std::string(workload.name) + ".xml", robotTypeText(workload)}}};
  LoadedWorld made{makeWorld(workload, robots, seed), {}};
  ErrorList errors;
  made.fleet = buildFleet(made.world, workload.name, types, {}, errors);
  errors.throwIfAny();
  return made;
}

std::filesystem::path writeWorld(const std::filesystem::path& folder, const Workload& workload, std::size_t robots,
                                 std::uint64_t seed) {
  std::filesystem::create_directories(folder / "robots");
  write(folder / "robots" / (std::string(workload.name) + ".xml"), robotTypeText(workload));
  auto file = folder / (std::string(workload.name) + ".xml");
  write(file, toXml(makeWorld(workload, robots, seed)));
  return file;
}

}  // namespace robosim
