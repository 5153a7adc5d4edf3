#include <algorithm>
#include <cmath>

#include "base/vector_width.h"
#include "sensors/raycast/picture_job.h"

// Functions below are always inlined, so that it does not matter how they pass vectors.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

alignas(64) constexpr double kAhead[kLanes] = {1, 1, 1, 1, 1, 1, 1, 1};

/// The floor of a picture, by row.
struct FloorRow {
  float depth = 0;
  float x = 0, y = 0;  ///< at the optical axis, relative to the reference point
  float per_left_x = 0, per_left_y = 0;
  FieldColors fields;
};

struct FloorRows {
  std::vector<FloorRow> rows;
  std::uint32_t first = 0;  ///< the floor is seen within the range from here on
  float bounds[4]{};        ///< of the floor, relative to the reference point: x_min, x_max, y_min, y_max
};

/// Rows of a tile at slopes from `low` to `high`; may include others next to them.
struct Rows {
  std::uint32_t begin, end;
};
[[gnu::always_inline]] inline Rows rowsBetween(const PictureGeometry& camera, double low, double high) {
  constexpr double kSlack_px = 0.01;
  const double middle = camera.height_px / 2.0 - 0.5;
  const double count = camera.height_px;
  const double first = middle - high * camera.focal_px - kSlack_px;
  const double last = middle - low * camera.focal_px + kSlack_px;
  return {static_cast<std::uint32_t>(std::min(std::max(first, -1.0) + 1, count)),
          static_cast<std::uint32_t>(std::min(std::max(last, -1.0) + 1, count))};
}

/// The rows of a tile while its picture is taken.
struct TileRows {
  RowOfDepths* depths;
  RowOfWords* pixels;
  RowOfWords* bodies;
};

template <bool kHasRgb, bool kHasBody>
[[gnu::always_inline]] inline void drawSolid(const PictureJob& job, const TileRows& tile, const SeenSolid& s,
                                             const SolidColors& colors, const Crossing& crossing,
                                             const VisibleSpan& span) {
  const PictureGeometry& camera = *job.camera;
  const auto body = static_cast<std::uint32_t>(s.body);
  const Floats in = toFloats(span.in);
  {
    const Floats low = toFloats(span.low), high = toFloats(span.high);
    Words color{};
    if constexpr (kHasRgb) color = faceColors(s, colors, crossing);
    const Rows rows = rowsBetween(camera, span.low_min, span.high_max);
    const float* const slopes = camera.slope.data();
    for (std::uint32_t row = rows.begin; row < rows.end; ++row) {
      const float slope = slopes[row];
      Floats& depth = vectorOf(tile.depths[row]);
      const Bits is_seen = (slope >= low) & (slope <= high) & (in < depth);
      depth = is_seen ? in : depth;
      if constexpr (kHasRgb) {
        Words& pixel = vectorOf(tile.pixels[row]);
        pixel = is_seen ? color : pixel;
      }
      if constexpr (kHasBody) {
        Words& bodies = vectorOf(tile.bodies[row]);
        bodies = is_seen ? Words{} + body : bodies;
      }
    }
  }
  if (span.level_m == 0) return;
  const Floats out = toFloats(span.out);
  const Rows rows = rowsBetween(camera, span.level_slope_min, span.level_slope_max);
  const double* const per_slope = camera.per_slope.data();
  const double level_m = span.level_m;
  const PackedRgb level = colors.level;
  for (std::uint32_t row = rows.begin; row < rows.end; ++row) {
    const auto at = static_cast<float>(level_m * per_slope[row]);
    Floats& depth = vectorOf(tile.depths[row]);
    const Bits is_seen = (at >= in) & (at <= out) & (at < depth);
    depth = is_seen ? Floats{} + at : depth;
    if constexpr (kHasRgb) {
      Words& pixel = vectorOf(tile.pixels[row]);
      pixel = is_seen ? Words{} + level : pixel;
    }
    if constexpr (kHasBody) {
      Words& bodies = vectorOf(tile.bodies[row]);
      bodies = is_seen ? Words{} + body : bodies;
    }
  }
}

