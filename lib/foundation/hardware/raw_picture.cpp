#include "hardware/raw_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace robosim {
namespace {

static_assert(std::endian::native == std::endian::little, "pictures are little-endian in messages");

constexpr std::string_view kMagic = "RoboSim picture\n";

struct Header {
  std::uint32_t width_px, height_px;
  float range_max_m;
  std::uint32_t layers;  ///< 1: rgb, 2: depth, 4: identity
};

template <typename T>
void take(std::string_view& bytes, std::vector<T>& layer, std::size_t count) {
  layer.resize(count);
  std::memcpy(layer.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
}

}  // namespace

std::vector<const char*> PictureLayers::names() const {
  std::vector<const char*> names;
  for (const auto& [is_there, name] : {std::pair(rgb, "rgb"), {depth, "depth"}, {identity, "identity"}}) {
    if (is_there) names.push_back(name);
  }
  return names;
}

std::vector<std::uint8_t> RawPicture::viewedColors() const {
  if (!rgb.empty()) return rgb;
  std::vector<std::uint8_t> colors;
  colors.reserve(3 * pixels());
  for (const float depth : depth_m) {
    const float nearness = depth > 0 ? 1 - std::min(1.f, depth / range_max_m) : 0;
    colors.insert(colors.end(), 3, static_cast<std::uint8_t>(255 * nearness + 0.5f));
  }
  if (!colors.empty()) return colors;
  for (const std::uint32_t body : identity) {
    const std::uint32_t mixed = (body + 1) * 2654435761u;  // Knuth's multiplicative hash: neighbours differ clearly
    for (const int shift : {24, 16, 8}) colors.push_back(static_cast<std::uint8_t>(mixed >> shift));
  }
  return colors;
}

std::string RawPicture::toBytes() const {
  const auto [has_rgb, has_depth, has_identity] = layers();
  const Header header{width_px, height_px, range_max_m,
                      (has_rgb ? 1u : 0u) | (has_depth ? 2u : 0u) | (has_identity ? 4u : 0u)};
  std::string out(kMagic);
  out.append(reinterpret_cast<const char*>(&header), sizeof header);
  for (const auto& layer : bytes()) out.append(reinterpret_cast<const char*>(layer.data()), layer.size());
  return out;
}

RawPicture RawPicture::fromBytes(std::string_view bytes) {
  Header header;
  if (!isIn(bytes) || bytes.size() < kMagic.size() + sizeof header) throw std::invalid_argument("a damaged picture");
  std::memcpy(&header, bytes.data() + kMagic.size(), sizeof header);
  bytes.remove_prefix(kMagic.size() + sizeof header);
  RawPicture picture{header.width_px, header.height_px, header.range_max_m, {}, {}, {}};
  const std::size_t count = picture.pixels();
  const bool has_rgb = header.layers & 1, has_depth = header.layers & 2, has_identity = header.layers & 4;
  if (count == 0 || picture.width_px > kPictureSideMax_px || picture.height_px > kPictureSideMax_px ||
      count > kRawPixelsMax || header.layers == 0 || header.layers > 7 || !(header.range_max_m > 0) ||
      !std::isfinite(header.range_max_m) ||
      bytes.size() != count * PictureLayers{has_rgb, has_depth, has_identity}.bytesPerPixel()) {
    throw std::invalid_argument("a picture of an impossible size");
  }
  if (has_rgb) take(bytes, picture.rgb, 3 * count);
  if (has_depth) take(bytes, picture.depth_m, count);
  if (has_identity) take(bytes, picture.identity, count);
  const auto is_possible = [&](float depth) { return depth >= 0 && depth <= picture.range_max_m; };
  if (!std::all_of(picture.depth_m.begin(), picture.depth_m.end(), is_possible)) {
    throw std::invalid_argument("a picture with an impossible depth");
  }
  return picture;
}

bool RawPicture::isIn(std::string_view bytes) { return bytes.starts_with(kMagic); }

}  // namespace robosim
