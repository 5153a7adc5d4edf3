#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/candidates.h"
#include "geometry/level_frame.h"
#include "geometry/sector_fan.h"

namespace robosim {

/// Sectors in single precision, from the middle of their fan: to tell quickly which of them a solid may reach into.
class RoughSectors {
 public:
  static constexpr std::size_t kBlock = SectorFan::kBlock;

  /// @param turn only its sine and cosine count: the sectors stay where the fan's middle is
  void place(const SectorFan& fan, const LevelFrame& turn, double range_m);
  std::size_t blocks() const { return reach_.size() / kBlock; }

  /// How far a sector still looks [m].
  void setReach(std::size_t sector, double reach_m) { reach_[sector] = static_cast<float>(reach_m); }

  /// Which sectors each solid may reach into nearer than they look: it lies neither all beyond one of their edges nor
  /// all too far along their axis.
  /// @param masks one a block
  void find(const RoughPlace& middle, const Candidates& candidates, std::span<Candidates::Masks> masks) const;

 private:
  struct Vectors {
    std::vector<float> x, y;
  };
  std::size_t size_ = 0;
  Vectors apex_, axis_, left_, right_;
  std::vector<float> reach_;
};

}  // namespace robosim
