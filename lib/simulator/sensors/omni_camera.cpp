#include "sensors/omni_camera.h"

#include <algorithm>
#include <vector>

#include "hardware/led_color.h"
#include "hardware/numbered_quantities.h"
#include "sensors/sighting_sensor.h"

namespace robosim {
namespace {

class OmniCamera : public SightingSensor {
 public:
  using SightingSensor::SightingSensor;

 protected:
  void find(const Snapshot& now, std::uint32_t robot, double range_m, std::vector<Sighting>& all) const override {
    const auto& own = now.world_from_robot[robot];
    static thread_local std::vector<std::uint32_t> near;
    now.scene.findMoving({own.x, own.y}, range_m, now.commands.size(), near);
    std::sort(near.begin(), near.end());
    for (const auto other : near) {
      const std::uint32_t color = now.commands[other].led_color;
      if (other == robot || color == 0) continue;
      const auto& pose = now.world_from_robot[other];
      const double z_m = now.scene.solid(now.bodyOf(other)).heights.z_max_m;
      all.push_back({static_cast<double>(color), {pose.x, pose.y, z_m}, now.bodyOf(other), pose.phi});
    }
    for (const FeaturedBody& light : now.featured) {
      if (light.body.light_cd == 0 || !light.is_present || light.id == now.bodyOf(robot)) continue;
      const auto& pose = light.body.world_from_body;
      const double color = ledColor(light.body.color);
      all.push_back({color, {pose.x, pose.y, light.body.center_z_m}, light.id, pose.phi});
    }
  }
};

}  // namespace

std::unique_ptr<Sensor> readOmniCamera(XmlReader& reader, const Mount& mount) {
  return std::make_unique<OmniCamera>(
      SightingOptions::read(reader, "omni_camera", 3, mount.robot_height_m, blobQuantities));
}

}  // namespace robosim
