#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "geometry/solid.h"
#include "world/world.h"

namespace robosim {

/// Decides who wins (2005: CheckWin). The gold is every hot object of the world. Of the robots that have asked since
/// the last decision, those whose discs are within the world's win distance of gold, outline to outline, are near
/// enough; the nearest of them wins, and of two equally near ones the first in the world's list. Height plays no part.
class Referee {
 public:
  Referee(const World& world, std::size_t robots);

  /// May be called for different robots from different threads.
  void ask(std::size_t robot) { asks_[robot] = 1; }

  /// @param disc_of where a robot stands
  /// @return who has won; nullopt for nobody
  std::optional<std::size_t> decide(const std::function<Circle(std::size_t robot)>& disc_of);
  /// Those that asked before the last decision, when nobody has won.
  std::span<const std::size_t> refused() const { return refused_; }

 private:
  double distanceToGold(const Circle& disc) const;  ///< [m]; infinite when there is no gold

  std::vector<Outline> gold_;
  double win_distance_m_;
  std::vector<std::uint8_t> asks_;  ///< by robot
  std::vector<std::size_t> refused_;
};

}  // namespace robosim