template <bool kHasRgb, bool kHasBody>
[[gnu::always_inline]] inline void drawBackground(const PictureJob& job, const FloorRows& floor,
                                                  std::size_t tile_number, const TileRows& tile) {
  const PictureGeometry& camera = *job.camera;
  const auto range = static_cast<float>(camera.range_m);
  const std::uint32_t rows = camera.height_px;
  const RowOfWords* const sky = &camera.sky[tile_number * rows];
  const std::uint32_t first = floor.first;
  for (std::uint32_t row = 0; row < first; ++row) vectorOf(tile.depths[row]) = Floats{} + range;
  if constexpr (kHasRgb) std::copy(sky, sky + first, tile.pixels);
  if constexpr (kHasBody) {
    for (std::uint32_t row = 0; row < first; ++row) vectorOf(tile.bodies[row]) = Words{} + RaycastPicture::kSky;
  }
  const Floats left = toFloats(&camera.left[tile_number * kLanes]);
  const FloorRow* const of_floor = floor.rows.data();
  const float x_min = floor.bounds[0], x_max = floor.bounds[1], y_min = floor.bounds[2], y_max = floor.bounds[3];
  for (std::uint32_t row = first; row < rows; ++row) {
    const FloorRow at = of_floor[row];
    vectorOf(tile.depths[row]) = Floats{} + at.depth;
    if constexpr (kHasBody) vectorOf(tile.bodies[row]) = Words{} + RaycastPicture::kFloor;
    if constexpr (kHasRgb) {
      const Floats x = at.x + at.per_left_x * left;
      const Floats y = at.y + at.per_left_y * left;
      const Bits whole_x = __builtin_convertvector(x, Bits), whole_y = __builtin_convertvector(y, Bits);
      // Rounded towards zero; a comparison that holds is -1.
      const Bits field_x = whole_x + (x < __builtin_convertvector(whole_x, Floats));
      const Bits field_y = whole_y + (y < __builtin_convertvector(whole_y, Floats));
      const Bits is_bright = -((field_x ^ field_y) & 1);
      const Words color = is_bright ? Words{} + at.fields.bright : Words{} + at.fields.dark;
      const Bits is_inside = (x >= x_min) & (x <= x_max) & (y >= y_min) & (y <= y_max);
      vectorOf(tile.pixels[row]) = is_inside ? color : Words{} + packed(kGroundColor);
    }
  }
}

/// Draws what is painted on the floor.
void paintFloor(const PictureJob& job, const FloorRows& floor, std::size_t tile_number, const TileRows& tile) {
  const PictureGeometry& camera = *job.camera;
  for (std::uint32_t row = floor.first; row < camera.height_px; ++row) {
    const double depth = job.floor_m * camera.per_slope[row];
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (tile.depths[row].depth[i] != floor.rows[row].depth) continue;  // hidden
      const double left = depth * camera.left[tile_number * kLanes + i];
      const TPoint2D place(job.frame.x + depth * job.frame.ahead_x - left * job.frame.ahead_y,
                           job.frame.y + depth * job.frame.ahead_y + left * job.frame.ahead_x);
      if (const auto color = paintAt(job.seen->floor, place)) tile.pixels[row].word[i] = *color;
    }
  }
}

