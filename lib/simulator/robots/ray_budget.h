#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>

#include "robots/fleet.h"

namespace robosim {

/// Sums the beams and rays that determine a fleet's memory.
class RayBudget {
 public:
  /// Adds a robot.
  /// @return which limit is exceeded; empty if none
  std::string add(const std::shared_ptr<const RobotModel>& model) {
    auto [counted, is_new] = models_.try_emplace(model);
    if (is_new) {
      for (const auto& sensor : model->sensors) {
        counted->second += sensor->info().beams.size();
        model_rays_ += sensor->rayCount();
      }
    }
    beams_ += counted->second;
    if (beams_ > kWorldBeamsMax) return "the robots have more than " + std::to_string(kWorldBeamsMax) + " beams";
    if (model_rays_ <= kWorldModelRaysMax) return "";
    return "the sensors of the " + std::to_string(models_.size()) + " kinds of robots have more than " +
           std::to_string(kWorldModelRaysMax) + " rays";
  }

 private:
  std::unordered_map<std::shared_ptr<const RobotModel>, std::size_t> models_;  ///< with the number of beams of each
  std::size_t beams_ = 0, model_rays_ = 0;
};

}  // namespace robosim
