#include "rendering/view_volume.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace robosim {

ViewVolume::ViewVolume(const mrpt::opengl::TRenderMatrices& matrices) {
  const Eigen::Matrix4f picture_from_world = matrices.p_matrix.asEigen() * matrices.v_matrix.asEigen();
  const Eigen::RowVector4f x = picture_from_world.row(0), y = picture_from_world.row(1), z = picture_from_world.row(2),
                           w = picture_from_world.row(3);
  const Eigen::RowVector4f planes[] = {w + x, w - x, w + y, w - y, w + z};
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const float length = planes[i].head<3>().norm();
    sides_[i] = {planes[i][0] / length, planes[i][1] / length, planes[i][2] / length, planes[i][3] / length};
  }
  depth_ = {w[0], w[1], w[2], w[3]};
  px_per_radian_ = y.head<3>().norm() * static_cast<float>(matrices.viewport_height) / 2;
}

bool ViewVolume::mayIntersect(const mrpt::math::TPoint3Df& center, float radius_m) const {
  return std::all_of(sides_.begin(), sides_.end(), [&](const Plane& side) { return side.of(center) > -radius_m; });
}

float ViewVolume::radiusPx(const mrpt::math::TPoint3Df& center, float radius_m) const {
  return radius_m * px_per_radian_ / std::max(depth_.of(center), 1e-3f);
}

}  // namespace robosim