template <bool kHasRgb, bool kHasBody>
[[gnu::always_inline]] inline void drawTiles(const PictureJob* job, const FloorRows* floor) {
  const PictureGeometry& camera = *job->camera;
  PictureScratch& scratch = *job->scratch;
  const TileRows tile{scratch.depths.data(), scratch.pixels.data(), scratch.bodies.data()};
  const bool is_painted = kHasRgb && (!job->seen->floor.areas.empty() || !job->seen->floor.pictures.empty());
  Horizon horizon;
  Crossing crossing;
  VisibleSpan span;
  for (std::size_t number = 0; number < camera.tiles; ++number) {
    drawBackground<kHasRgb, kHasBody>(*job, *floor, number, tile);
    horizon.reset();
    const std::size_t first = number * kLanes;
    const TileColumns columns{kAhead, &camera.left[first], &camera.dd[first], &camera.per_dd[first]};
    const double slope_max = columns.dy[0], slope_min = columns.dy[kLanes - 1];
    for (std::size_t k = 0; k < scratch.solids.size(); ++k) {
      const SeenSolid& s = scratch.solids[k];
      if (s.slope_max < slope_min || s.slope_min > slope_max || isHidden(s, horizon)) continue;
      if (s.isCircle()) {
        crossCircle(columns, s, static_cast<double>(job->sun_x), static_cast<double>(job->sun_y), crossing);
      } else {
        crossBox(columns, s, crossing);
      }
      if (!clipToHorizon(s, crossing, job->floor_m, horizon, span)) continue;
      if constexpr (kHasRgb) {
        if (!scratch.colors[k].is_set) setColors(*job, s, scratch.colors[k]);
      }
      drawSolid<kHasRgb, kHasBody>(*job, tile, s, scratch.colors[k], crossing, span);
    }
    if (is_painted) paintFloor(*job, *floor, number, tile);
    writeRows(TileTarget(*job, number, 0), camera.height_px, tile.depths, tile.pixels, tile.bodies);
  }
}

void setFloor(const PictureJob& job, FloorRows& floor) {
  const PictureGeometry& camera = *job.camera;
  floor.rows.resize(camera.height_px);
  floor.first = camera.height_px;
  if (!(job.floor_m < 0)) return;
  // An even number of fields from the origin of the world.
  const TPoint2D reference(2 * std::floor(job.frame.x / 2), 2 * std::floor(job.frame.y / 2));
  const TPoint2D origin(job.frame.x - reference.x, job.frame.y - reference.y);
  const auto per_pixel = static_cast<float>(1 / (camera.focal_px * -job.floor_m));
  for (std::uint32_t row = camera.height_px; row-- > 0;) {
    const double depth = job.floor_m * camera.per_slope[row];
    if (!(camera.slope[row] < 0) || !(depth < camera.range_m)) break;
    floor.first = row;
    FloorRow& at = floor.rows[row];
    at.depth = static_cast<float>(depth);
    at.x = static_cast<float>(origin.x + depth * job.frame.ahead_x);
    at.y = static_cast<float>(origin.y + depth * job.frame.ahead_y);
    at.per_left_x = static_cast<float>(-depth * job.frame.ahead_y);
    at.per_left_y = static_cast<float>(depth * job.frame.ahead_x);
    at.fields = fieldColors(at.depth * at.depth * per_pixel);
  }
  const Bounds2D& bounds = job.seen->floor.bounds;
  floor.bounds[0] = static_cast<float>(bounds.x_min - reference.x);
  floor.bounds[1] = static_cast<float>(bounds.x_max - reference.x);
  floor.bounds[2] = static_cast<float>(bounds.y_min - reference.y);
  floor.bounds[3] = static_cast<float>(bounds.y_max - reference.y);
}

}  // namespace

void takeLevelPicture(const PictureJob& job) {
  static thread_local FloorRows floor;
  const PictureGeometry& camera = *job.camera;
  PictureScratch& scratch = *job.scratch;
  findSeenSolids(job.seen->scene, job.frame, {.range_m = camera.range_m, .slope_max = camera.edge_slope}, job.owner,
                 scratch.solids);
  scratch.colors.assign(scratch.solids.size(), {});
  scratch.depths.resize(camera.height_px);
  scratch.pixels.resize(camera.height_px);
  scratch.bodies.resize(camera.height_px);
  setFloor(job, floor);
  forLayers(*job.picture, [&](auto has_rgb, auto has_body) {
    withVectors<drawTiles<has_rgb, has_body>>(&job, static_cast<const FloorRows*>(&floor));
  });
}

}  // namespace robosim
