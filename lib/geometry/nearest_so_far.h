#pragma once
#include "geometry/scene.h"

namespace robosim {

/// A Hit without its point, which is for the last: small enough for a processor's registers.
struct NearestSoFar {
  double distance_m;
  BodyId body = kNoBody;

  /// A tie goes to the lowest body.
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
