#include "server/photo_album.h"

namespace robosim {

void PhotoAlbum::note(std::size_t robot, const Readings& readings) {
  for (std::size_t slot = 0; slot < readings.measurements.size(); ++slot) {
    const auto* image = std::get_if<Image>(&readings.measurements[slot]);
    if (!image || image->jpeg.empty()) continue;
    Photo& photo = photos_[{robot, slot}];
    if (photo.jpeg.empty() || photo.step != readings.time.step) photo = {readings.time.step, image->jpeg};
  }
}

const PhotoAlbum::Photo* PhotoAlbum::find(std::size_t robot, std::size_t slot) const {
  const auto found = photos_.find({robot, slot});
  return found == photos_.end() ? nullptr : &found->second;
}

}  // namespace robosim
