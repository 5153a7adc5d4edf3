#pragma once
#include <memory>
#include <vector>

#include "geometry/index/center_index.h"
#include "geometry/index/neighbour_list.h"
#include "geometry/scene.h"

namespace robosim {

/// The solids of a scene, indexed.
struct SceneIndex {
  std::shared_ptr<const GridIndex> shared_stationary;
  const GridIndex& stationary;  ///< the shared one
  CenterIndex moving;
  std::vector<NeighbourList> neighbours;  ///< by moving solid

  std::uint32_t firstMoving() const { return static_cast<std::uint32_t>(stationary.items().size()); }
  BodyId movingBody(std::uint32_t i) const { return BodyId{firstMoving() + i}; }
  const GridItem& item(BodyId body) const {
    const auto i = static_cast<std::uint32_t>(body);
    return i < firstMoving() ? stationary.items()[stationary.indexOf(i)] : moving.items()[i - firstMoving()];
  }
  /// The neighbours of a body; null unless it is a moving solid.
  const NeighbourList* neighboursOf(BodyId owner) const {
    const std::size_t i = static_cast<std::uint32_t>(owner) - firstMoving();
    return i < neighbours.size() ? &neighbours[i] : nullptr;
  }
};

/// Closest hit found so far: a Hit without its point, small enough for registers. The point is computed for the final
/// hit only.
struct ClosestHit {
  double distance_m;
  BodyId body = kNoBody;

  /// Of two hits at the same distance the lower body wins.
  void keepBetter(double other_m, BodyId other, BodyId except) {
    const bool is_better = other_m < distance_m || (other_m == distance_m && body != kNoBody && other < body);
    if (!is_better || other == except) return;
    distance_m = other_m;
    body = other;
  }
};

}  // namespace robosim
