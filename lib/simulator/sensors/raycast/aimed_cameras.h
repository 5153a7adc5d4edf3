#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "hardware/camera_head.h"
#include "sensors/raycast/camera.h"

namespace robosim {

/// The cameras of the latest aims of a head: a head that stands still, or robots whose heads have equal aims, need one
/// camera. Making one takes about as long as some pictures. Thread-safe.
class AimedCameras {
 public:
  /// @param pixels of a picture, which determine the memory of a camera
  explicit AimedCameras(std::size_t pixels)
      : most_(std::clamp<std::size_t>(kPixelsMax / std::max<std::size_t>(1, pixels), 1, 64)) {}

  /// @param make returns the camera of the aim
  template <typename Make>
  std::shared_ptr<const RaycastCamera> at(const CameraAim& aim, const Make& make) {
    {
      const std::lock_guard lock(mutex_);
      const auto found =
          std::find_if(latest_.begin(), latest_.end(), [&](const auto& one) { return one.first == aim; });
      if (found != latest_.end()) {
        std::rotate(latest_.begin(), found, found + 1);
        return latest_.front().second;
      }
    }
    auto made = std::make_shared<const RaycastCamera>(make());  // without blocking other threads
    const std::lock_guard lock(mutex_);
    if (latest_.size() == most_) latest_.pop_back();
    latest_.insert(latest_.begin(), {aim, made});
    return made;
  }

 private:
  static constexpr std::size_t kPixelsMax = 1 << 20;

  std::size_t most_;
  std::mutex mutex_;
  std::vector<std::pair<CameraAim, std::shared_ptr<const RaycastCamera>>> latest_;  ///< the last used first
};

}  // namespace robosim
