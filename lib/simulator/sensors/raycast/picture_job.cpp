#include "sensors/raycast/picture_job.h"

#include <cmath>

namespace robosim {

PictureGeometry::PictureGeometry(const CameraInfo& info, const CameraAxes& the_axes, double range_max_m)
    : width_px(info.width_px),
      height_px(info.height_px),
      tiles((info.width_px + kLanes - 1) / kLanes),
      focal_px(info.focalLength()),
      // What is exactly at the range is seen.
      range_m(
          static_cast<double>(std::nextafter(static_cast<float>(range_max_m), std::numeric_limits<float>::infinity()))),
      axes(the_axes),
      is_level(the_axes.ahead.z == 0 && the_axes.left.z == 0 && info.distortion.isNone()),
      edge_slope(info.width_px / 2.0 / focal_px) {
  const PixelRays rays(info);
  const std::size_t columns = tiles * kLanes;
  for (std::size_t i = 0; i < columns; ++i) {
    const double offset = rays.left(static_cast<double>(i));
    left.push_back(offset);
    dd.push_back(1 + offset * offset);
    per_dd.push_back(1 / (1 + offset * offset));
  }
  for (std::uint32_t row = 0; row < height_px; ++row) {
    const double offset = rays.up(row);
    slope.push_back(static_cast<float>(offset));
    per_slope.push_back(1 / offset);
    up.insert(up.end(), kLanes, offset);
  }
  const bool has_lens = !info.distortion.isNone();
  if (has_lens) {
    lens_left.resize(columns * height_px);
    lens_up.resize(columns * height_px);
  }
  sky.resize(tiles * height_px);
  for (std::uint32_t row = 0; row < height_px; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const auto offset = rays.of(std::min(column, width_px - 1), row);
      if (has_lens) {
        lens_left[row * columns + column] = offset.left;
        lens_up[row * columns + column] = offset.up;
      }
      const auto way = axes.ahead + axes.left * offset.left + axes.up * offset.up;
      const double horizontal = way.x * way.x + way.y * way.y;
      horizontal_max = std::max(horizontal_max, std::sqrt(horizontal));
      sky[column / kLanes * height_px + row].word[column % kLanes] =
          skyColor(static_cast<float>(way.z / std::sqrt(horizontal + way.z * way.z)));
    }
  }
}

namespace {

SurfaceLook lookOf(const SeenScene& seen, BodyId body) {
  const auto i = static_cast<std::size_t>(body);
  return i < seen.looks.size() ? seen.looks[i] : SurfaceLook{};
}

}  // namespace

void setColors(const PictureJob& job, const SeenSolid& s, SolidColors& colors) {
  const SurfaceLook look = lookOf(*job.seen, s.body);
  colors.is_set = true;
  colors.level = lit(look, s.high_m < 0 ? kTopLight : kUndersideLight);
  if (s.isCircle()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto level = static_cast<float>(look.color[i]);
      colors.shade[i] = look.glows ? level : level * kSideLight[i];
      colors.sun[i] = look.glows ? 0.0F : level * kSunLight[i];
    }
    return;
  }
  const auto end = static_cast<float>(s.axis_x) * job.sun_x + static_cast<float>(s.axis_y) * job.sun_y;
  const auto side = static_cast<float>(s.axis_x) * job.sun_y - static_cast<float>(s.axis_y) * job.sun_x;
  const bool is_before_end = s.x * s.axis_x + s.y * s.axis_y < 0;  // the origin is beyond the end along the axis
  const bool is_before_side = s.y * s.axis_x - s.x * s.axis_y < 0;
  colors.end = lit(look, sideLight(is_before_end ? end : -end));
  colors.side = lit(look, sideLight(is_before_side ? side : -side));
}

}  // namespace robosim
