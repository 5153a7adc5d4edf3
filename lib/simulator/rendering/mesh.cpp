#include "rendering/mesh.h"

#include <algorithm>
#include <cmath>

#include <mrpt/poses/CPose3D.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

std::int8_t toSignedByte(double value) {
  return static_cast<std::int8_t>(std::lround(127 * std::clamp(value, -1.0, 1.0)));
}

MeshVertex vertex(const TPoint3D& at, const TPoint3D& normal, const Material& material) {
  MeshVertex v{.x_m = static_cast<float>(at.x), .y_m = static_cast<float>(at.y), .z_m = static_cast<float>(at.z)};
  for (int i = 0; i < 3; ++i) {
    v.normal[i] = toSignedByte(normal[i]);
    v.color[i] = static_cast<std::uint8_t>(
        std::lround(255 * std::clamp(material.color[static_cast<std::size_t>(i)], 0.0f, 1.0f)));
  }
  v.gloss = toSignedByte(material.gloss);
  v.painted = material.painted ? 255 : 0;
  return v;
}

/// Adds the quadrilateral a, b, c, d, counter-clockwise, with a normal at each corner.
void addQuad(Mesh& mesh, const TPoint3D (&at)[4], const TPoint3D (&normal)[4], const Material& material) {
  for (const int i : {0, 1, 2, 0, 2, 3}) mesh.vertices.push_back(vertex(at[i], normal[i], material));
}

}  // namespace

void Mesh::add(const Mesh& other, const mrpt::math::TPose3D& at) {
  const mrpt::poses::CPose3D pose(at);
  vertices.reserve(vertices.size() + other.vertices.size());
  for (MeshVertex v : other.vertices) {
    const TPoint3D moved = pose.composePoint(TPoint3D(v.x_m, v.y_m, v.z_m));
    const auto turned = pose.rotateVector(mrpt::math::TVector3D(v.normal[0], v.normal[1], v.normal[2]));
    v.x_m = static_cast<float>(moved.x);
    v.y_m = static_cast<float>(moved.y);
    v.z_m = static_cast<float>(moved.z);
    for (int i = 0; i < 3; ++i) v.normal[i] = toSignedByte(turned[i] / 127);
    vertices.push_back(v);
  }
}

void addPolygon(Mesh& mesh, std::span<const TPoint3D> corners, const Material& material) {
  const TPoint3D a = corners[1] - corners[0], b = corners[2] - corners[1];
  TPoint3D normal{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  normal *= 1 / normal.norm();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    for (const std::size_t corner : {std::size_t{0}, i - 1, i}) {
      mesh.vertices.push_back(vertex(corners[corner], normal, material));
    }
  }
}

void addBox(Mesh& mesh, const TPoint3D& low, const TPoint3D& high, const Material& material) {
  const TPoint2D outline[] = {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}};
  addPrism(mesh, outline, low.z, high.z, material, material);
  const TPoint3D bottom[] = {
      {low.x, low.y, low.z}, {low.x, high.y, low.z}, {high.x, high.y, low.z}, {high.x, low.y, low.z}};
  addPolygon(mesh, bottom, material);
}

void addPrism(Mesh& mesh, std::span<const TPoint2D> outline, double z_low_m, double z_high_m, const Material& side,
              const std::optional<Material>& top) {
  std::vector<TPoint3D> cover;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const TPoint2D &from = outline[i], &to = outline[(i + 1) % outline.size()];
    const TPoint3D face[] = {
        {from.x, from.y, z_low_m}, {to.x, to.y, z_low_m}, {to.x, to.y, z_high_m}, {from.x, from.y, z_high_m}};
    addPolygon(mesh, face, side);
    cover.emplace_back(from.x, from.y, z_high_m);
  }
  if (top) addPolygon(mesh, cover, *top);
}

void addCone(Mesh& mesh, const Cone& cone, const Material& side, const std::optional<Material>& top) {
  const double slope = (cone.radius_low_m - cone.radius_high_m) / (cone.z_high_m - cone.z_low_m);
  const double level = 1 / std::hypot(1, slope);
  const auto directions = circlePoints({0, 0}, 1, cone.sides);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const TPoint2D &from = directions[i], &to = directions[(i + 1) % directions.size()];
    const auto at = [&](const TPoint2D& direction, double radius_m, double z_m) {
      return TPoint3D(cone.axis.x + radius_m * direction.x, cone.axis.y + radius_m * direction.y, z_m);
    };
    const TPoint3D from_normal(level * from.x, level * from.y, level * slope);
    const TPoint3D to_normal(level * to.x, level * to.y, level * slope);
    addQuad(mesh,
            {at(from, cone.radius_low_m, cone.z_low_m), at(to, cone.radius_low_m, cone.z_low_m),
             at(to, cone.radius_high_m, cone.z_high_m), at(from, cone.radius_high_m, cone.z_high_m)},
            {from_normal, to_normal, to_normal, from_normal}, side);
  }
  if (top) addDisc(mesh, cone.axis, cone.z_high_m, cone.radius_high_m, cone.sides, *top);
}

void addDisc(Mesh& mesh, const TPoint2D& center, double z_m, double radius_m, int sides, const Material& material) {
  std::vector<TPoint3D> corners;
  for (const TPoint2D& point : circlePoints(center, radius_m, sides)) corners.emplace_back(point.x, point.y, z_m);
  addPolygon(mesh, corners, material);
}

std::vector<TPoint2D> circlePoints(const TPoint2D& center, double radius_m, int count) {
  std::vector<TPoint2D> points;
  for (int i = 0; i < count; ++i) {
    const double angle_rad = 2 * M_PI * i / count;
    points.emplace_back(center.x + radius_m * std::cos(angle_rad), center.y + radius_m * std::sin(angle_rad));
  }
  return points;
}

}  // namespace robosim
