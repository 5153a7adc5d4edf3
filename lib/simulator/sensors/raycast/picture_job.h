#pragma once
#include <cstring>
#include <type_traits>
#include <vector>

#include <mrpt/math/TPoint3D.h>

#include "sensors/raycast/column_tile.h"
#include "sensors/raycast/pixel_rays.h"
#include "sensors/raycast/surface_light.h"

/// Parts of a RaycastCamera's pictures that level cameras and others have in common.
// Functions below are always inlined, so that it does not matter how they pass vectors.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace robosim {

/// Numbers of a tile's columns.
using Floats [[gnu::vector_size(sizeof(float) * kLanes), gnu::may_alias]] = float;
using Words [[gnu::vector_size(sizeof(std::uint32_t) * kLanes), gnu::may_alias]] = std::uint32_t;
using Bits [[gnu::vector_size(sizeof(std::int32_t) * kLanes), gnu::may_alias]] = std::int32_t;

/// One row of a tile.
struct alignas(sizeof(float) * kLanes) RowOfDepths {
  float depth[kLanes];
};
struct alignas(sizeof(std::uint32_t) * kLanes) RowOfWords {
  std::uint32_t word[kLanes];
};

[[gnu::always_inline]] inline Floats& vectorOf(RowOfDepths& row) { return reinterpret_cast<Floats&>(row.depth); }
[[gnu::always_inline]] inline Words& vectorOf(RowOfWords& row) { return reinterpret_cast<Words&>(row.word); }
[[gnu::always_inline]] inline const Floats& vectorOf(const RowOfDepths& row) {
  return reinterpret_cast<const Floats&>(row.depth);
}
[[gnu::always_inline]] inline const Words& vectorOf(const RowOfWords& row) {
  return reinterpret_cast<const Words&>(row.word);
}

[[gnu::always_inline]] inline Floats toFloats(const double* of) {
  RowOfDepths row;
  for (std::size_t i = 0; i < kLanes; ++i) row.depth[i] = static_cast<float>(of[i]);
  return vectorOf(row);
}

/// What the pictures of a camera have in common. Rows are divided into tiles of kLanes pixels.
struct PictureGeometry {
  std::uint32_t width_px = 0, height_px = 0;
  std::size_t tiles = 0;  ///< in a row
  double focal_px = 0;
  double range_m = 0;     ///< depths below it are seen
  CameraAxes axes;        ///< robot frame
  bool is_level = false;  ///< each column of pixels lies in a vertical plane
  double edge_slope = 0;  ///< of a level camera: `left` at the picture's edge
  std::vector<double> left, dd,
      per_dd;                     ///< by column, to whole tiles: direction (1, left), squared length and its inverse
  std::vector<float> slope;       ///< of a level camera, by row: upwards per depth
  std::vector<double> per_slope;  ///< the inverse
  std::vector<RowOfWords> sky;    ///< by tile, then by row: colours of sky and haze

  /// @name Of other cameras
  ///@{
  double horizontal_max = 0;  ///< largest horizontal length of a ray per depth
  std::vector<double> up;     ///< by row, kLanes times
  /// Of a camera with a lens, by row and tile: offsets of its pixels. Otherwise empty.
  std::vector<double> lens_left, lens_up;
  ///@}

  PictureGeometry(const CameraInfo& info, const CameraAxes& axes, double range_max_m);
};

/// Colours of a solid.
struct SolidColors {
  bool is_set = false;
  PackedRgb level = 0;          ///< of the top or underside that is seen
  PackedRgb end = 0, side = 0;  ///< of a box's faces
  float shade[3]{}, sun[3]{};   ///< of a circle, in 8-bit levels: in the shade, and added by the sun
};

/// Memory for pictures, reused for all cameras of a thread.
struct PictureScratch {
  std::vector<SeenSolid> solids;
  std::vector<SolidColors> colors;  ///< by solid
  std::vector<RowOfDepths> depths;
  std::vector<RowOfWords> pixels, bodies;
};

/// A picture to be taken.
struct PictureJob {
  const PictureGeometry* camera;
  const SeenScene* seen;
  BodyId owner;
  ViewFrame frame;     ///< x along the optical axis of a level camera; of others, along the robot's
  float sun_x, sun_y;  ///< direction to the sun, in the frame
  double floor_m;      ///< height of the floor relative to the camera, below 0; -infinity when it is not seen
  PictureScratch* scratch;
  RaycastPicture* picture;  ///< of its final size
};

/// @name By the camera's geometry
///@{
void takeLevelPicture(const PictureJob& job);
void takeTiltedPicture(const PictureJob& job);
///@}

/// Sets the colours of a solid in a picture.
void setColors(const PictureJob& job, const SeenSolid& s, SolidColors& colors);

