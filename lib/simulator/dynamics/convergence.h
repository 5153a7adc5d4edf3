#pragma once

namespace robosim {

/// Ends the sweeps of an iteration that has converged, or that does not: between wedged bodies it never does.
class Convergence {
 public:
  /// @param fault what is left after a sweep
  bool isOver(double fault) {
    if (fault == 0) return true;
    if (++sweeps_ % kSweepsCompared != 0) return false;
    const bool is_stuck = before_ > 0 && fault > kShareMax * before_;
    before_ = fault;
    return is_stuck;
  }

 private:
  static constexpr int kSweepsCompared = 16;
  /// A row of 40 bodies converges by this in so many sweeps.
  static constexpr double kShareMax = 0.9;
  int sweeps_ = 0;
  double before_ = 0;
};

}  // namespace robosim
