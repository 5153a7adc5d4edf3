#pragma once
#include <vector>

#include "maze/pose_filter.h"
#include "maze/surface_map.h"

namespace robosim {

/// Corrects the drift of a pose by matching measured surfaces with those seen before. The distance of a point from the
/// line of a mapped surface (point-to-line metric: Censi, "An ICP variant using a point-to-line metric", ICRA 2008) is
/// a measurement of the filter. Where surfaces determine one direction only, as in a corridor, the other one drifts.
/// The map is taken as exact, and loops are not closed afterwards.
class ScanMatcher {
 public:
  explicit ScanMatcher(double cell_m) : map_(cell_m) {}

  /// Corrects the pose, and adds the points to the map.
  /// @param points robot frame
  void match(const std::vector<SurfacePoint>& points, PoseFilter& filter);
  void reset() { map_.reset(); }

 private:
  SurfaceMap map_;
};

}  // namespace robosim
