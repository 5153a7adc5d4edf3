#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/pose_tracker.h"
#include "maze/random_walk.h"

namespace robosim {

/// Heat measurements at the latest places of a robot, and their gradient.
class HeatSlope {
 public:
  explicit HeatSlope(double spacing_m) : spacing_m_(spacing_m) {}

  /// Adds a measurement, unless the last one was less than the spacing away. Of earlier ones the latest 11 are kept.
  void measure(const mrpt::math::TPoint2D& place, double heat);
  /// Gradient of the plane that fits the measurements best (least squares) [°C/m]; nullopt when their places do not
  /// determine it, as places on a line.
  std::optional<mrpt::math::TPoint2D> gradient() const;
  void clear() { measurements_.clear(); }

 private:
  struct Measurement {
    mrpt::math::TPoint2D place;
    double heat;
  };
  double spacing_m_;
  std::vector<Measurement> measurements_;  ///< oldest first; few
};

/// Ascends the gradient of heat, as animals do that compare the intensities along their path (klinotaxis; Fraenkel &
/// Gunn, "The Orientation of Animals", 1940): where the heat exceeds `warm`, it drives along the gradient of its latest
/// measurements, and in an arc while these do not determine it. Elsewhere, and after an obstacle on its way, it is a
/// RandomWalk.
class HeatGradient : public Controller {
 public:
  HeatGradient(const ControllerSetup& setup, const StepLength& length, double warm)
      : walk_(setup, length), warm_(warm) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<HeatGradient>(*this); }
  bool hasDrawnRandomNumbers() const override { return walk_.hasDrawnRandomNumbers(); }

 private:
  void ascend(Robot& robot);

  RandomWalk walk_;
  double warm_;
  PoseTracker tracker_;
  std::optional<HeatSlope> slope_;  ///< constructed in the first step, since it requires the robot
  std::uint64_t walk_until_ = 0;    ///< step until which it walks at random after an obstacle
};

}  // namespace robosim
