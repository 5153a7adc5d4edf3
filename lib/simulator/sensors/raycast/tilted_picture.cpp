#include <algorithm>
#include <cmath>

#include "base/vector_width.h"
#include "sensors/raycast/picture_job.h"

// Functions below are always inlined, so that it does not matter how they pass vectors.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPoint3D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Bounds of a solid or of pixels in the picture plane, at a depth of 1.
struct PlaneBounds {
  double left_min = kInfinity, left_max = -kInfinity, up_min = kInfinity, up_max = -kInfinity;

  void add(double left, double up) {
    left_min = std::min(left_min, left);
    left_max = std::max(left_max, left);
    up_min = std::min(up_min, up);
    up_max = std::max(up_max, up);
  }
};

/// Bounds of the corners of a prism that covers a solid; without limits if one is not ahead, and empty if none is.
PlaneBounds boundsOf(const PictureGeometry& camera, const SeenSolid& s) {
  constexpr double kSlack = 1e-9;
  const double along = s.half_length_m, aside = s.isCircle() ? s.half_length_m : s.half_width_m;
  PlaneBounds bounds;
  std::size_t ahead = 0;
  for (const double a : {-along, along}) {
    for (const double b : {-aside, aside}) {
      for (const double z : {s.low_m, s.high_m}) {
        const TPoint3D corner(s.x + a * s.axis_x - b * s.axis_y, s.y + a * s.axis_y + b * s.axis_x, z);
        const auto dot = [&](const TPoint3D& axis) {
          return corner.x * axis.x + corner.y * axis.y + corner.z * axis.z;
        };
        const double depth = dot(camera.axes.ahead);
        if (!(depth > kSlack)) continue;
        ++ahead;
        bounds.add(dot(camera.axes.left) / depth - kSlack, dot(camera.axes.up) / depth + kSlack);
        bounds.add(dot(camera.axes.left) / depth + kSlack, dot(camera.axes.up) / depth - kSlack);
      }
    }
  }
  if (ahead == 0) return {};
  return ahead == 8 ? bounds : PlaneBounds{-kInfinity, kInfinity, -kInfinity, kInfinity};
}

[[gnu::always_inline]] inline bool isAny(const Bits& of) {
  std::int32_t any = 0;
  for (std::size_t i = 0; i < kLanes; ++i) any |= of[i];
  return any != 0;
}
[[gnu::always_inline]] inline double largestDepth(const RowOfDepths& row) {
  float depth = row.depth[0];
  for (std::size_t i = 1; i < kLanes; ++i) depth = row.depth[i] > depth ? row.depth[i] : depth;
  return static_cast<double>(depth);
}

/// A tile of one row of pixels.
struct TileRow {
  std::size_t number;  ///< in the row
  std::uint32_t row;
  RowOfDepths depths;
  RowOfWords pixels, bodies;
};

/// Rays of a tile, in the view's frame, per depth.
struct alignas(64) TileRays {
  double x[kLanes], y[kLanes], z[kLanes], dd[kLanes], per_dd[kLanes], per_z[kLanes];
  PlaneBounds bounds;
};

[[gnu::always_inline]] inline void setRays(const PictureGeometry& camera, const double* left, const double* up,
                                           TileRays& rays) {
  const CameraAxes& axes = camera.axes;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kLanes; ++i) {
    // A vertical ray is replaced by a very steep one.
    constexpr double kMinHorizontal = 1e-150;
    const double x = axes.ahead.x + axes.left.x * left[i] + axes.up.x * up[i];
    const double y = axes.ahead.y + axes.left.y * left[i] + axes.up.y * up[i];
    const double z = axes.ahead.z + axes.left.z * left[i] + axes.up.z * up[i];
    const bool is_vertical = x * x + y * y == 0;
    rays.x[i] = is_vertical ? kMinHorizontal : x;
    rays.y[i] = y;
    rays.z[i] = z;
    rays.dd[i] = rays.x[i] * rays.x[i] + y * y;
    rays.per_dd[i] = 1 / rays.dd[i];
    rays.per_z[i] = 1 / (z == 0 ? kMinFaceSlope : z);
  }
  rays.bounds = {smallest(left), largest(left), smallest(up), largest(up)};
}

