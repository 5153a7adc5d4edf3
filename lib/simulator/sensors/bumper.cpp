#include "sensors/bumper.h"

#include <algorithm>
#include <cmath>

#include "base/portable_math.h"
#include "sensors/beam_mounts.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

class Bumper : public Sensor {
 public:
  explicit Bumper(const BumperOptions& options) : options_(options) {
    const double width_rad = 2 * M_PI / options.segments;
    info_.kind = SensorKind::bumper;
    info_.label = options.label;
    info_.beam_width_rad = width_rad;
    std::vector<Sector> sectors;
    for (int i = 0; i < options.segments; ++i) {
      const double angle = i * width_rad;
      const auto [sin, cos] = portable::sincos(angle);
      info_.beams.push_back(planarBeam(options.robot_radius_m * cos, options.robot_radius_m * sin, options.z_m, angle));
      sectors.push_back(Sector::towards({0, 0, options.z_m}, angle, width_rad / 2));
    }
    sectors_ = sectors;
    fan_ = BeamFan(sectors);
  }

  const SensorInfo& info() const override { return info_; }
  bool isNoisy() const override { return options_.chatter > 0; }
  double robotReach(double) const override { return options_.robot_radius_m + options_.travel_m; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    static thread_local BeamBatch batch;  // reused for all robots of a thread
    const double reach_m = options_.robot_radius_m + options_.travel_m;
    for (const auto robot : robots) {
      auto& pressed = std::get<Contacts>(readings[robot].measurements[slot]).pressed;
      static thread_local std::vector<std::uint8_t> before;
      if (options_.chatter > 0) before = pressed;
      batch.place(fan_, now.frames[robot], reach_m);
      now.scene.cast(batch, now.bodyOf(robot));
      for (std::size_t i = 0; i < pressed.size(); ++i) pressed[i] = batch.body(i) == BeamBatch::kNothing ? 0 : 1;
      if (now.surface) pressAtEdge(*now.surface, now.frames[robot], reach_m, pressed);
      if (options_.chatter > 0) bounce(now.noise(robot, slot), before, pressed);
    }
  }

 private:
  void bounce(Rng rng, const std::vector<std::uint8_t>& before, std::vector<std::uint8_t>& pressed) const {
    for (std::size_t i = 0; i < pressed.size(); ++i) {
      const bool flips = rng.uniform() < options_.chatter;
      if (flips && (pressed[i] != 0 || before[i] != 0)) pressed[i] = pressed[i] != 0 ? 0 : 1;
    }
  }

  /// Presses the segments that extend over an edge of the surface.
  void pressAtEdge(const Bounds2D& surface, const PlanarTransform& frame, double reach_m,
                   std::vector<std::uint8_t>& pressed) const {
    const auto press = [&](const TPoint2D& outwards, double distance_m) {
      if (distance_m > reach_m) return;
      const TPoint2D normal(frame.cos() * outwards.x + frame.sin() * outwards.y,
                            frame.cos() * outwards.y - frame.sin() * outwards.x);
      for (std::size_t i = 0; i < pressed.size(); ++i) {
        if (extentAlong(normal, sectors_[i], reach_m) >= distance_m) pressed[i] = 1;
      }
    };
    press({1, 0}, surface.x_max - frame.x());
    press({-1, 0}, frame.x() - surface.x_min);
    press({0, 1}, surface.y_max - frame.y());
    press({0, -1}, frame.y() - surface.y_min);
  }

  /// Extent of a segment from the robot's centre along a direction (unit vector, robot frame) [m].
  static double extentAlong(const TPoint2D& normal, const Sector& segment, double reach_m) {
    if (segment.contains(normal)) return reach_m;
    const auto along = [&](const TPoint2D& v) { return v.x * normal.x + v.y * normal.y; };
    return reach_m * std::max(along(segment.left), along(segment.right));
  }

  BumperOptions options_;
  SensorInfo info_;
  std::vector<Sector> sectors_;
  BeamFan fan_;  ///< sectors about the robot's centre, robot frame
};

}  // namespace

BumperOptions BumperOptions::read(XmlReader& reader, const Mount& mount) {
  BumperOptions o;
  o.label = reader.word("label", o.label);
  const double segments = reader.number("segments", {3, 360}, o.segments);
  if (segments != std::floor(segments)) reader.errorAt("segments", "must be a whole number");
  o.segments = static_cast<int>(segments);
  o.travel_m = reader.number("travel_m", Bounds::positive(0.1), o.travel_m);
  o.robot_radius_m = mount.robot_radius_m;
  if (auto noise = reader.child("noise")) {
    o.chatter = noise->number("chatter", Bounds::notNegative(1), 0);
    noise->finish();
  }
  o.z_m = reader.number("z_m", {-100, 100}, mount.robot_height_m / 2);
  return o;
}

std::unique_ptr<Sensor> makeBumper(const BumperOptions& options) { return std::make_unique<Bumper>(options); }

}  // namespace robosim
