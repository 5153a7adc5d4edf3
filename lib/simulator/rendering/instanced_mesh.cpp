#include "rendering/instanced_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <GL/gl.h>
#include <GL/glext.h>

#include "rendering/shaders.h"

namespace robosim {
namespace {

/// Radii in the picture [pixels] below which lower levels of detail are drawn.
constexpr float kRoughBelow_px = 14, kTinyBelow_px = 5, kSpeckBelow_px = 2;

template <typename Element>
void bindAttribute(unsigned location, int size, unsigned type, bool normalized, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(
      location, size, type, normalized ? GL_TRUE : GL_FALSE, sizeof(Element),
      reinterpret_cast<const void*>(offset));  // NOLINT(performance-no-int-to-ptr): required by OpenGL
}

}  // namespace

void GlMesh::draw(const std::vector<MeshInstance>& instances) {
  if (instances.empty() || mesh_.vertices.empty()) return;
  const bool is_new = !attributes_.isCreated();
  attributes_.createOnce();
  attributes_.bind();
  if (is_new) {
    vertices_.createOnce();
    vertices_.bind();
    vertices_.allocate(mesh_.vertices.data(), static_cast<int>(mesh_.vertices.size() * sizeof(MeshVertex)));
    bindAttribute<MeshVertex>(kPosition, 3, GL_FLOAT, false, offsetof(MeshVertex, x_m));
    bindAttribute<MeshVertex>(kNormal, 4, GL_BYTE, true, offsetof(MeshVertex, normal));
    bindAttribute<MeshVertex>(kColor, 4, GL_UNSIGNED_BYTE, true, offsetof(MeshVertex, color));
  }
  instances_.setUsage(GlBuffer::Usage::StreamDraw);
  instances_.createOnce();
  instances_.bind();
  instances_.allocate(instances.data(), static_cast<int>(instances.size() * sizeof(MeshInstance)));
  if (is_new) {
    bindAttribute<MeshInstance>(kPlace, 4, GL_FLOAT, false, offsetof(MeshInstance, x_m));
    bindAttribute<MeshInstance>(kPaint, 4, GL_UNSIGNED_BYTE, true, offsetof(MeshInstance, paint));
    glVertexAttribDivisor(kPlace, 1);
    glVertexAttribDivisor(kPaint, 1);
  }
  glDrawArraysInstanced(GL_TRIANGLES, 0, static_cast<int>(mesh_.vertices.size()), static_cast<int>(instances.size()));
  glBindVertexArray(0);
}

void GlMesh::free() {
  attributes_.destroy();
  vertices_.destroy();
  instances_.destroy();
}

InstancedMesh::InstancedMesh(Mesh full, Mesh rough, Mesh tiny, Mesh speck) {
  float low_m = 1e9f, high_m = -1e9f, around_m = 0;
  for (const auto& v : full.vertices) {
    low_m = std::min(low_m, v.z_m);
    high_m = std::max(high_m, v.z_m);
    around_m = std::max(around_m, std::hypot(v.x_m, v.y_m));
  }
  center_ = {0, 0, (low_m + high_m) / 2};
  radius_m_ = std::hypot(around_m, (high_m - low_m) / 2);
  levels_.push_back({GlMesh(std::move(full)), std::numeric_limits<float>::infinity(), {}});
  if (!rough.vertices.empty()) levels_.push_back({GlMesh(std::move(rough)), kRoughBelow_px, {}});
  if (!tiny.vertices.empty()) levels_.push_back({GlMesh(std::move(tiny)), kTinyBelow_px, {}});
  if (!speck.vertices.empty()) levels_.push_back({GlMesh(std::move(speck)), kSpeckBelow_px, {}});
}

mrpt::opengl::shader_list_t InstancedMesh::requiredShaders() const { return {kSolidShader}; }

void InstancedMesh::render(const RenderContext& rc) const {
  const ViewVolume view(*rc.state);
  for (auto& level : levels_) level.instances.clear();
  for (const MeshInstance& instance : instances_) {
    if (!isShown(instance)) continue;
    const mrpt::math::TPoint3Df center(instance.x_m, instance.y_m, center_.z);
    if (!view.mayIntersect(center, radius_m_)) continue;
    const float radius_px = levels_.size() > 1 ? view.radiusPx(center, radius_m_) : 0;
    auto level = levels_.rbegin();
    while (radius_px >= level->below_px) ++level;
    level->instances.push_back(instance);
  }
  ViewUniforms::set(*rc.shader, *rc.state);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  for (auto& level : levels_) level.mesh.draw(level.instances);
  glDisable(GL_CULL_FACE);
}

void InstancedMesh::freeOpenGLResources() {
  for (auto& level : levels_) level.mesh.free();
}

}  // namespace robosim
