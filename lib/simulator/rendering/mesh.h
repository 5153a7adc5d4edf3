#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPoint3D.h>
#include <mrpt/math/TPose3D.h>

#include "rendering/color.h"

namespace robosim {

/// Surface properties.
struct Material {
  Color color{1, 1, 1};
  float gloss = 0;       ///< [0, 1]: 0 is matt, 1 is polished metal
  bool painted = false;  ///< multiplied by the colour of the instance
};

/// Vertex in the layout of the vertex buffer.
struct MeshVertex {
  float x_m = 0, y_m = 0, z_m = 0;
  std::int8_t normal[3] = {};  ///< of length 127
  std::int8_t gloss = 0;       ///< [0, 127]
  std::uint8_t color[3] = {};
  std::uint8_t painted = 0;  ///< 0 or 255
  bool operator==(const MeshVertex&) const = default;
};
static_assert(sizeof(MeshVertex) == 20);

/// A solid's surface: triangles, three vertices each, counter-clockwise as seen from outside.
struct Mesh {
  std::vector<MeshVertex> vertices;
  bool operator==(const Mesh&) const = default;

  std::size_t triangles() const { return vertices.size() / 3; }
  /// Adds a copy of another mesh at a pose.
  void add(const Mesh& other, const mrpt::math::TPose3D& at);
};

/// An upright box with opposite corners at `low` and `high`.
void addBox(Mesh& mesh, const mrpt::math::TPoint3D& low, const mrpt::math::TPoint3D& high, const Material& material);

/// An upright prism over a convex outline, counter-clockwise; open at the bottom, and at the top if `top` is nullopt.
void addPrism(Mesh& mesh, std::span<const mrpt::math::TPoint2D> outline, double z_low_m, double z_high_m,
              const Material& side, const std::optional<Material>& top);

/// An upright cylinder or truncated cone round `axis` with smooth shading; open at the bottom, and at the top if `top`
/// is nullopt.
struct Cone {
  mrpt::math::TPoint2D axis;
  double z_low_m = 0, z_high_m = 0;
  double radius_low_m = 0, radius_high_m = 0;
  int sides = 32;
};
void addCone(Mesh& mesh, const Cone& cone, const Material& side, const std::optional<Material>& top);

/// A horizontal disc that faces up. Undersides are never drawn.
void addDisc(Mesh& mesh, const mrpt::math::TPoint2D& center, double z_m, double radius_m, int sides, const Material&);

/// A convex polygon in space, counter-clockwise as seen from its visible side.
void addPolygon(Mesh& mesh, std::span<const mrpt::math::TPoint3D> corners, const Material&);

/// Points on a circle, counter-clockwise.
std::vector<mrpt::math::TPoint2D> circlePoints(const mrpt::math::TPoint2D& center, double radius_m, int count);

}  // namespace robosim