/// Draws a solid where the columns of its outline are crossed within its heights.
template <bool kHasRgb, bool kHasBody>
[[gnu::always_inline]] inline void drawSolid(const PictureJob& job, const TileRays& rays, const SeenSolid& s,
                                             SolidColors& colors, const Crossing& crossing, TileRow& tile) {
  alignas(64) double depth[kLanes];
  alignas(64) float is_level[kLanes];
  double depth_min = kInfinity;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double z1 = s.low_m * rays.per_z[i], z2 = s.high_m * rays.per_z[i];
    const double z_from = z1 < z2 ? z1 : z2;
    const double z_to = z2 < z1 ? z1 : z2;
    const double from = z_from > crossing.in[i] ? z_from : crossing.in[i];
    const double to = z_to < crossing.out[i] ? z_to : crossing.out[i];
    depth[i] = from <= to ? from : kInfinity;
    is_level[i] = z_from > crossing.in[i] ? 1.0F : 0.0F;
  }
  depth_min = smallest(depth);
  if (!(depth_min < kInfinity)) return;
  const Floats at = toFloats(depth);
  Floats& nearest = vectorOf(tile.depths);
  const Bits is_seen = at < nearest;
  nearest = is_seen ? at : nearest;
  if constexpr (kHasRgb) {
    if (!colors.is_set) setColors(job, s, colors);
    RowOfDepths level;
    for (std::size_t i = 0; i < kLanes; ++i) level.depth[i] = is_level[i];
    const Words color = vectorOf(level) > 0 ? Words{} + colors.level : faceColors(s, colors, crossing);
    Words& pixels = vectorOf(tile.pixels);
    pixels = is_seen ? color : pixels;
  }
  Words& bodies = vectorOf(tile.bodies);
  bodies = is_seen ? Words{} + static_cast<std::uint32_t>(s.body) : bodies;
}

/// The floor of a picture relative to a reference point, an even number of fields from the origin of the world.
struct FloorView {
  TPoint2D origin;  ///< of the view
  Bounds2D bounds;
  float per_pixel;  ///< length that a pixel covers, over the square of its depth
  bool is_painted;

  explicit FloorView(const PictureJob& job)
      : per_pixel(static_cast<float>(1 / (job.camera->focal_px * -job.floor_m))),
        is_painted(!job.seen->floor.areas.empty() || !job.seen->floor.pictures.empty()) {
    const TPoint2D reference(2 * std::floor(job.frame.x / 2), 2 * std::floor(job.frame.y / 2));
    const Bounds2D& all = job.seen->floor.bounds;
    origin = {job.frame.x - reference.x, job.frame.y - reference.y};
    bounds = {all.x_min - reference.x, all.x_max - reference.x, all.y_min - reference.y, all.y_max - reference.y};
  }
};

constexpr float kFar_m = 1e9F;  ///< farther than any floor, and a whole number of 32 bits

/// Colours of the floor at the rays' depths.
[[gnu::always_inline]] inline void colorFloor(const PictureJob& job, const FloorView& floor, const TileRays& rays,
                                              const double* depth, RowOfWords& colors) {
  const double ahead_x = job.frame.ahead_x, ahead_y = job.frame.ahead_y;
  alignas(64) float x[kLanes], y[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) {
    x[i] = static_cast<float>(floor.origin.x + depth[i] * (ahead_x * rays.x[i] - ahead_y * rays.y[i]));
    y[i] = static_cast<float>(floor.origin.y + depth[i] * (ahead_y * rays.x[i] + ahead_x * rays.y[i]));
  }
  const auto x_min = static_cast<float>(floor.bounds.x_min), x_max = static_cast<float>(floor.bounds.x_max);
  const auto y_min = static_cast<float>(floor.bounds.y_min), y_max = static_cast<float>(floor.bounds.y_max);
  for (std::size_t i = 0; i < kLanes; ++i) {
    // Rays that do not meet the floor have no finite place there.
    const float near_x = x[i] > -kFar_m ? (x[i] < kFar_m ? x[i] : kFar_m) : -kFar_m;
    const float near_y = y[i] > -kFar_m ? (y[i] < kFar_m ? y[i] : kFar_m) : -kFar_m;
    const auto whole_x = static_cast<std::int32_t>(near_x), whole_y = static_cast<std::int32_t>(near_y);
    const std::int32_t field_x = whole_x - (near_x < static_cast<float>(whole_x) ? 1 : 0);
    const std::int32_t field_y = whole_y - (near_y < static_cast<float>(whole_y) ? 1 : 0);
    const float sign = ((field_x ^ field_y) & 1) != 0 ? kFieldContrast : -kFieldContrast;
    const auto at = static_cast<float>(depth[i]);
    const float fading = 1.6F - 2.0F * (at * at * floor.per_pixel);
    const float limited = fading > 0.0F ? fading : 0.0F;
    const float brightness = 1.0F + sign * (limited < 1.0F ? limited : 1.0F);
    const auto level = [&](std::size_t channel) {
      return static_cast<std::int32_t>(kCheckerColor[channel] * brightness * 255.0F + 0.5F);
    };
    const std::int32_t color = level(0) | level(1) << 8 | level(2) << 16;
    const bool is_inside = (x[i] >= x_min) & (x[i] <= x_max) & (y[i] >= y_min) & (y[i] <= y_max);
    colors.word[i] = is_inside ? static_cast<std::uint32_t>(color) : packed(kGroundColor);
  }
}

/// What is painted on the floor at the rays' depths.
void paintFloor(const PictureJob& job, const TileRays& rays, const double* depth, RowOfWords& colors) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = rays.x[i] * depth[i], y = rays.y[i] * depth[i];
    const TPoint2D place(job.frame.x + x * job.frame.ahead_x - y * job.frame.ahead_y,
                         job.frame.y + x * job.frame.ahead_y + y * job.frame.ahead_x);
    if (const auto color = paintAt(job.seen->floor, place)) colors.word[i] = *color;
  }
}

