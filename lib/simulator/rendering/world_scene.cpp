#include "rendering/world_scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "rendering/ground.h"
#include "rendering/instanced_mesh.h"
#include "rendering/object_mesh.h"
#include "rendering/robot_mesh.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Static bodies are grouped into square tiles, which are culled one by one.
constexpr double kTile_m = 8;
constexpr double kMaxTiles = 24;  ///< along either side of the world

MeshInstance at(double x_m, double y_m) { return {static_cast<float>(x_m), static_cast<float>(y_m)}; }

std::uint8_t toByte(float part) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0f, 1.0f))); }

std::vector<TPoint2D> outlineOf(const Body& body, int sides) {
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) return circlePoints({}, cylinder->radius_m, sides);
  const auto& cube = std::get<Cube>(body.shape);
  const double x = cube.length_m / 2, y = cube.width_m / 2;
  std::vector<TPoint2D> corners{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  for (auto& corner : corners) corner = TPose2D(0, 0, body.world_from_body.phi).composePoint(corner);
  return corners;
}

/// Meshes of the static bodies in one tile, relative to its centre.
struct Tile {
  TPoint2D center;
  Mesh bodies, shadows;
};

/// Between areas of the floor that overlap, of which the last one is on top.
constexpr double kLayer_m = 0.001;
constexpr int kLayersMax = 10;

std::vector<Body> bodiesOf(const std::vector<WorldObject>& objects, bool are_stationary) {
  std::vector<Body> bodies;
  int layers = 0;
  for (const auto& object : objects) {
    if (object.isStationary() != are_stationary) continue;
    Body& body = bodies.emplace_back(object.body);
    if (!body.isFloor()) continue;
    layers = std::min(layers + 1, kLayersMax);
    body.center_z_m = kPaint_m + layers * kLayer_m - body.height_m / 2;
  }
  return bodies;
}

std::vector<Body> bodiesOf(const std::vector<WorldMap>& maps) {
  std::vector<Body> bodies;
  for (const auto& map : maps) {
    const auto of_map = bodiesOf(map);
    bodies.insert(bodies.end(), of_map.begin(), of_map.end());
  }
  return bodies;
}

std::vector<Tile> makeTiles(std::vector<Body> bodies, const Bounds2D& bounds) {
  const double side_m =
      std::max({kTile_m, (bounds.x_max - bounds.x_min) / kMaxTiles, (bounds.y_max - bounds.y_min) / kMaxTiles});
  const int sides = bodies.size() <= 500 ? 72 : 24;
  std::map<std::pair<double, double>, Tile> tiles;
  for (Body& body : bodies) {
    const TPose2D place = body.world_from_body;
    const TPoint2D center((std::floor(place.x / side_m) + 0.5) * side_m, (std::floor(place.y / side_m) + 0.5) * side_m);
    Tile& tile = tiles.try_emplace({center.x, center.y}, Tile{center, {}, {}}).first->second;
    body.world_from_body.x -= center.x;
    body.world_from_body.y -= center.y;
    addBody(tile.bodies, body, sides);
    if (body.heights().z_max_m <= kPaint_m + kLayersMax * kLayer_m) continue;
    auto outline = outlineOf(body, sides);
    for (auto& point : outline) point += TPoint2D(body.world_from_body.x, body.world_from_body.y);
    addShadow(tile.shadows, outline, body.heights().z_max_m);
  }
  std::vector<Tile> list;
  for (auto& [center, tile] : tiles) list.push_back(std::move(tile));
  return list;
}

}  // namespace

struct WorldScene::Impl {
  /// Robots of equal appearance.
  struct RobotGroup {
    std::shared_ptr<InstancedMesh> robots;
    std::shared_ptr<Shadows> shadows;
  };

  using Parts = std::vector<mrpt::opengl::CRenderizable::Ptr>;

  /// Objects of the world, made again only when one of them is another or elsewhere.
  struct Objects {
    bool are_stationary;
    std::vector<Body> bodies = {};
    Parts parts = {};
  };

  Parts partsOf(std::vector<Body> bodies) const;
  /// @return whether the parts are new
  bool set(Objects& of_kind, const std::vector<WorldObject>& all_objects) const;
  void addRobots(const World& world, const Fleet& fleet);

  Bounds2D bounds;
  Parts all;  ///< but the objects
  Objects kinds[2]{{.are_stationary = true}, {.are_stationary = false}};
  std::vector<RobotGroup> groups;
  struct RobotInstance {
    std::size_t group, instance;
  };
  std::vector<RobotInstance> instances;  ///< by robot
};

