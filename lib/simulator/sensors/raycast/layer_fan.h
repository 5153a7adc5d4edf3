#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "geometry/scene.h"
#include "sensors/raycast/seen_solids.h"

namespace robosim {

/// Thin beams of a multi-layer scanner from one point: each column is a direction in the plane, and has one beam in
/// each layer, a cone of equal elevation. Constant; cast() finds what Scene::castRay() would for each beam, and the
/// floor, the plane z = 0 of the world frame.
class LayerFan {
 public:
  /// Origin and direction of a column, in the frame of the view.
  struct Column {
    mrpt::math::TPoint2D origin;     ///< [m]
    mrpt::math::TPoint2D direction;  ///< unit vector
  };

  /// @param directions unit vectors, in the frame of the view; neighbours should be similar
  /// @param elevations_rad of the layers, ascending, within ±89.9°
  /// @param range_max_m only what is nearer is found
  LayerFan(std::span<const mrpt::math::TPoint2D> directions, std::span<const double> elevations_rad,
           double range_max_m);

  std::size_t columns() const { return columns_; }
  std::size_t layers() const { return slope_.size(); }
  /// Index of a beam: layer by layer, from the lowest.
  std::size_t beam(std::size_t column, std::size_t layer) const { return layer * columns_ + column; }

  /// Casts all beams.
  /// @param frame of the view  @param owner is not hit
  /// @param distance_m by beam: replaced by the distance along the beam, infinite without a hit
  void cast(const Scene& scene, const ViewFrame& frame, BodyId owner, std::span<double> distance_m) const;
  /// The same with columns that start elsewhere, such as those of a scanner that moves during a scan.
  /// @param spread_m at least the distance of each column's origin from the view's
  void castMoved(const Scene& scene, const ViewFrame& frame, std::span<const Column> moved, double spread_m,
                 BodyId owner, std::span<double> distance_m) const;

 private:
  struct Job;
  template <bool kIsMoved>
  static void castTiles(const Job* job);

  std::size_t columns_;
  double range_m_;
  std::vector<double> dx_, dy_, ones_;                         ///< by column, padded to whole tiles
  std::vector<double> slope_, per_slope_, level_, per_level_;  ///< by layer: tangent of its elevation, cosine, inverses
};

}  // namespace robosim
