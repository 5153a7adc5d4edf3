#pragma once
#include "control/controller.h"
#include "control/controller_type.h"
#include "maze/straight_step.h"
#include "maze/stuck_recovery.h"

namespace robosim {

/// Distribution of the lengths of the straight steps of a walk.
class StepLength {
 public:
  /// Exponential distribution.
  static StepLength exponential(double mean_m) { return {0, mean_m, 0}; }
  /// Power law: the density of a length l >= min_m is proportional to l^-exponent. Lengths are cut off at max_m.
  static StepLength powerLaw(double exponent, double min_m, double max_m) { return {exponent, min_m, max_m}; }

  /// Length [m] that a step exceeds with the probability `share`, (0, 1].
  double exceededBy(double share) const;

 private:
  StepLength(double exponent, double scale_m, double max_m) : exponent_(exponent), scale_m_(scale_m), max_m_(max_m) {}

  double exponent_;  ///< 0: exponential distribution
  double scale_m_, max_m_;
};

/// Random walk: straight steps of random length, each after a turn by a uniformly distributed angle (Pearson, "The
/// problem of the random walk", Nature 72, 1905). Departures: Pearson's steps have one length; and a step also ends in
/// front of an obstacle. With lengths of a power law it is a Lévy walk (Viswanathan et al., "Optimizing the success of
/// random searches", Nature 401, 1999): exponent 2 is optimal for sparse targets that may be found again, and smaller
/// ones, towards 1, for targets that are found once. StuckRecovery handles lack of progress.
class RandomWalk : public Controller {
 public:
  RandomWalk(const ControllerSetup& setup, const StepLength& length)
      : setup_(setup), length_(length), recovery_(setup) {}
  void step(Robot& robot) override;
  std::unique_ptr<Controller> clone() const override { return std::make_unique<RandomWalk>(*this); }
  bool hasDrawnRandomNumbers() const override { return true; }

 private:
  ControllerSetup setup_;
  StepLength length_;
  StuckRecovery recovery_;
  StraightStep step_;
};

}  // namespace robosim
