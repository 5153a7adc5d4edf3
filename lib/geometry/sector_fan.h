#pragma once
#include <span>
#include <vector>

#include "geometry/sector.h"

namespace robosim {

/// Sectors of one height that look from near one place, in the frame of what carries them, as those of a ring of
/// sonars. A SectorBatch asks them all at once.
class SectorFan {
 public:
  static constexpr std::size_t kBlock = 16;

  SectorFan() = default;
  /// @param sectors all of the same apex.z
  explicit SectorFan(std::span<const Sector> sectors);

  std::size_t size() const { return size_; }
  double z() const { return z_m_; }
  /// In the middle of the apexes.
  const mrpt::math::TPoint2D& middle() const { return middle_; }
  /// Distance from there to the farthest apex [m].
  double spread() const { return spread_m_; }

 private:
  friend class RoughSectors;
  friend class SectorBatch;

  /// Points or directions, by sector; the last one repeated up to a whole block.
  struct Vectors {
    std::vector<double> x, y;
    void add(double to_x, double to_y) {
      x.push_back(to_x);
      y.push_back(to_y);
    }
  };

  std::size_t size_ = 0;
  double z_m_ = 0;
  mrpt::math::TPoint2D middle_;
  double spread_m_ = 0;
  Vectors apex_, axis_, left_, right_;
};

}  // namespace robosim