/// Calls draw(has_rgb, has_body) with the constants of the picture's layers.
template <typename Draw>
void forLayers(const RaycastPicture& picture, const Draw& draw) {
  const bool has_rgb = !picture.rgb.empty(), has_body = !picture.body.empty();
  if (has_rgb && has_body) return draw(std::true_type(), std::true_type());
  if (has_rgb) return draw(std::true_type(), std::false_type());
  if (has_body) return draw(std::false_type(), std::true_type());
  draw(std::false_type(), std::false_type());
}

/// Colours of a solid's vertical faces where the columns cross it.
[[gnu::always_inline]] inline Words faceColors(const SeenSolid& s, const SolidColors& colors,
                                               const Crossing& crossing) {
  RowOfWords words;
  if (s.isCircle()) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      const auto cosine = static_cast<float>(crossing.side[i]);
      const float share = cosine > 0 ? cosine : 0.0F;
      const float red = colors.shade[0] + colors.sun[0] * share;
      const float green = colors.shade[1] + colors.sun[1] * share;
      const float blue = colors.shade[2] + colors.sun[2] * share;
      const auto level = [](float of) { return static_cast<std::int32_t>((of < 255.0F ? of : 255.0F) + 0.5F); };
      words.word[i] = static_cast<std::uint32_t>(level(red) | level(green) << 8 | level(blue) << 16);
    }
  } else {
    for (std::size_t i = 0; i < kLanes; ++i) words.word[i] = crossing.side[i] > 0 ? colors.end : colors.side;
  }
  return vectorOf(words);
}

/// Layers of a picture, from a tile's first pixel.
struct TileTarget {
  std::uint8_t* rgb;  ///< null: not requested, as below
  float* depth_m;
  std::uint32_t* body;
  std::size_t width_px;  ///< of the picture
  std::size_t count;     ///< of the tile's columns in the picture, at most kLanes
  float range_m;

  TileTarget(const PictureJob& job, std::size_t tile, std::uint32_t row)
      : width_px(job.picture->width_px),
        count(std::min(kLanes, width_px - tile * kLanes)),
        range_m(static_cast<float>(job.camera->range_m)) {
    RaycastPicture& picture = *job.picture;
    const std::size_t at = row * width_px + tile * kLanes;
    rgb = picture.rgb.empty() ? nullptr : picture.rgb.data() + 3 * at;
    depth_m = picture.depth_m.empty() ? nullptr : picture.depth_m.data() + at;
    body = picture.body.empty() ? nullptr : picture.body.data() + at;
  }
};

/// Writes rows of a tile to the picture.
/// @tparam kIsWhole whether all columns of the tile are in the picture
template <bool kIsWhole>
[[gnu::always_inline]] inline void writeRows(const TileTarget& target, std::uint32_t rows, const RowOfDepths* depths,
                                             const RowOfWords* pixels, const RowOfWords* bodies) {
  using Bytes [[gnu::vector_size(16), gnu::may_alias]] = std::uint8_t;
  const std::size_t count = kIsWhole ? kLanes : target.count;
  const std::size_t width = target.width_px;
  if (float* to = target.depth_m) {
    for (std::uint32_t row = 0; row < rows; ++row, to += width) {
      RowOfDepths shown;
      const Floats& depth = vectorOf(depths[row]);
      vectorOf(shown) = depth < target.range_m ? depth : Floats{};
      std::memcpy(to, shown.depth, sizeof(float) * count);
    }
  }
  if (std::uint8_t* to = target.rgb) {
    for (std::uint32_t row = 0; row < rows; ++row, to += 3 * width) {
      // Three of every four bytes, without gaps.
      const auto* quads = reinterpret_cast<const Bytes*>(pixels[row].word);
      std::uint8_t bytes[3 * kLanes];
      std::uint8_t* const whole = kIsWhole ? to : bytes;
      for (std::size_t quad = 0; quad < 2; ++quad) {
        const Bytes three =
            __builtin_shufflevector(quads[quad], quads[quad], 0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15);
        std::memcpy(whole + 12 * quad, &three, 12);
      }
      if (!kIsWhole) std::memcpy(to, bytes, 3 * count);
    }
  }
  if (std::uint32_t* to = target.body) {
    for (std::uint32_t row = 0; row < rows; ++row, to += width) {
      std::memcpy(to, bodies[row].word, sizeof(std::uint32_t) * count);
    }
  }
}

[[gnu::always_inline]] inline void writeRows(const TileTarget& target, std::uint32_t rows, const RowOfDepths* depths,
                                             const RowOfWords* pixels, const RowOfWords* bodies) {
  if (target.count == kLanes) {
    writeRows<true>(target, rows, depths, pixels, bodies);
  } else {
    writeRows<false>(target, rows, depths, pixels, bodies);
  }
}

}  // namespace robosim
