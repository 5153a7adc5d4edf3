#pragma once
#include <optional>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "maze/maze_map.h"

namespace robosim {

/// Where heat was looked for, and where it comes from.
///
/// Walls do not stop heat, and a heat sensor knows no direction. So each place where heat h was measured votes for
/// every cell within the sensor's range with the weight φ that a source there would have had (1 - distance / range):
/// with Σφ² and Σhφ in each cell, (Σhφ)² / Σφ² is the part of all measurements that one source in that cell explains,
/// and Σhφ / Σφ² its temperature (a matched filter). The law `linear` is exactly this; for `inverse` the peak is
/// blunter and in the same place.
class HeatTrace {
 public:
  struct Source {
    mrpt::math::TPoint2D place;
    double temperature = 0;
  };

  /// @param map must outlive this.
  HeatTrace(MazeMap& map, double range_m, double robot_radius_m);

  /// Takes in a measurement, unless the last one was taken less than a cell away. @return whether it did.
  bool measure(const mrpt::math::TPoint2D& robot, double heat);
  /// The cell that best explains the heat, among those within range of the hottest place since the last
  /// searchFromHere(); nullopt when there was no heat.
  std::optional<Source> source() const;
  double range() const { return range_m_; }
  /// Looks for the source about the last measurement from now on, whatever was hotter before.
  void searchFromHere() { hottest_ = last_; }
  /// Forgets where it measured; the map's cells are the caller's to clear.
  void reset();

  /// Within so many cells of the robot a measurement counts.
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

  MazeMap& map_;
  double range_m_;
  int reach_cells_;
  std::vector<Vote> votes_;
  std::optional<Measurement> last_, hottest_;
};

}  // namespace robosim
