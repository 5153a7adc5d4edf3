#include "sensors/ground.h"

#include <algorithm>

#include "hardware/numbered_quantities.h"
#include "sensors/beam_mounts.h"
#include "sensors/line_of_sight.h"

namespace robosim {
namespace {

class Ground : public Sensor {
 public:
  Ground(SensorInfo info, double noise_std) : info_(std::move(info)), noise_std_(noise_std) {}

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return noise_std_ > 0; }
  bool usesNeighbours() const override { return false; }
  double robotReach(double) const override { return 0; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    for (const auto robot : robots) {
      auto& values = std::get<Values>(readings[robot].measurements[slot]).values;
      Rng rng = now.noise(robot, slot);
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto at = now.frames[robot].pointToWorld(originOf(info_.beams[i]));
        double grey = greyAt(now, {at.x, at.y});
        if (noise_std_ > 0) grey = std::clamp(grey + noise_std_ * rng.gaussian(), 0.0, 1.0);
        values[i] = asFloat(grey);
      }
    }
  }

 private:
  static double greyAt(const Snapshot& now, const mrpt::math::TPoint2D& point) {
    const auto is_above = [&](const FeaturedBody& area) {
      return area.is_present && area.body.isFloor() && isOn(area.solid.outline, point);
    };
    const auto area = std::find_if(now.featured.rbegin(), now.featured.rend(), is_above);
    if (area != now.featured.rend()) return greyOf(area->body.color);
    const auto picture = std::find_if(now.floor_pictures.rbegin(), now.floor_pictures.rend(),
                                      [&](const FloorPicture& one) { return one.isPainted(point); });
    if (picture != now.floor_pictures.rend()) return greyOf(picture->color());
    return 1;
  }

  SensorInfo info_;
  double noise_std_;
};

}  // namespace

double greyOf(const std::array<float, 3>& rgb) {
  return 0.299 * static_cast<double>(rgb[0]) + 0.587 * static_cast<double>(rgb[1]) +
         0.114 * static_cast<double>(rgb[2]);
}

std::unique_ptr<Sensor> readGround(XmlReader& reader, const Mount&) {
  SensorInfo info;
  info.kind = SensorKind::values;
  info.label = reader.word("label", "ground");
  info.beams = readBeamMounts(reader);
  info.quantities = numberedQuantities(info.beams.size(), {{"grey", ""}});
  double noise_std = 0;
  if (auto noise = reader.child("noise")) {
    noise_std = noise->number("std", {0, 1}, 0.02);
    noise->finish();
  }
  return std::make_unique<Ground>(std::move(info), noise_std);
}

}  // namespace robosim
