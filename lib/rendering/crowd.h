#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <mrpt/opengl/COpenGLBuffer.h>
#include <mrpt/opengl/COpenGLVertexArrayObject.h>

#include "rendering/drawable.h"
#include "rendering/mesh.h"
#include "rendering/view_volume.h"

namespace robosim {

/// Where one of a crowd stands, as the graphics driver takes it.
struct Member {
  float x_m = 0, y_m = 0, cosine = 1, sine = 0;
  std::array<std::uint8_t, 4> paint{255, 255, 255, 255};
};
static_assert(sizeof(Member) == 20);

/// A mesh in the graphics driver's hands, drawn for any number of members at once.
class GlMesh {
 public:
  explicit GlMesh(Mesh mesh) : mesh_(std::move(mesh)) {}

  /// Draws it for all of them, with the program in use.
  void draw(const std::vector<Member>& members);
  void free();
  const Mesh& mesh() const { return mesh_; }

 private:
  Mesh mesh_;
  mrpt::opengl::COpenGLBuffer vertices_, members_;
  mrpt::opengl::COpenGLVertexArrayObject attributes_;
};

/// Any number of things that look the same: one call to the driver draws all that are in view.
class Crowd : public Drawable {
 public:
  /// @param rough, tiny what is drawn instead where it is small, and smaller still; may be empty, for never
  explicit Crowd(Mesh full, Mesh rough = {}, Mesh tiny = {});

  /// To be put where they are before each frame.
  std::vector<Member>& members() { return members_; }

  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override;

 private:
  std::vector<Member> members_;
  mrpt::math::TPoint3Df middle_;  ///< of a ball about the mesh, on its axis
  float radius_m_ = 0;
  struct Level {
    GlMesh mesh;
    float below_px;               ///< drawn where its radius on the picture is less
    std::vector<Member> members;  ///< those in view of this frame
  };
  mutable std::vector<Level> levels_;  ///< the most detailed first
};

}  // namespace robosim
