#pragma once
#include "geometry/scene.h"

namespace robosim {

/// Closest hit found so far: a Hit without its point, small enough for registers. The point is computed for the final
/// hit only.
struct ClosestHit {
  double distance_m;
  BodyId body = kNoBody;

  /// Of two hits at the same distance the lower body wins.
  bool isWorseThan(double other_m, BodyId other) const {
    return other_m < distance_m || (other_m == distance_m && body != kNoBody && other < body);
  }
  void keepBetter(double other_m, BodyId other, BodyId except) {
    if (!isWorseThan(other_m, other) || other == except) return;
    distance_m = other_m;
    body = other;
  }
};

}  // namespace robosim
