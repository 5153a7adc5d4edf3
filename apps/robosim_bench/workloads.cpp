#include "robosim_bench/workloads.h"

#include <cmath>
#include <fstream>

#include "base/random.h"
#include "base/xml_element.h"
#include "geometry/scene.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "world/world_file.h"

namespace robosim {
namespace {

// At scale 1:
constexpr double kSquarePerRobot_m2 = 16;
constexpr double kRadius_m = 0.25;

const Workload kWorkloads[] = {
    {"sonar", "16 sonars of one ray, 5 m",
     "<sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>", 16},
    {"sector", "16 sonars of the exact 20° sector, 5 m",
     "<sonar model='sector' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>", 0},
    {"laser", "16 sonars of one ray, 5 m, and a laser of 181 beams, 8 m",
     "<sonar model='rays' rays='1' range_max_m='5'><ring count='16' radius_m='0.2' z_m='0.2'/></sonar>"
     "<laser z_m='0.25' range_max_m='8'/>",
     16 + 181},
    {"infrared", "24 infrared rays of 10 cm, one robot of 12.5 cm a square metre",
     "<infrared range_min_m='0' range_max_m='0.1'><ring count='24' radius_m='0.0625' z_m='0.05'/></infrared>", 24,
     0.25},
};

void addObject(World& world, Body body) {
  WorldObject object;
  object.name = "object" + std::to_string(world.objects.size());
  body.center_z_m = 0.5;  // higher than every sensor at any scale
  body.height_m = 1;
  object.body = body;
  world.objects.push_back(std::move(object));
}

/// A robot type in the format of worlds/robots/: at scale 1 a disc of 0.5 m with an acceleration sufficient for
/// "wander".
std::string robotTypeText(const Workload& workload) {
  const auto scaled = [&](double value) { return toText(value * workload.scale); };
  return "<?xml version='1.0'?>\n<robot name='" + workload.name + "'>\n<body radius_m='" + scaled(kRadius_m) +
         "' height_m='" + scaled(0.3) + "'/>\n<limits speed_max_mps='" + scaled(0.7) + "' accel_mps2='" + scaled(1) +
         "' decel_mps2='" + scaled(2) + "' turn_max_degps='115' turn_accel_degps2='286'/>\n" + "<sensors>" +
         workload.sensors + "<odometry/></sensors>\n</robot>\n";
}

RobotTypes knownTypes() { return robotTypesIn(robotTypeFolders({})); }

RobotTypes typesOf(const Workload& workload) {
  if (workload.has_type) return knownTypes();
  return {{workload.name, {workload.name + ".xml", robotTypeText(workload)}}};
}

double computeRadius(const Workload& workload) {
  return workload.has_type ? robotOfType(knownTypes(), workload.name).model->radius_m : workload.scale * kRadius_m;
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out) throw std::runtime_error(file.string() + ": could not be written; check whether the disk is full");
}

/// Random free places for robots (rejection sampling).
class Places {
 public:
  Places(const World& world, double radius_m) : scene_(solidsOf(world), 0, world.bounds), radius_m_(radius_m) {}

