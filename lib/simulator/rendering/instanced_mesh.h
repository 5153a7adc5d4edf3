#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "rendering/drawable.h"
#include "rendering/mesh.h"
#include "rendering/opengl_resources.h"
#include "rendering/view_volume.h"

namespace robosim {

/// Pose and colour of one instance, in the layout of the vertex buffer.
struct MeshInstance {
  float x_m = 0, y_m = 0, cosine = 1, sine = 0;
  std::array<std::uint8_t, 4> paint{255, 255, 255, 255};
};
static_assert(sizeof(MeshInstance) == 20);

/// An instance whose position is not a number is not drawn.
inline bool isShown(const MeshInstance& instance) { return !std::isnan(instance.x_m); }

/// A mesh in OpenGL buffers, drawn for any number of instances by one call.
class GlMesh {
 public:
  explicit GlMesh(Mesh mesh) : mesh_(std::move(mesh)) {}

  /// Draws all instances with the current program.
  void draw(const std::vector<MeshInstance>& instances);
  void free();
  const Mesh& mesh() const { return mesh_; }

 private:
  Mesh mesh_;
  GlBuffer vertices_, instances_;
  GlVertexArray attributes_;
};

/// Any number of objects of equal shape, drawn by one OpenGL call per level of detail after culling.
class InstancedMesh : public Drawable {
 public:
  /// @param rough, tiny, speck lower levels of detail for small sizes on the picture; empty if unused
  explicit InstancedMesh(Mesh full, Mesh rough = {}, Mesh tiny = {}, Mesh speck = {});

  /// To be updated before each frame.
  std::vector<MeshInstance>& instances() { return instances_; }

  mrpt::opengl::shader_list_t requiredShaders() const override;
  void render(const RenderContext&) const override;
  void freeOpenGLResources() override;

 private:
  std::vector<MeshInstance> instances_;
  mrpt::math::TPoint3Df center_;  ///< of the bounding sphere, on the mesh's axis
  float radius_m_ = 0;
  struct Level {
    GlMesh mesh;
    float below_px;                       ///< drawn where its radius on the picture is less
    std::vector<MeshInstance> instances;  ///< visible in this frame
  };
  mutable std::vector<Level> levels_;  ///< the most detailed first
};

}  // namespace robosim
