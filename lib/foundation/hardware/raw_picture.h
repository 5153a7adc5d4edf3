#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace robosim {

/// What the pictures of a ray-cast camera contain for each pixel. A camera of another model has none of these.
struct PictureLayers {
  bool rgb = false;
  bool depth = false;
  bool identity = false;
  bool operator==(const PictureLayers&) const = default;

  bool any() const { return rgb || depth || identity; }
  std::size_t bytesPerPixel() const { return (rgb ? 3u : 0u) + (depth ? 4u : 0u) + (identity ? 4u : 0u); }
  /// As in files, in the order of the pictures: {"rgb", "depth"}.
  std::vector<const char*> names() const;
};

/// Maximum width and height of an image [pixels], which JPEG files permit.
constexpr std::uint32_t kPictureSideMax_px = 2048;
/// Maximum number of pixels of a ray-cast picture, which bounds its size in messages and files.
constexpr std::size_t kRawPixelsMax = 1u << 20;

/// What a ray-cast camera sees, row by row from the top. It is exact: equal on every machine, and part of a run's
/// digest. Layers that the camera does not have are empty.
struct RawPicture {
  /// Identities of what is no body that users know. All others are indices: of the world's objects in their order, then
  /// of its robots (objects + robot).
  static constexpr std::uint32_t kSky = 0xffffffffu, kFloor = 0xfffffffeu, kWall = 0xfffffffdu;  ///< wall: of a map

  std::uint32_t width_px = 0, height_px = 0;  ///< [1, kPictureSideMax_px]
  float range_max_m = 0;                      ///< the camera's
  std::vector<std::uint8_t> rgb;              ///< red, green, blue of each pixel
  /// Distance of each pixel's point along the optical axis (z of the camera's optical frame); 0 where nothing is within
  /// range_max_m.
  std::vector<float> depth_m;
  std::vector<std::uint32_t> identity;  ///< of each pixel
  bool operator==(const RawPicture&) const = default;

  std::size_t pixels() const { return std::size_t{width_px} * height_px; }
  PictureLayers layers() const { return {!rgb.empty(), !depth_m.empty(), !identity.empty()}; }
  /// The bytes of its layers, in the order of the members; empty for those that it does not have.
  std::array<std::span<const std::byte>, 3> bytes() const {
    return {std::as_bytes(std::span(rgb)), std::as_bytes(std::span(depth_m)), std::as_bytes(std::span(identity))};
  }
  /// Colours for a view of it, as `rgb`: those, or else depths in shades of gray, white nearest, or else a colour for
  /// each identity.
  std::vector<std::uint8_t> viewedColors() const;

  /// As bytes in messages and saved states (little-endian).
  std::string toBytes() const;
  /// The inverse of toBytes(). @throws std::invalid_argument with a reason for bytes that it cannot have returned
  static RawPicture fromBytes(std::string_view bytes);
  /// Whether bytes begin as those of toBytes(), which no JPEG file does.
  static bool isIn(std::string_view bytes);
};

}  // namespace robosim
