#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "geometry/shapes/solid.h"
#include "world/world.h"

namespace robosim {

/// Outlines of the gold among objects: of every hot one.
std::vector<Outline> findGold(const std::vector<WorldObject>& objects);

/// Decides which robot wins (2005: CheckWin). Candidates are the robots that
/// have requested CheckWin since the last decision and whose discs are within the world's win distance of gold, outline
/// to outline. The nearest candidate wins; of equally near ones, the first in the world's list. Heights are ignored.
class Referee {
 public:
  Referee(const std::vector<WorldObject>& objects, double win_distance_m);

  /// @param requests by robot, 1 for a request of CheckWin
  /// @param disc_of the disc of a robot at its current pose
  /// @return the winner; nullopt if there is none
  std::optional<std::size_t> decide(std::span<const std::uint8_t> requests,
                                    const std::function<Circle(std::size_t robot)>& disc_of) const;

 private:
  double distanceToGold(const Circle& disc) const;  ///< [m]; infinite when there is no gold

  std::vector<Outline> gold_;
  double win_distance_m_;
};

}  // namespace robosim
