#pragma once
#include "geometry/shapes/solid.h"
#include "rendering/instanced_mesh.h"

namespace robosim {

/// The ground plane z = 0 out to the horizon: tiles of 1 m inside the world's bounds, plain ground outside.
class Ground : public Drawable {
 public:
  explicit Ground(const Bounds2D& bounds);

  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override { mesh_.free(); }

 private:
  Bounds2D bounds_;
  mutable GlMesh mesh_;
};

/// Shadows of upright objects on the ground, except those of a radius of less than 3 pixels. Each shadow redraws the
/// ground at a lower brightness, so overlapping shadows are no darker than one.
class Shadows : public Drawable {
 public:
  /// @param shadows on z = 0, relative to each instance's position; not rotated
  Shadows(Mesh shadows, const Bounds2D& bounds);

  std::vector<MeshInstance>& instances() { return instances_; }

  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override { mesh_.free(); }

 private:
  Bounds2D bounds_;
  std::vector<MeshInstance> instances_;
  float radius_m_ = 0;  ///< of a circle about the instance's position that contains its shadows
  mutable GlMesh mesh_;
  mutable std::vector<MeshInstance> seen_;  ///< in this frame
};

/// Adds the shadow of an upright prism that stands on the ground, with this convex outline, counter-clockwise.
void addShadow(Mesh& mesh, std::span<const mrpt::math::TPoint2D> outline, double height_m);

/// The sky: drawn where nothing else is in the picture. Writes no depth.
class Sky : public Drawable {
 public:
  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override { attributes_.destroy(); }

 private:
  mutable GlVertexArray attributes_;
};

}  // namespace robosim
