#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sensors/raycast/picture.h"

/// Colours of ray-cast pictures, close to those of the OpenGL scene (rendering/shaders.cpp). In single precision, from
/// exactly specified operations only.
namespace robosim {

using LightRgb = std::array<float, 3>;

/// The sun is behind the left shoulder of a viewer who faces along the y axis.
inline constexpr LightRgb kTowardsSun{-0.385F, -0.550F, 0.741F};  ///< unit vector, world frame
inline constexpr LightRgb kSunLight{0.52F, 0.50F, 0.46F};
inline constexpr LightRgb kSideLight{0.56F, 0.565F, 0.575F};     ///< of sky and ground on a vertical face
inline constexpr LightRgb kTopLight{0.985F, 0.99F, 1.0F};        ///< of sky and sun on a level face
inline constexpr LightRgb kUndersideLight{0.52F, 0.51F, 0.49F};  ///< of the ground
inline constexpr LightRgb kHorizonColor{0.82F, 0.88F, 0.94F};
inline constexpr LightRgb kZenithColor{0.33F, 0.53F, 0.80F};
inline constexpr LightRgb kHazeColor{0.66F, 0.70F, 0.72F};
inline constexpr LightRgb kCheckerColor{0.775F, 0.765F, 0.74F};  ///< mean of the checkerboard's fields
inline constexpr float kFieldContrast = 0.05F;                ///< by which bright and dark fields differ from the mean
inline constexpr LightRgb kGroundColor{0.60F, 0.63F, 0.55F};  ///< beyond the bounds

/// A colour as 0x00BBGGRR: its bytes in memory are red, green, blue, 0.
using PackedRgb = std::uint32_t;

inline PackedRgb packed(const Rgb& color) {
  return color[0] | static_cast<PackedRgb>(color[1]) << 8 | static_cast<PackedRgb>(color[2]) << 16;
}

/// @param level in [0, 1]; values beyond saturate
inline std::uint8_t levelOf(float level) {
  return static_cast<std::uint8_t>(std::min(std::max(level * 255.0F, 0.0F), 255.0F) + 0.5F);
}
inline PackedRgb packed(const LightRgb& color) {
  return packed(Rgb{levelOf(color[0]), levelOf(color[1]), levelOf(color[2])});
}

/// The colour of a surface in a light.
inline PackedRgb lit(const SurfaceLook& look, const LightRgb& light) {
  if (look.glows) return packed(look.color);
  LightRgb shown;
  for (std::size_t i = 0; i < 3; ++i) shown[i] = look.color[i] / 255.0F * light[i];
  return packed(shown);
}

/// Light on a vertical face. @param facing_sun cosine of the angle between its normal and the direction to the sun
inline LightRgb sideLight(float facing_sun) {
  LightRgb light;
  const float share = std::max(facing_sun, 0.0F);
  for (std::size_t i = 0; i < 3; ++i) light[i] = kSideLight[i] + kSunLight[i] * share;
  return light;
}

/// Sky, or haze below the horizon. @param up sine of the elevation
inline PackedRgb skyColor(float up) {
  if (!(up > 0)) return packed(kHazeColor);
  const float share = std::sqrt(std::min(up, 1.0F));
  LightRgb color;
  for (std::size_t i = 0; i < 3; ++i) color[i] = kHorizonColor[i] + (kZenithColor[i] - kHorizonColor[i]) * share;
  return packed(color);
}

/// Colours of a field of the checkerboard.
struct FieldColors {
  PackedRgb bright = 0, dark = 0;
};
/// @param pixel_m length on the floor that a pixel covers: the contrast fades where fields become narrower than pixels
inline FieldColors fieldColors(float pixel_m) {
  const float contrast = kFieldContrast * std::min(std::max(1.6F - 2.0F * pixel_m, 0.0F), 1.0F);
  LightRgb bright, dark;
  for (std::size_t i = 0; i < 3; ++i) {
    bright[i] = kCheckerColor[i] * (1.0F + contrast);
    dark[i] = kCheckerColor[i] * (1.0F - contrast);
  }
  return {packed(bright), packed(dark)};
}

/// Colour that is painted on the floor at a place, if any.
inline std::optional<PackedRgb> paintAt(const FloorLook& floor, const mrpt::math::TPoint2D& place) {
  for (auto i = floor.pictures.size(); i-- > 0;) {
    if (floor.pictures[i].isPainted(place)) return packed(LightRgb(floor.pictures[i].color()));
  }
  for (auto i = floor.areas.size(); i-- > 0;) {
    if (isOn(floor.areas[i].outline, place)) return packed(floor.areas[i].color);
  }
  return std::nullopt;
}

/// Whether a field of the checkerboard is bright.
inline bool isBrightField(double x, double y) {
  return ((static_cast<std::int64_t>(std::floor(x)) ^ static_cast<std::int64_t>(std::floor(y))) & 1) != 0;
}

}  // namespace robosim