WorldScene::Impl::Parts WorldScene::Impl::partsOf(std::vector<Body> bodies) const {
  Parts parts;
  for (Tile& tile : makeTiles(std::move(bodies), bounds)) {
    auto mesh = std::make_shared<InstancedMesh>(std::move(tile.bodies));
    mesh->instances() = {at(tile.center.x, tile.center.y)};
    parts.push_back(mesh);
    auto shadows = std::make_shared<Shadows>(std::move(tile.shadows), bounds);
    shadows->instances() = mesh->instances();
    parts.push_back(shadows);
  }
  return parts;
}

bool WorldScene::Impl::set(Objects& of_kind, const std::vector<WorldObject>& all_objects) const {
  std::vector<Body> bodies = bodiesOf(all_objects, of_kind.are_stationary);
  if (bodies == of_kind.bodies) return false;
  of_kind.parts = partsOf(bodies);
  of_kind.bodies = std::move(bodies);
  return true;
}

void WorldScene::Impl::addRobots(const World& world, const Fleet& fleet) {
  using Appearance = std::tuple<const RobotModel*, bool, double, double, double, double>;
  std::map<Appearance, std::size_t> group_of;
  for (const auto& robot : fleet.robots) {
    const Body body = robot.body();
    const auto* cube = std::get_if<Cube>(&body.shape);
    const double length_m = cube ? cube->length_m : std::get<Cylinder>(body.shape).radius_m;
    const Appearance appearance{robot.model.get(),        cube != nullptr, length_m,
                                cube ? cube->width_m : 0, body.height_m,   body.center_z_m};
    const auto [found, is_new] = group_of.emplace(appearance, groups.size());
    if (is_new) {
      Mesh shadow;
      addShadow(shadow, circlePoints({}, 0.9 * body.coveringRadius(), 24), body.heights().z_max_m);
      groups.push_back({std::make_shared<InstancedMesh>(
                            robotMesh(*robot.model, body, Detail::full), robotMesh(*robot.model, body, Detail::rough),
                            robotMesh(*robot.model, body, Detail::tiny), robotMesh(*robot.model, body, Detail::speck)),
                        std::make_shared<Shadows>(std::move(shadow), world.bounds)});
      all.push_back(groups.back().robots);
      all.push_back(groups.back().shadows);
    }
    auto& mesh_instances = groups[found->second].robots->instances();
    instances.push_back({found->second, mesh_instances.size()});
    MeshInstance mesh_instance;
    mesh_instance.paint = {toByte(body.color[0]), toByte(body.color[1]), toByte(body.color[2]), 255};
    mesh_instances.push_back(mesh_instance);
  }
}

WorldScene::WorldScene(const World& world, const Fleet& fleet) : impl_(std::make_unique<Impl>()) {
  impl_->all.push_back(std::make_shared<Ground>(world.bounds));
  impl_->all.push_back(std::make_shared<Sky>());
  impl_->bounds = world.bounds;
  for (auto& of_kind : impl_->kinds) impl_->set(of_kind, world.objects);
  const auto maps = impl_->partsOf(bodiesOf(world.maps));
  impl_->all.insert(impl_->all.end(), maps.begin(), maps.end());
  impl_->addRobots(world, fleet);
  std::vector<TPose2D> starts;
  for (const auto& robot : fleet.robots) starts.push_back(robot.world_from_start);
  place(starts);
}

WorldScene::~WorldScene() = default;

void WorldScene::addTo(mrpt::opengl::COpenGLScene& scene) const {
  for (const auto* parts : {&impl_->all, &impl_->kinds[0].parts, &impl_->kinds[1].parts}) {
    for (const auto& part : *parts) scene.insert(part);
  }
}

void WorldScene::setObjects(const std::vector<WorldObject>& objects, mrpt::opengl::COpenGLScene& scene) {
  for (auto& of_kind : impl_->kinds) {
    const Impl::Parts before = of_kind.parts;
    if (!impl_->set(of_kind, objects)) continue;
    for (const auto& part : before) scene.removeObject(part);
    for (const auto& part : of_kind.parts) scene.insert(part);
  }
}

void WorldScene::place(std::span<const TPose2D> world_from_robot) {
  for (std::size_t i = 0; i < impl_->instances.size(); ++i) {
    const auto& pose = world_from_robot[i];
    MeshInstance& mesh_instance =
        impl_->groups[impl_->instances[i].group].robots->instances()[impl_->instances[i].instance];
    mesh_instance.x_m = static_cast<float>(pose.x);
    mesh_instance.y_m = static_cast<float>(pose.y);
    mesh_instance.cosine = static_cast<float>(std::cos(pose.phi));
    mesh_instance.sine = static_cast<float>(std::sin(pose.phi));
  }
  for (auto& group : impl_->groups) {
    const auto& robots = group.robots->instances();
    group.shadows->instances().clear();
    std::copy_if(robots.begin(), robots.end(), std::back_inserter(group.shadows->instances()), isShown);
  }
}

}  // namespace robosim
