#include "rendering/stock_scene.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/serialization/CArchive.h>

#include "rendering/detail_level.h"
#include "rendering/object_mesh.h"
#include "rendering/robot_mesh.h"

namespace robosim {
namespace {

using mrpt::img::TColor;
using mrpt::math::TPoint2D;
using mrpt::math::TPose3D;
using mrpt::opengl::CSetOfTriangles;
using mrpt::opengl::TTriangle;

constexpr int kSides = 48;
/// Maximum number of robots drawn in full detail, which takes 0.25 MB each in the file.
constexpr std::size_t kMaxDetailedRobots = 100, kMaxRoughRobots = 1000;
/// Appearance of the grid and of the floor below it. The floor is lower, which avoids z-fighting.
constexpr double kGrid_m = 1, kFloor_m = -0.005;
const TColor kGridColor(170, 176, 184);
const Material kFloorFinish{.color = {0.82f, 0.84f, 0.86f}};

TTriangle::Vertex toVertex(const MeshVertex& from, const Color& paint) {
  TTriangle::Vertex v;
  v.xyzrgba.pt = {from.x_m, from.y_m, from.z_m};
  v.normal = {static_cast<float>(from.normal[0]) / 127, static_cast<float>(from.normal[1]) / 127,
              static_cast<float>(from.normal[2]) / 127};
  const auto tinted = [&](std::size_t i) {
    return static_cast<std::uint8_t>(from.painted != 0 ? static_cast<float>(from.color[i]) * paint[i] : from.color[i]);
  };
  v.setColor({tinted(0), tinted(1), tinted(2), 255});
  return v;
}

CSetOfTriangles::Ptr thing(const std::string& name, const Mesh& mesh, const Color& paint = {1, 1, 1}) {
  auto set = CSetOfTriangles::Create();
  set->setName(name);
  set->reserve(mesh.triangles());
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    TTriangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      triangle.vertices[corner] = toVertex(mesh.vertices[i + corner], paint);
    }
    set->insertTriangle(triangle);
  }
  return set;
}

void addGround(mrpt::opengl::COpenGLScene& scene, const Bounds2D& bounds) {
  Mesh floor;
  const mrpt::math::TPoint3D corners[] = {{bounds.x_min, bounds.y_min, kFloor_m},
                                          {bounds.x_max, bounds.y_min, kFloor_m},
                                          {bounds.x_max, bounds.y_max, kFloor_m},
                                          {bounds.x_min, bounds.y_max, kFloor_m}};
  addPolygon(floor, corners, kFloorFinish);
  scene.insert(thing("surface", floor));
  const auto [x_min, x_max] = std::pair(static_cast<float>(bounds.x_min), static_cast<float>(bounds.x_max));
  const auto [y_min, y_max] = std::pair(static_cast<float>(bounds.y_min), static_cast<float>(bounds.y_max));
  auto grid = mrpt::opengl::CGridPlaneXY::Create(x_min, x_max, y_min, y_max, 0.0f, static_cast<float>(kGrid_m));
  grid->setName("grid");
  grid->setColor_u8(kGridColor);
  scene.insert(grid);
}

}  // namespace

std::string toStockScene(const World& world, const Fleet& fleet, const ViewLayers& layers) {
  mrpt::opengl::COpenGLScene scene;
  addGround(scene, world.bounds);
  for (const auto& object : world.objects) {
    Mesh mesh;
    addBody(mesh, object.body, kSides);
    scene.insert(thing(object.name, mesh));
  }
  for (const auto& map : world.maps) {
    Mesh mesh;
    for (const auto& body : bodiesOf(map)) addBody(mesh, body, kSides);
    scene.insert(thing(map.file, mesh));
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) count += layers.shows(i) ? 1 : 0;
  const Detail detail = count <= kMaxDetailedRobots ? Detail::full
                        : count <= kMaxRoughRobots  ? Detail::rough
                                                    : Detail::tiny;
  for (std::size_t i = 0; i < fleet.robots.size(); ++i) {
    if (!layers.shows(i)) continue;
    const FleetRobot& robot = fleet.robots[i];
    auto body = thing(robot.info.name, robotMesh(*robot.model, robot.body(), detail), robot.color);
    const auto& start = robot.world_from_start;
    body->setPose(TPose3D(start.x, start.y, 0, start.phi, 0, 0));
    if (layers.names && count <= DetailLevel::kManyRobots) body->enableShowName();
    scene.insert(body);
  }
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << scene;
  return {static_cast<const char*>(stream.getRawBufferData()), static_cast<std::size_t>(stream.getTotalBytesCount())};
}

}  // namespace robosim
