#include "rendering/world_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <mrpt/opengl/COpenGLScene.h>

#include "rendering/crowd.h"
#include "rendering/ground.h"
#include "rendering/object_mesh.h"
#include "rendering/robot_mesh.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// What stands still is drawn in squares of ground, of which those out of view are left out.
constexpr double kSquare_m = 8;
constexpr double kSquaresMost = 24;  ///< along either side of the world

Member at(double x_m, double y_m) { return {static_cast<float>(x_m), static_cast<float>(y_m)}; }

std::uint8_t toByte(float part) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0f, 1.0f))); }

std::vector<TPoint2D> outlineOf(const Body& body, int sides) {
  if (const auto* cylinder = std::get_if<Cylinder>(&body.shape)) return circlePoints({}, cylinder->radius_m, sides);
  const auto& cube = std::get<Cube>(body.shape);
  const double x = cube.length_m / 2, y = cube.width_m / 2;
  std::vector<TPoint2D> corners{{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  for (auto& corner : corners) corner = TPose2D(0, 0, body.world_from_body.phi).composePoint(corner);
  return corners;
}

/// Meshes of what stands in one square, about its middle.
struct Square {
  TPoint2D middle;
  Mesh bodies, shadows;
};

/// All that stands there: objects, and what maps are made of.
std::vector<Body> bodiesOf(const World& world) {
  std::vector<Body> bodies;
  for (const auto& object : world.objects) bodies.push_back(object.body);
  for (const auto& map : world.maps) {
    const auto of_map = bodiesOf(map);
    bodies.insert(bodies.end(), of_map.begin(), of_map.end());
  }
  return bodies;
}

std::vector<Square> squaresOf(const World& world) {
  const double side_m = std::max({kSquare_m, (world.bounds.x_max - world.bounds.x_min) / kSquaresMost,
                                  (world.bounds.y_max - world.bounds.y_min) / kSquaresMost});
  const int sides = world.objects.size() <= 500 ? 72 : 24;
  std::map<std::pair<double, double>, Square> squares;
  for (Body& body : bodiesOf(world)) {
    const TPose2D place = body.world_from_body;
    const TPoint2D middle((std::floor(place.x / side_m) + 0.5) * side_m, (std::floor(place.y / side_m) + 0.5) * side_m);
    Square& square = squares.try_emplace({middle.x, middle.y}, Square{middle, {}, {}}).first->second;
    body.world_from_body.x -= middle.x;
    body.world_from_body.y -= middle.y;
    addBody(square.bodies, body, sides);
    if (body.heights().z_max_m <= 0) continue;
    auto outline = outlineOf(body, sides);
    for (auto& point : outline) point += TPoint2D(body.world_from_body.x, body.world_from_body.y);
    addShadow(square.shadows, outline, body.heights().z_max_m);
  }
  std::vector<Square> list;
  for (auto& [middle, square] : squares) list.push_back(std::move(square));
  return list;
}

}  // namespace

struct WorldScene::Impl {
  /// Robots that look the same.
  struct Kin {
    std::shared_ptr<Crowd> robots;
    std::shared_ptr<Shadows> shadows;
  };

  void addObjects(const World& world);
  void addRobots(const World& world, const Fleet& fleet);

  std::vector<mrpt::opengl::CRenderizable::Ptr> all;
  std::vector<Kin> kin;
  struct Seat {
    std::size_t kin, member;
  };
  std::vector<Seat> seats;  ///< by robot
};

void WorldScene::Impl::addObjects(const World& world) {
  for (Square& square : squaresOf(world)) {
    auto bodies = std::make_shared<Crowd>(std::move(square.bodies));
    bodies->members() = {at(square.middle.x, square.middle.y)};
    all.push_back(bodies);
    auto shadows = std::make_shared<Shadows>(std::move(square.shadows), world.bounds);
    shadows->members() = bodies->members();
    all.push_back(shadows);
  }
}

void WorldScene::Impl::addRobots(const World& world, const Fleet& fleet) {
  using Look = std::tuple<const RobotModel*, bool, double, double, double, double>;
  std::map<Look, std::size_t> kin_of;
  for (const auto& robot : fleet.robots) {
    const Body& body = robot.body;
    const auto* cube = std::get_if<Cube>(&body.shape);
    const double length_m = cube ? cube->length_m : std::get<Cylinder>(body.shape).radius_m;
    const Look look{robot.model.get(),        cube != nullptr, length_m,
                    cube ? cube->width_m : 0, body.height_m,   body.center_z_m};
    const auto [found, is_new] = kin_of.emplace(look, kin.size());
    if (is_new) {
      Mesh shadow;
      addShadow(shadow, circlePoints({}, 0.9 * body.coveringRadius(), 24), body.heights().z_max_m);
      kin.push_back({std::make_shared<Crowd>(robotMesh(*robot.model, body, Detail::full),
                                             robotMesh(*robot.model, body, Detail::rough),
                                             robotMesh(*robot.model, body, Detail::tiny)),
                     std::make_shared<Shadows>(std::move(shadow), world.bounds)});
      all.push_back(kin.back().robots);
      all.push_back(kin.back().shadows);
    }
    auto& members = kin[found->second].robots->members();
    seats.push_back({found->second, members.size()});
    Member member;
    member.paint = {toByte(body.color[0]), toByte(body.color[1]), toByte(body.color[2]), 255};
    members.push_back(member);
  }
}

WorldScene::WorldScene(const World& world, const Fleet& fleet) : impl_(std::make_unique<Impl>()) {
  impl_->all.push_back(std::make_shared<Ground>(world.bounds));
  impl_->all.push_back(std::make_shared<Sky>());
  impl_->addObjects(world);
  impl_->addRobots(world, fleet);
  std::vector<TPose2D> starts;
  for (const auto& robot : fleet.robots) starts.push_back(robot.world_from_start);
  place(starts);
}

WorldScene::~WorldScene() = default;

void WorldScene::addTo(mrpt::opengl::COpenGLScene& scene) const {
  for (const auto& thing : impl_->all) scene.insert(thing);
}

void WorldScene::place(std::span<const TPose2D> world_from_robot) {
  for (std::size_t i = 0; i < impl_->seats.size(); ++i) {
    const auto& pose = world_from_robot[i];
    Member& member = impl_->kin[impl_->seats[i].kin].robots->members()[impl_->seats[i].member];
    member.x_m = static_cast<float>(pose.x);
    member.y_m = static_cast<float>(pose.y);
    member.cosine = static_cast<float>(std::cos(pose.phi));
    member.sine = static_cast<float>(std::sin(pose.phi));
  }
  for (auto& alike : impl_->kin) alike.shadows->members() = alike.robots->members();
}

}  // namespace robosim
