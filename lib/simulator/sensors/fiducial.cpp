#include "sensors/fiducial.h"

#include <vector>

#include "hardware/numbered_quantities.h"
#include "sensors/sighting_sensor.h"

namespace robosim {
namespace {

class Fiducial : public SightingSensor {
 public:
  using SightingSensor::SightingSensor;

 protected:
  void find(const Snapshot& now, std::uint32_t robot, double, std::vector<Sighting>& all) const override {
    for (const FeaturedBody& marked : now.featured) {
      if (marked.body.fiducial == 0 || !marked.is_present || marked.id == now.bodyOf(robot)) continue;
      const auto& pose = marked.body.world_from_body;
      all.push_back({marked.body.fiducial, {pose.x, pose.y, marked.body.center_z_m}, marked.id, pose.phi});
    }
  }
};

}  // namespace

std::unique_ptr<Sensor> readFiducial(XmlReader& reader, const Mount& mount) {
  // Defaults of Stage: marks are seen within 8 m, and read within 5 m.
  auto options = SightingOptions::read(reader, "fiducial", 8, mount.robot_height_m / 2, fiducialQuantities);
  options.what_range_m = reader.number("id_range_max_m", Bounds::positive(100), 5);
  return std::make_unique<Fiducial>(options);
}

}  // namespace robosim