  bool isFree(const mrpt::math::TPoint2D& p) const {
    const double reach_m = 3 * radius_m_;
    const Bounds2D around{p.x - reach_m, p.x + reach_m, p.y - reach_m, p.y + reach_m};
    std::vector<BodyId> near;
    scene_.findBodies(around, near);
    for (const auto body : near) {
      if (distance(scene_.solid(body).outline, p) < 1.2 * radius_m_) return false;
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
  double radius_m_;
};

World makeWorld(const Workload& workload, std::size_t robots, std::uint64_t seed) {
  World world;
  world.name = workload.name;
  const double scale = workload.scale;
  const double half_m = scale * std::sqrt(kSquarePerRobot_m2 * static_cast<double>(robots)) / 2;
  world.bounds = {-half_m - scale, half_m + scale, -half_m - scale, half_m + scale};
  world.objects.reserve(4 + robots + (robots + 3) / 4);
  world.robots.reserve(robots);
  for (const double side : {-1.0, 1.0}) {
    addObject(world,
              {.shape = Cube{scale, 2 * (half_m + scale)}, .world_from_body = {side * (half_m + scale / 2), 0, 0}});
    addObject(world,
              {.shape = Cube{2 * (half_m + scale), scale}, .world_from_body = {0, side * (half_m + scale / 2), 0}});
  }
  Rng rng(seed, RandomPurpose::scenery);
  const auto somewhere = [&] {
    const double x = rng.uniform(-half_m, half_m);
    return mrpt::math::TPose2D(x, rng.uniform(-half_m, half_m), rng.uniform(-M_PI, M_PI));
  };
  for (std::size_t i = 0; i < robots; ++i) {
    const auto pose = somewhere();
    const double half_width_m = scale * rng.uniform(0.2, 0.6);
    if (rng.below(2)) {
      addObject(world, {.shape = Cylinder{half_width_m}, .world_from_body = pose});
    } else {
      addObject(world, {.shape = Cube{2 * half_width_m, 2 * scale * rng.uniform(0.2, 0.6)}, .world_from_body = pose});
    }
    if (i % 4 == 0) addObject(world, {.shape = Cube{4 * scale, 0.1 * scale}, .world_from_body = somewhere()});
  }

  const double radius_m = computeRadius(workload);
  const Places places(world, radius_m);
  // One robot starts in each square of a grid (4 m at scale 1), so that no two robots touch.
  const auto columns = static_cast<std::size_t>(std::ceil(2 * half_m / (4 * scale)));
  const double pitch_m = 2 * half_m / static_cast<double>(columns);
  const double margin_m = 1.2 * radius_m;
  for (std::size_t i = 0; i < robots; ++i) {
    RobotPlacement robot;
    robot.name = "r" + std::to_string(i);
    robot.model = workload.name;
    robot.controller = "wander";
    const double left = -half_m + pitch_m * static_cast<double>(i % columns);
    const double bottom = -half_m + pitch_m * static_cast<double>(i / columns);
    do {
      robot.world_from_robot = {left + rng.uniform(margin_m, pitch_m - margin_m),
                                bottom + rng.uniform(margin_m, pitch_m - margin_m), rng.uniform(-M_PI, M_PI)};
    } while (!places.isFree({robot.world_from_robot.x, robot.world_from_robot.y}));
    world.robots.push_back(std::move(robot));
  }
  return world;
}

}  // namespace

std::span<const Workload> workloads() { return kWorkloads; }

const Workload& workloadNamed(std::string_view name) {
  for (const auto& workload : kWorkloads) {
    if (name == workload.name) return workload;
  }
  throw std::invalid_argument("there is no workload '" + std::string(name) + "'");
}

Workload workloadOfType(const std::string& robot_type) {
  const FleetRobot robot = robotOfType(knownTypes(), robot_type);
  return {.name = robot_type, .help = robot.model->help, .sensors = "", .has_type = true};
}

std::vector<std::string> robotTypeNames() {
  std::vector<std::string> names;
  for (const auto& [name, file] : knownTypes()) names.push_back(name);
  return names;
}

LoadedWorld makeWorldToRun(const Workload& workload, std::size_t robots, std::uint64_t seed) {
  const RobotTypes types = typesOf(workload);
  LoadedWorld made{makeWorld(workload, robots, seed), {}};
  ErrorList errors;
  made.fleet = buildFleet(made.world, workload.name, types, {}, errors);
  errors.throwIfAny();
  made.world.robots = std::vector<RobotPlacement>();  // as loadWorldToRun() does
  return made;
}

std::filesystem::path writeWorld(const std::filesystem::path& folder, const Workload& workload, std::size_t robots,
                                 std::uint64_t seed) {
  std::filesystem::create_directories(folder / "robots");
  if (!workload.has_type) write(folder / "robots" / (workload.name + ".xml"), robotTypeText(workload));
  auto file = folder / (workload.name + ".xml");
  write(file, toXml(makeWorld(workload, robots, seed)));
  return file;
}

}  // namespace robosim
