#include "rendering/ground.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Dense>
#include <GL/gl.h>
#include <GL/glext.h>

#include "rendering/shaders.h"
#include "rendering/view_volume.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

/// Extent of the ground beyond the bounds: from a robot's height its edge is 0.01° below the horizon.
constexpr double kGroundReach_m = 2000;
constexpr float kShadowBrightness = 0.70f;  ///< brightness factor in a shadow
/// Offset of a shadow per metre of the object's height, for the sun direction of shaders.cpp.
constexpr double kShadow_x = 0.385 / 0.741, kShadow_y = 0.550 / 0.741;

void addLevel(Mesh& mesh, double west, double east, double south, double north) {
  const TPoint3D corners[] = {{west, south, 0}, {east, south, 0}, {east, north, 0}, {west, north, 0}};
  addPolygon(mesh, corners, {});
}

/// Builds the ground from small quads within the bounds and growing rings around them: depth is interpolated in single
/// precision, which is inexact by metres inside a quad of kilometres. Each ring overlaps the previous one slightly,
/// which is not visible.
Mesh groundMesh(const Bounds2D& bounds) {
  constexpr double kPiece_m = 4, kMaxPieces = 32, kGrowth = 2, kUnder_m = 0.05;
  const double piece_m =
      std::max({kPiece_m, (bounds.x_max - bounds.x_min) / kMaxPieces, (bounds.y_max - bounds.y_min) / kMaxPieces});
  Bounds2D inner{bounds.x_min - piece_m, bounds.x_min - piece_m, bounds.y_min - piece_m, bounds.y_min - piece_m};
  while (inner.x_max < bounds.x_max + piece_m) inner.x_max += piece_m;
  while (inner.y_max < bounds.y_max + piece_m) inner.y_max += piece_m;
  Mesh mesh;
  for (double x = inner.x_min; x < inner.x_max - piece_m / 2; x += piece_m) {
    for (double y = inner.y_min; y < inner.y_max - piece_m / 2; y += piece_m) {
      addLevel(mesh, x, x + piece_m, y, y + piece_m);
    }
  }
  const Bounds2D middle = inner;
  for (double reach_m = 2 * piece_m; reach_m < kGrowth * kGroundReach_m; reach_m *= kGrowth) {
    const double r = std::min(reach_m, kGroundReach_m), under = kUnder_m;
    const Bounds2D outer{middle.x_min - r, middle.x_max + r, middle.y_min - r, middle.y_max + r};
    addLevel(mesh, outer.x_min, inner.x_min + under, outer.y_min, inner.y_min + under);
    addLevel(mesh, outer.x_min, inner.x_min + under, inner.y_min, inner.y_max);
    addLevel(mesh, outer.x_min, inner.x_min + under, inner.y_max - under, outer.y_max);
    addLevel(mesh, inner.x_max - under, outer.x_max, outer.y_min, inner.y_min + under);
    addLevel(mesh, inner.x_max - under, outer.x_max, inner.y_min, inner.y_max);
    addLevel(mesh, inner.x_max - under, outer.x_max, inner.y_max - under, outer.y_max);
    addLevel(mesh, inner.x_min, inner.x_max, outer.y_min, inner.y_min + under);
    addLevel(mesh, inner.x_min, inner.x_max, inner.y_max - under, outer.y_max);
    inner = outer;
  }
  return mesh;
}

void setGround(const mrpt::opengl::CRenderizable::RenderContext& rc, const Bounds2D& bounds, float light) {
  ViewUniforms::set(*rc.shader, *rc.state);
  glUniform4f(rc.shader->uniformId("bounds"), static_cast<float>(bounds.x_min), static_cast<float>(bounds.y_min),
              static_cast<float>(bounds.x_max), static_cast<float>(bounds.y_max));
  glUniform1f(rc.shader->uniformId("light"), light);
}

/// Convex hull of points, counter-clockwise (Andrew's monotone chain, 1979).
std::vector<TPoint2D> convexHull(std::vector<TPoint2D> points) {
  std::sort(points.begin(), points.end(),
            [](const TPoint2D& a, const TPoint2D& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto left_of = [](const TPoint2D& a, const TPoint2D& b, const TPoint2D& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0;
  };
  std::vector<TPoint2D> hull;
  for (const int pass : {0, 1}) {
    const std::size_t first = hull.size();
    for (const TPoint2D& p : points) {
      while (hull.size() >= first + 2 && !left_of(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // first point of the other pass
    if (pass == 0) std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace

Ground::Ground(const Bounds2D& bounds) : bounds_(bounds), mesh_(groundMesh(bounds)) {}

mrpt::opengl::shader_list_t Ground::requiredShaders() const { return {kGroundShader}; }

void Ground::render(const RenderContext& rc) const {
  setGround(rc, bounds_, 1);
  mesh_.draw({MeshInstance{}});
}

Shadows::Shadows(Mesh shadows, const Bounds2D& bounds) : bounds_(bounds), mesh_(std::move(shadows)) {
  for (const auto& v : mesh_.mesh().vertices) radius_m_ = std::max(radius_m_, std::hypot(v.x_m, v.y_m));
}

mrpt::opengl::shader_list_t Shadows::requiredShaders() const { return {kShadowShader}; }

void Shadows::render(const RenderContext& rc) const {
  constexpr float kSeen_px = 3;
  const ViewVolume view(*rc.state);
  seen_.clear();
  std::copy_if(instances_.begin(), instances_.end(), std::back_inserter(seen_), [&](const MeshInstance& instance) {
    const mrpt::math::TPoint3Df center(instance.x_m, instance.y_m, 0);
    return view.mayIntersect(center, radius_m_) && view.radiusPx(center, radius_m_) >= kSeen_px;
  });
  setGround(rc, bounds_, kShadowBrightness);
  // Drawn over the ground at equal depth; the depth buffer stays that of the ground.
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-1, -1);
  glDepthMask(GL_FALSE);
  mesh_.draw(seen_);
  glDepthMask(GL_TRUE);
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void addShadow(Mesh& mesh, std::span<const TPoint2D> outline, double height_m) {
  std::vector<TPoint2D> points(outline.begin(), outline.end());
  for (const auto& p : outline) points.emplace_back(p.x + kShadow_x * height_m, p.y + kShadow_y * height_m);
  std::vector<TPoint3D> corners;
  for (const auto& p : convexHull(std::move(points))) corners.emplace_back(p.x, p.y, 0);
  addPolygon(mesh, corners, {});
}

mrpt::opengl::shader_list_t Sky::requiredShaders() const { return {kSkyShader}; }

void Sky::render(const RenderContext& rc) const {
  const Eigen::Matrix4f picture_from_world = rc.state->p_matrix.asEigen() * rc.state->v_matrix.asEigen();
  const Eigen::Matrix4f world_from_picture = picture_from_world.inverse();
  glUniformMatrix4fv(rc.shader->uniformId("world_from_picture"), 1, GL_FALSE, world_from_picture.data());
  attributes_.createOnce();
  attributes_.bind();
  int depth_function = 0;
  glGetIntegerv(GL_DEPTH_FUNC, &depth_function);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
  glDepthFunc(static_cast<unsigned>(depth_function));
  glBindVertexArray(0);
}

}  // namespace robosim
