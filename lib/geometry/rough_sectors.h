#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/level_frame.h"
#include "geometry/rough_solid.h"
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
  /// all too far along their axis. For each solid and each block of sectors, bit i for sector i.
  void find(const RoughPlace& middle, const RoughSolid* solids, std::span<const std::uint32_t> indices,
            std::uint32_t* masks) const;

 private:
  struct Vectors {
    std::vector<float> x, y;
  };
  Vectors apex_, axis_, left_, right_;
  std::vector<float> reach_;
};

}  // namespace robosim
