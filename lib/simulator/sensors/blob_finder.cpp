#include "sensors/blob_finder.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "sensors/blob_regions.h"
#include "sensors/image_source.h"

namespace robosim {
namespace {

class BlobFinder : public Sensor {
 public:
  BlobFinder(BlobFinderOptions options, const SensorInfo& camera, std::size_t camera_slot)
      : options_(std::move(options)), camera_slot_(camera_slot) {
    info_.kind = SensorKind::blob_finder;
    info_.label = options_.label;
    info_.beams = camera.beams;
    info_.camera = camera.camera;
    info_.pans = camera.pans;
    for (const auto& color : options_.colors) info_.colors.push_back(color.name);
  }

  const SensorInfo& info() const override { return info_; }
  std::optional<std::size_t> slotRead() const override { return camera_slot_; }
  double robotReach(double) const override { return 0; }  // its camera has its own

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& measurements = readings[robot].measurements;
      const auto& image = std::get<Image>(measurements[camera_slot_]);
      auto& blobs = std::get<Blobs>(measurements[slot]);
      blobs = blankBlobs(info_);
      if (image.isEmpty() || (!image.raw && !now.images)) continue;
      blobs.taken = true;
      blobs.of_color = image.raw ? findBlobs(*image.raw, options_.colors, options_.pixels_min)
                                 : now.images->findBlobs(image.jpeg, options_.colors, options_.pixels_min);
    }
  }

 private:
  BlobFinderOptions options_;
  std::size_t camera_slot_;
  SensorInfo info_;
};

/// Hue in [0, 2π); nullopt for a grey, which has none.
std::optional<double> computeHue(const std::vector<double>& rgb) {
  const auto [low, high] = std::minmax_element(rgb.begin(), rgb.end());
  const double spread = *high - *low;
  if (spread <= 0.05) return std::nullopt;
  const auto main = high - rgb.begin();
  const auto at = [&](std::ptrdiff_t i) { return rgb[static_cast<std::size_t>((main + i) % 3)]; };
  const double sixths = 2 * static_cast<double>(main) + (at(1) - at(2)) / spread;
  return std::fmod(sixths + 6, 6) * M_PI / 3;
}

TargetColor readColor(XmlReader reader) {
  TargetColor color;
  color.name = reader.word("name");
  if (!reader.has("rgb")) reader.error("<rgb> is missing; add red, green and blue, such as rgb=\"1 0.8 0.1\"");
  const auto rgb = reader.numbers("rgb", 3, {0, 1}, {1, 0, 0});
  if (const auto hue_rad = computeHue(rgb)) {
    color.hue_rad = *hue_rad;
  } else {
    reader.errorAt("rgb", "is a grey, which has no hue; give a colour");
  }
  color.within_rad = reader.angle("within_deg", Bounds::positive(180), color.within_rad);
  color.saturation_min = reader.number("saturation_min", {0, 1}, color.saturation_min);
  color.value_min = reader.number("value_min", {0, 1}, color.value_min);
  reader.finish();
  return color;
}

}  // namespace

BlobFinderOptions BlobFinderOptions::read(XmlReader& reader) {
  BlobFinderOptions o;
  o.label = reader.word("label", o.label);
  o.camera = reader.word("camera", o.camera);
  const double pixels = reader.number("pixels_min", {1, 1e6}, o.pixels_min);
  if (pixels != std::floor(pixels)) reader.errorAt("pixels_min", "must be a whole number");
  o.pixels_min = static_cast<unsigned>(pixels);
  std::set<std::string> taken;
  for (auto& element : reader.all("color")) {
    o.colors.push_back(readColor(element));
    const std::string& name = o.colors.back().name;
    if (!name.empty() && !taken.insert(name).second) element.errorAt("name", "is taken by another colour; change one");
  }
  constexpr std::size_t kColorsMax = 32;
  if (o.colors.empty() || o.colors.size() > kColorsMax) {
    reader.error("has " + std::to_string(o.colors.size()) + " colours; give 1 to " + std::to_string(kColorsMax) +
                 ", such as <color name=\"gold\" rgb=\"1 0.8 0.1\"/>");
  }
  return o;
}

std::unique_ptr<Sensor> makeBlobFinder(const BlobFinderOptions& options,
                                       std::span<const std::shared_ptr<const Sensor>> mounted) {
  for (std::size_t slot = mounted.size(); slot-- > 0;) {
    const SensorInfo& info = mounted[slot]->info();
    if (info.kind != SensorKind::camera || (!options.camera.empty() && info.label != options.camera)) continue;
    if (info.camera.isRaycast() && !info.camera.layers.rgb) continue;
    return std::make_unique<BlobFinder>(options, info, slot);
  }
  return nullptr;
}

}  // namespace robosim
