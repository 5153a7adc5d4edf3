#include "sensors/bumper.h"

#include <cmath>

#include "geometry/sector_batch.h"
#include "sensors/beam_mounts.h"

namespace robosim {
namespace {

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
      info_.beams.push_back(levelBeam(options.robot_radius_m * std::cos(angle),
                                      options.robot_radius_m * std::sin(angle), options.z_m, angle));
      sectors.push_back(Sector::towards({0, 0, options.z_m}, angle, width_rad / 2));
    }
    fan_ = SectorFan(sectors);
  }

  const SensorInfo& info() const override { return info_; }
  Measurement blank() const override { return Contacts{std::vector<std::uint8_t>(fan_.size(), 0)}; }

  void sense(const Snapshot& now, std::span<const std::uint32_t> robots, std::size_t slot,
             std::span<Readings> readings) const override {
    static thread_local SectorBatch batch;  // its arrays serve all robots of a thread
    const double reach_m = options_.robot_radius_m + options_.travel_m;
    for (const auto robot : robots) {
      auto& pressed = std::get<Contacts>(readings[robot].measurements[slot]).pressed;
      batch.place(fan_, now.frames[robot], reach_m);
      now.scene.senseSectors(batch, now.bodyOf(robot), now.near[robot]);
      for (std::size_t i = 0; i < pressed.size(); ++i) pressed[i] = batch.body(i) == SectorBatch::kNothing ? 0 : 1;
    }
  }

 private:
  BumperOptions options_;
  SensorInfo info_;
  SectorFan fan_;  ///< from the robot's centre, robot frame
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
  o.z_m = reader.number("z_m", {-100, 100}, mount.robot_height_m / 2);
  return o;
}

std::unique_ptr<Sensor> makeBumper(const BumperOptions& options) { return std::make_unique<Bumper>(options); }

}  // namespace robosim
