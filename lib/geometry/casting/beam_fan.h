#pragma once
#include <span>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "geometry/shapes/ray.h"
#include "geometry/shapes/sector.h"

namespace robosim {

/// Beams of a sensor at one height with nearby origins, in the frame of their carrier, such as those of a laser or of a
/// sonar ring. The beams are either all planar rays or all sectors. Precomputes what every BeamBatch of the fan needs.
class BeamFan {
 public:
  /// Number of beams that a solid is intersected with at a time: few keep the beams of a sonar ring apart, many fill
  /// the widest vectors.
  ///@{
  static constexpr std::size_t kNarrowBlock = 4;
  static constexpr std::size_t kWideBlock = 8;
  ///@}

  BeamFan() = default;
  /// @param rays planar (direction.z == 0), all with the same origin.z
  explicit BeamFan(std::span<const Ray> rays);
  /// @param sectors all with the same apex.z
  explicit BeamFan(std::span<const Sector> sectors);

  std::size_t size() const { return slot_.size(); }
  /// Whether the beams are sectors.
  bool isWide() const { return is_wide_; }
  double z() const { return z_m_; }
  /// Middle of the beams' origins.
  const mrpt::math::TPoint2D& middle() const { return middle_; }
  /// Distance [m] from the middle to the farthest origin.
  double spread() const { return spread_m_; }
  /// Unit vector within 90° of all directions in the beams; (0, 0) when there is none.
  const mrpt::math::TPoint2D& facing() const { return facing_; }

 private:
  friend class BeamBatch;

  /// Points or directions by slot, padded to whole blocks with the last one.
  struct Vectors {
    std::vector<double> x, y;
    void add(double to_x, double to_y) {
      x.push_back(to_x);
      y.push_back(to_y);
    }
  };

  bool is_wide_ = false;
  double z_m_ = 0;
  mrpt::math::TPoint2D middle_;
  double spread_m_ = 0;
  mrpt::math::TPoint2D facing_;
  /// By slot: the beams sorted counter-clockwise. A ray has its direction as both edges.
  Vectors origin_, left_, right_;
  std::vector<std::uint32_t> slot_;  ///< by beam
  std::size_t block_ = kNarrowBlock;
  float half_width_rad_ = 0;  ///< of the widest beam
  /// By bin of BearingArrays, over two turns, and the end: the first slot at or after the bin's begin. The slots of the
  /// second turn begin at the padded number of beams.
  std::vector<std::uint32_t> first_;
};

}  // namespace robosim
