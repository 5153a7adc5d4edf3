#include "sensors/camera_head.h"

#include <cmath>

#include "base/angle_units.h"

namespace robosim {
namespace {

enum class HeadModel : std::uint8_t { vcc4, evid30 };

/// The makers' data: doc/camera_heads.md gives the sources.
CameraHeadLimits limitsOf(HeadModel model) {
  const auto head = [](double pan_deg, double tilt_min_deg, double tilt_max_deg, double zoom_max, double pan_degps,
                       double tilt_degps, double zoom_s) {
    return CameraHeadLimits{
        -pan_deg * kRadPerDeg,  pan_deg * kRadPerDeg,    tilt_min_deg * kRadPerDeg, tilt_max_deg * kRadPerDeg, zoom_max,
        pan_degps * kRadPerDeg, tilt_degps * kRadPerDeg, (zoom_max - 1) / zoom_s};
  };
  switch (model) {
    case HeadModel::vcc4:
      return head(100, -30, 90, 16, 90, 70, 3);
    case HeadModel::evid30:
      return head(100, -25, 25, 12, 80, 50, 3);
  }
  return {};
}

/// Moves a value by at most `step`.
double approached(double value, double target, double step) {
  const double way = target - value;
  return std::abs(way) <= step ? target : value + std::copysign(step, way);
}

double speedOf(double commanded, double largest) { return commanded > 0 && commanded < largest ? commanded : largest; }

class CameraHead : public Sensor {
 public:
  explicit CameraHead(const CameraHeadOptions& options) {
    info_.kind = SensorKind::values;
    info_.label = options.label;
    info_.quantities = CameraAim::quantities();
    info_.head = options.limits;
  }

  const SensorInfo& info() const override { return info_; }
  bool usesNeighbours() const override { return false; }
  double robotReach(double) const override { return 0; }
  Measurement blank() const override { return CameraAim{}.values(); }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    if (now.time.step == 0 || now.commands.empty()) return;
    for (const auto robot : robots) {
      auto& measured = std::get<Values>(readings[robot].measurements[slot]);
      const CameraAim aim =
          movedTowards(*now.commands[robot].camera_head, CameraAim::from(measured), info_.head, now.time.period_s);
      measured.values = {aim.pan_rad, aim.tilt_rad, aim.zoom};
    }
  }

 private:
  SensorInfo info_;
};

}  // namespace

std::optional<CameraHeadOptions> CameraHeadOptions::read(XmlReader& camera) {
  auto reader = camera.child("ptz");
  if (!reader) return std::nullopt;
  CameraHeadOptions o;
  o.limits =
      limitsOf(reader->choice("model", {{"vcc4", HeadModel::vcc4}, {"evid30", HeadModel::evid30}}, HeadModel::vcc4));
  CameraHeadLimits& limits = o.limits;
  const auto speed = [&](const char* setting, double largest_radps) {
    return kRadPerDeg * reader->number(setting, Bounds::positive(3600), largest_radps / kRadPerDeg);
  };
  limits.pan_min_rad = reader->angle("pan_min_deg", {-360, 0}, limits.pan_min_rad);
  limits.pan_max_rad = reader->angle("pan_max_deg", {0, 360}, limits.pan_max_rad);
  limits.tilt_min_rad = reader->angle("tilt_min_deg", {-90, 0}, limits.tilt_min_rad);
  limits.tilt_max_rad = reader->angle("tilt_max_deg", {0, 90}, limits.tilt_max_rad);
  limits.zoom_max = reader->number("zoom_max", {1, 100}, limits.zoom_max);
  limits.pan_radps = speed("pan_degps", limits.pan_radps);
  limits.tilt_radps = speed("tilt_degps", limits.tilt_radps);
  limits.zoom_per_s = reader->number("zoom_per_s", Bounds::positive(1000), limits.zoom_per_s);
  reader->finish();
  return o;
}

std::unique_ptr<Sensor> makeCameraHead(const CameraHeadOptions& options) {
  return std::make_unique<CameraHead>(options);
}

CameraAim movedTowards(const CameraHeadCommand& command, const CameraAim& from, const CameraHeadLimits& limits,
                       double period_s) {
  const CameraAim target = limited(command.aim, limits);
  const CameraAim at = limited(from, limits);  // a saved state may have any
  return {approached(at.pan_rad, target.pan_rad, speedOf(command.pan_radps, limits.pan_radps) * period_s),
          approached(at.tilt_rad, target.tilt_rad, speedOf(command.tilt_radps, limits.tilt_radps) * period_s),
          approached(at.zoom, target.zoom, limits.zoom_per_s * period_s)};
}

}  // namespace robosim
