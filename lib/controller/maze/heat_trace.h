#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "maze/maze_map.h"

namespace robosim {

/// Searched area, and estimate of the position of a heat source by a matched filter.
///
/// Walls do not block heat, and a heat sensor has no direction. Each measurement h contributes to every cell within the
/// sensor's range with the weight φ = 1 - distance / range that a source there would have. With Σφ² and Σhφ per cell,
/// (Σhφ)² / Σφ² is the part of all measurements explained by one source in that cell, and Σhφ / Σφ² its temperature.
/// This is exact for the law `linear`; for `inverse` the maximum is flatter and at the same position.
class HeatTrace {
 public:
  struct Source {
    mrpt::math::TPoint2D place;
    double temperature = 0;
  };

  /// @param map must outlive this.
  HeatTrace(MazeMap& map, double range_m, double robot_radius_m);

  /// A copy that works on `map`, a copy of its map.
  HeatTrace copyOn(MazeMap& map) const {
    HeatTrace copy = *this;
    copy.map_ = &map;
    return copy;
  }

  /// Adds a measurement, unless the last one was less than a cell away. @return whether it was added.
  bool measure(const mrpt::math::TPoint2D& robot, double heat);
  /// The cell that best explains the heat, among those within range of the hottest place since the last
  /// searchFromHere(); nullopt when there was no heat.
  std::optional<Source> source() const;
  double range() const { return range_m_; }
  /// Restarts the search at the last measurement, ignoring hotter earlier ones.
  void searchFromHere() { hottest_ = last_; }
  /// Clears the measurements; the caller must clear the map's cells.
  void reset();

  /// Radius of a measurement's influence [cells].
  int reach() const { return reach_cells_; }

 private:
  struct Vote {
    Cell offset;
    float weight;
    bool searched;
  };
  struct Measurement {
    mrpt::math::TPoint2D place;
    double heat;
  };

  MazeMap* map_;
  double range_m_;
  int reach_cells_;
  std::vector<Vote> votes_;
  std::optional<Measurement> last_, hottest_;
};

}  // namespace robosim