template <bool kHasRgb, bool kHasBody>
[[gnu::always_inline]] inline void drawTiles(const PictureJob* job, const std::vector<PlaneBounds>* bounds,
                                             std::vector<std::uint32_t>* of_row) {
  const PictureGeometry& camera = *job->camera;
  PictureScratch& scratch = *job->scratch;
  const auto range = static_cast<float>(camera.range_m);
  TileRays rays;
  TileRow tile{};
  Crossing crossing;
  const TileColumns columns{rays.x, rays.y, rays.dd, rays.per_dd};
  const FloorView floor(*job);
  const bool has_lens = !camera.lens_left.empty();
  const std::size_t columns_count = camera.tiles * kLanes;
  for (tile.row = 0; tile.row < camera.height_px; ++tile.row) {
    const double* const row_up = has_lens ? &camera.lens_up[tile.row * columns_count] : &camera.up[tile.row * kLanes];
    const auto [up_min, up_max] = std::minmax_element(row_up, row_up + (has_lens ? columns_count : 1));
    std::size_t in_row = 0;
    for (std::size_t k = 0; k < scratch.solids.size(); ++k) {
      (*of_row)[in_row] = static_cast<std::uint32_t>(k);
      in_row += !((*bounds)[k].up_min > *up_max || (*bounds)[k].up_max < *up_min) ? 1 : 0;
    }
    for (tile.number = 0; tile.number < camera.tiles; ++tile.number) {
      const std::size_t first = tile.number * kLanes;
      setRays(camera, has_lens ? &camera.lens_left[tile.row * columns_count + first] : &camera.left[first],
              has_lens ? row_up + first : row_up, rays);
      alignas(64) double floor_depth[kLanes];
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double depth = job->floor_m * rays.per_z[i];
        const bool is_seen = (rays.z[i] < 0) & (depth < camera.range_m);
        floor_depth[i] = is_seen ? depth : camera.range_m;
      }
      vectorOf(tile.depths) = toFloats(floor_depth);
      vectorOf(tile.bodies) =
          vectorOf(tile.depths) < range ? Words{} + RaycastPicture::kFloor : Words{} + RaycastPicture::kSky;
      if constexpr (kHasRgb) tile.pixels = camera.sky[tile.number * camera.height_px + tile.row];
      double reach_m = largestDepth(tile.depths) * camera.horizontal_max;
      for (std::size_t n = 0; n < in_row; ++n) {
        const std::uint32_t k = (*of_row)[n];
        const SeenSolid& s = scratch.solids[k];
        const PlaneBounds& b = (*bounds)[k];
        if (s.near_m > reach_m) break;
        if (b.left_min > rays.bounds.left_max || b.left_max < rays.bounds.left_min) continue;
        if (s.isCircle()) {
          crossCircle(columns, s, static_cast<double>(job->sun_x), static_cast<double>(job->sun_y), crossing);
        } else {
          crossBox(columns, s, crossing);
        }
        drawSolid<kHasRgb, kHasBody>(*job, rays, s, scratch.colors[k], crossing, tile);
        reach_m = largestDepth(tile.depths) * camera.horizontal_max;
      }
      if constexpr (kHasRgb) {
        const Bits is_floor = vectorOf(tile.bodies) == RaycastPicture::kFloor;
        if (isAny(is_floor)) {
          RowOfWords colors;
          colorFloor(*job, floor, rays, floor_depth, colors);
          if (floor.is_painted) paintFloor(*job, rays, floor_depth, colors);
          vectorOf(tile.pixels) = is_floor ? vectorOf(colors) : vectorOf(tile.pixels);
        }
      }
      writeRows(TileTarget(*job, tile.number, tile.row), 1, &tile.depths, &tile.pixels, &tile.bodies);
    }
  }
}

}  // namespace

void takeTiltedPicture(const PictureJob& job) {
  static thread_local std::vector<PlaneBounds> bounds;
  static thread_local std::vector<std::uint32_t> of_row;  // indices of solids
  const PictureGeometry& camera = *job.camera;
  PictureScratch& scratch = *job.scratch;
  findSeenSolids(job.seen->scene, job.frame, {.range_m = camera.range_m * camera.horizontal_max}, job.owner,
                 scratch.solids);
  scratch.colors.assign(scratch.solids.size(), {});
  bounds.clear();
  for (const auto& s : scratch.solids) bounds.push_back(boundsOf(camera, s));
  of_row.resize(scratch.solids.size() + 1);
  forLayers(*job.picture, [&](auto has_rgb, auto has_body) {
    withVectors<drawTiles<has_rgb, has_body>>(&job, static_cast<const std::vector<PlaneBounds>*>(&bounds), &of_row);
  });
}

}  // namespace robosim
