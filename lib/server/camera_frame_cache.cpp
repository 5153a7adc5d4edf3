#include "server/camera_frame_cache.h"

namespace robosim {

void CameraFrameCache::update(const std::set<std::uint32_t>& watched, const std::vector<Readings>& readings) {
  std::erase_if(photos_,
                [&](const auto& photo) { return !watched.contains(static_cast<std::uint32_t>(photo.first.first)); });
  for (const auto robot : watched) {
    if (robot < readings.size()) note(robot, readings[robot]);
  }
}

void CameraFrameCache::note(std::size_t robot, const Readings& readings) {
  for (std::size_t slot = 0; slot < readings.measurements.size(); ++slot) {
    const auto* image = std::get_if<Image>(&readings.measurements[slot]);
    if (!image || image->jpeg.empty()) continue;
    Photo& photo = photos_[{robot, slot}];
    if (photo.jpeg.empty() || photo.step != readings.time.step) photo = {readings.time.step, image->jpeg};
  }
}

const CameraFrameCache::Photo* CameraFrameCache::find(std::size_t robot, std::size_t slot) const {
  const auto found = photos_.find({robot, slot});
  return found == photos_.end() ? nullptr : &found->second;
}

}  // namespace robosim
