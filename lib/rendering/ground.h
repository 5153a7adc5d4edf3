#pragma once
#include "geometry/solid.h"
#include "rendering/crowd.h"

namespace robosim {

/// The ground, z = 0, as far as one can see: a floor of tiles of 1 m inside a world's bounds, and plain ground beyond.
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

/// Shadows of upright things on the ground. Each is ground once more, but darker: so where two fall on one another it
/// is no darker than where there is one.
class Shadows : public Drawable {
 public:
  /// @param shadows on z = 0, about each member's place, and never turned
  Shadows(Mesh shadows, const Bounds2D& bounds);

  std::vector<Member>& members() { return members_; }

  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override { mesh_.free(); }

 private:
  Bounds2D bounds_;
  std::vector<Member> members_;
  mutable GlMesh mesh_;
};

/// Adds the shadow of an upright thing with this convex outline, counter-clockwise, that stands on the ground.
void addShadow(Mesh& mesh, std::span<const mrpt::math::TPoint2D> outline, double height_m);

/// The sky, wherever nothing else is in the picture. It has no depth.
class Sky : public Drawable {
 public:
  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override { attributes_.destroy(); }

 private:
  mutable mrpt::opengl::COpenGLVertexArrayObject attributes_;
};

}  // namespace robosim
