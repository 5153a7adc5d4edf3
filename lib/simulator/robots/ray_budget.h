#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>

#include "robots/fleet.h"

namespace robosim {

/// Sums the beams, rays and pixels that determine a fleet's memory.
class RayBudget {
 public:
  /// Adds a robot.
  /// @return which limit is exceeded, and how to keep it; empty if none
  std::string add(const std::shared_ptr<const RobotModel>& model) {
    auto [counted, is_new] = models_.try_emplace(model);
    if (is_new) {
      for (const auto& sensor : model->sensors) {
        const SensorInfo& info = sensor->info();
        counted->second.beams += info.beams.size();
        model_rays_ += sensor->rayCount();
        if (info.kind != SensorKind::camera || !info.camera.isRaycast()) continue;
        const std::size_t pixels = std::size_t{info.camera.width_px} * info.camera.height_px;
        counted->second.picture_bytes += pixels * info.camera.layers.bytesPerPixel();
        picture_bytes_ += pixels * kGeometryBytes;
      }
    }
    beams_ += counted->second.beams;
    picture_bytes_ += counted->second.picture_bytes;
    constexpr const char* kFewerBeams = "; use fewer robots, or sensors of fewer beams";
    if (beams_ > kWorldBeamsMax) {
      return "the robots have more than " + std::to_string(kWorldBeamsMax) + " beams" + kFewerBeams;
    }
    if (model_rays_ > kWorldModelRaysMax) {
      return "the sensors of the " + std::to_string(models_.size()) + " kinds of robots have more than " +
             std::to_string(kWorldModelRaysMax) + " rays" + kFewerBeams;
    }
    if (picture_bytes_ <= kWorldPictureBytesMax) return "";
    return "the ray-cast pictures of the robots take more than " + std::to_string(kWorldPictureBytesMax) +
           " bytes; use fewer robots, or cameras of fewer pixels or layers";
  }

 private:
  /// Of a camera with a lens, for each pixel of a robot model.
  static constexpr std::size_t kGeometryBytes = 20;
  struct OfOneRobot {
    std::size_t beams = 0, picture_bytes = 0;
  };

  std::unordered_map<std::shared_ptr<const RobotModel>, OfOneRobot> models_;
  std::size_t beams_ = 0, model_rays_ = 0, picture_bytes_ = 0;
};

}  // namespace robosim
