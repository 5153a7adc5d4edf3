#include "server/camera_frame_cache.h"

namespace robosim {

void CameraFrameCache::update(const std::set<std::uint32_t>& watched, const std::vector<Readings>& readings) {
  std::erase_if(pictures_, [&](const auto& picture) {
    return !watched.contains(static_cast<std::uint32_t>(picture.first.first));
  });
  for (const auto robot : watched) {
    if (robot < readings.size()) note(robot, readings[robot]);
  }
}

void CameraFrameCache::note(std::size_t robot, const Readings& readings) {
  for (std::size_t slot = 0; slot < readings.measurements.size(); ++slot) {
    const auto* image = std::get_if<Image>(&readings.measurements[slot]);
    if (!image || image->isEmpty()) continue;
    Picture& picture = pictures_[{robot, slot}];
    if (picture.image.isEmpty() || picture.step != readings.time.step) picture = {readings.time.step, *image};
  }
}

const CameraFrameCache::Picture* CameraFrameCache::find(std::size_t robot, std::size_t slot) const {
  const auto found = pictures_.find({robot, slot});
  return found == pictures_.end() ? nullptr : &found->second;
}

}  // namespace robosim
